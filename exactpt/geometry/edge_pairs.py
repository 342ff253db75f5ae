"""Pairs of edges of a polygon of many vertices that a float filter in numpy leaves open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Floats, overlapping_pairs
from exactpt.kernel.budget import ask
from exactpt.kernel.rounding import SLACK, TINY, U

K: Final = 8.0 * U
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
            ask()
            i, j = first[k : k + CHUNK], second[k : k + CHUNK]
            unsure = (j == i + 1) | (closed & (j - i == len(rows) - 1))
            unsure |= ~_surely_apart(ends[:, i], ends[:, j], error)
            pairs += zip(i[unsure].tolist(), j[unsure].tolist(), strict=True)
    return pairs


@np.errstate(all="ignore")
def _surely_apart(e: Floats, f: Floats, error: float) -> NDArray[np.bool_]:
    """Return for which pairs of edges, in columns, one is surely beside the line of the other."""
    apart = np.zeros(e.shape[1], np.bool_)
    for (ax, ay, bx, by), ends in ((e, f), (f, e)):
        ux, uy = bx - ax, by - ay
        left, right = ~np.zeros_like(apart), ~np.zeros_like(apart)
        for x, y in (ends[:2], ends[2:]):
            vx, vy = x - ax, y - ay
            p, q = ux * vy, uy * vx
            bound = K * (np.abs(p) + np.abs(q)) + TINY
            if error:
                size = np.abs(ux) + np.abs(uy) + np.abs(vx) + np.abs(vy)
                bound = (bound + 2.0 * error * (size + 4.0 * error)) * SLACK
            value = p - q
            left &= value > bound
            right &= value < -bound
        apart |= left | right
    return apart
