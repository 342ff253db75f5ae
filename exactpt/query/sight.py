"""Visibility from a vertex: the triangulated free space, and sight from triangle to triangle.

From a vertex, the open cone between the two other corners of a triangle is followed across the edge
between them; each triangle behind it splits the cone, or narrows it. A vertex within an open
cone is seen. One on the border of a cone is hidden by the vertex before it, and seen from that one.

A path may touch bodies, but not cross them: at a vertex of an open chain it stays on the side from
which it came. So a vertex may have several places: a `Corner` is a maximal part of the free space
around a vertex between two edges of bodies, the walls.

Source: F. Bungiu, M. Hemmer, J. Hershberger, K. Huang, A. Kröller, *Efficient computation of
visibility polygons* (2014), triangular expansion.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias, final

from exactpt.errors import AuditError
from exactpt.geometry.predicates import Point, between, in_triangle, orientation
from exactpt.indices import NO_VERTEX, Ends, HalfEdge, VertexId
from exactpt.query.sleeve import Sleeves, Triangle
from exactpt.query.subdivision import OUTSIDE, On, Spot, Subdivision

Corner: TypeAlias = Ends
"""A vertex, and the other end of the first wall of the corner: the free space is counter-clockwise
from it. Around a vertex without walls, the least of its neighbours."""


class Seen(NamedTuple):
    """A corner that is seen, and the number of diagonals of the tiling looked across."""

    corner: Corner
    crossed: int


@final
class FreeTriangles:
    """The triangulated tiles of a subdivision, into which points can be inserted.

    Args:
        plane: a subdivision; points outside its hull are not free.
        sleeves: its triangulated tiles.
    """

    def __init__(self, plane: Subdivision, sleeves: Sleeves) -> None:
        origin = plane.map.origin
        self._sleeves = sleeves
        self.points = list(plane.points)
        self._apex: dict[Ends, VertexId] = {}
        """For each directed edge the third vertex of the triangle on its left."""
        self._added: list[Triangle] = []
        self._walls: set[Ends] = set()
        self._diagonals: set[Ends] = set()
        for h in map(HalfEdge, range(len(origin))):
            is_wall = plane.boundary[h >> 1] or OUTSIDE in (plane.face[h], plane.face[h ^ 1])
            (self._walls if is_wall else self._diagonals).add((origin[h], origin[h ^ 1]))
        for tile in range(len(plane.snapshot.faces)):
            for triangle in sleeves.triangles(tile):
                self._add(*triangle)
        self._added.clear()

    def __copy__(self) -> FreeTriangles:
        """Return an independent copy, for insertions."""
        other = FreeTriangles.__new__(FreeTriangles)
        other.__dict__.update(self.__dict__)
        other.points, other._apex = self.points.copy(), self._apex.copy()  # noqa: SLF001
        other._added, other._walls = self._added.copy(), self._walls.copy()  # noqa: SLF001
        return other

    # Insertion

    def inserted(self, p: Point, spot: Spot, ends: Ends) -> VertexId:
        """Return the node of a point that no body has in its interior; a new one if need be.

        Args:
            p: the point.
            spot: where it is in the subdivision.
            ends: the ends of the edge, if it is on one.
        """
        if spot.on is On.NODE:
            return VertexId(spot.handle)
        if spot.on is On.EDGE:
            known = [(u, v, self._apex.get((u, v), NO_VERTEX)) for u, v in (ends, ends[::-1])]
        else:
            known = self._sleeves.triangles(int(spot.handle))
        a, b, c = self._holding([*known, *self._added], p)
        node = VertexId(len(self.points))
        self.points.append(p)
        edges = ((a, b), (b, c), (c, a))
        on = [(u, v) for u, v in edges if orientation(self.points[u], self.points[v], p) == 0]
        if on:
            self._split(*on[0], node)
        else:
            for u, v in edges:
                self._add(u, v, node)
        return node

    def _holding(self, triangles: Sequence[Triangle], p: Point) -> Triangle:
        """Return the triangle, of those that still exist, that contains a point."""
        for a, b, c in triangles:
            x, y, z = self.points[a], self.points[b], self.points[c]
            if self._apex.get((a, b)) == c and in_triangle(p, x, y, z):
                return a, b, c
        raise AuditError(f"no triangle has the point {p}")

    def _split(self, u: VertexId, v: VertexId, node: VertexId) -> None:
        """Split the edge uv at a node, and the triangles next to it."""
        for a, b in ((u, v), (v, u)):
            c = self._apex.pop((a, b), None)
            if c is not None:
                self._add(a, node, c)
                self._add(node, b, c)
            if (a, b) in self._walls:
                self._walls.remove((a, b))
                self._walls |= {(a, node), (node, b)}

    def _add(self, a: VertexId, b: VertexId, c: VertexId) -> None:
        self._apex[a, b], self._apex[b, c], self._apex[c, a] = c, a, b
        self._added.append((a, b, c))

    # Corners

    def corners_at(self, node: VertexId) -> list[Corner]:
        """Return all corners at a node."""
        return sorted({self._corner(u, v) for u, v in self._apex if u == node})

    def _corner(self, node: VertexId, a: VertexId) -> Corner:
        """Return the corner that has the triangle on the left of the edge from a node to a."""
        around = [a]
        while (node, a) not in self._walls:
            a = self._apex[a, node]  # clockwise
            if a == around[0]:
                return node, min(around)
            around.append(a)
        return node, a

    def _fan(self, corner: Corner) -> Iterator[Ends]:
        """Yield the edges opposite to a corner, in the triangles around it, counter-clockwise."""
        node, a = corner
        while True:
            b = self._apex[node, a]
            yield a, b
            if b == corner[1] or (node, b) in self._walls:
                return
            a = b

    def walls(self, corner: Corner) -> tuple[VertexId, ...]:
        """Return the other ends of the walls of a corner: none, or the first and the last."""
        if corner not in self._walls:
            return ()
        *_, (_, last) = self._fan(corner)
        return corner[1], last

    def may_pass(self, before: VertexId, corner: Corner) -> bool:
        """Return True if a shortest path from a node may go on beyond a corner.

        Not where the free space has an angle less than pi, and not where the walls are on both
        sides of the straight line: there it would be shortened, or cross a wall.
        """
        here, p = self.points[corner[0]], self.points[before]
        ends = [self.points[v] for v in self.walls(corner)]
        if not ends:
            return True
        return (
            orientation(here, *ends) <= 0
            and orientation(p, here, ends[0]) * orientation(p, here, ends[1]) >= 0
        )

    def is_taut(self, before: VertexId, corner: Corner, after: VertexId) -> bool:
        """Return True if a path is straight at a corner, or bends around its walls."""
        p, here, q = (self.points[v] for v in (before, corner[0], after))
        turn = orientation(p, here, q)
        if turn == 0:
            return between(p, q, here)
        walls = self.walls(corner)
        return bool(walls) and all(
            orientation(here, p, w) * turn <= 0 <= orientation(here, q, w) * turn
            for w in (self.points[v] for v in walls)
        )

    # Sight

    def seen(self, corner: Corner) -> Iterator[Seen]:
        """Yield the corners that are seen from a corner: on each ray the first vertex."""
        node, first = corner
        eye = self.points[node]
        yield Seen(self._corner(first, self._apex[node, first]), 0)
        for a, b in self._fan(corner):
            yield Seen(self._corner(b, node), 0)
            stack = [(a, b, a, b, 0)]
            while stack:
                u, v, right, left, crossed = stack.pop()
                if (v, u) in self._walls:
                    continue
                crossed += (u, v) in self._diagonals
                w = self._apex[v, u]
                p = self.points[w]
                after_right = orientation(eye, self.points[right], p) > 0
                before_left = orientation(eye, self.points[left], p) < 0
                if after_right and before_left:
                    yield Seen(self._corner(w, v), crossed)
                if after_right:
                    stack.append((u, w, right, w if before_left else left, crossed))
                if before_left:
                    stack.append((w, v, w if after_right else right, left, crossed))
