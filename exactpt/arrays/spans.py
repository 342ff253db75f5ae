"""Time spans of many pairs, and times counted from their starts."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from exactpt.arrays.incidence_times import Span
from exactpt.errors import InputError
from exactpt.kernel.doubles import Floats, Indices, doubles, first_true
from exactpt.kernel.numbers import shorten


class Spans(NamedTuple):
    """The start and the end of each time span.

    Attributes:
        start, end: as given.
        length: bounds of the differences.
        shifted: whether any start is not 0.
    """

    start: Floats
    end: Floats
    length: Span
    shifted: bool

    def part(self, first: int, last: int) -> Spans:
        """Return the spans in a range."""
        cut = slice(first, last)
        length = Span(self.length.low[cut], self.length.high[cut])
        return Spans(self.start[cut], self.end[cut], length, self.shifted)

    def at(self, index: Indices) -> Spans:
        """Return the spans at the given places."""
        return Spans(self.start[index], self.end[index], self.length.take(index), self.shifted)

    def times(self, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Enclosures of times from enclosures of times since the start."""
        if not self.shifted:
            return low, high
        with np.errstate(all="ignore"):
            lows = np.nextafter(self.start + low, -np.inf)
            highs = np.nextafter(self.start + high, np.inf)
        return np.where(low < np.inf, lows, np.inf), np.where(high < np.inf, highs, np.inf)


def read_spans(time: ArrayLike, count: int) -> Spans:
    """Time spans from one pair (start, end), or an array of shape (count, 2).

    Raises:
        InputError: if a time is not a finite double, or an end is not after its start.
    """
    given = doubles(time, "time").copy()
    if given.shape not in {(2,), (count, 2)}:
        raise InputError(f"time: shape (2,) or ({count}, 2) is needed, not {given.shape}")
    start, end = (np.broadcast_to(given[..., k], (count,)) for k in (0, 1))
    wrong = first_true(~(given[..., 0] < given[..., 1]))
    if wrong is not None:
        a, b = given[wrong].tolist()
        where = f"time{list(wrong)}" if wrong else "time"
        raise InputError(f"{where}: the span from {shorten(a)} to {shorten(b)} is empty")
    shifted = bool(given[..., 0].any())
    with np.errstate(all="ignore"):
        low = high = given[..., 1] - given[..., 0]
        if shifted:
            low, high = np.nextafter(low, -np.inf), np.nextafter(high, np.inf)
    bounds = Span(np.broadcast_to(low, (count,)), np.broadcast_to(high, (count,)))
    return Spans(start, end, bounds, shifted)
