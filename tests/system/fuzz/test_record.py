"""Records of runs: the same twice, another one if an answer changes."""

import pytest

from fuzz.pair_record import ARRAYS, pair_record
from fuzz.record import differences, record

FAMILIES = ["convex", "chains_on_grid", "points_in_line"]


@pytest.fixture(scope="module")
def lines():
    return list(record(FAMILIES, 6))


def test_a_record_has_a_line_for_every_scene_and_way(lines):
    ways = [line.split()[:3] for line in lines]

    assert len(ways) == 2 * (4 + 4 + 5)
    assert ways[:4] == [["convex", "0", way] for way in ("pairs", "greedy", "mixed", "lazy")]


def test_a_record_is_the_same_twice(lines):
    assert differences(lines, list(record(FAMILIES, 6))) == []


def test_another_answer_is_another_record(lines, monkeypatch):
    monkeypatch.setattr("exactpt.pairs.incidences.finite", lambda x: x + 1.0)

    assert differences(lines, list(record(FAMILIES, 6)))


def test_record_of_pairs_repeats_and_changes_with_an_answer(monkeypatch):
    lines = list(pair_record(["convex", "kissing_discs"], 2, 4))
    assert len(lines) == 6 + 4 + ARRAYS
    assert differences(lines, list(pair_record(["convex", "kissing_discs"], 2, 4))) == []

    monkeypatch.setattr("exactpt.pairs.incidences.finite", lambda x: x + 1.0)

    changed = differences(lines, list(pair_record(["convex", "kissing_discs"], 2, 4)))
    assert {line.split()[1] for line in changed} >= {"kissing_discs", "arrays"}
