"""Whether bodies contain points, and each other."""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import Point
from exactpt.motion.body import Body

__all__ = ["covers", "one_is_inside"]


def covers(body: Body, points: Sequence[Point], p: Point) -> bool:
    """Whether the polygon that is a body, with its vertices at given points, contains p."""
    return body.has_interior and contains(points, p, body.edges if body.has_rings else None)


def one_is_inside(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point]) -> bool:
    """Whether a point of one body is in the other, if their boundaries are disjoint.

    Let a point be in both. On a path from it within its part of a, or within that of b, the
    boundary of one of them comes first; this point of it is in the other body, and so is the
    whole ring. So one vertex of each ring tells.
    """
    return any(covers(a, p, q[ring.start]) for ring in b.rings) or any(
        covers(b, q, p[ring.start]) for ring in a.rings
    )
