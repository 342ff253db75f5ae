"""The outer triangulation: tiles outside the convex hull, for paths that leave it.

The region between the convex hull and a large rectangle is triangulated. A shortest path
between points inside the rectangle never bends at its corners. The rectangle may however
influence which homotopy class crosses the fewest diagonals; so it is the smallest of a fixed
series that contains the points of the query, and no result depends on earlier queries.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.pseudotriangulation.snapshot import Edge, Face, Node, Snapshot
from exactpt.query.sleeve import triangulated


class OuterRectangle(NamedTuple):
    """A series of rectangles around the bodies: their bounding box, with a margin that doubles."""

    left: QQ
    right: QQ
    low: QQ
    high: QQ

    @classmethod
    def of(cls, snapshot: Snapshot) -> OuterRectangle:
        """Return the series for a tiling of at least one body."""
        xs, ys = (
            [node.exact_x for node in snapshot.nodes],
            [node.exact_y for node in snapshot.nodes],
        )
        return cls(min(xs), max(xs), min(ys), max(ys))

    def corners(self, count: int) -> list[Point]:
        """Return the corners after ``count`` doublings, counter-clockwise from the lower left."""
        left, right, low, high = self
        margin = (right - left + high - low + 1) * power_of_two(count)
        left, right, low, high = left - margin, right + margin, low - margin, high + margin
        return [(left, low), (right, low), (right, high), (left, high)]

    def doublings(self, points: Sequence[Point]) -> int:
        """Return the number of doublings after which all points are strictly inside."""
        count = 0
        while True:
            (left, low), _, (right, high), _ = self.corners(count)
            if all(left < x < right and low < y < high for x, y in points):
                return count
            count += 1


def with_outer_triangulation(
    snapshot: Snapshot, hull: Sequence[int], corners: Sequence[Point]
) -> Snapshot:
    """Return the tiling with the region between its convex hull and a rectangle triangulated.

    Args:
        snapshot: a tiling of at least one body.
        hull: the nodes on its convex hull, counter-clockwise.
        corners: the corners of the rectangle, see `OuterRectangle.corners`.
    """
    places = [(node.exact_x, node.exact_y) for node in snapshot.nodes]
    first = len(places)
    nodes = [Node("", 0, x, y) for x, y in corners]
    # One polygon: the corners, a bridge to the hull, clockwise around it, and back. The bridge
    # ends at the leftmost node: all other nodes are to the right of it.
    least = min(range(len(hull)), key=lambda i: places[hull[i]])
    around = (
        [hull[(least - i) % len(hull)] for i in range(len(hull) + 1)] if len(hull) > 1 else hull
    )
    ring = [first, first + 1, first + 2, first + 3, first, *around]
    triangles = triangulated(ring, [*places, *corners])
    known = {(edge.u, edge.v) for edge in snapshot.edges}
    new = {
        (min(u, v), max(u, v)) for a, b, c in triangles for u, v in pairwise((a, b, c, a))
    } - known
    return replace(
        snapshot,
        nodes=(*snapshot.nodes, *nodes),
        edges=(*snapshot.edges, *(Edge(u, v, "diagonal", hull=False) for u, v in sorted(new))),
        faces=(*snapshot.faces, *(Face(t, t) for t in triangles)),
    )
