"""Simulation: a scene with its tiling, at a time that moves forward."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator
from typing import final

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import plan_tiling
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import counters
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.scene.scene import Scene
from exactpt.simulation.event import Event
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.snapshot import Snapshot, snapshot
from exactpt.tiling.tiling import Tiling

__all__ = ["Simulation"]


@final
class Simulation:
    """Runs a scene from its start towards its end or its first contact.

    Args:
        scene: what moves.
        tiling: which tiling to keep: "auto" or one of `TILINGS`.
        exact_only: decide everything by exact arithmetic, without the float filters.
        max_events: raise `BudgetExceeded` before one more event than these.
        max_seconds: raise `BudgetExceeded` after this time.

    Attributes:
        scene: the scene.
        name: the name of the tiling.
        contact: the first contact, once it has been reached; no time passes after it.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        tiling: str = "auto",
        exact_only: bool = False,
        max_events: int | None = None,
        max_seconds: float | None = None,
    ) -> None:
        self.scene = scene
        plan = plan_tiling(scene, tiling, scene.start)
        self.name = plan.name
        self.contact: Contact | None = None
        self._max_events = max_events
        self._deadline = None if max_seconds is None else clock.monotonic() + max_seconds
        self._counted = (counters.exact, counters.filtered)
        self._events = 0
        self._kinetic: Tiling | None = None
        touches, overlaps = initial_touches(scene)
        if overlaps:
            start = AlgebraicNumber(scene.start)
            self.contact = contact_of(scene, start, touches, overlaps)
        else:
            self._kinetic = plan.start(scene.start, exact_only=exact_only)

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        if self._kinetic is None:
            return AlgebraicNumber(self.scene.start)
        return self._kinetic.now

    @property
    def kinetic(self) -> Tiling | None:
        """The tiling that is kept (None if bodies touch at the start); for `exactpt.render`.

        At a contact it is the one just before.
        """
        return self._kinetic

    def run(self, until: Rational | None = None) -> Iterator[Event]:
        """Process the events up to and including a time, by default the end of the span.

        Yields every event as it has been processed; the last is of kind "contact" if the
        first contact comes by then.

        Raises:
            BudgetExceeded: if the bounds of the simulation are reached.
        """
        end = self.scene.end if until is None else min(rational(until), self.scene.end)
        if self.contact is not None:
            if not self._events:
                self._events += 1
                yield Event(self.contact.time, "contact")
            return
        kinetic = self._tiling()
        steps = kinetic.run(end)
        while True:
            self._check_budget()
            try:
                event = next(steps, None)
            except ContactFound as found:
                self.contact = contact_of(self.scene, kinetic.now, found.touches)
                self._events += 1
                yield Event(self.contact.time, "contact")
                return
            if event is None:
                return
            self._events += 1
            yield self._named(event)

    def run_to_contact(self) -> Contact | None:
        """The first contact in the time span, or None; the fastest way to it."""
        if self.contact is None:
            kinetic = self._tiling()
            try:
                for _ in kinetic.run():
                    self._events += 1
                    self._check_budget()
            except ContactFound as found:
                self.contact = contact_of(self.scene, kinetic.now, found.touches)
        return self.contact

    def snapshot(self) -> Snapshot:
        """The tiling at the current time, which must be rational.

        Raises:
            InputError: if it is not, or after the first contact.
        """
        if self.contact is not None:
            raise InputError(f"no tiling at a contact, t = {float(self.contact.time)!r}")
        now = self.now.simplified()
        if not now.is_rational:
            raise InputError(
                f"the tiling is asked for at t = {float(now)!r}, which is not rational"
            )
        kinetic = self._tiling()
        return snapshot(kinetic.vertices, kinetic.mesh_now(now.low), self.name, now.low)

    @property
    def stats(self) -> dict[str, object]:
        """Counts of the run so far, as in the contract and more."""
        exact, filtered = self._counted
        data: dict[str, object] = {
            "bodies": len(self.scene.bodies),
            "vertices": self.scene.vertex_count,
            "events": 0,
            "certificates": 0,
            "skipped": 0,
            "exact": counters.exact - exact,
            "filtered": counters.filtered - filtered,
        }
        if self._kinetic is not None:
            stats, certifier = self._kinetic.stats, self._kinetic.certifier
            data |= {
                "events": stats.total,
                "certificates": certifier.made,
                "skipped": certifier.skipped,
                "by_kind": dict(sorted(stats.events.items())),
                "pending": len(self._kinetic.queue),
                "most_pending": stats.most,
                "batches": stats.batches,
                "rebuilds": stats.rebuilds,
                "flips": stats.flips,
            }
        return data

    def _repr_svg_(self) -> str:
        """The tiling at the current time, or the contact, for notebooks."""
        from exactpt.render.notebook import simulation_svg

        return simulation_svg(self)

    def _tiling(self) -> Tiling:
        if self._kinetic is None:
            raise InputError("the bodies touch at the start: there is no tiling")
        return self._kinetic

    def _named(self, event: TilingEvent) -> Event:
        kinetic = self._tiling()
        name = kinetic.vertices.name
        time = event.time.exact or kinetic.certifier.resolve(event.time)
        return Event(
            time,
            event.kind,
            tuple((name(u), name(v)) for u, v in event.removed),
            tuple((name(u), name(v)) for u, v in event.added),
        )

    def _check_budget(self) -> None:
        late = self._deadline is not None and clock.monotonic() > self._deadline
        many = self._max_events is not None and self._events >= self._max_events
        if late or many:
            reached = self.reached()
            what = "time" if late else "number of events"
            raise BudgetExceeded(f"the {what} is used up at t = {float(reached)!r}", reached)

    def reached(self) -> QQ:
        """A rational time at most now: up to it there is provably no contact."""
        now = self.now
        return now.low if now.is_rational else now.canonical_interval()[0]
