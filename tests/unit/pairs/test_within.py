"""When two bodies come within a distance, by hand."""

import pytest

import exactpt
from exactpt import Body, InputError, Pieces, Rigid, Scene, Translation, first_within
from exactpt.kernel.numbers import QQ

TIP = [(0, 0), (-3, 1), (-3, -1)]
"""A wedge that points to the right."""
WALL = Body("wall", [(10, -9), (10, 9)])


def within(a, b, distance, time=(0, 20)):
    return first_within(Scene([a, b], time), a.name, b.name, distance)


@pytest.mark.parametrize("distance, time", [(0, 10), (3, 7), ("1/3", "29/3"), (10, 0), (12, 0)])
def test_a_tip_that_comes_to_a_wall(distance, time):
    assert within(Body("tip", TIP, Translation([0, 1])), WALL, distance) == QQ(time)


def test_tips_that_face_each_other():
    """Two vertices, straight across."""
    other = Body("other", [(10, 0), (13, -1), (13, 1)])
    tip = Body("tip", TIP, Translation([0, 1]))

    assert within(tip, other, 2) == 8


def test_a_point_that_passes_a_corner():
    """It passes the corner (9, 0) at a distance of 1 in x, at the height t^2 - 20.

    It is within 3/2 of the corner when (t^2 - 20)^2 = 9/4 - 1.
    """
    point = Body("point", [(10, -20)], Translation([0], [0, 0, 1]))
    box = Body("box", [(0, 0), (9, 0), (9, 5), (0, 5)])

    time = within(point, box, "3/2")

    assert time.polynomial == (1595, 0, -160, 0, 4)
    assert within(point, box, "1/2") is None
    assert within(point, box, 1).compare(time) > 0


def test_a_body_inside_of_another_is_near():
    ring = Body("ring", [(0, 0), (20, 0), (20, 20), (0, 20)])

    assert within(ring, Body("dot", [(10, 10)]), 1) == 0


def test_a_distance_that_is_kept_and_then_lost():
    """In pieces: along the wall at distance 2, then nearer."""
    motion = Pieces([(4, Translation([0], [0, 1])), (None, Translation([-4, 1], [0, 1]))])
    tip = Body("tip", [(8, 0), (7, 1)], motion)

    assert within(tip, WALL, 2) == 0
    assert within(tip, WALL, "3/2") == QQ(9, 2)


def test_distance_zero_is_a_contact():
    box = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1], [0, 0, "-1/10"]))
    mill = Body("mill", [(9, -6), (10, -6), (10, 2), (9, 2)], Rigid([0, "1/2"], pivot=("19/2", -2)))
    scene = Scene([box, mill], (0, 10))

    assert first_within(scene, "mill", "box", 0) == exactpt.first_contact(scene).time


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        (("wall", "tip", -1), {}, "a distance is not negative: -1"),
        (("wall", "nobody", 1), {}, "there is no body 'nobody'"),
        (("wall", "wall", 1), {}, "expected two different bodies"),
        (("wall", "tip"), {}, "either a distance or its square"),
        (("wall", "tip", 1), {"distance_squared": 1}, "either a distance or its square"),
    ],
)
def test_refusals(arguments, options, message):
    scene = Scene([WALL, Body("tip", TIP)])

    with pytest.raises(InputError, match=message):
        first_within(scene, *arguments, **options)


@pytest.mark.parametrize("digits", [300, 400, 2000])
def test_bug_axes_of_which_one_is_out_of_the_range_of_doubles_beside_the_other(digits):
    floor = Body("floor", [(-(10**digits), 0), (10**digits, 0)])
    wide = [floor, Body("point", [(0, 5)], Translation([0], [0, -1]))]
    round_one = [floor, Body("disc", [(0, 5)], Translation([0], [0, -1]), radius=1)]

    assert exactpt.first_contact(Scene(round_one, (0, 9))).time == 4
    assert exactpt.first_within(Scene(wide, (0, 9)), distance="1/2").time == QQ(9, 2)
