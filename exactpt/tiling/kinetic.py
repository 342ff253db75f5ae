"""The kinetic tiling: certificates of all angles, a queue of their failures, the repairs.

Source: the paper, section 2.2, with the sub-cases of its update rules worked out. An
angle of a free face fails when its three vertices become collinear. A corner that closes
is collapsed; a bend that straightens gives one of its edges way. Either is one slide of
an edge along its neighbour (`exactpt.planar.halfedge`).

At one time, several certificates may fail. They are repaired one after the other, in the
order of their slots, each judged by its sign *just after* that time, until none is
violated. If all angles of the result are as they should be, it is an embedding: the
angles around every vertex add up to a positive multiple of 2 pi and, by Euler's formula,
to 2 pi on average. A repair that is not possible, or an endless round, is answered by
building the tiling anew.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final, Self

from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ, floor
from exactpt.kinetic.queue import EventTime
from exactpt.motion.vertices import Vertex, Vertices
from exactpt.tiling.audit import audit_fan
from exactpt.tiling.closing import close_at
from exactpt.tiling.contacts import touches
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.exact import comes_first
from exactpt.tiling.inside import tile_inside
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import OUTER, SOLID, Mesh
from exactpt.tiling.moment import Moment
from exactpt.tiling.placement import nearer, nearer_copy, strictly_between
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.tiling.certificates import Certifier
    from exactpt.tiling.events import Stats

__all__ = ["KineticTiling", "RebuildNeeded"]

ANGLE: Final = 0
CELL: Final = 1
EXTREME: Final = 2
MOTION: Final = 3
SHRINK: Final = 4
KINDS: Final = 16
"""A slot of the queue is ``KINDS * handle + kind``."""


class RebuildNeeded(Exception):  # noqa: N818 - a turn of the control flow, no error
    """The events of one time could not be repaired one by one."""


class KineticTiling(Tiling):
    """A pseudo-triangulation of the free space that is kept up to date as time goes on.

    This class keeps any pointed pseudo-triangulation (`exactpt.tiling.lazy`); the
    canonical ones refine its rules.

    Attributes:
        mesh: the tiling just after the current time.
    """

    name = "lazy"
    mesh: Mesh

    def __init__(self, vertices: Vertices, start: QQ, end: QQ, *, exact_only: bool = False) -> None:
        super().__init__(vertices, start, end, exact_only=exact_only)
        self._set_up(Mesh(0), ())
        self._build(start)
        self._certify_everything()
        if self._due:
            raise AuditError(f"violated at the start: {sorted(self._due)}")
        for i in range(len(vertices.bodies)):
            self._schedule_piece(i)

    def _set_up(self, mesh: Mesh, flat: Iterable[int]) -> None:
        """Nothing is violated, and nothing pending."""
        self.mesh = mesh
        self._flat: set[int] = set(flat)
        self._due: set[int] = set()
        self._touched: set[int] = set()
        self._careful: bool = False
        self._undo: tuple[EventTime, list[tuple[int, EventTime]]] | None = None
        self._clear_notes()

    def _clear_notes(self) -> None:
        """Forget what is noted during the repairs of one time."""

    @classmethod
    def restored(
        cls,
        certifier: Certifier,
        vertices: Vertices,
        mesh: Mesh,
        stats: Stats,
        flat: Iterable[int],
    ) -> Self:
        """A tiling that goes on between two events; what is pending is the caller's to schedule."""
        self = cls.__new__(cls)
        self._begin(vertices, certifier, stats)
        self._set_up(mesh, flat)
        self._recall()
        return self

    def _recall(self) -> None:
        """Find again what is known between two events and follows from the mesh."""

    @property
    def flat(self) -> set[int]:
        """The half-edges whose angles are known to be straight for ever."""
        return self._flat

    # Construction

    def _build(self, time: QQ) -> None:
        """Make the tiling that holds just after a rational time."""
        raise NotImplementedError

    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event."""
        mesh = self.mesh.copy()
        self._close(mesh, Instant(self.vertices, time, after=False))
        return mesh

    def _close(self, mesh: Mesh, instant: Instant) -> None:
        """Make a tiling just after an instant the one at the instant."""
        close_at(mesh, instant)

    def _certify_everything(self) -> None:
        self._flat.clear()
        for slot in self.queue.slots():
            if slot % KINDS not in (MOTION, SHRINK):
                self.queue.cancel(slot)
        watched = []
        for h in self.mesh.map.half_edges():
            if self.mesh.region[h] != SOLID:
                if self._cannot_fail(h):
                    self._certify(h)
                else:
                    watched.append(h)
        answers = self.certifier.orientations([self._angle(h) for h in watched])
        for h, (s, time) in zip(watched, answers, strict=True):
            self._due.discard(h)
            self._keep(h, s, time)
        self.stats.most = max(self.stats.most, len(self.queue))

    def _schedule_piece(self, i: int) -> None:
        """Schedule the end of a body's current piece, and the end of a segment by shrinking."""
        moving = self.vertices.bodies[i]
        if moving.body.size == 2 and moving.deforms:
            time = self.certifier.first_coincidence(moving.ring[0], moving.ring[2])
            slot = KINDS * i + SHRINK
            if time is None:
                self.queue.cancel(slot)
            else:
                self.queue.schedule(slot, time)
        slot = KINDS * i + MOTION
        if moving.until is None or moving.until > self.certifier.end:
            self.queue.cancel(slot)
            return
        low, high = self.vertices.frame.time(moving.until)
        exact = AlgebraicNumber(moving.until)
        self.queue.schedule(slot, EventTime(low, high, -1, -1, -1, exact))

    # Certificates

    def _certify(self, h: int) -> None:
        """Certify the angle of h; note it as due if it is violated just after now."""
        mesh = self.mesh
        self._due.discard(h)
        self._flat.discard(h)
        a, p, b = self._angle(h)
        if self._cannot_fail(h):
            self.certifier.skipped += 1
            self.queue.cancel(KINDS * h + ANGLE)
            # A rigid angle keeps its sign. One that is new may have the wrong mark only in
            # the midst of simultaneous events.
            if self._careful and mesh.region[h] != SOLID and self.certifier.rigid(a, p, b):
                after = Moment(self.certifier, before=False)
                if (after.sign(a, p, b) > 0) != mesh.corner[h]:
                    self._due.add(h)
            return
        self._keep(h, *self.certifier.orientation(a, p, b))

    def _cannot_fail(self, h: int) -> bool:
        """Whether the angle of h needs no certificate of its own."""
        a, p, b = self._angle(h)
        return (
            self.certifier.rigid(a, p, b)
            or self.mesh.region[h] == SOLID
            or a == b
            or self._is_copy(h)
        )

    def _keep(self, h: int, s: int, time: EventTime | None) -> None:
        """Schedule the failure of an angle; note it as due if it is violated just after now."""
        slot = KINDS * h + ANGLE
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

    def _recertify(self, slots: tuple[int, ...]) -> None:
        """Certify changed angles; of faces that are or were triangles, all angles."""
        m = self.mesh.map
        self._touched.update(slots)
        todo = dict.fromkeys(slots)
        for h in slots:
            if m.following[m.following[m.following[m.following[h]]]] == h or self._is_triangle(h):
                todo.update(dict.fromkeys(m.face(h)))
        for h in todo:
            self._certify(h)

    def _is_triangle(self, h: int) -> bool:
        m = self.mesh.map
        return m.following[m.following[m.following[h]]] == h

    # Time

    def retreat(self, grid: QQ) -> QQ:
        """After `ContactFound`: go back to a rational time just before the contact.

        Args:
            grid: the time is the last multiple of it before the contact; or, if an event
                is in between, a dyadic rational after that.

        Returns:
            The time. The tiling is the one that leads up to the contact.
        """
        if self._undo is None:
            raise AuditError("there is no contact to go back from")
        (time_before, entries), contact = self._undo, self.now
        before = time_before.exact or self.certifier.resolve(time_before)
        self._undo = None
        for slot, time in entries:
            self.queue.schedule(slot, time)
        contact.refine_to(grid)
        m = floor(contact.high / grid)
        while contact.compare_rational(m * grid) <= 0:
            m -= 1
        t = m * grid
        if before.compare_rational(t) >= 0:
            t = rational_between(before, contact)
        self._move_to(t)
        return t

    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """Let bodies go on by other plans; work for their certificates alone.

        Args:
            plans: by the number of the body, what it is from now on. Its positions now are
                those that it has.
            t: now.

        Returns:
            What changes at once.
        """
        self._move_to(t)
        self._due.clear()
        self._touched.clear()
        self._careful = True
        try:
            for i in sorted(plans):
                if self.vertices.set_plan(i, plans[i], t, self.certifier.end):
                    first = self.mesh.ring_edge[self.vertices.bodies[i].ring[0]]
                    tile_inside(self.mesh, first, Moment(self.certifier, before=False))
                self._schedule_piece(i)
                self._record("motion", (), ())
            angles = [h for i in sorted(plans) for h in self._certify_body(i)]
            self._recheck([])
            self._certify_again(angles)
            self._settle()
        except RebuildNeeded:
            self._rebuild()
        self._careful = False
        self.stats.most = max(self.stats.most, len(self.queue))
        return self._reported()

    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        """Let all events of one time happen."""
        self._due.clear()
        self._undo = self.certifier.now, entries
        self.certifier.move_to(time, [(t.a, t.b, t.c) for _, t in entries])
        slots = [slot for slot, _ in entries]
        self._touched.clear()
        try:
            h, kind = divmod(slots[0], KINDS)
            if len(slots) == 1 and kind == ANGLE and time.crossing and not self._has_flats(h):
                if self._may_touch(h):
                    self._report_touches(self._angle(h))
                self._due.add(h)
            else:
                self._careful = True
                self.stats.batches += len(slots) > 1
                self._begin_batch(slots)
            self._settle()
        except RebuildNeeded:
            self._rebuild()
        self._careful = False
        self.stats.most = max(self.stats.most, len(self.queue))

    def _begin_batch(self, slots: list[int]) -> None:
        """Note what is violated just after now; report a contact if there is one."""
        angles = [slot // KINDS for slot in slots if slot % KINDS == ANGLE]
        shrinking = [slot // KINDS for slot in slots if slot % KINDS == SHRINK]
        moving = [slot // KINDS for slot in slots if slot % KINDS == MOTION]
        # Before anything is changed, so that `retreat` finds everything as it was.
        self._look_for_contact(angles, shrinking)
        if moving:
            self._undo = None
            changed = [h for i in moving for h in self._change_motion(i)]
            self._look_for_contact(changed, ())
            angles += changed
        self._recheck([slot for slot in slots if slot % KINDS not in (ANGLE, MOTION, SHRINK)])
        self._certify_again(angles)

    def _look_for_contact(self, angles: Iterable[int], shrinking: Iterable[int]) -> None:
        """Report what touches now near angles that vanish, and segments that shrink."""
        candidates: set[int] = set()
        for h in angles:
            candidates.update(self._straight_run(h))
        for i in shrinking:
            candidates.update(self.vertices.bodies[i].ring)
        if candidates:
            self._report_touches(candidates)

    def _certify_again(self, angles: Iterable[int]) -> None:
        for h in angles:
            if self.mesh.map.origin[h] >= 0:
                self._certify(h)

    def _recheck(self, slots: list[int]) -> None:
        """Look again at certificates that are none of angles; what comes before these is done."""
        if slots:
            raise AuditError(f"unknown slots {slots}")

    def _change_motion(self, i: int) -> list[int]:
        """Let a body enter its next piece; the angles that vanish now."""
        moving = self.vertices.bodies[i]
        if moving.until is None:
            raise AuditError(f"body {i} has no next piece")
        changes = moving.until in moving.body.breakpoints  # else only its offsets do
        self.vertices.enter_piece(i, moving.until)
        self._schedule_piece(i)
        if changes:
            self._record("motion", (), ())
        return self._certify_body(i)

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

    # Contacts

    def _angle(self, h: int) -> tuple[int, int, int]:
        m = self.mesh.map
        return m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]

    def _may_touch(self, h: int) -> bool:
        """Whether the vanishing of one angle alone may be a contact.

        A corner that closes on a body edge is one; so are vertices that coincide, and a
        bend that folds up instead of straightening (a spike of a deforming body).
        """
        if self._is_triangle(h):
            return True
        a, p, b = (self.vertices.all[v] for v in self._angle(h))
        if self.mesh.corner[h]:
            side = nearer(self.certifier, p, a, b)
            far = h if side > 0 else self.mesh.map.previous[h]
            return side == 0 or self.mesh.is_boundary(far)
        if self.mesh.is_boundary(h) and self.mesh.is_boundary(self.mesh.map.previous[h]):
            return True  # of a deforming body; its other vertices may be on the line too
        return not strictly_between(self.certifier, a, p, b)

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
            and Moment(self.certifier, before=False).sign(a, p, b) == 0
        )

    def _report_touches(self, candidates: Iterable[int]) -> None:
        found = touches(self.certifier, self.vertices, candidates)
        if found:
            raise ContactFound(found)

    # Repairs

    def _settle(self) -> None:
        """Repair until nothing is violated just after now.

        Raises:
            RebuildNeeded: if that does not end in a pseudo-triangulation.
        """
        rounds = 0
        while self._due or self._has_more():
            rounds += 1
            if rounds > 64 + 4 * len(self.queue):
                raise RebuildNeeded
            if self._due:
                self._repair(self._first_due())
            else:
                self._repair_more()
        if rounds > 1:
            self._check_batch(sorted(self._touched))

    def _first_due(self) -> int:
        """The violated angle to be mended first: copies of one triple in perturbed order."""
        first, *others = sorted(self._due)
        for h in others:
            p, q = self._vertices_of(h), self._vertices_of(first)
            if {(v.body, v.index) for v in p} == {(v.body, v.index) for v in q}:
                signs = (-1 if self.mesh.corner[g] else 1 for g in (h, first))
                if comes_first(p, next(signs), q, next(signs), self.now):
                    first = h
        return first

    def _vertices_of(self, h: int) -> tuple[Vertex, Vertex, Vertex]:
        a, p, b = self._angle(h)
        v = self.vertices.all
        return v[a], v[p], v[b]

    def _check_batch(self, touched: list[int]) -> None:
        """Check what several repairs at one time have left: corners, order around vertices.

        Raises:
            RebuildNeeded: if it is no pseudo-triangulation.
        """
        m = self.mesh.map
        after = Moment(self.certifier, before=False)
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
        self._recertify((first, second, after) if len(across) > 3 else tuple(mesh.map.face(first)))

    def _cancel_edge(self, h: int) -> None:
        """Forget the certificates of an edge that has been removed."""
        for g in (h, h ^ 1):
            self.queue.cancel(KINDS * g + ANGLE)
            self._due.discard(g)
            self._flat.discard(g)

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
        self._recertify((e, m.following[e], e ^ 1, h, m.previous[h]))

    def _slid(
        self, h: int, before: int, kind: str, ends: tuple[int, int, int], *, origin_moves: bool
    ) -> None:
        """Certify the angles that a slide has changed: two in one face, three across."""
        m = self.mesh.map
        old, fixed, new = ends
        self._record(kind, ((old, fixed),), ((new, fixed),))
        if origin_moves:
            changed = (h, m.following[h], h ^ 1, before, m.following[before])
        else:
            t = before ^ 1
            changed = (before, m.following[before], h, t, m.following[t])
        self._recertify(changed)

    def _record(
        self,
        kind: str,
        removed: tuple[tuple[int, int], ...],
        added: tuple[tuple[int, int], ...],
    ) -> None:
        """Note a change; one between copies of a thin vertex is none for the outside."""
        if removed and self._scene_edges(removed) == self._scene_edges(added):
            self.stats.count("internal")
            return
        self.stats.count(kind)
        self._events.append(TilingEvent(self.certifier.now, kind, removed, added))

    def _scene_edges(self, edges: tuple[tuple[int, int], ...]) -> set[frozenset[tuple[int, int]]]:
        v = self.vertices.all
        return {frozenset((v[i].body, v[i].index) for i in edge) for edge in edges}

    def _rebuild(self) -> None:
        """Build the tiling that holds from now on, and certify all of it.

        A rational time is tried, and accepted if the tiling built there is valid just
        after now and no certificate of it fails in between; else one nearer to now.
        """
        self.stats.rebuilds += 1
        before = {self._edge_key(h) for h in self.mesh.diagonals()}
        now = self.certifier.exact_now
        following = self.next_time()
        later = self.certifier.end
        if following is not None:
            number = following.exact or self.certifier.resolve(following)
            if number.compare_rational(later) < 0:
                later = rational_between(now, number)
        if now.compare_rational(later) >= 0:
            return
        while True:
            later = rational_between(now, AlgebraicNumber(later))
            self._due.clear()
            try:
                self._build(later)
                self._certify_everything()
            except (AuditError, RebuildNeeded):
                continue  # bodies overlap there, or the tiling was another one before
            following = self.next_time()
            if (
                not self._due
                and not self._has_more()
                and (
                    following is None
                    or (following.exact or self.certifier.resolve(following)).compare_rational(
                        later
                    )
                    > 0
                )
            ):
                break
        after = {self._edge_key(h) for h in self.mesh.diagonals()}
        self._record("reflex", tuple(sorted(before - after)), tuple(sorted(after - before)))

    def _edge_key(self, h: int) -> tuple[int, int]:
        u, v = self.mesh.ends(h)
        return (u, v) if u < v else (v, u)
