"""The engine: maintains a pseudo-triangulation over time, by the rules of one tiling.

It is composed of a clock, the table of certificates, a mesh with certified angles, the
repairs, and the rules. At the time of an event it looks for contacts, begins new pieces of
motion, and repairs. If a repair is not possible, or the repair loop does not end, it
rebuilds the tiling.

Source: the paper, section 2.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import ANGLE, MOTION, SHRINK, kind_of, pack, part_of
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, Ends, HalfEdge
from exactpt.kernel.numbers import QQ
from exactpt.kernel.stored import Stored
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.audit import audit_angles, audit_connected
from exactpt.pseudotriangulation.conflict_zone import find_conflict_zone
from exactpt.pseudotriangulation.inside import tile_inside
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.events import Stats, TilingEvent
from exactpt.tiling.isolated import LEFT, OPEN, IsolatedEvents
from exactpt.tiling.pieces import certify_piece
from exactpt.tiling.population import add_ring, remove_ring
from exactpt.tiling.repairs import RebuildNeeded, Repairs
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State, Tiling
from exactpt.tiling.touching import look_for_contact, may_touch, report_touches

if TYPE_CHECKING:
    from exactpt.motion.body import Body


@final
class Engine(Tiling):
    """A pointed pseudo-triangulation of the free space, maintained by the rules of one tiling.

    Attributes:
        certified: the mesh just after the current time, with the certificates of its angles.
        rules: the rules of the tiling.
        repairs: the repairs of violated certificates.
    """

    def __init__(
        self,
        entry: Entry,
        rules: type[Rules],
        vertices: Vertices,
        certifier: Certifier,
        stats: Stats,
    ) -> None:
        super().__init__(entry, vertices, certifier, stats)
        self.certified: CertifiedMesh = CertifiedMesh(vertices, certifier, self.table)
        self.rules: Rules = rules(self.certified, self.log)
        self.certified.followers = self.rules
        self.repairs: Repairs = Repairs(self.certified, self.rules, self.log)
        self._isolated: IsolatedEvents | None = None
        if rules.slides_are_plain and not certifier.exact_only:
            self._isolated = IsolatedEvents(
                self.certified, self.queue, self.clock, self.log, self.rules
            )

    # Building

    def begin(self, start: QQ) -> None:
        """See `Tiling.begin`."""
        self._build(start)
        if self.table.angles:
            raise AuditError(f"violated at the start: {sorted(self.table.angles)}")
        for i, moving in enumerate(self.vertices.bodies):
            certify_piece(self.clock, moving, i)

    def _build(self, time: QQ) -> None:
        """Build and certify the tiling that holds just after a rational time."""
        exact_only = self.certifier.exact_only
        instant = PredicatesAt(self.vertices, time, exact_only=exact_only)
        self.certified.mesh = self.rules.begin(instant)
        self.stats.most = max(self.stats.most, self.certified.certify_everything())

    def state(self) -> State:
        """Return the flat angles, the mesh, and the data of the rules."""
        flat = sorted(self.table.flat)
        return {"flat": flat, "mesh": self.mesh.state(), **self.rules.state()}

    def resume(self, state: Stored) -> None:
        """See `Tiling.resume`."""
        mesh = self.rules.empty_mesh(self.vertices)
        mesh.resume(state["mesh"], len(self.vertices.all))
        mesh.audit()
        self._audit_rings(mesh)
        self.certified.mesh = mesh
        for item in state["flat"].entries():
            h = HalfEdge(item.integer(0))
            if not mesh.map.is_used(h):
                raise item.refused("a half-edge in use")
            self.table.flat.add(h)
        self.rules.resume(state.members_by_key())

    def _audit_rings(self, mesh: Mesh) -> None:
        """Check that the edges of bodies in a mesh that was read are those of the vertices.

        Raises:
            AuditError: if an edge is missing, or leads elsewhere.
        """
        vertices = self.vertices
        for v in vertices.ids():
            h = mesh.ring_edge[v]
            if not (mesh.map.is_used(h) and mesh.boundary[h >> 1]):
                raise AuditError(f"vertex {v} has no edge to the next one on its ring")
            if mesh.ends(h) != (v, vertices.ahead(v)):
                raise AuditError(f"the edge of vertex {v} on its ring leads elsewhere")

    def has_part(self, certificate: CertificateId) -> bool:
        """See `Tiling.has_part`."""
        kind, part = kind_of(certificate), part_of(certificate)
        if kind == ANGLE:
            return self.mesh.map.is_used(HalfEdge(part))
        if kind in (MOTION, SHRINK):
            return part < len(self.vertices.bodies)
        return self.rules.has_part(kind, part)

    # The tiling

    @property
    def mesh(self) -> Mesh:
        """The tiling just after the current time."""
        return self.certified.mesh

    def mesh_after(self) -> Mesh:
        """Return the tiling just after the current time: not a copy."""
        return self.certified.mesh

    def mesh_at(self, instant: PredicatesAt) -> Mesh:
        """See `Tiling.mesh_at`."""
        return type(self.rules).build(instant)

    def mesh_now(self, time: QQ) -> Mesh:
        """Return the tiling at a rational time: the current one, or one before the next event.

        It is the current tiling with closed corners collapsed (`Rules.close`); if these
        cannot be collapsed one by one, it is built from scratch.
        """
        mesh = self.mesh.copy()
        instant = PredicatesAt(self.vertices, time, after=False)
        try:
            self.rules.close(mesh, instant)
        except AuditError:
            mesh = type(self.rules).build(instant)
            audit_angles(mesh, instant)
        return mesh

    def audit(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """See `Tiling.audit`."""
        audit_angles(mesh, instant)

    def audit_structure(self, instant: PredicatesAt) -> None:
        """See `Tiling.audit_structure`."""
        self.rules.audit(instant)

    # Events

    def _process(self, time: EventTime, entries: list[tuple[CertificateId, EventTime]]) -> None:
        """See `Tiling._process`."""
        certified, first = self.certified, entries[0][0]
        self.table.angles.clear()
        self.clock.enter(time, entries)
        certified.failure_group.clear()
        is_alone = len(entries) == 1 and time.crossing and kind_of(first) == ANGLE
        try:
            h = HalfEdge(part_of(first))
            if is_alone and not certified.has_flats(h):
                if may_touch(certified, h):
                    report_touches(certified, certified.angle(h))
                self.table.angles.add(h)
            else:
                certified.checks_rigid = True
                self.stats.batches += len(entries) > 1
                self._begin_batch([certificate for certificate, _ in entries])
        except RebuildNeeded:
            self._rebuild()
        else:
            self._repair()
        self._end_batch()

    def _repair(self) -> None:
        """Repair whatever is violated, if need be by building the tiling again."""
        try:
            self.repairs.repair_all()
        except RebuildNeeded:
            self._rebuild()

    def _step(self, until: QQ) -> bool:
        """See `Tiling._step`."""
        if self._isolated is not None:
            outcome = self._isolated.step(self.clock.low_of(until))
            if outcome != LEFT:
                if outcome == OPEN:
                    self._repair()
                    self._end_batch()
                self.contact_free_until = self.certifier.now
                return True
        return super()._step(until)

    def _end_batch(self) -> None:
        self.certified.checks_rigid = False
        self.stats.most = max(self.stats.most, len(self.table.pending))

    def _begin_batch(self, failed: list[CertificateId]) -> None:
        """Record the certificates that are violated just after now.

        Raises:
            ContactFound: if there is a contact now.
        """
        certified = self.certified
        angles = [HalfEdge(part_of(c)) for c in failed if kind_of(c) == ANGLE]
        moving = [part_of(c) for c in failed if kind_of(c) == MOTION]
        # Contacts come first, while nothing has changed, so that `retreat` is possible. An angle
        # that vanishes at the end of a piece has an event of its own now, so none is missed.
        shrinking = [part_of(c) for c in failed if kind_of(c) == SHRINK]
        look_for_contact(certified, angles, shrinking)
        if moving:
            certified.failure_group.has_new_motions = True
            self.clock.forbid_retreat()
            angles += [h for i in moving for h in self._change_motion(i)]
        self.rules.failed([c for c in failed if kind_of(c) not in (ANGLE, MOTION, SHRINK)])
        certified.certify_again(angles)

    def _change_motion(self, i: int) -> list[HalfEdge]:
        """Begin a body's next piece of motion; returns the angles that vanish now."""
        moving = self.vertices.bodies[i]
        if moving.until is None:
            raise AuditError(f"body {i} has no next piece")
        changes = moving.body.exact_is_breakpoint(
            moving.until
        )  # otherwise only the directions of its infinitesimal displacements do
        self.vertices.enter_piece(i, moving.until)
        certify_piece(self.clock, moving, i)
        if changes:
            self.log.record("motion", (), ())
        return self.certified.certify_body(i)

    # Changes of motions, insertion and removal of bodies

    def change_motions(self, bodies: Mapping[int, Body], t: QQ) -> list[TilingEvent] | None:
        """See `Tiling.change_motions`."""
        if not all(self.rules.allows_plan(body, t) for body in bodies.values()):
            return None
        if any(self.vertices.begins_inside(i, body, t) for i, body in bodies.items()):
            return None  # `tile_inside` is for one ring
        certified = self.certified
        self._begin_change(t)
        certified.failure_group.has_new_motions = True
        try:
            for i in sorted(bodies):
                if self.vertices.set_motion(i, bodies[i], t, self.certifier.end):
                    first = self.mesh.ring_edge[self.vertices.bodies[i].ring[0]]
                    tile_inside(self.mesh, first, certified.after())
                certify_piece(self.clock, self.vertices.bodies[i], i)
                self.log.record("motion", (), ())
            angles = [h for i in sorted(bodies) for h in certified.certify_body(i)]
            self.rules.failed([])
            certified.certify_again(angles)
            self.repairs.repair_all()
        except RebuildNeeded:
            self._rebuild()
        self._end_batch()
        return self.log.take()

    def add_body(self, body: Body, t: QQ) -> list[TilingEvent] | None:
        """See `Tiling.add_body`."""
        if not self.rules.allows_body(body, t):
            return None
        zone = find_conflict_zone(self.vertices, self.mesh, body, t)
        if zone is None:
            return None
        self._begin_change(t)
        i = self.vertices.add(body, t)
        certify_piece(self.clock, self.vertices.bodies[i], i)
        return self._end_change(
            was_possible=add_ring(self.certified, self.rules, self.log, i, zone)
        )

    def remove_body(self, i: int, t: QQ) -> list[TilingEvent] | None:
        """See `Tiling.remove_body`."""
        self._begin_change(t)
        was_possible = remove_ring(self.certified, self.rules, self.log, i)
        last = len(self.vertices.bodies) - 1
        for kind in (MOTION, SHRINK):
            self.table.move(pack(kind, last), pack(kind, i))
        self.vertices.remove(i)
        return self._end_change(was_possible=was_possible)

    def _begin_change(self, t: QQ) -> None:
        """Move to a rational time, at which nothing is violated, to change the tiling there."""
        self.clock.move_to(t)
        self.table.angles.clear()
        self.certified.failure_group.clear()
        self.certified.checks_rigid = True

    def _end_change(self, *, was_possible: bool) -> list[TilingEvent]:
        """Repair after a local change; rebuild the tiling if the change was not possible."""
        try:
            if not was_possible:
                raise RebuildNeeded
            self.repairs.repair_all()
            self.repairs.check_batch()
        except RebuildNeeded:
            self._rebuild()
        self._end_batch()
        return self.log.take()

    # Rebuilding

    def _rebuild(self) -> None:
        """Build and certify the tiling that holds just after now.

        It is built at a rational time later than now, and accepted if none of its certificates
        fails in between; otherwise at times nearer and nearer to now.

        Raises:
            AuditError: if no attempt succeeds; then a contact at this time has been missed.
        """
        self.stats.rebuilds += 1
        before = self._diagonals()
        if not any(self._build_anew(later) for later in self.clock.times_just_after()):
            raise AuditError(f"no tiling holds just after t = {float(self.now)!r}")
        after = self._diagonals()
        self.log.record("reflex", tuple(sorted(before - after)), tuple(sorted(after - before)))

    def _diagonals(self) -> set[Ends]:
        return {edge_key(*self.mesh.ends(h)) for h in self.mesh.diagonals()}

    def _build_anew(self, later: QQ) -> bool:
        """Build and certify the tiling of a later time; returns whether it has held since now."""
        self.table.angles.clear()
        try:
            self._build(later)
            audit_connected(self.mesh, self.vertices)
        except (AuditError, RebuildNeeded):
            return False  # bodies overlap there, or the tiling differs before
        following = self.next_number()
        return not (self.table.angles or self.rules.is_violated()) and (
            following is None or following.compare_rational(later) > 0
        )
