"""The driver of a tiling: from event to event, up to a time or to the first contact.

Nothing else calls `Tiling.advance` or `Tiling.advance_many`. Whoever follows a run is an
`Observer` and declares the callbacks that it needs; the driver requests no more from the tiling.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import Budget
from exactpt.kernel.collection import collector_at_rest
from exactpt.kernel.numbers import QQ, fraction
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.start import initial_touches, near_pairs
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.start import TilingPlan, plan_tiling

if TYPE_CHECKING:
    from exactpt.indices import HalfEdge
    from exactpt.motion.track import Incidence
    from exactpt.tiling.tiling import Tiling

NOTHING: Final = 0
"""Listen only to the start, the end, and changes of motions."""
TIMES: Final = 1
"""Listen to event times too (`Observer.on_event_time`); events are not recorded."""
EVENTS: Final = 2
"""Listen to the events of each event time too (`Observer.on_events`)."""
CHANGES: Final = 3
"""Listen to the changed half-edges too (`Observer.on_changed_edges`)."""

MANY: Final = 64
"""Number of event times between two checks of the budget, if nothing listens."""


class Observer:
    """An observer of a run; every method does nothing by default.

    Attributes:
        listens_to: `NOTHING`, `TIMES`, `EVENTS` or `CHANGES`.
    """

    listens_to: int = TIMES

    def on_initial_contact(self, scene: Scene) -> None:
        """Process a contact at the start; no other method but `finish` is called."""

    def on_advance(self, scene: Scene, tiling: Tiling) -> None:
        """Prepare for an advance; the scene is the one after the last change of motions."""

    def on_changed_edges(self, changed: set[HalfEdge] | None) -> None:
        """Process an event time, or a time without an event before it, which is now.

        Args:
            changed: see `Tiling.changes`.
        """

    def on_events(self, tiling: Tiling, events: Sequence[TilingEvent]) -> None:
        """Process an event time, which is now, with these events."""

    def on_event_time(self, tiling: Tiling) -> None:
        """Process an event time, which is now."""

    def on_end(self, tiling: Tiling) -> None:
        """Process the end of a run without another event, which is now."""

    def on_contact(self, tiling: Tiling, touches: Sequence[Incidence]) -> None:
        """Process a contact now, which ends the run; the tiling is the one just before."""

    def on_change(self, t: QQ) -> None:
        """Process a change of motions or bodies at a rational time."""

    def finish(self) -> None:
        """Finish the observation of the run."""


class TiledScene:
    """A scene and its tiling, both of which may change between two events.

    Attributes:
        scene: the bodies, from the last change of motions on.
        tiling: the tiling; None before there is one.
    """

    def __init__(self, scene: Scene, tiling: Tiling | None = None) -> None:
        self._scene = scene
        self.tiling = tiling

    @property
    def scene(self) -> Scene:  # noqa: D102 - an attribute
        return self._scene

    @property
    def kinetic(self) -> Tiling:
        """The tiling.

        Raises:
            InputError: if bodies touch at the start.
        """
        if self.tiling is None:
            raise InputError("the bodies touch at the start: there is no tiling")
        return self.tiling


@final
class Driver:
    """Drives the tiling of a scene.

    Args:
        scene: the scene; with its tiling, if it changes.
        tiling: the tiling of a scene, between two events; None before `start`.
        observers: the observers of the run.
        budget: the bounds of `run`.

    Attributes:
        tiled: the scene and its tiling.
        observers: the observers of the run.
        budget: the bounds of `run`.
        since: a rational time with no contact up to it; None before the contacts at the start
            are known, and if there are any.
        touches: the incidences of the contact that ended the last `start` or `advance`; None
            without one.
        initial_pairs: the pairs of bodies in contact at the start, as in `initial_touches`.
        is_broken: whether the tiling was left in the middle of an event; set by the caller.
    """

    def __init__(
        self,
        scene: Scene | TiledScene,
        tiling: Tiling | None = None,
        *,
        observers: Sequence[Observer] = (),
        budget: Budget | None = None,
    ) -> None:
        self.tiled = TiledScene(scene, tiling) if isinstance(scene, Scene) else scene
        self.observers = list(observers)
        self.budget = Budget(None, None) if budget is None else budget
        self.since: QQ | None = None if self.tiled.tiling is None else self.tiled.scene.exact_start
        self.touches: Sequence[Incidence] | None = None
        self.initial_pairs: Sequence[tuple[int, int]] = ()
        self.is_broken = False

    def start(self, tiling: str | TilingPlan, *, exact_only: bool = False) -> Contact | None:
        """Build the tiling of a name or a choice, or return the contact at the start.

        Raises:
            BudgetExceeded: if the time or the memory of this thread is used up.
            InputError: see `plan_tiling`.
        """
        scene = self.tiled.scene
        start = scene.exact_start
        plan = plan_tiling(scene, tiling, start) if isinstance(tiling, str) else tiling
        near = None if exact_only else near_pairs(plan.vertices, start)
        touches, initial_pairs = initial_touches(scene, near)
        if initial_pairs:
            self.touches, self.initial_pairs = touches, initial_pairs
            for observer in self.observers:
                observer.on_initial_contact(scene)
            return contact_of(scene, AlgebraicNumber(start), touches, initial_pairs)
        self.since = start
        try:
            with collector_at_rest():  # in one piece: at its end all that is new is visited once
                self.tiled.tiling = plan.start(start, exact_only=exact_only)
        except BudgetExceeded as spent:
            spent.reached = scene.start
            raise
        return None

    def advance(self, until: QQ, level: int = EVENTS) -> list[TilingEvent] | None:
        """Process the events of the next event time, if it is not after ``until``.

        Args:
            until: the time, rational.
            level: the highest level that anything listens to. Below `EVENTS` no event is
                recorded; `NOTHING` permits up to `MANY` event times at once.

        Returns:
            The events (none if all are internal). None if no event time was left, and the
            current time is now ``until``; or if there is a contact now: then `touches` has its
            incidences, and observers are notified by `meet`.
        """
        tiling, self.touches = self.tiled.kinetic, None
        for observer in self.observers:
            observer.on_advance(self.tiled.scene, tiling)
        events: list[TilingEvent] | None = None
        try:
            if level >= EVENTS:
                events = tiling.advance(until)
            elif tiling.advance_many(until, MANY if level == NOTHING else 1):
                events = []
        except ContactFound as found:
            self.touches = found.touches
            return None
        if self.observers:
            self._notify(tiling, events)
        return events

    def events(self, until: QQ) -> Iterator[TilingEvent]:
        """Yield the events up to a time, or to a contact (`touches`)."""
        while (events := self.advance(until)) is not None:
            yield from events

    def run(self, until: QQ) -> Contact | None:
        """Return the first contact up to a time, or None; events are not returned.

        Raises:
            BudgetExceeded: if the budget is exceeded; its ``reached`` is a time up to which no
                contact exists.
        """
        level = max((observer.listens_to for observer in self.observers), default=NOTHING)
        if self.budget.limits_events:
            level = max(level, EVENTS)
        while (events := self.advance(until, level)) is not None:
            self.spend(len(events))
        return None if self.touches is None else self.meet()

    def meet(self) -> Contact:
        """End the run with the contact that `advance` has found."""
        for observer in self.observers:
            observer.on_contact(self.tiled.kinetic, self.touches or ())
        return self.contact_ahead()

    def contact_ahead(self) -> Contact:
        """Return the contact that `advance` has found."""
        return contact_of(self.tiled.scene, self.tiled.kinetic.now, self.touches or ())

    def change(self, t: QQ) -> None:
        """Continue after a change of motions or bodies at a rational time without a contact."""
        self.since = t
        for observer in self.observers:
            observer.on_change(t)

    def spend(self, events: int) -> None:
        """Count events; between two event times, so that the run can go on.

        Raises:
            BudgetExceeded: if the budget permits fewer, or its time is over.
        """
        if self.budget.is_late():
            raise BudgetExceeded("time limit exceeded", self.reached())
        if not self.budget.spend(events):
            raise BudgetExceeded("limit of events exceeded", self.reached())

    def reached(self) -> Fraction | None:
        """Return a rational time, at most now, up to which no contact exists.

        As `contact_free_until`, but between two events without a contact the time now, if that
        is rational.
        """
        if self.is_broken:
            return self.contact_free_until()
        now = self.tiled.kinetic.now
        return now.low if now.is_rational else now.canonical_interval()[0]

    def contact_free_until(self) -> Fraction | None:
        """Return a rational time up to which no contact exists, also during an event.

        None if nothing is known, see `Search.contact_free_until`.
        """
        since, tiling = self.since, self.tiled.tiling
        if since is None:
            return None
        if tiling is None or tiling.contact_free_until is None:
            return fraction(since)
        return fraction(
            max(since, tiling.vertices.normalization.exact_time(tiling.contact_free_until.low))
        )

    def _notify(self, tiling: Tiling, events: Sequence[TilingEvent] | None) -> None:
        """Notify the observers of an event time, or that there is none."""
        levels = [observer.listens_to for observer in self.observers]
        changed = tiling.changes() if CHANGES in levels else None
        for level, observer in zip(levels, self.observers, strict=True):
            if level >= CHANGES:
                observer.on_changed_edges(changed)
            if events is None:
                observer.on_end(tiling)
                continue
            if level >= EVENTS:
                observer.on_events(tiling, events)
            if level >= TIMES:
                observer.on_event_time(tiling)
