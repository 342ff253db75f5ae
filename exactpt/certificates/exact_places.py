"""Positions at an instant that doubles hold exactly: ties are decided without rationals.

At the time 0 of a scene of integers, or of doubles, in linear motion, the doubles are the
positions themselves. Computations without rounding are exact, zeros included
(`exactpt.filters.error_free`): there, most undecided cases of a filter are ties.
"""

from __future__ import annotations

from typing import final

from librt.vecs import vec

from exactpt.certificates.coefficients import K
from exactpt.filters.error_free import NOT_EXACT, exact_cross_sign, is_exact_product, is_exact_sum
from exactpt.indices import VertexId
from exactpt.motion.vertices import WIDTH, Vertices


@final
class ExactPlaces:
    """The positions of straight trajectories at an instant, held by doubles, where they are.

    Args:
        vertices: the moving vertices.
        x, y: their coordinates at the instant, normalised; NaN if unknown.
        are_exact: whether these, but for NaN, have no error.
        after: whether orders are those just after the instant, or else those at it.
    """

    def __init__(
        self, vertices: Vertices, x: vec[float], y: vec[float], *, are_exact: bool, after: bool
    ) -> None:
        self._vertices = vertices
        self._x: vec[float] = x
        self._y: vec[float] = y
        self._are_exact: bool = are_exact
        self._after: bool = after

    def cross_sign(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """Return the sign of (b - a) x (d - c) at the instant; `NOT_EXACT` if it is not certain."""
        if not self._are_exact:
            return NOT_EXACT
        x, y = self._x, self._y
        return exact_cross_sign((x[a], y[a]), (x[b], y[b]), (x[c], y[c]), (x[d], y[d]))

    def is_slope(self, a: VertexId, b: VertexId, q: float) -> bool:
        """Return True if q, the double nearest to minus the slope of the line from a to b, is that.

        Then q dx is -dy or differs from it by less than a unit in its last place, and all sums of
        `is_exact_product` are exact but perhaps the last, which is 0 only if the error is.
        """
        if not self._are_exact:
            return False
        x, y = self._x, self._y
        dx, dy = x[b] - x[a], y[b] - y[a]
        return (
            is_exact_product(q, dx, -dy)
            and is_exact_sum(x[b], -x[a], dx)
            and is_exact_sum(y[b], -y[a], dy)
        )

    def order(self, a: VertexId, b: VertexId) -> int:
        """Return 1 if a is left of b (`Predicates.left_of`), -1 if right, for one x; 0: undecided.

        Just after the instant x(b) - x(a) has the sign of its slope, since the trajectories are
        straight. Where that is identically zero, y decides.
        """
        if not self._are_exact or self._x[a] != self._x[b]:
            return 0
        if self._after:
            places, off = self._vertices.places, 2.0 * self._vertices.enclosures.errors[1]
            slope = places[WIDTH * b + 2] - places[WIDTH * a + 2]
            if abs(slope) > off + K * abs(slope):
                return 1 if slope > 0.0 else -1
            motion = self._vertices.motion_of
            if off and not motion(a) == motion(b) >= 0:
                return 0
        height = self._y[a] - self._y[b]
        return 1 if height > 0.0 else -1 if height < 0.0 else 0
