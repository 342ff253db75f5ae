"""When two bodies come within a distance: by hand, and against bodies grown by the square."""

from random import Random

import pytest

import exactpt
from exactpt import Body, InputError, Pieces, Rigid, Scene, Translation, first_within
from exactpt.kernel.numbers import QQ
from exactpt.scene.families.shapes import convex_polygon, hull
from fuzz.questions.all_pairs import first_contact_allpairs

TIP = [(0, 0), (-3, 1), (-3, -1)]
"""A wedge that points to the right."""
WALL = Body("wall", [(10, -9), (10, 9)])


def within(a, b, distance, norm="max", time=(0, 20)):
    return first_within(Scene([a, b], time), a.name, b.name, distance, norm=norm)


@pytest.mark.parametrize("distance, time", [(0, 10), (3, 7), ("1/3", "29/3"), (10, 0), (12, 0)])
def test_a_tip_that_comes_to_a_wall(distance, time):
    assert within(Body("tip", TIP, Translation([0, 1])), WALL, distance) == QQ(time)


def test_tips_that_face_each_other():
    """Two vertices, straight across: no edge is near any corner of the square."""
    other = Body("other", [(10, 1), (13, 0), (13, 2)])
    tip = Body("tip", TIP, Translation([0, 1]))

    assert within(tip, other, 2) == 8
    assert within(tip, other, 2, norm="y") == 0
    assert within(tip, other, 2, norm="x") == 8


def test_a_point_that_passes_a_corner():
    """It enters the square around the corner by its lower side, at an irrational time."""
    point = Body("point", [(10, -20)], Translation([0], [0, 0, 1]))
    box = Body("box", [(0, 0), (9, 0), (9, 5), (0, 5)])

    time = within(point, box, "3/2")

    assert time.polynomial == (-37, 0, 2)
    assert within(point, box, "1/2") is None
    assert within(point, box, 1).compare(time) > 0


def test_along_an_axis_it_is_the_shadows():
    below = Body("below", [(0, 0), (2, 0), (2, 1)], Translation([0, 1], [0, -1]))
    above = Body("above", [(6, 9), (8, 9), (7, 12)])

    assert within(below, above, 1, norm="x") == 3
    assert within(below, above, 7, norm="y") is None
    assert within(below, above, 8, norm="y") == 0


def test_a_body_inside_of_another_is_near():
    ring = Body("ring", [(0, 0), (20, 0), (20, 20), (0, 20)])

    assert within(ring, Body("dot", [(10, 10)]), 1) == 0


def test_a_distance_that_is_kept_and_then_lost():
    """In pieces: along the wall at distance 2, then nearer."""
    motion = Pieces([(4, Translation([0], [0, 1])), (None, Translation([-4, 1], [0, 1]))])
    tip = Body("tip", [(8, 0), (7, 1)], motion)

    assert within(tip, WALL, 2) == 0
    assert within(tip, WALL, "3/2") == QQ(9, 2)


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_it_is_the_contact_with_the_grown_body(seed, turning):
    """Of convex bodies that translate: B with the square is convex, and moves as B does.

    A may turn; it is not grown.
    """
    rng = Random(seed)
    a = convex_polygon(rng, (QQ(0), QQ(0)), 8, rng.randint(3, 6))
    b = convex_polygon(rng, (QQ(40), QQ(rng.randint(-30, 30))), 8, rng.randint(3, 6))
    d = QQ(rng.randint(1, 20), rng.randint(1, 4))
    moving = Translation([0, -rng.randint(1, 5)], [0, rng.randint(-2, 2), QQ(-1, 3)])
    spin = Rigid([0, QQ(rng.randint(1, 4), 5)]) if turning else Translation()
    grown = hull([(x + s * d, y + r * d) for x, y in b for s in (1, -1) for r in (1, -1)])

    time = within(Body("a", a, spin), Body("b", b, moving), d)

    contact = first_contact_allpairs(
        Scene([Body("a", a, spin), Body("grown", grown, moving)], (0, 20))
    )
    assert (time is None) == (contact is None)
    assert contact is None or time.compare(contact.time) == 0


def test_distance_zero_is_a_contact():
    box = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1], [0, 0, "-1/10"]))
    mill = Body("mill", [(9, -6), (10, -6), (10, 2), (9, 2)], Rigid([0, "1/2"], pivot=("19/2", -2)))
    scene = Scene([box, mill], (0, 10))

    for norm in ("euclidean", "max"):
        time = exactpt.first_within(scene, "mill", "box", 0, norm=norm)
        assert time == exactpt.first_contact(scene).time


def test_without_a_norm_it_is_the_maximum():
    scene = Scene([WALL, Body("tip", TIP, Translation([0, 1]))], (0, 20))

    with pytest.warns(DeprecationWarning, match="name the norm"):
        assert first_within(scene, "wall", "tip", 3) == 7


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        (("wall", "tip", -1), {}, "a distance is not negative: -1"),
        (("wall", "nobody", 1), {}, "there is no body 'nobody'"),
        (("wall", "wall", 1), {}, "expected two different bodies"),
        (("wall", "tip", 1), {"norm": "l1"}, "no norm 'l1'; there are: euclidean, max, x, y"),
        (("wall", "tip"), {}, "either a distance or its square"),
        (("wall", "tip", 1), {"distance_squared": 1}, "either a distance or its square"),
        (("wall", "tip"), {"distance_squared": 1, "norm": "x"}, "is for the Euclidean norm"),
    ],
)
def test_refusals(arguments, options, message):
    scene = Scene([WALL, Body("tip", TIP)])

    with pytest.raises(InputError, match=message):
        first_within(scene, *arguments, **{"norm": "euclidean"} | options)


@pytest.mark.parametrize("digits", [300, 400, 2000])
def test_bug_axes_of_which_one_is_out_of_the_range_of_doubles_beside_the_other(digits):
    floor = Body("floor", [(-(10**digits), 0), (10**digits, 0)])
    wide = [floor, Body("point", [(0, 5)], Translation([0], [0, -1]))]
    round_one = [floor, Body("disc", [(0, 5)], Translation([0], [0, -1]), radius=1)]

    assert exactpt.first_contact(Scene(round_one, (0, 9))).time == 4
    assert exactpt.first_within(Scene(wide, (0, 9)), distance="1/2", norm="euclidean").time == QQ(
        9, 2
    )
