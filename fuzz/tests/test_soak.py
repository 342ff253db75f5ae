"""A soak in short, and records of runs."""

import pytest

from exactpt import AuditError, Simulation
from fuzz import soak
from fuzz.pair_record import ARRAYS, pair_record
from fuzz.record import differences, record
from fuzz.soak import Sample, Soak, table, verdict


def actions(count, seed=1, tiling="lazy"):
    soaked = Soak(seed, tiling)
    chosen = soaked._actions()
    for _ in range(count):
        action = soaked.rng.choices(*chosen)[0]
        soaked.did[action.__name__] += 1
        action()
    return soaked


@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_everything_happens(tiling):
    did = actions(60, tiling=tiling).did

    assert set(did) >= {"go_on", "plan", "come", "go", "copy", "save", "audit", "prove", "contact"}


def test_a_seed_gives_the_same_soak():
    assert actions(30).did == actions(30).did


def test_it_lasts_as_long_as_it_is_asked_to():
    soaked, reported = Soak(0, "lazy"), []

    soaked.run(1.0, reported.append)

    assert len(reported) == len(soaked.samples) > 3
    assert len(table(soaked)) == len(reported) + 2


def test_a_copy_that_differs_is_noticed(monkeypatch):
    soaked = Soak(0, "lazy")
    monkeypatch.setattr(Simulation, "copy", lambda _: Soak(1, "lazy").simulation)

    with pytest.raises(AuditError, match="a copy goes on in another way"):
        all(soaked.copy() is None for _ in range(50))


def test_a_restored_run_that_differs_is_noticed(monkeypatch):
    soaked = Soak(0, "lazy")
    monkeypatch.setattr(Simulation, "restore", lambda _: Soak(1, "lazy").simulation)

    with pytest.raises(AuditError, match="a restored run has another state"):
        soaked.save()


def test_overlap_and_rejected_proofs_are_noticed(monkeypatch):
    soaked = Soak(0, "lazy")
    monkeypatch.setattr(soak, "initial_touches", lambda _: ([], [(0, 1)]))
    with pytest.raises(AuditError, match="bodies overlap"):
        soaked.audit()

    def rejected(*_):
        raise soak.proof_scene.Rejected("line 3")

    monkeypatch.setattr(soak.proof_check, "check", rejected)
    with pytest.raises(AuditError, match="a proof is rejected: line 3"):
        soaked.prove()


@pytest.mark.parametrize(
    "memory, digits, grown", [(0, 0, 0), (0.5, 0, 0), (5, 0, 1), (0, 9, 1), (5, 9, 2)]
)
def test_growth_is_noticed(memory, digits, grown):
    soaked = Soak(0, "lazy")
    soaked.samples = [
        Sample(i, i, 100, 5, 50 + memory * i, 80 + digits * i, 0.5) for i in range(30)
    ]

    assert len(verdict(soaked)) == grown


# Records of runs: the same twice, another one if an answer changes

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
    monkeypatch.setattr("exactpt.pair.incidences.finite", lambda x: x + 1.0)

    assert differences(lines, list(record(FAMILIES, 6)))


def test_record_of_pairs_repeats_and_changes_with_an_answer(monkeypatch):
    lines = list(pair_record(["convex", "kissing_discs"], 2, 4))
    assert len(lines) == 6 + 4 + ARRAYS
    assert differences(lines, list(pair_record(["convex", "kissing_discs"], 2, 4))) == []

    monkeypatch.setattr("exactpt.pair.incidences.finite", lambda x: x + 1.0)

    changed = differences(lines, list(pair_record(["convex", "kissing_discs"], 2, 4)))
    assert {line.split()[1] for line in changed} >= {"kissing_discs", "arrays"}
