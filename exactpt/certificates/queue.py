"""The event queue: event times as float enclosures, compared exactly only if two overlap.

The order of events is total and the same on every machine: by exact time, and at equal
times by slot. Cancelled events are dropped when they reach the top.
"""

from __future__ import annotations

from heapq import heappop, heappush
from typing import Final, Protocol, final

import numpy as np
from librt.vecs import append, vec
from mypy_extensions import i32, i64, mypyc_attr

from exactpt.certificates.calendar import Calendar
from exactpt.certificates.certificate import ANGLE, KIND_COUNT
from exactpt.filters.rounding import INFINITY
from exactpt.indices import CertificateId, HalfEdge, Triple
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.doubles import Floats, Indices, items
from exactpt.kernel.integer_polynomial import IntPoly

NO_CERTIFICATE: Final = CertificateId(-1)

LARGEST: Final[float] = float.fromhex("0x1.fffffffffffffp+1023")
"""The largest finite double."""


@final
@mypyc_attr(acyclic=True)
class EventTime:
    """An event time: a float enclosure, and the exact number on demand.

    Attributes:
        low, high: doubles, normalised as in the run: low <= time <= high.
        a, b, c: the function of which the time is a root, as known to the resolver.
        exact: the exact time, once it has been computed.
        crossing: whether the function changes sign at it; otherwise it only touches 0.
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
    """Return the earlier of two exact times, the first if equal; None is infinity."""
    if s is None or t is None or s.exact is None or t.exact is None:
        return s or t
    return t if t.exact.compare(s.exact) < 0 else s


class Resolver(Protocol):
    """Computes the exact times of events."""

    def resolve(self, time: EventTime) -> AlgebraicNumber:
        """Return the exact time, stored in ``time.exact``; the enclosure is narrowed likewise."""
        ...


class Angles:
    """The functions of the certificates of angles, of which the queue stores none."""

    def function(self, h: HalfEdge) -> Triple:
        """Return the three vertices of the angle of a half-edge, the least one first."""
        raise NotImplementedError


class EventQueue(Calendar):
    """A queue of event times with at most one pending event per slot.

    An event is an enclosure in the calendar, and the three numbers of its function. Its
    `EventTime` is kept only if it has an exact number, or no change of sign; otherwise it is
    made when it is needed.

    Attributes:
        angles: the functions of angles; with None, their numbers are stored too.
    """

    def __init__(self, resolver: Resolver, counters: Counters) -> None:
        super().__init__()
        self._resolver = resolver
        self._counters: Counters = counters
        self._keys: vec[vec[i32]] = vec[vec[i32]]([vec[i32]() for _ in range(KIND_COUNT)])
        self._kept: dict[CertificateId, EventTime] = {}
        self.angles: Angles | None = None

    def __len__(self) -> int:
        return int(self._count)

    def schedule(self, slot: CertificateId, time: EventTime) -> None:
        """Put an event into a slot, replacing the one there."""
        low = min(time.low, LARGEST)  # infinity stands for an empty slot
        self.schedule_crossing(slot, low, time.high, time.a, time.b, time.c)
        if time.exact is not None or not time.crossing:
            self._kept[slot] = time

    def schedule_crossing(
        self, slot: CertificateId, low: float, high: float, a: i64, b: i64, c: i64
    ) -> None:
        """Put a change of sign, whose exact time is not known, into a slot."""
        if self._kept:
            self._kept.pop(slot, None)
        row, at = slot % KIND_COUNT, 3 * (slot // KIND_COUNT)
        if row != ANGLE or self.angles is None:
            key = self._keys[row]
            if at >= len(key):
                key = _extended(key, at + 3 * (at // 12) + 3)
                self._keys[row] = key
            key[at] = i32(a)
            key[at + 1] = i32(b)
            key[at + 2] = i32(c)
        self._put(slot, low, high)

    def schedule_angles(self, parts: Indices, lows: Floats, highs: Floats) -> None:
        """Put changes of sign of angles into their slots; none is pending, and `angles` is set.

        Args:
            parts: the half-edges, in increasing order.
            lows: the lower ends of the enclosures, less than infinity.
            highs: the upper ends.
        """
        if not len(parts):
            return
        spans = np.full((int(parts[-1]) + 1, 2), INFINITY)
        spans[parts, 0], spans[parts, 1] = lows, highs
        self._spans[ANGLE] = vec[float](items(spans))
        self._count += len(parts)
        self._heap_size = 0  # its slots may be beyond the new rows; the calendar has all events
        self._make_calendar()

    def cancel(self, slot: CertificateId) -> None:
        """Empty a slot."""
        span, at = self._spans[slot % KIND_COUNT], 2 * (slot // KIND_COUNT)
        if at < len(span) and span[at] != INFINITY:
            span[at] = INFINITY
            self._count -= 1
            if self._kept:
                self._kept.pop(slot, None)

    def pending(self, slot: CertificateId) -> EventTime | None:
        """Return the time of the event in a slot, or None."""
        span, at = self._spans[slot % KIND_COUNT], 2 * (slot // KIND_COUNT)
        return None if at >= len(span) or span[at] == INFINITY else self.time_of(slot)

    def time_of(self, slot: CertificateId) -> EventTime:
        """Return the time of a slot that is not empty."""
        if self._kept:
            kept = self._kept.get(slot)
            if kept is not None:
                return kept
        row, part = slot % KIND_COUNT, slot // KIND_COUNT
        low, high, at = self._spans[row][2 * part], self._spans[row][2 * part + 1], 3 * part
        if row == ANGLE and self.angles is not None:
            u, v, w = self.angles.function(HalfEdge(part))
            return EventTime(low, high, u, v, w)
        key = self._keys[row]
        return EventTime(low, high, i64(key[at]), i64(key[at + 1]), i64(key[at + 2]))

    def slots(self) -> list[CertificateId]:
        """Return all slots with a pending event, in increasing order."""
        found: list[CertificateId] = []
        for row in range(KIND_COUNT):
            span = self._spans[row]
            parts = range(len(span) // 2)
            found += [CertificateId(KIND_COUNT * p + row) for p in parts if span[2 * p] != INFINITY]
        return sorted(found)

    def first_alone(self, until: float) -> CertificateId:
        """Return the slot of the first event, which stays, if doubles decide that.

        Returns:
            -1 if there is none, it is not certainly before ``until``, another enclosure overlaps
            its own, or the sign does not change at it.
        """
        if not self._find_first():
            return NO_CERTIFICATE
        slot = self._heap_slot[0]
        low, high = self._heap_low[0], self._spans[slot % KIND_COUNT][2 * (slot // KIND_COUNT) + 1]
        if high > until:
            return NO_CERTIFICATE
        if self._kept:
            kept = self._kept.get(CertificateId(slot))
            if kept is not None and not kept.crossing:
                return NO_CERTIFICATE
        while (self._heap_size > 1 and self._heap_low[1] <= high) or (
            self._heap_size > 2 and self._heap_low[2] <= high
        ):
            self._drop_top()
            other = self._heap_slot[0]
            if other != slot and (
                self._spans[other % KIND_COUNT][2 * (other // KIND_COUNT)] == self._heap_low[0]
            ):
                self._push(slot, low)
                return NO_CERTIFICATE
            self._heap_slot[0] = slot
            self._heap_low[0] = low
        return CertificateId(slot)

    def take_first(self, slot: CertificateId) -> None:
        """Remove the event that `first_alone` has returned."""
        self._drop_top()
        self._counters.filtered += 1
        self.cancel(slot)

    def pop(self) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None:
        """Remove the earliest events; return their time and their slots, None if there are none.

        The slots are in increasing order, each with its own `EventTime`.

        If the first enclosure ends before the next one begins, that decides. Otherwise all
        events that may be first are compared exactly.
        """
        if not self._find_first():
            return None
        slot = CertificateId(self._heap_slot[0])
        time = self.time_of(slot)
        self._drop_top()
        candidates: dict[CertificateId, EventTime] = {}  # a slot may be in the heap twice
        bound = time.high
        while self._heap_size and self._heap_low[0] <= bound:
            other, low = CertificateId(self._heap_slot[0]), self._heap_low[0]
            self._drop_top()
            if other != slot and self._spans[other % KIND_COUNT][2 * (other // KIND_COUNT)] == low:
                its = self.time_of(other)
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
        for slot, time in later:  # a comparison may have narrowed its enclosure
            self.schedule(slot, time)
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
        self._sequence: int = 0
        self._exact_heap: list[tuple[AlgebraicNumber, int, CertificateId, EventTime]] = []

    def __len__(self) -> int:
        return len(self._kept)

    def schedule(self, slot: CertificateId, time: EventTime) -> None:
        """Put an event into a slot, replacing the one there."""
        self._kept[slot] = time
        self._sequence += 1
        number = time.exact or self._resolver.resolve(time)
        heappush(self._exact_heap, (number, self._sequence, slot, time))

    def schedule_crossing(
        self, slot: CertificateId, low: float, high: float, a: i64, b: i64, c: i64
    ) -> None:
        """Put a change of sign, whose exact time is not known, into a slot."""
        self.schedule(slot, EventTime(low, high, a, b, c))

    def cancel(self, slot: CertificateId) -> None:
        """Empty a slot."""
        self._kept.pop(slot, None)

    def pending(self, slot: CertificateId) -> EventTime | None:
        """Return the time of the event in a slot, or None."""
        return self._kept.get(slot)

    def slots(self) -> list[CertificateId]:
        """Return all slots with a pending event, in increasing order."""
        return sorted(self._kept)

    def pop(self) -> tuple[EventTime, list[tuple[CertificateId, EventTime]]] | None:
        """Return the earliest time and all slots with an event at it; None if it is empty."""
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
    """Return, of equal times, the one with the smallest polynomial: the same in every run.

    Of several, the first one.
    """
    best = times[0]
    if len(times) == 1:
        return best
    for time in times:
        if time.exact is not None and (best.exact is None or _size(time.exact) < _size(best.exact)):
            best = time
    return best


def _size(number: AlgebraicNumber) -> tuple[int, IntPoly]:
    """Return the size of a polynomial: of the linear one, if the number is rational.

    It is recognised as rational here, which an earlier comparison may have done or not.
    """
    polynomial = number.simplified().exact_polynomial
    return len(polynomial), polynomial


def _extended(key: vec[i32], length: i64) -> vec[i32]:
    """Return a vector, filled up with zeros to a length."""
    while len(key) < length:
        key = append(key, 0)
    return key
