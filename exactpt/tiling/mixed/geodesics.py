"""Shortest paths along polygons: sleeves of triangles, pulled tight by the funnel algorithm.

The geodesic from vertex a to vertex b of a polygon is the shortest path in the free space
that can be shrunk to the boundary between them. The polygon is on its left. Pushed a
little off the boundary, the path runs through the triangles around the vertices in
between; turning back is cut out of that sequence, and the funnel algorithm shortens the
path in what is left. A vertex on the convex hull of everything is on every geodesic around
it, so the sleeves end there. Instead of the boundary the chain may be any path that can be
shrunk to it, with the polygon on its left.

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
from exactpt.planar.halfedge import without_steps_back
from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["Geodesics", "Part", "joined"]

LEFT: Final = 1
RIGHT: Final = -1


class Part(NamedTuple):
    """A part of a geodesic, from one vertex of its chain to another that it cannot leave.

    Attributes:
        path: the vertices along it.
        end: the position in the chain of the half-edge that starts where it ends.
    """

    path: list[int]
    end: int


@final
class Geodesics:
    """Geodesics in a triangulated part of the free space.

    Args:
        predicates: of the time.
        mesh: the triangulation.
        triangles: the half-edges of the triangles; the set may grow.
    """

    def __init__(self, predicates: Predicates, mesh: Mesh, triangles: Set[int]) -> None:
        self._predicates = predicates
        self._mesh = mesh
        self._triangles = triangles

    def path(self, chain: Sequence[int]) -> list[int]:
        """The geodesic along a chain, as vertices.

        Args:
            chain: half-edges, each of which starts where the one before ends. If it ends
                where it began, the geodesic is the loop pinned there.
        """
        return joined(self.parts(chain))

    def without_loops(self, chain: Sequence[int]) -> Sequence[int]:
        """A chain without what can be shrunk to a vertex that it passes several times."""
        m = self._mesh.map
        kept = without_steps_back(chain)
        before = -1
        while len(kept) != before:
            before = len(kept)
            count = Counter([*(m.origin[h] for h in kept), m.target(kept[-1])])
            for v in [v for v, times in count.items() if times > 1]:
                kept = self._without_loops_at(v, kept)
        return kept

    def _without_loops_at(self, v: int, chain: list[int]) -> list[int]:
        """A chain without what can be shrunk to one vertex."""
        kept: list[int] = []
        start = 0
        for part in self.parts(chain, v):
            if len(part.path) > 1:
                kept += chain[start : part.end]
            start = part.end
        return kept

    def parts(self, chain: Sequence[int], pin: int = -1) -> list[Part]:
        """The same in parts, which end at a pin and where not all on the right are triangles."""
        m = self._mesh.map
        parts = []
        start = m.origin[chain[0]]
        sleeve: list[int] = []
        for i in range(1, len(chain)):
            fan = self._fan(chain[i - 1], chain[i])
            if fan is None or m.origin[chain[i]] == pin:
                parts.append(Part(self._funnel(start, m.origin[chain[i]], sleeve), i))
                start = m.origin[chain[i]]
                sleeve = []
            else:
                _extend(sleeve, fan)
        parts.append(Part(self._funnel(start, m.target(chain[-1]), sleeve), len(chain)))
        return parts

    def from_leftmost(self, cycle: Sequence[int]) -> list[int]:
        """The half-edges of a cycle around a body from its leftmost vertex on.

        Of a body's ring, or geodesics along it, that vertex is on the convex hull of the
        body, and so on its unpinned cycle, which lies between the two.
        """
        origin, first = self._mesh.map.origin, 0
        for i in range(1, len(cycle)):
            if self._predicates.left_of(origin[cycle[i]], origin[cycle[first]]):
                first = i
        return [*cycle[first:], *cycle[:first]]

    def _fan(self, before: int, after: int) -> list[int] | None:
        """The triangles on the right of a chain at a vertex; None if not all are triangles.

        A triangle is named by its least half-edge.
        """
        m = self._mesh.map
        h = before ^ 1
        fan = []
        while h != after:
            if h not in self._triangles:
                return None
            fan.append(min(h, m.following[h], m.previous[h]))
            h = m.previous[h] ^ 1
        return fan

    def _funnel(self, start: int, goal: int, sleeve: Sequence[int]) -> list[int]:
        """The shortest path from start to goal through a sleeve of triangles."""
        if len(sleeve) < 2:
            return [start] if start == goal else [start, goal]
        funnel = _Funnel(start, self._turn)
        for l, r in self._portals(sleeve):
            funnel.extend(r, RIGHT)
            funnel.extend(l, LEFT)
        funnel.extend(goal, LEFT)
        path = [*funnel.path, *funnel.chain[LEFT]]
        return path if path[-1] == goal else [*path, goal]

    def _turn(self, apex: int, p: int, side_p: int, q: int, side_q: int) -> int:
        """The orientation of apex, p, q, for obstacles p and q on given sides of the path.

        Of three on one line for ever the middle one sticks out, away from its body: an
        obstacle on the left (side 1) to the right, and the other way.
        """
        if p == q:
            return 0
        s = self._predicates.sign(apex, p, q)
        if s == 0:
            s = side_p if self._predicates.nearer(apex, p, q) else -side_q
        return s

    def _portals(self, sleeve: Sequence[int]) -> list[tuple[int, int]]:
        """The left and the right end of the edge between each triangle and the next."""
        m = self._mesh.map
        portals = []
        for t, u in pairwise(sleeve):
            around = m.face(u)
            h = next(h for h in m.face(t) if h ^ 1 in around)
            portals.append((m.target(h), m.origin[h]))
        return portals


def joined(parts: Sequence[Part]) -> list[int]:
    """The vertices along a geodesic."""
    return [*parts[0].path[:1], *(v for part in parts for v in part.path[1:])]


def _extend(sleeve: list[int], fan: Sequence[int]) -> None:
    """Go on through a fan, cutting out steps forth and back."""
    for t in fan:
        if sleeve and sleeve[-1] == t:
            continue
        if len(sleeve) > 1 and sleeve[-2] == t:
            sleeve.pop()
        else:
            sleeve.append(t)


@final
class _Funnel:
    """The shortest paths from a start to both ends of the last portal.

    They share a path up to the apex and then part, into a chain that turns left and one
    that turns right: the sides of the funnel. A new end of a portal shortens its own side
    from behind, or, if that is used up, moves the apex along the other.

    Attributes:
        path: from the start to the apex.
        chain: of each side, the vertices after the apex.
    """

    def __init__(self, start: int, turn: Callable[[int, int, int, int, int], int]) -> None:
        self.path = [start]
        self.chain: dict[int, deque[int]] = {LEFT: deque(), RIGHT: deque()}
        self._turn = turn

    def extend(self, v: int, side: int) -> None:
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
