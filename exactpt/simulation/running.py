"""The run of a scene: from event to event, up to the first contact or beyond."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from fractions import Fraction
from typing import TypeAlias, final

from exactpt.collision.driver import MANY
from exactpt.errors import AuditError, BudgetExceeded, InputError, carry, carrying
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import Budget
from exactpt.kernel.numbers import QQ, Rational, power_of_two, rational, show
from exactpt.kernel.rounding import check_rounding
from exactpt.pairs.contact import Contact, contact_of
from exactpt.pairs.start import initial_touches, near_pairs
from exactpt.scene.scene import Scene
from exactpt.simulation.contexts import Guard, OneThread
from exactpt.simulation.event import Event
from exactpt.simulation.history import Log
from exactpt.simulation.living import Choice, LivingScene
from exactpt.simulation.met import Met, met
from exactpt.simulation.recording import Recorder
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.start import plan_tiling, proved_until

__all__ = ["Response", "Run", "begin"]

Response: TypeAlias = "Callable[[Contact], object]"
"""Called just before a contact; it may change motions."""


@final
class Run:
    """A scene whose time passes, see `exactpt.Simulation`.

    Attributes:
        living: the scene with its tiling.
        margin: maximum distance in time between a response and its contact.
        pending: events that have been processed and not been reported.
        contact: the contact that has ended the run, or None.
        contacts: number of contacts so far.
        met: the last contact with a response.
        recorder: what records the run, or None.
        log: what remembers the run, or None.
        alone: the context in which a thread uses the run.
    """

    def __init__(self, living: LivingScene, budget: Budget) -> None:
        self.living = living
        self.margin = _margin_of(living.scene)
        self.pending: deque[Event] = deque()
        self.contact: Contact | None = None
        self.contacts = 0
        self.met: Met | None = None
        self.recorder: Recorder | None = None
        self.log: Log | None = None
        self.alone = OneThread()
        self._budget = budget
        self._is_broken = False
        self._proved: QQ = living.scene._start

    # Time

    def events(
        self, until: Rational | None, respond: Response | None, margin: Rational | None
    ) -> Iterator[Event]:
        """The events up to and including a time, see `Simulation.run`."""
        last = self.living.scene._end
        end = last if until is None else min(rational(until), last)
        grid = self.margin if margin is None else rational(margin)
        if grid <= 0:
            raise InputError(f"the margin before contacts is not positive: {grid}")
        if self.contact is None and self.living.kinetic.is_after(end):
            now = float(self.living.now)
            raise InputError(f"until: t = {show(end)} is over, it is t = {now!r} now")
        while (event := self._next(end, respond, grid)) is not None:
            yield event

    def _next(self, end: QQ, respond: Response | None, grid: QQ) -> Event | None:
        """Return the next event up to a time; None if there is none."""
        pending, is_bounded = self.pending, self._budget.is_bounded
        with self.alone:
            while True:
                if is_bounded and self.contact is None:
                    self._check_time()
                if pending:
                    if is_bounded:
                        self._count(1)
                    return pending.popleft()
                if self.contact is not None or not self._advance(end, respond, grid):
                    return None

    def step(self) -> list[Event]:
        """The events of the next time at which there are any, see `Simulation.step`."""
        with self.alone:
            while not self.pending and self.contact is None:
                self._check_time()
                if not self._advance(self.living.scene._end, None, self.margin):
                    break
            self._count(len(self.pending))
            events = list(self.pending)
            self.pending.clear()
            return events

    def to_contact(self) -> Contact | None:
        """The first contact, see `Simulation.run_to_contact`."""
        with self.alone:
            if self.contact is None:
                self.check_whole()
                self._pass_to_contact(self.living.scene._end)
            return self.contact

    def _pass_to_contact(self, end: QQ) -> None:
        with self._guarded():
            try:
                if self.recorder is None and not self._budget.limits_events:
                    while self.living.kinetic.advance_many(end, MANY):
                        self._check_time()
                else:
                    while (events := self._pass(end)) is not None:
                        self._count(len(events))
                        self._check_time()
            except ContactFound as found:
                self._end_with(found)

    def _advance(self, end: QQ, respond: Response | None, grid: QQ) -> bool:
        """Advance to the next time with events; False if there is none up to the end."""
        self.check_whole()
        try:
            with self._budget.held():
                events = self._pass(end)
                if events is None:
                    return False
                self.pending.extend(self.living.teller.told(events))
                return True
        except ContactFound as contact:
            found = contact.with_traceback(None)  # whose frames would keep it, and all else
        except BaseException as error:
            self._failed(error)
            raise
        if respond is None:
            with self._guarded():
                self._end_with(found)
        else:
            self._answer(found, respond, grid)
        return True

    def _pass(self, end: QQ) -> list[TilingEvent] | None:
        """Advance the tiling to its next event up to a time, see `Tiling.advance`."""
        recorder, kinetic = self.recorder, self.living.kinetic
        if recorder is None:
            return kinetic.advance(end)
        recorder.begin(self.living.scene, kinetic)
        events = kinetic.advance(end)
        recorder.advanced()
        return events

    def _guarded(self) -> Guard:
        """A context in which the budget holds, and a broken invariant carries the scene."""
        return Guard(self._budget.held(), self._failed)

    def _failed(self, error: BaseException) -> None:
        """Note an error inside of the tiling.

        Interrupted elsewhere than between two events, the tiling is left in the middle of a
        change.
        """
        if isinstance(error, AuditError):
            carry(error, self._scene)
        elif isinstance(error, BudgetExceeded):
            if error.reached is None:  # not between two events
                self._is_broken = True
                error.reached = self.passed()
        elif not isinstance(error, InputError):  # Ctrl-C, no memory, an error of the user's code
            self._is_broken = True

    def check_whole(self) -> None:
        """Check that the run has not been interrupted in the middle of an event.

        Raises:
            InputError: if it has.
            RoundingError: see `check_rounding`.
        """
        check_rounding()
        if self._is_broken:
            raise InputError("the run was interrupted in the middle of an event: it cannot go on")

    # Contacts

    def _contact(self, found: ContactFound) -> Contact:
        return contact_of(self.living.scene, self.living.now, found.touches)

    def end_with(self, contact: Contact) -> None:
        """End with a contact, the last event."""
        self.contact = contact
        self._report(contact)

    def _end_with(self, found: ContactFound) -> None:
        """End with a contact of the tiling, which is there now."""
        self._record(found)
        self.end_with(self._contact(found))

    def _record(self, found: ContactFound) -> None:
        if self.recorder is not None:
            self.recorder.met(found.touches)

    def _answer(self, found: ContactFound, respond: Response, grid: QQ) -> None:
        """Respond just before a contact; unless something is changed, it takes place."""
        living, kinetic = self.living, self.living.kinetic
        with self._guarded():
            contact = self._contact(found)
        ahead = met(contact, living)
        if self.met is not None and ahead.is_again(self.met):
            self._record(found)
            self.contact = contact
            return
        with self._guarded():
            kinetic.retreat(grid)
        self._report(contact)
        self.met = ahead
        changes = living.changes
        respond(contact)
        check_rounding()
        if living.changes == changes:
            self.contact = contact
            with self._guarded(), suppress(ContactFound):
                kinetic.advance(living.scene._end)
            self._record(found)

    def end_record(self) -> None:
        """Record nothing else, see `Simulation.end_proof`."""
        with self.alone:
            recorder, self.recorder = self.recorder, None
            if recorder is not None:
                self.check_whole()
                recorder.finish()

    def _report(self, contact: Contact) -> None:
        self.contacts += 1
        if self.log is not None:
            self.log.met(contact)
        self.pending.append(Event(contact.time, "contact"))

    # Changes, and how far it is

    def change(self, how: Callable[[LivingScene], Iterable[Event]]) -> None:
        """Change motions or bodies at a rational time, and report the events that this causes.

        Raises:
            BudgetExceeded: if the time or memory is used up; the run cannot go on then.
            InputError: if the run has ended with a contact.
        """
        with self.alone:
            if self.contact is not None:
                raise InputError(
                    f"the run has ended with a contact at t = {float(self.contact.time)!r}"
                )
            self.check_whole()
            with self._guarded():
                self.pending.extend(how(self.living))
            self._proved = self.living.now._low
            if self.log is not None:
                self.log.changed(self._proved, self.living.bodies)
            if self.recorder is not None:
                self.recorder.change(self._proved)

    def _scene(self) -> Scene:
        return self.living.scene

    def reached(self) -> Fraction | None:
        """See `Simulation.reached`."""
        if self.contact is not None or self._is_broken:
            return self.passed()
        now = self.living.now
        return now.low if now.is_rational else now.canonical_interval()[0]

    def passed(self) -> Fraction | None:
        """See `Search.passed`."""
        tiling = self.living.tiling
        return None if tiling is None else proved_until(tiling, self._proved)

    def rest(self) -> tuple[int | None, float | None, int | None]:
        """The events, seconds and memory that are left, None for no limit."""
        return self._budget.rest()

    def _count(self, events: int) -> None:
        """Count events that are to be reported; a contact is reported in any case."""
        if not self._budget.spend(events) and self.contact is None:
            raise BudgetExceeded("the number of events is used up", self.reached())

    def _check_time(self) -> None:
        if self._budget.is_late():
            raise BudgetExceeded("the time is used up", self.reached())


def begin(
    scene: Scene,
    tiling: str,
    budget: Budget,
    *,
    exact_only: bool,
    recorder: Recorder | None = None,
    log: Log | None = None,
) -> Run:
    """The run of a scene from its start, see `exactpt.Simulation`."""
    with carrying(lambda: scene), budget.held():
        plan = plan_tiling(scene, tiling, scene._start)
        choice = Choice(tiling, plan.name, exact_only)
        near = None if exact_only else near_pairs(plan.vertices, scene._start)
        touches, overlaps = initial_touches(scene, near)
        if overlaps:
            run = Run(LivingScene(scene, None, choice), budget)
            run.log = log
            run.end_with(contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps))
            if recorder is not None:
                recorder.touching(scene)
            return run
        try:
            kinetic = plan.start(scene._start, exact_only=exact_only)
        except BudgetExceeded as spent:
            spent.reached = scene.start
            raise
        run = Run(LivingScene(scene, kinetic, choice), budget)
        run.recorder, run.log = recorder, log
        return run


def _margin_of(scene: Scene) -> QQ:
    """About 2^-80 of the time span."""
    span = scene._end - scene._start
    return power_of_two(span.numerator.bit_length() - span.denominator.bit_length() - 80)
