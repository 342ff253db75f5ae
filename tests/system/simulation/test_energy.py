"""The kinetic energy of elastic bodies in a box stays what it is, within a stated bound."""

from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Bounce, Scene, Simulation, Velocity

WALLS = {
    "south": [(-1, -1), (51, -1), (51, 0), (-1, 0)],
    "north": [(-1, 40), (51, 40), (51, 41), (-1, 41)],
    "west": [(-1, 1), (0, 1), (0, 39), (-1, 39)],
    "east": [(50, 1), (51, 1), (51, 39), (50, 39)],
}
SHAPE = [(3, 0), (1, 3), (-2, 2), (-3, -1), (0, -3)]


def box_of_bodies():
    """Twenty convex pentagons with random velocities in four walls."""
    rng = Random(43)
    bodies = []
    for i in range(20):
        x, y = 10 * (i % 5) + 5, 10 * (i // 5) + 5
        outline = [(x + u, y + v) for u, v in SHAPE]
        velocity = [Fraction(rng.randint(-32, 32), 4) for _ in range(2)]
        bodies.append(Body(f"body {i}", outline, Velocity(*velocity)))
    return Scene([*bodies, *(Body(*wall) for wall in WALLS.items())], time=(0, 100_000))


def drift(bounce, contacts):
    """The relative change of energy after a number of contacts."""
    simulation = Simulation(box_of_bodies(), tiling="lazy")
    before, time = bounce.kinetic_energy(simulation), 0
    while simulation.contacts < contacts:
        time += 2
        for _ in simulation.run(time, on_contact=bounce):
            pass
    return abs(bounce.kinetic_energy(simulation) / before - 1)


@pytest.mark.long
def test_energy_of_300_bounces():
    fine = Bounce(WALLS, grid=Fraction(1, 2**30), slowest=Fraction(1, 2**10))

    assert drift(fine, 300) < Fraction(1, 10**8)


@pytest.mark.slow
def test_energy_of_100000_bounces():
    """The bound of docs/howto/simulation.md."""
    fine = Bounce(WALLS, grid=Fraction(1, 2**30), slowest=Fraction(1, 2**10))

    assert drift(fine, 100_000) <= Fraction(1, 10**6)
