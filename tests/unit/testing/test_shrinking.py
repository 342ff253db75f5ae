"""Shrinking: what is left is as small as it can be, and still fails."""

import json

import pytest

from exactpt import Body, Scene
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing import make_question
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.testing.shrinking import shrink, shrink_data, shrink_question


def shrunk(data, fails):
    def judged(candidate):
        try:
            loads(json.dumps(candidate))
        except ValueError:
            return False
        return fails(candidate)

    return shrink_data(data, judged, seconds=30.0)


def test_one_guilty_body_is_left_alone_and_at_rest():
    data = to_json(generate("convex", 1))
    guilty = data["bodies"][3]["name"]

    smallest = shrunk(data, lambda d: any(b["name"] == guilty for b in d["bodies"]))

    assert smallest["bodies"] == [{"name": guilty, "vertices": [["0", "0"]]}]


def test_numbers_get_simple():
    data = to_json(generate("mixed_shapes", 0))

    def fails(d):
        return any(c not in ("0", "1", "-1") for b in d["bodies"] for v in b["vertices"] for c in v)

    (body,) = shrunk(data, fails)["bodies"]
    assert sorted(body["vertices"][0]) in (["0", "1/2"], ["-1/2", "0"])


def test_a_needed_velocity_stays():
    data = to_json(generate("convex", 1))

    def fails(d):
        return any(b.get("motion", {}).get("x", ["0"])[-1] != "0" for b in d["bodies"])

    (body,) = shrunk(data, fails)["bodies"]
    assert body["motion"]["x"] in (["0", "1"], ["0", "-1"])
    assert len(body["vertices"]) == 1


@pytest.mark.long
def test_what_is_left_is_a_scene_of_every_kind():
    for family in FAMILIES:
        data = to_json(generate(family, 0))
        smallest = shrunk(data, lambda d: bool(d["bodies"]))

        assert len(smallest["bodies"]) == 1
        assert "motion" not in smallest["bodies"][0]
        assert "keyframes" not in smallest["bodies"][0]


def test_what_never_fails_again_is_left_as_it_is():
    data = to_json(generate("row", 0))

    assert shrunk(data, lambda _: False) == data


def test_time_runs_out():
    data = to_json(generate("convex", 1))

    assert shrink_data(data, lambda _: True, seconds=0.0) == data


def test_a_scene_is_shrunken_to_a_scene():
    smallest = shrink(generate("convex", 1), lambda scene: len(scene.bodies) > 1)

    assert [body.size for body in smallest.bodies] == [1, 1]


def test_a_scene_that_does_not_fail_is_refused():
    with pytest.raises(ValueError, match="the scene itself does not fail"):
        shrink(generate("row", 0), lambda _: False)


def test_bug_the_only_hole_of_a_body_or_part_was_kept():
    square, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (6, 3), (6, 6)]
    beside = [(x + 20, y) for x, y in square]
    with_a_hole = Body("a", square, holes=[hole])
    with_parts = Body("a", parts=[{"vertices": square, "holes": [hole]}, beside])

    (smallest,) = to_json(shrink(Scene([with_a_hole]), lambda _: True))["bodies"]
    assert "holes" not in smallest
    smallest = to_json(
        shrink(Scene([with_parts]), lambda scene: "parts" in to_json(scene)["bodies"][0])
    )
    assert all("holes" not in part for part in smallest["bodies"][0]["parts"])


def test_bug_a_slow_question_was_shrunken_without_a_limit(monkeypatch):
    """By a clock that goes on by one second in each call of what fails."""
    question, seconds = make_question("convex_pairs"), 0

    def fails(*_):
        nonlocal seconds
        seconds += 1
        return False

    monkeypatch.setattr("exactpt.testing.shrinking.clock.monotonic", lambda: 30 * seconds)
    shrink_question(question, fails)

    assert seconds == 3
