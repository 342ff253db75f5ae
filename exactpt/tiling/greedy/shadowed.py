"""The kinetic greedy pseudo-triangulation of simple polygons.

The rules of convex bodies, on all of the free space: a reflex vertex of a polygon is a
corner there, where a diagonal may end in any direction. What the paper describes for
convex bodies, by shadow edges, works here too (`exactpt.tiling.greedy.flipping`); for
convex bodies the vertical decomposition (`exactpt.tiling.greedy.greedy`) does with fewer
certificates and without shadow events.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import TURN, kind_of, pack, part_of
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.plane_sweep import sweep_diagonals
from exactpt.pseudotriangulation.pointed import make_pointed, point_vertex
from exactpt.tiling.greedy.flipping import FlippingTiling
from exactpt.tiling.repairs import RebuildNeeded

__all__ = ["ShadowedTiling"]


@final
class ShadowedTiling(FlippingTiling):
    """The canonical greedy tiling of simple polygons."""

    name = "greedy"

    @classmethod
    def mesh_at(cls, instant: PredicatesAt) -> Mesh:
        """The greedy tiling of an instant: swept, reduced, and flipped until it is."""
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())
        return mesh

    def _clear_notes(self) -> None:
        super()._clear_notes()
        self._turned: set[int] = set()

    def _certify_everything(self) -> None:
        self._turned.clear()
        super()._certify_everything()
        for v in self.vertices.ids():
            self._certify_turn(v)

    def _certify_body(self, i: int) -> list[int]:
        self._turned.update(self.vertices.bodies[i].ring)
        return super()._certify_body(i)

    def _recheck(self, slots: list[int]) -> None:
        self._turned.update(part_of(slot) for slot in slots if kind_of(slot) == TURN)
        super()._recheck([slot for slot in slots if kind_of(slot) != TURN])

    def _repair_convex_vertex(self, h: int, kind: str) -> None:
        self._turned.add(self.mesh.map.origin[h])
        super()._repair_convex_vertex(h, kind)

    def _restore_greedy(self, after: OneSided, diagonals: Iterable[int] = ()) -> None:
        if self._turned:
            self._point_turned(after)
        super()._restore_greedy(after, diagonals)

    def _enter_body(self, i: int) -> None:
        for v in self.vertices.bodies[i].ring:
            self._certify_turn(v)

    def _leave_body(self, i: int) -> None:
        for v in self.vertices.bodies[i].ring:
            self.queue.cancel(pack(TURN, v))
            self._turned.discard(v)

    def _certify_turn(self, v: int) -> None:
        """Certify that a vertex of a deforming polygon stays reflex, if it is."""
        vertex = self.vertices.all[v]
        slot = pack(TURN, v)
        self.queue.cancel(slot)
        if not self.certifier.rigid(vertex.ahead, v, vertex.behind):
            s, time = self.certifier.orientation(vertex.ahead, v, vertex.behind)
            if s > 0 and time is not None:
                self.queue.schedule(slot, time)

    def _point_turned(self, after: OneSided) -> None:
        """Free vertices that have become convex of their diagonals in mid-air."""
        for v in sorted(self._turned):
            first = self.mesh.ring_edge[v]
            try:
                changes = point_vertex(self.mesh, first, after)
            except AuditError:
                raise RebuildNeeded from None
            for change in changes:
                self._cancel_edge(change.handle)
                added = () if change.new is None else (change.new,)
                self._record("corner", (change.old,), added)
                self._recertify([h for h in change.angles if self.mesh.map.origin[h] >= 0])
            self._certify_turn(v)
        self._turned.clear()
