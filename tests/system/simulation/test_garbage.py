"""A tiling and its events are freed by reference counts, without the cyclic collector."""

import gc
from collections import Counter
from contextlib import contextmanager
from random import Random

import pytest

from benchmarks.living import WALLS, box
from benchmarks.shapes import crowd
from exactpt.simulation.responses import Bounce
from exactpt.simulation.simulation import Simulation
from exactpt.tiling.start import TILINGS, start_tiling

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
        kept = start_tiling(scene, tiling, scene._start)

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
