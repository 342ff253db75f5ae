"""Contacts at the start of bodies whose places are known within a stated error.

A contact is certain if the bodies touch after every rigid move by the errors. Each case says by how
much the bodies overlap in the direction in which they part first: that is the largest error for
which a contact is certain.
"""

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from exactpt import Body, Polynomial, PosePath, Scene, Spin, Translation, first_contact_enclosed
from exactpt.geometry.polygon import is_convex
from exactpt.kernel.numbers import QQ
from exactpt.pair.sure import surely_meet

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
DIAMOND = [(0, "-7/5"), ("7/5", 0), (0, "7/5"), ("-7/5", 0)]
ANGLE = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
PLATE = {
    "parts": [{"vertices": [(0, 0), (10, 0), (10, 10), (0, 10)],
               "holes": [[(6, 4), (4, 4), (4, 6), (6, 6)]]}],
}  # fmt: skip


def box(left, right, bottom=-1, top=1):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def at_rest(name, shape, **options):
    if isinstance(shape, dict):
        return Body(name, **shape, **options)
    return Body(name, shape, **options)


CASES = {
    "a point in a square": (at_rest("a", [(0, 0)]), SQUARE, 1),
    "a point at a corner": (at_rest("a", [(1, 1)]), SQUARE, 0),
    "boxes side by side": (at_rest("a", box(0, 4)), box(3, 9), 1),
    "equal boxes": (at_rest("a", SQUARE), SQUARE, 2),
    "a box in a box, flush": (at_rest("a", box(0, 1)), box(0, 5), 1),
    "squares that make a star": (at_rest("a", SQUARE), DIAMOND, Fraction(12, 5)),
    "a cross of bars": (at_rest("a", box(-5, 5)), box(-1, 1, -5, 5), 6),
    "a segment through a box": (at_rest("a", [(-2, 0), (2, 0)]), SQUARE, 1),
    "a segment across a box, flush": (at_rest("a", [(-1, 0), (1, 0)]), SQUARE, 1),
    "crossing segments": (at_rest("a", [(-2, 0), (2, 0)]), [(0, -1), (0, 3)], 1),
    "segments on a line": (at_rest("a", [(0, 0), (4, 0)]), [(1, 0), (9, 0)], 0),
    "equal points": (at_rest("a", [(0, 0)]), [(0, 0)], 0),
    "a disc and a point": (at_rest("a", [(0, 0)], radius=2), [(1, 0)], 1),
    "a disc beside a box": (at_rest("a", [(0, 0)], radius=2), box(1, 9), 1),
    "a disc in a box": (at_rest("a", [(3, 0)], radius=2), box(0, 10, -4, 4), 5),
    "a box at an angle, flush": (at_rest("a", ANGLE), box(3, 9, 0, 1), 1),
    "angles": (at_rest("a", ANGLE), [(-x, -y) for x, y in ANGLE], 0),
    "a box in a plate": (at_rest("a", PLATE), box(1, 3, 4, 6), 3),
    "a box in a hole": (at_rest("a", PLATE), box("9/2", "11/2", "9/2", "11/2"), None),
}
"""A body, the shape of another one, and the largest error for which their contact is certain."""


def start_of(*bodies, time=(0, 2), **options):
    scene = Scene(bodies, time=time)
    found = first_contact_enclosed(scene, **options)
    assert first_contact_enclosed(Scene.from_json(scene.to_json()), **options) == found
    return found


def is_certain_at_start(found, start=0):
    assert found is None or found.high is None or found.low <= found.high
    return found is not None and found.high == start


def still(error, place=(0, 0), time=(0, 2)):
    return PosePath(time, [(*place, 0)]).with_place_error(error)


CONVEX = [case for case in CASES if not case.startswith(("a box in a", "angles", "a box at"))]
"""Cases in which the condition is necessary, too."""


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("part", ["1/2", "999999/1000000", 1, "1000001/1000000"])
def test_an_overlap_is_certain_if_it_is_at_least_the_error(case, part):
    body, shape, depth = CASES[case]
    error = Fraction(part) * Fraction(depth or 1)
    bodies = body, at_rest("b", shape, motion=still(error))
    found = first_contact_enclosed(Scene(bodies, time=(0, 2)))

    is_certain = is_certain_at_start(found)
    if case in CONVEX:
        assert is_certain == (error <= depth)
    elif is_certain:
        assert error <= depth
    else:
        assert not depth or error > Fraction(9, 10) * depth


@pytest.mark.parametrize("case", [case for case in CONVEX if CASES[case][2]])
@pytest.mark.parametrize("more", [Fraction(0), Fraction(1, 10**6)])
def test_errors_of_both_bodies_add_up(case, more):
    body, shape, depth = CASES[case]
    part = Fraction(1, 3)
    first = body.with_motion(still(depth * part + more))
    second = at_rest("b", shape, motion=still(depth * (1 - part)))

    found = first_contact_enclosed(Scene([first, second], time=(0, 2)))
    assert is_certain_at_start(found) == (more == 0)


def test_bug_a_stated_error_was_forgotten_at_the_start():
    wall = Body("wall", [(1, -5), (1, 5)])
    path = PosePath([0, 2], [([1], [0], 0)])
    for motion in (
        path.with_place_error("1/10"),
        PosePath([0, 2], [(1, 0, 0)], place_error="1/10"),
    ):
        found = start_of(Body("b", [(0, 0)], motion), wall)
        assert (found.low, found.high) == (0, None)
        assert found.pairs == (("b", "wall"),)
    assert is_certain_at_start(start_of(Body("b", [(0, 0)], path), wall))


@pytest.mark.parametrize("less, certain", [(0, True), ("1/1000000", False)])
def test_place_error_of_the_constructor_states_what_the_fit_leaves(less, certain):
    """A point at (1/3, 0) is inside a box, by the stated error or a little less.

    The piece is at 341/1024 + t/1024 - t^2/2048, which is off by -1/3072 + t/1024 - t^2/2048. In
    [0, 2] the Bernstein coefficients of that are -1/3072, 2/3072 and -1/3072. So 1/1536 is proved
    to be enough for the fit, and 1 - 1/1536 of the place error is left.
    """
    path = PosePath([0, 2], [("1/3", 0, 0)], error="1/100", place_error=1)
    stated = 1 - Fraction(1, 1536)
    left = Fraction(1, 3) - stated + Fraction(less)

    found = start_of(Body("point", [(0, 0)], path), Body("box", box(left, 9, -5, 5)))

    assert path.pieces[1][1].x == Polynomial(["341/1024", "1/1024", "-1/2048"])
    assert path.assumed_place_error == stated
    assert is_certain_at_start(found) == certain


def test_only_the_error_of_fitting_vanishes_where_the_fit_is_exact():
    """At the angle 0 a blade that turns is where its formula puts it, and touches the hub there."""
    hub = Body("hub", [(1, 0), (1, -1), (2, -1)])
    blade = [(0, 0), (3, 0)]
    turn = PosePath([0, 2], [(0, 0, [0, 1])], error="1/100")

    for motion in (turn, Spin(1, error="1/100")):
        assert is_certain_at_start(start_of(hub, Body("blade", blade, motion)))
    stated = turn.with_place_error("1e-9")
    assert not is_certain_at_start(start_of(hub, Body("blade", blade, stated)))


def test_a_start_later_than_the_path_counts_the_error_too():
    wall = Body("wall", [(1, -5), (1, 5)])
    path = PosePath([0, 1, 2], [([0, 1], 0, [-1, 1]), (1, 0, [0, 1])])
    assert is_certain_at_start(start_of(Body("b", [(0, 0)], path), wall, time=(1, 2)), 1)
    stated = path.with_place_error("1/10")
    found = start_of(Body("b", [(0, 0)], stated), wall, time=(1, 2))
    assert found.low == 1
    assert found.high is None


def test_an_angle_that_was_closed_up_counts_at_a_later_start():
    """From 1 the angle is 0 as closed up, and 10^-16 as given: the tip is off the wall there."""
    c = np.array([[[0, 0, -1.0], [0, 0, 0]], [[0, 0, 1.0], [0, 0, 1e-16]]])
    path = PosePath.of_curve(SimpleNamespace(c=c, x=[0, 1, 2]))
    wall = Body("wall", [(1, 0), (1, -1)])
    assert path.pose(1) == (0, 0, 0)

    arm = Body("arm", [(0, 0), (1, 0)], path)
    found = start_of(arm, wall, time=(1, 2))

    assert path.assumed_angle_error == Fraction(1e-16)
    assert not is_certain_at_start(found, 1)


def test_a_point_that_passes_on_is_certain_later():
    """A point within 1/10 of the wall comes through at a speed of 1: at t = 1/10 it has passed."""
    wall = Body("wall", [(1, -5), (1, 5), (9, 5), (9, -5)])
    path = PosePath([0, 2], [([1, 1], [0], 0)]).with_place_error("1/10")
    found = start_of(Body("b", [(0, 0)], path), wall)

    assert found.low == 0
    assert Fraction(1, 10) <= found.high < Fraction(12, 100)


def test_pairs_at_the_start_are_those_that_may_touch():
    """The exact box touches the wall; the far one is a little more than its error away."""
    wall = Body("wall", [(1, -5), (1, 5)])
    touching = Body("touching", [(0, 2), (1, 2)])
    near = Body("near", [(0, 0)], still("1/10", (Fraction(91, 100), 0)))
    far = Body("far", [(0, -2)], still("1/10", (Fraction(89, 100), 0)))

    found = start_of(wall, touching, near, far)
    assert is_certain_at_start(found)
    assert found.pairs == (("wall", "near"), ("wall", "touching"))
    some = start_of(wall, touching, near, far, between=[("wall", "near"), ("wall", "far")])
    assert (some.low, some.high, some.pairs) == (0, None, (("wall", "near"),))
    assert start_of(wall, touching, far, ignoring=[["wall", "touching"]]) is None


def test_flush_boxes_that_come_together_touch_for_sure():
    """Corners come to corners, so no vertex is ever inside the other box."""
    path = PosePath([0, 2], [([0, 1], 0, 0)], error="1e-9").with_place_error("1/100")
    found = start_of(Body("a", box(0, 1), path), Body("b", box(2, 3)))

    assert Fraction(99, 100) - Fraction(1, 10**6) < found.low < Fraction(99, 100)
    assert Fraction(101, 100) < found.high < Fraction(102, 100)


@pytest.mark.parametrize(
    "points, expected",
    [
        (SQUARE, True),
        (SQUARE[::-1], True),
        ([(0, 0), (1, 0), (2, 0), (2, 1)], True),
        (ANGLE, False),
        ([(0, 0), (4, 3), (0, 3), (4, 0), (2, 5)], False),  # a star, which turns twice
        ([(0, 0), (2, 0), (1, 0), (1, 1)], False),  # a spike
        ([(0, 0), (1, 0), (2, 0)], False),
        ([(0, 0), (1, 0), (1, 1), (0, 1)] * 2, False),
        ([(0, 0), (0, -3), (4, 0), (0, 3)], True),
    ],
)
def test_a_ring_is_convex_if_it_turns_once_to_one_side(points, expected):
    assert is_convex([(QQ(x), QQ(y)) for x, y in points]) == expected


def test_a_deep_point_of_bodies_that_are_not_convex_is_found():
    """Two angles of thickness 1 that cover each other: 1/2 from both boundaries."""
    a, b = Body("a", ANGLE), Body("b", ANGLE, Translation(["1/10"]))
    assert surely_meet(a, b, QQ(0), QQ(9, 10))
    assert not surely_meet(a, b, QQ(0), QQ(100))
