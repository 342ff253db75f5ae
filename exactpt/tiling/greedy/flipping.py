"""Kinetic tilings whose diagonals are flipped: certified shadow edges.

Every diagonal s between two tiles has a shadow edge s' (paper, section 2.2), and the
tiling is greedy if and only if theta(s) < theta(s') for each (Lemma 4.2, the local
property). s and s' cross, so their order changes only when one of them becomes vertical:
s from the smallest theta to the largest, or s' the other way. The shadow itself stays
while it is tangent at both ends. So for every diagonal there are six certificates: the
x-order of s and of s', and four orientations.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import SHADOW, pack, part_of
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.pseudotriangulation.flip import flip, flip_until_greedy, shadow, tangency
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.populated import PopulatedTiling
from exactpt.tiling.repairs import RebuildNeeded

__all__ = ["FlippingTiling"]


class _Shadow(NamedTuple):
    """What is certified of a diagonal.

    Attributes:
        diagonal: its ends.
        visits: of its shadow.
        corners: whether each of them is one of its face.
        crossing: the ends of its shadow.
        tangencies: there.
    """

    diagonal: tuple[int, int]
    visits: tuple[int, int]
    corners: tuple[bool, bool]
    crossing: tuple[int, int]
    tangencies: list[tuple[int, int, int]]


class FlippingTiling(PopulatedTiling):
    """A tiling that is greedy wherever its diagonals may be flipped."""

    def _close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        self._free_flat_vertices(mesh, instant)
        super()._close(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())

    def _free_flat_vertices(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Flip the diagonals away from vertices that are flat at the instant, reflex after it.

        In the quadrangle around a diagonal from such a vertex that one is a corner, strictly
        convex, so that the other diagonal does not end there. What is left at the vertex is
        a tile that has no area at the instant.
        """
        deforming = [v for body in self.vertices.bodies if body.deforms for v in body.ring]
        if not deforming:
            return
        after = PredicatesAt(self.vertices, instant.time)
        for v in deforming:
            ahead, behind = self.vertices.all[v].ahead, self.vertices.all[v].behind
            if instant.sign(ahead, v, behind) <= 0 < after.sign(ahead, v, behind):
                for h in mesh.map.fan(mesh.ring_edge[v]):
                    visits = shadow(mesh, h, after) if mesh.is_flippable(h) else None
                    if visits is not None:
                        flip(mesh, h, visits, after)

    def _clear_notes(self) -> None:
        self._stale: set[int] = set()
        self._moved: set[int] = set()
        self._shadows: dict[int, _Shadow] = {}

    def _recall(self) -> None:
        after = OneSided(self.certifier, before=False)
        for h in self.mesh.flippable():
            visits = shadow(self.mesh, h, after)
            if visits is not None:  # at a contact, after which nothing comes
                self._shadows[h] = self._shadow_of(h, visits)

    def _certify_everything(self) -> None:
        self._clear_notes()
        super()._certify_everything()
        self._stale.clear()
        self._restore_greedy(OneSided(self.certifier, before=False), self.mesh.flippable())

    def _recertify(self, slots: list[int]) -> None:
        super()._recertify(slots)
        self._stale.update(slots)

    def _certify_body(self, i: int) -> list[int]:
        vanishing = super()._certify_body(i)
        m = self.mesh.map
        for v in self.vertices.bodies[i].ring:
            self._stale.update(m.fan(self.mesh.ring_edge[v]))
        self._moved.update(self._near(self._stale))
        return vanishing

    def _recheck(self, slots: list[int]) -> None:
        self._moved.update(part_of(slot) for slot in slots)

    def _settle(self) -> None:
        super()._settle()
        self._restore_greedy(OneSided(self.certifier, before=False))

    def _restore_greedy(self, after: OneSided, diagonals: Iterable[int] = ()) -> None:
        """Flip what is no longer greedy, and certify the shadows of all that may have changed.

        That is every diagonal of a tile that has changed, and those whose own certificates
        have failed.
        """
        m = self.mesh.map
        nearby = self._near(self._stale)
        nearby.update(min(h, h ^ 1) for h in self._moved)
        nearby.update(diagonals)
        self._stale.clear()
        shadows: dict[int, tuple[int, int]] = {}
        candidates = [h for h in sorted(nearby) if m.origin[h] >= 0 and self.mesh.is_flippable(h)]
        try:
            flips = flip_until_greedy(self.mesh, after, candidates, shadows, self._is_known)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self._record("diagonal", (old,), (new,))
            super()._recertify([h for h in changed if m.origin[h] >= 0])
        if self._due:
            raise RebuildNeeded
        for h in sorted(nearby | shadows.keys()):
            if m.origin[h] < 0 or not self.mesh.is_flippable(h):
                self._cancel_shadow(h)
            elif h in shadows:
                self._certify_shadow(h, shadows[h], after)
        self._moved.clear()

    def _is_known(self, h: int) -> bool:
        """Whether the certificates of a diagonal have not failed, and are still the right ones.

        A pseudo-quadrangle has two diagonals only. So what is tangent at both ends, as it
        was, is the other one still, whatever has changed elsewhere in the two tiles. (Ends
        that the two share are left out: the angle there is one of both tiles together.)
        """
        old = self._shadows.get(h)
        return (
            old is not None
            and h not in self._moved
            and not set(old.diagonal) & set(old.crossing)
            and old == self._shadow_of(h, old.visits)
        )

    def _near(self, half_edges: Iterable[int]) -> set[int]:
        """The edges of the tiles on both sides of these."""
        m = self.mesh.map
        return {
            min(g, g ^ 1)
            for h in half_edges
            if m.origin[h] >= 0
            for side in (h, h ^ 1)
            for g in m.face(side)
        }

    def _cancel_edge(self, h: int) -> None:
        super()._cancel_edge(h)
        self._cancel_shadow(min(h, h ^ 1))

    def _certify_shadow(self, h: int, visits: tuple[int, int], after: OneSided) -> None:
        """Certify that a diagonal has smaller theta than its shadow, and what the shadow is.

        Certificates that are the same as before are pending still.
        """
        new = self._shadow_of(h, visits)
        if self._shadows.get(h) == new and h not in self._moved:
            return
        self._shadows[h] = new
        self._certify_spin(pack(SHADOW, h), *new.diagonal, after)
        self._certify_spin(pack(SHADOW + 1, h), *new.crossing, after)
        for i, triple in enumerate(new.tangencies):
            self._certify_tangency(pack(SHADOW + 2 + i, h), triple)

    def _shadow_of(self, h: int, visits: tuple[int, int]) -> _Shadow:
        m = self.mesh.map
        corners = self.mesh.corner[visits[0]], self.mesh.corner[visits[1]]
        crossing = m.origin[visits[0]], m.origin[visits[1]]
        return _Shadow(self.mesh.ends(h), visits, corners, crossing, tangency(self.mesh, h, visits))

    def _certify_spin(self, slot: int, u: int, v: int, after: OneSided) -> None:
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
        self._shadows.pop(h, None)
        for i in range(6):
            self.queue.cancel(pack(SHADOW + i, h))
