"""Scenes of two bodies by arrays: the bytes of the answers are those of one scene at a time."""

import json
from fractions import Fraction

import pytest
from folding import every
from scenes_of_two import (
    far_misses,
    generic_lines,
    nearly_degenerate,
    tiny_and_far,
    turning,
    turning_on_a_grid,
    turning_past,
)

from exactpt.arrays import screening
from exactpt.arrays import turning as turning_arrays
from exactpt.batch import Options, answers
from exactpt.batch.answering import answer, answers_of
from exactpt.batch.two_bodies import read_two_bodies
from exactpt.scene.format import loads
from exactpt.search.first import first_contact

PLAIN = Options()


def one_by_one(lines):
    return [answer(line.encode(), PLAIN) for line in lines]


def found_by_arrays(lines, monkeypatch):
    """The answers, None where arrays leave a scene open."""
    monkeypatch.setattr("exactpt.batch.answering.answer", lambda *_: None)
    return list(answers_of([line.encode() for line in lines], PLAIN))


WRITTEN = {
    "doubles": float,
    "thousandths": lambda x: round(x, 3),
    "binary": lambda x: round(x * 1024) / 1024,
    "ratios": lambda x: str(Fraction(x)),
    "texts": lambda x: f"{x:.6f}",
}


@pytest.mark.long("texts")
@pytest.mark.parametrize("kind", WRITTEN)
def test_generic_scenes_are_all_decided_by_filters(kind, monkeypatch):
    lines = generic_lines(300, seed=3, write=WRITTEN[kind])
    expected = one_by_one(lines)
    found = found_by_arrays(lines, monkeypatch)

    assert sum(data is None for data in found) <= 3
    assert [json.dumps(d) for d in found if d] == [
        json.dumps(e) for d, e in zip(found, expected, strict=True) if d
    ]
    assert 100 < sum(data["contact"] is None for data in expected) < 200


def test_generic_scenes_of_bodies_that_turn_are_all_decided_by_filters(monkeypatch):
    """A regression: each was computed by itself, in 2.6 ms."""
    lines = turning(40)
    expected = one_by_one(lines[:10])
    found = found_by_arrays(lines, monkeypatch)

    assert None not in found
    assert 10 < sum(data["contact"] is None for data in found) < 30
    assert list(map(json.dumps, found[:10])) == list(map(json.dumps, expected))


FAMILIES = {
    "nearly degenerate": lambda: nearly_degenerate(6),
    "far misses": lambda: far_misses(400),
    "tiny and far": lambda: tiny_and_far(600),
    "turning": lambda: turning(60),
    "turning on a grid": lambda: turning_on_a_grid(200),
    "turning past": lambda: turning_past(100),
}


@pytest.mark.long
@pytest.mark.parametrize("family", FAMILIES)
def test_no_answer_of_a_filter_differs_from_the_exact_one(family, monkeypatch):
    lines = FAMILIES[family]()
    expected = one_by_one(lines)
    found = found_by_arrays(lines, monkeypatch)

    decided = [k for k, data in enumerate(found) if data is not None]
    assert len(decided) >= 25
    assert [json.dumps(found[k]) for k in decided] == [json.dumps(expected[k]) for k in decided]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_no_answer_of_a_filter_differs_in_many_scenes(seed, monkeypatch):
    lines = nearly_degenerate(150, seed) + far_misses(8000, seed) + tiny_and_far(8000, seed)
    lines += turning(500, seed) + turning_on_a_grid(3000, seed) + turning_past(3000, seed)
    expected = one_by_one(lines)
    found = found_by_arrays(lines, monkeypatch)

    assert [(d, e) for d, e in zip(found, expected, strict=True) if d is not None and d != e] == []


@pytest.mark.long
@pytest.mark.parametrize("family", ["far misses", "tiny and far", "turning past"])
def test_without_the_bounds_on_rounding_there_are_wrong_answers(family, monkeypatch):
    monkeypatch.setattr(screening, "U", 0.0)
    monkeypatch.setattr(turning_arrays, "UNIT", 0.0)
    lines = FAMILIES[family]()
    expected = one_by_one(lines)
    found = found_by_arrays(lines, monkeypatch)

    assert any(d is not None and d != e for d, e in zip(found, expected, strict=True))


def test_the_end_of_the_span_is_exact():
    """The contact at t = 1/3 is in a span that ends there, but not in one that ends before."""
    bodies = (
        '[{"name": "a", "vertices": [[0, 0]], "motion": {"x": [0, 3]}},'
        ' {"name": "b", "vertices": [[1, -1], [1, 2]]}]'
    )
    ends = ['"1/3"', "0.333333333333333333", "0.333333333333333334"]
    lines = [f'{{"exactpt": 1, "time": [0, {end}], "bodies": {bodies}}}' for end in ends]

    found = [data["contact"] is not None for data in answers(lines)]

    assert found == [True, False, True]
    assert found == [first_contact(loads(line)) is not None for line in lines]


BODY = '{"name": "a", "vertices": [[0, 0], [1, 0], [0, 1]]}'
OTHER = '{"name": "b", "vertices": [[5, 0]], "motion": {"x": [0, -1]}}'


def scene(a=BODY, b=OTHER, time="[0, 9]", more=""):
    return f'{{"exactpt": 1, "time": {time}, "bodies": [{a}, {b}]{more}}}'


NOT_PLAIN = {
    "not JSON": "{",
    "no scene": "[]",
    "a nested list": "[" * 5000,
    "a missing key": '{"exactpt": 1, "time": [0, 1]}',
    "a key more": scene(more=', "id": 3'),
    "a key twice": scene(more=', "time": [0, 1]'),
    "another version": scene().replace('"exactpt": 1', '"exactpt": 2'),
    "true for one": scene().replace('"exactpt": 1', '"exactpt": true'),
    "three bodies": scene(a=f"{BODY}, {BODY}"),
    "one name": scene(b=BODY),
    "no name": scene(a='{"name": "", "vertices": [[0, 0]]}'),
    "a name that is a number": scene(a='{"name": 0.5, "vertices": [[0, 0]]}'),
    "no vertex": scene(a='{"name": "a", "vertices": []}'),
    "a vertex of three": scene(a='{"name": "a", "vertices": [[0, 0, 0]]}'),
    "a vertex in a text": scene(a='{"name": "a", "vertices": ["12", "34"]}'),
    "a vertex that moves": scene(a='{"name": "a", "vertices": [{"x": [0, 1], "y": [1]}]}'),
    "the last vertex repeats": scene(
        a='{"name": "a", "vertices": [[0, 0], [1, 0], [0, 1], [0, 0]]}'
    ),
    "no area": scene(a='{"name": "a", "vertices": [[0, 0], [1, 0], [2, 0]]}'),
    "not simple": scene(a='{"name": "a", "vertices": [[0, 0], [1, 1], [1, 0], [0, 1]]}'),
    "NaN": scene(a='{"name": "a", "vertices": [[NaN, 0]]}'),
    "infinite": scene(a='{"name": "a", "vertices": [[1e999, 0]]}'),
    "tiny": scene(a='{"name": "a", "vertices": [[1e-300, 0]]}'),
    "a zero with a large exponent": scene(a='{"name": "a", "vertices": [[0e-200000, 0]]}'),
    "an underscore": scene(a='{"name": "a", "vertices": [["1_0", 0]]}'),
    "a zero denominator": scene(a='{"name": "a", "vertices": [["1/0", 0]]}'),
    "a boolean": scene(a='{"name": "a", "vertices": [[true, 0]]}'),
    "closed is a number": scene(a='{"name": "a", "vertices": [[0, 0]], "closed": 1}'),
    "a radius": scene(a='{"name": "a", "vertices": [[0, 0]], "radius": 1}'),
    "motion is null": scene(a='{"name": "a", "vertices": [[0, 0]], "motion": null}'),
    **{
        f"it turns by {rigid}": scene(
            a=f'{{"name": "a", "vertices": [[0, 0]], "motion": {{"rigid": {rigid}}}}}'
        )
        for rigid in (
            "[]",
            "{}",
            '{"half_turn": 1}',
            '{"half_turn": [0, 0, 1]}',
            '{"half_turn": [0, "x"]}',
            '{"half_turn": [0, 1], "pivot": [0]}',
            '{"half_turn": [0, 1], "pivot": {"x": 0, "y": 0}}',
            '{"half_turn": [0, 1], "orientation": [1, 1]}',
            '{"half_turn": [0, 1], "orientation": [0.6, 0.8000000000000000000001]}',
            '{"half_turn": [0, 1], "angle": 1}',
        )
    },
    "it turns, and more": scene(
        a='{"name": "a", "vertices": [[0, 0]], "motion": {"rigid": {"half_turn": []}, "x": [1]}}'
    ),
    "an empty span": scene(time="[1, 1]"),
    "a span of one": scene(time="[1]"),
    "a start that is no double": scene(time="[0.1, 9]"),
    "cubic": scene(a='{"name": "a", "vertices": [[0, 0]], "motion": {"x": [0, 0, 0, 1]}}'),
}


@every("what", NOT_PLAIN)
def test_what_is_not_plain_is_answered_as_if_alone(what):
    line = NOT_PLAIN[what]
    (found,) = answers([line])

    assert found == answer(line.encode(), PLAIN)
    if what not in {"no area", "not simple"}:
        assert read_two_bodies(line.encode()) is None


@pytest.mark.parametrize("a", ["-0.0", "0", "-0", '"0/7"', "0.000", '"-0"'])
def test_zeros_are_plain(a):
    line = scene(a=f'{{"name": "a", "vertices": [[{a}, 0]]}}')

    assert read_two_bodies(line.encode()) is not None
    assert next(answers([line])) == answer(line.encode(), PLAIN)


CHAINS = '{"name": "a", "vertices": [[0, 0], [1, 0], [2, 1]], "closed": false}'
INSIDE = '{"name": "b", "vertices": [[0.125, 0.25]]}'
THROWN = '{"name": "b", "vertices": [[0.3, 5]], "motion": {"y": [0, 1, -1]}}'
TURNED = (
    '{"name": "b", "vertices": [[-5, 3]], "motion": {"rigid": {"half_turn": [-0.2, 0.1], '
    '"orientation": [0, -1], "pivot": [0.5, 0.5], "x": [0.1], "y": [0, 0.01, 0.001]}}}'
)
SEEN = [
    scene(a=CHAINS), scene(b=INSIDE), scene(b=THROWN), scene(time="[-0.5, 9]"),
    scene(b=TURNED), scene(b=TURNED, time="[-1.5, 99]"), scene(b=TURNED, time="[0, 1e200]"),
    scene(b=TURNED.replace("-0.2", "1e160")), scene(b=TURNED.replace("-5", "1e260")),
    scene(b=TURNED.replace("-5", "1e-260")), scene(b=TURNED.replace("0.1]", "1e200]")),
]  # fmt: skip


@pytest.mark.parametrize("line", SEEN)
def test_chains_overlaps_throws_and_other_starts(line):
    (found,) = answers([line])

    contact = first_contact(loads(line))
    assert found == {"contact": contact and contact.to_json()}
