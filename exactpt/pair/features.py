"""Squared distances of moving features as quotients of polynomials in time.

The distance of two disjoint bodies is that of a vertex of one to a vertex of the other, or to
the interior of an edge of it, at the foot of the perpendicular. With trajectories (x / w, y / w),
w > 0, and the determinant d = |a b v| of the rows (x, y, w):

* vertices u, v: ((x_v w_u - x_u w_v)^2 + (y_v w_u - y_u w_v)^2) / (w_u w_v)^2;
* vertex v, line ab: d^2 / (w_v^2 n), where n / (w_a w_b)^2 is the squared length of ab; the foot
  is on the edge where (b - a) . (v - a) >= 0 and (a - b) . (v - b) >= 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, final

from exactpt.brief import record_in_brief
from exactpt.cached_property import cached_property
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import lowest_terms
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    greatest_common_divisor,
    multiply,
    scale,
    subtract,
)
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence, Track, dot, orientation_polynomial, vector, vertex_touch


class Feature(NamedTuple):
    """A vertex or an edge of a body; one of the two fields is None.

    Attributes:
        vertex: the number of the vertex.
        edge: the number of the edge, which goes from the vertex of that number to the next.
    """

    vertex: int | None
    edge: int | None

    def __repr__(self) -> str:
        return record_in_brief(self)


@final
class FeaturePair:
    """A vertex of a body, and a vertex or an edge of another body.

    Args:
        touch: the vertex, and the other vertex or the edge.
        v: the trajectory of the vertex.
        ends: those of the ends of the edge; of the other vertex alone.

    Attributes:
        is_of_edge: whether the other feature is an edge.
    """

    def __init__(self, touch: Incidence, v: Track, ends: tuple[Track, ...]) -> None:
        self.touch = touch
        self.v = v
        self.ends = ends
        self.is_of_edge = len(ends) == 2

    @property
    def features(self) -> tuple[Feature, Feature]:
        """The features of the lower and of the higher body."""
        body, vertex, other, edge, other_vertex = self.touch
        one = Feature(vertex, None)
        two = Feature(other_vertex, None) if edge < 0 else Feature(None, edge)
        return (one, two) if body < other else (two, one)

    @cached_property
    def squared(self) -> tuple[IntPoly, IntPoly]:
        """Numerator and denominator, neither ever negative, of the squared distance."""
        v, end = self.v, self.ends[0]
        if not self.is_of_edge:
            w = multiply(end.w, v.w)
            return _squared_length(vector(end, v)), multiply(w, w)
        d = self.at_distance(QQ(0))
        return multiply(d, d), multiply(multiply(v.w, v.w), _squared_length(self._along))

    @cached_property
    def lowest(self) -> tuple[IntPoly, IntPoly]:
        """`squared` without a common factor; of rigid bodies of a much lower degree."""
        return lowest_terms(*self.squared)

    @cached_property
    def limits(self) -> tuple[IntPoly, ...]:
        """Polynomials that are not negative where the foot is on the edge; none of a vertex."""
        return (self._from_first, self._from_last) if self.is_of_edge else ()

    @cached_property
    def _from_first(self) -> IntPoly:
        return dot(self._direction, vector(self.ends[0], self.v))

    @cached_property
    def _from_last(self) -> IntPoly:
        return dot(self._direction, vector(self.v, self.ends[1]))

    @cached_property
    def _direction(self) -> tuple[IntPoly, IntPoly]:
        """The vector of the edge, times a positive factor that is small.

        The ends of an edge of a turning body have one denominator w. With its square as a factor,
        signs are those of a longer polynomial, which has w in common with the orientation.
        """
        a, b = self.ends
        if a.w == b.w:
            return subtract(b.x, a.x), subtract(b.y, a.y)
        return self._along

    @cached_property
    def _along(self) -> tuple[IntPoly, IntPoly]:
        """The vector of the edge, times the denominators of both ends."""
        return vector(*self.ends)

    def at_distance(self, squared: QQ) -> IntPoly:
        """Return a polynomial that is positive where the squared distance is larger, 0 where equal.

        That of the line, of an edge. If the distance is 0, a polynomial that is 0 there alone, of
        any sign elsewhere: the orientation, or a common factor of the differences in x and in y.
        """
        if squared:
            n, d = self.squared
            return subtract(scale(n, ZZ(squared.denominator)), scale(d, ZZ(squared.numerator)))
        if self.is_of_edge:
            a, b = self.ends
            return orientation_polynomial(a, b, self.v)
        dx, dy = vector(self.v, self.ends[0])
        if len(dx) == len(dy) == 2 and dx[0] * dy[1] != dx[1] * dy[0]:
            return (ZZ(1),)
        return greatest_common_divisor(dx, dy) if dx and dy else dx or dy

    def holds(self, t: AlgebraicNumber) -> bool:
        """Return True if the foot of the perpendicular is on the edge, which has a length."""
        return self._is_on(t.sign_of)

    def holds_after(self, t: AlgebraicNumber) -> bool:
        """Return True if it is so just after a time."""
        return self._is_on(t.sign_after)

    def _is_on(self, sign: Callable[[IntPoly], int]) -> bool:
        """Return True if no limit is negative, and not both are 0: as for an edge of length 0."""
        if not self.is_of_edge:
            return True
        first = sign(self._from_first)
        return first >= 0 and (last := sign(self._from_last)) >= 0 and first + last > 0

    def first_time(self, squared: QQ, begin: AlgebraicNumber, until: QQ) -> AlgebraicNumber | None:
        """Return the first time in (begin, until] at which the squared distance has a value.

        The foot of the perpendicular is on the edge at that time. None without such a time, or
        if the distance of the line has this value for all t; if that is 0, the vertex enters the
        edge at one of its ends.
        """
        f = self.at_distance(squared)
        if self.is_of_edge and not f and not squared:
            ends = [FeaturePair(self.touch, self.v, (end,)) for end in self.ends]
            times = [pair.first_time(squared, begin, until) for pair in ends]
            return min((time for time in times if time is not None), default=None)
        for root in roots_after(f, begin, until) if f else ():
            if self.holds(root.time):
                return root.time
        return None

    def touch_at(self, t: AlgebraicNumber, ends: Sequence[int]) -> Incidence:
        """Return the incidence while the foot is on the edge; at an end, with that vertex.

        Args:
            t: the time.
            ends: the numbers of the ends.
        """
        body, vertex, other, *_ = self.touch
        for end, f in zip(ends, self.limits, strict=False):
            if t.sign_of(f) == 0:
                return vertex_touch(body, vertex, other, end)
        return self.touch

    def is_inside(self, t: AlgebraicNumber) -> bool:
        """Return True for two vertices, or if the foot of the perpendicular is inside the edge."""
        return all(t.sign_of(f) > 0 for f in self.limits)


def feature_pairs(
    a: Body,
    b: Body,
    p: tuple[Track, ...],
    q: tuple[Track, ...],
    numbers: Iterable[int] | None = None,
) -> Iterator[FeaturePair]:
    """Yield all pairs of a vertex of one body and a vertex or an edge of the other.

    Args:
        a: a body.
        b: the other body.
        p: the trajectories of the vertices of the first body.
        q: those of the second body.
        numbers: the numbers of the pairs to yield, if not all. Pairs of vertices have the first
            ones, then edges of the first body with vertices, then vertices with edges.
    """
    edges, others, n, m = a.edges, b.edges, len(p), len(q)
    everything = range(n * m + len(edges) * m + n * len(others))
    for number in everything if numbers is None else numbers:
        i, j = divmod(number, m)
        if i < n:
            yield FeaturePair(Incidence(0, i, 1, -1, j), p[i], (q[j],))
        elif (e := i - n) < len(edges):
            k, l = edges[e]
            yield FeaturePair(Incidence(1, j, 0, e, -1), q[j], (p[k], p[l]))
        else:
            i, e = divmod(number - (n + len(edges)) * m, len(others))
            k, l = others[e]
            yield FeaturePair(Incidence(0, i, 1, e, -1), p[i], (q[k], q[l]))


def _squared_length(u: tuple[IntPoly, IntPoly]) -> IntPoly:
    return dot(u, u)
