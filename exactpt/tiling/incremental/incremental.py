"""The kinetic incremental pseudo-triangulation of moving points (paper, section 3.2).

The 3n - 5 certificates are those of `exactpt.tiling.incremental.structure`; the changes at
their failures are those of `exactpt.tiling.incremental.tree_repairs`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast, final, get_args

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
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, VertexId
from exactpt.kernel.numbers import QQ
from exactpt.kernel.stored import Stored
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.events import ContactFound, Stats, TilingEvent
from exactpt.tiling.incremental.certified_trees import CertifiedTrees
from exactpt.tiling.incremental.chains import PATIENCE, ChainKind, Chains
from exactpt.tiling.incremental.contacts import coinciding
from exactpt.tiling.incremental.fan import Fan
from exactpt.tiling.incremental.mesh import mesh_of, update_mesh
from exactpt.tiling.incremental.static import holds_at, sweep_at
from exactpt.tiling.incremental.structure import IncrementalStructure
from exactpt.tiling.incremental.tree_repairs import TreeRepairs
from exactpt.tiling.tiling import State, Tiling


@final
class IncrementalTiling(Tiling):
    """The canonical tiling of points: at any time the one built by the sweep.

    It does not use the engine: it maintains two trees instead of a mesh with certified angles,
    and derives the mesh from them on demand.

    Args:
        entry: its line in the catalogue.
        vertices: the points.
        certifier: certificates and the current time.
        stats: the counts of the run.
        chains: the representation of chains; see `Chains`.
        fan: whether the fan triangulation is maintained.

    Attributes:
        chains: the current representation of chains.
    """

    def __init__(
        self,
        entry: Entry,
        vertices: Vertices,
        certifier: Certifier,
        stats: Stats,
        *,
        chains: ChainKind = "auto",
        fan: bool = False,
    ) -> None:
        super().__init__(entry, vertices, certifier, stats)
        self.chains: Chains = Chains(chains, PATIENCE * len(vertices.all))
        none = IncrementalStructure.of([], ([], []))
        self._certified: CertifiedTrees = CertifiedTrees(none, certifier, self.table)
        self.fan = Fan() if fan else None
        self._repairs: TreeRepairs = TreeRepairs(
            self._certified, certifier, self.log, self.chains, self.fan
        )
        self._mesh: Mesh | None = None
        self._is_current: bool = False

    def begin(self, start: QQ) -> None:
        """See `Tiling.begin`."""
        exact_only = self.certifier.exact_only
        self._replace(sweep_at(PredicatesAt(self.vertices, start, exact_only=exact_only)))
        self._certified.certify_everything()
        if any(self._certified.violated):
            raise AuditError(f"violated at the start: {self._certified.violated}")
        self.stats.most = len(self.queue)
        for p in map(VertexId, range(len(self.vertices.all))):
            self._schedule_piece(p)

    def _replace(self, structure: IncrementalStructure) -> None:
        """Set the structure, without certificates."""
        if self.chains.kind == "searchable":
            structure.make_searchable()
        self._certified.now = structure
        if self.fan is not None:
            self.fan.begin(structure)

    @property
    def structure(self) -> IncrementalStructure:
        """The tiling just after the current time, as trees."""
        return self._certified.now

    def state(self) -> State:
        """Return the trees, the representation of chains, and the count of the fan's changes."""
        chains = self.chains
        state: State = {
            "structure": self.structure.state(),
            "chains": [chains.kind, chains.allowed],
        }
        if self.fan is not None:
            state["fan"] = self.fan.changes
        return state

    def resume(self, state: Stored) -> None:
        """See `Tiling.resume`."""
        kind, allowed = state["chains"].entries(2)
        self.chains.kind = cast("ChainKind", kind.text(get_args(ChainKind)))
        self.chains.allowed = allowed.integer(0)
        count = len(self.vertices.all)
        self._replace(IncrementalStructure.resumed(state["structure"], count))
        if self.fan is not None:
            self.fan.changes = state["fan"].integer(0)

    def has_part(self, certificate: CertificateId) -> bool:
        """See `Tiling.has_part`."""
        return point_of(certificate) < len(self.vertices.all)

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return the incremental tiling of an instant."""
        return mesh_of(sweep_at(instant))

    def mesh_at(self, instant: PredicatesAt) -> Mesh:
        """See `Tiling.mesh_at`."""
        return self.build(instant)

    def audit(self, mesh: Mesh, instant: PredicatesAt) -> None:  # noqa: ARG002
        """See `Tiling.audit`; points have no rings, so only links and corners are checked."""
        mesh.audit()

    def mesh_after(self) -> Mesh:
        """Return the tiling just after the current time, derived from the trees: not a copy."""
        if self._mesh is None or not self._is_current:
            changed = self.structure.take_changes()
            if self._mesh is None or changed is None:
                self._mesh = mesh_of(self.structure)
            else:
                update_mesh(self._mesh, self.structure, changed)
            self._is_current = True
        return self._mesh

    def mesh_now(self, time: QQ) -> Mesh:
        """Return the tiling at a rational time: the current one, or one before the next event.

        If certificates vanish at that time, it is built by the sweep.

        Raises:
            AuditError: if a certificate is violated at that time.
        """
        instant = PredicatesAt(self.vertices, time, after=False)
        structure = self.structure
        return mesh_of(structure if holds_at(structure, instant) else sweep_at(instant))

    def _schedule_piece(self, p: VertexId) -> None:
        """Schedule the end of the current piece of a point's motion."""
        end = self.clock.end_of_piece(self.vertices.bodies[p])
        self.table.schedule(pack_point(POINT_MOTION, p), end)

    def add_body(self, body: Body, t: QQ) -> None:
        """See `Tiling.add_body`: the tiling must be rebuilt."""

    def remove_body(self, i: int, t: QQ) -> None:
        """See `Tiling.remove_body`: the tiling must be rebuilt."""

    def change_motions(self, bodies: Mapping[int, Body], t: QQ) -> list[TilingEvent]:
        """See `Tiling.change_motions`."""
        self.clock.move_to(t)
        self._is_current = False
        for p in map(VertexId, sorted(bodies)):
            self.vertices.set_motion(int(p), bodies[int(p)], t, self.certifier.end)
            self._schedule_piece(p)
            self.log.record("motion", (), ())
        for p in map(VertexId, sorted(bodies)):
            self._certified.certify_point(p)
        self._repairs.repair_all()
        self._record_fan()
        self.stats.most = max(self.stats.most, len(self.queue))
        return self.log.take()

    # Events

    def _process(self, time: EventTime, entries: list[tuple[CertificateId, EventTime]]) -> None:
        """See `Tiling._process`."""
        self.clock.enter(time, entries)
        self._is_current = False
        failed = [certificate for certificate, _ in entries]
        with_equal_x = [
            point_of(certificate)
            for certificate in failed
            if point_kind_of(certificate) == POINT_ORDER
        ]
        if with_equal_x and (touches := coinciding(self.certifier, self.structure, with_equal_x)):
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
                certified.violated[kind].add(p)
            elif kind == POINT_ORDER:
                certified.certify_order(p)
            else:
                certified.certify_edge(kind, p)
        self._repairs.repair_all()
        self._record_fan()
        self.stats.most = max(self.stats.most, len(self.queue))
        if self.chains.kind == "auto":
            self._check_chains()

    def _record_fan(self) -> None:
        """Record the changes of the fan triangulation at this time as one event, the last one."""
        if self.fan is None:
            return
        changes = self.fan.take_changes()
        if changes.removed or changes.added:
            self.log.record_fan(changes.removed, changes.added)

    def _check_chains(self) -> None:
        """Make chains searchable if they have turned out to be long."""
        upper, lower = self.structure.trees
        if self.chains.are_long(upper.steps + lower.steps):
            self.structure.make_searchable()

    def _change_motion(self, p: VertexId) -> None:
        """Begin the next piece of a point's motion."""
        moving = self.vertices.bodies[p]
        if moving.until is None:
            raise AuditError(f"body {p} has no next piece")
        self.vertices.enter_piece(int(p), moving.until)
        self._schedule_piece(p)
        self.log.record("motion", (), ())
        self._certified.certify_point(p)
