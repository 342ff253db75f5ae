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

from librt.vecs import vec
from mypy_extensions import i64, mypyc_attr

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import SHADOW, part_of
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, HalfEdge
from exactpt.kernel.budget import check_budget
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.flip import flip, flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.shadow import shadow
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.greedy.shadows import COUNT, CertifiedShadows
from exactpt.tiling.repairs import RebuildNeeded
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State


@mypyc_attr(allow_interpreted_subclasses=True)
class FlippingRules(Rules):
    """The rules of a tiling all of whose flippable diagonals are greedy."""

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self._shadows: CertifiedShadows = CertifiedShadows(certified)
        self._changed: list[HalfEdge] = []  # half-edges with new angles
        self._moved: list[HalfEdge] = []  # diagonals of bodies that move anew, or with failures
        self._marks: vec[i64] = vec[i64]()  # of half-edges: the last search that visited each
        self._searches: i64 = 0

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
            ahead, behind = vertices.ahead(v), vertices.behind(v)
            if instant.orientation(ahead, v, behind) <= 0 < after.orientation(ahead, v, behind):
                for h in mesh.map.star(mesh.ring_edge[v]):
                    visits = shadow(mesh, h, after) if mesh.is_flippable(h) else None
                    if visits is not None:
                        flip(mesh, h, visits, after)

    def resume(self, state: State) -> None:  # noqa: ARG002 - shadows follow from the mesh
        """See `Rules.resume`."""
        mesh, after = self.certified.mesh, self.certified.after()
        for h in mesh.flippable():
            check_budget()
            visits = shadow(mesh, h, after)
            if visits is not None:  # it is None only at a contact, which ends the run
                self._shadows.resume(h, visits)

    def has_part(self, kind: int, part: int) -> bool:
        """See `Rules.has_part`."""
        h, mesh = HalfEdge(part), self.certified.mesh
        is_diagonal = h % 2 == 0 and mesh.map.is_used(h) and mesh.is_flippable(h)
        return SHADOW <= kind < SHADOW + COUNT and is_diagonal

    def certify(self) -> None:
        """See `Rules.certify`."""
        self._changed.clear()
        self._moved.clear()
        self._shadows.clear()
        self._restore_greedy(self.certified.mesh.flippable())

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        angles = self.certified.ring_angles(i)
        self._changed += angles
        for h in self._edges_of_tiles(angles):
            self._moved.append(h)
            self._shadows.fail_all(h)

    def changed(self, half_edges: list[HalfEdge]) -> None:
        """See `Rules.changed`."""
        self._changed += half_edges

    def cancelled(self, h: HalfEdge) -> None:
        """See `Rules.cancelled`."""
        self._shadows.cancel(min(h, twin(h)))

    def failed(self, certificates: list[CertificateId]) -> None:
        """See `Rules.failed`."""
        for certificate in certificates:
            self._moved.append(HalfEdge(part_of(certificate)))
            self._shadows.fail(certificate)

    def recanonicalize(self) -> None:
        """See `Rules.recanonicalize`."""
        edges = self._edges_of_tiles(self._changed)
        marks, search = self._marks, self._searches
        for h in self._moved:
            if marks[h] != search and marks[h ^ 1] != search:
                marks[h] = search
                edges.append(h)
        edges.sort()
        self._restore_greedy(edges)

    def _restore_greedy(self, edges: list[HalfEdge]) -> None:
        """Flip the diagonals that have ceased to be greedy, and certify shadow edges again.

        Args:
            edges: even half-edges in increasing order: those of changed tiles, body edges
                apart, and those with failed certificates.
        """
        certified, mesh, after = self.certified, self.certified.mesh, self.certified.after()
        origin = mesh.map.origin
        candidates: list[HalfEdge] = []
        for h in edges:
            if origin[h] >= 0 and mesh.is_flippable(h):
                candidates.append(h)
            else:
                self._shadows.cancel(h)
        try:
            flips = flip_until_greedy(mesh, after, candidates, self._shadows)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.log.record("diagonal", (old,), (new,))
            certified.recertify([h for h in changed if mesh.map.origin[h] >= 0])
        self._changed.clear()  # by the flips; the diagonals there have been examined
        if certified.table.angles:
            raise RebuildNeeded
        self._shadows.certify()
        self._moved.clear()

    def _edges_of_tiles(self, half_edges: list[HalfEdge]) -> list[HalfEdge]:
        """Return the edges (even half-edges) of the tiles on both sides of some half-edges.

        Without body edges. At least one half-edge of each has `_searches` in `_marks` afterwards.
        """
        mesh, origin = self.certified.mesh, self.certified.mesh.map.origin
        following, boundary = mesh.map.following, mesh.boundary
        if len(self._marks) != len(following):
            self._marks = vec[i64]([0] * len(following))
        self._searches += 1
        marks, search = self._marks, self._searches
        edges: list[HalfEdge] = []
        for h in half_edges:
            for side in range(2):
                g = twin(h) if side else h
                while origin[g] >= 0 and marks[g] != search:
                    marks[g] = search
                    if marks[g ^ 1] != search and not boundary[g >> 1]:
                        edges.append(min(g, twin(g)))
                    g = following[g]
        return edges
