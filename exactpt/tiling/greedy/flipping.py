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
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.repairs import RebuildNeeded
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State

__all__ = ["FlippingRules"]


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


class FlippingRules(Rules):
    """The rules of a tiling that is greedy wherever its diagonals may be flipped."""

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self._stale: set[int] = set()
        self._moved: set[int] = set()
        self._shadows: dict[int, _Shadow] = {}

    def close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """See `Rules.close`."""
        self._free_flat_vertices(mesh, instant)
        super().close(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())

    def _free_flat_vertices(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Flip the diagonals away from vertices that are flat at the instant, reflex after it.

        In the quadrangle around a diagonal from such a vertex that one is a corner, strictly
        convex, so that the other diagonal does not end there. What is left at the vertex is
        a tile that has no area at the instant.
        """
        vertices = self.certified.vertices
        deforming = [v for body in vertices.bodies if body.deforms for v in body.ring]
        if not deforming:
            return
        after = PredicatesAt(vertices, instant.time)
        for v in deforming:
            ahead, behind = vertices.all[v].ahead, vertices.all[v].behind
            if instant.sign(ahead, v, behind) <= 0 < after.sign(ahead, v, behind):
                for h in mesh.map.fan(mesh.ring_edge[v]):
                    visits = shadow(mesh, h, after) if mesh.is_flippable(h) else None
                    if visits is not None:
                        flip(mesh, h, visits, after)

    def resume(self, state: State) -> None:  # noqa: ARG002 - shadows follow from the mesh
        """See `Rules.resume`."""
        mesh, after = self.certified.mesh, self.certified.after()
        for h in mesh.flippable():
            visits = shadow(mesh, h, after)
            if visits is not None:  # at a contact, after which nothing comes
                self._shadows[h] = self._shadow_of(h, visits)

    def certify(self) -> None:
        """See `Rules.certify`."""
        self._stale.clear()
        self._moved.clear()
        self._shadows.clear()
        self._restore_greedy(self.certified.mesh.flippable())

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        self._stale.update(self.certified.ring_angles(i))
        self._moved.update(self._near(self._stale))

    def changed(self, half_edges: list[int]) -> None:
        """See `Rules.changed`."""
        self._stale.update(half_edges)

    def cancelled(self, h: int) -> None:
        """See `Rules.cancelled`."""
        self._cancel_shadow(min(h, h ^ 1))

    def failed(self, certificates: list[int]) -> None:
        """See `Rules.failed`."""
        self._moved.update(part_of(c) for c in certificates)

    def restore(self) -> None:
        """See `Rules.restore`."""
        self._restore_greedy()

    def _restore_greedy(self, diagonals: Iterable[int] = ()) -> None:
        """Flip what is no longer greedy, and certify the shadows of all that may have changed.

        That is every diagonal of a tile that has changed, and those whose own certificates
        have failed.
        """
        certified, mesh, after = self.certified, self.certified.mesh, self.certified.after()
        m = mesh.map
        nearby = self._near(self._stale)
        nearby.update(min(h, h ^ 1) for h in self._moved)
        nearby.update(diagonals)
        shadows: dict[int, tuple[int, int]] = {}
        candidates = [h for h in sorted(nearby) if m.origin[h] >= 0 and mesh.is_flippable(h)]
        try:
            flips = flip_until_greedy(mesh, after, candidates, shadows, self._is_known)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.log.record("diagonal", (old,), (new,))
            certified.recertify([h for h in changed if m.origin[h] >= 0])
        self._stale.clear()  # of flips, all that has changed is among their shadows
        if certified.table.angles:
            raise RebuildNeeded
        for h in sorted(nearby | shadows.keys()):
            if m.origin[h] < 0 or not mesh.is_flippable(h):
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
        m = self.certified.mesh.map
        return {
            min(g, g ^ 1)
            for h in half_edges
            if m.origin[h] >= 0
            for side in (h, h ^ 1)
            for g in m.face(side)
        }

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
        mesh = self.certified.mesh
        corners = mesh.corner[visits[0]], mesh.corner[visits[1]]
        crossing = mesh.map.origin[visits[0]], mesh.map.origin[visits[1]]
        return _Shadow(mesh.ends(h), visits, corners, crossing, tangency(mesh, h, visits))

    def _certify_spin(self, certificate: int, u: int, v: int, after: OneSided) -> None:
        a, b = (u, v) if after.left_of(u, v) else (v, u)
        certifier, time = self.certified.certifier, None
        if not certifier.keeps_x_order(a, b):
            _, time = certifier.x_order(a, b)
        self.certified.table.schedule(certificate, time)

    def _certify_tangency(self, certificate: int, triple: tuple[int, int, int]) -> None:
        a, b, c = triple
        certifier, time = self.certified.certifier, None
        if len({a, b, c}) == 3 and not certifier.rigid(a, b, c):
            _, time = certifier.orientation(a, b, c)
        self.certified.table.schedule(certificate, time)

    def _cancel_shadow(self, h: int) -> None:
        self._shadows.pop(h, None)
        for i in range(6):
            self.certified.table.pending.cancel(pack(SHADOW + i, h))
