"""Shortest paths along polygons: sleeves of triangles, pulled tight by the funnel algorithm.

The geodesic from vertex a to vertex b of a polygon is the shortest path in the free space
that is homotopic to the boundary between them. The polygon is on its left. Moved slightly off
the boundary, this chain runs through the triangles around the vertices in between. Steps back
are removed from this sequence of triangles, and the funnel algorithm finds the shortest path
in the resulting sleeve. A vertex on the convex hull of all bodies is on every geodesic around
it, so the sleeves end there. The chain may be any path homotopic to the boundary with the
polygon on its left.

Source: D. T. Lee, F. P. Preparata, *Euclidean shortest paths in the presence of
rectilinear barriers*, Networks 14 (1984); J. Hershberger, J. Snoeyink, *Computing minimum
length paths of a given homotopy class*, CGTA 4 (1994).
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Sequence, Set
from itertools import pairwise
from typing import Final, NamedTuple, final

from exactpt.certificates.predicates import Predicates
from exactpt.indices import NO_VERTEX, Ends, HalfEdge, VertexId
from exactpt.planar.halfedge import found, twin, without_steps_back
from exactpt.pseudotriangulation.mesh import Mesh

LEFT: Final = 1
RIGHT: Final = -1


class Part(NamedTuple):
    """A part of a geodesic, between two vertices of its chain that it must pass.

    Attributes:
        path: the vertices along it.
        end: the position in the chain of the half-edge that starts at the end of the part.
    """

    path: list[VertexId]
    end: int


@final
class Geodesics:
    """Geodesics in a triangulated part of the free space.

    Args:
        predicates: the predicates of the time.
        mesh: the triangulation.
        triangles: the half-edges of its triangles; the caller may add more.
    """

    def __init__(self, predicates: Predicates, mesh: Mesh, triangles: Set[HalfEdge]) -> None:
        self._predicates = predicates
        self._mesh = mesh
        self._triangles = triangles

    def path(self, chain: Sequence[HalfEdge]) -> list[VertexId]:
        """Return the geodesic homotopic to a chain, as vertices.

        Args:
            chain: half-edges, each of which starts where the one before ends. If the chain is
                closed, the geodesic is a loop pinned at its first vertex.
        """
        return joined(self.parts(chain))

    def without_loops(self, chain: Sequence[HalfEdge]) -> Sequence[HalfEdge]:
        """Return a chain without contractible loops at vertices that it passes several times."""
        m = self._mesh.map
        kept = without_steps_back(chain)
        before = -1
        while len(kept) != before:
            before = len(kept)
            count = Counter([*(m.origin[h] for h in kept), m.target(kept[-1])])
            for v in [v for v, times in count.items() if times > 1]:
                kept = self._without_loops_at(v, kept)
        return kept

    def _without_loops_at(self, v: VertexId, chain: list[HalfEdge]) -> list[HalfEdge]:
        """Return a chain without contractible loops at one vertex."""
        kept: list[HalfEdge] = []
        start = 0
        for part in self.parts(chain, v):
            if len(part.path) > 1:
                kept += chain[start : part.end]
            start = part.end
        return kept

    def parts(self, chain: Sequence[HalfEdge], pin: VertexId = NO_VERTEX) -> list[Part]:
        """Return the geodesic in parts, cut at pins and beside faces that are not triangles."""
        m = self._mesh.map
        parts = []
        start = m.origin[chain[0]]
        sleeve: list[HalfEdge] = []
        for i in range(1, len(chain)):
            triangles = self._triangles_at(chain[i - 1], chain[i])
            if triangles is None or m.origin[chain[i]] == pin:
                parts.append(Part(self._funnel(start, m.origin[chain[i]], sleeve), i))
                start = m.origin[chain[i]]
                sleeve = []
            else:
                _extend(sleeve, triangles)
        parts.append(Part(self._funnel(start, m.target(chain[-1]), sleeve), len(chain)))
        return parts

    def from_leftmost(self, cycle: Sequence[HalfEdge]) -> list[HalfEdge]:
        """Return the half-edges of a cycle around a body, from its leftmost vertex on.

        The cycle is the ring of the body, or consists of geodesics along it. Its leftmost vertex
        is on the convex hull of the body, and so on the unpinned geodesic cycle, which lies
        between the two.
        """
        origin, first = self._mesh.map.origin, 0
        for i in range(1, len(cycle)):
            if self._predicates.left_of(origin[cycle[i]], origin[cycle[first]]):
                first = i
        return [*cycle[first:], *cycle[:first]]

    def around_contents(self, ring: Sequence[HalfEdge]) -> list[HalfEdge]:
        """Return a chain around the contents of a hole from their leftmost vertex p, or none.

        The chain leads from p to the ring of the hole, around it, and back. The unpinned geodesic
        cycle is convex only at vertices of the contents, so p is its leftmost vertex too. The part
        left of p in the hole is empty, and no part of the cycle: where the chain touches the ring
        there does not matter. A triangle at p that reaches to the left has a vertex there.
        """
        m, origins = self._mesh.map, {self._mesh.map.origin[h]: i for i, h in enumerate(ring)}
        p = NO_VERTEX
        for h in self._component(twin(ring[0])):
            v = m.origin[h]
            if v not in origins and (p == NO_VERTEX or self._predicates.left_of(v, p)):
                p = v
        if p == NO_VERTEX:
            return []
        leftwards = (
            h
            for h in m.star(self._mesh.ring_edge[p])
            if m.target(h) in origins and self._predicates.left_of(m.target(h), p)
        )
        bridge = found(leftwards, "bridge to the left")
        first = origins[m.target(bridge)]
        return [bridge, *ring[first:], *ring[:first], twin(bridge)]

    def _component(self, first: HalfEdge) -> set[HalfEdge]:
        """Return the half-edges of all triangles that are connected to one."""
        m = self._mesh.map
        seen: set[HalfEdge] = set()
        todo = [first]
        while todo:
            h = todo.pop()
            if h not in seen and h in self._triangles:
                face = m.face(h)
                seen.update(face)
                todo += [twin(g) for g in face]
        return seen

    def _triangles_at(self, before: HalfEdge, after: HalfEdge) -> list[HalfEdge] | None:
        """Return the triangles right of a chain at a vertex; None if a face is not one.

        A triangle is represented by its least half-edge.
        """
        m = self._mesh.map
        h = twin(before)
        triangles = []
        while h != after:
            if h not in self._triangles:
                return None
            triangles.append(min(h, m.following[h], m.previous[h]))
            h = twin(m.previous[h])
        return triangles

    def _funnel(
        self, start: VertexId, goal: VertexId, sleeve: Sequence[HalfEdge]
    ) -> list[VertexId]:
        """Return the shortest path from start to goal through a sleeve of triangles."""
        if len(sleeve) < 2:
            return [start] if start == goal else [start, goal]
        funnel = _Funnel(start, self._turn)
        for l, r in self._portals(sleeve):
            funnel.extend(r, RIGHT)
            funnel.extend(l, LEFT)
        funnel.extend(goal, LEFT)
        path = [*funnel.path, *funnel.chain[LEFT]]
        return path if path[-1] == goal else [*path, goal]

    def _turn(self, apex: VertexId, p: VertexId, side_p: int, q: VertexId, side_q: int) -> int:
        """Return the orientation of apex, p, q, for obstacles p and q on given sides of the path.

        Of three vertices collinear for all times the middle one sticks out, away from its body: an
        obstacle on the left of the path (side 1) sticks out to the right, and vice versa.
        """
        if p == q:
            return 0
        s = self._predicates.orientation(apex, p, q)
        if s == 0:
            s = side_p if self._predicates.nearer(apex, p, q) else -side_q
        return s

    def _portals(self, sleeve: Sequence[HalfEdge]) -> list[Ends]:
        """Return the ends, left and right, of the edges between triangles of a sleeve."""
        m = self._mesh.map
        portals = []
        for t, u in pairwise(sleeve):
            around = m.face(u)
            shared = (h for h in m.face(t) if h ^ 1 in around)
            h = found(shared, "edge between two triangles of a sleeve")
            portals.append((m.target(h), m.origin[h]))
        return portals


def joined(parts: Sequence[Part]) -> list[VertexId]:
    """Return the vertices along a geodesic."""
    return [*parts[0].path[:1], *(v for part in parts for v in part.path[1:])]


def _extend(sleeve: list[HalfEdge], triangles: Sequence[HalfEdge]) -> None:
    """Extend a sleeve by adjacent triangles, with steps forth and back removed."""
    for t in triangles:
        if sleeve and sleeve[-1] == t:
            continue
        if len(sleeve) > 1 and sleeve[-2] == t:
            sleeve.pop()
        else:
            sleeve.append(t)


@final
class _Funnel:
    """The shortest paths from a start to both ends of the last portal.

    They share a path up to the apex, and from there on are a chain that turns left and one
    that turns right, the sides of the funnel. A new end of a portal shortens its own side from
    the far end or, when nothing of it is left, moves the apex along the other side.

    Attributes:
        path: from the start to the apex.
        chain: for each side, the vertices after the apex.
    """

    def __init__(
        self, start: VertexId, turn: Callable[[VertexId, VertexId, int, VertexId, int], int]
    ) -> None:
        self.path = [start]
        self.chain: dict[int, deque[VertexId]] = {LEFT: deque(), RIGHT: deque()}
        self._turn = turn

    def extend(self, v: VertexId, side: int) -> None:
        """Move the end of one side to v."""
        own, other = self.chain[side], self.chain[-side]
        if v == (own[-1] if own else self.path[-1]):
            return
        while own:
            before = own[-2] if len(own) > 1 else self.path[-1]
            if self._turn(before, own[-1], side, v, side) * side > 0:
                own.append(v)
                return
            own.pop()
        while other and self._turn(self.path[-1], other[0], -side, v, side) * side <= 0:
            self.path.append(other.popleft())
        if v != self.path[-1]:
            own.append(v)
