"""The kinetic greedy pseudo-triangulation of simple polygons.

The rules of convex bodies, on all of the free space: a reflex vertex of a polygon is a
corner there, where a diagonal may end in any direction. What the paper describes for
convex bodies, by shadow edges, works here too (`exactpt.tiling.greedy.flipping`); for
convex bodies the vertical decomposition (`exactpt.tiling.greedy.greedy`) does with fewer
certificates and without shadow events.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import TURN, kind_of, pack, part_of
from exactpt.errors import AuditError
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.plane_sweep import sweep_diagonals
from exactpt.pseudotriangulation.pointed import make_pointed, point_vertex
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.greedy.flipping import FlippingRules
from exactpt.tiling.repairs import RebuildNeeded

__all__ = ["ShadowRules"]


@final
class ShadowRules(FlippingRules):
    """The canonical greedy tiling of simple polygons."""

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self._turned: set[int] = certified.table.violated[TURN]

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """The greedy tiling of an instant: swept, reduced, and flipped until it is."""
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())
        return mesh

    def certify(self) -> None:
        """See `Rules.certify`."""
        self._turned.clear()
        super().certify()
        for v in self.certified.vertices.ids():
            self._certify_turn(v)

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        self._turned.update(self.certified.vertices.bodies[i].ring)
        super().certify_body(i)

    def failed(self, certificates: list[int]) -> None:
        """See `Rules.failed`."""
        self._turned.update(part_of(c) for c in certificates if kind_of(c) == TURN)
        super().failed([c for c in certificates if kind_of(c) != TURN])

    def turns_reflex(self, h: int) -> None:
        """See `Rules.turns_reflex`."""
        self._turned.add(self.certified.mesh.map.origin[h])

    def restore(self) -> None:
        """See `Rules.restore`."""
        if self._turned:
            self._point_turned()
        super().restore()

    def enter(self, i: int) -> None:
        """See `Rules.enter`."""
        for v in self.certified.vertices.bodies[i].ring:
            self._certify_turn(v)

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        for v in self.certified.vertices.bodies[i].ring:
            self.certified.table.pending.cancel(pack(TURN, v))
            self._turned.discard(v)

    def _certify_turn(self, v: int) -> None:
        """Certify that a vertex of a deforming polygon stays reflex, if it is."""
        vertex, certifier = self.certified.vertices.all[v], self.certified.certifier
        time = None
        if not certifier.rigid(vertex.ahead, v, vertex.behind):
            s, zero = certifier.orientation(vertex.ahead, v, vertex.behind)
            time = zero if s > 0 else None
        self.certified.table.schedule(pack(TURN, v), time)

    def _point_turned(self) -> None:
        """Free vertices that have become convex of their diagonals in mid-air."""
        certified, mesh, after = self.certified, self.certified.mesh, self.certified.after()
        for v in sorted(self._turned):
            try:
                changes = point_vertex(mesh, mesh.ring_edge[v], after)
            except AuditError:
                raise RebuildNeeded from None
            for change in changes:
                certified.cancel_edge(change.handle)
                added = () if change.new is None else (change.new,)
                self.log.record("corner", (change.old,), added)
                certified.recertify([h for h in change.angles if mesh.map.origin[h] >= 0])
            self._certify_turn(v)
        self._turned.clear()
