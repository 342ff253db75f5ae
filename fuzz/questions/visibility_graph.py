"""The shortest path by Dijkstra's algorithm in the whole visibility graph, in 500-bit arithmetic.

From the definition: no tiling, no tangents. Its nodes are the vertices, the start and the goal,
each once for every sector between two edges that end there: a path that arrives in a sector
leaves in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cmp_to_key, partial
from heapq import heappop, heappush
from itertools import pairwise
from typing import Any, Final, TypeAlias

import mpmath

from fuzz.questions import brute
from fuzz.questions.brute import Places, Point

__all__ = ["VisibilityGraph", "length_of"]

Real: TypeAlias = "Any"
"""A real number of mpmath, which declares no types."""

BITS: Final = 500


def length_of(points: Sequence[Point]) -> Real:
    """The length of a polyline with rational vertices."""
    with mpmath.workprec(BITS):
        return mpmath.fsum(_distance(p, q) for p, q in pairwise(points))


def _distance(p: Point, q: Point) -> Real:
    x, y = q[0] - p[0], q[1] - p[1]
    d = x * x + y * y
    return mpmath.sqrt(mpmath.mpf(int(d.numerator)) / int(d.denominator))


class VisibilityGraph:
    """The graph of a scene (name -> points), and of a start and a goal, which are not inside."""

    def __init__(self, scene: Places, start: Point, goal: Point) -> None:
        self.scene = scene
        ends = [start, goal]
        self.points = sorted({*ends, *(p for points in scene.values() for p in points)})
        self.wall_side: dict[tuple[Point, Point], bool] = {}
        """(p, q) -> whether the left of the part of an edge from p to q is free."""
        for points in scene.values():
            is_solid = len(points) > 2 and not isinstance(points, brute.OpenChain)
            for ring, is_hole in brute.rings_of(points):
                edges = [(a, b) for i, a, b in brute.edges_of(points) if i in ring]
                area = sum(brute.cross((0, 0), a, b) for a, b in edges)
                for a, b in edges:
                    left = is_solid and (area > 0) != is_hole
                    self._add_wall(a, b, left_is_solid=left, is_solid=is_solid)
        self.walls: dict[Point, list[Point]] = {p: [] for p in self.points}
        for p, q in self.wall_side:
            self.walls[p].append(q)
        for p, around in self.walls.items():
            around.sort(key=cmp_to_key(partial(_angular, p)))

    def _add_wall(self, a: Point, b: Point, *, left_is_solid: bool, is_solid: bool) -> None:
        """Add the parts of an edge between the points on it."""
        stops = [p for p in self.points if brute.on_segment(p, a, b)]
        stops.sort(reverse=a > b)
        for p, q in pairwise(stops):
            self.wall_side[p, q] = not left_is_solid
            self.wall_side[q, p] = left_is_solid or not is_solid

    def _legs(self, p: Point) -> Iterator[tuple[int, Point, int]]:
        """(sector, q, sector there) of all legs from a point."""
        for q in self.points:
            if q == p or any(brute.on_segment(v, p, q) for v in self.points if v not in (p, q)):
                continue
            if (p, q) in self.wall_side:
                i, j = self.walls[p].index(q), self.walls[q].index(p)
                if self.wall_side[p, q]:
                    yield i, q, (j - 1) % len(self.walls[q])
                if self.wall_side[q, p]:
                    yield (i - 1) % len(self.walls[p]), q, j
            elif not brute.crosses(p, q, self.scene):
                yield self._sector(p, q), q, self._sector(q, p)

    def _sector(self, p: Point, q: Point) -> int:
        """The sector at p that has the direction to q, by the wall before it."""
        walls = self.walls[p]
        before = [i for i, w in enumerate(walls) if _angular(p, w, q) < 0]
        return before[-1] if before else len(walls) - 1

    def shortest(self, start: Point, goal: Point) -> Real | None:
        """The length of a shortest path; None if there is no path."""
        with mpmath.workprec(BITS):
            zero = mpmath.mpf(0)
            count = max(len(self.walls[start]), 1)
            at = {(start, i - (not self.walls[start])): zero for i in range(count)}
            heap = [(zero, *state) for state in at]
            legs: dict[Point, list[tuple[int, Point, int]]] = {}
            while heap:
                length, p, sector = heappop(heap)
                if p == goal:
                    return length
                if length > at[p, sector]:
                    continue
                if p not in legs:
                    legs[p] = list(self._legs(p))
                for here, q, there in legs[p]:
                    new = length + _distance(p, q)
                    if here == sector and new < at.get((q, there), mpmath.inf):
                        at[q, there] = new
                        heappush(heap, (new, q, there))
        return None


def _angular(o: Point, a: Point, b: Point) -> int:
    """The order of directions counter-clockwise from (1, 0)."""
    lower = [(p[1], p[0]) < (o[1], o[0]) for p in (a, b)]
    if lower[0] != lower[1]:
        return 1 if lower[0] else -1
    turn = brute.cross(o, a, b)
    return int(turn < 0) - int(turn > 0)
