"""The convex hull of all bodies, searched by angles in doubles: where a line enters it.

Counter-clockwise around the hull, the side value v of `exactpt.query.ray` increases along edges of
directions between that of the ray and the opposite one, and then decreases: so its least and
greatest corner follow from the angles of the edges, and a sign change between them from bisection.
Angles are rounded, which decides nothing: of a convex polygon one edge alone has its origin on
the right of a line and its target on the left, and a corner with a value less than those of both
neighbours has the least of all. Where these signs are not certain, nothing is returned.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from typing import final

from exactpt.indices import NO_HALF_EDGE, HalfEdge


@final
class Hull:
    """The cycle around the face outside of the hull.

    Args:
        corners: its corners in doubles, clockwise around the hull, each with the half-edge that
            ends at it, as of `Subdivision.outline`: the last one also first.
    """

    __slots__ = ("_angles", "_center", "_corners", "_first", "_sectors", "_shift")

    def __init__(self, corners: Sequence[tuple[float, float, HalfEdge]]) -> None:
        # Counter-clockwise: the half-edge of a corner comes from the next one.
        self._corners = around = corners[:0:-1]
        n = len(around)
        self._center = sum(x for x, _, _ in around) / n, sum(y for _, y, _ in around) / n
        cx, cy = self._center
        spokes = [math.atan2(y - cy, x - cx) for x, y, _ in around]
        pairs = pairwise([*around, around[0]])
        angles = [math.atan2(d - b, c - a) for (a, b, _), (c, d, _) in pairs]
        self._shift, self._sectors = _from_least(spokes)
        self._first, self._angles = _from_least(angles)

    def edge_before(self, x: float, y: float) -> HalfEdge:
        """Return an edge that a point has on its way to the centre, if it is outside."""
        at = bisect_right(self._sectors, math.atan2(y - self._center[1], x - self._center[0]))
        return self._corners[(at - 1 + self._shift) % len(self._corners)][2]

    def entered(self, line: tuple[float, float, float], off: float) -> HalfEdge | None:
        """Return the edge at which a line enters the hull.

        Args:
            line: the line, as in `Ray`.
            off: a bound on the errors of its values.

        Returns:
            The edge, whose interior it crosses; -1 if it passes the hull; None if doubles
            do not decide.
        """
        dx, dy, c = line
        corners, n = self._corners, len(self._corners)

        def value(k: int) -> float:
            x, y, _ = corners[k % n]
            return dx * y - dy * x - c

        angle = math.atan2(dy, dx)
        opposite = angle - math.pi if angle > 0.0 else angle + math.pi
        least = bisect_right(self._angles, angle) + self._first
        most = bisect_right(self._angles, opposite) + self._first
        low, high = value(least), value(most)
        if low > off or high < -off:
            k, sign = (least, 1.0) if low > off else (most, -1.0)
            nearer = sign * value(k) + 2.0 * off
            passes = nearer < sign * value(k - 1) and nearer < sign * value(k + 1)
            return NO_HALF_EDGE if passes else None
        left, right = most, least if least > most else least + n
        while left + 1 < right:
            middle = (left + right) // 2
            x, y, _ = corners[middle % n]
            at = dx * y - dy * x - c
            if at > off:
                left = middle
            elif at < -off:
                right = middle
            else:
                return None
        return corners[left % n][2] if value(left) > off and value(right) < -off else None


def _from_least(angles: Sequence[float]) -> tuple[int, list[float]]:
    """Return the number of the least angle, and all from it on."""
    first = min(range(len(angles)), key=angles.__getitem__)
    return first, [*angles[first:], *angles[:first]]
