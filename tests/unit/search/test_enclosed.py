"""Bounds of the first contact of bodies that turn at exactly a constant rate."""

import math
from decimal import Decimal
from fractions import Fraction

import pytest

from exactpt import (
    Body,
    InputError,
    PosePath,
    Rigid,
    Scene,
    Spin,
    Translation,
    first_contact_enclosed,
)
from exactpt.kernel.numbers import QQ
from exactpt.motion.displacement import displacement
from exactpt.pair.sure import surely_meet, surely_passed

WALL = Body("wall", [(-1, 1), (1, 1), (1, 2), (-1, 2)])
"""A blade of length 2 from the origin comes to its corner (1, 1) at the angle pi / 4."""


def spin(error="1/1000", **options):
    return Spin(1, error=error, **options)


def bounds_of(*bodies, time=(0, 3)):
    return first_contact_enclosed(Scene(bodies, time=time))


@pytest.mark.long("1e-12")
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


def blade(omega=1):
    return Body("b", [(0, 0), (2, 0)], Spin(omega, error="1/1000"))


@pytest.mark.parametrize("omega", [1, -2, 0])
@pytest.mark.parametrize(
    "other",
    [
        Body("p", [(2, 0)]),
        Body("p", [(1, 0), (1, -1)], Translation(0, [0, -1])),
        Body("p", [(4, 0)], Spin(3), radius=2),
        Body("p", holes=[[(2, -1), (-1, -1), (-1, 1), (2, 1)]],
             vertices=[(-9, -9), (9, -9), (9, 9), (-9, 9)]),
    ],
    ids=["point", "leaving", "disc", "hole"],
)  # fmt: skip
def test_bug_touch_at_the_start_at_angle_0_was_not_certain(omega, other):
    """Each true angle is 0 at t = 0, whatever the pieces are."""
    found = bounds_of(blade(omega), other, Body("far", [(99, 0)], spin()))

    assert found.low == found.high == 0
    assert found.pairs == (("b", "p"),)


def test_touching_at_the_start_at_another_angle_is_not_sure():
    """The tip is at a place that is not rational, and leaves at once."""
    turning = blade()
    tip = Body("p", [turning.exact_at(QQ(1))[1]])
    found = bounds_of(turning, tip, time=(1, 3))

    assert found.low == 1
    assert found.high is None


def test_touch_at_the_start_names_the_pairs_that_may_meet():
    ahead = PosePath([0, 3], [(0, 0, [1, 1])], error="1/1000", pivot=(0, 5))
    turning = Body("q", [(0, 5), (2, 5)], ahead)
    found = bounds_of(
        blade(), Body("p", [(2, 0)]), turning, Body("r", [turning.exact_at(QQ(0))[1]])
    )

    assert found.low == found.high == 0
    assert found.pairs == (("b", "p"), ("q", "r"))


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


def test_displacement_at_a_rational_distance_from_the_pivot_is_exact():
    """The error of the angle times 5, the distance of (3, 4): a number of less than 24 bits."""
    body = Body("b", [(3, 4)], spin("1/1024"))

    assert displacement(body, QQ(0), QQ(3)) == QQ(5, 1024)


def test_lower_bound_is_the_time_at_which_the_pieces_are_within_the_displacement():
    """A tip at (cos a, sin a) is displaced by 1. It is at that distance from (0, 1) at sin a = 1/2.

    There the angle a of the pieces is pi / 6, and the true angle may be larger by 1.
    """
    tip = Body("tip", [(1, 0)], spin(1))

    found = bounds_of(tip, Body("post", [(0, 1)]))

    ((x, y),) = tip.at(found.low, digits=30)
    assert y == Decimal("0.5")
    assert x == Decimal("0.866025403784438646763723170753")


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


RINGED = {
    "hole": {"holes": [[(6, 4), (4, 4), (4, 6), (6, 6)]]},
    "hole within a part": {
        "parts": [
            {"vertices": [(12, 0), (13, 0), (12, 1)]},
            {"vertices": [(0, 0), (10, 0), (10, 10), (0, 10)],
             "holes": [[(6, 4), (4, 4), (4, 6), (6, 6)]]},
        ]
    },
}  # fmt: skip
"""A plate of side 10 whose hole is the square from (4, 4) to (6, 6)."""


def plate(kind, motion=None):
    outline = [(0, 0), (10, 0), (10, 10), (0, 10)] if kind == "hole" else None
    return Body("plate", outline, motion or Translation([0]), **RINGED[kind])


@pytest.mark.parametrize("kind", sorted(RINGED))
def test_bug_point_in_a_hole_was_deep_inside_the_plate(kind):
    error = QQ(1, 100)

    def sure(x, y):
        answers = {
            surely_meet(Body("p", [(x, y)]), plate(kind), QQ(0), error),
            surely_meet(plate(kind), Body("p", [(x, y)]), QQ(0), error),
        }
        assert len(answers) == 1
        return answers.pop()

    assert not sure(QQ(11, 2), 5)
    assert sure(3, 5)  # in the plate, away from both rings
    assert not sure(QQ(3999, 1000), 5)  # in the plate, near the hole
    assert not sure(11, QQ(1, 2))  # between the two parts
    assert sure(QQ(49, 4), QQ(1, 4)) == (kind != "hole")


@pytest.mark.parametrize("kind", sorted(RINGED))
def test_bug_bounds_with_a_point_in_a_hole_excluded_the_contact(kind):
    """The edge x = 0 comes to the post at t = 0.2893; the other point stays in the hole."""
    turning = plate(kind, Spin(1, (5, 5), error="1/30"))
    post = Body("post", [("-157/200", "6909/1000")])
    found = bounds_of(turning, post, Body("still", [("11/2", 5)]), time=(0, 2))

    x, y = -5.785, 1.909
    time = math.acos(5 / math.hypot(x, y)) - math.atan2(y, -x)
    assert found.low < time < found.high
    assert found == bounds_of(turning, post, time=(0, 2))


def test_another_radius():
    disc = Body("disc", [(0, 0)], Translation([0, 1]), radius=1)

    assert disc.with_radius("5/2") == Body("disc", [(0, 0)], Translation([0, 1]), radius="5/2")
    with pytest.raises(InputError, match="radius: it is negative: -1"):
        disc.with_radius(-1)
