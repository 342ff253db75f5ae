"""A calendar of enclosures of event times in vectors, from which the queue takes the first.

Source: R. Brown, Calendar queues, Communications of the ACM 31 (1988), 1220-1227.
"""

from __future__ import annotations

from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i32, i64

from exactpt.certificates.certificate import KIND_COUNT
from exactpt.filters.rounding import INFINITY

DAYS: Final[int] = 1000
"""Maximum number of days: their lists are in a processor's cache together."""

SAMPLE: Final[int] = 64
"""Number of events that determine the reach of a calendar."""


class Calendar:
    """Enclosures of pending events, at most one in each slot; the first is on top of a heap.

    Certificates of one kind (`exactpt.certificates.certificate`) have slots in one row,
    neighbouring parts side by side; the row of an unused kind is empty.

    Days are intervals of time of equal length. Most certificates are cancelled long before they
    fail. So an event is only noted by its slot in the list of its day, and the events that are
    still pending when the day begins are pushed to the heap. Events after the last day are not
    noted: the calendar is built again at its end, and when most of its notes are of cancelled
    events. The day of an event is a monotone function of ``low`` (each rounding is monotone), so
    the heap holds all events that begin before the next day.

    A note, or an entry of the heap, is valid while its ``low`` equals that of its slot.
    """

    def __init__(self) -> None:
        # The enclosure (low, high) of part p of row k is at 2 p and 2 p + 1 in _spans[k]; low is
        # infinite if nothing is pending in the slot, KIND_COUNT p + k.
        self._spans: vec[vec[float]] = vec[vec[float]]([vec[float]() for _ in range(KIND_COUNT)])
        self._count: i64 = 0
        self._heap_low: vec[float] = vec[float]()
        self._heap_slot: vec[i64] = vec[i64]()
        self._heap_size: i64 = 0
        # The days are linked lists: _day has the first note of each, -1 if there is none.
        self._day: vec[i32] = vec[i32]()
        self._note_slot: vec[i64] = vec[i64]()
        self._note_next: vec[i32] = vec[i32]()
        self._note_size: i64 = 0
        self._days: i64 = 0
        self._next_day: float = 0.0
        self._first: float = 0.0
        self._per_day: float = 0.0
        self._notes: i64 = 0
        self._has_more: bool = False

    def _put(self, slot: i64, low: float, high: float) -> None:
        """Make [low, high] the enclosure of a slot, and note it; low must be less than infinity."""
        row, at = slot % KIND_COUNT, 2 * (slot // KIND_COUNT)
        span = self._spans[row]
        if at >= len(span):
            span = _extended(span, at + 2 * (at // 8) + 2)
            self._spans[row] = span
        if span[at] == INFINITY:
            self._count += 1
        span[at] = low
        span[at + 1] = high
        self._note(slot, low)
        if self._notes > 4 * self._count + 256:
            self._make_calendar()

    def _note(self, slot: i64, low: float) -> None:
        """Note an event on its day, or push it if the day has begun; none after the last day."""
        day = (low - self._first) * self._per_day
        if not day >= self._next_day:  # nor if it is not a number
            self._push(slot, low)
        elif day < float(self._days):
            self._notes += 1
            today, size = i64(day), self._note_size
            following = self._day[today]
            if size == len(self._note_slot):
                self._note_slot = append(self._note_slot, slot)
                self._note_next = append(self._note_next, following)
            else:
                self._note_slot[size] = slot
                self._note_next[size] = following
            self._day[today] = i32(size)
            self._note_size = size + 1
        else:
            self._has_more = True

    def _push(self, slot: i64, low: float) -> None:
        """Put an entry into the heap."""
        self._notes += 1
        n = self._heap_size
        lows, slots = self._heap_low, self._heap_slot
        if n == len(slots):
            lows, slots = append(lows, low), append(slots, slot)
            self._heap_low, self._heap_slot = lows, slots
        self._heap_size = n + 1
        while n > 0:
            up = (n - 1) >> 1
            above = lows[up]
            if above <= low:
                break
            lows[n] = above
            slots[n] = slots[up]
            n = up
        lows[n] = low
        slots[n] = slot

    def _drop_top(self) -> None:
        """Remove the top of the heap."""
        n = self._heap_size - 1
        self._heap_size = n
        if n == 0:
            return
        lows, slots = self._heap_low, self._heap_slot
        low, slot = lows[n], slots[n]
        i: i64 = 0
        j: i64 = 1
        while j < n:
            below = lows[j]
            if j + 1 < n:
                right = lows[j + 1]
                if right < below:
                    j, below = j + 1, right
            if low <= below:
                break
            lows[i] = below
            slots[i] = slots[j]
            i = j
            j = 2 * i + 1
        lows[i] = low
        slots[i] = slot

    def _make_calendar(self) -> None:
        """Build the calendar again.

        Its days cover about the earliest 3/4 of the pending events, estimated from a sample since
        few may be far later than all others, and the enclosure on top of the heap. About six
        events are noted on each day, or more where there are very many.
        """
        reach = -INFINITY
        if self._heap_size:
            top = self._heap_slot[0]
            reach = self._spans[top % KIND_COUNT][2 * (top // KIND_COUNT) + 1]
        least, furthest = self._sampled()
        days: i64 = min(self._count // 8, DAYS) + 1
        span = max(reach, furthest) - least
        per_day = (float(days) - 0.5) / span if 0.0 < span < INFINITY else 0.0
        self._first = least
        self._per_day = per_day if per_day < INFINITY else 0.0  # infinite if the span is subnormal
        self._days, self._day = days, vec[i32]([-1] * days)
        self._heap_size = self._note_size = 0
        self._next_day, self._notes, self._has_more = 0.0, 0, False
        for row in range(KIND_COUNT):
            lows = self._spans[row]
            for at in range(0, len(lows), 2):  # most slots are empty
                low = lows[at]
                if low != INFINITY:
                    self._note(KIND_COUNT * (at >> 1) + row, low)

    def _sampled(self) -> tuple[float, float]:
        """Return the least low of a pending event, and the upper quartile of a sample."""
        step: i64 = self._count // SAMPLE + 1
        seen: i64 = 0
        least = INFINITY
        sample: list[float] = []
        for row in range(KIND_COUNT):
            lows = self._spans[row]
            for at in range(0, len(lows), 2):
                low = lows[at]
                if low != INFINITY:
                    least = min(least, low)
                    if seen % step == 0:
                        sample.append(low)
                    seen += 1
        if not sample:
            return 0.0, 0.0
        sample.sort()
        return least, sample[3 * len(sample) // 4]

    def _begin_day(self) -> None:
        """Push the events that are pending on the next day to the heap.

        The event of a slot that is noted here may be of a later day by now, where it is noted too.
        """
        today = i64(self._next_day)
        n = i64(self._day[today])
        self._day[today] = -1
        self._next_day += 1.0
        while n >= 0:
            slot = self._note_slot[n]
            low = self._spans[slot % KIND_COUNT][2 * (slot // KIND_COUNT)]
            if low != INFINITY and not (low - self._first) * self._per_day >= self._next_day:
                self._push(slot, low)
            n = i64(self._note_next[n])

    def _find_first(self) -> bool:
        """Bring the first event, and all that begin within its enclosure, into the heap.

        Returns:
            Whether there is an event; if so, it is on top of the heap.
        """
        while True:
            high = INFINITY
            while self._heap_size:
                slot = self._heap_slot[0]
                span, at = self._spans[slot % KIND_COUNT], 2 * (slot // KIND_COUNT)
                if span[at] == self._heap_low[0]:
                    high = span[at + 1]
                    break
                self._drop_top()
            if self._heap_size and (high - self._first) * self._per_day < self._next_day:
                return True
            if self._next_day < float(self._days):
                self._begin_day()
            elif self._has_more:
                self._make_calendar()
            else:
                return self._heap_size > 0


def _extended(span: vec[float], length: i64) -> vec[float]:
    """Return a vector, filled up with infinity to a length."""
    while len(span) < length:
        span = append(span, INFINITY)
    return span
