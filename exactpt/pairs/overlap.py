"""Whether two bodies meet, or overlap, at a rational time: more than a touch of boundaries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TypeAlias

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import Point, between, side
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.rings import ring_edges
from exactpt.pairs.distance import squared_distance
from exactpt.pairs.stretches import meet, segments_of

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
    each part of a polygon is inside or outside of the other as a whole, and one interior point
    of each tells.
    """
    reach = a._radius + b._radius
    if reach:
        return squared_distance(a, b, t) < reach * reach
    p, q = a._at(t), b._at(t)
    p_edges = [(p[i], p[j]) for i, j in segments_of(a)]
    q_edges = [(q[i], q[j]) for i, j in segments_of(b)]
    if any(_cross(e, f) for e in p_edges for f in q_edges):
        return True
    return (a.has_interior and _enters(b, q, q_edges, p_edges)) or (
        b.has_interior and _enters(a, p, p_edges, q_edges)
    )


def _enters(
    body: Body, points: Sequence[Point], edges: Sequence[Segment], polygon: Sequence[Segment]
) -> bool:
    """Whether a point of a body, whose edges cross none of a polygon's, is inside of that."""
    if any(_is_inside(middle, polygon) for edge in edges for middle in _middles(edge, polygon)):
        return True
    return body.has_interior and any(
        _is_inside(inner, polygon) for inner in _inner_points(body, points)
    )


def _cross(e: Segment, f: Segment) -> bool:
    return side(*e, f[0]) * side(*e, f[1]) < 0 and side(*f, e[0]) * side(*f, e[1]) < 0


def _is_inside(point: Point, polygon: Sequence[Segment]) -> bool:
    """Whether a point is in the interior of a polygon, by its edges."""
    corners = [end for edge in polygon for end in edge]
    pairs = [(i, i + 1) for i in range(0, len(corners), 2)]
    return contains(corners, point, pairs) and not any(
        side(u, v, point) == 0 and between(u, v, point) for u, v in polygon
    )


def _middles(edge: Segment, polygon: Sequence[Segment]) -> Iterator[Point]:
    """The midpoints of the parts into which the vertices of a polygon cut an edge."""
    u, v = edge
    cuts = sorted({u, v, *(p for p, _ in polygon if side(u, v, p) == 0 and between(u, v, p))})
    if len(cuts) == 1:
        yield u
    for p, q in pairwise(cuts):
        yield (p[0] + q[0]) / 2, (p[1] + q[1]) / 2


def _inner_points(body: Body, points: Sequence[Point]) -> Iterator[Point]:
    """A point in the interior of each part, on a horizontal line through no vertex."""
    for rings in body.parts:
        part = [(points[i], points[j]) for i, j in ring_edges((rings,))]
        low, above = sorted({y for (_, y), _ in part})[:2]
        y = (low + above) / 2
        crossings = sorted(
            u[0] + (v[0] - u[0]) * (y - u[1]) / (v[1] - u[1])
            for u, v in part
            if (u[1] < y) != (v[1] < y)
        )
        yield (crossings[0] + crossings[1]) / 2, y
