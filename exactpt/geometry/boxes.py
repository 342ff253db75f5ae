"""Which of many boxes overlap: sort and sweep, in numpy. A filter, never a decision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from exactpt.kernel.numbers import QQ, enclosing_floats

__all__ = ["Boxes", "boxes_of_points", "overlapping_pairs"]

Boxes: TypeAlias = NDArray[np.float64]
"""Shape (n, 4): low x, high x, low y, high y, each rounded outward."""

_CHUNK: Final = 1 << 21


def boxes_of_points(groups: Sequence[Sequence[tuple[QQ, QQ]]]) -> Boxes:
    """The bounding box of each group of points, rounded outward."""
    rows = np.empty((len(groups), 4))
    for i, points in enumerate(groups):
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        rows[i, 0] = enclosing_floats(min(xs))[0]
        rows[i, 1] = enclosing_floats(max(xs))[1]
        rows[i, 2] = enclosing_floats(min(ys))[0]
        rows[i, 3] = enclosing_floats(max(ys))[1]
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
