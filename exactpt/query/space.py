"""The free space at one time, and queries about it.

A point is located by a straight walk through the tiling from a place near it (jump-and-walk), a
ray is followed from tile to tile, and the shortest path of a homotopy class is found in a sleeve
of tiles. Preparation takes O(n log n). A query takes O(edges crossed): O(k) for k bodies in a
tiling with the minimum number of faces, O(log n) across the relative hull of a polygon in the
mixed tiling, plus the size of the tiles visited.

Sources: the paper, sections 4 and 5 (Lemma 5.4 for the number of edges crossed); E. P. Mücke,
I. Saias, B. Zhu, Fast randomized point location without preprocessing in two- and
three-dimensional Delaunay triangulations, Computational Geometry 12 (1999) (jump-and-walk; walks
start in the middle of a cell of a grid here).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TypeAlias, final

import numpy as np
from mypy_extensions import i64
from numpy.typing import ArrayLike

from exactpt.brief import counted
from exactpt.cached_property import cached_property
from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.indices import VertexId
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, Rational, as_doubles, fraction, shorten, show
from exactpt.pseudotriangulation.snapshot import Snapshot, snapshot
from exactpt.query.answers import Hit, Located, Place, ShortestPath, VertexName
from exactpt.query.homotopy import ShortestPaths
from exactpt.query.locate import cast, codes_of, find, place_of
from exactpt.query.nodes import Given, exact
from exactpt.query.outer import OuterRectangle, with_outer_triangulation
from exactpt.query.ray import Ray
from exactpt.query.subdivision import OUTSIDE, Subdivision
from exactpt.tiling.start import relative_hulls
from exactpt.tiling.tiling import Tiling

PointLike: TypeAlias = "Sequence[Rational]"
"""A point or a direction: a sequence of two numbers."""


@final
class FreeSpace:
    """The plane at a rational time, subdivided into bodies and tiles of the free space.

    Bodies are closed: a ray that grazes a body hits it, and a segment that touches a body is
    not free. Coordinates are rational and never rounded.

    Args:
        kinetic: a kinetic tiling.
        at: a rational time, from now to before the next event.

    Attributes:
        snapshot: the tiling at that time; `Place.tile` is an index into its faces.
    """

    def __init__(self, kinetic: Tiling, at: QQ) -> None:
        self._vertices = kinetic.vertices
        self._changes = kinetic.vertices.changes
        self._node = kinetic.vertices.nodes()
        self._bodies = [moving.body for moving in kinetic.vertices.bodies]
        mesh = kinetic.mesh_now(at)
        # The relative hulls of the mesh change as the run goes on: they are read now.
        self._relative_hulls = mesh.relative_hulls()
        self.exact_at = at
        self._wide: dict[int, ShortestPaths] = {}
        self.snapshot: Snapshot = snapshot(self._vertices, mesh, kinetic.name, at)

    def __repr__(self) -> str:
        bodies = counted(len(self._bodies), "body")
        faces = counted(len(self.snapshot.faces), "face")
        return f"<FreeSpace of {bodies}, {faces}, at t = {show(self.exact_at)}>"

    @property
    def at(self) -> Fraction:
        """The time of the subdivision."""
        return fraction(self.exact_at)

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("a FreeSpace is of its run: copy the simulation, or take the snapshot")

    @cached_property
    def _plane(self) -> Subdivision:
        return Subdivision(self.snapshot, self._bodies)

    # Places and rays

    def locate(self, point: PointLike) -> Place:
        """Return the location of a point: tile, diagonal, body, edge, vertex, or outside."""
        spot, crossed = find(self._plane, _given(point))
        return place_of(self._plane, spot, crossed)

    def locate_many(self, points: ArrayLike) -> Located:
        """Return the locations of many points: the same as `locate` of each.

        Args:
            points: finite doubles of shape (n, 2), exactly as they are.

        Raises:
            InputError: if the shape is not (n, 2), or a coordinate is not finite.
        """
        plane = self._plane
        given = np.asarray(points, dtype=np.float64)
        if given.ndim != 2 or given.shape[1] != 2:
            raise InputError(f"points: an array of shape (n, 2), got {given.shape}")
        bad = np.flatnonzero(~np.isfinite(given).all(axis=1))
        if len(bad):
            raise InputError(f"points: row {bad[0]} is not finite: {given[bad[0]].tolist()}")
        kind, (owner, feature) = np.empty(len(given), np.int8), np.full((2, len(given)), -1)
        for k, (x, y) in enumerate(given.tolist()):
            check_budget()
            kind[k], owner[k], feature[k] = codes_of(plane, find(plane, (x, y))[0])
        return Located(kind, owner, feature)

    def ray_cast(self, origin: PointLike, direction: PointLike) -> Hit | None:
        """Return the first point of a ray that belongs to a body; None if there is none.

        Raises:
            InputError: if the direction is (0, 0).
        """
        start, along = _given(origin), _given(direction)
        if not any(along):
            raise InputError("a ray needs a direction that is not (0, 0)")
        return cast(self._plane, Ray(self._plane, start, along))

    def is_free(self, p: PointLike, q: PointLike) -> bool:
        """Return True if no body intersects the closed segment from p to q."""
        start, end = _given(p), _given(q)
        if start == end:
            return self.locate(start).is_free
        return cast(self._plane, Ray(self._plane, start, goal=end)) is None

    # Paths

    def path(self, start: PointLike, goal: PointLike) -> ShortestPath:
        """Return the shortest path of the homotopy class of one that crosses the fewest diagonals.

        Another homotopy class may contain a shorter path: see `shortest_path`. Free points are
        connected, if need be around the convex hull, unless one is in a hole of a body.

        Raises:
            InputError: if one of the points is not free.
            UnreachableError: if one of them is in a hole, and the other is not in the same hole.
        """
        p, q = _point(start), _point(goal)
        return self._paths((p, q)).path(p, q)

    def shortest_path(self, start: PointLike, goal: PointLike) -> ShortestPath:
        """Return a shortest path of all; it may touch bodies, but not cross them.

        Lengths are compared exactly; of equally short paths it is always the same one. It takes
        longer than `path`: the search looks around from each vertex that it reaches.

        Args:
            start: a point, which may be on the boundary of a body.
            goal: likewise.

        Raises:
            InputError: if one of the points is in the interior of a body.
            UnreachableError: if no path leads from one to the other, since one of them is in a
                hole of a body, or on its edge, and the other is not.
        """
        p, q = _point(start), _point(goal)
        return self._paths((p, q)).shortest(p, q)

    def shorten(self, walk: Sequence[PointLike]) -> ShortestPath:
        """Return the shortest path homotopic to a polyline, with the same ends.

        Args:
            walk: the vertices of a polyline in free space, at least one.

        Raises:
            InputError: if the polyline intersects a body.
        """
        points = [_point(p) for p in walk]
        if not points:
            raise InputError("a walk has at least one point")
        return self._paths(points).shorten(points)

    def _paths(self, points: Sequence[Point]) -> ShortestPaths:
        """Return the path finder in the smallest outer rectangle that contains the points."""
        plane = self._plane
        count = self._around.doublings(points) if plane.points else 0
        if count not in self._wide:
            if plane.points:
                corners = self._around.corners(count)
                wider = with_outer_triangulation(self.snapshot, self._hull_nodes(), corners)
                plane = Subdivision(wider, self._bodies)
            self._wide[count] = ShortestPaths(plane)
        return self._wide[count]

    @cached_property
    def _around(self) -> OuterRectangle:
        return OuterRectangle.of(self.snapshot)

    # Bodies

    def hull(self) -> list[VertexName]:
        """Return the vertices on the convex hull of all bodies, counter-clockwise.

        Vertices in the interior of a hull edge are included. A hull without area is traversed in
        both directions.
        """
        return [self._plane.node_name(v) for v in self._hull_nodes()]

    def _hull_nodes(self) -> Sequence[i64]:
        plane = self._plane
        if OUTSIDE not in plane.cycles:
            return range(len(plane.points))
        m = plane.map
        cycle = [m.origin[h] for h in m.face(plane.cycles[OUTSIDE][0])][::-1]
        least = cycle.index(min(cycle))
        return cycle[least:] + cycle[:least]

    def relative_hull(self, body: str) -> list[VertexName]:
        """Return the vertices of the shortest loop around this body alone, counter-clockwise.

        Bodies in its holes are in the loop too. The mixed tiling contains it; with any other
        tiling a mixed tiling is built here.

        Raises:
            InputError: if the body does not exist, or has several parts; or if a mixed tiling
                must be built, and bodies have been added, removed or given new motions since this
                space was made.
        """
        if len(self._bodies[self._index(body)].parts) > 1:
            raise InputError(
                f"body {shorten(body)} has several parts: no loop is the shortest around all"
            )
        index, first = self._index(body), self._plane.first
        if first[index + 1] - first[index] == 1:
            return [(body, 0)]
        around = self._relative_hulls or self._built_hulls
        nodes = [self._node[v] for v in around(index)]
        cycle = [
            v for before, v in zip([nodes[-1], *nodes[:-1]], nodes, strict=True) if v != before
        ]
        cycle = cycle or nodes[:1]
        least = cycle.index(min(cycle))
        return [self._plane.node_name(v) for v in cycle[least:] + cycle[:least]]

    @cached_property
    def _built_hulls(self) -> Callable[[int], list[VertexId]]:
        if self._vertices.changes != self._changes:
            raise InputError("the bodies have other motions now: make the space anew")
        return relative_hulls(PredicatesAt(self._vertices, self.exact_at, after=False))

    def neighbours(self, body: str) -> list[str]:
        """Return the bodies connected to a body by a diagonal, in the order of the scene.

        The next body to touch this one is among them at the time of contact: a vertex that is
        about to touch an edge is joined to an end of it.

        Raises:
            InputError: if the body does not exist.
        """
        index, plane = self._index(body), self._plane
        m = plane.map
        found: set[int] = set()
        for node in range(plane.first[index], plane.first[index + 1]):
            if plane.out[node] >= 0:
                found.update(plane.body[m.target(h)] for h in m.star(plane.out[node]))
        return [plane.names[i] for i in sorted(found - {index})]

    def _index(self, body: str) -> int:
        if body not in self._plane.names:
            raise InputError(f"no body {shorten(body)}")
        return self._plane.names.index(body)


def _given(p: PointLike) -> Given:
    if isinstance(p, str) or len(p) != 2:
        raise InputError(f"a point has two coordinates: {shorten(p)}")
    near = as_doubles([*p])
    return exact(p) if near is None else (near[0], near[1])


def _point(p: PointLike) -> Point:
    return exact(_given(p))
