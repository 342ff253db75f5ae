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

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.query.sleeve import triangulated
from exactpt.tiling.snapshot import Edge, Face, Node, Snapshot

__all__ = ["doublings", "surrounded"]


def doublings(snapshot: Snapshot, points: Sequence[Point]) -> int:
    """How often the margin around the bodies is doubled until points are inside."""
    count = 0
    while True:
        (left, low), _, (right, high), _ = _corners(snapshot, count)
        if all(left < x < right and low < y < high for x, y in points):
            return count
        count += 1


def surrounded(snapshot: Snapshot, hull: Sequence[int], count: int) -> Snapshot:
    """The tiling with tiles around it, in a rectangle.

    Args:
        snapshot: a tiling of at least one body.
        hull: the nodes on its convex hull, counter-clockwise.
        count: which rectangle, see `doublings`.
    """
    places = [(node.x, node.y) for node in snapshot.nodes]
    corners = _corners(snapshot, count)
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


def _corners(snapshot: Snapshot, count: int) -> list[Point]:
    """The corners, counter-clockwise from the lower left, of a rectangle well around bodies."""
    xs, ys = [node.x for node in snapshot.nodes], [node.y for node in snapshot.nodes]
    left, right, low, high = min(xs), max(xs), min(ys), max(ys)
    margin = (right - left + high - low + 1) * QQ(1 << count)
    left, right, low, high = left - margin, right + margin, low - margin, high + margin
    return [(left, low), (right, low), (right, high), (left, high)]
