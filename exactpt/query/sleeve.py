"""The shortest path of a homotopy class: a sleeve of triangulated tiles and the funnel algorithm.

A path through free space is determined, up to homotopy, by the sequence of diagonals that it
crosses, after crossings back and forth are cancelled. The tiles along it are triangulated; the
triangles between the start and the goal form the sleeve; the funnel algorithm finds the
shortest path in it. The sleeve may overlap itself: the algorithm needs no more than a surface
glued from triangles along their edges.

Source: D. T. Lee, F. P. Preparata, *Euclidean shortest paths in the presence of
rectilinear barriers*, Networks 14 (1984); J. Hershberger, J. Snoeyink, *Computing minimum
length paths of a given homotopy class*, CGTA 4 (1994).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Final, TypeAlias, final

from exactpt.errors import AuditError
from exactpt.geometry.predicates import Point, between, in_triangle, orientation
from exactpt.indices import NO_HALF_EDGE, NO_VERTEX, Ends, HalfEdge, Index, Triple, VertexId
from exactpt.query.subdivision import Subdivision

Triangle: TypeAlias = Triple
Portal: TypeAlias = Ends
"""The left and the right end, as nodes, of an edge that a path crosses."""

NOWHERE: Final = (NO_VERTEX, NO_VERTEX)


@final
class Sleeves:
    """The triangulated tiles of a subdivision; a tile is triangulated on first use."""

    def __init__(self, plane: Subdivision) -> None:
        self._plane = plane
        self._tiles: dict[int, list[Triangle]] = {}

    def dual_path(self, start: int, goal: int) -> list[HalfEdge] | None:
        """Return a shortest path in the dual graph: the fewest diagonals between two tiles.

        Returns:
            The half-edges of the diagonals in order, each on the side of the tile that is left;
            None if the tiles are in different components of the free space.
        """
        plane, m = self._plane, self._plane.map
        came: dict[int, HalfEdge] = {start: NO_HALF_EDGE}
        queue = deque([start])
        while queue and goal not in came:
            tile = queue.popleft()
            for h in m.face(plane.cycles[tile][0]):
                there = plane.face[h ^ 1]
                if there >= 0 and not plane.boundary[h >> 1] and there not in came:
                    came[there] = h
                    queue.append(there)
        if goal not in came:
            return None
        crossed = []
        tile = goal
        while came[tile] >= 0:
            crossed.append(came[tile])
            tile = plane.face[came[tile]]
        return crossed[::-1]

    def portals(
        self, start: Point, tile: int, crossed: Sequence[HalfEdge], goal: Point
    ) -> list[Portal]:
        """Return the portals from ``start`` in ``tile`` across ``crossed`` to ``goal``."""
        plane, origin = self._plane, self._plane.map.origin
        portals: list[Portal] = []
        here = self._triangle_of(tile, start)
        for h in crossed:
            u, v = origin[h], origin[h ^ 1]
            portals += self._between(tile, here, self._triangle_at(tile, u, v))
            portals.append((v, u))
            tile = plane.face[h ^ 1]
            here = self._triangle_at(tile, v, u)
        return portals + self._between(tile, here, self._triangle_of(tile, goal))

    def triangles(self, tile: int) -> list[Triangle]:
        """Return the triangles of a tile, counter-clockwise."""
        known = self._tiles.get(tile)
        if known is None:
            m = self._plane.map
            cycle = [m.origin[h] for h in m.face(self._plane.cycles[tile][0])]
            known = self._tiles[tile] = triangulated(cycle, self._plane.points)
        return known

    def _triangle_of(self, tile: int, p: Point) -> int:
        points = self._plane.points
        for i, (a, b, c) in enumerate(self.triangles(tile)):
            if in_triangle(p, points[a], points[b], points[c]):
                return i
        raise AuditError(f"no triangle of tile {tile} has the point {p}")

    def _triangle_at(self, tile: int, u: VertexId, v: VertexId) -> int:
        for i, (a, b, c) in enumerate(self.triangles(tile)):
            if (u, v) in ((a, b), (b, c), (c, a)):
                return i
        raise AuditError(f"no triangle of tile {tile} has the edge from {u} to {v}")

    def _between(self, tile: int, start: int, goal: int) -> list[Portal]:
        """Return the portals between two triangles of a tile."""
        triangles = self.triangles(tile)
        owner = {
            edge: i for i, (a, b, c) in enumerate(triangles) for edge in ((a, b), (b, c), (c, a))
        }
        came: dict[int, tuple[int, Portal]] = {start: (-1, NOWHERE)}
        queue = [start]
        while goal not in came:
            i = queue.pop()
            a, b, c = triangles[i]
            for u, v in ((a, b), (b, c), (c, a)):
                j = owner.get((v, u))
                if j is not None and j not in came:
                    came[j] = (i, (v, u))
                    queue.append(j)
        portals = []
        while goal != start:
            goal, portal = came[goal]
            portals.append(portal)
        return portals[::-1]


def triangulated(cycle: Sequence[Index], points: list[Point]) -> list[tuple[Index, Index, Index]]:
    """Return a triangulation of a simple polygon, given counter-clockwise, by ear clipping.

    The boundary may touch itself at vertices and along edges. Vertices with an angle of pi are
    kept: no triangle has a vertex in the interior of one of its edges. O(n^2) in a tile of n
    vertices, if the number of candidate ears tested in a row is bounded.
    """
    nodes = list(cycle)
    triangles: list[tuple[Index, Index, Index]] = []
    i = misses = 0
    while len(nodes) > 3:
        n = len(nodes)
        a, b, c = nodes[i - 1], nodes[i], nodes[(i + 1) % n]
        if _is_ear(nodes, a, b, c, points):
            triangles.append((a, b, c))
            del nodes[i]
            i, misses = (i - 1) % (n - 1), 0
        else:
            i, misses = (i + 1) % n, misses + 1
            if misses > n:
                raise AuditError(f"the polygon {nodes} is not simple")
    triangles.append((nodes[0], nodes[1], nodes[2]))
    return triangles


def _is_ear(nodes: Sequence[Index], a: Index, b: Index, c: Index, points: list[Point]) -> bool:
    p, q, r = points[a], points[b], points[c]
    return orientation(p, q, r) > 0 and not any(
        in_triangle(points[v], p, q, r) for v in nodes if v not in (a, b, c)
    )


def pull_tight(
    start: Point, goal: Point, portals: Sequence[Portal], points: list[Point]
) -> list[VertexId]:
    """Return the nodes at which the shortest path through portals bends, in order.

    The funnel algorithm. Nodes that the path passes straight on are left out.
    """
    ends = [(points[l], points[r]) for l, r in portals] + [(goal, goal)]
    nodes = [*portals, NOWHERE]
    path: list[tuple[Point, VertexId]] = [(start, NO_VERTEX)]
    apex = left = right = start
    left_at = right_at = -1
    i = 0
    while i < len(ends):
        l, r = ends[i]
        if apex == right or orientation(apex, right, r) >= 0:
            if apex in (right, left) or _opens(apex, left, r) or _stops_short(apex, left, r):
                right, right_at = r, i
            else:  # the right end has crossed the left side of the funnel: a bend
                path.append((left, nodes[left_at][0]))
                apex = right = left
                i, right_at = left_at + 1, left_at
                continue
        if apex == left or orientation(apex, left, l) <= 0:
            if apex in (left, right) or _opens(apex, l, right) or _stops_short(apex, right, l):
                left, left_at = l, i
            else:
                path.append((right, nodes[right_at][1]))
                apex = left = right
                i, left_at = right_at + 1, right_at
                continue
        i += 1
    path.append((goal, NO_VERTEX))
    return bends(path)


def _opens(apex: Point, left: Point, right: Point) -> bool:
    """Return True if ``right`` is to the right of ``left`` as seen from the apex.

    Opposite directions count as well: the apex is then on the portal.
    """
    turn = orientation(apex, left, right)
    return turn < 0 or (turn == 0 and between(left, right, apex))


def _stops_short(apex: Point, end: Point, near: Point) -> bool:
    """Return True if a point is on a side of the funnel, before its end.

    The funnel has no width there, but a path to that point does not bend at the end.
    """
    return near != end and orientation(apex, end, near) == 0 and between(apex, end, near)


def bends(path: Sequence[tuple[Point, VertexId]]) -> list[VertexId]:
    """Return the nodes, if not -1, at which a path turns, its start and its goal left out."""
    kept: list[tuple[Point, VertexId]] = []
    for p, node in path:
        if kept and kept[-1][0] == p:
            continue
        while len(kept) > 1 and _is_straight(kept[-2][0], kept[-1][0], p):
            kept.pop()
        kept.append((p, node))
    return [node for _, node in kept[1:] if node >= 0]


def _is_straight(a: Point, b: Point, c: Point) -> bool:
    return orientation(a, b, c) == 0 and between(a, c, b)
