"""The intervals in which bodies meet: by hand, and against the definition."""

from random import Random

import pytest

from exactpt import Body, InputError, Pieces, Rigid, Scene, Translation, contact_intervals, contacts
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes import FAMILIES, generate
from fuzz.questions.scenes import meeting_scene
from fuzz.questions.tiny import pair_scene

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
WALL = Body("wall", [(10, -9), (10, 9)])


def times(intervals):
    return [(float(i.start), float(i.end)) for i in intervals]


def of(first, second, time=(0, 20)):
    return times(contact_intervals(Scene([first, second], time), first.name, second.name))


def test_a_square_that_passes_through_a_wall():
    assert of(Body("square", SQUARE, Translation([0, 1])), WALL) == [(8, 10)]


def test_it_comes_back():
    there = Translation([0, 1])
    back = Translation([20, -1])
    square = Body("square", SQUARE, Pieces([(10, there), (None, back)]))

    assert of(square, WALL) == [(8, 12)]


def test_a_touch_is_an_interval_of_length_zero():
    """A parabola that touches the wall, and is gone."""
    point = Body("point", [(0, 0)], Translation([9, 2, -1]))

    assert of(point, WALL) == [(1, 1)]


def test_bodies_that_meet_from_the_start_to_the_end():
    inner = Body("inner", [(0, 0), (1, 0), (0, 1)], Rigid([0, 1], pivot=("1/3", "1/3")))
    outer = Body("outer", [(-9, -9), (9, -9), (9, 9), (-9, 9)])

    assert of(inner, outer) == [(0, 20)]
    assert of(inner, Body("far", [(50, 0), (51, 0), (50, 1)])) == []


def test_a_body_that_is_swallowed_and_leaves():
    """In between only its interior is in the other one: no edges cross."""
    dot = Body("dot", [(-1, 4)], Translation([0, 1]))
    box = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])

    assert of(dot, box) == [(1, 6)]
    assert of(box, dot) == [(1, 6)]


def test_a_segment_that_slides_along_its_line():
    """All orientations vanish for all times."""
    first = Body("first", [(0, 0), (2, 0)], Translation([0, 1]))
    second = Body("second", [(5, 0), (6, 0)])

    assert of(first, second) == [(3, 6)]


def test_a_segment_that_slides_and_then_lifts():
    """Nothing vanishes at the time of the change that did not vanish before."""
    lift = Pieces([(4, Translation([0, 1])), (None, Translation([0, 1], [-4, 1]))])
    first = Body("first", [(0, 0), (2, 0)], lift)
    second = Body("second", [(-9, 0), (9, 0)])

    assert of(first, second) == [(0, 4)]


def test_points_that_meet_twice():
    first = Body("first", [(0, 0)], Translation([0, 3, -1]))
    second = Body("second", [(2, 0)])

    assert of(first, second) == [(1, 1), (2, 2)]


def test_the_end_belongs_to_the_time_span():
    square = Body("square", SQUARE, Translation([0, 1]))

    assert of(square, WALL, time=(0, 8)) == [(8, 8)]
    assert of(square, WALL, time=(8, 9)) == [(8, 9)]
    assert of(square, WALL, time=(10, 11)) == [(10, 10)]
    assert of(square, WALL, time=("21/2", 11)) == []


def test_names():
    scene = Scene([Body("square", SQUARE), WALL], time=(0, 1))
    with pytest.raises(InputError, match="got 'wall' twice"):
        contact_intervals(scene, "wall", "wall")
    with pytest.raises(InputError, match="nobody"):
        contact_intervals(scene, "wall", "nobody")


def test_all_pairs_in_order():
    scene = Scene(
        [
            Body("slow", SQUARE, Translation([0, 1], [5])),
            Body("fast", SQUARE, Translation([0, 2])),
            WALL,
            Body("idle", [(0, 50), (1, 50), (0, 51)]),
        ],
        time=(0, 20),
    )

    found = [(i.a, i.b, float(i.start), float(i.end)) for i in contacts(scene)]

    assert found == [("fast", "wall", 4, 5), ("slow", "wall", 8, 10)]


def compare(scene, a, b):
    found = contact_intervals(scene, a.name, b.name)
    assert disagreement(reference.contact_intervals(a, b, scene.time), found) is None
    return len(found)


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [150, pytest.param(4_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_tiny_scenes_against_the_definition(count):
    random = Random(count)
    found = 0
    for _ in range(count):
        scene = pair_scene(random)
        found += compare(scene, *scene.bodies)

    assert found > count / 4


@pytest.mark.long("bodies_on_grid")
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_pairs_of_the_families(family):
    """Of each family the three smallest pairs of bodies: the definition takes long."""
    scene = generate(family, 3)
    small = sorted((b for b in scene.bodies if b.size <= 6), key=lambda b: b.size)[:3]
    for i, a in enumerate(small):
        for b in small[:i]:
            compare(scene, a, b)


@pytest.mark.parametrize("family", ["convex", "pieces", "turning", "deforming", "ballistic"])
def test_pairs_that_are_passed_over_never_meet(family):
    scene = generate(family, 1)

    found = contacts(scene)

    every = [
        (a.name, b.name, i.start, i.end)
        for k, a in enumerate(scene.bodies)
        for b in scene.bodies[k + 1 :]
        for i in contact_intervals(scene, a.name, b.name)
    ]
    assert sorted((i.a, i.b, float(i.start), float(i.end)) for i in found) == sorted(
        (a, b, float(s), float(e)) for a, b, s, e in every
    )


def test_bug_the_order_of_the_names_changed_names_and_polynomials():
    """The times are roots of x^2 - 2, found for a vertex of each body."""
    fall = Translation([0], [0, 0, -1])
    scene = Scene(
        [Body("a", [(0, 2), (1, 2), (0, 3)], fall), Body("b", [(-5, 0), (5, 0), (0, -1)])]
    )
    wide = Scene(scene.bodies, time=(0, 2))
    forth, back = (contact_intervals(wide, *names) for names in (("a", "b"), ("b", "a")))

    assert [i.to_json() for i in back] == [i.to_json() for i in forth]
    assert [i.to_json() for i in contacts(wide)] == [i.to_json() for i in forth]
    assert forth == back
    assert (back[0].a, back[0].b) == ("a", "b")
    random, irrational = Random("named"), 0
    for _ in range(60):
        drawn = meeting_scene(random)
        a, b = (body.name for body in drawn.bodies)
        first, second = (contact_intervals(drawn, *names) for names in ((a, b), (b, a)))
        assert [i.to_json() for i in first] == [i.to_json() for i in second]
        irrational += any(not i.start.is_rational for i in first)
    assert irrational > 3
