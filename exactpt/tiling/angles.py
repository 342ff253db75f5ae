"""Certified angles: which sign every angle of a tiling has, and when it may lose it.

Source: the paper, section 2.2. An angle of a face fails when its three vertices become
collinear. One whose vertices belong to one rigid body never does; the three angles of a
triangle vanish together and share one certificate.
"""

from __future__ import annotations

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import ANGLE, MOTION, SHRINK, kind_of, pack
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertex, Vertices
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.pseudotriangulation.degenerate import close_at
from exactpt.pseudotriangulation.mesh import SOLID, Mesh
from exactpt.tiling.events import Stats
from exactpt.tiling.simultaneous import Batch
from exactpt.tiling.tiling import Tiling

__all__ = ["CertifiedTiling"]


class CertifiedTiling(Tiling):
    """A tiling with a certificate for each angle that can fail.

    Attributes:
        mesh: the tiling just after the current time.
    """

    def __init__(self, vertices: Vertices, certifier: Certifier, stats: Stats) -> None:
        super().__init__(vertices, certifier, stats)
        self.mesh: Mesh = Mesh(0)
        self._flat: set[int] = set()
        self._due: set[int] = set()
        self._batch: Batch = Batch()
        self._careful: bool = False
        self._clear_notes()

    def _clear_notes(self) -> None:
        """Forget what is noted during the repairs of one time."""

    @property
    def flat(self) -> set[int]:
        """The half-edges whose angles are known to be straight for ever."""
        return self._flat

    def mesh_after(self) -> Mesh:
        """The tiling just after the current time: not a copy."""
        return self.mesh

    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event.

        It is the current one with corners closed; or, where corners close on each other
        so that one by one they cannot, the one that is built at that time.
        """
        mesh = self.mesh.copy()
        instant = PredicatesAt(self.vertices, time, after=False)
        try:
            self._close(mesh, instant)
        except AuditError:
            mesh = self.mesh_at(instant)
            audit_angles(mesh, instant)
        return mesh

    def _close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Make a tiling just after an instant the one at the instant.

        Raises:
            AuditError: if that does not end in a tiling.
        """
        if close_at(mesh, instant):
            audit_angles(mesh, instant)

    def _certify_everything(self) -> None:
        self._flat.clear()
        for slot in self.queue.slots():
            if kind_of(slot) not in (MOTION, SHRINK):
                self.queue.cancel(slot)
        watched: list[int] = []
        angles: list[tuple[int, int, int]] = []
        region = self.mesh.region
        for h in self.mesh.map.half_edges():
            if region[h] != SOLID:
                a, p, b = self._angle(h)
                if self._cannot_fail(h, a, p, b):
                    self._skip(h)
                else:
                    watched.append(h)
                    angles.append((a, p, b))
        answers = self.certifier.orientations(angles)
        for h, (s, time) in zip(watched, answers, strict=True):
            self._due.discard(h)
            self._keep(h, s, time)
        self.stats.most = max(self.stats.most, len(self.queue))

    def _certify(self, h: int) -> None:
        """Certify the angle of h; note it as due if it is violated just after now."""
        if self._due:
            self._due.discard(h)
        if self._flat:
            self._flat.discard(h)
        a, p, b = self._angle(h)
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
        self.queue.cancel(pack(ANGLE, h))
        if self._careful and self.mesh.region[h] != SOLID:
            a, p, b = self._angle(h)
            if self.certifier.rigid(a, p, b):
                after = OneSided(self.certifier, before=False)
                if (after.sign(a, p, b) > 0) != self.mesh.corner[h]:
                    self._due.add(h)

    def _cannot_fail(self, h: int, a: int, p: int, b: int) -> bool:
        """Whether the angle of h, at p between a and b, needs no certificate of its own."""
        return a == b or self.certifier.rigid(a, p, b) or self._is_copy(h)

    def _keep(self, h: int, s: int, time: EventTime | None) -> None:
        """Schedule the failure of an angle; note it as due if it is violated just after now."""
        slot = pack(ANGLE, h)
        if s == 0:
            self._flat.add(h)
        if (s > 0) != self.mesh.corner[h]:
            self.queue.cancel(slot)
            self._due.add(h)
        elif time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)

    def _is_copy(self, h: int) -> bool:
        """Whether another half-edge of a triangular face stands for its three angles."""
        m = self.mesh.map
        g = m.following[h]
        k = m.following[g]
        return m.following[k] == h and (g < h or k < h) and self.mesh.corner[h]

    def _recertify(self, slots: list[int]) -> None:
        """Certify changed angles; of faces that are or were triangles, all angles."""
        m = self.mesh.map
        self._batch.touch(slots)
        todo: dict[int, None] = {}
        for h in slots:
            todo[h] = None
            if m.following[m.following[m.following[m.following[h]]]] == h or self._is_triangle(h):
                for g in m.face(h):
                    todo[g] = None
        for h in todo:
            self._certify(h)

    def _certify_body(self, i: int) -> list[int]:
        """Certify anew whatever depends on a body; the angles that vanish now."""
        m = self.mesh.map
        angles: dict[int, None] = {}
        for v in self.vertices.bodies[i].ring:
            for h in m.fan(self.mesh.ring_edge[v]):
                angles.update(dict.fromkeys((h, m.following[h], h ^ 1)))
        vanishing = []
        for h in angles:
            zeros = self.certifier.zeros
            self._certify(h)
            if self.certifier.zeros > zeros:
                vanishing.append(h)
        return vanishing

    def _cancel_edge(self, h: int) -> None:
        """Forget the certificates of an edge that has been removed."""
        for g in (h, h ^ 1):
            self.queue.cancel(pack(ANGLE, g))
            self._due.discard(g)
            self._flat.discard(g)

    def _angle(self, h: int) -> tuple[int, int, int]:
        m = self.mesh.map
        return m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]

    def _vertices_of(self, h: int) -> tuple[Vertex, Vertex, Vertex]:
        a, p, b = self._angle(h)
        v = self.vertices.all
        return v[a], v[p], v[b]

    def _is_triangle(self, h: int) -> bool:
        m = self.mesh.map
        return m.following[m.following[m.following[h]]] == h

    def _straight_run(self, h: int) -> set[int]:
        """The vertices of an angle, and on along chains that are straight for ever."""
        m = self.mesh.map
        run = set(self._angle(h))
        for step in (m.following, m.previous):
            g = step[h]
            while g != h and self._is_flat(g):
                g = step[g]
                run.add(m.origin[g])
        return run

    def _has_flats(self, h: int) -> bool:
        """Whether a chain that is straight for ever may be next to an angle."""
        m = self.mesh.map
        return bool(self._flat) or self._is_flat(m.following[h]) or self._is_flat(m.previous[h])

    def _is_flat(self, h: int) -> bool:
        """Whether the angle of h is straight for ever; of one body it has no certificate."""
        a, p, b = self._angle(h)
        return h in self._flat or (
            a != b
            and self.certifier.rigid(a, p, b)
            and OneSided(self.certifier, before=False).sign(a, p, b) == 0
        )
