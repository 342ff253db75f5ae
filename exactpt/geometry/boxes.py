"""Overlapping pairs among many boxes, by a sweep in numpy: a filter, never a decision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isqrt
from typing import Final, TypeAlias

import numpy as np

from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats, Indices
from exactpt.kernel.numbers import QQ, relative_doubles

Boxes: TypeAlias = Floats
"""Shape (n, 4), or (k, n, 4) for k times: low x, high x, low y, high y, each rounded outward,
without NaN."""

_FEW: Final = 64
"""Maximum number of boxes of which all pairs are compared."""

_ALL: Final = 1 << 16
"""Maximum number of pairs of boxes of two kinds that are all compared."""

_CHUNK: Final = 1 << 21
"""Maximum number of candidate pairs in a chunk, unless a single box has more."""


def boxes_of_points(groups: Sequence[Sequence[tuple[QQ, QQ]]]) -> Boxes:
    """Return the bounding box of each group of points, rounded outward.

    They may be relative to one of the points (`relative_doubles`). Rounding is monotone, so the
    nearest double of the least coordinate is the least of the nearest doubles, and the next double
    below is at most the coordinate.
    """
    rows = np.empty((len(groups), 4))
    if not groups:
        return rows
    firsts = np.cumsum([0, *map(len, groups[:-1])])
    for axis in (0, 1):
        near, _ = relative_doubles([p[axis] for points in groups for p in points])
        rows[:, 2 * axis] = np.minimum.reduceat(near, firsts)
        rows[:, 2 * axis + 1] = np.maximum.reduceat(near, firsts)
    return grown(rows, 0.0)


@np.errstate(all="ignore")  # after the largest double comes infinity, rightly
def grown(boxes: Boxes, by: Floats | float) -> Boxes:
    """Return boxes whose sides are moved outward by numbers, and to the next double.

    A sum far from 0 may lose the number, and a bound made of differences of the boxes would not
    allow for that.

    Args:
        boxes: the boxes.
        by: of at least 0: one number, or for each box one, shape (n, 1), or two, shape (n, 2).
    """
    wide = np.empty_like(boxes)
    wide[:, ::2] = np.nextafter(boxes[:, ::2] - by, -np.inf)
    wide[:, 1::2] = np.nextafter(boxes[:, 1::2] + by, np.inf)
    return wide


def widen_unknown(boxes: Boxes) -> None:
    """Replace every box with a NaN side by the whole plane."""
    boxes[np.isnan(boxes).any(axis=-1)] = (-np.inf, np.inf, -np.inf, np.inf)


def overlapping_pairs(boxes: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """Yield all pairs i < j of closed boxes that intersect, in chunks of index arrays (i, j)."""
    n = len(boxes)
    if n <= _FEW:
        low_x, high_x, low_y, high_y = boxes.T
        meets = (low_x[:, None] <= high_x) & (low_y[:, None] <= high_y)
        first, second = np.divmod(np.flatnonzero(meets & meets.T), n)
        above = first < second
        yield first[above], second[above]
        return
    yield from _swept_pairs(boxes)


def crossing_pairs(some: Boxes, others: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """Yield all intersecting pairs of a closed box of the first and of the second, in chunks."""
    n = len(some)
    if n * len(others) <= _ALL:
        low_x, high_x, low_y, high_y = some.T[..., None]
        left, right, below, above = others.T.copy()  # in one piece each: compared faster
        meets = (low_x <= right) & (low_y <= above)
        meets &= (high_x >= left) & (high_y >= below)
        yield np.divmod(np.flatnonzero(meets), len(others))
        return
    for first, second in overlapping_pairs(np.concatenate((some, others))):
        crossed = (first < n) & (second >= n)
        yield first[crossed], second[crossed] - n


def _swept_pairs(boxes: Boxes) -> Iterator[tuple[Indices, Indices]]:
    """As `overlapping_pairs`.

    The plane is cut into horizontal strips, each swept from left to right. Two boxes that
    intersect have a strip in common; the pair is reported in the lowest one.
    """
    n = len(boxes)
    order = np.argsort(boxes[:, 0], kind="stable")
    low_y, high_y = boxes[order, 2], boxes[order, 3]
    # In this order, the x-interval of box i intersects exactly those of boxes i < j < ends[i].
    ends = np.searchsorted(boxes[order, 0], boxes[order, 1], side="right")
    lowest, highest = _strips(low_y, high_y)
    # One copy of each box for each of its strips, sorted by strip.
    box, strip = _spread(np.arange(n), lowest, highest + 1)
    by_strip = np.argsort(strip, kind="stable")
    box, strip = box[by_strip], strip[by_strip]
    place = strip.astype(np.int64) * (n + 1) + box
    after = np.arange(1, len(box) + 1)
    stop = np.searchsorted(place, place - box + ends[box])
    first = 0
    while first < len(box):
        check_budget()
        # As many boxes as fit in a chunk, but at least one.
        total = np.cumsum(stop[first:] - after[first:], dtype=np.int64)
        last = first + max(1, int(np.searchsorted(total, _CHUNK, side="right")))
        here, there = _spread(np.arange(first, last), after[first:last], stop[first:last])
        i, j = box[here], box[there]
        meets = (low_y[i] <= high_y[j]) & (low_y[j] <= high_y[i])
        meets &= strip[here] == np.maximum(lowest[i], lowest[j])
        a, b = order[i[meets]], order[j[meets]]
        yield np.minimum(a, b), np.maximum(a, b)
        first = last


def _strips(low: Floats, high: Floats) -> tuple[Indices, Indices]:
    """Return the lowest and the highest strip of each interval.

    About as many intervals begin in each strip, and few intersect many strips. A higher
    interval is in no lower strip, wherever the plane is cut.
    """
    n = len(low)
    count = isqrt(n)
    ordered = np.sort(low)
    while True:
        bounds = ordered[n // count :: n // count] if count > 1 else ordered[:0]
        lowest = np.searchsorted(bounds, low, side="right")
        highest = np.searchsorted(bounds, high, side="right")
        if count <= 1 or int((highest - lowest).sum()) <= 2 * n:
            return lowest, highest
        count //= 2


def _spread(items: Indices, start: Indices, stop: Indices) -> tuple[Indices, Indices]:
    """Return each item repeated for every number in its range [start, stop), and these numbers."""
    sizes = stop - start
    numbers = np.arange(int(sizes.sum())) - np.repeat(np.cumsum(sizes) - sizes - start, sizes)
    return np.repeat(items, sizes), numbers
