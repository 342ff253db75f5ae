"""Pairs of edges of a polygon of many vertices that a float filter in numpy leaves open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Floats, overlapping_pairs
from exactpt.kernel.budget import ask
from exactpt.kernel.rounding import SLACK, TINY, U

__all__ = ["unsure_pairs"]

K: Final = 8.0 * U


def unsure_pairs(
    rows: Sequence[tuple[float, float, float, float]], error: float, *, closed: bool
) -> list[tuple[int, int]]:
    """The pairs i < j of edges that have a common end, or may meet.

    Args:
        rows: the edges one after another, as x and y of both ends.
        error: a bound on the errors of all coordinates.
        closed: whether the last one and the first one have a common end.
    """
    ends = np.array(rows)
    x, y = ends[:, ::2], ends[:, 1::2]
    low_x, low_y = x.min(axis=1) - 4.0 * error, y.min(axis=1) - 4.0 * error
    boxes = np.stack((low_x, x.max(axis=1), low_y, y.max(axis=1)), axis=1)
    pairs: list[tuple[int, int]] = []
    for first, second in overlapping_pairs(boxes):
        ask()
        unsure = (second == first + 1) | (closed & (second - first == len(rows) - 1))
        unsure |= ~_surely_apart(ends[first], ends[second], error)
        pairs += zip(first[unsure].tolist(), second[unsure].tolist(), strict=True)
    return pairs


@np.errstate(all="ignore")
def _surely_apart(e: Floats, f: Floats, error: float) -> NDArray[np.bool_]:
    """Return for which pairs of edges one is surely on one side of the line of the other."""
    apart = np.zeros(len(e), np.bool_)
    for line, ends in ((e, f), (f, e)):
        u = line[:, 2:] - line[:, :2]
        signs = []
        for k in (0, 2):
            v = ends[:, k : k + 2] - line[:, :2]
            p, q = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
            bound = K * (np.abs(p) + np.abs(q)) + TINY
            size = np.abs(u).sum(axis=1) + np.abs(v).sum(axis=1)
            bound = (bound + 2.0 * error * (size + 4.0 * error)) * SLACK
            signs.append((p - q > bound) * 1 - (p - q < -bound))
        apart |= signs[0] * signs[1] > 0
    return apart
