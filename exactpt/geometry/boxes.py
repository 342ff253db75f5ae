"""Which of many boxes overlap: sort and sweep, in numpy. A filter, never a decision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from exactpt.kernel.numbers import QQ, nearest_float

__all__ = ["Boxes", "boxes_of_points", "overlapping_pairs"]

Boxes: TypeAlias = NDArray[np.float64]
"""Shape (n, 4): low x, high x, low y, high y, each rounded outward."""

_CHUNK: Final = 1 << 21


def boxes_of_points(groups: Sequence[Sequence[tuple[QQ, QQ]]]) -> Boxes:
    """The bounding box of each group of points, rounded outward.

    Rounding is monotone, so the nearest double of the least coordinate is the least of the
    nearest doubles; and the one below that is no larger than the coordinate.
    """
    rows = np.empty((len(groups), 4))
    if not groups:
        return rows
    firsts = np.cumsum([0, *map(len, groups[:-1])])
    for axis in (0, 1):
        near = np.array([nearest_float(p[axis]) for points in groups for p in points])
        rows[:, 2 * axis] = np.minimum.reduceat(near, firsts)
        rows[:, 2 * axis + 1] = np.maximum.reduceat(near, firsts)
    rows[:, ::2] = np.nextafter(rows[:, ::2], -np.inf)
    rows[:, 1::2] = np.nextafter(rows[:, 1::2], np.inf)
    return rows


def overlapping_pairs(boxes: Boxes) -> Iterator[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """All pairs i < j of boxes that meet (closed), in chunks of index arrays (i, j)."""
    n = len(boxes)
    order = np.argsort(boxes[:, 0], kind="stable")
    low, high = boxes[order, 0], boxes[order, 1]
    low_y, high_y = boxes[order, 2], boxes[order, 3]
    # In sorted order, box i meets in x exactly the boxes i < j < ends[i].
    ends = np.searchsorted(low, high, side="right")
    counts = np.maximum(ends - np.arange(1, n + 1), 0)
    first = 0
    while first < n:
        # As many boxes as fit a chunk, at least one.
        total = np.cumsum(counts[first:])
        last = first + max(1, int(np.searchsorted(total, _CHUNK, side="right")))
        part = counts[first:last]
        i = np.repeat(np.arange(first, last), part)
        offsets = np.arange(len(i)) - np.repeat(np.cumsum(part) - part, part)
        j = i + 1 + offsets
        meets = (low_y[i] <= high_y[j]) & (low_y[j] <= high_y[i])
        a, b = order[i[meets]], order[j[meets]]
        yield np.minimum(a, b), np.maximum(a, b)
        first = last
