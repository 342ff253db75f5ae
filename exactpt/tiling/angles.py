"""Certified angles: which sign every angle of a tiling has, and when it may lose it.

Source: the paper, section 2.2. An angle of a face fails when its three vertices become
collinear. One whose vertices belong to one rigid body never does; the three angles of a
triangle vanish together and share one certificate.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, final

from exactpt.certificates.certificate import ANGLE, MOTION, SHRINK, pack
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.queue import EventTime
from exactpt.certificates.table import CertificateTable
from exactpt.motion.vertices import Vertex, Vertices
from exactpt.pseudotriangulation.mesh import SOLID, Mesh
from exactpt.tiling.simultaneous import Batch

if TYPE_CHECKING:
    from exactpt.tiling.rules import Rules

__all__ = ["CertifiedMesh"]


@final
class CertifiedMesh:
    """A mesh just after the current time, with a certificate for each angle that can fail.

    Attributes:
        mesh: the mesh.
        vertices: the moving vertices.
        certifier: certificates and the current time.
        table: what is pending, violated and flat.
        rules: of the structure, told of all that changes.
        batch: what is repaired at the current time.
        is_careful: whether marks may be wrong where signs do not change.
    """

    rules: Rules

    def __init__(self, vertices: Vertices, certifier: Certifier, table: CertificateTable) -> None:
        self.mesh: Mesh = Mesh(0)
        self.vertices: Vertices = vertices
        self.certifier: Certifier = certifier
        self.table: CertificateTable = table
        self.batch: Batch = Batch()
        self.is_careful: bool = False

    def after(self) -> OneSided:
        """Predicates just after the current time."""
        return OneSided(self.certifier, before=False)

    def certify_everything(self) -> int:
        """Certify all angles, and what else the structure has; how many are pending of angles."""
        self.table.keep_only((MOTION, SHRINK))
        watched: list[int] = []
        angles: list[tuple[int, int, int]] = []
        region = self.mesh.region
        for h in self.mesh.map.half_edges():
            if region[h] != SOLID:
                a, p, b = self.angle(h)
                if self._cannot_fail(h, a, p, b):
                    self._skip(h)
                else:
                    watched.append(h)
                    angles.append((a, p, b))
        answers = self.certifier.orientations(angles)
        for h, (s, time) in zip(watched, answers, strict=True):
            self.table.angles.discard(h)
            self._keep(h, s, time)
        pending = len(self.table.pending)
        self.rules.certify()
        return pending

    def certify(self, h: int) -> None:
        """Certify the angle of h; note it if it is violated just after now."""
        table = self.table
        if table.angles:
            table.angles.discard(h)
        if table.flat:
            table.flat.discard(h)
        a, p, b = self.angle(h)
        if self.mesh.region[h] == SOLID or self._cannot_fail(h, a, p, b):
            self._skip(h)
        else:
            s, time = self.certifier.orientation(a, p, b)
            self._keep(h, s, time)

    def _skip(self, h: int) -> None:
        """An angle that cannot fail has no certificate; but its mark may be wrong.

        A rigid angle keeps its sign. One that is new has the wrong mark only in the midst
        of simultaneous events.
        """
        self.certifier.skipped += 1
        self.table.pending.cancel(pack(ANGLE, h))
        if self.is_careful and self.mesh.region[h] != SOLID:
            a, p, b = self.angle(h)
            if self.certifier.rigid(a, p, b) and (
                (self.after().sign(a, p, b) > 0) != self.mesh.corner[h]
            ):
                self.table.angles.add(h)

    def _cannot_fail(self, h: int, a: int, p: int, b: int) -> bool:
        """Whether the angle of h, at p between a and b, needs no certificate of its own."""
        return a == b or self.certifier.rigid(a, p, b) or self._is_copy(h)

    def _keep(self, h: int, s: int, time: EventTime | None) -> None:
        """Schedule the failure of an angle; note it if it is violated just after now."""
        table, certificate = self.table, pack(ANGLE, h)
        if s == 0:
            table.flat.add(h)
        if (s > 0) != self.mesh.corner[h]:
            table.pending.cancel(certificate)
            table.angles.add(h)
        elif time is None:
            table.pending.cancel(certificate)
        else:
            table.pending.schedule(certificate, time)

    def _is_copy(self, h: int) -> bool:
        """Whether another half-edge of a triangular face stands for its three angles."""
        m = self.mesh.map
        g = m.following[h]
        k = m.following[g]
        return m.following[k] == h and (g < h or k < h) and self.mesh.corner[h]

    def recertify(self, half_edges: list[int]) -> None:
        """Certify changed angles; of faces that are or were triangles, all angles."""
        m = self.mesh.map
        self.batch.touch(half_edges)
        todo: dict[int, None] = {}
        for h in half_edges:
            todo[h] = None
            if m.following[m.following[m.following[m.following[h]]]] == h or self.is_triangle(h):
                for g in m.face(h):
                    todo[g] = None
        for h in todo:
            self.certify(h)
        self.rules.changed(half_edges)

    def certify_body(self, i: int) -> list[int]:
        """Certify anew whatever depends on a body; the angles that vanish now."""
        m = self.mesh.map
        angles: dict[int, None] = {}
        for h in self.ring_angles(i):
            angles.update(dict.fromkeys((h, m.following[h], h ^ 1)))
        vanishing = []
        for h in angles:
            zeros = self.certifier.zeros
            self.certify(h)
            if self.certifier.zeros > zeros:
                vanishing.append(h)
        self.rules.certify_body(i)
        return vanishing

    def certify_again(self, half_edges: Iterable[int]) -> None:
        """Certify the angles of those half-edges that are still there."""
        for h in half_edges:
            if self.mesh.map.origin[h] >= 0:
                self.certify(h)

    def cancel_edge(self, h: int) -> None:
        """Forget the certificates of an edge that has been removed."""
        table = self.table
        for g in (h, h ^ 1):
            table.pending.cancel(pack(ANGLE, g))
            table.angles.discard(g)
            table.flat.discard(g)
        self.rules.cancelled(h)

    # Angles

    def angle(self, h: int) -> tuple[int, int, int]:
        """The vertices of the angle of h, which is at the second one."""
        m = self.mesh.map
        return m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]

    def vertices_of(self, h: int) -> tuple[Vertex, Vertex, Vertex]:
        """The same as moving vertices."""
        a, p, b = self.angle(h)
        v = self.vertices.all
        return v[a], v[p], v[b]

    def is_triangle(self, h: int) -> bool:
        """Whether the face on the left of h has three edges."""
        m = self.mesh.map
        return m.following[m.following[m.following[h]]] == h

    def straight_run(self, h: int) -> set[int]:
        """The vertices of an angle, and on along chains that are straight for ever."""
        m = self.mesh.map
        run = set(self.angle(h))
        for step in (m.following, m.previous):
            g = step[h]
            while g != h and self._is_flat(g):
                g = step[g]
                run.add(m.origin[g])
        return run

    def has_flats(self, h: int) -> bool:
        """Whether a chain that is straight for ever may be next to an angle."""
        m = self.mesh.map
        return (
            bool(self.table.flat) or self._is_flat(m.following[h]) or self._is_flat(m.previous[h])
        )

    def _is_flat(self, h: int) -> bool:
        """Whether the angle of h is straight for ever; of one body it has no certificate."""
        a, p, b = self.angle(h)
        return h in self.table.flat or (
            a != b and self.certifier.rigid(a, p, b) and self.after().sign(a, p, b) == 0
        )

    # Bodies

    def ring_angles(self, i: int) -> list[int]:
        """The half-edges out of the vertices of a body."""
        m, ring_edge = self.mesh.map, self.mesh.ring_edge
        return [h for v in self.vertices.bodies[i].ring for h in m.fan(ring_edge[v])]

    def edges_at(self, i: int) -> list[int]:
        """The edges at the vertices of a body."""
        return list(dict.fromkeys(min(h, h ^ 1) for h in self.ring_angles(i)))
