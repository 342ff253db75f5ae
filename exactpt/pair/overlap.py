"""Contacts and overlaps (more than a touch of boundaries) of two bodies at a rational time."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise, product
from typing import NamedTuple, TypeAlias, final

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import (
    Point,
    between,
    crossing_of_lines,
    is_left_of_path,
    orientation,
)
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.rings import ring_edges
from exactpt.pair.distance import compare_distance
from exactpt.pair.pieces_of_two import segments_of

Segment: TypeAlias = "tuple[Point, Point]"


@final
class _Placed(NamedTuple):
    """A body at one time.

    Attributes:
        body: the body.
        points: its vertices.
        edges: its edges; of a point, one without length.
        pinches: points among which are those in which its rings touch; none if none do.
    """

    body: Body
    points: Sequence[Point]
    edges: Sequence[Segment]
    pinches: Collection[Point]

    def is_entered_at(self, point: Point) -> bool:
        """Return True if an edge that crosses an edge of the body in a point goes into it there."""
        return self.body.has_interior and point not in self.pinches


def _placed(body: Body, t: QQ) -> _Placed:
    points = body.exact_at(t)
    edges = [(points[i], points[j]) for i, j in segments_of(body)]
    return _Placed(body, points, edges, set(points) if body.exact_ring_touches else ())


def bodies_meet(a: Body, b: Body, t: QQ) -> bool:
    """Return True if two bodies, rounded or not, have a point in common."""
    reach = a.exact_radius + b.exact_radius
    return compare_distance(a, b, t, reach * reach) <= 0


def overlap(a: Body, b: Body, t: QQ) -> bool:
    """Return True if a point of one body is in the interior of the other, or thin bodies cross.

    Thin bodies, those without interior, cross if they have a connected piece C in common such
    that one of them divides each small neighbourhood of C, and the other has points in two of
    its parts. Rounded bodies overlap if their cores are nearer than the sum of the radii.

    Edges cross if each has its ends strictly on both sides of the other. Then each goes into the
    interior of the other's polygon, unless another ring of that polygon touches the edge there: a
    thin body may lead through such a point into a hole. The point is a vertex of the polygon then.
    Let edges cross in such points only, and cut each edge of one body at the vertices of the other.
    Then each part of an edge is inside of another polygon, outside, or on its boundary, as its
    midpoint is. If none is inside, the interior of each part of a polygon is inside or outside of
    the other as a whole, and one interior point of each decides. What chains have in common are
    vertices and whole parts of edges: a piece C is a path in both. If an end of a chain is in C,
    the chain does not divide its neighbourhood, and leaves C at one end at most. Else C divides
    both, and they cross if one leaves C to different sides of the other.
    """
    reach = a.exact_radius + b.exact_radius
    if reach:
        return compare_distance(a, b, t, reach * reach) < 0
    first, second = _placed(a, t), _placed(b, t)
    if _cross_inside(first, second):
        return True
    if not (a.has_interior or b.has_interior):
        return _chains_cross(_cut(first.edges, second.edges), _cut(second.edges, first.edges))
    return (a.has_interior and _enters(second, first.edges)) or (
        b.has_interior and _enters(first, second.edges)
    )


def _cross_inside(first: _Placed, second: _Placed) -> bool:
    """Return True if edges of two bodies cross, and so the bodies overlap there."""
    are_thin = not (first.body.has_interior or second.body.has_interior)
    never_touch = not (first.pinches or second.pinches)
    for e, f in product(first.edges, second.edges):
        if not _cross(e, f):
            continue
        if are_thin or never_touch:
            return True
        point = crossing_of_lines(*e, *f)
        if first.is_entered_at(point) or second.is_entered_at(point):
            return True
    return False


def _cut(edges: Sequence[Segment], at: Sequence[Segment]) -> list[Point]:
    """Return the vertices of a chain that is cut at the vertices of another chain, in order."""
    vertices = [edges[0][0]]
    for u, v in edges:
        cuts = _cuts((u, v), at)
        vertices += cuts[1:] if u < v else cuts[-2::-1]
    return vertices


def _chains_cross(p: Sequence[Point], q: Sequence[Point]) -> bool:
    """Return True if chains cross; they are cut at each other's vertices, and no edges cross."""
    places: dict[Point, list[int]] = {}
    for k, v in enumerate(q):
        places.setdefault(v, []).append(k)
    common = {(i, k) for i, u in enumerate(p) for k in places.get(u, ())}
    for i, k in common:
        for step in (1, -1):
            j, l = i, k
            while (j + 1, l + step) in common:
                j, l = j + 1, l + step
            if (i - 1, k - step) in common:
                continue  # a part of a longer path
            if i == j and not common.isdisjoint([(i - 1, k + step), (i + 1, k - step)]):
                continue  # an end of a path in the other direction
            if min(i, k, l) == 0 or j == len(p) - 1 or max(k, l) == len(q) - 1:
                continue
            left = is_left_of_path(p[i - 1], p[i], p[i + 1], q[k - step])
            if left != is_left_of_path(p[j - 1], p[j], p[j + 1], q[l + step]):
                return True
    return False


def _enters(placed: _Placed, polygon: Sequence[Segment]) -> bool:
    """Return True if a part of a body is inside of a polygon, of which it crosses no edges inside.

    Args:
        placed: the body.
        polygon: the edges of the polygon.
    """
    middles = (middle for edge in placed.edges for middle in _middles(edge, polygon))
    if any(_is_inside(middle, polygon) for middle in middles):
        return True
    return placed.body.has_interior and any(
        _is_inside(inner, polygon) for inner in _inner_points(placed.body, placed.points)
    )


def _cross(e: Segment, f: Segment) -> bool:
    return (
        orientation(*e, f[0]) * orientation(*e, f[1]) < 0
        and orientation(*f, e[0]) * orientation(*f, e[1]) < 0
    )


def _is_inside(point: Point, polygon: Sequence[Segment]) -> bool:
    """Return True if a point is in the interior of a polygon, by its edges."""
    corners = [end for edge in polygon for end in edge]
    pairs = [(i, i + 1) for i in range(0, len(corners), 2)]
    return contains(corners, point, pairs) and not any(
        orientation(u, v, point) == 0 and between(u, v, point) for u, v in polygon
    )


def _middles(edge: Segment, polygon: Sequence[Segment]) -> Iterator[Point]:
    """Yield the midpoints of the parts into which the vertices of a polygon cut an edge."""
    cuts = _cuts(edge, polygon)
    if len(cuts) == 1:
        yield cuts[0]
    for p, q in pairwise(cuts):
        yield (p[0] + q[0]) / 2, (p[1] + q[1]) / 2


def _cuts(edge: Segment, at: Sequence[Segment]) -> list[Point]:
    """Return the ends of an edge and the ends of other edges on it, sorted, each once."""
    u, v = edge
    ends = {p for other in at for p in other}
    return sorted({u, v, *(p for p in ends if orientation(u, v, p) == 0 and between(u, v, p))})


def _inner_points(body: Body, points: Sequence[Point]) -> Iterator[Point]:
    """Yield a point in the interior of each part, on a horizontal line through no vertex.

    A body that deforms may have a part that is flat at this time: of one that is level there is
    none, and of another one it is a point of its edges.
    """
    for rings in body.parts:
        part = [(points[i], points[j]) for i, j in ring_edges((rings,))]
        heights = sorted({y for (_, y), _ in part})
        if len(heights) == 1:
            continue
        y = (heights[0] + heights[1]) / 2
        crossings = sorted(
            u[0] + (v[0] - u[0]) * (y - u[1]) / (v[1] - u[1])
            for u, v in part
            if (u[1] < y) != (v[1] < y)
        )
        yield (crossings[0] + crossings[1]) / 2, y
