"""Squared distances of moving features as quotients of polynomials in time.

The distance of two disjoint bodies is that of a vertex of one to a vertex of the other, or to
the interior of an edge of it, at the foot of the perpendicular. With trajectories (x / w, y / w),
w > 0, and the determinant d = |a b v| of the rows (x, y, w):

* vertices u, v: ((x_v w_u - x_u w_v)^2 + (y_v w_u - y_u w_v)^2) / (w_u w_v)^2;
* vertex v, line ab: d^2 / (w_v^2 n), where n / (w_a w_b)^2 is the squared length of ab; the foot
  is on the edge where (b - a) . (v - a) >= 0 and (a - b) . (v - b) >= 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple, final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.incidence import difference, orientation
from exactpt.motion.track import Track

__all__ = ["Feature", "FeaturePair", "excess", "feature_pair", "feature_pairs"]


class Feature(NamedTuple):
    """A vertex or an edge of a body; the other one of the two is None.

    Attributes:
        vertex: the number of the vertex.
        edge: the number of the edge, which goes from the vertex of that number to the next.
    """

    vertex: int | None
    edge: int | None


@final
class FeaturePair:
    """A vertex of a body, and a vertex or an edge of another one.

    Args:
        features: of the first body and of the second one.
        v: the trajectory of the vertex.
        ends: those of the ends of the edge; of the other vertex alone.

    Attributes:
        is_of_edge: whether the other feature is an edge.
    """

    def __init__(
        self, features: tuple[Feature, Feature], v: Track, ends: tuple[Track, ...]
    ) -> None:
        self.features = features
        self.v = v
        self.ends = ends
        self.is_of_edge = len(ends) == 2

    @cached_property
    def squared(self) -> tuple[IntPoly, IntPoly]:
        """Numerator and denominator, neither ever negative, of the squared distance."""
        return _squared(self.v, self.ends)

    @cached_property
    def limits(self) -> tuple[IntPoly, ...]:
        """Polynomials that are not negative where the foot is on the edge; none of a vertex."""
        if not self.is_of_edge:
            return ()
        a, b = self.ends
        return _dot(a, b, self.v), _dot(b, a, self.v)

    def at_distance(self, squared: QQ) -> IntPoly:
        """A polynomial that is positive where the squared distance is larger, 0 where equal."""
        return _excess(self.squared, squared)

    def holds(self, t: AlgebraicNumber) -> bool:
        """Whether the foot of the perpendicular is on the edge, which has a length."""
        return all(t.sign_of(f) >= 0 for f in self.limits) and (
            not self.is_of_edge or t.sign_of(_norm(*self.ends)) > 0
        )

    def first_time(self, squared: QQ, begin: AlgebraicNumber, until: QQ) -> AlgebraicNumber | None:
        """Return the first time in (begin, until] at which the squared distance has a value.

        The foot of the perpendicular is on the edge at that time. None if there is no such time,
        or the distance of the line has this value for all t.
        """
        f = self.at_distance(squared)
        for root in roots_after(f, begin, until) if f else ():
            if self.holds(root.time):
                return root.time
        return None

    def is_inside(self, t: AlgebraicNumber) -> bool:
        """Whether the foot of the perpendicular is no end of the edge; true of two vertices."""
        return all(t.sign_of(f) > 0 for f in self.limits)

    def holds_after(self, t: AlgebraicNumber) -> bool:
        """Whether it is so just after a time."""
        return all(t.sign_after(f) >= 0 for f in self.limits) and (
            not self.is_of_edge or t.sign_after(_norm(*self.ends)) > 0
        )


def excess(v: Track, ends: tuple[Track, ...], squared: QQ) -> IntPoly:
    """A polynomial that is positive where a vertex is farther away than a distance.

    Args:
        v: the trajectory of the vertex.
        ends: that of another vertex, or those of the ends of an edge, of whose line it is.
        squared: the square of the distance.
    """
    return _excess(_squared(v, ends), squared)


def _excess(ratio: tuple[IntPoly, IntPoly], squared: QQ) -> IntPoly:
    n, d = ratio
    return subtract(scale(n, ZZ(squared.denominator)), scale(d, ZZ(squared.numerator)))


def _squared(v: Track, ends: tuple[Track, ...]) -> tuple[IntPoly, IntPoly]:
    """Numerator and denominator of the squared distance."""
    if len(ends) == 1:
        w = multiply(ends[0].w, v.w)
        return _norm(ends[0], v), multiply(w, w)
    a, b = ends
    d = orientation(a, b, v)
    return multiply(d, d), multiply(multiply(v.w, v.w), _norm(a, b))


def feature_pairs(
    a: Body, b: Body, p: tuple[Track, ...], q: tuple[Track, ...]
) -> Iterator[FeaturePair]:
    """All pairs of a vertex of one body and a vertex or an edge of the other."""
    count = len(p) * len(q) + len(a.edges) * len(q) + len(p) * len(b.edges)
    return (feature_pair(a, b, p, q, k) for k in range(count))


def feature_pair(
    a: Body, b: Body, p: tuple[Track, ...], q: tuple[Track, ...], number: int
) -> FeaturePair:
    """The pair of this number: pairs of vertices, then edges of the first body, of the second."""
    i, j = divmod(number, len(q))
    if i < len(p):
        return FeaturePair((_vertex(i), _vertex(j)), q[j], (p[i],))
    e = i - len(p)
    if e < len(a.edges):
        k, l = a.edges[e]
        return FeaturePair((_edge(e), _vertex(j)), q[j], (p[k], p[l]))
    i, e = divmod(number - (len(p) + len(a.edges)) * len(q), len(b.edges))
    k, l = b.edges[e]
    return FeaturePair((_vertex(i), _edge(e)), p[i], (q[k], q[l]))


def _vertex(number: int) -> Feature:
    return Feature(number, None)


def _edge(number: int) -> Feature:
    return Feature(None, number)


def _norm(a: Track, b: Track) -> IntPoly:
    """The squared distance of two vertices times (w_a w_b)^2."""
    x, y = difference(a.x, a.w, b.x, b.w), difference(a.y, a.w, b.y, b.w)
    return add(multiply(x, x), multiply(y, y))


def _dot(a: Track, b: Track, v: Track) -> IntPoly:
    """(b - a) . (v - a), times a positive factor."""
    along_x = multiply(difference(a.x, a.w, b.x, b.w), difference(a.x, a.w, v.x, v.w))
    along_y = multiply(difference(a.y, a.w, b.y, b.w), difference(a.y, a.w, v.y, v.w))
    return add(along_x, along_y)
