"""Predicates at one rational time, for the static constructions.

They give either the signs just after the time (for a scene that starts at an event: its
tiling is the one right after), or the signs at the time itself (for a tiling shown at the
time of an event). The two differ only where a function vanishes at that time. A float
filter decides where it can.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cmp_to_key
from itertools import chain
from math import isinf, isnan
from typing import Final, final

import numpy as np
from librt.vecs import vec
from numpy.typing import NDArray

from exactpt.certificates.exact_places import ExactPlaces
from exactpt.certificates.perturbation import (
    copies_first,
    cross,
    orientation_polynomial,
    x_order_terms,
)
from exactpt.certificates.positions import K, cross_sign, positions_at
from exactpt.certificates.predicates import Predicates
from exactpt.certificates.reasons import reason
from exactpt.filters.error_free import NOT_EXACT
from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U
from exactpt.geometry.predicates import Point, orientation
from exactpt.indices import Triple, VertexId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.counters import Counters
from exactpt.kernel.doubles import Floats, Indices, items
from exactpt.kernel.integer_polynomial import IntPoly, evaluate, sign_at
from exactpt.kernel.numbers import QQ, nearest_float, power_of_two, sign
from exactpt.motion.vertex import Vertex
from exactpt.motion.vertices import Vertices

STEPS: Final = 2.0**30
"""Number of units per unit of slope, as slopes are first compared in floats."""


def sorted_by_x(predicates: Predicates, ids: Iterable[VertexId]) -> list[VertexId]:
    """Distinct vertices from left to right."""
    if isinstance(predicates, PredicatesAt):
        return predicates.sorted_by_x(ids)
    return _sorted_exactly(predicates, ids)


def _sorted_exactly(predicates: Predicates, ids: Iterable[VertexId]) -> list[VertexId]:
    def order(a: VertexId, b: VertexId) -> int:
        return -1 if predicates.left_of(a, b) else 1

    return sorted(ids, key=cmp_to_key(order))


@final
class PredicatesAt(Predicates):
    """Positions and predicates at a rational time.

    Attributes:
        time: the time.
        after: whether the signs are those just after the time, or else those at it.
    """

    def __init__(
        self, vertices: Vertices, time: QQ, *, after: bool = True, exact_only: bool = False
    ) -> None:
        self.vertices = vertices
        self.time = time
        self.after = after
        self._counters: Counters = vertices.counters
        self._number = AlgebraicNumber(time)
        self._exact_only: bool = exact_only
        self._exact: dict[VertexId, Point] = {}
        # The error of a difference of coordinates is at most d plus its own rounding.
        self._xs, self._ys, error = positions_at(vertices, *vertices.normalization.time(time))
        self._x: vec[float] = vec[float](items(self._xs))
        self._y: vec[float] = vec[float](items(self._ys))
        d = self._d = 2.0 * error
        is_exact = d == 0.0 and not exact_only
        self._places = ExactPlaces(vertices, self._x, self._y, are_exact=is_exact, after=after)
        # The bound of `cross_sign` for the largest differences among these positions.
        width, height = _extent(self._xs), _extent(self._ys)
        self._largest_bound: float = (
            K * 2.0 * width * height + d * 2.0 * (width + height + d)
        ) * SLACK + TINY
        if exact_only:
            self._largest_bound = INFINITY

    @property
    def coordinates(self) -> tuple[Floats, Floats]:
        """The rounded coordinates x and y of all vertices, normalised; NaN without a bound."""
        return self._xs, self._ys

    def position(self, v: VertexId) -> Point:
        """Return the exact unperturbed position of a vertex."""
        found = self._exact.get(v)
        if found is None:
            x, y = self._x[v], self._y[v]
            is_exact = self._d == 0.0 and self.vertices.normalization.is_identity
            if is_exact and not isnan(x):
                found = QQ(*x.as_integer_ratio()), QQ(*y.as_integer_ratio())
            else:
                vertex = self.vertices.all[v]
                found = vertex.piece.position(vertex.index, self.time)
            self._exact[v] = found
        return found

    def orientation(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        """1 if a, b, c turn left, -1 if right, 0 if collinear (counts as right)."""
        x, y = self._x, self._y
        ax, ay = x[a], y[a]
        det = (x[b] - ax) * (y[c] - ay) - (y[b] - ay) * (x[c] - ax)
        if det > self._largest_bound:
            self._counters.filtered += 1
            return 1
        if det < -self._largest_bound:
            self._counters.filtered += 1
            return -1
        return self._sign_closely(a, b, c)

    def _sign_closely(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        if not self._exact_only:
            x, y, d = self._x, self._y, self._d
            s = cross_sign(x[b] - x[a], y[b] - y[a], d, x[c] - x[a], y[c] - y[a], d)
            if s:
                self._counters.filtered += 1
                return s
        return self._exact_sign(a, b, c)

    def signs(self, triples: Sequence[Triple]) -> list[int]:
        """Return the `sign` of each triple, in numpy."""
        if not triples:
            return []
        ids = np.fromiter(chain.from_iterable(triples), np.int64, 3 * len(triples))
        found: list[int] = self.signs_of(ids.reshape(-1, 3)).tolist()
        return found

    @np.errstate(all="ignore")
    def signs_of(self, ids: Indices) -> Indices:
        """Return the `sign` of each row of three ids, in numpy."""
        a, b, c = ids.T
        ux, uy = self._xs[b] - self._xs[a], self._ys[b] - self._ys[a]
        vx, vy = self._xs[c] - self._xs[a], self._ys[c] - self._ys[a]
        p, q = ux * vy, uy * vx
        det, d = p - q, self._d
        bound = (
            K * (abs(p) + abs(q)) + d * (abs(ux) + abs(uy) + abs(vx) + abs(vy) + 2.0 * d)
        ) * SLACK + TINY
        signs = np.where(det > bound, 1, np.where(det < -bound, -1, 0))
        if self._exact_only:
            signs[:] = 0
        unsure = np.flatnonzero(signs == 0)
        self._counters.filtered += len(ids) - len(unsure)
        for k, triple in zip(unsure.tolist(), ids[unsure].tolist(), strict=True):
            signs[k] = self._exact_sign(*triple)
        return signs

    def _exact_sign(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        check_budget()
        u, v, w = (self.vertices.all[i] for i in (a, b, c))
        are_copies = u.is_copy_of(v) or v.is_copy_of(w) or w.is_copy_of(u)
        s = 0 if are_copies else self._places.cross_sign(a, b, a, c)
        if s in (1, -1):
            self._counters.filtered += 1
            return s
        if s == NOT_EXACT:
            s = orientation(self.position(a), self.position(b), self.position(c))
        is_zero = s == 0 and not are_copies
        self._count(u, v, w, is_zero=is_zero)
        if not are_copies:
            motion = self.vertices.motion_of
            together = motion(a) == motion(b) == motion(c) >= 0
            if s or together or not self.after:
                return s
        elif s := self._sign_of_copies(u, v, w):
            return s
        return self.first_sign((orientation_polynomial(u, v, w),))

    def _count(self, *vertices: Vertex, is_zero: bool) -> None:
        why = reason(*vertices, is_zero=is_zero, exact_only=self._exact_only)
        self._counters.count_exact("sign", why)

    def _sign_of_copies(self, u: Vertex, v: Vertex, w: Vertex) -> int:
        """Return the sign of `perturbation.copy_orientation` at the time itself."""
        a, b, c = copies_first(u, v, w)
        (ax, ay), (bx, by) = self.offset(a.id), self.offset(b.id)
        (px, py), (qx, qy) = (
            (self.offset(i) if a.is_copy_of(c) else self.position(i)) for i in (a.id, c.id)
        )
        return sign((bx - ax) * (qy - py) - (by - ay) * (qx - px))

    def first_sign(self, terms: Iterable[IntPoly]) -> int:
        """Return the sign of the first term that is not zero: just after the time, or at it."""
        for f in terms:
            s = self._number.sign_after(f) if self.after else sign_at(f, self.time)
            if s:
                return s
        return 0

    def left_of(self, a: VertexId, b: VertexId) -> bool:
        """Return True if a is left of b; of equal x, the upper one counts as left."""
        difference = self._x[b] - self._x[a]
        bound = self._d + K * abs(difference)
        if not self._exact_only:
            if difference > bound:
                self._counters.filtered += 1
                return True
            if difference < -bound:
                self._counters.filtered += 1
                return False
            if s := self._places.order(a, b):
                self._counters.filtered += 1
                return s > 0
        (ax, _), (bx, _) = self.position(a), self.position(b)
        u, v = self.vertices.all[a], self.vertices.all[b]
        self._count(u, v, is_zero=ax == bx)
        if ax != bx:
            return ax < bx
        return self.first_sign(x_order_terms(u, v)) > 0

    def sorted_by_x(self, ids: Iterable[VertexId]) -> list[VertexId]:
        """Return vertices from left to right: sorted by doubles, and exactly where these are close.

        In the order of the doubles, every vertex before a gap wider than the error bound is
        certainly left of every vertex after the gap.
        """
        x, d = self._x, self._d
        order = sorted(ids, key=self._xs.item)
        if self._exact_only or any(isnan(x[v]) for v in order):
            return _sorted_exactly(self, order)
        first = 0
        for last in range(1, len(order) + 1):
            if last < len(order):
                gap = x[order[last]] - x[order[last - 1]]
                if not gap > d + K * gap:
                    continue
            if last - first > 1:
                order[first:last] = _sorted_exactly(self, order[first:last])
            first = last
        return order

    def descent(self, a: VertexId, b: VertexId) -> float:
        """Minus the slope of the line from a to b, a left of b, rounded down to 1 / `STEPS`.

        In units of 1 / `STEPS`. Rounding down is monotone, so if both ends of an enclosure
        are rounded to one number, so is the slope. The error of the quotient is bounded as in
        `exactpt.certificates.positions`. A line that is vertical at the time is steeper than
        any other, downwards or upwards.
        """
        dx, dy = self._x[b] - self._x[a], self._y[b] - self._y[a]
        ex, ey = self._d + K * abs(dx), self._d + K * abs(dy)
        if dx > 2.0 * ex and dx > SMALL and not self._exact_only:
            q = -dy / dx
            if self._places.is_slope(a, b, q):
                return q * STEPS // 1.0
            error = ((ey + abs(q) * ex) / (dx - ex) + 4.0 * U * abs(q)) * SLACK + TINY
            low = (q - error) * STEPS // 1.0
            if low == (q + error) * STEPS // 1.0:
                return low
        (ax, ay), (bx, by) = self.position(a), self.position(b)
        if ax == bx:
            return -INFINITY if by > ay else INFINITY
        scale = self.vertices.normalization.scale
        near = nearest_float((ay - by) / (bx - ax) * power_of_two(scale[0] - scale[1])) * STEPS
        return near if isinf(near) else near // 1.0

    def cross_sign(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """1 if the direction from a to b turns left to that from c to d, -1 if right."""
        now = self.cross_sign_now(a, b, c, d)
        if now or not self.after:
            return now
        p, q, r, s = (self.vertices.all[i].track for i in (a, b, c, d))
        return self._number.sign_after(cross(p, q, r, s))

    def cross_sign_now(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """Return the `cross_sign` at the time itself; 0 for parallel directions."""
        if not self._exact_only:
            x, y, off = self._x, self._y, self._d
            now = cross_sign(x[b] - x[a], y[b] - y[a], off, x[d] - x[c], y[d] - y[c], off)
            if now:
                self._counters.filtered += 1
                return now
        now = self._places.cross_sign(a, b, c, d)
        if now != NOT_EXACT:
            self._counters.filtered += 1
            return now
        p, q, r, s = (self.position(i) for i in (a, b, c, d))
        now = sign((q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]))
        self._count(*[self.vertices.all[i] for i in (a, b, c, d)], is_zero=now == 0)
        return now

    def middle(self, a: VertexId, b: VertexId, c: VertexId) -> VertexId:
        """Return the middle one of three collinear vertices."""
        if self.nearer(a, b, c):
            return b if self.nearer(c, b, a) else a
        return c if self.nearer(b, c, a) else a

    def nearer(self, p: VertexId, a: VertexId, b: VertexId) -> bool:
        """Return True if a is nearer to p than b is, for a and b in the same direction from p."""
        origin, u, v = self.position(p), self.position(a), self.position(b)
        if u == v:
            return self._copy_is_nearer(p, a, b)
        axis = 0 if u[0] != origin[0] or v[0] != origin[0] else 1
        return abs(u[axis] - origin[axis]) < abs(v[axis] - origin[axis])

    def _copy_is_nearer(self, p: VertexId, a: VertexId, b: VertexId) -> bool:
        """Return True if copy a of a vertex is displaced further towards p than its copy b."""
        (ax, ay), (bx, by) = self.offset(a), self.offset(b)
        (px, py), (x, y) = self.position(p), self.position(a)
        return (ax - bx) * (px - x) + (ay - by) * (py - y) > 0

    def offset(self, vertex_id: VertexId) -> Point:
        """Return the direction of a vertex's infinitesimal displacement; (0, 0) if it has none."""
        offset = self.vertices.all[vertex_id].offset
        if offset is None:
            return QQ(0), QQ(0)
        return evaluate(offset[0], self.time), evaluate(offset[1], self.time)


def _extent(values: NDArray[np.float64]) -> float:
    """Return the largest difference of two of the numbers, NaN ignored."""
    known = values[~np.isnan(values)]
    return float(np.ptp(known)) if len(known) else 0.0
