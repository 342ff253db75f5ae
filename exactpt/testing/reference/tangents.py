"""The incremental tiling of points (the paper, section 3.3): two tangents of each point, by slopes.

Points are in the order of x; of points with equal x the upper one is the first. Of the points
before p, u(p) is the one from which the slope to p is the least, and d(p) the one from which it is
the largest. A slope from a point above is less than all others. Of points with equal slopes, all
on one line with p, the nearest one counts.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, Rational, rational

__all__ = ["Edge", "tangents"]

Edge: TypeAlias = tuple[int, int]
"""The numbers of two points, the lower one first."""

_Slope: TypeAlias = tuple[int, QQ]
"""A slope, in their order: 0 for a vertical line, or 1 and the slope of any other."""


def tangents(positions: Sequence[tuple[Rational, Rational]]) -> set[Edge]:
    """Return the edges of the incremental tiling of distinct points: p u(p) and p d(p) of each p.

    Args:
        positions: the position of each point.

    Example:
        >>> sorted(tangents([(0, 0), (1, 3), (2, 1), (3, 2)]))
        [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)]
    """
    points = [(rational(x), rational(y)) for x, y in positions]
    order = sorted(range(len(points)), key=lambda i: (points[i][0], -points[i][1]))
    edges = set()
    for k in range(1, len(order)):
        p = order[k]
        nearest_first = order[:k][::-1]
        slopes = {q: _slope(points[q], points[p]) for q in nearest_first}
        for q in (min(slopes, key=slopes.__getitem__), max(slopes, key=slopes.__getitem__)):
            edges.add((min(p, q), max(p, q)))
    return edges


def _slope(q: Point, p: Point) -> _Slope:
    """Return the slope from q to p, which is not before q."""
    if q[0] == p[0]:
        return 0, QQ(0)
    return 1, (p[1] - q[1]) / (p[0] - q[0])
