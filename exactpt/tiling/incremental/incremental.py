"""The kinetic incremental pseudo-triangulation of moving points (paper, section 3.2).

A queue holds when each of the 3n - 5 certificates of `exactpt.tiling.incremental.structure`
fails. What a failure changes is told in `exactpt.tiling.incremental.repairs`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import (
    POINT_MOTION,
    POINT_ORDER,
    pack_point,
    point_kind_of,
    point_of,
)
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError, InputError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.events import ContactFound, Stats, TilingEvent
from exactpt.tiling.incremental.chains import PATIENCE, ChainKind, Chains
from exactpt.tiling.incremental.contacts import coinciding
from exactpt.tiling.incremental.mesh import mesh_of
from exactpt.tiling.incremental.repairs import RepairedStructure
from exactpt.tiling.incremental.static import holds_at, sweep_at

__all__ = ["IncrementalTiling"]


@final
class IncrementalTiling(RepairedStructure):
    """The canonical tiling of points: at any time the one that the sweep builds."""

    name = "incremental"

    @classmethod
    def begin(
        cls,
        vertices: Vertices,
        start: QQ,
        end: QQ,
        *,
        exact_only: bool = False,
        chains: ChainKind = "auto",
        fan: bool = False,
    ) -> IncrementalTiling:
        """The tiling of points just after a time at which no two are in one place.

        Args:
            vertices: the points.
            start: the current time.
            end: the last time of interest.
            exact_only: decide everything by exact arithmetic.
            chains: see `Chains`.
            fan: count the changes of the fan triangulation too, in ``stats.fan``.
        """
        structure = sweep_at(PredicatesAt(vertices, start, exact_only=exact_only))
        certifier = Certifier(vertices, start, end, exact_only=exact_only)
        kept = Chains(chains, PATIENCE * len(vertices.all))
        self = cls(vertices, certifier, Stats(), structure, kept, fan=fan)
        self._certified.certify_everything()
        if any(self._certified.due):
            raise AuditError(f"violated at the start: {self._certified.due}")
        self.stats.most = len(self.queue)
        for p in range(len(vertices.all)):
            self._schedule_piece(p)
        return self

    @classmethod
    def vertices_of(cls, bodies: Sequence[Body], start: QQ, end: QQ) -> Vertices:
        """One vertex a point.

        Raises:
            InputError: if a body is no point.
        """
        for body in bodies:
            if body.size > 1:
                raise InputError(
                    f"body {body.name!r}: has {body.size} vertices: "
                    "the incremental tiling is for points"
                )
        return Vertices.of(bodies, start, end, plain=True)

    @classmethod
    def mesh_at(cls, instant: PredicatesAt) -> Mesh:
        """The incremental tiling of an instant."""
        return mesh_of(sweep_at(instant))

    def mesh_after(self) -> Mesh:
        """The tiling just after the current time; made anew after every event."""
        if self._mesh is None:
            self._mesh = mesh_of(self.structure)
        return self._mesh

    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event.

        Where certificates vanish at that very time, the tiling is the one that the sweep
        builds then.

        Raises:
            AuditError: if a certificate is violated at that time.
        """
        instant = PredicatesAt(self.vertices, time, after=False)
        structure = self.structure
        return mesh_of(structure if holds_at(structure, instant) else sweep_at(instant))

    def _schedule_piece(self, p: int) -> None:
        """Schedule the end of the current piece of a point's motion."""
        self._schedule_end(self.vertices.bodies[p], pack_point(POINT_MOTION, p))

    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """See `Tiling.change_plans`."""
        self._move_to(t)
        self._mesh = None
        for p in sorted(plans):
            self.vertices.set_plan(p, plans[p], t, self.certifier.end)
            self._schedule_piece(p)
            self._record("motion", (), ())
        for p in sorted(plans):
            self._certified.certify_point(p)
        self._settle()
        self.stats.most = max(self.stats.most, len(self.queue))
        return self._reported()

    # Events

    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        self._undo = self.certifier.now, entries
        self.certifier.move_to(time, [(t.a, t.b, t.c) for _, t in entries])
        self._mesh = None
        slots = [slot for slot, _ in entries]
        level = [point_of(slot) for slot in slots if point_kind_of(slot) == POINT_ORDER]
        if level and (touches := coinciding(self.certifier, self.structure, level)):
            raise ContactFound(touches)
        if len(slots) > 1:
            self.stats.batches += 1
        alone = len(slots) == 1 and time.crossing
        certified = self._certified
        for slot in slots:
            p, kind = point_of(slot), point_kind_of(slot)
            if kind == POINT_MOTION:
                self._change_motion(p)
            elif alone:
                certified.due[kind].add(p)
            elif kind == POINT_ORDER:
                certified.certify_order(p)
            else:
                certified.certify_edge(kind, p)
        self._settle()
        self.stats.most = max(self.stats.most, len(self.queue))
        if self.chains.kind == "auto":
            self._judge_chains()

    def _judge_chains(self) -> None:
        """Make chains searchable if they have turned out to be long."""
        upper, lower = self.structure.trees
        if self.chains.are_long(upper.steps + lower.steps):
            self.structure.make_searchable()

    def _change_motion(self, p: int) -> None:
        moving = self.vertices.bodies[p]
        if moving.until is None:
            raise AuditError(f"body {p} has no next piece")
        self.vertices.enter_piece(p, moving.until)
        self._schedule_piece(p)
        self._record("motion", (), ())
        self._certified.certify_point(p)
