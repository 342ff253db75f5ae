"""A scene checked by an independent witness: CGAL verifies every tiling and event time."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import final

from exactpt.cgal import BodyShape, CgalCheck, IsolatedRoot
from exactpt.collision.contact import time_to_json
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import plan_tiling
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound
from exactpt.tiling.snapshot import snapshot
from exactpt.tiling.tiling import Tiling

__all__ = ["Report", "check_scene"]


@final
@dataclass(slots=True)
class Report:
    """What was checked, and what failed.

    Attributes:
        tiling: the name of the tiling.
        tilings: how many tilings CGAL has verified.
        times: how many event times.
        events: how many events there were.
        contact: the time of the first contact, as in docs/format.md, or None.
        failures: a line each.
    """

    tiling: str
    tilings: int = 0
    times: int = 0
    events: int = 0
    contact: dict[str, object] | None = None
    failures: list[str] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Whether nothing failed."""
        return not self.failures

    def to_json(self) -> dict[str, object]:
        """The report as JSON data."""
        return {
            "ok": self.ok,
            "tiling": self.tiling,
            "tilings": self.tilings,
            "times": self.times,
            "events": self.events,
            "contact": self.contact,
            "failures": self.failures,
        }

    def lines(self) -> list[str]:
        """The report for people."""
        verdict = "CGAL agrees" if self.ok else "CGAL DISAGREES"
        head = f"{verdict}: {self.tilings} tilings ({self.tiling}), {self.times} event times"
        if not self.tilings:
            head += " (bodies touch at the start: there is nothing to tile)"
        return [head, *(f"  {failure}" for failure in self.failures)]


def check_scene(
    scene: Scene,
    *,
    tiling: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Report:
    """Simulate a scene, and have CGAL verify what the tiling was and when it changed.

    The tiling at the start, at a rational time between any two consecutive event times,
    and at the end; each event time is one real root of its polynomial in its interval, and
    later than the one before.

    Args:
        scene: what moves.
        tiling: which tiling to keep.
        max_events: stop when there have been more events than these.
        max_seconds: see `exactpt.Simulation`.
        reached: is told of each event time when it has been checked.

    Raises:
        InputError: if the program cgal_check is missing.
        BudgetExceeded: if the bounds are reached.
    """
    plan = plan_tiling(scene, tiling, scene._start)
    report = Report(plan.name)
    deadline = None if max_seconds is None else clock.monotonic() + max_seconds
    with CgalCheck() as cgal:
        witness = _Witness(scene, cgal, report)
        if initial_touches(scene)[1]:
            start = AlgebraicNumber(scene._start)
            witness.time(start)
            report.contact = time_to_json(start)
            return report
        kinetic = plan.start(scene._start)
        try:
            witness.tiling(kinetic, scene._start)
            while True:
                witness.between(kinetic)
                events = kinetic.advance(scene._end)
                if events is None:
                    break
                report.events += len(events)
                witness.time(kinetic.now)
                if reached is not None:
                    reached(kinetic.now)
                if (max_events is not None and report.events > max_events) or (
                    deadline is not None and clock.monotonic() > deadline
                ):
                    low = kinetic.now.canonical_interval()[0]
                    raise BudgetExceeded("the budget of the check is used up", low)
            witness.tiling(kinetic, scene._end)
        except ContactFound:
            witness.time(kinetic.now)
            report.contact = time_to_json(kinetic.now)
    return report


@final
class _Witness:
    def __init__(self, scene: Scene, cgal: CgalCheck, report: Report) -> None:
        self._shapes = BodyShape.of_scene(scene)
        self._cgal = cgal
        self._report = report
        self._before: IsolatedRoot | None = None

    def between(self, kinetic: Tiling) -> None:
        """Verify the tiling between now and the next event, if there is time between."""
        following = kinetic.next_number()
        if following is not None and kinetic.now.compare(following) < 0:
            self.tiling(kinetic, rational_between(kinetic.now, following))

    def tiling(self, kinetic: Tiling, at: QQ) -> None:
        """Verify the tiling at a time at which it holds."""
        mesh = kinetic.mesh_now(at)
        tile = snapshot(kinetic.vertices, mesh, self._report.tiling, at).to_json()
        verdict = self._cgal.check_tiling(tile, self._shapes)
        self._report.tilings += 1
        if not verdict.ok:
            self._report.failures.append(f"tiling at t = {at}: {verdict.reason}")

    def time(self, time: AlgebraicNumber) -> None:
        """Verify an event time, and that it is not before the last one."""
        number = time.simplified()
        root = IsolatedRoot(number._polynomial, *number._canonical_interval())
        verdict = self._cgal.check_root(*root)
        self._report.times += 1
        if not verdict.ok:
            self._report.failures.append(f"event time {time!r}: {verdict.reason}")
        elif self._before is not None and self._cgal.compare_roots(self._before, root) > 0:
            self._report.failures.append(f"event time {time!r} is before the one before it")
        self._before = root
