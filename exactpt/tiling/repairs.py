"""Repairs of violated angles.

Source: the paper, section 2.2, with the sub-cases of its update rules worked out. A corner
whose angle becomes 0 is collapsed; at a reflex angle that becomes pi, one of the two edges is
replaced. In both cases one edge slides along its neighbour (`exactpt.planar.halfedge`).

Several certificates may fail at one time. They are repaired one after the other, in
increasing order of half-edges, each by its sign *just after* that time, until none is
violated. If all angles of the result have the sign of their marks, it is an embedding: the
angles around every vertex add up to a positive multiple of 2 pi and, by Euler's formula,
to 2 pi on average.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.coincidence import nearer, nearer_copy, strictly_between
from exactpt.certificates.perturbation import comes_first
from exactpt.errors import AuditError
from exactpt.indices import HalfEdge, Triple
from exactpt.planar.halfedge import found, twin
from exactpt.pseudotriangulation.audit import audit_star
from exactpt.pseudotriangulation.mesh import OUTER
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.rules import Rules


class RebuildNeeded(Exception):  # noqa: N818 - control flow, no error
    """The failures of one time cannot be repaired one by one."""


@final
class Repairs:
    """Repairs the violated angles of a mesh, and the other certificates of its rules."""

    def __init__(self, certified: CertifiedMesh, rules: Rules, log: Log) -> None:
        self.certified: CertifiedMesh = certified
        self._rules: Rules = rules
        self._log: Log = log

    def repair_all(self) -> None:
        """Repair until nothing is violated just after now.

        Raises:
            RebuildNeeded: if that does not end in a pseudo-triangulation.
        """
        table, failure_group, rules = (
            self.certified.table,
            self.certified.failure_group,
            self._rules,
        )
        rounds, most = 0, 64 + 4 * (len(table.pending) + len(table.angles))
        while table.angles or rules.is_violated():
            rounds += 1
            if rounds > most:
                raise RebuildNeeded
            failure_group.begin_repair()
            if table.angles:
                self._repair(self.first_violated())
            else:
                rules.repair()
        if failure_group.needs_check(self.certified.mesh):
            self.check_batch()
        rules.recanonicalize()

    def first_violated(self) -> HalfEdge:
        """Return the least violated angle; of copies, the first in the perturbed order."""
        certified, violated = self.certified, self.certified.table.angles
        if len(violated) == 1:
            for only in violated:
                return only
        first = min(violated)
        q = certified.vertices_of(first)
        triple = {(v.body, v.index) for v in q}
        for h in sorted(self._violated_at(triple) - {first}):
            p = certified.vertices_of(h)
            if {(v.body, v.index) for v in p} == triple:
                signs = (-1 if certified.mesh.corner[g] else 1 for g in (h, first))
                if comes_first(p, next(signs), q, next(signs), certified.certifier.exact_now):
                    first, q = h, p
        return first

    def _violated_at(self, vertices: set[tuple[int, int]]) -> set[HalfEdge]:
        """Return the violated angles at vertices of the scene, given by body and index."""
        certified = self.certified
        origin, every = certified.mesh.map.origin, certified.vertices.all
        return {
            h for h in certified.table.angles if ((v := every[origin[h]]).body, v.index) in vertices
        }

    def check_batch(self) -> None:
        """Check the corners of changed faces and the order around their vertices.

        Raises:
            RebuildNeeded: if the mesh is not a pseudo-triangulation there.
        """
        mesh, touched = self.certified.mesh, sorted(self.certified.failure_group.touched)
        m, after = mesh.map, self.certified.after()
        try:
            mesh.audit_faces(touched)
            for v in sorted({m.origin[h] for h in touched if m.origin[h] >= 0}):
                audit_star(mesh, mesh.ring_edge[v], after)
        except AuditError:
            raise RebuildNeeded from None
        self._rules.check(touched)

    def _repair(self, h: HalfEdge) -> None:
        """Repair the violated angle of h."""
        certified = self.certified
        certified.table.angles.discard(h)
        is_corner = certified.mesh.corner[h]
        if is_corner and certified.is_triangle(h):
            self._repair_triangle(h)
        elif is_corner:
            self._repair_corner(h)
        else:
            self._repair_reflex_angle(h)

    def _repair_triangle(self, h: HalfEdge) -> None:
        """Dissolve a triangle whose middle vertex has come to lie on the opposite edge.

        In a pointed tiling the middle vertex is a reflex vertex of a polygon that becomes
        convex: it was a corner of all its tiles, and becomes a reflex vertex of the tile
        across the edge.
        """
        certified, mesh = self.certified, self.certified.mesh
        vertices = certified.vertices_of(h)
        for i, middle in enumerate(vertices):
            a, b = vertices[i - 1], vertices[i - 2]
            if strictly_between(certified.certifier, a, middle, b):
                break
        else:
            raise RebuildNeeded
        opposite = (g for g in mesh.map.face(h) if middle.id not in mesh.ends(g))
        edge = found(opposite, "edge opposite of the vertex in the middle")
        if mesh.is_boundary(edge):
            raise RebuildNeeded
        across = mesh.map.face(twin(edge))
        self._log.record("hull" if mesh.is_hull(edge) else "corner", (mesh.ends(edge),), ())
        first, second = mesh.map.following[edge], mesh.map.previous[edge]
        after = mesh.map.following[edge ^ 1]
        mesh.dissolve_triangle(edge)
        certified.cancel_edge(edge)
        certified.recertify([first, second, after] if len(across) > 3 else mesh.map.face(first))

    def _repair_corner(self, h: HalfEdge) -> None:
        mesh, certifier = self.certified.mesh, self.certified.certifier
        a, p, b = self.certified.angle(h)
        va, vp, vb = self.certified.vertices_of(h)
        side = nearer(certifier, vp, va, vb) or nearer_copy(certifier, vp, va, vb)
        before = mesh.map.previous[h]
        if side == 0:
            raise RebuildNeeded
        long, origin_moves = (h, True) if side > 0 else (before, False)
        if mesh.is_boundary(long):
            raise RebuildNeeded
        kind = "hull" if mesh.is_hull(long) else "corner"
        mesh.collapse_corner(h, origin_moves=origin_moves)
        ends = (p, b, a) if origin_moves else (p, a, b)
        self._record_slide(h, before, kind, ends, origin_moves=origin_moves)

    def _repair_reflex_angle(self, h: HalfEdge) -> None:
        mesh = self.certified.mesh
        a, p, b = self.certified.angle(h)
        before = mesh.map.previous[h]
        kind = "hull" if mesh.region[h] == OUTER else "reflex"
        stays_before, stays_after = mesh.stays(h)
        if stays_before and stays_after:
            self._rules.turns_reflex(h)
            self._repair_convex_vertex(h, kind)
            return
        # Of two diagonals that become collinear, the one before p is replaced: it has the
        # larger theta, as the greedy tiling requires. For just after now p lies to the right
        # of the segment from a (before p) to b (after p). If a is left of b, p is below the
        # segment and a p falls more steeply, so theta(a p) is larger; if a is right of b, p is
        # above it and again theta(p a) is larger.
        origin_moves = stays_before
        mesh.straighten(h, origin_moves=origin_moves)
        ends = (p, b, a) if origin_moves else (p, a, b)
        self._record_slide(h, before, kind, ends, origin_moves=origin_moves)

    def _repair_convex_vertex(self, h: HalfEdge, kind: str) -> None:
        """Cut off a triangle at a convex vertex of a body that becomes reflex."""
        a, _, b = self.certified.angle(h)
        e = self.certified.mesh.cut_off(h)
        self._log.record(kind, (), ((a, b),))
        m = self.certified.mesh.map
        self.certified.recertify([e, m.following[e], twin(e), h, m.previous[h]])

    def _record_slide(
        self, h: HalfEdge, before: HalfEdge, kind: str, ends: Triple, *, origin_moves: bool
    ) -> None:
        """Record the slide of an edge, and certify the five angles that it has changed.

        Args:
            h: the half-edge whose angle has been repaired.
            before: the half-edge before h until the repair.
            kind: the kind of the event.
            ends: the old end of the edge, its fixed end and its new one.
            origin_moves: whether h has moved, or else the edge before it.
        """
        m = self.certified.mesh.map
        old, fixed, new = ends
        self._log.record(kind, ((old, fixed),), ((new, fixed),))
        if origin_moves:
            changed = [h, m.following[h], twin(h), before, m.following[before]]
        else:
            t = twin(before)
            changed = [before, m.following[before], h, t, m.following[t]]
        self.certified.recertify(changed)
