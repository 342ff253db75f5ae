"""The time of a tiling: how it moves on to what fails next, and back to before a contact."""

from __future__ import annotations

from typing import final

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.certificates.table import CertificateTable
from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, multiple_before, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.frame import Frame
from exactpt.motion.vertices import MovingBody

__all__ = ["Clock"]


@final
class Clock:
    """The current time of a run.

    Attributes:
        certifier: it knows the current time.
        table: it knows what fails when.
    """

    def __init__(self, certifier: Certifier, table: CertificateTable, frame: Frame) -> None:
        self.certifier: Certifier = certifier
        self.table: CertificateTable = table
        self._frame: Frame = frame
        # The time before the last one with events, and these: what `retreat` restores.
        self._undo: tuple[EventTime, list[tuple[int, EventTime]]] | None = None
        self._until: tuple[QQ, float] = (certifier.end, frame.time(certifier.end)[0])

    def next_time(self) -> EventTime | None:
        """When the next certificates fail; the queue keeps them."""
        popped = self.table.pending.pop()
        if popped is None:
            return None
        time, entries = popped
        self._put_back(entries)
        return time

    def next_number(self) -> AlgebraicNumber | None:
        """When the next certificates fail, exactly."""
        time = self.next_time()
        return None if time is None else time.exact or self.certifier.resolve(time)

    def pop(self, until: QQ) -> tuple[EventTime, list[tuple[int, EventTime]]] | None:
        """The next time at which certificates fail, and these; None if it is after ``until``."""
        if until is not self._until[0]:
            self._until = (until, self._frame.time(until)[0])
        popped = self.table.pending.pop()
        if popped is not None:
            time, entries = popped
            if time.high > self._until[1]:
                number = time.exact or self.certifier.resolve(time)
                if number.compare_rational(until) > 0:
                    self._put_back(entries)
                    return None
        return popped

    def enter(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        """Let the time at which some certificates fail be now."""
        self._undo = self.certifier.now, entries
        self.certifier.move_to(time, [(t.a, t.b, t.c) for _, t in entries])

    def move_to(self, t: QQ) -> None:
        """Let a rational time be now; nothing happens up to it that has not been processed."""
        low, high = self._frame.time(t)
        self.certifier.move_to(EventTime(low, high, -1, -1, -1, AlgebraicNumber(t)), [])

    def forget_way_back(self) -> None:
        """There is no contact at the current time, and something changes for good."""
        self._undo = None

    def retreat(self, grid: QQ) -> QQ:
        """See `Tiling.retreat`."""
        if self._undo is None:
            raise AuditError("there is no contact to go back from")
        (time_before, entries), contact = self._undo, self.certifier.exact_now
        before = time_before.exact or self.certifier.resolve(time_before)
        self._undo = None
        self._put_back(entries)
        t = multiple_before(contact, grid)
        if before.compare_rational(t) >= 0:
            t = rational_between(before, contact)
        self.move_to(t)
        return t

    def end_of_piece(self, moving: MovingBody) -> EventTime | None:
        """When a body's current piece of motion ends; None if that is after the last time."""
        if moving.until is None or moving.until > self.certifier.end:
            return None
        low, high = self._frame.time(moving.until)
        return EventTime(low, high, -1, -1, -1, AlgebraicNumber(moving.until))

    def _put_back(self, entries: list[tuple[int, EventTime]]) -> None:
        for certificate, time in entries:
            self.table.pending.schedule(certificate, time)
