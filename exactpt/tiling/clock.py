"""The clock of a tiling: it advances to the next event and retreats to before a contact."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, final

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.certificates.table import CertificateTable
from exactpt.errors import AuditError
from exactpt.indices import CertificateId
from exactpt.kernel.algebraic import AlgebraicNumber, multiple_before, rational_between
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.motion.normalization import Normalization
from exactpt.motion.vertex import MovingBody

MAX_TIMES: Final = 15
"""Maximum number of times just after now; number k is within a distance of 2^-(2^k)."""


@final
class Clock:
    """The current time of a run.

    Attributes:
        certifier: holds the current time.
        table: holds the times of failure.
    """

    def __init__(
        self, certifier: Certifier, table: CertificateTable, normalization: Normalization
    ) -> None:
        self.certifier: Certifier = certifier
        self.table: CertificateTable = table
        self._normalization: Normalization = normalization
        # What `retreat` restores: the previous event time, and the entries of the current one.
        self._undo: tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None = None
        self._until: tuple[QQ, float] = (certifier.end, normalization.time(certifier.end)[0])

    def next_number(self) -> AlgebraicNumber | None:
        """Return the exact time of the next failure; None if there is none."""
        popped = self.table.pending.pop()
        if popped is None:
            return None
        time, entries = popped
        number = time.exact or self.certifier.resolve(time)
        self._put_back(entries)
        return number

    def is_after(self, t: QQ) -> bool:
        """Return True if now is after a rational time; exact, mostly by enclosures."""
        low, high = self._normalization.time(t)
        if self.certifier.now_low > high:
            return True
        if self.certifier.now_high < low:
            return False
        return self.certifier.exact_now.compare_rational(t) > 0

    def pop(self, until: QQ) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None:
        """Take the next failures off the queue, with their time; None if after ``until``."""
        popped = self.table.pending.pop()
        if popped is not None:
            time, entries = popped
            if time.high > self.low_of(until):
                number = time.exact or self.certifier.resolve(time)
                if number.compare_rational(until) > 0:
                    self._put_back(entries)
                    return None
        return popped

    def low_of(self, until: QQ) -> float:
        """Return a lower bound of a rational time, normalised."""
        if until is not self._until[0]:
            self._until = (until, self._normalization.time(until)[0])
        return self._until[1]

    def enter(self, time: EventTime, entries: list[tuple[CertificateId, EventTime]]) -> None:
        """Advance to a time at which some certificates fail."""
        self._undo = self.certifier.now, entries
        self.certifier.move_to(time, [t for _, t in entries])

    def move_to(self, t: QQ) -> None:
        """Move to a rational time; no unprocessed event may lie before it."""
        low, high = self._normalization.time(t)
        self.certifier.move_to(EventTime(low, high, -1, -1, -1, AlgebraicNumber(t)), [])

    def forbid_retreat(self) -> None:
        """Exclude a retreat: now is not a contact, and changes follow that stay."""
        self._undo = None

    def retreat(self, grid: QQ) -> QQ:
        """See `Tiling.retreat`."""
        if self._undo is None:
            raise AuditError("there is no contact to retreat from")
        (time_before, entries), contact = self._undo, self.certifier.exact_now
        before = time_before.exact or self.certifier.resolve(time_before)
        self._undo = None
        self._put_back(entries)
        t = multiple_before(contact, grid)
        if before.compare_rational(t) >= 0:
            t = rational_between(before, contact)
        self.move_to(t)
        return t

    def times_just_after(self) -> Iterator[QQ]:
        """Rational times after now and before the next failure, nearer and nearer to now.

        At the end of the time span they are beyond it: trajectories continue there. The times do
        not depend on how far comparisons have refined the number of now: a tiling that is built at
        one of them has the same half-edges in every run.

        Raises:
            AuditError: if the next failure is not after now, so that no such time exists.
        """
        now, following, later = self.certifier.exact_now, self.next_number(), self.certifier.end
        if now.compare_rational(later) >= 0:
            later = rational_between(now, AlgebraicNumber(later + 1))
        elif following is not None and following.compare_rational(later) < 0:
            if following.compare(now) <= 0:
                raise AuditError("the next failure in the queue is not after the current event")
            later = rational_between(now, following)
        low, _ = now.exact_canonical_interval()
        for k in range(MAX_TIMES):
            half = (later - low) * power_of_two(-(1 << k) - 1)
            at_least_now = low if now.is_rational else multiple_before(now, half) + half
            yield rational_between(now, AlgebraicNumber(at_least_now + half))

    def end_of_piece(self, moving: MovingBody) -> EventTime | None:
        """Return the end of a body's current piece of motion; None if it is after the time span."""
        if moving.until is None or moving.until > self.certifier.end:
            return None
        low, high = self._normalization.time(moving.until)
        return EventTime(low, high, -1, -1, -1, AlgebraicNumber(moving.until))

    def _put_back(self, entries: list[tuple[CertificateId, EventTime]]) -> None:
        for certificate, time in entries:
            self.table.pending.schedule(certificate, time)
