"""The meetings of the rings of a body at one time: faults, and points in which rings touch.

Two rings touch if they have single points in common and do not cross there. From these points alone
`dividing_loop` decides whether the inside of a part is connected. All results are exact. Float
boxes, rounded outward, only rule out pairs of edges.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum
from itertools import combinations
from typing import NamedTuple, TypeAlias

from exactpt.geometry.polygon import edges_touch, near_groups
from exactpt.geometry.predicates import Point, between, is_left_of_path, orientation

_Node: TypeAlias = "int | Point"
"""A node of the graph of touches: a ring, by its number, or a point in which rings touch."""


class FaultKind(Enum):
    """Why two edges cannot be edges of one body."""

    NO_LENGTH = "an edge whose ends coincide"
    SAME_RING = "two edges of one ring, or of a chain, that share more than a common end"
    CROSSING = "two edges of two rings that cross, or at whose common point the rings cross"
    COMMON_PIECE = "two edges of two rings that share more than a point"


class EdgeFault(NamedTuple):
    """Two edges that cannot be edges of one body.

    Attributes:
        first, second: the edges, by the numbers of their first vertices; equal if an edge has no
            length.
        kind: why they cannot.
    """

    first: int
    second: int
    kind: FaultKind


class Passage(NamedTuple):
    """The way of a ring through a point.

    Attributes:
        vertex: the vertex of the ring in this place; None inside of an edge.
        before, after: the vertices between which the ring passes: the neighbours of the vertex,
            or the ends of the edge.
    """

    vertex: int | None
    before: int
    after: int


class RingTouch(NamedTuple):
    """A point in which two or more rings touch.

    Attributes:
        point: the point.
        passages: how each of the rings, by number, passes through it.
    """

    point: Point
    passages: Mapping[int, Passage]

    @property
    def vertex(self) -> int:
        """The first vertex in this place. There is one: edges that do not cross touch at an end."""
        return min(way.vertex for way in self.passages.values() if way.vertex is not None)


class Meetings(NamedTuple):
    """Where the edges of rings meet.

    Attributes:
        fault: the first fault; None if there is none.
        touches: the points in which rings touch, in the order of their first vertices; none if
            there is a fault.
    """

    fault: EdgeFault | None
    touches: Sequence[RingTouch]


def ring_meetings(
    points: Sequence[Point], edges: Sequence[tuple[int, int]], rings: Sequence[range]
) -> Meetings:
    """Return where the edges of one or more rings, or of a chain, meet.

    >>> square, hole = [(0, 0), (4, 0), (4, 4), (0, 4)], [(4, 1), (2, 3), (2, 2)]
    >>> edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 4)]
    >>> found = ring_meetings([*square, *hole], edges, [range(4), range(4, 7)])
    >>> found.fault, [touch.point for touch in found.touches]
    (None, [(4, 1)])

    Args:
        points: the positions of the vertices.
        edges: the edges, as pairs of vertices; edge i begins at vertex i.
        rings: the vertices of each ring.
    """
    for i, (u, v) in enumerate(edges):
        if points[u] == points[v]:
            return Meetings(EdgeFault(i, i, FaultKind.NO_LENGTH), ())
    ring_of = {vertex: number for number, ring in enumerate(rings) for vertex in ring}
    faults: list[EdgeFault] = []
    touching: dict[Point, dict[int, Passage]] = {}
    for i, j in near_groups([(points[u], points[v]) for u, v in edges]):
        if ring_of[i] == ring_of[j]:
            if edges_touch(points, edges[i], edges[j]):
                faults.append(EdgeFault(i, j, FaultKind.SAME_RING))
            continue
        common = _common_point(points, edges[i], edges[j])
        if isinstance(common, FaultKind):
            faults.append(EdgeFault(i, j, common))
        elif common is not None:
            ways = touching.setdefault(common, {})
            for edge in (i, j):
                ring = ring_of[edge]
                ways[ring] = _passage(points, rings[ring], edges[edge], common)
    if faults:
        return Meetings(min(faults, key=lambda fault: fault[:2]), ())
    touches = [RingTouch(point, ways) for point, ways in touching.items()]
    crossings = [fault for touch in touches for fault in _crossings(points, touch)]
    if crossings:
        return Meetings(min(crossings, key=lambda fault: fault[:2]), ())
    return Meetings(None, sorted(touches, key=lambda touch: touch.vertex))


def _common_point(
    points: Sequence[Point], e: tuple[int, int], f: tuple[int, int]
) -> Point | FaultKind | None:
    """Return the only common point of two edges; the fault if they have more or cross there."""
    a, b, c, d = (points[v] for v in (*e, *f))
    sides_of_e = orientation(a, b, c), orientation(a, b, d)
    sides_of_f = orientation(c, d, a), orientation(c, d, b)
    common = {p for p, s in zip((c, d), sides_of_e, strict=True) if s == 0 and between(a, b, p)}
    common |= {p for p, s in zip((a, b), sides_of_f, strict=True) if s == 0 and between(c, d, p)}
    if len(common) > 1:
        return FaultKind.COMMON_PIECE
    if common:
        return common.pop()
    cross = sides_of_e[0] * sides_of_e[1] < 0 and sides_of_f[0] * sides_of_f[1] < 0
    return FaultKind.CROSSING if cross else None


def _passage(points: Sequence[Point], ring: range, edge: tuple[int, int], p: Point) -> Passage:
    """Return the way of a ring through a point of one of its edges."""
    for vertex in edge:
        if points[vertex] == p:
            place = vertex - ring.start
            return Passage(vertex, ring[place - 1], ring[(place + 1) % len(ring)])
    return Passage(None, *edge)


def _crossings(points: Sequence[Point], touch: RingTouch) -> Iterator[EdgeFault]:
    """Yield the pairs of rings that cross at a common point, by the edges on which they arrive.

    There, one ring has both sides of the other. No two of its edges there lie on each other.
    """
    for one, other in combinations(touch.passages.values(), 2):
        path = points[one.before], touch.point, points[one.after]
        sides = {is_left_of_path(*path, points[v]) for v in (other.before, other.after)}
        if len(sides) == 2:
            first, second = sorted((one.before, other.before))
            yield EdgeFault(first, second, FaultKind.CROSSING)


def dividing_loop(touches: Iterable[RingTouch], part: Iterable[int]) -> list[Point]:
    """Return touches of the rings of a part that divide its inside; none if it is connected.

    The rings of the part are its outline and its holes. They do not cross, the holes are inside
    of the outline, and none is inside of another.

    *Criterion.* Let G be the graph whose nodes are the rings and the points in which they touch,
    and in which a ring is joined to each of these points that is on it. The inside is connected
    if and only if G has no cycle: neither one of two rings that touch twice, nor one of more
    rings, each of which touches the next one in another point. (Several rings in one point are no
    cycle: G is a star there.)

    *Proof.* Draw the m rings as a plane graph B. Its nodes are the points of G, and one point of
    each ring without any. A ring with k nodes consists of k edges. So B has as many edges as rings
    have points, I, and with V nodes and C components, Euler's formula gives I - V + C + 1 faces.
    The graph G, with these points as nodes too, has m + V nodes, I edges and C components, so
    c = I - (m + V) + C independent cycles: B has c + m + 1 faces. The outside of the outline is
    one of them, by Jordan's theorem, as no ring has a point there. The inside of each of the
    m - 1 holes is one, for the same reason. The other c + 1 faces are the components of the inside
    of the part: one if and only if c = 0.

    Args:
        touches: points in which rings of the body touch.
        part: the numbers of the rings of the part.
    """
    joined: dict[_Node, list[_Node]] = {ring: [] for ring in part}
    for touch in touches:
        of_part = [ring for ring in touch.passages if ring in joined]
        if of_part:
            joined[touch.point] = [*of_part]
        for ring in of_part:
            joined[ring].append(touch.point)
    return [node for node in _cycle(joined) if not isinstance(node, int)]


def _cycle(joined: Mapping[_Node, Sequence[_Node]]) -> list[_Node]:
    """Return the nodes of a cycle of a graph, in order; none if there is no cycle."""
    found_from: dict[_Node, _Node | None] = {}
    for root in joined:
        if root in found_from:
            continue
        found_from[root] = None
        ahead = [root]
        for node in ahead:  # the list grows: a search in breadth
            for neighbour in joined[node]:
                if neighbour not in found_from:
                    found_from[neighbour] = node
                    ahead.append(neighbour)
                elif neighbour != found_from[node]:
                    return _closed(_to_root(found_from, node), _to_root(found_from, neighbour))
    return []


def _to_root(found_from: Mapping[_Node, _Node | None], node: _Node) -> list[_Node]:
    """Return the nodes from a node of a tree to its root."""
    way = [node]
    while (before := found_from[way[-1]]) is not None:
        way.append(before)
    return way


def _closed(way: list[_Node], other: list[_Node]) -> list[_Node]:
    """Return the cycle of two ways to the root of a tree whose first nodes are joined."""
    shared = set(way).intersection(other)
    meeting_place = next(node for node in way if node in shared)
    back = [node for node in other if node not in shared]
    return [*way[: way.index(meeting_place) + 1], *reversed(back)]
