"""Shortest paths along polygons: sleeves of triangles, pulled tight by the funnel algorithm.

The geodesic from vertex a to vertex b of a polygon is the shortest path in the free space
that can be shrunk to the boundary between them. The polygon is on its left. Pushed a
little off the boundary, the path runs through the triangles around the vertices in
between; turning back is cut out of that sequence, and the funnel algorithm shortens the
path in what is left. A vertex on the convex hull of everything is on every geodesic around
it, so the sleeves end there.

Source: D. T. Lee, F. P. Preparata, *Euclidean shortest paths in the presence of
rectilinear barriers*, Networks 14 (1984); J. Hershberger, J. Snoeyink, *Computing minimum
length paths of a given homotopy class*, CGTA 4 (1994).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Final, final

from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import OUTER, Mesh

__all__ = ["Geodesics"]

LEFT: Final = 1
RIGHT: Final = -1


@final
class Geodesics:
    """Geodesics in a triangulated free space.

    Args:
        instant: the predicates.
        triangulation: a mesh whose free tiles are triangles.
    """

    def __init__(self, instant: Instant, triangulation: Mesh) -> None:
        self._instant = instant
        self._mesh = triangulation

    def path(self, chain: Sequence[int]) -> list[int]:
        """The geodesic along a chain of consecutive vertices of a ring, as vertices.

        Of a chain that ends where it began, the loop pinned there.
        """
        path = [chain[0]]
        sleeve: list[int] = []
        for i in range(1, len(chain) - 1):
            fan = self._fan(chain[i - 1], chain[i])
            if fan is None:  # on the convex hull
                path += self._funnel(path[-1], chain[i], sleeve)[1:]
                sleeve = []
            else:
                _extend(sleeve, fan)
        path += self._funnel(path[-1], chain[-1], sleeve)[1:]
        return path

    def _fan(self, before: int, v: int) -> list[int] | None:
        """The triangles around v from one neighbour to the next; None if the outside is one.

        A triangle is named by its least half-edge.
        """
        mesh, m = self._mesh, self._mesh.map
        h = mesh.ring_edge[before] ^ 1  # from v to the vertex before, free space on its left
        last = mesh.ring_edge[v]
        fan = []
        while h != last:
            if mesh.region[h] == OUTER:
                return None
            fan.append(min(h, m.following[h], m.previous[h]))
            h = m.previous[h] ^ 1
        return fan

    def _funnel(self, start: int, goal: int, sleeve: Sequence[int]) -> list[int]:
        """The shortest path from start to goal through a sleeve of triangles."""
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
        s = self._instant.sign(apex, p, q)
        if s == 0:
            s = side_p if self._instant.nearer(apex, p, q) else -side_q
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
