"""Whole runs: kinetic energy, garbage, a hundred thousand bodies."""

import gc
import tracemalloc
from collections import Counter
from contextlib import contextmanager
from fractions import Fraction
from random import Random

import pytest

from benchmarks import large
from benchmarks.living import WALLS, box
from benchmarks.shapes import crowd
from exactpt import Body, Bounce, Scene, Simulation, Velocity
from exactpt.collision.driver import Driver
from exactpt.testing.audits import audit_at
from exactpt.tiling.start import TILINGS, start_tiling

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


@pytest.mark.long
def test_energy_of_300_bounces():
    fine = Bounce(ROOM, grid=Fraction(1, 2**30), slowest=Fraction(1, 2**10))

    assert drift(fine, 300) < Fraction(1, 10**8)


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
        kept = start_tiling(scene, tiling, scene.exact_start)

    assert left.total() <= FEW
    assert len(kept.queue) > 60


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


def started(bodies, tiling):
    scene = large.crowd(bodies, 0)
    driver = Driver(scene)
    assert driver.start(tiling) is None
    return scene, driver.tiled.kinetic


@pytest.mark.long
@pytest.mark.parametrize("tiling, most", [("lazy", 1800), ("greedy", 2100)])
def test_a_tiling_of_bodies_in_arrays_keeps_less_than_two_kilobytes_a_body(tiling, most):
    """About 1,640 and 1,940 bytes (an object for each vertex made it 700 more)."""
    kept = started(9, tiling)  # imports on first use are not measured
    gc.collect()
    tracemalloc.start()
    try:
        kept = started(1000, tiling)
        gc.collect()
        of_scene = sum(
            array.nbytes for array in vars(kept[0].bodies).values() if hasattr(array, "nbytes")
        )
        size = tracemalloc.get_traced_memory()[0] - of_scene
    finally:
        tracemalloc.stop()

    assert 500 < size / 1000 < most


@pytest.mark.slow
def test_events_of_a_hundred_thousand_bodies():
    scene, kinetic = started(100_000, "greedy")

    assert kinetic.advance_many(scene.exact_end, 20_000) == 20_000

    assert kinetic.stats.total >= 20_000
    assert kinetic.stats.rebuilds == 0
    made = len(scene.bodies._made)
    audit_at(kinetic, next(kinetic.clock.times_just_after()))
    assert made < 1000  # those of exact decisions; the audit makes all
