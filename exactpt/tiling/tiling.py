"""What every kinetic tiling is: certificates, a queue of their failures, time that passes."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Self

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, EventTime, ExactQueue
from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, multiple_before, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import MovingBody, Vertices
from exactpt.tiling.events import Stats, TilingEvent

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["Tiling"]


class Tiling:
    """A tiling of the free space that is kept up to date as time goes on.

    Attributes:
        vertices: the moving vertices.
        certifier: certificates and the current time.
        queue: pending failures.
        stats: counts.
    """

    name = ""

    def __init__(self, vertices: Vertices, certifier: Certifier, stats: Stats) -> None:
        self.vertices: Vertices = vertices
        self.certifier: Certifier = certifier
        counters = vertices.counters
        self.queue: EventQueue = (
            ExactQueue(certifier, counters)
            if certifier.exact_only
            else EventQueue(certifier, counters)
        )
        self.stats: Stats = stats
        self._events: list[TilingEvent] = []
        # The time before the last one with events, and these: what `retreat` restores.
        self._undo: tuple[EventTime, list[tuple[int, EventTime]]] | None = None
        self._until: tuple[QQ, float] = (certifier.end, vertices.frame.time(certifier.end)[0])

    @classmethod
    @abstractmethod
    def begin(cls, vertices: Vertices, start: QQ, end: QQ, *, exact_only: bool = False) -> Self:
        """The tiling just after a time at which the bodies are disjoint.

        Args:
            vertices: of the bodies, from ``start`` on.
            start: the current time.
            end: the last time of interest.
            exact_only: decide everything by exact arithmetic.
        """

    @abstractmethod
    def mesh_after(self) -> Mesh:
        """The tiling just after the current time."""

    @classmethod
    @abstractmethod
    def mesh_at(cls, instant: PredicatesAt) -> Mesh:
        """The tiling of an instant."""

    @abstractmethod
    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event."""

    def take_over_counts(self, other: Tiling) -> None:
        """Go on counting where another tiling of the same run has stopped."""
        other.stats.most = max(other.stats.most, self.stats.most)
        other.stats.flips += self.stats.flips
        self.stats = other.stats
        self.certifier.made += other.certifier.made
        self.certifier.skipped += other.certifier.skipped
        self.certifier.zeros += other.certifier.zeros
        self.vertices.counters.add(other.vertices.counters.now())

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("the tiling of a run is copied and pickled with its simulation")

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        return self.certifier.exact_now

    def next_time(self) -> EventTime | None:
        """When the next certificates fail; the queue keeps them."""
        popped = self.queue.pop()
        if popped is None:
            return None
        time, entries = popped
        for slot, its_time in entries:
            self.queue.schedule(slot, its_time)
        return time

    def next_number(self) -> AlgebraicNumber | None:
        """When the next certificates fail, exactly."""
        time = self.next_time()
        return None if time is None else time.exact or self.certifier.resolve(time)

    def run(self, until: QQ | None = None) -> Iterator[TilingEvent]:
        """Process all events up to and including a time (default: the end of the span).

        Raises:
            ContactFound: at the first contact.
        """
        end = self.certifier.end if until is None else min(until, self.certifier.end)
        while (events := self.advance(end)) is not None:
            yield from events

    def advance(self, until: QQ) -> list[TilingEvent] | None:
        """Process the events of the next time, if that is not after ``until``.

        Returns:
            The events (perhaps none that matter outside); None if there are no more, and
            then the current time is ``until``.

        Raises:
            ContactFound: if there is a contact at that time.
        """
        if until is not self._until[0]:
            self._until = (until, self.vertices.frame.time(until)[0])
        popped = self.queue.pop()
        if popped is not None:
            time, entries = popped
            if time.high > self._until[1]:
                number = time.exact or self.certifier.resolve(time)
                if number.compare_rational(until) > 0:
                    for slot, its_time in entries:
                        self.queue.schedule(slot, its_time)
                    popped = None
        if popped is None:
            self._move_to(until)
            return None
        self._process(*popped)
        return self._reported()

    def retreat(self, grid: QQ) -> QQ:
        """After `ContactFound`: go back to a rational time just before the contact.

        Args:
            grid: the time is the last multiple of it before the contact; or, if an event
                is in between, a dyadic rational after that.

        Returns:
            The time. The tiling is the one that leads up to the contact.
        """
        if self._undo is None:
            raise AuditError("there is no contact to go back from")
        (time_before, entries), contact = self._undo, self.now
        before = time_before.exact or self.certifier.resolve(time_before)
        self._undo = None
        for slot, time in entries:
            self.queue.schedule(slot, time)
        t = multiple_before(contact, grid)
        if before.compare_rational(t) >= 0:
            t = rational_between(before, contact)
        self._move_to(t)
        return t

    @abstractmethod
    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """Let bodies go on by other plans; work for their certificates alone.

        Args:
            plans: by the number of the body, what it is from now on. Its positions now are
                those that it has.
            t: now.

        Returns:
            What changes at once.
        """

    def _move_to(self, t: QQ) -> None:
        """Let a rational time be now; nothing happens up to it that has not been processed."""
        low, high = self.vertices.frame.time(t)
        self.certifier.move_to(EventTime(low, high, -1, -1, -1, AlgebraicNumber(t)), [])

    def _schedule_end(self, moving: MovingBody, slot: int) -> None:
        """Schedule the end of a body's current piece, if that is not after the last time."""
        if moving.until is None or moving.until > self.certifier.end:
            self.queue.cancel(slot)
            return
        low, high = self.vertices.frame.time(moving.until)
        exact = AlgebraicNumber(moving.until)
        self.queue.schedule(slot, EventTime(low, high, -1, -1, -1, exact))

    def _record(
        self,
        kind: str,
        removed: tuple[tuple[int, int], ...],
        added: tuple[tuple[int, int], ...],
    ) -> None:
        """Note a change."""
        self.stats.count(kind)
        self._events.append(TilingEvent(self.certifier.now, kind, removed, added))

    def _reported(self) -> list[TilingEvent]:
        events, self._events = self._events, []
        return events

    @abstractmethod
    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        """Let all events of one time happen."""
