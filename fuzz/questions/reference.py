"""When bodies meet, and how near they are, from the definition.

It shares nothing with `exactpt.pairs` but the kernel, the trajectories and orientations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cmp_to_key
from itertools import combinations, pairwise, product
from typing import Protocol, TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.track import Track, difference, orientation_polynomial

__all__ = [
    "contact_intervals", "critical_times", "edges_of", "first_within", "intervals_within",
    "is_within", "meet_at", "moments", "pieces", "tracks",
]  # fmt: skip


class Instant(Protocol):
    """A time at which signs of polynomials are known."""

    def sign_of(self, f: IntPoly, /) -> int:
        """-1, 0 or 1."""


Tracks: TypeAlias = tuple[Track, ...]
Vector: TypeAlias = tuple[IntPoly, IntPoly]
Point: TypeAlias = tuple[QQ, QQ]
Place: TypeAlias = tuple[str, int]
Interval: TypeAlias = tuple[AlgebraicNumber, AlgebraicNumber]


def pieces(a: Body, b: Body, start: QQ, end: QQ) -> Iterator[tuple[QQ, QQ, Tracks, Tracks]]:
    """The time span from one change of a motion to the next, with the trajectories."""
    cuts = {t for body in (a, b) for t in body.exact_breakpoints if start < t < end}
    times = [start, *sorted(cuts), end]
    for begin, until in pairwise(times):
        yield begin, until, a.exact_piece_after(begin).tracks, b.exact_piece_after(begin).tracks


def critical_times(polynomials: Iterable[IntPoly], begin: QQ, until: QQ) -> list[AlgebraicNumber]:
    """The distinct roots in (begin, until] of any of the polynomials, and the end."""
    found = [AlgebraicNumber(until)]
    for f in polynomials:
        if f:
            found += [r.time for r in roots_after(f, AlgebraicNumber(begin), until)]
    found.sort(key=cmp_to_key(AlgebraicNumber.compare))
    return [t for k, t in enumerate(found) if not k or found[k - 1].compare(t) < 0]


def edges_of(body: Body) -> list[tuple[int, int]]:
    """The edges as pairs of vertices; a point is an edge from itself to itself."""
    return body.edges or [(0, 0)]


def within_box(t: Instant, a: Track, b: Track, v: Track) -> bool:
    """Return True if v, on the line ab, is between a and b."""
    for to, fro in zip(gap(v, a), gap(v, b), strict=True):
        to_a, to_b = t.sign_of(to), t.sign_of(fro)
        if to_a * to_b > 0:
            return False
    return True


def on_segment(t: Instant, a: Track, b: Track, v: Track) -> bool:
    """Return True if v is on the closed segment ab."""
    return t.sign_of(orientation_polynomial(a, b, v)) == 0 and within_box(t, a, b, v)


def segments_meet(t: Instant, a: Track, b: Track, c: Track, d: Track) -> bool:
    """Return True if the closed segments ab and cd share a point."""
    signs = [
        t.sign_of(orientation_polynomial(*o)) for o in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
    ]
    if signs[0] * signs[1] < 0 and signs[2] * signs[3] < 0:
        return True
    return (
        on_segment(t, a, b, c)
        or on_segment(t, a, b, d)
        or on_segment(t, c, d, a)
        or on_segment(t, c, d, b)
    )


def has_inside(t: Instant, body: Body, p: Tracks, other: Body, q: Tracks) -> bool:
    """Return True if a ring of another body is in a polygon whose edges it does not touch."""
    return body.has_interior and any(contains(t, body, p, q[ring.start]) for ring in other.rings)


def contains(t: Instant, body: Body, p: Tracks, v: Track) -> bool:
    """By the crossings of a ray to the right; v is on no edge."""
    inside = False
    for a, b in ((p[i], p[j]) for i, j in body.edges):
        above = [t.sign_of(difference(v.y, v.w, p.y, p.w)) > 0 for p in (a, b)]
        if above[0] != above[1]:
            left = t.sign_of(orientation_polynomial(a, b, v)) > 0
            inside ^= left == above[1]
    return inside


def meet_at(t: Instant, a: Body, b: Body, p: Tracks, q: Tracks) -> bool:
    """Return True if two bodies share a point."""
    return (
        any(
            segments_meet(t, p[i], p[j], q[k], q[l])
            for (i, j), (k, l) in product(edges_of(a), edges_of(b))
        )
        or has_inside(t, a, p, b, q)
        or has_inside(t, b, q, a, p)
    )


def moments(begin: QQ, until: QQ, p: Tracks, q: Tracks) -> list[AlgebraicNumber]:
    """All times in (begin, until] at which anything about two bodies may change, in order."""
    orientations = [orientation_polynomial(*triple) for triple in combinations([*p, *q], 3)]
    gaps = [f for u, v in product(p, q) for f in gap(u, v)]
    return critical_times(orientations + gaps, begin, until)


def contact_intervals(a: Body, b: Body, start: QQ, end: QQ) -> list[Interval]:
    """The maximal closed intervals in which two bodies meet, as pairs of algebraic numbers."""

    def meet(t: Instant, p: Tracks, q: Tracks) -> bool:
        return meet_at(t, a, b, p, q)

    return _intervals(a, b, start, end, meet, moments)


def intervals_within(a: Body, b: Body, start: QQ, end: QQ, s: QQ) -> list[Interval]:
    """The maximal closed intervals in which the squared distance is at most s."""

    def within(t: Instant, p: Tracks, q: Tracks) -> bool:
        return is_within(t, a, b, p, q, s)

    def critical(begin: QQ, until: QQ, p: Tracks, q: Tracks) -> list[AlgebraicNumber]:
        found = [orientation_polynomial(*three) for three in combinations([*p, *q], 3)]
        for v, c, d in _corners(a, b, p, q):
            found += dot(gap(c, d), gap(c, v)), dot(gap(d, c), gap(d, v))
        return critical_times([*found, *_excesses(a, b, p, q, s)], begin, until)

    return _intervals(a, b, start, end, within, critical)


def _intervals(
    a: Body, b: Body, start: QQ, end: QQ, holds: Callable[[Instant, Tracks, Tracks], bool],
    critical: Callable[[QQ, QQ, Tracks, Tracks], list[AlgebraicNumber]],
) -> list[Interval]:  # fmt: skip
    """The maximal closed intervals in which something holds, which changes at critical times."""
    last = AlgebraicNumber(start)
    states: list[tuple[AlgebraicNumber | None, bool]] = [(last, holds(last, *tracks(a, b, start)))]
    for begin, until, p, q in pieces(a, b, start, end):
        for time in critical(begin, until, p, q):
            between = AlgebraicNumber(rational_between(last, time))
            states += [(None, holds(between, p, q)), (time, holds(time, p, q))]
            last = time
    found: list[Interval] = []
    since: AlgebraicNumber | None = None
    for at, is_so in [*states, (None, False)]:
        if at is not None and is_so:
            since = since or at
            last = at
        elif at is None and not is_so and since is not None:
            found.append((since, last))
            since = None
    return found


def tracks(a: Body, b: Body, t: QQ) -> tuple[Tracks, Tracks]:
    """The trajectories just after a time."""
    return a.exact_piece_after(t).tracks, b.exact_piece_after(t).tracks


def gap(u: Track, v: Track) -> Vector:
    """(x, y) of v - u, times w_u w_v."""
    return difference(u.x, u.w, v.x, v.w), difference(u.y, u.w, v.y, v.w)


def dot(e: Vector, f: Vector) -> IntPoly:
    """The scalar product."""
    return add(multiply(e[0], f[0]), multiply(e[1], f[1]))


def cross(e: Vector, f: Vector) -> IntPoly:
    """The determinant."""
    return subtract(multiply(e[0], f[1]), multiply(e[1], f[0]))


def excess_of_vertices(u: Track, v: Track, s: QQ) -> IntPoly:
    """Positive where the squared distance of u and v is more than s."""
    w = multiply(u.w, v.w)
    return less(dot(gap(u, v), gap(u, v)), multiply(w, w), s)


def excess_of_line(v: Track, a: Track, b: Track, s: QQ) -> IntPoly:
    """Positive where the squared distance of v from the line ab is more than s."""
    e, f = gap(a, b), gap(a, v)
    w = multiply(a.w, v.w)
    return less(multiply(cross(e, f), cross(e, f)), multiply(multiply(w, w), dot(e, e)), s)


def less(n: IntPoly, d: IntPoly, s: QQ) -> IntPoly:
    """n - s d, times a positive number."""
    return subtract(scale(n, ZZ(s.denominator)), scale(d, ZZ(s.numerator)))


def _corners(a: Body, b: Body, p: Tracks, q: Tracks) -> list[tuple[Track, Track, Track]]:
    """The vertices of each body with the ends of the edges of the other one."""
    corners = [(v, p[k], p[l]) for v in q for k, l in a.edges]
    return corners + [(v, q[k], q[l]) for v in p for k, l in b.edges]


def _excesses(a: Body, b: Body, p: Tracks, q: Tracks, s: QQ) -> list[IntPoly]:
    """Positive where the squared distance of two features is more than s."""
    found = [excess_of_vertices(u, v, s) for u, v in product(p, q)]
    return found + [excess_of_line(v, c, d, s) for v, c, d in _corners(a, b, p, q)]


def is_within(t: Instant, a: Body, b: Body, p: Tracks, q: Tracks, s: QQ) -> bool:
    """Return True if the squared distance is at most s at an algebraic time."""
    if meet_at(t, a, b, p, q):
        return True
    if any(t.sign_of(excess_of_vertices(u, v, s)) <= 0 for u, v in product(p, q)):
        return True
    return any(
        t.sign_of(excess_of_line(v, c, d, s)) <= 0
        and t.sign_of(dot(gap(c, d), gap(c, v))) > 0
        and t.sign_of(dot(gap(d, c), gap(d, v))) > 0
        for v, c, d in _corners(a, b, p, q)
    )


def first_within(a: Body, b: Body, start: QQ, end: QQ, s: QQ) -> AlgebraicNumber | None:
    """The first time at which the squared distance is at most s."""
    now = AlgebraicNumber(start)
    if is_within(now, a, b, *tracks(a, b, start), s):
        return now
    for begin, until, p, q in pieces(a, b, start, end):
        for time in critical_times(_excesses(a, b, p, q, s), begin, until):
            if is_within(time, a, b, p, q, s):
                return time
    return None


def nearest(a: Body, b: Body, t: QQ) -> tuple[QQ, set[tuple[Place, Place]]]:
    """The squared distance at a rational time, and the pairs of features with it.

    A place is ("v", i), or ("e", i) for the interior of an edge.
    """
    p, q = a.exact_at(t), b.exact_at(t)
    found: list[tuple[QQ, tuple[Place, Place]]] = []
    for (i, u), (j, v) in product(enumerate(p), enumerate(q)):
        found.append(((u[0] - v[0]) ** 2 + (u[1] - v[1]) ** 2, (("v", i), ("v", j))))
        found += [
            (s, (("e", e), ("v", j)))
            for e, (k, l) in enumerate(a.edges)
            if i == 0 and (s := to_interior(v, p[k], p[l])) is not None
        ]
        found += [
            (s, (("v", i), ("e", e)))
            for e, (k, l) in enumerate(b.edges)
            if j == 0 and (s := to_interior(u, q[k], q[l])) is not None
        ]
    least = min(s for s, _ in found)
    if least and meet_at(AlgebraicNumber(t), a, b, *tracks(a, b, t)):
        return QQ(0), set()
    return least, {features for s, features in found if s == least}


def to_interior(v: Point, a: Point, b: Point) -> QQ | None:
    """The squared distance of v from its foot on ab; None if that is not between a and b."""
    (x, y), (ax, ay), (bx, by) = v, a, b
    length = (bx - ax) ** 2 + (by - ay) ** 2
    if length == 0:
        return None
    share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length
    if not 0 < share < 1:
        return None
    return (ax + share * (bx - ax) - x) ** 2 + (ay + share * (by - ay) - y) ** 2
