"""The kinetic incremental pseudo-triangulation of moving points (paper, section 3.2).

A queue holds when each of the 3n - 5 certificates of `exactpt.tiling.incremental.structure`
fails. What a failure changes is told in `exactpt.tiling.incremental.repairs`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import (
    POINT_MOTION,
    POINT_ORDER,
    pack_point,
    point_kind_of,
    point_of,
)
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.incremental.chains import Chains
from exactpt.tiling.incremental.contacts import coinciding
from exactpt.tiling.incremental.mesh import mesh_of
from exactpt.tiling.incremental.repairs import RepairedStructure
from exactpt.tiling.incremental.static import holds_at, sweep_at
from exactpt.tiling.incremental.structure import IncrementalStructure
from exactpt.tiling.tiling import State

__all__ = ["IncrementalTiling"]


@final
class IncrementalTiling(RepairedStructure):
    """The canonical tiling of points: at any time the one that the sweep builds.

    It has the interface of the engine, not the engine: what it keeps and repairs are two
    trees, of which the mesh is read off when it is asked for, so that there are no
    certified angles of a mesh that rules could add to.
    """

    def begin(self, start: QQ) -> None:
        """See `Tiling.begin`."""
        exact_only = self.certifier.exact_only
        self._keep(sweep_at(PredicatesAt(self.vertices, start, exact_only=exact_only)))
        self._certified.certify_everything()
        if any(self._certified.due):
            raise AuditError(f"violated at the start: {self._certified.due}")
        self.stats.most = len(self.queue)
        for p in range(len(self.vertices.all)):
            self._schedule_piece(p)

    def state(self) -> State:
        """The trees, and how chains are kept."""
        structure, chains = self.structure, self.chains
        return {"structure": structure.state(), "chains": [chains.kind, chains.allowed]}

    def resume(self, state: State) -> None:
        """See `Tiling.resume`."""
        self.chains = Chains(*state["chains"])
        self._keep(IncrementalStructure.resumed(state["structure"]))

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """The incremental tiling of an instant."""
        return mesh_of(sweep_at(instant))

    def mesh_at(self, instant: PredicatesAt) -> Mesh:
        """See `Tiling.mesh_at`."""
        return self.build(instant)

    def audit(self, mesh: Mesh, instant: PredicatesAt) -> None:  # noqa: ARG002
        """See `Tiling.audit`; its points have no rings, around which angles are checked."""
        mesh.audit()

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
        end = self.clock.end_of_piece(self.vertices.bodies[p])
        self.table.schedule(pack_point(POINT_MOTION, p), end)

    def add_body(self, body: Body, t: QQ) -> None:
        """See `Tiling.add_body`: the structure is swept anew."""

    def remove_body(self, i: int, t: QQ) -> None:
        """See `Tiling.remove_body`: the structure is swept anew."""

    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """See `Tiling.change_plans`."""
        self.clock.move_to(t)
        self._mesh = None
        for p in sorted(plans):
            self.vertices.set_plan(p, plans[p], t, self.certifier.end)
            self._schedule_piece(p)
            self.log.record("motion", (), ())
        for p in sorted(plans):
            self._certified.certify_point(p)
        self._settle()
        self.stats.most = max(self.stats.most, len(self.queue))
        return self.log.take()

    # Events

    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        self.clock.enter(time, entries)
        self._mesh = None
        failed = [certificate for certificate, _ in entries]
        level = [
            point_of(certificate)
            for certificate in failed
            if point_kind_of(certificate) == POINT_ORDER
        ]
        if level and (touches := coinciding(self.certifier, self.structure, level)):
            raise ContactFound(touches)
        if len(failed) > 1:
            self.stats.batches += 1
        alone = len(failed) == 1 and time.crossing
        certified = self._certified
        for certificate in failed:
            p, kind = point_of(certificate), point_kind_of(certificate)
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
        self.log.record("motion", (), ())
        self._certified.certify_point(p)
