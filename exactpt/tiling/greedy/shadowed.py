"""The kinetic greedy pseudo-triangulation of simple polygons, with certified shadow edges.

The rules of convex bodies, on all of the free space: a reflex vertex of a polygon is a
corner there, where a diagonal may end in any direction. Every diagonal s has a shadow
edge s' (paper, section 2.2), and the tiling is greedy if and only if theta(s) < theta(s')
for each (Lemma 4.2, the local property). s and s' cross, so their order changes only when
one of them becomes vertical: s from the smallest theta to the largest, or s' the other
way. The shadow itself stays while it is tangent at both ends. So for every diagonal there
are six certificates: the x-order of s and of s', and four orientations.

This is what the paper describes for convex bodies too; there, the vertical decomposition
(`exactpt.tiling.greedy.greedy`) does with fewer certificates and without shadow events.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.tiling.build import build_mesh
from exactpt.tiling.greedy.shadow import flip_until_greedy, shadow, tangency
from exactpt.tiling.instant import Instant
from exactpt.tiling.kinetic import KINDS, KineticTiling, RebuildNeeded
from exactpt.tiling.mesh import FREE, Mesh
from exactpt.tiling.moment import Moment
from exactpt.tiling.plane_sweep import sweep_diagonals
from exactpt.tiling.pointed import make_pointed, point_vertex

__all__ = ["ShadowedTiling"]

TURN: Final = 5

SHADOW: Final = 8
"""Kinds SHADOW to SHADOW + 5: the x-order of a diagonal and of its shadow, four tangencies."""


class ShadowedTiling(KineticTiling):
    """The canonical greedy tiling of simple polygons."""

    name = "greedy"

    def _build(self, time: QQ) -> None:
        self.mesh = self.mesh_at(Instant(self.vertices, time, exact_only=self.certifier.exact_only))

    @classmethod
    def mesh_at(cls, instant: Instant) -> Mesh:
        """The greedy tiling of an instant: swept, reduced, and flipped until it is."""
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        flip_until_greedy(mesh, instant, list(_flippable(mesh)))
        return mesh

    def _close(self, mesh: Mesh, instant: Instant) -> None:
        super()._close(mesh, instant)
        flip_until_greedy(mesh, instant, list(_flippable(mesh)))

    def _certify_everything(self) -> None:
        self._stale: set[int] = set()
        self._turned: set[int] = set()
        super()._certify_everything()
        self._stale.clear()
        for v in range(len(self.vertices.all)):
            self._certify_turn(v)
        after = Moment(self.certifier, before=False)
        for h in _flippable(self.mesh):
            self._certify_shadow(h, after)

    def _recertify(self, slots: tuple[int, ...]) -> None:
        super()._recertify(slots)
        self._stale.update(slots)

    def _certify_body(self, i: int) -> list[int]:
        vanishing = super()._certify_body(i)
        m = self.mesh.map
        for v in self.vertices.bodies[i].ring:
            self._stale.update(m.fan(self.mesh.ring_edge[v]))
            self._turned.add(v)
        return vanishing

    def _recheck(self, slots: list[int]) -> None:
        for slot in slots:
            if slot % KINDS == TURN:
                self._turned.add(slot // KINDS)
            else:
                self._stale.add(slot // KINDS)

    def _repair_convex_vertex(self, h: int, kind: str) -> None:
        self._turned.add(self.mesh.map.origin[h])
        super()._repair_convex_vertex(h, kind)

    # Reflex vertices that become convex

    def _certify_turn(self, v: int) -> None:
        """Certify that a vertex of a deforming polygon stays reflex, if it is."""
        vertex = self.vertices.all[v]
        slot = KINDS * v + TURN
        self.queue.cancel(slot)
        if self.vertices.bodies[vertex.body].is_tiled:
            s, time = self.certifier.orientation(vertex.ahead, v, vertex.behind)
            if s > 0 and time is not None:
                self.queue.schedule(slot, time)

    def _point_turned(self, after: Moment) -> None:
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
                self._recertify(tuple(h for h in change.angles if self.mesh.map.origin[h] >= 0))
            self._certify_turn(v)
        self._turned.clear()

    def _settle(self) -> None:
        super()._settle()
        m = self.mesh.map
        after = Moment(self.certifier, before=False)
        if self._turned:
            self._point_turned(after)
        nearby = {
            min(g, g ^ 1)
            for h in self._stale
            if m.origin[h] >= 0
            for side in (h, h ^ 1)
            for g in m.face(side)
        }
        self._stale.clear()
        candidates = [h for h in sorted(nearby) if self._is_flippable(h)]
        changed = self._flip(candidates, after)
        for h in sorted({*candidates, *changed}):
            if m.origin[h] >= 0 and self._is_flippable(h):
                self._certify_shadow(h, after)
            else:
                self._cancel_shadow(h)

    def _flip(self, candidates: list[int], after: Moment) -> set[int]:
        """Flip until the tiling is greedy again; the diagonals next to what changed."""
        m = self.mesh.map
        try:
            flips = flip_until_greedy(self.mesh, after, candidates)
        except AuditError:
            raise RebuildNeeded from None
        nearby: set[int] = set()
        for old, new, changed in flips:
            self._record("diagonal", (old,), (new,))
            super()._recertify(tuple(h for h in changed if m.origin[h] >= 0))
            for h in changed:
                if m.origin[h] >= 0:
                    nearby.update(min(g, g ^ 1) for side in (h, h ^ 1) for g in m.face(side))
        if self._due:
            raise RebuildNeeded
        return nearby

    def _cancel_edge(self, h: int) -> None:
        super()._cancel_edge(h)
        self._cancel_shadow(min(h, h ^ 1))

    def _is_flippable(self, h: int) -> bool:
        mesh = self.mesh
        return not mesh.is_boundary(h) and mesh.region[h] == FREE and mesh.region[h ^ 1] == FREE

    def _certify_shadow(self, h: int, after: Moment) -> None:
        """Certify that a diagonal has smaller theta than its shadow, and what the shadow is."""
        visits = shadow(self.mesh, h, after)
        if visits is None:
            raise RebuildNeeded
        m = self.mesh.map
        x, y = m.origin[visits[0]], m.origin[visits[1]]
        slot = KINDS * h + SHADOW
        self._certify_spin(slot, *self.mesh.ends(h), after)
        self._certify_spin(slot + 1, x, y, after)
        for i, triple in enumerate(tangency(self.mesh, h, visits)):
            self._certify_tangency(slot + 2 + i, triple)

    def _certify_spin(self, slot: int, u: int, v: int, after: Moment) -> None:
        a, b = (u, v) if after.left_of(u, v) else (v, u)
        time = None
        if not self.certifier.keeps_x_order(a, b):
            _, time = self.certifier.x_order(a, b)
        if time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)

    def _certify_tangency(self, slot: int, triple: tuple[int, int, int]) -> None:
        a, b, c = triple
        time = None
        if len({a, b, c}) == 3 and not self.certifier.rigid(a, b, c):
            _, time = self.certifier.orientation(a, b, c)
        if time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)

    def _cancel_shadow(self, h: int) -> None:
        for i in range(6):
            self.queue.cancel(KINDS * h + SHADOW + i)


def _flippable(mesh: Mesh) -> Iterator[int]:
    return (h for h in mesh.diagonals() if mesh.region[h] == FREE and mesh.region[h ^ 1] == FREE)
