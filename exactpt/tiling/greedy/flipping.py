"""Kinetic tilings whose diagonals are flipped, by certificates of their shadow edges.

Every diagonal s between two tiles has a shadow edge s' (paper, section 2.2), and the
tiling is greedy if and only if theta(s) < theta(s') for each (Lemma 4.2, the local
property). s and s' cross, so their order by theta changes only when one of them becomes
vertical: theta(s) passes from the smallest value to the largest, or theta(s') from the
largest to the smallest. The shadow edge remains the same as long as it is tangent at both
ends. So every diagonal has six certificates: the x-order of the ends of s and of s', and
four orientations.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import SHADOW, pack, part_of
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, Ends, HalfEdge, Triple, VertexId
from exactpt.kernel.budget import ask
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.flip import flip, flip_until_greedy, shadow, tangency
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.repairs import RebuildNeeded
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State

__all__ = ["FlippingRules"]


@final
class _Shadow:
    """The certified data of a diagonal and its shadow edge.

    Attributes:
        diagonal: the ends of the diagonal.
        visits: the half-edges that the shadow edge joins.
        corners: whether each of these is at a corner of both faces together.
        crossing: the ends of the shadow edge.
        tangencies: the triples that certify its tangencies.
    """

    __slots__ = ("corners", "crossing", "diagonal", "tangencies", "visits")

    def __init__(
        self,
        diagonal: Ends,
        visits: tuple[HalfEdge, HalfEdge],
        corners: tuple[bool, bool],
        crossing: Ends,
        tangencies: list[Triple],
    ) -> None:
        self.diagonal: Ends = diagonal
        self.visits: tuple[HalfEdge, HalfEdge] = visits
        self.corners: tuple[bool, bool] = corners
        self.crossing: Ends = crossing
        self.tangencies: list[Triple] = tangencies

    def is_same_edge(self, other: _Shadow) -> bool:
        """Whether all but the tangencies is equal."""
        return (
            self.diagonal == other.diagonal
            and self.visits == other.visits
            and self.corners == other.corners
            and self.crossing == other.crossing
        )


class FlippingRules(Rules):
    """The rules of a tiling all of whose flippable diagonals are greedy."""

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self._changed: set[HalfEdge] = set()  # half-edges with new angles
        self._moved: set[HalfEdge] = set()  # diagonals of bodies that move anew, or with failures
        self._failed: set[CertificateId] = set()
        self._shadows: dict[HalfEdge, _Shadow] = {}
        self._kept: dict[HalfEdge, tuple[HalfEdge, HalfEdge]] = {}

    def close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """See `Rules.close`."""
        self._free_flat_vertices(mesh, instant)
        super().close(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.flippable())

    def _free_flat_vertices(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Flip the diagonals away from vertices that are flat at the instant, reflex after it.

        Such a vertex is a strictly convex corner of the quadrangle around each of its
        diagonals, so the other diagonal of the quadrangle does not end there. The tile that
        is left at the vertex has no area at the instant.
        """
        vertices = self.certified.vertices
        deforming = [v for body in vertices.bodies if body.deforms for v in body.ring]
        if not deforming:
            return
        after = PredicatesAt(vertices, instant.time)
        for v in deforming:
            ahead, behind = vertices.all[v].ahead, vertices.all[v].behind
            if instant.sign(ahead, v, behind) <= 0 < after.sign(ahead, v, behind):
                for h in mesh.map.star(mesh.ring_edge[v]):
                    visits = shadow(mesh, h, after) if mesh.is_flippable(h) else None
                    if visits is not None:
                        flip(mesh, h, visits, after)

    def resume(self, state: State) -> None:  # noqa: ARG002 - shadows follow from the mesh
        """See `Rules.resume`."""
        mesh, after = self.certified.mesh, self.certified.after()
        for h in mesh.flippable():
            ask()
            visits = shadow(mesh, h, after)
            if visits is not None:  # it is None only at a contact, which ends the run
                self._shadows[h] = self._shadow_of(h, visits)

    def certify(self) -> None:
        """See `Rules.certify`."""
        self._changed.clear()
        self._moved.clear()
        self._failed.clear()
        self._shadows.clear()
        self._restore_greedy(self.certified.mesh.flippable())

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        self._changed.update(self.certified.ring_angles(i))
        nearby = self._edges_of_tiles(self._changed)
        self._moved.update(nearby)
        self._failed.update(pack(SHADOW + i, h) for h in nearby for i in range(6))

    def changed(self, half_edges: list[HalfEdge]) -> None:
        """See `Rules.changed`."""
        self._changed.update(half_edges)

    def cancelled(self, h: HalfEdge) -> None:
        """See `Rules.cancelled`."""
        self._cancel_shadow(min(h, twin(h)))

    def failed(self, certificates: list[CertificateId]) -> None:
        """See `Rules.failed`."""
        self._moved.update(HalfEdge(part_of(c)) for c in certificates)
        self._failed.update(certificates)

    def restore(self) -> None:
        """See `Rules.restore`."""
        self._restore_greedy()

    def _restore_greedy(self, diagonals: Iterable[HalfEdge] = ()) -> None:
        """Flip the diagonals that are no longer greedy, and certify shadow edges again.

        Diagonals of changed tiles are examined, and those whose certificates have failed.
        """
        certified, mesh, after = self.certified, self.certified.mesh, self.certified.after()
        m = mesh.map
        nearby = self._edges_of_tiles(self._changed)
        nearby.update(min(h, twin(h)) for h in self._moved)
        nearby.update(diagonals)
        shadows: dict[HalfEdge, tuple[HalfEdge, HalfEdge]] = {}
        kept = self._kept
        kept.clear()
        candidates = [h for h in sorted(nearby) if m.origin[h] >= 0 and mesh.is_flippable(h)]
        try:
            flips = flip_until_greedy(mesh, after, candidates, shadows, self._is_certified)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.log.record("diagonal", (old,), (new,))
            certified.recertify([h for h in changed if m.origin[h] >= 0])
        self._changed.clear()  # by the flips; the diagonals there have been examined
        if certified.table.angles:
            raise RebuildNeeded
        for h in sorted(nearby | shadows.keys() | kept.keys()):
            if m.origin[h] < 0 or not mesh.is_flippable(h):
                self._cancel_shadow(h)
            elif h in shadows or h in kept:
                self._certify_shadow(h, shadows.get(h) or kept[h], after)
        self._moved.clear()
        self._failed.clear()

    def _is_certified(self, h: HalfEdge) -> bool:
        """Whether the shadow of a diagonal is still what it was, and none of the two vertical.

        A pseudo-quadrangle has two diagonals only. So what is tangent at both ends is the other
        one still, whatever has changed elsewhere in the two tiles; and that it is greater is
        certified. Where the neighbours of an end have changed, signs tell whether it is tangent
        there.
        """
        old = self._shadows.get(h)
        if old is None or h in self._moved:
            return False
        new = self._shadow_of(h, old.visits)
        before, now = old.tangencies, new.tangencies
        if not new.is_same_edge(old):
            return False
        if before == now:
            return True
        if not now:
            return False
        if not all(
            before[2 * e : 2 * e + 2] == now[2 * e : 2 * e + 2]
            or self._is_tangent(now[2 * e], now[2 * e + 1], new.corners[e])
            for e in (0, 1)
        ):
            return False
        self._kept[h] = old.visits
        return True

    def _is_tangent(
        self,
        after: Triple,
        before: Triple,
        is_corner: bool,  # noqa: FBT001
    ) -> bool:
        """Whether a segment xy is tangent at x, by (x, after, y) and (x, y, before).

        At a corner it is inside the angle; at a reflex vertex both neighbours are on one side,
        and so is the solid angle between them.
        """
        instant = self.certified.after()
        first, second = instant.sign(*after), instant.sign(*before)
        return first > 0 and second > 0 if is_corner else first * second < 0

    def _edges_of_tiles(self, half_edges: Iterable[HalfEdge]) -> set[HalfEdge]:
        """The edges of the tiles on both sides of some half-edges."""
        m = self.certified.mesh.map
        found: set[HalfEdge] = set()
        for h in half_edges:
            if m.origin[h] >= 0:
                for side in (h, twin(h)):
                    if side not in found:
                        found.update(m.face(side))
        return {min(g, twin(g)) for g in found}

    def _certify_shadow(
        self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge], after: OneSided
    ) -> None:
        """Certify that a diagonal has smaller theta than its shadow edge, and the tangencies.

        Certificates that are the same as before, and have not failed, are pending still.
        """
        new, old = self._shadow_of(h, visits), self._shadows.get(h)
        self._shadows[h] = new
        spin, failed = pack(SHADOW, h), self._failed
        if old is None or old.diagonal != new.diagonal or spin in failed:
            self._certify_x_order(spin, *new.diagonal, after)
        spin = pack(SHADOW + 1, h)
        if old is None or old.crossing != new.crossing or spin in failed:
            self._certify_x_order(spin, *new.crossing, after)
        known = [] if old is None else old.tangencies
        for i, triple in enumerate(new.tangencies):
            there = pack(SHADOW + 2 + i, h)
            if i >= len(known) or known[i] != triple or there in failed:
                self._certify_tangency(there, triple)

    def _shadow_of(self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge]) -> _Shadow:
        mesh = self.certified.mesh
        first, second = visits
        there = tangency(mesh, h, visits)
        corners = self._is_corner(h, first, there[:2]), self._is_corner(h, second, there[2:])
        crossing = mesh.map.origin[first], mesh.map.origin[second]
        return _Shadow(mesh.ends(h), visits, corners, crossing, there)

    def _is_corner(self, h: HalfEdge, visit: HalfEdge, tangencies: list[Triple]) -> bool:
        """Whether a visit is at a corner of both faces of a diagonal together."""
        following = self.certified.mesh.map.following
        if tangencies and (visit == following[h] or visit == following[h ^ 1]):
            # At an end of the diagonal itself the angles of the two faces are one.
            (x, after, _), (_, _, before) = tangencies
            return self.certified.after().sign(before, x, after) > 0
        return self.certified.mesh.corner[visit]

    def _certify_x_order(
        self, certificate: CertificateId, u: VertexId, v: VertexId, after: OneSided
    ) -> None:
        a, b = (u, v) if after.left_of(u, v) else (v, u)
        certifier, time = self.certified.certifier, None
        if not certifier.keeps_x_order(a, b):
            _, time = certifier.x_order(a, b)
        self.certified.table.schedule(certificate, time)

    def _certify_tangency(self, certificate: CertificateId, triple: Triple) -> None:
        a, b, c = triple
        certifier, time = self.certified.certifier, None
        if len({a, b, c}) == 3 and not certifier.rigid(a, b, c):
            _, time = certifier.orientation(a, b, c)
        self.certified.table.schedule(certificate, time)

    def _cancel_shadow(self, h: HalfEdge) -> None:
        if self._shadows.pop(h, None) is None:
            return
        for i in range(6):
            self.certified.table.pending.cancel(pack(SHADOW + i, h))
