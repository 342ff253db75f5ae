"""The shortest path by Dijkstra's algorithm in the whole visibility graph.

There is no tiling, and there are no tangents. The nodes are the vertices, the start and the goal,
each once for every sector between two edges that end there: a path that arrives in a sector leaves
in it. Lengths are sums of square roots of rationals, which no algebraic number of small degree is:
each root is rounded down to a multiple of 2^-`BITS`, so that rationals enclose the sum.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cmp_to_key, partial
from heapq import heappop, heappush
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

from exactpt.geometry.predicates import orient2d
from exactpt.kernel.numbers import ZZ, isqrt
from exactpt.testing.reference.shapes import is_on_segment, squared_distance
from exactpt.testing.reference.space import (
    OpenChain,
    Places,
    Point,
    crosses,
    edges_of,
    rings_of,
)

__all__ = ["Length", "VisibilityGraph", "length_of", "shortest_length"]

BITS: Final = 512
"""Lengths are enclosed within the number of legs times 2^-BITS."""

Units: TypeAlias = ZZ
"""A length as a multiple of 2^-BITS, rounded down leg by leg."""


class Length(NamedTuple):
    """A length between two rationals, which are equal up to the last of some 500 bits."""

    low: Fraction
    high: Fraction

    def may_be(self, other: Length) -> bool:
        """Return True if both may be one length: nothing tells them apart."""
        return self.low <= other.high and other.low <= self.high

    def __float__(self) -> float:
        return float(self.low)


def length_of(points: Sequence[Point]) -> Length:
    """Return the length of a polyline with rational vertices.

    >>> float(length_of([(0, 0), (1, 1), (1, 2)]))
    2.414213562373095

    Args:
        points: its vertices.
    """
    legs = list(pairwise(points))
    return _enclosed(sum((_units(p, q) for p, q in legs), ZZ(0)), len(legs))


def shortest_length(scene: Places, start: Point, goal: Point) -> Length | None:
    """Return the length of a shortest path in the free space; None if there is no path.

    >>> wall = {"wall": [(1, -1), (1, 1)]}
    >>> float(shortest_length(wall, (0, 0), (2, 0)))
    2.8284271247461903

    Args:
        scene: the points of each body, by its name, as `points_of` returns them.
        start: a point that is not inside a body.
        goal: another one.
    """
    return VisibilityGraph(scene, start, goal).shortest(start, goal)


def _units(p: Point, q: Point) -> Units:
    squared = squared_distance(p, q)
    scaled = (ZZ(squared.numerator) << (2 * BITS)) // ZZ(squared.denominator)
    return isqrt(scaled)


def _enclosed(units: Units, legs: int) -> Length:
    """Return the enclosure of a sum: each leg may be longer by a unit."""
    one = 1 << BITS
    return Length(Fraction(int(units), one), Fraction(int(units) + legs, one))


class VisibilityGraph:
    """The graph of a scene (name -> points), and of a start and a goal, which are not inside."""

    def __init__(self, scene: Places, start: Point, goal: Point) -> None:
        self.scene = scene
        ends = [start, goal]
        self.points = sorted({*ends, *(p for points in scene.values() for p in points)})
        self.wall_side: dict[tuple[Point, Point], bool] = {}
        """(p, q) -> whether the left of the part of an edge from p to q is free."""
        for points in scene.values():
            is_solid = len(points) > 2 and not isinstance(points, OpenChain)
            for ring, is_hole in rings_of(points):
                edges = [(a, b) for i, a, b in edges_of(points) if i in ring]
                area = sum(orient2d((0, 0), a, b) for a, b in edges)
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
        stops = [p for p in self.points if is_on_segment(p, a, b)]
        stops.sort(reverse=a > b)
        for p, q in pairwise(stops):
            self.wall_side[p, q] = not left_is_solid
            self.wall_side[q, p] = left_is_solid or not is_solid

    def _legs(self, p: Point) -> Iterator[tuple[int, Point, int]]:
        """(sector, q, sector there) of all legs from a point."""
        for q in self.points:
            if q == p or any(is_on_segment(v, p, q) for v in self.points if v not in (p, q)):
                continue
            if (p, q) in self.wall_side:
                i, j = self.walls[p].index(q), self.walls[q].index(p)
                if self.wall_side[p, q]:
                    yield i, q, (j - 1) % len(self.walls[q])
                if self.wall_side[q, p]:
                    yield (i - 1) % len(self.walls[p]), q, j
            elif not crosses(p, q, self.scene):
                yield self._sector(p, q), q, self._sector(q, p)

    def _sector(self, p: Point, q: Point) -> int:
        """Return the sector at p that has the direction to q, by the wall before it."""
        walls = self.walls[p]
        before = [i for i, w in enumerate(walls) if _angular(p, w, q) < 0]
        return before[-1] if before else len(walls) - 1

    def shortest(self, start: Point, goal: Point) -> Length | None:
        """Return the length of a shortest path; None if there is no path."""
        sectors = max(len(self.walls[start]), 1)
        first = 0 if self.walls[start] else -1
        at = {(start, first + i): (ZZ(0), 0) for i in range(sectors)}
        heap = [(*length, *node) for node, length in at.items()]
        legs: dict[Point, list[tuple[int, Point, int]]] = {}
        while heap:
            units, count, p, sector = heappop(heap)
            if p == goal:
                return _enclosed(units, count)
            if (units, count) > at[p, sector]:
                continue
            if p not in legs:
                legs[p] = list(self._legs(p))
            for here, q, there in legs[p]:
                longer = units + _units(p, q), count + 1
                is_shorter = (q, there) not in at or longer < at[q, there]
                if here == sector and is_shorter:
                    at[q, there] = longer
                    heappush(heap, (*longer, q, there))
        return None


def _angular(o: Point, a: Point, b: Point) -> int:
    """Compare two directions from a point: the order is counter-clockwise from (1, 0)."""
    lower = [(p[1], p[0]) < (o[1], o[0]) for p in (a, b)]
    if lower[0] != lower[1]:
        return 1 if lower[0] else -1
    turn = orient2d(o, a, b)
    return int(turn < 0) - int(turn > 0)
