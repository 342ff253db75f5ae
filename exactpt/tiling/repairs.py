"""Repairs: what is done to a tiling when angles are violated.

Source: the paper, section 2.2, with the sub-cases of its update rules worked out. A
corner that closes is collapsed; a bend that straightens gives one of its edges way.
Either is one slide of an edge along its neighbour (`exactpt.planar.halfedge`).

At one time, several certificates may fail. They are repaired one after the other, in the
order of their slots, each judged by its sign *just after* that time, until none is
violated. If all angles of the result are as they should be, it is an embedding: the
angles around every vertex add up to a positive multiple of 2 pi and, by Euler's formula,
to 2 pi on average.
"""

from __future__ import annotations

from exactpt.certificates.coincidence import nearer, nearer_copy, strictly_between
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.perturbation import comes_first
from exactpt.errors import AuditError
from exactpt.pseudotriangulation.audit import audit_fan
from exactpt.pseudotriangulation.mesh import OUTER
from exactpt.tiling.angles import CertifiedTiling

__all__ = ["RebuildNeeded", "RepairedTiling"]


class RebuildNeeded(Exception):  # noqa: N818 - a turn of the control flow, no error
    """The events of one time could not be repaired one by one."""


class RepairedTiling(CertifiedTiling):
    """A tiling whose violated angles are mended one by one."""

    def _settle(self) -> None:
        """Repair until nothing is violated just after now.

        Raises:
            RebuildNeeded: if that does not end in a pseudo-triangulation.
        """
        rounds, most = 0, 64 + 4 * (len(self.queue) + len(self._due))
        while self._due or self._has_more():
            rounds += 1
            if rounds > most:
                raise RebuildNeeded
            self._batch.begin_repair()
            if self._due:
                self._repair(self._first_due())
            else:
                self._repair_more()
        if self._batch.needs_check(self.mesh):
            self._check_batch(sorted(self._batch.touched))

    def _first_due(self) -> int:
        """The violated angle to be mended first: copies of one triple in perturbed order."""
        first = min(self._due)
        if len(self._due) == 1:
            return first
        q = self._vertices_of(first)
        triple = {(v.body, v.index) for v in q}
        for h in sorted(self._due_at(triple) - {first}):
            p = self._vertices_of(h)
            if {(v.body, v.index) for v in p} == triple:
                signs = (-1 if self.mesh.corner[g] else 1 for g in (h, first))
                if comes_first(p, next(signs), q, next(signs), self.now):
                    first, q = h, p
        return first

    def _due_at(self, vertices: set[tuple[int, int]]) -> set[int]:
        """The violated angles at some vertices, each given by its body and its number there."""
        origin, every = self.mesh.map.origin, self.vertices.all
        return {h for h in self._due if ((v := every[origin[h]]).body, v.index) in vertices}

    def _check_batch(self, touched: list[int]) -> None:
        """Check what several repairs at one time have left: corners, order around vertices.

        Raises:
            RebuildNeeded: if it is no pseudo-triangulation.
        """
        m = self.mesh.map
        after = OneSided(self.certifier, before=False)
        try:
            self.mesh.audit_faces(touched)
            for v in sorted({m.origin[h] for h in touched if m.origin[h] >= 0}):
                audit_fan(self.mesh, self.mesh.ring_edge[v], after)
        except AuditError:
            raise RebuildNeeded from None

    def _has_more(self) -> bool:
        """Whether a certificate that is none of an angle is violated just after now."""
        return False

    def _repair_more(self) -> None:
        """Mend one of these."""

    def _repair(self, h: int) -> None:
        """Mend the violated angle of h."""
        self._due.discard(h)
        if self._is_triangle(h) and self.mesh.corner[h]:
            self._repair_triangle(h)
        elif self.mesh.corner[h]:
            self._repair_corner(h)
        else:
            self._repair_bend(h)

    def _repair_triangle(self, h: int) -> None:
        """A triangle closes: its middle vertex, a corner so far, comes to lie on the far edge.

        Of a pointed tiling, it is a reflex vertex of a polygon that becomes convex; the
        triangle was its last tile with an angle above pi on the other side.
        """
        mesh = self.mesh
        vertices = self._vertices_of(h)
        for i, middle in enumerate(vertices):
            a, b = vertices[i - 1], vertices[i - 2]
            if strictly_between(self.certifier, a, middle, b):
                break
        else:
            raise RebuildNeeded
        edge = next(g for g in mesh.map.face(h) if middle.id not in mesh.ends(g))
        if mesh.is_boundary(edge):
            raise RebuildNeeded
        across = mesh.map.face(edge ^ 1)
        self._record("hull" if mesh.is_hull(edge) else "corner", (mesh.ends(edge),), ())
        first, second = mesh.map.following[edge], mesh.map.previous[edge]
        after = mesh.map.following[edge ^ 1]
        mesh.dissolve_triangle(edge)
        self._cancel_edge(edge)
        self._recertify([first, second, after] if len(across) > 3 else mesh.map.face(first))

    def _repair_corner(self, h: int) -> None:
        mesh, m = self.mesh, self.mesh.map
        a, p, b = self._angle(h)
        v = self.vertices.all
        side = nearer(self.certifier, v[p], v[a], v[b]) or nearer_copy(
            self.certifier, v[p], v[a], v[b]
        )
        before = m.previous[h]
        if side == 0:
            raise RebuildNeeded
        long, origin_moves = (h, True) if side > 0 else (before, False)
        if mesh.is_boundary(long):
            raise RebuildNeeded
        kind = "hull" if mesh.is_hull(long) else "corner"
        mesh.collapse_corner(h, origin_moves=origin_moves)
        ends = (p, b, a) if origin_moves else (p, a, b)
        self._slid(h, before, kind, ends, origin_moves=origin_moves)

    def _repair_bend(self, h: int) -> None:
        mesh, m = self.mesh, self.mesh.map
        a, p, b = self._angle(h)
        before = m.previous[h]
        kind = "hull" if mesh.region[h] == OUTER else "reflex"
        stays_before, stays_after = mesh.stays(h)
        if stays_before and stays_after:
            self._repair_convex_vertex(h, kind)
            return
        # Of two diagonals that become one line the one before the bend gives way: the one
        # of larger theta, as the greedy tiling wants it. For just after now the bend p has
        # passed the segment from a (before) to b (after) to its right. If a is left of b,
        # p is below it and a p falls more steeply, so theta(a p) is larger; if a is right
        # of b, p is above and again theta(p a) is larger.
        origin_moves = stays_before
        mesh.straighten(h, origin_moves=origin_moves)
        ends = (p, b, a) if origin_moves else (p, a, b)
        self._slid(h, before, kind, ends, origin_moves=origin_moves)

    def _repair_convex_vertex(self, h: int, kind: str) -> None:
        """A convex vertex of a body becomes reflex: it gets a triangle of its own."""
        a, _, b = self._angle(h)
        e = self.mesh.cut_off(h)
        self._record(kind, (), ((a, b),))
        m = self.mesh.map
        self._recertify([e, m.following[e], e ^ 1, h, m.previous[h]])

    def _slid(
        self, h: int, before: int, kind: str, ends: tuple[int, int, int], *, origin_moves: bool
    ) -> None:
        """Certify the angles that a slide has changed: two in one face, three across."""
        m = self.mesh.map
        old, fixed, new = ends
        self._record(kind, ((old, fixed),), ((new, fixed),))
        if origin_moves:
            changed = [h, m.following[h], h ^ 1, before, m.following[before]]
        else:
            t = before ^ 1
            changed = [before, m.following[before], h, t, m.following[t]]
        self._recertify(changed)

    def _record(
        self,
        kind: str,
        removed: tuple[tuple[int, int], ...],
        added: tuple[tuple[int, int], ...],
    ) -> None:
        """Note a change; one between copies of a thin vertex is none for the outside."""
        if self._has_copies(removed) and self._scene_edges(removed) == self._scene_edges(added):
            self.stats.count("internal")
        else:
            super()._record(kind, removed, added)

    def _has_copies(self, edges: tuple[tuple[int, int], ...]) -> bool:
        """Whether an edge ends at a vertex that has copies."""
        for a, b in edges:
            if self.vertices.all[a].offset is not None or self.vertices.all[b].offset is not None:
                return True
        return False

    def _scene_edges(self, edges: tuple[tuple[int, int], ...]) -> set[frozenset[tuple[int, int]]]:
        v = self.vertices.all
        return {frozenset((v[i].body, v[i].index) for i in edge) for edge in edges}
