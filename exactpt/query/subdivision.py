"""The planar subdivision at a rational time, by the edges of bodies and the diagonals.

Queries walk through it: a planar map on the vertices of the scene, without the infinitesimal
copies of vertices of degenerate bodies and without faces of area zero
(`exactpt.pseudotriangulation.snapshot`). Coordinates are exact. The faces are the tiles of the
free space, the interiors of the bodies, and the exterior of the convex hull.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import cached_property, cmp_to_key
from itertools import pairwise
from typing import Final, TypeAlias, final

from mypy_extensions import i64

from exactpt.geometry.polygon import signed_area2
from exactpt.geometry.predicates import Point
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.kernel.numbers import QQ, sign
from exactpt.motion.body import Body
from exactpt.planar.halfedge import PlanarMap, twin
from exactpt.pseudotriangulation.snapshot import Snapshot
from exactpt.query.hull import Hull
from exactpt.query.nodes import Nodes

OUTSIDE: Final = -1
"""The face outside the convex hull."""

Corner: TypeAlias = tuple[float, float, HalfEdge]
"""A node on the boundary of a face, in doubles (`Nodes`), and the half-edge that ends at it."""


def cross(u: Point, v: Point) -> QQ:
    """Return the cross product of two vectors: positive if v is to the left of u."""
    return u[0] * v[1] - u[1] * v[0]


@final
class Subdivision:
    """A planar map with coordinates.

    Args:
        snapshot: the tiling.
        bodies: the bodies, in the order of the scene.
        hidden: edges of the tiling to leave out, those inside bodies: pairs of nodes (u, v)
            with u < v.

    Attributes:
        snapshot: the tiling.
        points: position of each node.
        nodes: the positions as doubles.
        map: half-edges between nodes; none if the scene is a single point.
        face: face to the left of each half-edge: index of a tile in the snapshot, `OUTSIDE`,
            or ``-2 - i`` for the interior of body i.
        boundary: for each edge (half-edge // 2), whether it belongs to a body.
        out: for each node, one outgoing half-edge, or -1.
        cycles: for each face, one half-edge of each cycle around it, with the face on its left.
            The interior of a body has one for each of its rings, any other face a single one.
        names: names of the bodies, in the order of the scene.
        first: first node of each body; the last entry is the number of nodes.
        body: index of the body of each node.
    """

    def __init__(
        self,
        snapshot: Snapshot,
        bodies: Sequence[Body],
        hidden: Collection[tuple[int, int]] = (),
    ) -> None:
        self.snapshot = snapshot
        self.points: list[Point] = [(node._x, node._y) for node in snapshot.nodes]
        self.nodes = Nodes(self.points)
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
        self.cycles: dict[int, list[HalfEdge]] = {}
        self._name_faces(bodies)
        self._outlines: dict[int, list[list[Corner]]] = {}

    def direction(self, h: HalfEdge) -> Point:
        """Return the vector from the origin of a half-edge to its target."""
        (a, b), (c, d) = self.points[self.map.origin[h]], self.points[self.map.origin[h ^ 1]]
        return c - a, d - b

    def place(self, h: HalfEdge) -> tuple[float, float]:
        """Return the origin of a half-edge in doubles (`Nodes`)."""
        node = self.map.origin[h]
        return self.nodes.xs[node], self.nodes.ys[node]

    def outline(self, face: int) -> list[list[Corner]]:
        """Return the corners of each cycle around a face, in order, the last one also first."""
        known = self._outlines.get(face)
        if known is None:
            cycles = [self.map.face(h) for h in self.cycles[face]]
            known = self._outlines[face] = [
                [(*self.place(twin(h)), h) for h in (cycle[-1], *cycle)] for cycle in cycles
            ]
        return known

    @cached_property
    def hull(self) -> Hull | None:
        """The hull of the nodes; None without any edges."""
        return Hull(self.outline(OUTSIDE)[0]) if OUTSIDE in self.cycles else None

    def edge_number(self, h: HalfEdge) -> int:
        """Return the number of the edge of a body that a half-edge belongs to."""
        u, v = sorted((self.map.origin[h], self.map.origin[h ^ 1]))
        return (u if v == u + 1 else v) - self.first[self.body[u]]

    def node_name(self, node: i64) -> tuple[str, int]:
        """Return the name of the body and the number of the vertex of a node."""
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

    def _name_faces(self, bodies: Sequence[Body]) -> None:
        names: dict[tuple[i64, i64], int] = {}
        for i, body in enumerate(bodies):
            if body.has_interior:
                names.update(dict.fromkeys(self._inner_edges(i, body), -2 - i))
        for i, tile in enumerate(self.snapshot.faces):
            names.update(dict.fromkeys(pairwise([*tile.nodes, tile.nodes[0]]), i))
        origin = self.map.origin
        seen: set[HalfEdge] = set()
        for h in map(HalfEdge, range(len(origin))):
            self.face[h] = face = names.get((origin[h], origin[h ^ 1]), OUTSIDE)
            if h not in seen:
                seen.update(self.map.face(h))
                self.cycles.setdefault(face, []).append(h)

    def _inner_edges(self, i: int, body: Body) -> Iterator[tuple[int, int]]:
        """Yield the edges of a closed body, directed so that its interior is on their left."""
        for rings in body.parts:
            for k, ring in enumerate(rings):
                nodes = [self.first[i] + vertex for vertex in ring]
                turns_left = signed_area2([self.points[v] for v in nodes]) > 0
                if turns_left != (k == 0):
                    nodes.reverse()
                yield from pairwise([*nodes, nodes[0]])
