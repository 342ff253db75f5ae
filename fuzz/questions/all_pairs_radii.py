"""Rounded bodies from the definition: the part of the reference search that is about radii.

Two bodies touch where the distance of their cores is at most the sum R of their radii. Cores that
are farther apart come to distance R first at a pair of vertices, or at a vertex and the interior
of an edge, at the foot of the perpendicular. All of these pairs are tested, in exact arithmetic.
Nothing but the kernel and the trajectories is shared with the search that users call.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import TypeAlias

from exactpt import AlgebraicNumber, Body
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.track import Incidence, Track

Point: TypeAlias = "tuple[QQ, QQ]"
Segment: TypeAlias = "tuple[Point, Point]"
Ratio: TypeAlias = "tuple[IntPoly, IntPoly]"
"""A quotient of polynomials; the second one is positive."""
Vector: TypeAlias = "tuple[IntPoly, IntPoly, IntPoly]"
"""(x, y, w), for the vector (x / w, y / w)."""


def core_distance(a: Body, b: Body, t: QQ) -> QQ:
    """Return the squared distance of the cores of two bodies at a rational time."""
    p, q = a.exact_at(t), b.exact_at(t)
    if _is_in(b, q, a, p) or _is_in(a, p, b, q):
        return QQ(0)
    return min(
        _of_segments((p[i], p[j]), (q[k], q[l]))
        for (i, j), (k, l) in product(a.edges or [(0, 0)], b.edges or [(0, 0)])
    )


def _is_in(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point]) -> bool:
    """Return True if a ring of a body is inside of another body, if no edges cross."""
    edges = [(q[i], q[j]) for i, j in b.edges]
    return b.has_interior and any(_is_inside(p[ring.start], edges) for ring in a.rings)


def _is_inside(v: Point, edges: Sequence[Segment]) -> bool:
    """By the crossings of the ray to the right; on the boundary it does not matter."""
    odd = False
    for (ax, ay), (bx, by) in edges:
        if (ay > v[1]) != (by > v[1]) and v[0] < ax + (v[1] - ay) * (bx - ax) / (by - ay):
            odd = not odd
    return odd


def _of_segments(e: Segment, f: Segment) -> QQ:
    if _turn(*e, f[0]) * _turn(*e, f[1]) < 0 and _turn(*f, e[0]) * _turn(*f, e[1]) < 0:
        return QQ(0)
    return min(*(_of_point(v, f) for v in e), *(_of_point(v, e) for v in f))


def _turn(a: Point, b: Point, c: Point) -> QQ:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _of_point(v: Point, segment: Segment) -> QQ:
    (ax, ay), (bx, by) = segment
    ex, ey, fx, fy = bx - ax, by - ay, v[0] - ax, v[1] - ay
    length = ex * ex + ey * ey
    share = min(max((ex * fx + ey * fy) / length, QQ(0)), QQ(1)) if length else QQ(0)
    return (fx - share * ex) ** 2 + (fy - share * ey) ** 2


def first_at_distance(
    a: Body, b: Body, p: Sequence[Track], q: Sequence[Track], span: tuple[QQ, QQ]
) -> AlgebraicNumber | None:
    """Return the first time in (start, end] at which features of the cores are at distance R.

    Args:
        a: a body.
        b: another body; the cores are farther apart than R at the start.
        p: the trajectories of the vertices of the first.
        q: those of the second.
        span: the start and the end.
    """
    squared = (a.exact_radius + b.exact_radius) ** 2
    begin, end = AlgebraicNumber(span[0]), span[1]
    found: list[AlgebraicNumber] = []
    for u, v in product(p, q):
        f = _excess(_squared(_from(u, v)), squared)
        found += [root.time for root in roots_after(f, begin, end)][:1] if f else []
    for v, c, d in _vertices_and_edges(a, b, p, q):
        f = _excess(_squared_from_line(v, c, d), squared)
        times = [root.time for root in roots_after(f, begin, end)] if f else []
        found += [t for t in times if min(_sides_of_foot(v, c, d, t)) > 0][:1]
    return min(found, default=None)


def touches_at_distance(
    bodies: Sequence[Body], tracks: Sequence[Sequence[Track]], ij: tuple[int, int],
    time: AlgebraicNumber,
) -> Iterator[Incidence]:  # fmt: skip
    """Yield the pairs of features of bodies i < j that are at distance R at a time."""
    i, j = ij
    squared = (bodies[i].exact_radius + bodies[j].exact_radius) ** 2
    p, q = tracks[i], tracks[j]
    for (k, u), (l, v) in product(enumerate(p), enumerate(q)):
        if time.sign_of(_excess(_squared(_from(u, v)), squared)) == 0:
            yield Incidence(i, k, j, -1, l)
    for (n, m), (one, other) in (((i, j), (p, q)), ((j, i), (q, p))):
        for (k, v), (e, (c, d)) in product(enumerate(one), enumerate(bodies[m].edges)):
            f = _excess(_squared_from_line(v, other[c], other[d]), squared)
            if time.sign_of(f) == 0 and min(_sides_of_foot(v, other[c], other[d], time)) > 0:
                yield Incidence(n, k, m, e, -1)


def _vertices_and_edges(
    a: Body, b: Body, p: Sequence[Track], q: Sequence[Track]
) -> Iterator[tuple[Track, Track, Track]]:
    yield from ((v, p[k], p[l]) for v, (k, l) in product(q, a.edges))
    yield from ((v, q[k], q[l]) for v, (k, l) in product(p, b.edges))


def _from(u: Track, v: Track) -> Vector:
    """v - u."""
    return (
        subtract(multiply(v.x, u.w), multiply(u.x, v.w)),
        subtract(multiply(v.y, u.w), multiply(u.y, v.w)),
        multiply(u.w, v.w),
    )


def _dot(e: Vector, f: Vector) -> Ratio:
    return add(multiply(e[0], f[0]), multiply(e[1], f[1])), multiply(e[2], f[2])


def _squared(e: Vector) -> Ratio:
    return _dot(e, e)


def _squared_from_line(v: Track, a: Track, b: Track) -> Ratio:
    """Return the squared distance (e x f)^2 / e^2 of v from ab, e = b - a, f = v - a."""
    e, f = _from(a, b), _from(a, v)
    cross, w = subtract(multiply(e[0], f[1]), multiply(e[1], f[0])), multiply(e[2], f[2])
    n, d = _squared(e)
    return multiply(multiply(cross, cross), d), multiply(multiply(w, w), n)


def _excess(ratio: Ratio, least: QQ) -> IntPoly:
    """Positive where the quotient is larger than a number, 0 where it is equal."""
    n, d = ratio
    return subtract(scale(n, ZZ(least.denominator)), scale(d, ZZ(least.numerator)))


def _sides_of_foot(v: Track, a: Track, b: Track, t: AlgebraicNumber) -> tuple[int, int]:
    """Return the signs of e . f and e . (e - f); the foot is inside the edge if both are 1."""
    e, f, g = _from(a, b), _from(a, v), _from(v, b)
    return t.sign_of(_dot(e, f)[0]), t.sign_of(_dot(e, g)[0])
