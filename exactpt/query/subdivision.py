"""The planar subdivision at a rational time, by the edges of bodies and the diagonals.

Queries walk through it: a planar map on the vertices of the scene, without the infinitesimal
copies of vertices of degenerate bodies and without faces of area zero
(`exactpt.pseudotriangulation.snapshot`). Coordinates are exact. The faces are the tiles of the
free space, the interiors of the bodies, and the exterior of the convex hull.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import cmp_to_key
from itertools import pairwise
from typing import Final, final

from exactpt.geometry.polygon import signed_area2
from exactpt.geometry.predicates import Point
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.kernel.numbers import QQ, sign
from exactpt.planar.halfedge import PlanarMap, twin
from exactpt.pseudotriangulation.snapshot import Snapshot

__all__ = ["OUTSIDE", "Subdivision", "cross"]

OUTSIDE: Final = -1
"""The face outside the convex hull."""


def cross(u: Point, v: Point) -> QQ:
    """The cross product of two vectors: positive if v is to the left of u."""
    return u[0] * v[1] - u[1] * v[0]


@final
class Subdivision:
    """A planar map with coordinates.

    Args:
        snapshot: the tiling.
        hidden: edges of the tiling to leave out, those inside bodies: pairs of nodes (u, v)
            with u < v.

    Attributes:
        snapshot: the tiling.
        points: position of each node.
        map: half-edges between nodes; none if the scene is a single point.
        face: face to the left of each half-edge: index of a tile in the snapshot, `OUTSIDE`,
            or ``-2 - i`` for the interior of body i.
        boundary: for each edge (half-edge // 2), whether it belongs to a body.
        out: for each node, one outgoing half-edge, or -1.
        edge_of: for each face, one half-edge with the face on its left.
        names: names of the bodies, in the order of the scene.
        first: first node of each body; the last entry is the number of nodes.
        body: index of the body of each node.
    """

    def __init__(self, snapshot: Snapshot, hidden: Collection[tuple[int, int]] = ()) -> None:
        self.snapshot = snapshot
        self.points: list[Point] = [(node._x, node._y) for node in snapshot.nodes]
        self.names: list[str] = []
        self.first: list[int] = []
        self.body: list[int] = []
        for i, node in enumerate(snapshot.nodes):
            if node.vertex == 0:
                self.names.append(node.body)
                self.first.append(i)
            self.body.append(len(self.names) - 1)
        self.first.append(len(self.points))
        self.map = PlanarMap()
        self.boundary: list[bool] = []
        self.out: list[HalfEdge] = [NO_HALF_EDGE] * len(self.points)
        self._link(hidden)
        self.face: list[int] = [OUTSIDE] * len(self.map.origin)
        self.edge_of: dict[int, HalfEdge] = {}
        self._name_faces()

    def direction(self, h: HalfEdge) -> Point:
        """The vector from the origin of a half-edge to its target."""
        (a, b), (c, d) = self.points[self.map.origin[h]], self.points[self.map.origin[h ^ 1]]
        return c - a, d - b

    def edge_number(self, h: HalfEdge) -> int:
        """The number of the edge of a body that a half-edge belongs to."""
        u, v = sorted((self.map.origin[h], self.map.origin[h ^ 1]))
        return (u if v == u + 1 else v) - self.first[self.body[u]]

    def node_name(self, node: int) -> tuple[str, int]:
        """The name of the body and the number of the vertex of a node."""
        body = self.body[node]
        return self.names[body], node - self.first[body]

    def _link(self, hidden: Collection[tuple[int, int]]) -> None:
        around: list[list[HalfEdge]] = [[] for _ in self.points]
        for edge in self.snapshot.edges:
            if edge.kind == "boundary" or (edge.u, edge.v) not in hidden:
                h = self.map.add_edge(VertexId(edge.u), VertexId(edge.v))
                self.boundary.append(edge.kind == "boundary")
                around[edge.u].append(h)
                around[edge.v].append(twin(h))
        for node, edges in enumerate(around):
            if edges:
                self.out[node] = edges[0]
                star = self._sorted(edges)
                for h, following in pairwise([*star, star[0]]):
                    # Coming in along the twin of the later half-edge, the face continues
                    # along the earlier one.
                    self.map.link(twin(following), h)

    def _sorted(self, edges: list[HalfEdge]) -> list[HalfEdge]:
        """Half-edges out of a node, sorted counter-clockwise from the direction (1, 0)."""
        direction = {h: self.direction(h) for h in edges}
        lower = {h: y < 0 or (y == 0 and x < 0) for h, (x, y) in direction.items()}

        def order(g: HalfEdge, h: HalfEdge) -> int:
            if lower[g] != lower[h]:
                return 1 if lower[g] else -1
            return -sign(cross(direction[g], direction[h]))

        return sorted(edges, key=cmp_to_key(order))

    def _name_faces(self) -> None:
        names: dict[tuple[int, int], int] = {}
        for i in range(len(self.names)):
            names.update(dict.fromkeys(self._inner_edges(i), -2 - i))
        for i, tile in enumerate(self.snapshot.faces):
            names.update(dict.fromkeys(pairwise([*tile.nodes, tile.nodes[0]]), i))
        origin = self.map.origin
        for h in map(HalfEdge, range(len(origin))):
            face = names.get((origin[h], origin[h ^ 1]))
            if face is not None:
                self.face[h] = face
                self.edge_of[face] = h
            else:
                self.edge_of[OUTSIDE] = h

    def _inner_edges(self, body: int) -> Sequence[tuple[int, int]]:
        """The edges of a closed body, directed so that its interior is on their left."""
        nodes = list(range(self.first[body], self.first[body + 1]))
        last = nodes[0], nodes[-1]
        if len(nodes) < 3 or not self._has_edge(*last):
            return []
        if signed_area2([self.points[v] for v in nodes]) < 0:
            nodes.reverse()
        return list(pairwise([*nodes, nodes[0]]))

    def _has_edge(self, u: int, v: int) -> bool:
        """Whether two nodes are joined by an edge of a body."""
        m = self.map
        return any(self.boundary[h >> 1] and m.target(h) == v for h in m.star(self.out[u]))
