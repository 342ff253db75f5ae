"""A region of a mesh to be retiled: some faces without the edges between them.

The rest of the mesh is unchanged, handles included. Within the region a plane sweep
(`exactpt.pseudotriangulation.plane_sweep`) finds new diagonals, and the result is made
pointed again; that may remove or flip diagonals of adjacent tiles too.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Iterable
from functools import cmp_to_key
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from librt.vecs import extend

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import NO_HALF_EDGE, Ends, HalfEdge, Triple, VertexId
from exactpt.planar.halfedge import found, twin
from exactpt.pseudotriangulation.build import star_order
from exactpt.pseudotriangulation.mesh import FREE, OUTER, SOLID, Mesh
from exactpt.pseudotriangulation.plane_sweep import Sweep, SweptEdge
from exactpt.pseudotriangulation.pointed import make_pointed

if TYPE_CHECKING:
    from exactpt.motion.vertices import MovingBody, Vertices


class Retiled(NamedTuple):
    """The changes made by retiling a region.

    Attributes:
        handles: the handles of removed edges; a later edge may use them again.
        removed, added: the diagonals removed and added, as pairs of vertices, in order.
        angles: the half-edges whose angles are new, or belong or belonged to a triangle.
    """

    handles: list[HalfEdge]
    removed: list[Ends]
    added: list[Ends]
    angles: list[HalfEdge]


class _Angle(NamedTuple):
    ends: Triple
    in_triangle: bool


class Region:
    """Faces of a mesh that have been merged.

    Args:
        mesh: the mesh; the edges are removed from it at once.
        faces: one half-edge of every face; none before the first edge.
        gone: the edges to be removed, none of which borders another face.

    Attributes:
        mesh: the mesh.
        gone: the edges that have been removed.
    """

    def __init__(self, mesh: Mesh, faces: Iterable[HalfEdge], gone: Iterable[HalfEdge]) -> None:
        self.mesh = mesh
        self.gone: list[HalfEdge] = []
        self._before: dict[HalfEdge, _Angle] = {}
        self._rim: list[HalfEdge] = []
        self._removed: list[Ends] = []
        for first in faces:
            self._join(first)
        is_unbounded = not self._before or any(mesh.region[h] == OUTER for h in self._before)
        self._around = FREE if is_unbounded else SOLID
        self._remove(list(gone))

    def _join(self, first: HalfEdge) -> None:
        """Add a face to the region."""
        if first not in self._before:
            face = self.mesh.map.face(first)
            self._before.update((h, self._angle(h)) for h in face)
            self._rim += face

    def _remove(self, edges: list[HalfEdge]) -> None:
        """Remove edges between faces of the region; later edges may use their handles."""
        mesh = self.mesh
        lost = {g for h in edges for g in (h, twin(h))}
        self.gone += edges
        self._removed += [mesh.ends(h) for h in edges if not mesh.is_boundary(h)]
        self._rim = [h for h in self._rim if h not in lost]
        for h in lost:
            self._before.pop(h, None)
        for h in edges:
            mesh.map.remove_edge(h)

    def add_ring(self, vertices: Vertices, moving: MovingBody) -> None:
        """Add the ring of a new body to the region."""
        mesh, m = self.mesh, self.mesh.map
        more = len(vertices.all) - len(mesh.ring_edge)
        mesh.ring_edge = extend(mesh.ring_edge, [NO_HALF_EDGE] * more)
        for v in moving.ring:
            h = mesh.add_edge(v, vertices.ahead(v), boundary=True)
            mesh.ring_edge[v] = h
            mesh.region[h] = SOLID
            self._rim.append(twin(h))
        for v in moving.ring:
            ahead, behind = mesh.ring_edge[v], twin(mesh.ring_edge[vertices.behind(v)])
            m.link(twin(behind), ahead)
            m.link(twin(ahead), behind)

    def tile(self, predicates: Predicates) -> Retiled:
        """Tile the region.

        Raises:
            AuditError: if it cannot be tiled, because bodies in it overlap.
        """
        sweep = Sweep(predicates, self._edges(predicates, self._open()), around=self._around)
        added = [(u, v) for u, v, _ in sweep.run()]
        inside = [*self._rim, *self._insert(predicates, added)]
        self._mark(predicates, inside)
        changes = make_pointed(self.mesh, predicates, inside)
        m = self.mesh.map
        angles = dict.fromkeys(h for h in inside if self._has_changed(h))
        angles.update(dict.fromkeys(h for change in changes for h in change.angles))
        return Retiled(
            [change.handle for change in changes],
            self._removed + [change.old for change in changes],
            added + [change.new for change in changes if change.new is not None],
            [h for h in angles if m.origin[h] >= 0],
        )

    def _angle(self, h: HalfEdge) -> _Angle:
        m = self.mesh.map
        before = m.previous[h]
        in_triangle = m.following[m.following[h]] == before
        return _Angle((m.origin[before], m.origin[h], m.origin[h ^ 1]), in_triangle)

    def _has_changed(self, h: HalfEdge) -> bool:
        return self.mesh.map.origin[h] >= 0 and self._before.get(h) != self._angle(h)

    def _open(self) -> list[HalfEdge]:
        """Return the half-edges of the rim with the region to be tiled on their left."""
        return self._rim

    def _edges(self, predicates: Predicates, around: Iterable[HalfEdge]) -> Iterable[SweptEdge]:
        """Yield the swept edges of half-edges around some faces."""
        rim = dict.fromkeys(around)
        done: set[HalfEdge] = set()
        for h in rim:
            if h not in done:
                done.update((h, twin(h)))
                g = h if predicates.left_of(*self.mesh.ends(h)) else twin(h)
                yield SweptEdge(*self.mesh.ends(g), FREE if g in rim else SOLID)

    def _insert(self, predicates: Predicates, diagonals: Iterable[Ends]) -> list[HalfEdge]:
        """Link new diagonals into the stars of their ends; returns their half-edges."""
        mesh, m = self.mesh, self.mesh.map
        new: dict[VertexId, list[HalfEdge]] = {}
        for u, v in diagonals:
            h = mesh.add_edge(u, v, boundary=False)
            new.setdefault(u, []).append(h)
            new.setdefault(v, []).append(twin(h))
        for v, edges in new.items():
            # Counter-clockwise, as in `build_mesh`: the body first, then free space.
            star = m.star(mesh.ring_edge[v])
            last = found(filter(mesh.is_boundary, star[1:]), "second edge of a body at a vertex")
            k = star.index(last)
            free, key = star[k + 1 :], cmp_to_key(star_order(predicates, mesh, v, star[k]))
            for h in edges:
                insort(free, h, key=key)
            for h, following in pairwise([*star[: k + 1], *free, star[0]]):
                m.link(twin(following), h)
        return [h for edges in new.values() for h in edges]

    def _mark(self, predicates: Predicates, inside: list[HalfEdge]) -> None:
        """Mark the new angles, and the outer face."""
        mesh, m = self.mesh, self.mesh.map
        for h in inside:
            mesh.region[h] = FREE
            angle = self._angle(h)
            if h not in self._before or self._before[h].ends != angle.ends:
                a, p, b = angle.ends
                mesh.corner[h] = a == b or predicates.orientation(a, p, b) > 0
        seen: set[HalfEdge] = set()
        for h in inside:
            if h not in seen:
                face = m.face(h)
                seen.update(face)
                corners = sum(mesh.corner[g] for g in face)
                if corners == 0:
                    for g in face:
                        mesh.region[g] = OUTER
                elif corners != 3:
                    raise AuditError(f"a face of the region has {corners} corners")
