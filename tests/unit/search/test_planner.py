"""Plans among obstacles: the answers of `first_contact`, and what is done once."""

import json
from random import Random

import pytest

from exactpt import (
    Body,
    InputError,
    Pieces,
    Planner,
    Rigid,
    Scene,
    Spin,
    Translation,
    first_contact,
)
from exactpt.search import planner as planners
from exactpt.testing.scenes import FAMILIES, POINTS, generate

BOX = [(0, 0), (2, 0), (2, 1), (0, 1)]


def summary(contact):
    return None if contact is None else json.dumps(contact.to_json())


def without_planner(obstacles, body, time):
    names = [obstacle.name for obstacle in obstacles]
    groups = [names] if len(names) > 1 else []
    return first_contact(Scene([*obstacles, body], time), ignoring=groups)


@pytest.mark.long("hairs")
@pytest.mark.parametrize("family", sorted({**FAMILIES, **POINTS}))
def test_a_body_of_a_scene_among_the_others(family):
    """Under its own motion, another body's, and one that turns."""
    for seed in range(2):
        scene = generate(family, seed)
        others = list(scene.bodies)
        rng = Random(seed)
        body = others.pop(rng.randrange(len(others)))
        if not others:
            continue
        planner = Planner(others, (scene.start, scene.end))
        for motion in (body.motion, rng.choice(others).motion, Rigid([0, 1], x=[0, 3])):
            moving = body.with_motion(motion)
            expected = without_planner(others, moving, (scene.start, scene.end))
            pairs = () if expected is None else expected.pairs
            if all(body.name in (pair.body, pair.other) for pair in pairs):
                assert summary(planner.first_contact(body, motion)) == summary(expected)


def test_obstacles_may_overlap_and_close_on_themselves():
    """Only contacts of the shape count."""
    jaw = Body(
        "jaw",
        [(-1, 0), (4, 0), (4, 1), (0, 1), (0, 3), {"x": [4], "y": [3, -1]}, (4, 4), (-1, 4)],
    )
    inside = Body("inside", [(-1, 0), (1, 0), (0, 1)])
    assert first_contact(Scene([jaw], (0, 9))).kind == "self"
    planner = Planner([jaw, inside], (0, 9))
    contact = planner.first_contact([(9, 2)], Translation([0, -1]))
    assert (contact.time, contact.kind) == (5, "vertex-edge")
    assert planner.first_contact([(9, 9)], Translation([0, -1])) is None


def test_a_shape_that_closes_on_itself_has_a_contact_far_from_obstacles():
    jaw = [(-1, 0), (4, 0), (4, 1), (0, 1), (0, 3), {"x": [4], "y": [3, -1]}, (4, 4), (-1, 4)]
    contact = Planner([Body("far", [(99, 99)])], (0, 9)).first_contact(jaw, Translation())
    assert (contact.time, contact.kind) == (2, "self")


def test_a_contact_at_the_start_is_an_initial_one():
    planner = Planner([Body("wall", [(1, -1), (3, -1), (3, 5)])], (0, 1))
    contact = planner.first_contact(BOX, Translation([0, 1]))
    assert contact.kind == "initial"
    assert contact.initial_pairs == (("wall", "shape"),)


def test_without_obstacles_there_is_none():
    planner = Planner([], (0, 1))
    assert planner.first_contacts(BOX, [Translation([0, 1]), Rigid([0, 1])]) == [None, None]
    assert planner.first_contacts(BOX, []) == []


def test_obstacles_move_in_pieces():
    gate = Pieces([(2, Translation([0], [0, 1])), (None, Translation([0], [4, -1]))])
    wall = Body("gate", [(5, 0), (5, 3)], gate)
    planner = Planner([wall], (0, 9))
    slow, fast = planner.first_contacts([(0, 1)], [Translation([0, "5/3"]), Translation([0, 5])])
    assert slow.time == 3
    assert fast.time == 1


@pytest.mark.parametrize(
    "shape, motion, message",
    [
        ([(0, 0), (2, 2), (2, 0), (0, 2)], Translation(), "not a simple polygon"),
        (BOX, Pieces([(1, Translation([0, 1])), (None, Translation())]), "vertex 0 jumps"),
        (BOX, "up", "not a motion"),
        ([], Translation(), "at least one vertex"),
        (Body("wall", BOX), Translation(), "the name is taken by an obstacle"),
    ],
)
def test_refusals(shape, motion, message):
    planner = Planner([Body("wall", [(9, 0), (9, 1)])], (0, 10))
    with pytest.raises(InputError, match=message):
        planner.first_contact(shape, motion)


def test_obstacles_are_valid():
    with pytest.raises(InputError, match="taken by another body"):
        Planner([Body("a", BOX), Body("a", BOX)])
    with pytest.raises(InputError, match="is empty"):
        Planner([Body("a", BOX)], (1, 1))


def grid(count):
    return [
        Body(f"o{i}", [(x + 9 * (i % 6), y + 9 * (i // 6)) for x, y in BOX]) for i in range(count)
    ]


def test_obstacles_are_validated_and_prepared_once(monkeypatch):
    """For a hundred plans each obstacle is looked at once, and the shape, which only translates."""
    checked, read, boxed = [], [], []
    outline_at, rows_of, boxes = planners.Scene, planners.rows_of_scene, planners.boxes_during

    def validated(bodies, time):
        checked.extend(bodies := list(bodies))
        return outline_at(bodies, time)

    monkeypatch.setattr(planners, "Scene", validated)
    monkeypatch.setattr(planners, "rows_of_scene", lambda *given: read.append(1) or rows_of(*given))
    monkeypatch.setattr(planners, "boxes_during", lambda *given: boxed.append(1) or boxes(*given))
    planner = Planner(grid(30), (0, 10))

    straight = [Translation([0, "1/8"], [0, k]) for k in range(50)]
    curved = [Translation([0, "1/8"], [0, k, 1]) for k in range(5)]
    planner.first_contacts([(-9, -9), (-8, -9), (-8, -8)], [*straight, *curved])

    assert len(checked) == 30 + 1
    assert (read, boxed) == ([1], [1])


@pytest.fixture
def counts(monkeypatch):
    """The counts of each search of a planner."""
    searches = []

    class Counted(planners.SweepSearch):
        def run_to_contact(self):
            contact = super().run_to_contact()
            searches.append(self.stats)
            return contact

    monkeypatch.setattr(planners, "SweepSearch", Counted)
    return searches


def test_a_plan_looks_at_the_obstacles_near_it_alone(counts):
    """A shape passes along the lowest row of a grid of 30: at most six obstacles are compared."""
    planner = Planner(grid(30), (0, 10))
    shape = [(-9, "1/2"), (-8, "1/2"), (-8, 3)]

    assert planner.first_contact(shape, Translation([0, 8])).time == 1
    assert planner.first_contact(shape, Translation([0, 8, 1])) is not None
    assert [1 <= one["pairs"] <= 6 for one in counts] == [True, True]
    assert planner.first_contact(shape, Translation([0, -1], [0, 0, 1])) is None
    assert counts[2]["certificates"] == 0


def test_a_plan_leaves_the_rows_of_the_obstacles_as_they_were():
    """Obstacles that spin have their pieces at once; a shape that spins gets its own each time."""
    blade = Body("blade", [(0, 0), (3, 0), (3, 1)], Spin(1, (0, 0), error="1/50"))
    planner = Planner([blade], (0, 6))
    motion, other = (Spin(-1, (x, 0), error="1/50") for x in (6, 60))

    times = [planner.first_contact([(6, 0), (2, 0), (2, -1)], motion).time for _ in range(3)]
    far = planner.first_contact([(60, 0), (56, 0), (56, -1)], other)

    assert far is None
    assert times == [times[0]] * 3
