"""The planar subdivision at a rational time, by the edges of bodies and the diagonals.

Queries walk through it: a planar map on the vertices of the scene, without the infinitesimal
copies of vertices of degenerate bodies and without faces of area zero
(`exactpt.pseudotriangulation.snapshot`). Coordinates are exact. The faces are the tiles of the
free space, the interiors of the bodies, and the exterior of the convex hull.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Iterator, Sequence
from enum import Enum
from typing import Final, NamedTuple, TypeAlias, final

from mypy_extensions import i64

from exactpt.cached_property import cached_property
from exactpt.geometry.polygon import signed_area2
from exactpt.geometry.predicates import Point
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.planar.halfedge import PlanarMap, twin
from exactpt.pseudotriangulation.snapshot import Snapshot
from exactpt.query.hull import Hull
from exactpt.query.nodes import Given, Nodes

OUTSIDE: Final = -1
"""The face outside the convex hull."""

_MAX_CORNERS: Final = 32
"""Of larger faces no corners are kept for each half-edge: memory would grow with the square."""

Corner: TypeAlias = tuple[float, float, HalfEdge]
"""A node on the boundary of a face, in doubles (`Nodes`), and the half-edge that ends at it."""


class On(Enum):
    """The type of cell that contains a point."""

    FACE = "face"
    EDGE = "edge"
    NODE = "node"


class Spot(NamedTuple):
    """The cell of the subdivision that contains a point.

    Attributes:
        on: the interior of a face, the interior of an edge, or a node.
        handle: the face; a half-edge of the edge; or the node.
    """

    on: On
    handle: i64


BEYOND: Final = Spot(On.FACE, OUTSIDE)
"""The cell of the points outside the convex hull."""


def cross(u: Point, v: Point) -> QQ:
    """Return the cross product of two vectors: positive if v is to the left of u."""
    return u[0] * v[1] - u[1] * v[0]


@final
class Subdivision:
    """A planar map with coordinates.

    Args:
        snapshot: the tiling.
        bodies: the bodies, in the order of the scene.

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
        ahead: for each half-edge, see `look_ahead`; None before its first call.
        starts: where walks to the points of a cell of the nodes' grid begin, if some did.
    """

    def __init__(self, snapshot: Snapshot, bodies: Sequence[Body]) -> None:
        self.snapshot = snapshot
        self.points: list[Point] = [(node.exact_x, node.exact_y) for node in snapshot.nodes]
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
        self.boundary = [edge.kind == "boundary" for edge in snapshot.edges]
        self.cycles: dict[int, list[HalfEdge]] = {}
        self._link(bodies)
        self.starts: dict[tuple[int, int], tuple[Given, Spot]] = {}
        self._outlines: dict[int, list[list[Corner]]] = {}
        self.ahead: list[tuple[list[Corner], HalfEdge] | None] = [None] * len(self.face)

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

    def look_ahead(self, h: HalfEdge) -> tuple[list[Corner], HalfEdge]:
        """Return the face of a half-edge as seen from it; after the first call also in `ahead`.

        Returns:
            The corners after the half-edge up to its origin, which is left out, each with the twin
            of the half-edge that ends at it; the twin of the last one. Of the face outside, of a
            face with several cycles, and of one of many corners, no corners and -1.
        """
        face = self.face[h]
        cycle = self.map.face(h)[1:]
        corners, last = list[Corner](), NO_HALF_EDGE
        if face != OUTSIDE and len(self.cycles[face]) == 1 and len(cycle) < _MAX_CORNERS:
            corners = [(*self.place(twin(g)), twin(g)) for g in cycle]
            last = corners.pop()[2]
        self.ahead[h] = corners, last
        return corners, last

    @cached_property
    def hull(self) -> Hull | None:
        """The hull of the nodes; None without any edges."""
        return Hull(self.outline(OUTSIDE)[0]) if OUTSIDE in self.cycles else None

    def node_name(self, node: i64) -> tuple[str, int]:
        """Return the name of the body and the number of the vertex of a node."""
        body = self.body[node]
        return self.names[body], node - self.first[body]

    def _link(self, bodies: Sequence[Body]) -> None:
        """Link the half-edges around each face; those of no tile or body are around the outside."""
        ends = [
            pair for edge in self.snapshot.edges for pair in ((edge.u, edge.v), (edge.v, edge.u))
        ]
        half = {pair: HalfEdge(h) for h, pair in enumerate(ends)}
        following, previous = [NO_HALF_EDGE] * len(ends), [NO_HALF_EDGE] * len(ends)
        self.face: list[int] = [OUTSIDE] * len(ends)
        for number, nodes in self._rings(bodies):
            cycle = [half[pair] for pair in zip(nodes, (*nodes[1:], nodes[0]), strict=True)]
            insort(self.cycles.setdefault(number, []), min(cycle))
            for h, g in zip(cycle, (*cycle[1:], cycle[0]), strict=True):
                following[h], previous[g], self.face[h] = g, h, number
        outer: dict[i64, list[HalfEdge]] = {}
        for h in half.values():
            if following[h] == NO_HALF_EDGE:
                outer.setdefault(ends[h][0], []).append(h)
        for h in (h for edges in outer.values() for h in edges):
            # A hull without area has two at a node: back along the edge only at its ends.
            after = outer[ends[h][1]]
            g = after[0] if after[0] != twin(h) else after[-1]
            following[h], previous[g] = g, h
        if outer:
            self.cycles[OUTSIDE] = [min(h for edges in outer.values() for h in edges)]
        self.out = [NO_HALF_EDGE] * len(self.points)
        for (u, _), h in reversed(half.items()):
            self.out[u] = h
        self.map = PlanarMap.of((VertexId(u) for u, _ in ends), following, previous, [])

    def _rings(self, bodies: Sequence[Body]) -> Iterator[tuple[int, Sequence[i64]]]:
        """Yield the cycles around tiles and in bodies: the face, and its nodes."""
        yield from ((i, tile.nodes) for i, tile in enumerate(self.snapshot.faces))
        for i, body in enumerate(bodies):
            for rings in body.parts if body.has_interior else ():
                for k, ring in enumerate(rings):
                    nodes = [self.first[i] + vertex for vertex in ring]
                    turns_left = signed_area2([self.points[v] for v in nodes]) > 0
                    yield -2 - i, nodes if turns_left == (k == 0) else nodes[::-1]
