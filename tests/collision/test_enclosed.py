"""Bounds of the first contact of bodies that turn at exactly a constant rate."""

import math
from fractions import Fraction

import pytest

from exactpt import Body, InputError, Rigid, Scene, Spin, Translation, first_contact_enclosed
from exactpt.kernel.numbers import QQ
from exactpt.motion.displacement import displacement
from exactpt.proximity.sure import surely_meet, surely_passed

WALL = Body("wall", [(-1, 1), (1, 1), (1, 2), (-1, 2)])
"""A blade of length 2 from the origin comes to its corner (1, 1) at the angle pi / 4."""


def spin(error="1/1000", **options):
    return Spin(1, time=(0, 3), error=error, **options)


def bounds_of(*bodies, time=(0, 3)):
    return first_contact_enclosed(Scene(bodies, time=time))


@pytest.mark.parametrize("error", ["1/100", "1/1000", "1e-6", "1e-12"])
def test_the_true_time_is_enclosed_as_nearly_as_the_error_allows(error):
    found = bounds_of(Body("blade", [(0, 0), (2, 0)], spin(error)), WALL)

    assert found.is_certain
    assert found.pairs == (("blade", "wall"),)
    assert found.low < math.pi / 4 < found.high
    # The blade passes the corner at the speed sqrt(2), and may be out of place by 2 errors.
    width = Fraction(found.high.high) - Fraction(found.low.low)
    assert width < 2.2 * 2 * float(Fraction(error)) / math.sqrt(2)


def test_without_a_spin_the_bounds_are_the_time():
    box = Body("box", [(-9, 1), (-8, 1), (-8, 2)], Translation([0, "3"]))
    found = bounds_of(box, WALL, Body("blade", [(20, 0), (22, 0)], spin()))

    assert found.low == found.high == Fraction(7, 3)
    assert found.pairs == (("box", "wall"),)


def test_an_exact_contact_before_an_uncertain_one_counts():
    """The point may be missed by the tip; the box meets the wall later, for sure."""
    box = Body("box", [(-13, 1), (-12, 1), (-12, 2)], Translation([0, "3"]))
    tip = Body("tip", [(0, 2)])
    found = bounds_of(
        Body("blade", [(0, 0), (2, 0)], spin()), tip, box, Body("w", [(-5, 0), (-5, 3)])
    )

    assert found.low < math.pi / 2
    assert found.high == Fraction(7, 3)
    assert found.pairs == (("blade", "tip"),)


def test_what_may_graze_has_no_upper_bound():
    blade = Body("blade", [(0, 0), (2, 0)], spin())
    for x in (2, Fraction(20001, 10000), Fraction(19999, 10000)):
        found = bounds_of(blade, Body("post", [(0, x)]))
        assert not found.is_certain
        assert found.low < math.pi / 2
        assert found.to_json()["high"] is None
    assert bounds_of(blade, Body("post", [(0, Fraction(201, 100))])) is None


def test_a_point_that_a_blade_sweeps_is_met_for_sure():
    found = bounds_of(Body("blade", [(0, 0), (2, 0)], spin()), Body("post", [(0, 1)]))

    assert found.low < math.pi / 2 < found.high
    assert float(found.high) - float(found.low) < 2.2 * 2 / 1000


def test_it_is_passed_before_an_end_of_the_edge_comes_near_or_not_for_sure():
    blade = Body("blade", [(0, 0), (2, 0)], spin())
    times, error = (QQ(3, 2), QQ(8, 5)), QQ(1, 500)

    def passed(y, error=error, times=times):
        return surely_passed(Body("p", [(0, y)]), blade, 0, *times, error)

    assert passed(1)
    assert not passed(3)  # the foot is outside
    assert not passed(QQ(1999, 1000))  # an end is near
    assert not passed(1, QQ(1, 10))  # the line is near at one of the times
    assert not passed(1, times=(QQ(8, 5), QQ(9, 5)))  # both on one side


def test_contained_and_overlapping_bodies_meet_at_the_start():
    room = Body("room", [(-9, -9), (9, -9), (9, 9), (-9, 9)])
    for body in (Body("b", [(0, 0), (2, 0)], spin()), Body("b", [(8, 0), (20, 0)], spin())):
        found = bounds_of(body, room)
        assert found.low == found.high == 0


def test_touching_at_the_start_is_not_sure():
    """It leaves at once, and may never have touched."""
    found = bounds_of(Body("b", [(0, 0), (2, 0)], spin()), Body("p", [(2, 0)]))

    assert found.low == 0
    assert found.high is None


def test_rounded_bodies():
    disc = Body("disc", [(2, 0)], spin(), radius=1)
    found = bounds_of(disc, Body("post", [(0, 3)], radius="1/2"))
    # The centres are 1.5 apart: |2 e^it - 3i|^2 = 13 - 12 sin t = 9/4.
    time = math.asin((13 - 9 / 4) / 12)

    assert found.low < time < found.high
    assert float(found.high) - float(found.low) < 2.2 * 2 / 1000 / (12 * math.cos(time) / 3)


def test_a_body_that_turns_and_closes_on_itself_meets_itself_at_an_exact_time():
    claw = [(0, 0), (4, 0), (4, 3), {"x": [3, "-1"], "y": [3]}, {"x": [3, "-1"], "y": [2]},
            (3, 1), (1, 1), (1, 3), (0, 3)]  # fmt: skip
    found = bounds_of(Body("claw", claw, spin()))

    assert found.low == found.high == 2
    assert found.pairs == (("claw", "claw"),)


def test_how_far_a_point_may_be_out_of_place():
    for body in (
        Body("b", [(3, 4), (0, 0)], spin()),
        Body("b", keyframes=[(0, [(1, 0)]), (1, [(3, 4)]), (9, [(0, 0)])], motion=spin()),
        Body("b", [{"x": [0, 1], "y": [4]}], spin()),
        Body("b", [(8, 0)], spin(pivot=(3, 0), x=[0, 9])),
    ):
        assert QQ(5, 1000) <= displacement(body, QQ(0), QQ(3)) < QQ(5001, 1000000)
    assert displacement(Body("b", [(3, 4)], Rigid([0, 1])), QQ(0), QQ(3)) == 0
    assert displacement(Body("b", [(0, 0)], spin()), QQ(0), QQ(3)) == 0


def test_when_bodies_are_sure_to_meet():
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]

    def sure(a, b, error, radius=0):
        return surely_meet(Body("a", a), Body("b", b, radius=radius), QQ(0), QQ(error))

    assert sure(square, [(1, 2)], 1)
    assert not sure(square, [(1, 2)], QQ(1001, 1000))
    assert sure([(-1, 2), (9, 2)], [(1, 0), (1, 9)], 2)
    assert not sure([(-1, 2), (9, 2)], [(1, 0), (1, 9)], QQ(2001, 1000))
    assert not sure([(-1, 2), (9, 2)], [(1, 3), (1, 9)], QQ(1, 1000))
    assert sure([(0, 0)], [(0, 0)], 0)
    assert not sure([(0, 0)], [(0, 0)], QQ(1, 10**9))
    assert sure([(0, 0)], [(3, 0)], 1, radius=4)
    assert not sure([(0, 0)], [(3, 0)], QQ(1001, 1000), radius=4)
    assert sure(square, [(1, 2)], 2, radius=1)
    assert not sure(square, [(1, 2)], QQ(2001, 1000), radius=1)


def test_another_radius():
    disc = Body("disc", [(0, 0)], Translation([0, 1]), radius=1)

    assert disc.with_radius("5/2") == Body("disc", [(0, 0)], Translation([0, 1]), radius="5/2")
    with pytest.raises(InputError, match="radius: it is negative: -1"):
        disc.with_radius(-1)
