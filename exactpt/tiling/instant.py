"""Predicates at one rational time, for the static constructions.

Two ways to ask: for the signs just after the time (a scene that starts on an event is
kept as it is right after), or for those at the time itself (a tiling that is shown at the
very time of an event). The two differ only for what vanishes at that time. A float filter
decides where it can.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cmp_to_key
from typing import TYPE_CHECKING, Final, final

from exactpt.geometry.predicates import Point, side
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import counters
from exactpt.kernel.integer_polynomial import IntPoly, evaluate, sign_at
from exactpt.kernel.numbers import QQ, sign
from exactpt.motion.vertices import Vertex, Vertices
from exactpt.tiling.exact import copies_first, cross, orientation, x_order_terms
from exactpt.tiling.reasons import reason

if TYPE_CHECKING:
    from exactpt.tiling.greedy.shadow import Predicates

__all__ = ["Instant", "sorted_by_x"]

U: Final = 2.0**-53
TINY: Final = 1e-290


def sorted_by_x(predicates: Predicates, ids: Iterable[int]) -> list[int]:
    """Different vertices from left to right."""

    def order(a: int, b: int) -> int:
        return -1 if predicates.left_of(a, b) else 1

    return sorted(ids, key=cmp_to_key(order))


@final
class Instant:
    """Positions and predicates at a rational time.

    Attributes:
        time: the time.
        after: whether signs are those just after it; else, those at it.
        positions: the exact unperturbed position of every vertex, by id.
    """

    def __init__(
        self, vertices: Vertices, time: QQ, *, after: bool = True, exact_only: bool = False
    ) -> None:
        self.vertices = vertices
        self.time = time
        self.after = after
        self._number = AlgebraicNumber(time)
        self._exact_only: bool = exact_only
        self.positions: list[tuple[QQ, QQ]] = []
        for vertex in vertices.all:
            self.positions.append(vertex.track.at(time))
        self._x: list[float] = []
        self._y: list[float] = []
        largest, exact = 0.0, True
        for position in self.positions:
            x, y = vertices.frame.point(position)
            self._x.append(x)
            self._y.append(y)
            largest = max(largest, abs(x), abs(y))
            exact = exact and position == (QQ(x), QQ(y))
        # Each float coordinate is off by at most one unit of the largest.
        self._error: float = 0.0 if exact else 2.0 * U * largest

    def sign(self, a: int, b: int, c: int) -> int:
        """1 if a, b, c turn left, -1 if right, 0 if collinear (counts as right).

        With coordinates off by d / 2 = U * largest each, differences are off by d and
        their own rounding; the rest is as in `exactpt.tiling.coefficients`.
        """
        x, y = self._x, self._y
        ux, uy = x[b] - x[a], y[b] - y[a]
        vx, vy = x[c] - x[a], y[c] - y[a]
        p, q = ux * vy, uy * vx
        det = p - q
        d = self._error
        bound = (
            8.0 * U * (abs(p) + abs(q))
            + d * (abs(ux) + abs(uy) + abs(vx) + abs(vy) + 2.0 * d) * (1.0 + 1e-10)
            + TINY
        )
        if not self._exact_only:
            if det > bound:
                counters.filtered += 1
                return 1
            if det < -bound:
                counters.filtered += 1
                return -1
        u, v, w = (self.vertices.all[i] for i in (a, b, c))
        are_copies = u.track is v.track or v.track is w.track or w.track is u.track
        s = 0 if are_copies else side(*(self.positions[i] for i in (a, b, c)))
        is_zero = s == 0 and not are_copies
        why = reason(u, v, w, is_zero=is_zero, exact_only=self._exact_only)
        counters.count_exact("sign", why)
        if not are_copies:
            together = u.image.motion == v.image.motion == w.image.motion >= 0
            if s or together or not self.after:
                return s
        elif s := self._sign_of_copies(u, v, w):
            return s
        return self.first_sign((orientation(u, v, w),))

    def _sign_of_copies(self, u: Vertex, v: Vertex, w: Vertex) -> int:
        """The sign of `copy_orientation` at the time itself."""
        a, b, c = copies_first(u, v, w)
        (ax, ay), (bx, by) = self.offset(a.id), self.offset(b.id)
        (px, py), (qx, qy) = (
            (self.offset(i) if a.track is c.track else self.positions[i]) for i in (a.id, c.id)
        )
        return sign((bx - ax) * (qy - py) - (by - ay) * (qx - px))

    def all_stay_convex(self) -> bool:
        """Whether all bodies are convex and stay so; at a vertex, an angle of pi will do."""
        v = self.vertices.all
        return all(
            not body.is_tiled and all(self.sign(v[p].ahead, p, v[p].behind) <= 0 for p in body.ring)
            for body in self.vertices.bodies
        )

    def first_sign(self, terms: Iterable[IntPoly]) -> int:
        """The sign of the first term that is not zero: for ever, or at the time."""
        for f in terms:
            s = self._number.sign_after(f) if self.after else sign_at(f, self.time)
            if s:
                return s
        return 0

    def left_of(self, a: int, b: int) -> bool:
        """Whether a comes before b from left to right (of equal x the upper one first)."""
        (ax, _), (bx, _) = self.positions[a], self.positions[b]
        if ax != bx:
            return ax < bx
        v = self.vertices.all
        return self.first_sign(x_order_terms(v[a], v[b])) > 0

    def turn(self, a: int, b: int, c: int, d: int) -> int:
        """1 if the direction from a to b turns left to that from c to d, -1 if right."""
        p, q, r, s = (self.positions[i] for i in (a, b, c, d))
        now = sign((q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]))
        if now or not self.after:
            return now
        v = self.vertices.all
        return self._number.sign_after(cross(v[a].track, v[b].track, v[c].track, v[d].track))

    def middle(self, a: int, b: int, c: int) -> int:
        """Of three collinear vertices, the one between the others."""
        if self.nearer(a, b, c):
            return b if self.nearer(c, b, a) else a
        return c if self.nearer(b, c, a) else a

    def nearer(self, p: int, a: int, b: int) -> bool:
        """Whether a is nearer to p than b is, for a and b in one direction from p."""
        origin, u, v = self.positions[p], self.positions[a], self.positions[b]
        if u == v:
            return self._copy_is_nearer(p, a, b)
        axis = 0 if u[0] != origin[0] or v[0] != origin[0] else 1
        return abs(u[axis] - origin[axis]) < abs(v[axis] - origin[axis])

    def _copy_is_nearer(self, p: int, a: int, b: int) -> bool:
        """Of two copies of a thin vertex, the one whose offset points towards p."""
        (ax, ay), (bx, by) = self.offset(a), self.offset(b)
        (px, py), (x, y) = self.positions[p], self.positions[a]
        return (ax - bx) * (px - x) + (ay - by) * (py - y) > 0

    def offset(self, vertex_id: int) -> Point:
        """The direction of a vertex's infinitesimal offset; (0, 0) unless its body is thin."""
        offset = self.vertices.all[vertex_id].offset
        if offset is None:
            return QQ(0), QQ(0)
        return evaluate(offset[0], self.time), evaluate(offset[1], self.time)
