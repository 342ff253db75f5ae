"""Whether bodies contain points, and each other."""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import Point
from exactpt.motion.body import Body


def covers(body: Body, points: Sequence[Point], p: Point) -> bool:
    """Return True if the polygon that is a body, with its vertices at given points, contains p."""
    return body.has_interior and contains(points, p, body.edges if body.has_rings else None)


def one_is_inside(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point]) -> bool:
    """Return True if a point of one body is in the other, if their boundaries are disjoint.

    Let a point be in both. On a path from it within its part of a, or within that of b, the
    boundary of one of them comes first; this point of it is in the other body, and so is the
    whole ring. So one vertex of each ring decides.
    """
    return _has_ring(a, p, b, q) or _has_ring(b, q, a, p)


def _has_ring(body: Body, points: Sequence[Point], other: Body, places: Sequence[Point]) -> bool:
    """Return True if a polygon contains the first vertex of a ring of another body."""
    if not body.has_interior:
        return False
    firsts = [places[ring.start] for ring in other.rings]
    if len(firsts) > 1:
        (left, right), (low, high) = ((min(c), max(c)) for c in zip(*points, strict=True))
        firsts = [(x, y) for x, y in firsts if left <= x <= right and low <= y <= high]
    return any(covers(body, points, first) for first in firsts)
