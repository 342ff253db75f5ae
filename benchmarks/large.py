"""Runs of up to a million convex bodies from arrays, as a user runs them, the collector on.

Each run has a process of its own, whose memory is measured before and after each step. Events are
those that ``for event in Simulation.run()`` sees; then the next ones are processed many at a time.
Contacts are those of a second run, in which bodies bounce: from the first one on, at which bodies
are made. Times are processor times.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from itertools import islice
from math import ceil, sqrt
from time import process_time
from typing import Final, NamedTuple

import numpy as np

from benchmarks.output import Output, Row
from benchmarks.timing import per_event, resident
from exactpt import Bounce, Contact, Scene, Simulation
from exactpt.tiling.driver import NOTHING, Driver

__all__ = ["FULL", "QUICK", "Sizes", "crowd", "figures", "run"]

CELL: Final = 1000.0
"""Width of the cell of a body at the start."""
RADIUS: Final = 5.0
SPEED: Final = 1000
END: Final = 100
MOST: Final = 10_000
"""Number of bodies up to which they bounce: of 100,000, a contact of `greedy` took 30 s."""
TILINGS: Final = ("lazy", "greedy")


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        bodies: numbers of bodies.
        events: number of events seen one by one, and of event times processed at once after them.
        contacts: number of contacts that are timed.
    """

    bodies: Sequence[int]
    events: int
    contacts: int


QUICK: Final = Sizes((100,), 50, 5)
FULL: Final = Sizes((1000, 10_000, 100_000, 1_000_000), 50_000, 20)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Run every tiling with every number of bodies."""
    rows: list[Row] = []
    for bodies in sizes.bodies:
        for tiling in TILINGS:
            output.progress(f"{bodies} bodies, {tiling}")
            words = [tiling, *map(str, (bodies, sizes.events, sizes.contacts, seed))]
            command = [sys.executable, "-m", "benchmarks.large", *words]
            printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            rows.append(json.loads(printed))
    output.table("large", rows)


def crowd(bodies: int, seed: int) -> Scene:
    """Polygons of 3 to 9 vertices on circles, in cells of a square, with random velocities."""
    rng = np.random.default_rng(seed)
    side = ceil(sqrt(bodies))
    cells = np.stack(np.divmod(np.arange(bodies), side), axis=1)
    centers = CELL * (cells - side // 2) + rng.uniform(-0.4, 0.4, (bodies, 2)) * CELL
    counts = rng.integers(3, 10, bodies)
    owner = np.repeat(np.arange(bodies), counts)
    turns = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    angles = 2.0 * np.pi * (turns + rng.uniform(0.0, 0.9, len(owner))) / counts[owner]
    radii = RADIUS * rng.uniform(0.3, 1.0, bodies)[owner]
    ring = np.stack((np.cos(angles), np.sin(angles)), axis=1) * radii[:, None]
    velocities = rng.integers(-SPEED, SPEED + 1, (bodies, 2)).astype(np.float64)
    offsets = np.concatenate(([0], np.cumsum(counts)))
    return Scene.from_arrays(centers[owner] + ring, offsets, velocities=velocities, time=(0, END))


def figures(tiling: str, bodies: int, events: int, contacts: int, seed: int) -> Row:
    """The figures of one run, in this process."""
    Simulation(crowd(9, 0), tiling=tiling)  # imports on first use are not measured
    empty = resident()
    scene = crowd(bodies, seed)
    with_scene = resident()
    before = process_time()
    simulation = Simulation(scene, tiling=tiling)
    start = process_time() - before
    with_tiling = resident()
    before = process_time()
    seen = sum(1 for _ in islice(simulation.run(), events))
    one_by_one = process_time() - before
    kinetic, many = simulation.kinetic, 0
    before = process_time()
    if kinetic is not None and simulation.contact is None:
        total = kinetic.stats.total
        driver = Driver(scene, kinetic)
        while many < events and driver.advance(scene.exact_end, NOTHING) is not None:
            many = kinetic.stats.total - total
        many = kinetic.stats.total - total
    at_once = process_time() - before
    del simulation, kinetic
    return {
        "bodies": bodies,
        "tiling": tiling,
        "start s": start,
        "us a body": per_event(start, bodies),
        "kB a body, scene": (with_scene - empty) / bodies / 1000,
        "kB a body, tiling": (with_tiling - with_scene) / bodies / 1000,
        "events seen": seen,
        "us an event, seen": per_event(one_by_one, seen),
        "events at once": many,
        "us an event, at once": per_event(at_once, many),
        "contacts a second": rate(scene, tiling, contacts) if bodies <= MOST else None,
    }


def rate(scene: Scene, tiling: str, contacts: int) -> float | None:
    """Contacts a second of bodies that bounce, from the first one on; None without a second."""
    bounce, clock = Bounce(), list[float]()

    def respond(simulation: Simulation, contact: Contact) -> None:
        bounce(simulation, contact)
        clock.append(process_time())

    for _ in Simulation(scene, tiling=tiling).run(on_contact=respond):
        if len(clock) > contacts:
            break
    return (len(clock) - 1) / (clock[-1] - clock[0]) if len(clock) > 1 else None


if __name__ == "__main__":
    name, *numbers = sys.argv[1:]
    sys.stdout.write(json.dumps(figures(name, *map(int, numbers))))
