"""The conflict zone of a new body in a tiling: the faces that it intersects.

A search from any face visits others in the order of their distance (in floats, which
decide only the order) until it finds one that contains a vertex of the body; from there,
every diagonal that the body crosses leads to another face of the zone, exactly. Everything is
decided at the given time, for closed faces and the closed body, so that nothing is missed
where certificates vanish at that time.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.errors import AuditError, InputError
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.geometry.predicates import Point, orientation
from exactpt.indices import HalfEdge, VertexId
from exactpt.kernel.numbers import shorten, show
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import INSIDE, OUTER, SOLID, Mesh

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.motion.vertices import Vertices


class ConflictZone(NamedTuple):
    """The faces and diagonals that a body intersects.

    Attributes:
        faces: one half-edge of every face that it intersects.
        crossed: one half-edge of every diagonal that it intersects.
    """

    faces: list[HalfEdge]
    crossed: list[HalfEdge]


def find_conflict_zone(vertices: Vertices, mesh: Mesh, body: Body, t: QQ) -> ConflictZone | None:
    """Return the conflict zone of a body that is not in the tiling yet.

    None if its first vertex is in a body of several rings: the face there is not one cycle.

    Args:
        vertices: the moving vertices.
        mesh: their tiling just after a time.
        body: the new body.
        t: the time.

    Raises:
        InputError: if the body touches another body.
    """
    return _Search(vertices, mesh, body, t).zone()


@final
class _Search:
    def __init__(self, vertices: Vertices, mesh: Mesh, body: Body, t: QQ) -> None:
        self.vertices = vertices
        self.mesh = mesh
        self.body = body
        self.t = t
        self.points: Sequence[Point] = body.exact_at(t)
        pairs = body.edges or [(0, 0)]
        self.edges = [(self.points[u], self.points[v]) for u, v in pairs]
        self.low = min(p[0] for p in self.points), min(p[1] for p in self.points)
        self.high = max(p[0] for p in self.points), max(p[1] for p in self.points)
        self.known: dict[VertexId, Point] = {}

    def zone(self) -> ConflictZone | None:
        """Return the conflict zone of the body."""
        if not self.vertices.bodies:
            return ConflictZone([], [])
        first = self._face_around(self.points[0])
        if not first:
            return None
        faces, crossed, touched = [first[0]], dict[HalfEdge, None](), set[int]()
        if self.mesh.region[first[0]] in (SOLID, INSIDE):
            touched.add(self._body_at(first[0]))
        seen, todo = set(first), [first]
        for face in todo:
            for h in face:
                if min(h, twin(h)) in crossed or not self._meets(h):
                    continue
                if self.mesh.is_boundary(h):
                    touched.add(self._body_at(h))
                    continue
                crossed[min(h, twin(h))] = None
                if h ^ 1 not in seen:
                    beyond = self.mesh.map.face(twin(h))
                    seen.update(beyond)
                    todo.append(beyond)
                    faces.append(twin(h))
        # A body inside the new one is connected to what lies outside of it, if anything
        # does; so is the first face.
        touched.update(
            self._body_at(g)
            for h in [*crossed, first[0]]
            for g in (h, twin(h))
            if self.body.has_interior and contains(self.points, self._at(self.mesh.map.origin[g]))
        )
        if touched:
            name = self.vertices.bodies[min(touched)].body.name
            raise InputError(
                f"body {shorten(self.body.name)} touches body {shorten(name)} at t = {show(self.t)}"
            )
        return ConflictZone(faces, list(crossed))

    def _at(self, v: VertexId) -> Point:
        """Return the position of a vertex."""
        if v not in self.known:
            self.known[v] = self.vertices.all[v].track.exact_at(self.t)
        return self.known[v]

    def _ends(self, h: HalfEdge) -> tuple[Point, Point]:
        u, v = self.mesh.ends(h)
        return self._at(u), self._at(v)

    def _body_at(self, h: HalfEdge) -> int:
        return self.vertices.all[self.mesh.map.origin[h]].body

    def _face_around(self, p: Point) -> list[HalfEdge]:
        """Return a closed face that contains a point; empty if it is in a body of several rings."""
        m, solid, seen = self.mesh.map, self._in_rings(), set[HalfEdge]()
        first = self.mesh.ring_edge[self.vertices.bodies[-1].ring[0]]
        waiting = [(0.0, twin(first)), *((math.inf, h) for h in solid)]
        target = self.vertices.normalization.point(p)
        while waiting:
            _, first = heapq.heappop(waiting)
            if first in seen:
                continue
            face = m.face(first)
            seen.update(face)
            # The unbounded face winds around the points that are not in it.
            is_around = (self._turns(face, p) != 0) != (self.mesh.region[first] == OUTER)
            if is_around and solid.keys().isdisjoint(face):
                return face
            for h in face:
                if h ^ 1 not in seen:
                    heapq.heappush(waiting, (self._distance(h, target), twin(h)))
        if not solid:
            raise AuditError(f"no face around ({p[0]}, {p[1]})")
        return []

    def _in_rings(self) -> dict[HalfEdge, None]:
        """Return the half-edges with a body of several rings on their left, one of each ring."""
        of = [b for b in self.vertices.bodies if b.body.has_rings and not b.is_tiled]
        return dict.fromkeys(self.mesh.ring_edge[ring[0]] for b in of for ring in b.rings)

    def _distance(self, h: HalfEdge, target: tuple[float, float]) -> float:
        """Return an estimate of the distance from an edge to a normalised position."""
        (ax, ay), (bx, by) = map(self.vertices.normalization.point, self._ends(h))
        dx, dy, px, py = bx - ax, by - ay, target[0] - ax, target[1] - ay
        square = dx * dx + dy * dy
        s = min(max((px * dx + py * dy) / square, 0.0), 1.0) if square > 0.0 else 0.0
        return math.hypot(px - s * dx, py - s * dy)

    def _turns(self, face: Sequence[HalfEdge], p: Point) -> int:
        """Return the winding number of a face around a point, half-open in y as in `contains`."""
        turns = 0
        for h in face:
            a, b = self._ends(h)
            if (a[1] > p[1]) != (b[1] > p[1]):
                s = orientation(a, b, p)
                if b[1] > a[1]:
                    turns += s > 0
                else:
                    turns -= s < 0
        return turns

    def _meets(self, h: HalfEdge) -> bool:
        """Return True if the boundary of the body intersects the closed edge of a half-edge."""
        a, b = self._ends(h)
        for axis in (0, 1):
            if max(a[axis], b[axis]) < self.low[axis] or min(a[axis], b[axis]) > self.high[axis]:
                return False
        return any(segments_meet(a, b, c, d) for c, d in self.edges)
