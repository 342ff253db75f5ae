"""Whole runs: kinetic energy, garbage, a hundred thousand bodies."""

import gc
import tracemalloc
from collections import Counter
from contextlib import contextmanager
from fractions import Fraction
from itertools import islice
from random import Random

import pytest

from benchmarks import large
from benchmarks.living import WALLS, box
from benchmarks.shapes import crowd
from exactpt import Body, Bounce, Scene, Simulation, Velocity
from exactpt.testing import audit

TILINGS = ("greedy", "lazy", "mixed")

ROOM = {
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
    return Scene([*bodies, *(Body(*wall) for wall in ROOM.items())], time=(0, 100_000))


def drift(bounce, contacts):
    """The relative change of energy after a number of contacts."""
    simulation = Simulation(box_of_bodies(), tiling="lazy")
    before, time = bounce.kinetic_energy(simulation), 0
    while simulation.contacts < contacts:
        time += 2
        for _ in simulation.run(time, on_contact=bounce):
            pass
    return abs(bounce.kinetic_energy(simulation) / before - 1)


@pytest.mark.slow
def test_energy_of_100000_bounces():
    """The bound of docs/howto/simulation.md."""
    fine = Bounce(ROOM, grid=Fraction(1, 2**30), slowest=Fraction(1, 2**10))

    assert drift(fine, 100_000) <= Fraction(1, 10**6)


# A tiling and its events are freed by reference counts, without the cyclic collector

FEW = 8
"""Number of objects that may be left in cycles, whatever the size of a scene."""


@contextmanager
def garbage():
    """Counts the objects, by type, that only the cyclic collector could free."""
    found = Counter()
    gc.collect()
    gc.disable()
    gc.set_debug(gc.DEBUG_SAVEALL)
    try:
        yield found
        gc.collect()
        found.update(type(one).__name__ for one in gc.garbage)
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        gc.enable()


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_start_leaves_none(tiling):
    scene = crowd(60, Random(1), radius=60, end=100)
    with garbage() as left:
        kept = Simulation(scene, tiling=tiling)

    assert left.total() <= FEW
    assert kept.stats["pending"] > 60


@pytest.mark.parametrize("tiling", TILINGS)
def test_contacts_and_responses_leave_none(tiling):
    simulation = Simulation(box(20, Random(1)), tiling=tiling)
    bounce = Bounce(WALLS, fastest=16)
    for _ in simulation.run(1, on_contact=bounce):
        pass
    before = simulation.contacts
    with garbage() as left:
        for _ in simulation.run(4, on_contact=bounce):
            pass

    assert simulation.contacts > before + 2 * FEW
    assert left.total() <= FEW


# A hundred thousand bodies from arrays: the run equals a tiling built anew, in little memory


@pytest.mark.long
@pytest.mark.parametrize("tiling, most", [("lazy", 1800), ("greedy", 2100)])
def test_a_tiling_of_bodies_in_arrays_keeps_less_than_two_kilobytes_a_body(tiling, most):
    """About 1,640 and 1,940 bytes (an object for each vertex made it 700 more)."""
    kept = Simulation(large.crowd(9, 0), tiling=tiling)  # imports on first use are not measured
    scene = large.crowd(1000, 0)
    gc.collect()
    tracemalloc.start()
    try:
        kept = Simulation(scene, tiling=tiling)
        gc.collect()
        size = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()

    assert kept.contact is None
    assert 500 < size / 1000 < most


@pytest.mark.slow
def test_events_of_a_hundred_thousand_bodies():
    simulation = Simulation(large.crowd(100_000, 0), tiling="greedy")

    assert len(list(islice(simulation.run(), 20_000))) == 20_000

    assert simulation.stats["events"] >= 20_000
    assert simulation.stats["rebuilds"] == 0
    audit(simulation)
