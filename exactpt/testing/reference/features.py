"""Vertices and edges that move: predicates at an algebraic time, and the polynomials behind them.

A vector of a track is given times a positive function, the product of the denominators of its
ends; so the signs are right.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, product
from typing import NamedTuple

from exactpt.kernel.integer_polynomial import IntPoly, derivative, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.motion.body import Body
from exactpt.motion.track import Track, difference, dot, orientation_polynomial, vector
from exactpt.testing.reference.shapes import edges_of
from exactpt.testing.reference.times import Instant, Tracks


class Corner(NamedTuple):
    """A vertex of one body, and the ends of an edge of another."""

    vertex: Track
    start: Track
    end: Track


class Ratio(NamedTuple):
    """A quotient of polynomials; the denominator is never negative."""

    numerator: IntPoly
    denominator: IntPoly


def corners(a: Body, b: Body, p: Tracks, q: Tracks) -> Iterator[Corner]:
    """Yield every vertex of each body with every edge of the other; a point has no edges."""
    yield from (Corner(v, p[k], p[l]) for v, (k, l) in product(q, a.edges))
    yield from (Corner(v, q[k], q[l]) for v, (k, l) in product(p, b.edges))


def orientations(p: Tracks, q: Tracks = ()) -> Iterator[IntPoly]:
    """Yield the orientation of every three vertices."""
    for three in combinations([*p, *q], 3):
        yield orientation_polynomial(*three)


def coordinate_differences(p: Tracks, q: Tracks) -> Iterator[IntPoly]:
    """Yield the differences of x, and of y, of every vertex of one body and one of the other."""
    for u, v in product(p, q):
        yield from vector(u, v)


def is_between(t: Instant, v: Track, a: Track, b: Track) -> bool:
    """Return True if v, on the line ab, is in the closed segment: in its box."""
    for to_a, to_b in zip(vector(v, a), vector(v, b), strict=True):
        if t.sign_of(to_a) * t.sign_of(to_b) > 0:
            return False
    return True


def is_on_segment(t: Instant, v: Track, a: Track, b: Track) -> bool:
    """Return True if v is in the closed segment ab."""
    return t.sign_of(orientation_polynomial(a, b, v)) == 0 and is_between(t, v, a, b)


def segments_meet(t: Instant, a: Track, b: Track, c: Track, d: Track) -> bool:
    """Return True if the closed segments ab and cd share a point."""
    c_side, d_side = (t.sign_of(orientation_polynomial(a, b, v)) for v in (c, d))
    a_side, b_side = (t.sign_of(orientation_polynomial(c, d, v)) for v in (a, b))
    if c_side * d_side < 0 and a_side * b_side < 0:
        return True
    return (
        (c_side == 0 and is_between(t, c, a, b))
        or (d_side == 0 and is_between(t, d, a, b))
        or (a_side == 0 and is_between(t, a, c, d))
        or (b_side == 0 and is_between(t, b, c, d))
    )


def is_inside(t: Instant, v: Track, body: Body, p: Tracks) -> bool:
    """Return True if a vertex that is on no edge of a body is in its interior.

    The edges that a ray to the right crosses are counted.
    """
    inside = False
    for i, j in body.edges:
        a, b = p[i], p[j]
        a_is_above, b_is_above = (t.sign_of(difference(v.y, v.w, u.y, u.w)) > 0 for u in (a, b))
        if a_is_above != b_is_above:
            is_left = t.sign_of(orientation_polynomial(a, b, v)) > 0
            inside ^= is_left == b_is_above
    return body.has_interior and inside


def bodies_meet(t: Instant, a: Body, b: Body, p: Tracks, q: Tracks) -> bool:
    """Return True if two bodies share a point; bodies without radii, or the cores of others."""
    return (
        any(
            segments_meet(t, p[i], p[j], q[k], q[l])
            for (i, j), (k, l) in product(edges_of(a), edges_of(b))
        )
        or any(is_inside(t, p[ring.start], b, q) for ring in a.rings)
        or any(is_inside(t, q[ring.start], a, p) for ring in b.rings)
    )


def squared_of_vertices(u: Track, v: Track) -> Ratio:
    """Return the squared distance of two vertices."""
    w = multiply(u.w, v.w)
    return Ratio(dot(vector(u, v), vector(u, v)), multiply(w, w))


def squared_from_line(corner: Corner) -> Ratio:
    """Return the squared distance of the vertex from the line of the edge.

    That is (e x f)^2 / e^2 with e from one end of the edge to the other, f from there to the
    vertex. It is 0 / 0 where the edge is a point.
    """
    v, a, b = corner
    along, to_vertex = vector(a, b), vector(a, v)
    area = subtract(multiply(along[0], to_vertex[1]), multiply(along[1], to_vertex[0]))
    w = multiply(a.w, v.w)
    return Ratio(multiply(area, area), multiply(multiply(w, w), dot(along, along)))


def excess(ratio: Ratio, number: QQ) -> IntPoly:
    """Return a polynomial: positive where a quotient is more than a number, zero where equal."""
    return subtract(
        scale(ratio.numerator, ZZ(number.denominator)),
        scale(ratio.denominator, ZZ(number.numerator)),
    )


def slope(ratio: Ratio) -> IntPoly:
    """Return a polynomial with the sign of the derivative of a quotient."""
    n, d = ratio
    return subtract(multiply(derivative(n), d), multiply(n, derivative(d)))


def sides_of_foot(corner: Corner) -> tuple[IntPoly, IntPoly]:
    """Return two polynomials; the foot of the vertex is inside the edge where both are positive."""
    v, a, b = corner
    return dot(vector(a, b), vector(a, v)), dot(vector(b, a), vector(b, v))


def has_foot(t: Instant, corner: Corner) -> bool:
    """Return True if the foot of the perpendicular from the vertex is inside the edge."""
    return all(t.sign_of(f) > 0 for f in sides_of_foot(corner))
