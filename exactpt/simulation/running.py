"""The run of a scene: from event to event, up to the first contact or beyond."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from threading import RLock
from typing import TypeAlias, final

from exactpt.errors import AuditError, BudgetExceeded, InputError, carry, carrying
from exactpt.filters.rounding import check_rounding
from exactpt.kernel.budget import Budget
from exactpt.kernel.numbers import QQ, Rational, power_of_two, rational, show
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.simulation.event import RunEvent, events_of
from exactpt.simulation.history import Log
from exactpt.simulation.mutable_scene import Choice, MutableScene
from exactpt.simulation.reported_contact import ReportedContact, with_motions_of
from exactpt.tiling.driver import Driver, Observer
from exactpt.tiling.start import plan_tiling

Response: TypeAlias = "Callable[[Contact], object]"
"""Called just before a contact; it may change motions."""


@final
class OneThread:
    """A context for one thread at a time, in which that thread may enter it again.

    Another thread is refused, not kept waiting: the order of their events would depend on chance.

    Raises:
        InputError: on entering, if another thread is inside.
    """

    __slots__ = ("_lock",)

    def __init__(self) -> None:
        self._lock = RLock()

    def __enter__(self) -> None:
        if not self._lock.acquire(blocking=False):
            raise InputError(
                "the simulation is in use by another thread: wait for it, or use a copy()"
            )

    def __exit__(self, *_error: object) -> None:
        self._lock.release()


@final
class Run:
    """A scene whose time passes, see `exactpt.Simulation`.

    Attributes:
        mutable: the scene with its tiling.
        begun: the time at which the run began, before any change.
        margin: maximum distance in time between a response and its contact.
        pending: events that have been processed and not been reported.
        contact: the contact that has ended the run, or None.
        contacts: number of contacts so far.
        reported: the last contact with a response.
        driver: drives the tiling; its observers record the run.
        log: what remembers the run, or None.
        alone: the context in which a thread uses the run.
    """

    def __init__(
        self,
        mutable: MutableScene,
        budget: Budget,
        observers: Sequence[Observer] = (),
        *,
        begun: QQ | None = None,
    ) -> None:
        self.mutable = mutable
        self.driver = Driver(mutable, observers=observers, budget=budget)
        scene = mutable.scene
        self.begun = scene.exact_start if begun is None else begun
        self.margin = _margin_of(self.begun, scene.exact_end)
        self.pending: deque[RunEvent] = deque()
        self.contact: Contact | None = None
        self.contacts = 0
        self.reported: ReportedContact | None = None
        self.log: Log | None = None
        self.alone = OneThread()
        self._budget = budget

    # Time

    def events(
        self, until: Rational | None, respond: Response | None, margin: Rational | None
    ) -> Iterator[RunEvent]:
        """Yield the events up to and including a time, see `Simulation.run`."""
        last = self.mutable.scene.exact_end
        end = last if until is None else min(rational(until), last)
        grid = self.margin if margin is None else rational(margin)
        if grid <= 0:
            raise InputError(f"the margin before contacts is not positive: {show(grid)}")
        if self.contact is None and self.mutable.kinetic.is_after(end):
            now = float(self.mutable.now)
            raise InputError(f"until: t = {show(end)} is over, it is t = {now!r} now")
        while (event := self._next(end, respond, grid)) is not None:
            yield event

    def _next(self, end: QQ, respond: Response | None, grid: QQ) -> RunEvent | None:
        """Return the next event up to a time; None if there is none."""
        pending, is_bounded = self.pending, self._budget.is_bounded
        with self.alone:
            while True:
                if is_bounded:
                    self._spend(min(1, len(pending)))
                if pending:
                    return pending.popleft()
                if self.contact is not None or not self._advance(end, respond, grid):
                    return None

    def step(self) -> list[RunEvent]:
        """Return the events of the next time at which there are any, see `Simulation.step`."""
        with self.alone:
            while not self.pending and self.contact is None:
                self._spend(0)
                if not self._advance(self.mutable.scene.exact_end, None, self.margin):
                    break
            self._spend(len(self.pending))
            events = list(self.pending)
            self.pending.clear()
            return events

    def to_contact(self) -> Contact | None:
        """Return the first contact, see `Simulation.run_to_contact`."""
        with self.alone:
            if self.contact is None:
                self.check_whole()
                with self._guarded():
                    contact = self.driver.run(self.mutable.scene.exact_end)
                    if contact is not None:
                        self.end_with(contact)
            return self.contact

    def _advance(self, end: QQ, respond: Response | None, grid: QQ) -> bool:
        """Advance to the next time with events; False if there is none up to the end."""
        self.check_whole()
        try:
            with self._budget.held():
                events = self.driver.advance(end)
                if events is not None:
                    self.pending.extend(events_of(self.mutable.kinetic, events))
                    return True
        except BaseException as error:
            self._failed(error)
            raise
        if self.driver.touches is None:
            return False
        if respond is None:
            with self._guarded():
                self.end_with(self.driver.meet())
        else:
            self._answer(respond, grid)
        return True

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """Return a context in which the budget holds; a broken invariant carries the scene."""
        try:
            with self._budget.held():
                yield
        except BaseException as error:
            self._failed(error)
            raise

    def _failed(self, error: BaseException) -> None:
        """Note an error inside of the tiling.

        Interrupted elsewhere than between two events, the tiling is left in the middle of a
        change.
        """
        if isinstance(error, AuditError):
            carry(error, self._scene)
        elif isinstance(error, BudgetExceeded):
            if error.reached is None:  # not between two events
                self.driver.is_broken = True
                error.reached = self.driver.contact_free_until()
        elif not isinstance(error, InputError):  # Ctrl-C, no memory, an error of the user's code
            self.driver.is_broken = True

    def check_whole(self) -> None:
        """Check that the run has not been interrupted in the middle of an event.

        Raises:
            InputError: if it has.
            RoundingError: see `check_rounding`.
        """
        check_rounding()
        if self.driver.is_broken:
            raise InputError("the run was interrupted in the middle of an event: it cannot go on")

    # Contacts

    def end_with(self, contact: Contact) -> None:
        """End with a contact, the last event."""
        self.contact = contact
        self._report(contact)

    def _answer(self, respond: Response, grid: QQ) -> None:
        """Respond just before a contact; unless something is changed, it takes place."""
        mutable, driver = self.mutable, self.driver
        with self._guarded():  # all of it: the run cannot go on if the contact was not dealt with
            contact = driver.contact_ahead()
            ahead = with_motions_of(contact, mutable)
            if self.reported is not None and ahead.is_again(self.reported):
                self.contact = driver.meet()
                return
            driver.tiled.kinetic.retreat(grid)
        self._report(contact)
        self.reported = ahead
        changes = mutable.changes
        respond(contact)
        check_rounding()
        if mutable.changes == changes:
            self.contact = contact
            with self._guarded():
                driver.advance(mutable.scene.exact_end)
                driver.meet()

    def end_record(self) -> None:
        """Record nothing else, see `Simulation.end_proof`."""
        with self.alone:
            observers, self.driver.observers = self.driver.observers, []
            if observers:
                self.check_whole()
            for observer in observers:
                observer.finish()

    def _report(self, contact: Contact) -> None:
        self.contacts += 1
        if self.log is not None:
            self.log.add_contact(contact)
        self.pending.append(RunEvent(contact.time, "contact"))

    # Changes, and how far it is

    def change(self, how: Callable[[MutableScene], Iterable[RunEvent]]) -> None:
        """Change motions or bodies at a rational time, and report the events that this causes.

        Raises:
            BudgetExceeded: if the time or memory is used up; the run cannot continue.
            InputError: if the run has ended with a contact.
        """
        with self.alone:
            if self.contact is not None:
                raise InputError(
                    f"the run has ended with a contact at t = {float(self.contact.time)!r}"
                )
            self.check_whole()
            with self._guarded():
                self.pending.extend(how(self.mutable))
            t = self.mutable.now.exact_low
            if self.log is not None:
                self.log.changed(t, self.mutable.bodies)
            self.driver.change(t)

    def _scene(self) -> Scene:
        return self.mutable.scene

    def reached(self) -> Fraction | None:
        """See `Simulation.reached`."""
        return self.driver.reached() if self.contact is None else self.driver.contact_free_until()

    def rest(self) -> tuple[int | None, float | None, int | None]:
        """Return the events, seconds and memory that are left, None for no limit."""
        return self._budget.rest()

    def _spend(self, events: int) -> None:
        """Count events that are to be reported; a contact is reported in any case."""
        if self.contact is None:
            self.driver.spend(events)


def begin(
    scene: Scene,
    tiling: str,
    budget: Budget,
    *,
    exact_only: bool,
    fan: bool = False,
    observers: Sequence[Observer] = (),
    log: Log | None = None,
) -> Run:
    """Return the run of a scene from its start, see `exactpt.Simulation`."""
    with carrying(lambda: scene), budget.held():
        plan = plan_tiling(scene, tiling, scene.exact_start, fan=fan)
        mutable = MutableScene(scene, None, Choice(tiling, plan.name, exact_only, fan))
        run = Run(mutable, budget, observers)
        run.log = log
        contact = run.driver.start(plan, exact_only=exact_only)
        if contact is not None:
            run.end_with(contact)
        return run


def _margin_of(begun: QQ, end: QQ) -> QQ:
    """About 2^-80 of the time span."""
    span = end - begun
    return power_of_two(span.numerator.bit_length() - span.denominator.bit_length() - 80)
