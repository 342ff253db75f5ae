"""Number of changes of the tilings of moving points, with the paper's bounds, and their time.

The incremental pseudo-triangulation (IPT) changes O(n lambda_s(n)) times (Theorem 3.3), in
linear motion the fan triangulation O(n^(4/3) lambda_s(n)) times (Theorem 3.4), lambda_s(n)
being nearly n. Long chains are traversed linearly or searched: both are measured.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from random import Random
from typing import Final, Literal, NamedTuple, TypeAlias

from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.plots import series_of
from benchmarks.point_scenes import FAMILIES, random_linear, swaps_beside_arc
from benchmarks.timing import exponent, memory_of, per_event, timed
from exactpt.certificates.certifier import Certifier
from exactpt.scene.scene import Scene
from exactpt.tiling.driver import Driver
from exactpt.tiling.events import Stats
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.start import plan_tiling

__all__ = ["FULL", "QUICK", "Measured", "Sizes", "measure", "run"]

Chains: TypeAlias = Literal["auto", "linked", "searchable"]

BOUNDS: Final = "IPT n^2, fan n^2.33 (linear motion), but for factors below any power"
CHAINS: Final[tuple[Chains, ...]] = ("linked", "searchable", "auto")


class Sizes(NamedTuple):
    """Numbers of points: for all families, for short chains and for long chains."""

    points: Sequence[int]
    short: Sequence[int]
    long: Sequence[int]


QUICK: Final = Sizes((20, 40, 80), (40, 80), (40, 80))
FULL: Final = Sizes((50, 100, 200, 500, 1000), (50, 500), (500, 1000, 2000, 4000))


class Measured(NamedTuple):
    """Measurements of a run to its end or its first contact.

    Attributes:
        events: number of changes of the IPT.
        fan: number of changes of the fan triangulation; 0 if it is not kept.
        seconds: processor time.
        exact: number of decisions by exact arithmetic.
        steps: number of vertices of chains passed in searches.
        start: seconds to build and certify the tiling.
        pending: number of certificates in the queue at the start.
    """

    events: int
    fan: int
    seconds: float
    exact: int
    steps: int
    start: float
    pending: int

    @property
    def per_event(self) -> float:
        """Microseconds per event."""
        return per_event(self.seconds, self.events)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Count changes, and measure the time of events."""
    rows: list[Row] = []
    fits: list[Row] = []
    for family, make in FAMILIES.items():
        with_fan, without = [], []
        for n in sizes.points:
            output.progress(f"{family}, {n} points")
            scene = make(n, Random(f"points:{family}:{n}:{seed}"))
            with_fan.append(measure(scene, fan=True))
            without.append(measure(scene))
            rows.append(
                {
                    "family": family,
                    "points": n,
                    "start s": without[-1].start,
                    "pending": without[-1].pending,
                    "kilobytes": memory_of(partial(_start, fresh(scene))),
                    "changes of the IPT": without[-1].events,
                    "changes of the fan": with_fan[-1].fan,
                    "fan : IPT": with_fan[-1].fan / max(1, without[-1].events),
                    "us an event": without[-1].per_event,
                    "us an event with the fan": with_fan[-1].per_event,
                    "exact": without[-1].exact,
                }
            )
        fits.append(
            {
                "family": family,
                "p IPT": exponent(sizes.points, [run.events for run in without]),
                "p fan": exponent(sizes.points, [run.fan for run in with_fan]),
                "p us an event": exponent(sizes.points, [run.per_event for run in without]),
                "bounds": BOUNDS,
            }
        )
    output.table("points", rows)
    output.table("points-exponents", fits)
    output.table("points-chains", _chains(output, sizes, seed))
    series = series_of(rows, "family", "points", "changes of the IPT")
    output.lines("points", "Changes of the IPT", ("points", "changes"), series)


def measure(scene: Scene, *, chains: Chains = "auto", fan: bool = False) -> Measured:
    """Run a scene to its end or its first contact."""
    tiling, start = timed(lambda: _start(scene, chains=chains, fan=fan))
    pending = len(tiling.queue)
    exact = tiling.vertices.counters.exact
    driver = Driver(scene, tiling)
    _, seconds = timed(lambda: sum(1 for _ in driver.events(scene.exact_end)))
    return Measured(
        tiling.stats.total - tiling.stats.events.get("motion", 0),
        0 if tiling.fan is None else tiling.fan.changes,
        seconds,
        tiling.vertices.counters.exact - exact,
        sum(tree.steps for tree in tiling.structure.trees),
        start,
        pending,
    )


def _start(scene: Scene, *, chains: Chains = "auto", fan: bool = False) -> IncrementalTiling:
    plan = plan_tiling(scene, "incremental", scene.exact_start)
    certifier = Certifier(plan.vertices, scene.exact_start, scene.exact_end, exact_only=False)
    tiling = IncrementalTiling(
        plan.entry, plan.vertices, certifier, Stats(), chains=chains, fan=fan
    )
    tiling.begin(scene.exact_start)
    return tiling


def _chains(output: Output, sizes: Sizes, seed: int) -> list[Row]:
    """Chains traversed linearly or searched: short ones, and ones of nearly all points."""
    rows: list[Row] = []
    for what, make, of_kind in (
        ("short: random, linear", random_linear, sizes.short),
        ("long: swaps beside an arc", swaps_beside_arc, sizes.long),
    ):
        for kind in CHAINS:
            for n in of_kind:
                output.progress(f"chains {kind}, {what}, {n} points")
                run = measure(make(n, Random(f"chains:{n}:{seed}")), chains=kind)
                rows.append(
                    {
                        "chains": what,
                        "kept": kind,
                        "points": n,
                        "events": run.events,
                        "us an event": run.per_event,
                        "steps an event": run.steps / max(1, run.events),
                    }
                )
    return rows
