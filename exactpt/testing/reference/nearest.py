"""How near two bodies are at a time, and when they are nearest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import quotient_at
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, Rational, fraction, rational
from exactpt.motion.body import Body
from exactpt.testing.reference.features import (
    corners,
    has_foot,
    sides_of_foot,
    slope,
    squared_from_line,
    squared_of_vertices,
)
from exactpt.testing.reference.shapes import (
    Points,
    bodies_meet,
    squared_distance,
    squared_to_interior,
)
from exactpt.testing.reference.times import Piece, critical_times, pieces
from exactpt.testing.reference.within import first_within

__all__ = ["Least", "Nearest", "Place", "least_distance", "nearest"]


class Place(NamedTuple):
    """A vertex of a body, or the inside of one of its edges, by its number; the other is None."""

    vertex: int | None
    edge: int | None


class Nearest(NamedTuple):
    """The distance of two bodies at a time.

    Attributes:
        core_squared: the square of the distance of the cores, the bodies without their radii.
        features: all pairs of places at that distance, of the first body and of the second. None
            if cores share a point, but no vertex of one of them is on the other's boundary.
    """

    core_squared: Fraction
    features: frozenset[tuple[Place, Place]]


class Least(NamedTuple):
    """The least distance of two bodies in a time span, and the first time of it.

    Attributes:
        time: the exact time.
        core_squared: the square of the distance of the cores, the bodies without their radii.
    """

    time: AlgebraicNumber
    core_squared: AlgebraicNumber


def nearest(a: Body, b: Body, at: Rational) -> Nearest:
    """Return the distance of two bodies at a rational time.

    >>> from exactpt import Body
    >>> found = nearest(Body("a", [(0, 0), (4, 0)]), Body("b", [(1, 3)]), 0)
    >>> found.core_squared, [*found.features]
    (Fraction(9, 1), [(Place(vertex=None, edge=0), Place(vertex=0, edge=None))])

    Args:
        a: a body.
        b: another one.
        at: the time.
    """
    t = rational(at)
    p, q = a.exact_at(t), b.exact_at(t)
    found = [*_distances(a, b, p, q)]
    least = min(squared for squared, _ in found)
    if least and bodies_meet(a, p, b, q):
        return Nearest(Fraction(0), frozenset())
    features = frozenset(pair for squared, pair in found if squared == least)
    return Nearest(fraction(least), features)


def _distances(a: Body, b: Body, p: Points, q: Points) -> Iterator[tuple[QQ, tuple[Place, Place]]]:
    """Yield the squared distance of every two vertices, and of every vertex above an edge."""
    for (i, u), (j, v) in product(enumerate(p), enumerate(q)):
        yield squared_distance(u, v), (Place(i, None), Place(j, None))
    for (i, u), (e, (k, l)) in product(enumerate(p), enumerate(b.edges)):
        squared = squared_to_interior(u, q[k], q[l])
        if squared is not None:
            yield squared, (Place(i, None), Place(None, e))
    for (e, (k, l)), (j, v) in product(enumerate(a.edges), enumerate(q)):
        squared = squared_to_interior(v, p[k], p[l])
        if squared is not None:
            yield squared, (Place(None, e), Place(j, None))


def least_distance(a: Body, b: Body, time: Sequence[Rational]) -> Least:
    """Return the least distance of two bodies in a time span.

    If they share a point, it is 0, first when they first do. If not, the distance is that of two
    vertices, or of a vertex and an edge above which it is. Such a distance is least where its
    derivative is zero, or where a motion begins or ends. Where the foot comes to an end of the
    edge, the distance from that vertex takes over with the same derivative.

    >>> from exactpt import Body, Translation
    >>> ball = Body("ball", [(0, 3)], Translation([-4, 1]))
    >>> least_distance(ball, Body("point", [(0, 0)]), (0, 10))
    Least(time=AlgebraicNumber('4'), core_squared=AlgebraicNumber('9'))

    Args:
        a: a body.
        b: another one.
        time: the start and the end of the time span.
    """
    start, end = map(rational, time)
    first = first_within(a, b, time, 0)
    if first is not None:
        return Least(first, AlgebraicNumber(0))
    candidates = [least for piece in pieces(a, b, start, end) for least in _least_ones(a, b, piece)]
    squared = min(least.core_squared for least in candidates)
    return Least(min(t for t, value in candidates if value == squared), squared)


def _least_ones(a: Body, b: Body, piece: Piece) -> Iterator[Least]:
    """Yield the distance of every two features at all times at which it may be the least."""
    p, q = piece.first, piece.second
    for u, v in product(p, q):
        ratio = squared_of_vertices(u, v)
        for t in _candidates([slope(ratio)], piece):
            yield Least(t, quotient_at(ratio.numerator, ratio.denominator, t))
    for corner in corners(a, b, p, q):
        ratio = squared_from_line(corner)
        for t in _candidates([slope(ratio), *sides_of_foot(corner)], piece):
            if has_foot(t, corner):
                yield Least(t, quotient_at(ratio.numerator, ratio.denominator, t))


def _candidates(polynomials: Iterable[IntPoly], piece: Piece) -> list[AlgebraicNumber]:
    begin = AlgebraicNumber(piece.begin)
    return [begin, *critical_times(polynomials, piece.begin, piece.end)]
