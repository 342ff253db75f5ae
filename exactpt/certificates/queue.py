"""The event queue: event times as float enclosures, compared exactly only if two overlap.

The order of events is total and the same on every machine: by exact time, and at equal
times by slot. Cancelled events are dropped when they reach the top.
"""

from __future__ import annotations

from heapq import heappop, heappush
from typing import Final, Protocol, final

from mypy_extensions import i64, mypyc_attr

from exactpt.indices import CertificateId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.rounding import INFINITY

__all__ = ["EventQueue", "EventTime", "ExactQueue", "Resolver", "earlier"]


DAYS: Final = 1000
"""Maximum number of days: their lists are in a processor's cache together."""

SAMPLE: Final = 64
"""Number of events that tell the reach of a calendar."""

ROWS: Final = 16
"""Number of rows of slots: certificates of one kind (`exactpt.certificates.certificate`) have
slots in one row, those of neighbouring parts side by side; the row of an unused kind is empty."""


@final
@mypyc_attr(acyclic=True)
class EventTime:
    """An event time: a float enclosure, and the exact number on demand.

    Attributes:
        low, high: doubles, normalised as in the run: low <= time <= high.
        a, b, c: the function of which the time is a root, as known to the resolver.
        exact: the exact time, once it has been computed.
        crossing: whether the function changes sign then; otherwise it only touches 0.
    """

    __slots__ = ("a", "b", "c", "crossing", "exact", "high", "low")

    def __init__(
        self,
        low: float,
        high: float,
        a: i64,
        b: i64,
        c: i64,
        exact: AlgebraicNumber | None = None,
        crossing: bool = True,  # noqa: FBT001, FBT002 - positional for speed
    ) -> None:
        self.low: float = low
        self.high: float = high
        self.a: i64 = a
        self.b: i64 = b
        self.c: i64 = c
        self.exact: AlgebraicNumber | None = exact
        self.crossing: bool = crossing


def earlier(s: EventTime | None, t: EventTime | None) -> EventTime | None:
    """The earlier of two exact times, the first if they are equal; None counts as infinity."""
    if s is None or t is None or s.exact is None or t.exact is None:
        return s or t
    return t if t.exact.compare(s.exact) < 0 else s


class Resolver(Protocol):
    """Computes the exact times of events."""

    def resolve(self, time: EventTime) -> AlgebraicNumber:
        """The exact time, stored in ``time.exact``; the enclosure is narrowed likewise."""
        ...


class EventQueue:
    """A queue of event times with at most one pending event per slot.

    A calendar: a row of days of equal length. Most certificates are cancelled long before they
    fail; so an event is only noted by its slot on its day, and what is still pending when its
    day has come goes to a heap. What is later than the last day is not noted: the calendar is
    made anew at its end, and when most of its notes are of cancelled events.
    The day of an event grows with ``low`` (each rounding is monotone), so the heap holds all
    that begin before the next day.

    Source: R. Brown, Calendar queues, Communications of the ACM 31 (1988), 1220-1227.
    """

    def __init__(self, resolver: Resolver, counters: Counters) -> None:
        self._resolver = resolver
        self._counters: Counters = counters
        self._rows: list[list[EventTime | None]] = [[] for _ in range(ROWS)]
        self._count: int = 0
        self._heap: list[tuple[float, int, CertificateId, EventTime]] = []
        self._sequence: int = 0
        self._days: list[list[CertificateId]] = []
        self._next_day: float = 0.0
        self._first: float = 0.0
        self._per_day: float = 0.0
        self._notes: int = 0
        self._has_more: bool = False

    def __len__(self) -> int:
        return self._count

    def schedule(self, slot: CertificateId, time: EventTime) -> None:
        """Put an event into a slot, replacing the one there."""
        self._put(slot, time)
        self._note(slot, time)
        if self._notes > 4 * self._count + 256:
            self._make_calendar()

    def cancel(self, slot: CertificateId) -> None:
        """Empty a slot."""
        row, part = self._rows[slot % ROWS], slot // ROWS
        if part < len(row) and row[part] is not None:
            row[part] = None
            self._count -= 1

    def pending(self, slot: CertificateId) -> EventTime | None:
        """The time of the event in a slot, or None."""
        row, part = self._rows[slot % ROWS], slot // ROWS
        return row[part] if part < len(row) else None

    def slots(self) -> list[CertificateId]:
        """All slots with a pending event, in increasing order."""
        return sorted(
            [
                CertificateId(ROWS * part + kind)
                for kind, row in enumerate(self._rows)
                for part, time in enumerate(row)
                if time is not None
            ]
        )

    def _put(self, slot: CertificateId, time: EventTime) -> None:
        row, part = self._rows[slot % ROWS], slot // ROWS
        if part >= len(row):
            row += [None] * (part + 1 - len(row))
        if row[part] is None:
            self._count += 1
        row[part] = time

    def _note(self, slot: CertificateId, time: EventTime) -> None:
        """Note an event on its day, or in the heap if that has come; none after the last day."""
        day = (time.low - self._first) * self._per_day
        if not day >= self._next_day:  # nor if it is not a number
            self._push(slot, time)
        elif day < len(self._days):
            self._notes += 1
            self._days[int(day)].append(slot)
        else:
            self._has_more = True

    def _push(self, slot: CertificateId, time: EventTime) -> None:
        self._notes += 1
        self._sequence += 1
        heappush(self._heap, (time.low, self._sequence, slot, time))

    def _make_calendar(self) -> None:
        """Note anew the first three quarters of the pending events, and what the first meets.

        Few may be far later than all others, so a sample tells how far the days reach; about
        six events are noted on each, or more where there are very many.
        """
        reach = self._heap[0][3].high if self._heap else -INFINITY
        slots: list[CertificateId] = []
        times: list[EventTime] = []
        for kind, row in enumerate(self._rows):  # most slots are empty
            for part, time in enumerate(row):
                if time is not None:
                    slots.append(CertificateId(ROWS * part + kind))
                    times.append(time)
        lows = [time.low for time in times]
        self._first = min(lows, default=0.0)
        sample, days = sorted(lows[:: len(lows) // SAMPLE + 1]), min(len(lows) // 8, DAYS) + 1
        span = max(reach, sample[3 * len(sample) // 4] if sample else 0.0) - self._first
        per_day = (days - 0.5) / span if 0.0 < span < INFINITY else 0.0
        self._per_day = per_day if per_day < INFINITY else 0.0  # infinite if the span is subnormal
        self._heap, self._days = [], [[] for _ in range(days)]
        self._next_day, self._notes, self._has_more = 0.0, 0, False
        for k, slot in enumerate(slots):  # compiled, a zip would be slower
            self._note(slot, times[k])

    def _begin_day(self) -> None:
        """Put what is pending on the next day into the heap.

        The event of a slot may be of a later day by then, where it is noted.
        """
        today = int(self._next_day)
        slots, self._days[today] = self._days[today], []
        self._next_day += 1.0
        rows = self._rows
        for slot in dict.fromkeys(slots):
            time = rows[slot % ROWS][slot // ROWS]
            if time is not None:
                self._note(slot, time)

    def _find_first(self) -> bool:
        """Have the first event, and all that begin within its enclosure, in the heap.

        Returns:
            Whether there is an event; then it is on top of the heap.
        """
        while True:
            heap = self._heap
            while heap and self.pending(heap[0][2]) is not heap[0][3]:
                heappop(heap)
            if heap and (heap[0][3].high - self._first) * self._per_day < self._next_day:
                return True
            if self._next_day < len(self._days):
                self._begin_day()
            elif self._has_more:
                self._make_calendar()
            else:
                return bool(heap)

    def pop(self) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None:
        """The earliest time and all slots with an event then; None if the queue is empty.

        The slots are in increasing order, each with its own `EventTime`.

        If the first enclosure ends before the next one begins, that decides. Otherwise all
        events that may be first are compared exactly.
        """
        if not self._find_first():
            return None
        heap = self._heap
        _, _, slot, time = heappop(heap)
        bound = time.high
        candidates: dict[CertificateId, EventTime] = {}  # a slot may be in the heap twice
        while heap and heap[0][0] <= bound:
            _, _, other, its = heappop(heap)
            if self.pending(other) is its:
                candidates[other] = its
                bound = min(bound, its.high)
        if not candidates:
            self._counters.filtered += 1
            self.cancel(slot)
            return time, [(slot, time)]
        candidates[slot] = time
        return self._pop_exactly(sorted(candidates.items()))

    def _pop_exactly(
        self, entries: list[tuple[CertificateId, EventTime]]
    ) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]]:
        best: list[tuple[CertificateId, EventTime]] = []
        later: list[tuple[CertificateId, EventTime]] = []
        for slot, time in entries:
            order = -1 if not best else self._compare(time, best[0][1])
            if order < 0:
                later += best
                best = [(slot, time)]
            elif order == 0:
                best.append((slot, time))
            else:
                later.append((slot, time))
        for slot, time in later:
            self._push(slot, time)
        for slot, _ in best:
            self.cancel(slot)
        return _simplest([time for _, time in best]), best

    def _compare(self, s: EventTime, t: EventTime) -> int:
        if s.high < t.low:
            return -1
        if s.low > t.high:
            return 1
        if (
            s.exact is None
            and t.exact is None
            and (s.a, s.b, s.c, s.low, s.high) == (t.a, t.b, t.c, t.low, t.high)
        ):
            return 0  # the same root of the same function: a filter isolates it
        x = s.exact or self._resolver.resolve(s)
        y = t.exact or self._resolver.resolve(t)
        order = x.compare(y)
        self._counters.count_exact("time", "close" if order else "zero")
        return order


@final
class ExactQueue(EventQueue):
    """An event queue without floats: every comparison of two times is exact."""

    def __init__(self, resolver: Resolver, counters: Counters) -> None:
        super().__init__(resolver, counters)
        self._exact_heap: list[tuple[AlgebraicNumber, int, CertificateId, EventTime]] = []

    def schedule(self, slot: CertificateId, time: EventTime) -> None:
        """Put an event into a slot, replacing the one there."""
        self._put(slot, time)
        self._sequence += 1
        number = time.exact or self._resolver.resolve(time)
        heappush(self._exact_heap, (number, self._sequence, slot, time))

    def pop(self) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None:
        """The earliest time and all slots with an event then; None if the queue is empty."""
        heap = self._exact_heap
        entries: list[tuple[CertificateId, EventTime]] = []
        first: AlgebraicNumber | None = None
        while heap:
            number, _, slot, time = heap[0]
            if self.pending(slot) is time:
                self._counters.count_exact("time", "asked")
                if first is not None and number.compare(first) > 0:
                    break
                first = number
                entries.append((slot, time))
                self.cancel(slot)
            heappop(heap)
        if not entries:
            return None
        entries.sort()
        return _simplest([time for _, time in entries]), entries


def _simplest(times: list[EventTime]) -> EventTime:
    """Of equal times, the one with the smallest polynomial: the same in every run."""
    best = times[0]
    for time in times:
        if time.exact is not None and (best.exact is None or _size(time.exact) < _size(best.exact)):
            best = time
    return best


def _size(number: AlgebraicNumber) -> tuple[int, IntPoly]:
    return len(number._polynomial), number._polynomial
