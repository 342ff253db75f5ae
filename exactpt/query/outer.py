"""Tiles outside the convex hull as well, for paths that leave it.

Four corners of a large rectangle are added, and the ring between them and the convex hull
is cut into triangles. A shortest path between points in the rectangle never bends at its
corners. But of two ways, it may depend on the rectangle which one crosses fewer diagonals:
so it is the least of a series that has the points of a question inside, and an answer does
not depend on what has been asked before.
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

__all__ = ["OuterRectangle", "with_outer_triangulation"]


class OuterRectangle(NamedTuple):
    """Rectangles around the bodies: a box, and a margin that is doubled again and again."""

    left: QQ
    right: QQ
    low: QQ
    high: QQ

    @classmethod
    def of(cls, snapshot: Snapshot) -> OuterRectangle:
        """The box of a tiling of at least one body."""
        xs, ys = [node._x for node in snapshot.nodes], [node._y for node in snapshot.nodes]
        return cls(min(xs), max(xs), min(ys), max(ys))

    def corners(self, count: int) -> list[Point]:
        """The corners after so many doublings, counter-clockwise from the lower left."""
        left, right, low, high = self
        margin = (right - left + high - low + 1) * power_of_two(count)
        left, right, low, high = left - margin, right + margin, low - margin, high + margin
        return [(left, low), (right, low), (right, high), (left, high)]

    def doublings(self, points: Sequence[Point]) -> int:
        """How often the margin is doubled until points are inside."""
        count = 0
        while True:
            (left, low), _, (right, high), _ = self.corners(count)
            if all(left < x < right and low < y < high for x, y in points):
                return count
            count += 1


def with_outer_triangulation(
    snapshot: Snapshot, hull: Sequence[int], corners: Sequence[Point]
) -> Snapshot:
    """The tiling with tiles around it, in a rectangle.

    Args:
        snapshot: a tiling of at least one body.
        hull: the nodes on its convex hull, counter-clockwise.
        corners: of the rectangle, see `OuterRectangle`.
    """
    places = [(node._x, node._y) for node in snapshot.nodes]
    first = len(places)
    nodes = [Node("", 0, x, y) for x, y in corners]
    # One polygon: around the corners, over to the hull, clockwise around it, and back.
    # The way over is to the leftmost node: everything else is on the right of it.
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
