"""First contacts of scenes in which the number of slabs of time once followed from bystanders."""

from fractions import Fraction

import pytest

from exactpt import Body, Pieces, Rigid, Scene, Translation, first_contact, first_within
from exactpt.testing import ending_at

LOOKS = 600
"""Looks at the clock that a search of a few slabs may take; it takes some in each slab."""


def guided(span: int, speed: int) -> Scene:
    """Return a rod that goes to and fro between two rails, beside a body that flies away.

    The rod stays 1/4 of a unit in x or y away from the diagonal, the rails 1 or 2 units.
    """
    upper = Body("upper", [(-5, -4), (16, 17), (15, 17), (-5, -3)])
    lower = Body("lower", [(-4, -5), (17, 16), (17, 15), (-3, -5)])
    quarter = Fraction(1, 4)
    left = [(Fraction(i), i + quarter) for i in range(10)]
    right = [(Fraction(i), i - quarter) for i in reversed(range(10))]
    there_and_back = [0, Fraction(4, span), Fraction(-4, span**2)]
    rod = Body("rod", [*left, *right], Translation(there_and_back, there_and_back))
    bystander = Body("fly", [(25, 0), (26, 0), (25, 1)], Translation([0], [0, speed]))
    return Scene([upper, lower, rod, bystander], (0, span))


@pytest.mark.parametrize(("span", "speed"), [(100, 1), (100, 10**4), (10**5, 1), (10**5, 10**9)])
def test_first_contact_beside_a_body_that_flies_away_takes_few_slabs(span: int, speed: int) -> None:
    """The number of slabs was span times speed, divided by 5."""
    with ending_at(None) as clock:
        assert first_contact(guided(span, speed), method="pairs") is None
    assert clock.looks < LOOKS
    with ending_at(None) as clock:
        assert first_within(guided(span, speed), distance=Fraction(1, 100)) is None
    assert clock.looks < LOOKS


@pytest.mark.parametrize("exponent", [54, 55, 60])
def test_first_contact_of_a_fast_convoy_takes_few_slabs(exponent: int) -> None:
    """Relative to the common motion, doubles no longer tell the places of bodies apart.

    Relative to b, a sinks by 2 and c moves by 1/2 to the right in a unit of time, both beside it.
    """
    fast = 2**exponent
    bodies = [
        Body("a", [(-1, -4), (0, -3), (1, -3), (2, -4)],
             Translation([0, fast, fast], [0, fast - 2])),
        Body("b", [(1, 3)], Translation([0, fast, fast], [0, fast])),
        Body("c", [(-2, 4), (-3, 6)], Translation([0, fast + Fraction(1, 2), fast], [0, fast])),
        Body("d", [(3, 0), (4, -2), (3, -2), (2, 0)], Translation([0, fast, fast], [0, fast])),
    ]  # fmt: skip
    with ending_at(None) as clock:
        assert first_contact(Scene(bodies, (0, 7)), method="pairs") is None
    assert clock.looks < 40 * LOOKS  # all pairs of features are decided exactly, in each slab


def steps(count: int, last: Translation) -> Pieces:
    """Return a motion to and fro between x = 0 and x = 1, in some pieces, and then another one.

    Every second piece is a rest. It ends at x = 0 if the count is a multiple of 4.
    """
    motions = []
    for k in range(count):
        to_the_right, waits = k % 4 == 0, k % 2 == 1
        x: list[int] = (
            [1 if k % 4 == 1 else 0] if waits else [-k, 1] if to_the_right else [k + 1, -1]
        )
        motions.append((k + 1, Translation(x, [0])))
    return Pieces([*motions, (None, last)])


def test_first_contact_after_many_pieces_far_away_is_in_the_right_piece() -> None:
    """The robot waits until t = 400, then falls by 1 a unit of time, from y = 100 to y = 1 - s^2.

    The plate rises by (t / 499)^2 from 0 to 1: it is at 1 at t = 499, when the robot is at 1.
    """
    robot = Body("robot", [(0, 100), (2, 100), (1, 101)], steps(400, Translation([0], [400, -1])))
    rises = Translation([0], [0, 0, Fraction(1, 499**2)])
    plate = Body("plate", [(-9, -1), (9, -1), (9, 0), (-9, 0)], rises)
    with ending_at(None) as clock:
        contact = first_contact(Scene([robot, plate], (0, 1000)), method="pairs")
    assert contact is not None
    assert contact.time == 499
    assert clock.looks < 2 * LOOKS  # a box of each piece is made


def test_first_contact_of_a_body_with_what_it_has_carried_is_found() -> None:
    """Both move together until t = 8, then the load rises by 1 and turns back: y = (t - 8)(9 - t).

    It stands 1/2 above the arm, which rises by 1/4 a unit of time from t = 8 on. With s = t - 8,
    1/2 + s (1 - s) = s / 4 has the positive root s = (3 + sqrt(41)) / 8.
    """
    together = [(k + 1, Translation([0, 1], [0])) for k in range(7)]
    at_8 = (8, Translation([0, 1], [0]))
    arm_rises = (None, Translation([8], [-2, Fraction(1, 4)]))
    load_turns = (None, Translation([8], [-72, 17, -1]))
    arm = Body("arm", [(0, -1), (4, -1), (4, 0), (0, 0)], Pieces([*together, at_8, arm_rises]))
    half = Fraction(1, 2)
    load = Body("load", [(1, half), (3, half), (2, 2)], Pieces([*together, at_8, load_turns]))
    spinner = Body("spinner", [(50, 50), (51, 50), (50, 51)], Rigid([0, 1], pivot=(50, 50)))
    contact = first_contact(Scene([arm, load, spinner], (0, 20)), method="pairs")
    assert contact is not None
    assert float(contact.time) == pytest.approx(8 + (3 + 41**0.5) / 8, abs=1e-12)
