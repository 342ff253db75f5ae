"""What certificates cost alone is measured on a tiling, which goes on unchanged."""

from itertools import islice
from random import Random

from benchmarks.floor import CERTIFICATES, floor
from benchmarks.shapes import crowd
from exactpt.collision.driver import Driver
from exactpt.tiling.start import start_tiling


def test_a_tiling_goes_on_unchanged():
    scene = crowd(30, Random(1), radius=60, end=100)
    measured, other = (start_tiling(scene, "lazy", scene._start) for _ in range(2))

    assert floor(measured, 100) > 0

    assert measured.queue.slots() == other.queue.slots()
    events = [
        [(e.kind, e.removed, e.added, e.time.low) for e in islice(driver.events(scene.end), 50)]
        for driver in (Driver(lambda: scene, kinetic) for kinetic in (measured, other))
    ]
    assert len(events[0]) == 50
    assert events[0] == events[1]


def test_each_event_computes_its_certificates():
    scene = crowd(30, Random(2), radius=60, end=100)
    kinetic = start_tiling(scene, "lazy", scene._start)
    before = kinetic.certifier.made

    floor(kinetic, 10)

    assert kinetic.certifier.made == before + 10 * CERTIFICATES
