"""The kinetic greedy pseudo-triangulation of simple polygons.

The greedy rule of convex bodies is applied to the whole free space, in which a reflex
vertex of a polygon is a corner, where a diagonal may end in any direction. The paper's
method for convex bodies, by shadow edges, applies here too (`exactpt.tiling.greedy.flipping`).
For convex bodies the vertical decomposition (`exactpt.tiling.greedy.greedy`) needs fewer
certificates, and no events of shadow edges.
"""

from __future__ import annotations

from typing import ClassVar, cast, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import TURN, kind_of, pack, part_of
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, HalfEdge, VertexId
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.plane_sweep import sweep_diagonals
from exactpt.pseudotriangulation.pointed import make_pointed, point_vertex
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.greedy.flipping import FlippingRules
from exactpt.tiling.repairs import RebuildNeeded


@final
class ShadowRules(FlippingRules):
    """The canonical greedy tiling of simple polygons."""

    slides_are_plain: ClassVar[bool] = True

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self._turned: set[VertexId] = cast("set[VertexId]", certified.table.violated[TURN])

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return the greedy tiling of an instant: swept, made pointed, flipped until greedy."""
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())
        return mesh

    def has_part(self, kind: int, part: int) -> bool:
        """See `Rules.has_part`."""
        if kind == TURN:
            return part < len(self.certified.vertices.all)
        return super().has_part(kind, part)

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

    def failed(self, certificates: list[CertificateId]) -> None:
        """See `Rules.failed`."""
        self._turned.update(VertexId(part_of(c)) for c in certificates if kind_of(c) == TURN)
        super().failed([c for c in certificates if kind_of(c) != TURN])

    def turns_reflex(self, h: HalfEdge) -> None:
        """See `Rules.turns_reflex`."""
        self._turned.add(self.certified.mesh.map.origin[h])

    def recanonicalize(self) -> None:
        """See `Rules.recanonicalize`."""
        if self._turned:
            self._make_pointed()
        super().recanonicalize()

    def enter(self, i: int) -> None:
        """See `Rules.enter`."""
        for v in self.certified.vertices.bodies[i].ring:
            self._certify_turn(v)

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        for v in self.certified.vertices.bodies[i].ring:
            self.certified.table.pending.cancel(pack(TURN, v))
            self._turned.discard(v)

    def _certify_turn(self, v: VertexId) -> None:
        """Certify that a vertex of a deforming polygon stays reflex, if it is reflex."""
        vertices, certifier = self.certified.vertices, self.certified.certifier
        ahead, behind = vertices.ahead(v), vertices.behind(v)
        time = None
        if not certifier.rigid(ahead, v, behind):
            s, zero = certifier.orientation(ahead, v, behind)
            time = zero if s > 0 else None
        self.certified.table.schedule(pack(TURN, v), time)

    def _make_pointed(self) -> None:
        """Make vertices pointed that have become convex, by removals and flips of diagonals."""
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
