"""The first time within a distance in the maximum norm, or along an axis, from the definition.

In the maximum norm, two bodies are within d if they meet, or the square of half-side d around a
vertex of one meets an edge of the other. Along an axis they are, unless all vertices of one are
more than d beyond all of the other. All critical times are tried, in order.
"""

from __future__ import annotations

from itertools import pairwise, product
from typing import Literal

from exactpt import AlgebraicNumber, Body
from exactpt.kernel.integer_polynomial import IntPoly, add, scale
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.motion.track import Track, orientation_polynomial
from fuzz.questions.reference import (
    Tracks,
    critical_times,
    edges_of,
    gap,
    meet_at,
    pieces,
    segments_meet,
    tracks,
)

__all__ = ["first_within_norm"]

Norm = Literal["max", "x", "y"]


def first_within_norm(
    a: Body, b: Body, start: QQ, end: QQ, d: QQ, norm: Norm
) -> AlgebraicNumber | None:
    """The first time at which two bodies are within d."""
    now = AlgebraicNumber(start)
    if _is_within(now, a, b, *tracks(a, b, start), d, norm):
        return now
    for begin, until, p, q in pieces(a, b, start, end):
        for time in critical_times(_polynomials(a, b, p, q, d), begin, until):
            if _is_within(time, a, b, p, q, d, norm):
                return time
    return None


def _polynomials(a: Body, b: Body, p: Tracks, q: Tracks, d: QQ) -> list[IntPoly]:
    """They vanish where a corner of a square has the x or y of a vertex, or is on an edge."""
    found = [f for u, v in product(p, q) for w in _square(v, d) for f in gap(u, w)]
    for v, (i, j) in product(p, edges_of(b)):
        found += [orientation_polynomial(q[i], q[j], w) for w in _square(v, d)]
    for v, (i, j) in product(q, edges_of(a)):
        found += [orientation_polynomial(p[i], p[j], w) for w in _square(v, d)]
    return found


def _is_within(
    t: AlgebraicNumber, a: Body, b: Body, p: Tracks, q: Tracks, d: QQ, norm: Norm
) -> bool:
    if norm != "max":
        return not (_are_beyond(t, p, q, d, norm) or _are_beyond(t, q, p, d, norm))
    return (
        meet_at(t, a, b, p, q)
        or any(_is_near(t, v, q[i], q[j], d) for v in p for i, j in edges_of(b))
        or any(_is_near(t, v, p[i], p[j], d) for v in q for i, j in edges_of(a))
    )


def _are_beyond(t: AlgebraicNumber, p: Tracks, q: Tracks, d: QQ, axis: Norm) -> bool:
    """Return True if all of q are more than d beyond all of p."""
    k = 0 if axis == "x" else 1
    return all(t.sign_of(gap(_moved(u, d, d), v)[k]) > 0 for u, v in product(p, q))


def _is_near(t: AlgebraicNumber, v: Track, a: Track, b: Track, d: QQ) -> bool:
    """Return True if the segment ab intersects the square around v."""
    low, _, high, _ = corners = _square(v, d)
    if all(t.sign_of(f) >= 0 for f in (*gap(low, a), *gap(a, high))):
        return True
    sides = pairwise([*corners, low])
    return any(segments_meet(t, a, b, c, e) for c, e in sides)


def _square(v: Track, d: QQ) -> list[Track]:
    """The corners of the square around v, counter-clockwise from the lowest and leftmost."""
    return [_moved(v, x, y) for x, y in ((-d, -d), (d, -d), (d, d), (-d, d))]


def _moved(v: Track, x: QQ, y: QQ) -> Track:
    m = ZZ(x.denominator * y.denominator)
    moved_x = add(scale(v.x, m), scale(v.w, ZZ(x * m)))
    moved_y = add(scale(v.y, m), scale(v.w, ZZ(y * m)))
    return Track(moved_x, moved_y, scale(v.w, m), None)
