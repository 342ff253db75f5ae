"""A hundred thousand bodies from arrays: the run equals a tiling built anew, in little memory."""

import gc
import tracemalloc

import pytest

from benchmarks.large import crowd
from exactpt.collision.driver import Driver
from fuzz.statics import audit_at


def started(bodies, tiling):
    scene = crowd(bodies, 0)
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

    assert kinetic.advance_many(scene._end, 20_000) == 20_000

    assert kinetic.stats.total >= 20_000
    assert kinetic.stats.rebuilds == 0
    made = len(scene.bodies._made)
    audit_at(kinetic, next(kinetic.clock.times_just_after()))
    assert made < 1000  # those of exact decisions; the audit makes all
