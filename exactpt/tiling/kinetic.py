"""The kinetic tiling: what happens at the time of an event, contacts, new plans.

A repair that is not possible, or an endless round of them, is answered by building the
tiling anew.

Source: the paper, section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final, Self

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import ANGLE, MOTION, SHRINK, kind_of, pack, part_of
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.coincidence import nearer, strictly_between
from exactpt.certificates.incidences import touches
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.motion.vertices import MovingBody, Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.inside import tile_inside
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.events import ContactFound, Stats, TilingEvent
from exactpt.tiling.repairs import RebuildNeeded, RepairedTiling

if TYPE_CHECKING:
    from exactpt.motion.body import Body

__all__ = ["KineticTiling"]

MOST_TRIES: Final = 15
"""How often a tiling is built anew before that is given up: 2^-(2^k) nearer at try k."""


class KineticTiling(RepairedTiling):
    """A pseudo-triangulation of the free space that is kept up to date as time goes on.

    This class keeps any pointed pseudo-triangulation (`exactpt.tiling.lazy`); the
    canonical ones refine its rules.

    Attributes:
        mesh: the tiling just after the current time.
    """

    name = "lazy"

    @classmethod
    def begin(cls, vertices: Vertices, start: QQ, end: QQ, *, exact_only: bool = False) -> Self:
        """The tiling just after a time at which the bodies are disjoint."""
        self = cls(vertices, Certifier(vertices, start, end, exact_only=exact_only), Stats())
        self._build(start)
        self._certify_everything()
        if self._due:
            raise AuditError(f"violated at the start: {sorted(self._due)}")
        for i in range(len(vertices.bodies)):
            self._schedule_piece(i)
        return self

    def resume(self, mesh: Mesh, flat: Iterable[int]) -> None:
        """Go on with a mesh between two events; what is pending is the caller's to schedule."""
        self.mesh = mesh
        self._flat = set(flat)
        self._recall()

    def _recall(self) -> None:
        """Find again what is known between two events and follows from the mesh."""

    def _build(self, time: QQ) -> None:
        """Make the tiling that holds just after a rational time."""
        self.mesh = self.mesh_at(
            PredicatesAt(self.vertices, time, exact_only=self.certifier.exact_only)
        )

    def _schedule_piece(self, i: int) -> None:
        """Schedule when a body's current piece ends, and when the body loses its inside.

        That may be so of a segment that shrinks to a point, and a triangle that becomes
        flat: the only bodies that deform so and whose inside is not tiled.
        """
        moving = self.vertices.bodies[i]
        slot = pack(SHRINK, i)
        time = self._collapse(moving) if moving.deforms else None
        if time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)
        self._schedule_end(moving, pack(MOTION, i))

    def _collapse(self, moving: MovingBody) -> EventTime | None:
        if moving.body.size == 2:
            return self.certifier.first_coincidence(moving.ring[0], moving.ring[2])
        if moving.body.size == 3 and moving.body.closed:
            return self.certifier.orientation(*moving.ring)[1]
        return None

    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """See `Tiling.change_plans`."""
        self._move_to(t)
        self._due.clear()
        self._batch.clear()
        self._batch.has_new_motions = self._careful = True
        try:
            for i in sorted(plans):
                if self.vertices.set_plan(i, plans[i], t, self.certifier.end):
                    first = self.mesh.ring_edge[self.vertices.bodies[i].ring[0]]
                    tile_inside(self.mesh, first, OneSided(self.certifier, before=False))
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
        self._batch.clear()
        try:
            h = part_of(slots[0])
            is_angle = len(slots) == 1 and kind_of(slots[0]) == ANGLE
            if is_angle and time.crossing and not self._has_flats(h):
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
        angles = [part_of(slot) for slot in slots if kind_of(slot) == ANGLE]
        shrinking = [part_of(slot) for slot in slots if kind_of(slot) == SHRINK]
        moving = [part_of(slot) for slot in slots if kind_of(slot) == MOTION]
        # Before anything is changed, so that `retreat` finds everything as it was. What
        # vanishes at the end of a piece has an event then, so that one look finds all.
        self._look_for_contact(angles, shrinking)
        if moving:
            self._batch.has_new_motions = True
            self._undo = None
            angles += [h for i in moving for h in self._change_motion(i)]
        self._recheck([slot for slot in slots if kind_of(slot) not in (ANGLE, MOTION, SHRINK)])
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
        changes = moving.until in moving.body._breakpoints  # else only its offsets do
        self.vertices.enter_piece(i, moving.until)
        self._schedule_piece(i)
        if changes:
            self._record("motion", (), ())
        return self._certify_body(i)

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

    def _report_touches(self, candidates: Iterable[int]) -> None:
        found = touches(self.certifier, self.vertices, candidates)
        if found:
            raise ContactFound(found)

    def _rebuild(self) -> None:
        """Build the tiling that holds from now on, and certify all of it.

        A rational time is tried, and accepted if the tiling built there is valid just
        after now and no certificate of it fails in between; else one nearer to now.

        Raises:
            AuditError: if none is found: a contact now has been missed.
        """
        self.stats.rebuilds += 1
        before = {edge_key(*self.mesh.ends(h)) for h in self.mesh.diagonals()}
        now, following = self.now, self.next_number()
        later = self.certifier.end
        if now.compare_rational(later) >= 0:
            later = rational_between(now, AlgebraicNumber(later + 1))  # plans run on as they are
        elif following is not None and following.compare_rational(later) < 0:
            later = rational_between(now, following)
        for k in range(MOST_TRIES):
            width = (later - now._low) * power_of_two(-(1 << k))
            now.refine_to(width / 2)
            if self._build_anew(rational_between(now, AlgebraicNumber(now._high + width / 2))):
                break
        else:
            raise AuditError(f"no tiling holds just after t = {float(now)!r}")
        after = {edge_key(*self.mesh.ends(h)) for h in self.mesh.diagonals()}
        self._record("reflex", tuple(sorted(before - after)), tuple(sorted(after - before)))

    def _build_anew(self, later: QQ) -> bool:
        """Build and certify the tiling of a later time; whether it has held since now."""
        self._due.clear()
        try:
            self._build(later)
            self._certify_everything()
        except (AuditError, RebuildNeeded):
            return False  # bodies overlap there, or the tiling was another one before
        following = self.next_number()
        return not (self._due or self._has_more()) and (
            following is None or following.compare_rational(later) > 0
        )
