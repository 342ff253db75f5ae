"""The run of a scene: from event to event, up to the first contact or beyond."""

from __future__ import annotations

import time as clock
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from fractions import Fraction
from typing import Self

from exactpt.certificates.queue import EventTime
from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import plan_tiling
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counts
from exactpt.kernel.numbers import QQ, Rational, fraction, power_of_two, rational, show
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene
from exactpt.simulation.event import Event
from exactpt.simulation.living import LivingScene
from exactpt.simulation.questions import Questions
from exactpt.simulation.report import report
from exactpt.tiling.events import ContactFound
from exactpt.tiling.tiling import Tiling

__all__ = ["Running"]


class Running(Questions):
    """`exactpt.Simulation` without changes of bodies and without files.

    Args and attributes: see there.
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
        for what, bound in (("max_events", max_events), ("max_seconds", max_seconds)):
            if bound is not None and not bound >= 0:
                raise InputError(f"{what}: not a number from 0 on: {bound!r}")
        plan = plan_tiling(scene, tiling, scene._start)
        self.contact: Contact | None = None
        self.contacts: int = 0
        self._given = scene, plan.name
        self._margin = _margin_of(scene)
        self._asked_for = tiling, exact_only
        self._max_events = max_events
        self._deadline = None if max_seconds is None else clock.monotonic() + max_seconds
        self._events = 0
        self._proved: QQ = scene._start
        self._passed: EventTime | None = None
        self._met: tuple[AlgebraicNumber, dict[str, Body]] | None = None
        self._pending: deque[Event] = deque()
        self._forget_space()
        self._living: LivingScene | None = None
        touches, overlaps = initial_touches(scene)
        if overlaps:
            self._end_with(contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps))
        else:
            try:
                kinetic = plan.start(scene._start, exact_only=exact_only)
            except BudgetExceeded as spent:
                spent.reached = scene.start
                raise
            self._living = LivingScene(scene, kinetic, tiling, exact_only=exact_only)

    @property
    def scene(self) -> Scene:
        """The bodies with their current motions; the scene starts at the last change of motion."""
        return self._given[0] if self._living is None else self._living.scene

    @property
    def name(self) -> str:
        """The name of the tiling."""
        return self._given[1] if self._living is None else self._living.kinetic.name

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        if self._living is None:
            return AlgebraicNumber(self.scene._start)
        return self._living.kinetic.now

    @property
    def kinetic(self) -> Tiling | None:
        """The kinetic tiling, for `exactpt.render`; None if bodies touch at the start.

        At a contact it is the tiling just before.
        """
        return None if self._living is None else self._living.kinetic

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the run so far, see `exactpt.simulation.report`."""
        changes = 0 if self._living is None else self._living.changes
        data = report(self.scene, self.kinetic, self._counts())
        return data | {"contacts": self.contacts, "plans": changes}

    def _counts(self) -> Counts:
        """The counts of decisions of the run so far."""
        if self._living is None:
            return Counts(0, 0, {})
        return self._living.kinetic.vertices.counters.now()

    # Time

    def run(
        self,
        until: Rational | None = None,
        *,
        on_contact: Callable[[Self, Contact], object] | None = None,
        margin: Rational | None = None,
    ) -> Iterator[Event]:
        """Process the events up to and including a time, by default the end of the span.

        Yields every event after it has been processed. Without ``on_contact`` the first contact is
        the last event. With it, the simulation returns to a rational time just before each contact
        and calls ``on_contact`` with itself and the `Contact`. If that changes anything
        (`set_motion`, `set_motions`, `add`, `remove`), the run continues, until the same contact
        recurs while its bodies still have the same motions; otherwise it ends at the contact.

        Args:
            until: the last time, rational.
            on_contact: the response, which may change motions: bounce, stop or slide.
            margin: maximum distance in time between the callback and the contact; by default
                about 2^-80 of the time span. The callback happens at the last multiple of the
                margin before the contact, whose numbers are short; or later, if another event
                happens between that time and the contact.

        Raises:
            BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
            InputError: if the margin is not positive, or ``until`` is before now.
        """
        end = self.scene._end if until is None else min(rational(until), self.scene._end)
        grid = self._margin if margin is None else rational(margin)
        if grid <= 0:
            raise InputError(f"the margin before contacts is not positive: {grid}")
        if self.contact is None and self.now.compare_rational(end) > 0:
            raise InputError(f"until: t = {show(end)} is over, it is t = {float(self.now)!r} now")
        while True:
            if self.contact is None:
                self._check_time()
            if self._pending:
                self._count(1)
                yield self._pending.popleft()
            elif self.contact is not None or not self._advance(end, on_contact, grid):
                return

    def step(self) -> list[Event]:
        """Process the events of the next time at which there are any.

        Returns:
            The events; an empty list if there are no more, and then the current time is the end.

        Raises:
            BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
        """
        while not self._pending and self.contact is None:
            self._check_time()
            if not self._advance(self.scene._end, None, QQ(1)):
                break
        self._count(len(self._pending))
        events = list(self._pending)
        self._pending.clear()
        return events

    def run_to_contact(self) -> Contact | None:
        """The first contact in the time span, or None; the fastest way to find it.

        Raises:
            BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
        """
        if self.contact is None:
            kinetic = self._alive().kinetic
            self._forget_space()
            try:
                for _ in kinetic.run():
                    self._passed = kinetic.certifier.now
                    self._count(1)
                    self._check_time()
            except ContactFound as found:
                self._end_with(contact_of(self.scene, kinetic.now, found.touches))
        return self.contact

    def _advance(
        self, end: QQ, on_contact: Callable[[Self, Contact], object] | None, grid: QQ
    ) -> bool:
        """Advance to the next time with events; False if there is none up to the end."""
        living = self._alive()
        self._forget_space()
        try:
            events = living.kinetic.advance(end)
        except ContactFound as found:
            contact = contact_of(self.scene, living.kinetic.now, found.touches)
            if on_contact is None:
                self._end_with(contact)
            elif self._is_met(contact):
                self.contact = contact
            else:
                self._meet(contact, on_contact, grid)
            return True
        self._passed = living.kinetic.certifier.now
        if events is None:
            return False
        self._pending.extend(map(living.named, events))
        return True

    def _meet(
        self, contact: Contact, on_contact: Callable[[Self, Contact], object], grid: QQ
    ) -> None:
        """Call back just before a contact; unless something is changed, the contact takes place."""
        living = self._alive()
        kinetic = living.kinetic
        kinetic.retreat(grid)
        self.contacts += 1
        self._pending.append(Event(contact.time, "contact"))
        self._met = contact.time, self._plans_in(contact)
        changes = living.changes
        on_contact(self, contact)
        if living.changes == changes:
            self.contact = contact
            with suppress(ContactFound):
                kinetic.advance(self.scene._end)

    def _plans_in(self, contact: Contact) -> dict[str, Body]:
        names = {name for pair in contact.pairs for name in (pair.body, pair.other)}
        return {name: self._alive().body(name) for name in names}

    def _is_met(self, contact: Contact) -> bool:
        """Whether this is the last contact again, with the same motions of its bodies."""
        if self._met is None or self._met[0].compare(contact.time) != 0:
            return False
        now, then = self._plans_in(contact), self._met[1]
        return now.keys() == then.keys() and all(now[name] is then[name] for name in now)

    def _end_with(self, contact: Contact) -> None:
        self.contact = contact
        self.contacts += 1
        self._pending.append(Event(contact.time, "contact"))

    def _count(self, events: int) -> None:
        """Count events that are to be reported; a contact is reported in any case."""
        self._events += events
        most = self._max_events
        if most is not None and self._events > most and self.contact is None:
            raise BudgetExceeded("the number of events is used up", self.reached())

    def _check_time(self) -> None:
        if self._deadline is not None and clock.monotonic() > self._deadline:
            raise BudgetExceeded("the time is used up", self.reached())

    def reached(self) -> Fraction:
        """A rational time, at most now, up to which there is provably no contact."""
        now = self.now
        return now.low if now.is_rational else now.canonical_interval()[0]

    def passed(self) -> Fraction:
        """As `reached`, but computed at once, even in the middle of an event."""
        if self._living is None or self._passed is None:
            return fraction(self._proved)
        frame = self._living.kinetic.vertices.frame
        return fraction(max(self._proved, frame.exact_time(self._passed.low)))

    def _change(self, events: Iterable[Event]) -> None:
        """Report the events that a change of motions or bodies at a rational time has caused."""
        self._pending.extend(events)
        self._proved, self._passed = self.now._low, None  # times refer to the previous tiling

    def _alive(self) -> LivingScene:
        if self._living is None:
            raise InputError("the bodies touch at the start: there is no tiling")
        return self._living

    def _asked(self) -> Tiling:
        if self.contact is not None:
            raise InputError(f"no tiling at a contact, t = {float(self.contact.time)!r}")
        return self._alive().kinetic


def _margin_of(scene: Scene) -> QQ:
    """About 2^-80 of the time span."""
    span = scene._end - scene._start
    return power_of_two(span.numerator.bit_length() - span.denominator.bit_length() - 80)
