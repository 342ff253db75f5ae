"""Certified angles: a certificate for every angle of a tiling that may become 0, pi or 2 pi.

Source: the paper, section 2.2. An angle of a face fails when its three vertices become
collinear. An angle whose vertices belong to one rigid body never fails; the three angles
of a triangle fail together and share one certificate.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, final

import numpy as np
from librt.vecs import vec
from mypy_extensions import i64, mypyc_attr

from exactpt.certificates.certificate import ANGLE, MOTION, SHRINK, pack
from exactpt.certificates.certifier import Certifier, least_first
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.queue import Angles
from exactpt.certificates.table import CertificateTable
from exactpt.filters.rounding import INFINITY
from exactpt.indices import NO_HALF_EDGE, HalfEdge, Triple, VertexId, half_edge_vec
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import view
from exactpt.motion.vertex import Vertex
from exactpt.motion.vertices import MOTION as MOTION_OF
from exactpt.motion.vertices import OTHER_MOTION, WIDTH, Vertices
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import SOLID, Mesh
from exactpt.tiling.simultaneous import FailureGroup

MANY: Final = 50
"""Number of angles from which on they are certified in numpy."""
FEW: Final = 16
"""Number of certificates from one look at the budget to the next."""
MAX_ANGLES_OF_FIVE: Final[int] = 20
"""Maximum number of angles that `CertifiedMesh.certify_five` certifies."""


@mypyc_attr(allow_interpreted_subclasses=True)
class Followers:
    """Further certificates of a mesh; its methods do nothing by default, see `Rules`."""

    def certify(self) -> None:
        """Certify a newly built tiling, except for its angles."""

    def certify_body(self, i: int) -> None:
        """Certify again what depends on the motion of a body, except for angles."""

    def changed(self, half_edges: list[HalfEdge]) -> None:
        """Follow a change of the angles of these half-edges."""

    def cancelled(self, h: HalfEdge) -> None:
        """Follow the removal of an edge: cancel its certificates."""


@final
class CertifiedMesh(Angles):
    """A mesh just after the current time, with a certificate for each angle that can fail.

    Attributes:
        mesh: the mesh.
        vertices: the moving vertices.
        certifier: certificates and the current time.
        table: the pending and the violated certificates, and the flat angles.
        followers: the rules of the tiling, which receive every change.
        failure_group: the repairs at the current time.
        checks_rigid: whether angles that cannot fail are checked too: in the midst of repairs
            and after other changes their marks may be wrong.
    """

    followers: Followers

    def __init__(self, vertices: Vertices, certifier: Certifier, table: CertificateTable) -> None:
        self.mesh: Mesh = Mesh(0)
        self.vertices: Vertices = vertices
        self.certifier: Certifier = certifier
        self.table: CertificateTable = table
        table.pending.angles = self
        self.failure_group: FailureGroup = FailureGroup()
        self.checks_rigid: bool = False
        self._after: OneSided = OneSided(certifier, before=False)
        self._todo: vec[HalfEdge] = half_edge_vec([NO_HALF_EDGE] * MAX_ANGLES_OF_FIVE)

    def after(self) -> OneSided:
        """Predicates just after the current time, whichever that is."""
        return self._after

    def certify_everything(self) -> int:
        """Certify the whole tiling; returns the number pending without those of the rules."""
        self.table.keep_only((MOTION, SHRINK))
        mesh, certifier = self.mesh, self.certifier
        is_usual = not (certifier.exact_only or certifier.roots_now or self.checks_rigid)
        if is_usual and len(mesh.region) >= MANY:
            half_edges = self._certify_in_arrays()
        else:
            half_edges = [h for h in mesh.map.half_edges() if mesh.region[h] != SOLID]
        for k, h in enumerate(half_edges):
            if k % FEW == 0:
                check_budget()
            self.certify(h)
        pending = len(self.table.pending)
        self.followers.certify()
        return pending

    def _certify_in_arrays(self) -> list[HalfEdge]:
        """Certify all angles, none of which is pending; return those that numpy leaves open."""
        table, certifier, m = self.table, self.certifier, self.mesh.map
        origin, following = view(m.origin), view(m.following)
        h = np.flatnonzero((origin >= 0) & (view(self.mesh.region) != SOLID))
        corner = view(self.mesh.corner)[h] > 0
        ids = np.stack([origin[view(m.previous)[h]], origin[h], origin[h ^ 1]], axis=1)
        second = following[h]
        third = following[second]
        shares = corner & (following[third] == h) & ((second < h) | (third < h))
        motions = view(self.vertices.places).reshape(-1, WIDTH)[ids, MOTION_OF]
        moves = motions[:, 0]
        together = (moves >= 0.0) & (moves == motions[:, 1]) & (moves == motions[:, 2])
        shares |= ids[:, 0] == ids[:, 2]
        for k in np.flatnonzero((motions == OTHER_MOTION).any(axis=1) & ~shares).tolist():
            a, p, b = ids[k].tolist()
            together[k] = certifier.rigid(a, p, b)
        fails = ~(shares | together)
        certifier.skipped += len(h) - int(np.count_nonzero(fails))
        h, corner, ids = h[fails], corner[fails], ids[fails]
        if len(h) < MANY:
            few: list[HalfEdge] = h.tolist()
            return few
        ids = np.take_along_axis(ids, (ids.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
        signs, lows, highs = certifier.orientations(ids)
        is_known, holds = signs != 0, (signs > 0) == corner
        table.angles.update(h[is_known & ~holds].tolist())
        fails = is_known & holds & (lows < INFINITY)
        table.pending.schedule_angles(h[fails], lows[fails], highs[fails])
        left: list[HalfEdge] = h[~is_known].tolist()
        return left

    def certify(self, h: HalfEdge) -> bool:
        """Certify the angle of h, or record it as violated just after now.

        Returns:
            Whether it can fail and vanishes now; an angle that the filter decides does not.
        """
        table = self.table
        if table.angles:
            table.angles.discard(h)
        if table.flat:
            table.flat.discard(h)
        a, p, b = self.angle(h)
        if self.mesh.region[h] == SOLID or self._cannot_fail(h, a, p, b):
            self._skip(h)
            return False
        s, vanishes = table.watch_orientation(pack(ANGLE, h), a, p, b)
        if s == 0:
            table.flat.add(h)
        if (s > 0) != self.mesh.corner[h]:
            table.pending.cancel(pack(ANGLE, h))
            table.angles.add(h)
        return vanishes

    def _skip(self, h: HalfEdge) -> None:
        """Cancel the certificate of an angle that cannot fail; optionally check its mark.

        A rigid angle keeps its sign, so its mark can be wrong only if the angle is new, in the
        midst of simultaneous repairs.
        """
        self.certifier.skipped += 1
        self.table.pending.cancel(pack(ANGLE, h))
        if self.checks_rigid and self.mesh.region[h] != SOLID:
            a, p, b = self.angle(h)
            if self.certifier.rigid(a, p, b) and (
                (self.after().orientation(a, p, b) > 0) != self.mesh.corner[h]
            ):
                self.table.angles.add(h)

    def _cannot_fail(self, h: HalfEdge, a: VertexId, p: VertexId, b: VertexId) -> bool:
        """Return True if the angle of h, at p between a and b, needs no certificate of its own."""
        if a == b or self._shares_certificate(h):
            return True
        return self.certifier.rigid(a, p, b)

    def _shares_certificate(self, h: HalfEdge) -> bool:
        """Return True if the angle's triangle is certified at another angle."""
        if not self.mesh.corner[h]:
            return False
        m = self.mesh.map
        g = m.following[h]
        k = m.following[g]
        return m.following[k] == h and (g < h or k < h)

    def recertify(self, half_edges: list[HalfEdge]) -> None:
        """Certify changed angles, and all angles of faces that are or were triangles."""
        following = self.mesh.map.following
        self.failure_group.touch(half_edges)
        todo: dict[HalfEdge, None] = {}
        for h in half_edges:
            todo[h] = None
            second = following[h]
            third = following[second]
            fourth = following[third]
            if fourth == h or following[fourth] == h:
                todo[second] = todo[third] = None
                if fourth != h:
                    todo[fourth] = None
        for h in todo:
            self.certify(h)
        self.followers.changed(half_edges)

    def certify_five(
        self, h0: HalfEdge, h1: HalfEdge, h2: HalfEdge, h3: HalfEdge, h4: HalfEdge
    ) -> None:
        """Certify the same angles as `recertify`, in the same order, and nothing else."""
        todo = self._todo
        n = self._list(h4, self._list(h3, self._list(h2, self._list(h1, self._list(h0, 0)))))
        i: i64 = 0
        while i < n:
            self.certify(todo[i])
            i += 1

    def _list(self, h: HalfEdge, n: i64) -> i64:
        """List h, and its face if that is or was a triangle; n are listed; return their number."""
        following = self.mesh.map.following
        second = following[h]
        third = following[second]
        fourth = following[third]
        n = self._list_one(h, n)
        if fourth == h or following[fourth] == h:
            n = self._list_one(third, self._list_one(second, n))
            if fourth != h:
                n = self._list_one(fourth, n)
        return n

    def _list_one(self, h: HalfEdge, n: i64) -> i64:
        """List h if it is not one of the n listed; return their number."""
        todo = self._todo
        i: i64 = 0
        while i < n:
            if todo[i] == h:
                return n
            i += 1
        todo[n] = h
        return n + 1

    def certify_body(self, i: int) -> list[HalfEdge]:
        """Certify again whatever depends on a body; returns the angles that vanish now."""
        m = self.mesh.map
        angles: dict[HalfEdge, None] = {}
        for h in self.ring_angles(i):
            angles.update(dict.fromkeys((h, m.following[h], twin(h))))
        vanishing = [h for h in angles if self.certify(h)]
        self.followers.certify_body(i)
        return vanishing

    def certify_again(self, half_edges: Iterable[HalfEdge]) -> None:
        """Certify the angles of those half-edges that still exist."""
        for h in half_edges:
            if self.mesh.map.origin[h] >= 0:
                self.certify(h)

    def cancel_edge(self, h: HalfEdge) -> None:
        """Cancel the certificates of an edge that has been removed."""
        table = self.table
        for g in (h, twin(h)):
            table.pending.cancel(pack(ANGLE, g))
            table.angles.discard(g)
            table.flat.discard(g)
        self.followers.cancelled(h)

    # Angles

    def angle(self, h: HalfEdge) -> Triple:
        """Return the three vertices of the angle of h, its apex in the middle."""
        m = self.mesh.map
        return m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]

    def function(self, h: HalfEdge) -> Triple:
        """See `Angles.function`."""
        a, p, b = self.angle(h)
        return least_first(a, p, b)

    def vertices_of(self, h: HalfEdge) -> tuple[Vertex, Vertex, Vertex]:
        """Return the three moving vertices of the angle of h, its apex in the middle."""
        a, p, b = self.angle(h)
        v = self.vertices.all
        return v[a], v[p], v[b]

    def is_triangle(self, h: HalfEdge) -> bool:
        """Return True if the face on the left of h has three edges."""
        m = self.mesh.map
        return m.following[m.following[m.following[h]]] == h

    def collinear_run(self, h: HalfEdge) -> set[VertexId]:
        """Return the vertices of an angle, extended on both sides along flat angles."""
        m = self.mesh.map
        run = set(self.angle(h))
        for step in (m.following, m.previous):
            g = step[h]
            while g != h and self._is_flat(g):
                g = step[g]
                run.add(m.origin[g])
        return run

    def has_flats(self, h: HalfEdge) -> bool:
        """Return True if an angle may be next to a flat one."""
        m = self.mesh.map
        return (
            bool(self.table.flat) or self._is_flat(m.following[h]) or self._is_flat(m.previous[h])
        )

    def _is_flat(self, h: HalfEdge) -> bool:
        """Return True if the angle of h is flat (of one rigid body it is not in the table)."""
        a, p, b = self.angle(h)
        return h in self.table.flat or (
            a != b and self.certifier.rigid(a, p, b) and self.after().orientation(a, p, b) == 0
        )

    # Bodies

    def ring_angles(self, i: int) -> list[HalfEdge]:
        """Return the half-edges out of the vertices of a body: the stars of its vertices."""
        m, ring_edge = self.mesh.map, self.mesh.ring_edge
        return [h for v in self.vertices.bodies[i].ring for h in m.star(ring_edge[v])]

    def edges_at(self, i: int) -> list[HalfEdge]:
        """Return one half-edge, the even one, of every edge at the vertices of a body."""
        return list(dict.fromkeys(min(h, twin(h)) for h in self.ring_angles(i)))
