"""Whether two bodies meet, or overlap, at a rational time: more than a touch of boundaries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TypeAlias

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import Point, between, side
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.proximity.distance import squared_distance
from exactpt.proximity.stretches import meet, segments_of

__all__ = ["bodies_meet", "overlap"]

Segment: TypeAlias = "tuple[Point, Point]"


def bodies_meet(a: Body, b: Body, t: QQ) -> bool:
    """Whether two bodies, rounded or not, have a point in common."""
    reach = a._radius + b._radius
    return squared_distance(a, b, t) <= reach * reach if reach else meet(a, b, t)


def overlap(a: Body, b: Body, t: QQ) -> bool:
    """Whether a point of one body is in the interior of the other, or edges cross each other.

    Rounded bodies overlap if their cores are nearer than the sum of the radii.

    Edges cross if each has its ends strictly on both sides of the other. Let no edges cross, and
    cut each edge of one polygon at the vertices of the other; then each part is inside of the
    other, outside, or on its boundary, as its midpoint is. If none is inside, the interior of
    each polygon is inside or outside of the other as a whole, and one interior point of each
    tells.
    """
    reach = a._radius + b._radius
    if reach:
        return squared_distance(a, b, t) < reach * reach
    p, q = a._at(t), b._at(t)
    p_edges = [(p[i], p[j]) for i, j in segments_of(a)]
    q_edges = [(q[i], q[j]) for i, j in segments_of(b)]
    if any(_cross(e, f) for e in p_edges for f in q_edges):
        return True
    return (a.has_interior and _enters(b, q, q_edges, p)) or (
        b.has_interior and _enters(a, p, p_edges, q)
    )


def _enters(
    body: Body, points: Sequence[Point], edges: Sequence[Segment], ring: Sequence[Point]
) -> bool:
    """Whether a point of a body, whose edges cross none of the ring, is inside of a polygon."""
    if any(_is_inside(middle, ring) for edge in edges for middle in _middles(edge, ring)):
        return True
    return body.has_interior and _is_inside(_inner_point(points), ring)


def _cross(e: Segment, f: Segment) -> bool:
    return side(*e, f[0]) * side(*e, f[1]) < 0 and side(*f, e[0]) * side(*f, e[1]) < 0


def _is_inside(point: Point, ring: Sequence[Point]) -> bool:
    """Whether a point is in the interior of a polygon."""
    return contains(ring, point) and not any(
        side(u, v, point) == 0 and between(u, v, point)
        for u, v in zip(ring, [*ring[1:], ring[0]], strict=True)
    )


def _middles(edge: Segment, ring: Sequence[Point]) -> Iterator[Point]:
    """The midpoints of the parts into which the vertices of a polygon cut an edge."""
    u, v = edge
    cuts = sorted({u, v, *(p for p in ring if side(u, v, p) == 0 and between(u, v, p))})
    if len(cuts) == 1:
        yield u
    for p, q in pairwise(cuts):
        yield (p[0] + q[0]) / 2, (p[1] + q[1]) / 2


def _inner_point(ring: Sequence[Point]) -> Point:
    """A point in the interior of a simple polygon, on a horizontal line through no vertex."""
    low, above = sorted({y for _, y in ring})[:2]
    y = (low + above) / 2
    crossings = sorted(
        u[0] + (v[0] - u[0]) * (y - u[1]) / (v[1] - u[1])
        for u, v in zip(ring, [*ring[1:], ring[0]], strict=True)
        if (u[1] < y) != (v[1] < y)
    )
    return (crossings[0] + crossings[1]) / 2, y
