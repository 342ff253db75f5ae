"""Exact first contact in space of a vertex and a face, and of two edges.

The closed triangle (segment) at a time is the convex hull of its vertices at that time, also
where these coincide or are collinear. All vertices move linearly during [0, 1]. The first
contact is the least t in [0, 1] at which the two sets share a point; it exists if they ever do,
since the times of contact are a closed set.

**Candidates.** Let there be no contact at 0, and let T > 0 be the time of the first contact. The
four vertices are coplanar at T, so T is a root of their coplanarity polynomial, a cubic.

If the cubic is identically zero, then the vertex is on an edge of the face at T (an end of one
edge is on the other edge). Otherwise the vertex would be in the interior of a triangle that is
not degenerate (the edges would cross at inner points of both, without being parallel); since all
stays in one plane, that would hold just before T, too, and T would not be the first. (A
degenerate triangle is the union of its edges; if parallel or degenerate edges share a point, an
end of one is on the other.)

So T is the first time of one of several pairs of a point and a segment PQ. Let P and Q be
relative to the point. They are collinear with the point at T, so T is a root of each component
of P x Q. If P x Q is identically zero, then P or Q is zero at T: otherwise the point would be
strictly between P and Q, and since all stays on one line, just before T, too. P is not
identically zero (there would be a contact at 0), so T is a root of a component of P that is not
identically zero, or of one of Q.

Each candidate is tested exactly, in increasing order. At a time at which the four vertices are
coplanar, all cross products of vectors between them are multiples of one normal, so ratios of
these are ratios of one component.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import lcm
from typing import Final, TypeAlias, final

from exactpt.cached_property import cached_property
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import quotient_at
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, subtract, trimmed
from exactpt.kernel.numbers import QQ, ZZ, Rational
from exactpt.kernel.roots import roots_after
from exactpt.testing.space.queries import Kind, SpaceQuery, read_points

Vector: TypeAlias = tuple[IntPoly, IntPoly, IntPoly]
"""A vector whose components are integer polynomials in t."""
Quotient: TypeAlias = tuple[IntPoly, IntPoly]
"""Numerator and denominator, which does not vanish at the time in question."""

ONE: Final = QQ(1)
ZERO_QUOTIENT: Final[Quotient] = ((), (ZZ(1),))


@final
class SpaceContact:
    """The first contact of a vertex and a face, or of two edges.

    Attributes:
        time: the exact time, in [0, 1].
    """

    def __init__(self, time: AlgebraicNumber, coordinates: tuple[Quotient, Quotient]) -> None:
        self.time = time
        self._coordinates = coordinates

    @cached_property
    def coordinates(self) -> tuple[AlgebraicNumber, AlgebraicNumber]:
        """The point of contact in barycentric coordinates (u, v), exactly.

        On a face abc the point is a + u (b - a) + v (c - a), with u, v >= 0 and u + v <= 1. On
        edges ab and cd it is a + u (b - a) = c + v (d - c), with u and v in [0, 1]. If several
        points are common, or several pairs denote one point, this is the lexicographically
        least pair.
        """
        (n, d), (m, e) = self._coordinates
        return quotient_at(n, d, self.time), quotient_at(m, e, self.time)

    def to_json(self) -> dict[str, object]:
        """Return the contact as a JSON object, see docs/testing.md."""
        u, v = self.coordinates
        return {"time": self.time.to_json(), "coordinates": [u.to_json(), v.to_json()]}

    def __repr__(self) -> str:
        return f"<SpaceContact at t = {float(self.time)!r}>"


def vertex_face(
    start: Sequence[Sequence[Rational]], end: Sequence[Sequence[Rational]]
) -> SpaceContact | None:
    """Return the first contact of a vertex and a triangle in space; None if there is none.

    Args:
        start: the vertex and the three vertices of the triangle at t = 0, four points
            (x, y, z) of rationals; doubles have their exact values.
        end: the same vertices at t = 1. Each vertex moves linearly in between.

    Raises:
        InputError: if there are not four points of three finite numbers each.
    """
    return first_contact_of("vertex-face", start, end)


def edge_edge(
    start: Sequence[Sequence[Rational]], end: Sequence[Sequence[Rational]]
) -> SpaceContact | None:
    """Return the first contact of two segments in space; None if there is none.

    Args:
        start: the ends of the first segment and the ends of the second at t = 0, four points
            (x, y, z) of rationals; doubles have their exact values.
        end: the same vertices at t = 1. Each vertex moves linearly in between.

    Raises:
        InputError: if there are not four points of three finite numbers each.
    """
    return first_contact_of("edge-edge", start, end)


def first_contact_of(
    kind: Kind, start: Sequence[Sequence[Rational]], end: Sequence[Sequence[Rational]]
) -> SpaceContact | None:
    """Return the first contact of a query of either kind; see `vertex_face` and `edge_edge`."""
    first, last = read_points(start, "start"), read_points(end, "end")
    count = 1 if kind == "vertex-face" else 2
    if _are_boxes_apart((*first[:count], *last[:count]), (*first[count:], *last[count:])):
        return None
    return _Pair(kind == "vertex-face", _tracks(first, last)).first_contact()


def contact_of(query: SpaceQuery) -> SpaceContact | None:
    """Return the exact first contact of a query; None if there is none."""
    return first_contact_of(query.kind, query.start, query.end)


def _are_boxes_apart(one: Sequence[Sequence[QQ]], other: Sequence[Sequence[QQ]]) -> bool:
    """Return True if the bounding boxes of two sets of points are disjoint."""
    for k in range(3):
        a, b = [p[k] for p in one], [p[k] for p in other]
        if max(a) < min(b) or max(b) < min(a):
            return True
    return False


def _tracks(start: Sequence[Sequence[QQ]], end: Sequence[Sequence[QQ]]) -> list[Vector]:
    """Return the paths of the vertices, all multiplied by one positive integer."""
    common = lcm(*(int(c.denominator) for point in (*start, *end) for c in point))
    first, last = ([[ZZ(c * common) for c in p] for p in points] for points in (start, end))
    return [
        (_linear(p[0], q[0]), _linear(p[1], q[1]), _linear(p[2], q[2]))
        for p, q in zip(first, last, strict=True)
    ]


@final
class _Pair:
    """The equations of a vertex and a face, or of two edges.

    Their coordinates (x, y) in a contact satisfy x e + y f = g for three vectors e, f, g, and are
    in a polygon: the triangle x, y >= 0, x + y <= 1 (a face), or the unit square (two edges).
    """

    __slots__ = ("_e", "_f", "_g", "_is_face", "_normal", "_segments")

    def __init__(self, is_face: bool, tracks: Sequence[Vector]) -> None:  # noqa: FBT001
        p, a, b, c = tracks
        self._is_face = is_face
        self._e = _minus(b, a) if is_face else _minus(a, p)
        self._f = _minus(c, a) if is_face else _minus(b, c)
        self._g = _minus(p, a) if is_face else _minus(b, p)
        self._normal = _cross(self._e, self._f)
        self._segments: Sequence[tuple[Vector, Vector]]
        if is_face:
            a, b, c = (_minus(q, p) for q in (a, b, c))
            self._segments = [(a, b), (b, c), (c, a)]
        else:
            ends = [(p, a, b), (p, a, c), (b, c, p), (b, c, a)]
            self._segments = [(_minus(q, o), _minus(r, o)) for q, r, o in ends]

    def first_contact(self) -> SpaceContact | None:
        """Return the first contact; None if there is none."""
        cubic = _dot(self._normal, self._g)
        if _has_no_root(cubic):
            return None
        candidates = [AlgebraicNumber(0)]
        if cubic and cubic[0]:
            candidates = []
        for t in (*candidates, *self._candidates(cubic)):
            found = self._coordinates_at(t)
            if found is not None:
                return SpaceContact(t, found)
        return None

    def _candidates(self, cubic: IntPoly) -> Iterator[AlgebraicNumber]:
        """Yield times in (0, 1] that include the first contact, unless there is one at 0."""
        if cubic:
            yield from _roots(cubic)
        else:
            yield from sorted(t for p, q in self._segments for t in _times_on_segment(p, q))

    def _coordinates_at(self, t: AlgebraicNumber) -> tuple[Quotient, Quotient] | None:
        """Return the coordinates of the contact at a root t of the cubic; None without one."""
        for k in range(3):
            if t.sign_of(self._normal[k]):
                # x e + y f = g: the cross products with f and with e leave one unknown each.
                d = self._normal[k]
                x = _cross_component(self._g, self._f, k), d
                y = _cross_component(self._e, self._g, k), d
                return (x, y) if self._contains(x, y, t) else None
        if any(_contains_origin(p, q, t) for p, q in self._segments):
            return self._least_on_line(t)
        return None

    def _least_on_line(self, t: AlgebraicNumber) -> tuple[Quotient, Quotient]:
        """Return the lexicographically least coordinates if e, f and g are parallel at t.

        One component of x e + y f = g is the equation of a line that implies the others. The
        least pair is an end of the intersection of this line and the polygon, so it is on an
        edge of the polygon. If e and f are zero, so is g, and the least pair is (0, 0).
        """
        for k in range(3):
            a, b, c = self._e[k], self._f[k], self._g[k]
            if t.sign_of(a) or t.sign_of(b):
                pairs = [
                    (x, y)
                    for x, y in self._ends(a, b, c)
                    if t.sign_of(x[1]) and t.sign_of(y[1]) and self._contains(x, y, t)
                ]
                best = pairs[0]
                for pair in pairs[1:]:
                    best = pair if _precedes(pair, best, t) else best
                return best
        return ZERO_QUOTIENT, ZERO_QUOTIENT

    def _ends(self, a: IntPoly, b: IntPoly, c: IntPoly) -> list[tuple[Quotient, Quotient]]:
        """Return the intersections of a x + b y = c with the lines of the polygon's edges."""
        one: Quotient = ((ZZ(1),), (ZZ(1),))
        ends = [(ZERO_QUOTIENT, (c, b)), ((c, a), ZERO_QUOTIENT)]
        if self._is_face:
            d = subtract(a, b)
            return [*ends, ((subtract(c, b), d), (subtract(a, c), d))]
        return [*ends, (one, (subtract(c, a), b)), ((subtract(c, b), a), one)]

    def _contains(self, x: Quotient, y: Quotient, t: AlgebraicNumber) -> bool:
        """Return True if (x, y) is in the polygon at t; the denominators do not vanish there."""
        (n, d), (m, e) = x, y
        s, r = t.sign_of(d), t.sign_of(e)
        if t.sign_of(n) * s < 0 or t.sign_of(m) * r < 0:
            return False
        if not self._is_face:
            return t.sign_of(subtract(d, n)) * s >= 0 and t.sign_of(subtract(e, m)) * r >= 0
        if d == e:
            return t.sign_of(subtract(d, add(n, m))) * s >= 0
        rest = subtract(multiply(d, e), add(multiply(n, e), multiply(m, d)))
        return t.sign_of(rest) * s * r >= 0


def _precedes(
    one: tuple[Quotient, Quotient], other: tuple[Quotient, Quotient], t: AlgebraicNumber
) -> bool:
    """Return True if one pair of numbers is lexicographically less than another at t."""
    for (n, d), (m, e) in zip(one, other, strict=True):
        difference = subtract(multiply(n, e), multiply(m, d))
        s = t.sign_of(difference) * t.sign_of(d) * t.sign_of(e)
        if s:
            return s < 0
    return False


def _contains_origin(p: Vector, q: Vector, t: AlgebraicNumber) -> bool:
    """Return True if the origin is on the segment pq at t."""
    return not any(map(t.sign_of, _cross(p, q))) and t.sign_of(_dot(p, q)) <= 0


def _times_on_segment(p: Vector, q: Vector) -> Iterator[AlgebraicNumber]:
    """Yield times in (0, 1] that include the first one at which the origin is on pq."""
    turn = next(filter(None, _cross(p, q)), None)
    if turn is not None:
        yield from _roots(turn)
        return
    for vector in (p, q):
        component = next(filter(None, vector), None)
        if component is not None:
            yield from _roots(component)


def _roots(f: IntPoly) -> Iterator[AlgebraicNumber]:
    """Yield the roots of f in (0, 1]; f is not zero."""
    return (root.time for root in roots_after(f, AlgebraicNumber(0), ONE))


def _has_no_root(f: IntPoly) -> bool:
    """Return True if the Bernstein coefficients of a cubic on [0, 1] have one strict sign."""
    if not f:
        return False
    a, b, c, d = (*f, *(ZZ(0),) * (4 - len(f)))
    row = (a, 3 * a + b, 3 * a + 2 * b + c, a + b + c + d)
    return min(row) > 0 or max(row) < 0


def _linear(a: ZZ, b: ZZ) -> IntPoly:
    """Return a (1 - t) + b t."""
    return trimmed((a, b - a))


def _minus(p: Vector, q: Vector) -> Vector:
    return subtract(p[0], q[0]), subtract(p[1], q[1]), subtract(p[2], q[2])


def _cross(p: Vector, q: Vector) -> Vector:
    return _cross_component(p, q, 0), _cross_component(p, q, 1), _cross_component(p, q, 2)


def _cross_component(p: Vector, q: Vector, k: int) -> IntPoly:
    i, j = (k + 1) % 3, (k + 2) % 3
    return subtract(multiply(p[i], q[j]), multiply(p[j], q[i]))


def _dot(p: Vector, q: Vector) -> IntPoly:
    return add(add(multiply(p[0], q[0]), multiply(p[1], q[1])), multiply(p[2], q[2]))
