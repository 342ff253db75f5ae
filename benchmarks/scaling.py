"""Events, certificates, time and memory of every tiling of bodies by the size of a scene.

Crowds of convex bodies grow in number; two combs and two spirals grow in vertices, interlocked
or a hundred diameters apart. Exponents p are fitted to c n^p by least squares over the
logarithms, and compared with the paper's bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from random import Random
from typing import Final, NamedTuple

from benchmarks.floor import floor
from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.plots import series_of
from benchmarks.shapes import TANGLES, TangleFamily, crowd, tangle
from benchmarks.timing import exponent, memory_of, per_event, timed
from exactpt import Scene, Simulation
from exactpt.kernel.numbers import QQ
from exactpt.tiling.driver import Driver
from exactpt.tiling.start import TILINGS, start_tiling
from exactpt.tiling.tiling import Tiling

__all__ = ["FULL", "QUICK", "Measured", "Sizes", "measure", "run"]

BOUNDS: Final = {
    "greedy": "30 k certificates for convex bodies",
    "mixed": "O(kappa log n) certificates",
    "lazy": "4 certificates a bridge edge",
}
"""Proved bounds for k bodies with n vertices. A bridge edge joins two bodies; kappa is the
minimum number of links of a subdivision that separates the bodies."""


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        bodies: numbers of bodies of crowds.
        vertices: numbers of vertices of each of two interlocked polygons.
        events: maximum number of events of a run.
        runs: number of runs, of which the fastest counts.
        large: numbers of bodies of crowds that are run once, with twenty times as many events.
    """

    bodies: Sequence[int]
    vertices: Sequence[int]
    events: int
    runs: int
    large: Sequence[int]


QUICK: Final = Sizes((10, 30, 100), (16, 64), 200, 1, (300,))
FULL: Final = Sizes(
    (10, 20, 50, 100, 200, 500, 1000), (16, 64, 256, 1024, 4096), 1000, 3, (10_000, 100_000)
)

CROWD: Final = "convex crowd"
LARGE_TILINGS: Final = ("lazy", "greedy")
"""The tilings that large crowds of convex bodies are given."""

ALONE: Final = "seven certificates alone"
"""Name of the line for what is not the tiling's: as many certificates as an event makes."""


class Measured(NamedTuple):
    """Measurements of a run of a tiling.

    Attributes:
        start: seconds to build and certify it.
        certificates: number of certificates made at the start.
        pending: number of certificates in the queue at the start.
        most: maximum number of certificates in the queue.
        events: number of events up to the contact, the end, or the bound.
        seconds: processor time of these events.
        alone: processor time of these events without the contact that may end them.
        simulated: the same in a `Simulation`, whose events are not read.
        exact: exact decisions per thousand decisions.
        kilobytes: memory of everything that the start has made.
    """

    start: float
    certificates: int
    pending: int
    most: int
    events: int
    seconds: float
    alone: float
    simulated: float
    exact: float
    kilobytes: float

    @property
    def per_event(self) -> float:
        """Microseconds per event."""
        return per_event(self.seconds, self.events)

    @property
    def ratio(self) -> float | None:
        """How many times as long the events of a simulation take; None without events."""
        return self.simulated / self.alone if self.events else None


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure every tiling on every family."""
    rows: list[Row] = []
    fits: list[Row] = []
    families: dict[str, tuple[Sequence[int], Callable[[int], Scene]]] = {
        CROWD: (sizes.bodies, partial(_crowd, seed=seed))
    }
    for name, make in TANGLES.items():
        for where, far in (("", False), (", far apart", True)):
            families[name + where] = (sizes.vertices, partial(_tangle, make, far=far))
    for family, (of_family, scene_of) in families.items():
        for tiling in TILINGS:
            runs = []
            for n in of_family:
                output.progress(f"{family}, {tiling}, size {n}")
                runs.append(measure(scene_of(n), tiling, sizes))
                rows.append(_row(family, tiling, scene_of(n), n, runs[-1]))
            fits.append(_fit(family, tiling, of_family, runs))
    unknown = dict.fromkeys(rows[0])
    for n in sizes.large:
        for tiling in LARGE_TILINGS:
            output.progress(f"{CROWD}, {tiling}, size {n}")
            rows.append({**unknown, **_large(n, tiling, 20 * sizes.events, seed)})
    of_all = (*sizes.bodies, *sizes.large)
    rows.extend({**unknown, **_floor(n, sizes.events, seed)} for n in of_all)
    output.table("scaling", rows)
    output.table("scaling-exponents", fits)
    crowds = [row for row in rows if row["family"] == CROWD]
    for name, column, axis in (
        ("events", "us an event", "microseconds an event"),
        ("certificates", "pending", "certificates"),
    ):
        series = series_of(crowds, "tiling", "size", column)
        output.lines(f"scaling-{name}", f"Convex bodies: {axis}", ("bodies", axis), series)


def measure(scene: Scene, tiling: str, sizes: Sizes) -> Measured:
    """The fastest of several runs, and the memory of a separate one."""
    start_tiling(fresh(scene), tiling, scene.exact_start)  # imports on first use are not timed
    runs = [_run_once(fresh(scene), tiling, sizes.events) for _ in range(sizes.runs)]
    best = min(runs, key=lambda m: m.start + m.seconds)
    given = fresh(scene)
    kilobytes = memory_of(lambda: start_tiling(given, tiling, given.exact_start))
    alone, simulated = (
        min(times) for times in zip(*((m.alone, m.simulated) for m in runs), strict=True)
    )
    return best._replace(alone=alone, simulated=simulated, kilobytes=kilobytes)


def _run_once(scene: Scene, tiling: str, events: int) -> Measured:
    kinetic, start = timed(lambda: start_tiling(scene, tiling, scene.exact_start))
    certificates, pending = kinetic.certifier.made, len(kinetic.queue)
    _, seconds = timed(lambda: _pass(kinetic, _events(scene, kinetic), events))
    happened = kinetic.stats.total
    exact, filtered, _ = kinetic.vertices.counters.now()
    return Measured(
        start,
        certificates,
        pending,
        max(pending, kinetic.stats.most),
        happened,
        seconds,
        *_alone_and_simulated(scene, tiling, happened),
        1000 * exact / max(1, exact + filtered),
        0.0,
    )


def _alone_and_simulated(scene: Scene, tiling: str, events: int) -> tuple[float, float]:
    """Processor time of some events of a tiling, and of the same events of a simulation."""
    kinetic = start_tiling(fresh(scene), tiling, scene.exact_start)
    simulation = Simulation(fresh(scene), tiling=tiling)
    other = simulation.kinetic
    if other is None or events == 0:
        return 0.0, 0.0
    _, alone = timed(lambda: _pass(kinetic, _events(scene, kinetic), events))
    _, simulated = timed(lambda: _pass(other, simulation.run(), events))
    return alone, simulated


def _events(scene: Scene, kinetic: Tiling) -> Iterable[object]:
    """The events of a tiling up to the first contact."""
    return Driver(scene, kinetic).events(scene.exact_end)


def _pass(kinetic: Tiling, run: Iterable[object], events: int) -> None:
    """Process events up to a contact or a maximum number."""
    for _ in run:
        if kinetic.stats.total >= events:
            return


def _large(bodies: int, tiling: str, events: int, seed: int) -> Row:
    """Figures of a single run."""
    scene = _crowd(bodies, seed)
    kinetic, start = timed(lambda: start_tiling(scene, tiling, scene.exact_start))
    made, pending = kinetic.certifier.made, len(kinetic.queue)
    _, seconds = timed(lambda: _pass(kinetic, _events(scene, kinetic), events))
    return {
        "family": CROWD,
        "tiling": tiling,
        "size": bodies,
        "vertices": scene.vertex_count,
        "start s": start,
        "made": made,
        "pending": pending,
        "events": kinetic.stats.total,
        "us an event": per_event(seconds, kinetic.stats.total),
    }


def _floor(bodies: int, events: int, seed: int) -> Row:
    """Return the row of the certificates of an event alone, beside those of the tilings."""
    kinetic = start_tiling(_crowd(bodies, seed), "lazy", QQ(0))
    return {
        "family": CROWD,
        "tiling": ALONE,
        "size": bodies,
        "us an event": floor(kinetic, events),
    }


def _crowd(k: int, seed: int) -> Scene:
    return crowd(k, Random(f"scaling:{k}:{seed}"), radius=60, end=100)


def _tangle(make: TangleFamily, n: int, *, far: bool) -> Scene:
    given = make(n)
    return tangle(given, shift=100 * given.diameter if far else 0)


def _row(family: str, tiling: str, scene: Scene, size: int, run: Measured) -> Row:
    return {
        "family": family,
        "tiling": tiling,
        "size": size,
        "vertices": scene.vertex_count,
        "start s": run.start,
        "made": run.certificates,
        "pending": run.pending,
        "most": run.most,
        "events": run.events,
        "us an event": run.per_event,
        "simulation": run.ratio,
        "exact in 1000": run.exact,
        "kilobytes": run.kilobytes,
    }


def _fit(family: str, tiling: str, sizes: Sequence[int], runs: Sequence[Measured]) -> Row:
    return {
        "family": family,
        "tiling": tiling,
        "p start": exponent(sizes, [run.start for run in runs]),
        "p pending": exponent(sizes, [run.pending for run in runs]),
        "p memory": exponent(sizes, [run.kilobytes for run in runs]),
        "p us an event": exponent(sizes, [run.per_event for run in runs]),
        "bound": BOUNDS.get(tiling, ""),
    }
