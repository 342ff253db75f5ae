"""Pairs of edges of a polygon of many vertices that a float filter in numpy leaves open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from exactpt.geometry.boxes import Floats, overlapping_pairs
from exactpt.geometry.ragged import Flags, segments_meet
from exactpt.kernel.budget import check_budget

CHUNK: Final = 1 << 13
"""Number of pairs that are compared at once, so that their numbers stay in the cache."""


def unsure_pairs(
    rows: Sequence[tuple[float, float, float, float]], error: float, *, closed: bool
) -> list[tuple[int, int]]:
    """Return the pairs i < j of edges that have a common end, or may intersect.

    Args:
        rows: the edges one after another, as x and y of both ends.
        error: a bound on the errors of all coordinates.
        closed: whether the last one and the first one have a common end.
    """
    ends = np.array(rows).T.copy()
    (x, y), (u, v) = ends[:2], ends[2:]
    off = 4.0 * error
    low_x, low_y = np.minimum(x, u) - off, np.minimum(y, v) - off
    boxes = np.stack((low_x, np.maximum(x, u), low_y, np.maximum(y, v)), axis=1)
    pairs: list[tuple[int, int]] = []
    for first, second in overlapping_pairs(boxes):
        for k in range(0, len(first), CHUNK):
            check_budget()
            i, j = first[k : k + CHUNK], second[k : k + CHUNK]
            unsure = (j == i + 1) | (closed & (j - i == len(rows) - 1))
            unsure |= ~_surely_apart(ends[:, i], ends[:, j], error)
            pairs += zip(i[unsure].tolist(), j[unsure].tolist(), strict=True)
    return pairs


def _surely_apart(e: Floats, f: Floats, error: float) -> Flags:
    """Return which pairs of edges, in columns, surely have no common point.

    A difference of two coordinates has at most twice their error.
    """
    u, v, p = ((x, y) for x, y in (e[2:] - e[:2], f[2:] - f[:2], f[:2] - e[:2]))
    return segments_meet(u, v, p, 2.0 * error, 2.0 * error)[0]
