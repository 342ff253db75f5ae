"""Starts in arrays: the same tilings, certificates and counts as one by one."""

from random import Random

import pytest
from exactpt.collision.tilings import start_tiling, tilings_for

from benchmarks.shapes import crowd
from exactpt.pairs.start import initial_touches
from exactpt.scene.generate import FAMILIES, generate
from exactpt.tiling import angles

pytestmark = pytest.mark.plain

FEW = 10**9


def crowded(k, seed=0):
    return crowd(k, Random(f"starts {seed}"), radius=60, end=60)


def state_after_start(scene, tiling):
    """All that a start has made and counted."""
    kinetic = start_tiling(scene, tiling, scene._start)
    queue, counters = kinetic.queue, kinetic.vertices.counters
    pending = [(slot, queue.pending(slot)) for slot in queue.slots()]
    return [end for _, t in pending for end in (t.low, t.high)], (
        kinetic.state(),
        kinetic.vertices.enclosures.errors,
        [(slot, t.a, t.b, t.c, t.crossing, t.exact) for slot, t in pending],
        kinetic.table.violated,
        (kinetic.certifier.made, kinetic.certifier.skipped, kinetic.certifier.zeros),
        counters.now(),
        queue._count,
    )


def compared(scene, monkeypatch):
    """Compare the starts of all tilings of a scene, if its bodies are disjoint."""
    if initial_touches(scene)[1]:
        return
    for tiling in tilings_for(scene):
        states = []
        for least in (FEW, 0):
            monkeypatch.setattr(angles, "MANY", least)
            states.append(state_after_start(scene, tiling))
        (one_by_one, state), (at_once, other) = states
        assert state == other
        assert at_once == pytest.approx(one_by_one, rel=1e-9)


@pytest.mark.parametrize("family", FAMILIES)
def test_starts_in_arrays_are_those_one_by_one(family, monkeypatch):
    """Degenerate bodies, deformation and turns among them."""
    for seed in range(3):
        compared(generate(family, seed), monkeypatch)


def test_starts_of_crowds(monkeypatch):
    for k in (3, 30):
        compared(crowded(k), monkeypatch)
