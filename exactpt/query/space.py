"""The space around the bodies at one time, and what can be asked of it.

A point is located by a walk through the tiling along a straight line, a ray is followed
from tile to tile, and a path is pulled tight in a sleeve of tiles. Making the space takes
O(n log n), asking O(edges crossed): O(k) of k bodies in a tiling with the fewest faces,
and O(log n) on the way through the relative hull of a polygon in the mixed one. (Each
step reads the tile that it passes.)

Source: the paper, sections 4 and 5 (Lemma 5.4 for the number of edges crossed).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TypeAlias, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, Rational, fraction, rational
from exactpt.pseudotriangulation.mesh import INSIDE, Mesh
from exactpt.pseudotriangulation.snapshot import Snapshot, snapshot
from exactpt.query.answers import Hit, Path, Place, VertexName
from exactpt.query.locate import cast, find, place_of
from exactpt.query.subdivision import OUTSIDE, Subdivision
from exactpt.query.surround import Around, surrounded
from exactpt.query.ways import Ways
from exactpt.tiling.mixed.static import mixed_mesh
from exactpt.tiling.tiling import Tiling

__all__ = ["FreeSpace", "PointLike"]

PointLike: TypeAlias = "Sequence[Rational]"
"""A point or direction as a caller may write it: two numbers."""


@final
class FreeSpace:
    """The plane at a rational time, tiled.

    Bodies are closed: a ray that grazes one hits it, a segment that touches one is not
    free. Points are pairs of rationals, exactly what is given.

    Args:
        kinetic: a tiling.
        at: a rational time, now or before the next event.

    Attributes:
        snapshot: the tiling then; `Place.tile` counts its faces.
    """

    def __init__(self, kinetic: Tiling, at: QQ) -> None:
        self._vertices = kinetic.vertices
        self._changes = kinetic.vertices.changes
        self._node = kinetic.vertices.nodes()
        self._mesh: Mesh = kinetic.mesh_now(at)
        # The bodies live on with the run; which they are now is kept.
        self._relative_hulls = self._mesh.relative_hulls()
        self._at = at
        self._wide: dict[int, Ways] = {}
        self.snapshot: Snapshot = snapshot(self._vertices, self._mesh, kinetic.name, at)

    @property
    def at(self) -> Fraction:
        """The time."""
        return fraction(self._at)

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("a FreeSpace is of its run: copy the simulation, or take the snapshot")

    @cached_property
    def _hidden(self) -> set[tuple[int, int]]:
        """The edges inside bodies, as pairs of nodes."""
        mesh, node = self._mesh, self._node
        ends = [mesh.ends(h) for h in mesh.diagonals() if mesh.region[h] == INSIDE]
        return {(min(node[u], node[v]), max(node[u], node[v])) for u, v in ends}

    @cached_property
    def _plane(self) -> Subdivision:
        return Subdivision(self.snapshot, self._hidden)

    # Places and rays

    def locate(self, point: PointLike) -> Place:
        """Where a point is."""
        spot, crossed = find(self._plane, _point(point))
        return place_of(self._plane, spot, crossed)

    def ray_cast(self, origin: PointLike, direction: PointLike) -> Hit | None:
        """The first point of a ray that a body has; None if it hits nothing.

        Raises:
            InputError: if the direction is (0, 0).
        """
        start, along = _point(origin), _point(direction)
        if not any(along):
            raise InputError("a ray needs a direction that is not (0, 0)")
        return cast(self._plane, start, along)

    def is_free(self, p: PointLike, q: PointLike) -> bool:
        """Whether no body has a point of the closed segment from p to q."""
        start, end = _point(p), _point(q)
        if start == end:
            return self.locate(start).is_free
        return cast(self._plane, start, (end[0] - start[0], end[1] - start[1]), QQ(1)) is None

    # Paths

    def path(self, start: PointLike, goal: PointLike) -> Path:
        """The shortest of the paths that cross the fewest diagonals in the same order.

        Another order of diagonals may have a shorter one. There is always a way between free
        points, around the convex hull if need be.

        Raises:
            InputError: if one of the points is not free.
        """
        p, q = _point(start), _point(goal)
        return self._ways((p, q)).path(p, q)

    def shorten(self, walk: Sequence[PointLike]) -> Path:
        """The shortest path that a walk can be deformed into, its ends fixed.

        Args:
            walk: the points of a polyline in free space.

        Raises:
            InputError: if a body is in the way.
        """
        points = [_point(p) for p in walk]
        if not points:
            raise InputError("a walk has at least one point")
        return self._ways(points).shorten(points)

    def _ways(self, points: Sequence[Point]) -> Ways:
        """What knows the ways between points: in a rectangle that has them inside."""
        plane = self._plane
        count = self._around.doublings(points) if plane.points else 0
        if count not in self._wide:
            if plane.points:
                corners = self._around.corners(count)
                wider = surrounded(self.snapshot, self._hull_nodes(), corners)
                plane = Subdivision(wider, self._hidden)
            self._wide[count] = Ways(plane)
        return self._wide[count]

    @cached_property
    def _around(self) -> Around:
        return Around.of(self.snapshot)

    # Bodies

    def hull(self) -> list[VertexName]:
        """The vertices on the convex hull of all bodies, counter-clockwise.

        Those inside an edge of the hull too. A hull without area is walked there and back.
        """
        return [self._plane.node_name(v) for v in self._hull_nodes()]

    def _hull_nodes(self) -> list[int]:
        plane = self._plane
        if OUTSIDE not in plane.door:
            return list(range(len(plane.points)))
        m = plane.map
        cycle = [m.origin[h] for h in m.face(plane.door[OUTSIDE])][::-1]
        least = cycle.index(min(cycle))
        return cycle[least:] + cycle[:least]

    def relative_hull(self, body: str) -> list[VertexName]:
        """The vertices of the shortest loop around a body and no other, counter-clockwise.

        In the mixed tiling it is known; for others that tiling is built here.

        Raises:
            InputError: if there is no such body; or if that tiling must be built, and bodies
                have changed their motions, come or gone since the space was made.
        """
        index, first = self._index(body), self._plane.first
        if first[index + 1] - first[index] == 1:
            return [(body, 0)]
        around = self._relative_hulls or self._mixed
        nodes = [self._node[v] for v in around(index)]
        cycle = [
            v for before, v in zip([nodes[-1], *nodes[:-1]], nodes, strict=True) if v != before
        ]
        cycle = cycle or nodes[:1]
        least = cycle.index(min(cycle))
        return [self._plane.node_name(v) for v in cycle[least:] + cycle[:least]]

    @cached_property
    def _mixed(self) -> Callable[[int], list[int]]:
        if self._vertices.changes != self._changes:
            raise InputError("the bodies have other motions now: make the space anew")
        return mixed_mesh(PredicatesAt(self._vertices, self._at, after=False)).relative_hulls()

    def neighbours(self, body: str) -> list[str]:
        """The bodies that a diagonal joins to a body, in the order of the scene.

        Whatever touches the body next is among them then: a vertex that meets an edge is
        joined to one of its ends just before.

        Raises:
            InputError: if there is no such body.
        """
        index, plane = self._index(body), self._plane
        m = plane.map
        found: set[int] = set()
        for node in range(plane.first[index], plane.first[index + 1]):
            if plane.out[node] >= 0:
                found.update(plane.body[m.target(h)] for h in m.fan(plane.out[node]))
        return [plane.names[i] for i in sorted(found - {index})]

    def _index(self, body: str) -> int:
        if body not in self._plane.names:
            raise InputError(f"no body {body!r}")
        return self._plane.names.index(body)


def _point(p: PointLike) -> Point:
    if isinstance(p, str) or len(p) != 2:
        raise InputError(f"a point has two coordinates: {p!r}")
    return rational(p[0]), rational(p[1])
