"""Bounces with restitution and masses: momentum and energy of two bodies on a line."""

import pickle
from fractions import Fraction

import pytest

from exactpt import Body, Bounce, InputError, Scene, Simulation, Velocity

BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]
EXACT = 2.0**-19  # velocities are rounded to the grid of 2^-20


def velocities_after(bounce, u=2, v=-1):
    """The velocities of two boxes that meet on the x axis, after their first contact."""
    left = Body("left", BOX, Velocity(u, 0))
    right = Body("right", [(x + 10, y) for x, y in BOX], Velocity(v, 0))
    simulation = Simulation(Scene([left, right], time=(0, 20)))
    list(simulation.run(5, on_contact=bounce))
    assert simulation.contacts == 1
    now = Fraction(5)
    return [
        float(simulation.body(name).at(now + 1)[0][0] - simulation.body(name).at(now)[0][0])
        for name in ("left", "right")
    ]


def test_equal_masses_exchange_their_velocities():
    assert velocities_after(Bounce()) == pytest.approx([-1, 2], abs=EXACT)


def test_momentum_and_energy_of_unequal_masses_are_kept():
    u, v = velocities_after(Bounce(masses={"left": 3, "right": "1/2"}))

    assert 3 * u + v / 2 == pytest.approx(3 * 2 - 1 / 2, abs=4 * EXACT)
    assert 3 * u * u + v * v / 2 == pytest.approx(3 * 4 + 1 / 2, abs=20 * EXACT)
    assert u < v


def test_restitution_is_the_ratio_of_speeds():
    u, v = velocities_after(Bounce(restitution="1/4"))

    assert v - u == pytest.approx(3 / 4, abs=2 * EXACT)
    assert u + v == pytest.approx(1, abs=2 * EXACT)


def test_without_restitution_bodies_part_slowly():
    u, v = velocities_after(Bounce(restitution=0, slowest="1/8"))

    assert v - u == pytest.approx(1 / 8, abs=2 * EXACT)


def test_a_fixed_body_is_infinitely_heavy():
    u, v = velocities_after(Bounce(fixed=["right"], masses={"left": 100}), v=0)

    assert (u, v) == (pytest.approx(-2, abs=EXACT), 0)


def test_a_bounce_that_was_pickled_is_the_same():
    bounce = Bounce(restitution="1/2", masses={"left": 3})

    assert velocities_after(pickle.loads(pickle.dumps(bounce))) == velocities_after(bounce)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"restitution": 2}, "restitution: not between 0 and 1: 2"),
        ({"restitution": "-1/2"}, "restitution: not between 0 and 1"),
        ({"masses": {"left": 0}}, "the mass of 'left': not positive: 0"),
    ],
)
def test_options_out_of_range_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        Bounce(**options)


def test_a_mass_of_no_body_is_refused():
    with pytest.raises(InputError, match="Bounce: masses: there is no body 'lfet'"):
        velocities_after(Bounce(masses={"lfet": 2}))
