"""Homotopy classes of paths: the diagonals that a path crosses, and its shortest representative.

And the shortest of all classes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from itertools import pairwise
from typing import final

from exactpt.cached_property import cached_property
from exactpt.errors import AuditError, InputError, UnreachableError
from exactpt.geometry.predicates import Point
from exactpt.indices import NO_VERTEX, Ends, HalfEdge, VertexId
from exactpt.kernel.numbers import place, shorten
from exactpt.planar.halfedge import twin, without_steps_back
from exactpt.query.answers import ShortestPath, VertexName
from exactpt.query.locate import find, place_of
from exactpt.query.ray import Ray, reach
from exactpt.query.shortest import last_step
from exactpt.query.sight import FreeTriangles
from exactpt.query.sleeve import NOWHERE, Sleeves, bends, pull_tight
from exactpt.query.subdivision import OUTSIDE, On, Spot, Subdivision
from exactpt.query.walk import steps_of


@final
class ShortestPaths:
    """Shortest paths within the convex hull of a subdivision."""

    def __init__(self, plane: Subdivision) -> None:
        self._plane = plane
        self._sleeves = Sleeves(plane)

    def path(self, p: Point, q: Point) -> ShortestPath:
        """Return the shortest path homotopic to one that crosses the fewest diagonals."""
        if not self._plane.points:
            return _path((p, q), (), 0)
        first, last = self._tile(p), self._tile(q)
        crossed = self._sleeves.dual_path(first, last)
        if crossed is None:
            raise self._unreachable(p, q)
        return self._tight(p, first, crossed, q)

    def shortest(self, p: Point, q: Point) -> ShortestPath:
        """Return a shortest path; its ends may be on bodies, but not in their interior."""
        ends = [self._ends_of(find(self._plane, point)[0], point) for point in (p, q)]
        if p == q or not self._plane.points:
            return _path((p, q), (), 0)
        free = copy(self._triangles)
        start, goal = (free.inserted(*end) for end in ends)
        step = last_step(free, start, goal)
        if step is None:
            raise self._unreachable(p, q)
        nodes = step.nodes()
        way = [(p, NO_VERTEX), *((free.points[v], v) for v in nodes[1:-1]), (q, NO_VERTEX)]
        return self._named(p, bends(way), q, step.crossed)

    def shorten(self, points: Sequence[Point]) -> ShortestPath:
        """Return the shortest path homotopic to a polyline."""
        if not self._plane.points:
            return _path((points[0], points[-1]), (), 0)
        first = tile = self._tile(points[0])
        crossed: list[HalfEdge] = []
        for p, q in pairwise(points):
            part = self._crossed_along(p, tile, q)
            crossed += part
            tile = self._plane.face[part[-1] ^ 1] if part else tile
        return self._tight(points[0], first, without_steps_back(crossed), points[-1])

    @cached_property
    def _triangles(self) -> FreeTriangles:
        return FreeTriangles(self._plane, self._sleeves)

    def _ends_of(self, spot: Spot, p: Point) -> tuple[Point, Spot, Ends]:
        """Return a point, its spot, and the ends of the edge that it is on, for an insertion."""
        plane = self._plane
        if spot.on is On.FACE and spot.handle < OUTSIDE:
            raise _not_free(p, place_of(plane, spot).body)
        if spot.on is not On.EDGE:
            return p, spot, NOWHERE
        return p, spot, (plane.map.origin[spot.handle], plane.map.origin[spot.handle ^ 1])

    def _tile(self, p: Point) -> int:
        """Return a tile that contains a free point, in its interior or on its boundary."""
        plane = self._plane
        spot, _ = find(plane, p)
        place = place_of(plane, spot)
        if place.body is not None:
            raise _not_free(p, place.body)
        if spot.on is On.EDGE:
            return max(plane.face[spot.handle], plane.face[spot.handle ^ 1])
        return spot.handle

    def _crossed_along(self, p: Point, tile: int, q: Point) -> list[HalfEdge]:
        """Return the half-edges that a free segment from p in ``tile`` to q crosses, in order."""
        plane = self._plane
        if p == q:
            return []
        ray = Ray(plane, p, goal=q)
        spot, _ = find(plane, p)
        here = tile
        crossed: list[HalfEdge] = []
        steps = steps_of(plane, ray, spot)
        while True:
            step = next(steps)
            there = step.through.handle if step.through.on is On.FACE else here
            if spot.on is On.EDGE and there not in (here, OUTSIDE):
                h = HalfEdge(spot.handle)
                crossed.append(h if plane.face[h] == here else twin(h))
                here = there
            if step.end is None or ray.beyond_goal(step.end) >= 0:
                self._tile(q)  # raises if q is not free
                return crossed
            place = place_of(plane, step.end)
            if place.body is not None:
                (x, y), _ = reach(p, ray.direction, ray.ends(step.end))
                raise InputError(f"the walk meets body {shorten(place.body)} at ({x}, {y})")
            spot = step.end

    def _tight(
        self, start: Point, tile: int, crossed: Sequence[HalfEdge], goal: Point
    ) -> ShortestPath:
        plane = self._plane
        portals = self._sleeves.portals(start, tile, crossed, goal)
        nodes = pull_tight(start, goal, portals, plane.points)
        return self._named(start, nodes, goal, len(crossed))

    def _unreachable(self, p: Point, q: Point) -> UnreachableError:
        """Return the error that a body with a hole keeps two points apart.

        Raises:
            AuditError: if no body has a hole.
        """
        what = f"no path leads from ({p[0]}, {p[1]}) to ({q[0]}, {q[1]})"
        if all(len(cycles) == 1 for cycles in self._plane.cycles.values()):
            raise AuditError(what)
        return UnreachableError(f"{what}: a body is around one of them")

    def _named(
        self, start: Point, nodes: Sequence[VertexId], goal: Point, crossed: int
    ) -> ShortestPath:
        """Return the path that bends at these nodes."""
        plane = self._plane
        points = (start, *(plane.points[v] for v in nodes), goal)
        return _path(points, tuple(plane.node_name(v) for v in nodes), crossed)


def _not_free(p: Point, body: str | None) -> InputError:
    return InputError(f"the point ({p[0]}, {p[1]}) is not free: body {shorten(body)} has it")


def _path(points: Iterable[Point], bends: tuple[VertexName, ...], crossed: int) -> ShortestPath:
    """Return a path with coordinates as `Fraction`."""
    return ShortestPath(tuple(map(place, points)), bends, crossed)
