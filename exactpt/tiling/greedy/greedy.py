"""The kinetic greedy vertical pseudo-triangulation of convex bodies (paper, section 4.2).

Angles are repaired as in any tiling; of two diagonals that become collinear, the one with
the larger theta is replaced. The vertical decomposition detects the diagonals that become
vertical, and the bitangents that become vertical and so get the smallest theta.
"""

from __future__ import annotations

from typing import ClassVar, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import CELL, EXTREME, kind_of, part_of
from exactpt.certificates.convex_bodies import all_stay_convex
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, HalfEdge, VertexId
from exactpt.kernel.numbers import QQ, shorten
from exactpt.kernel.stored import Stored
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key, twin
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip, flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.shadow import crosses, shadow
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.greedy.certified_cells import CertifiedCells
from exactpt.tiling.greedy.sweep import greedy_diagonals
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.greedy.visibility import facing_visit
from exactpt.tiling.repairs import RebuildNeeded
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State


def greedy_mesh(instant: PredicatesAt, cells: VerticalDecomposition) -> tuple[Mesh, int]:
    """Return the greedy tiling, and the number of flips that were needed after the sweep.

    Flips can be needed only if the sweep found two bitangents on one line; these diagonals are
    checked. The vertical decomposition is used up.
    """
    diagonals, tied = greedy_diagonals(instant, cells)
    mesh = build_mesh(instant, diagonals)
    unsure = [h for h in mesh.diagonals() if edge_key(*mesh.ends(h)) in tied] if tied else []
    flips = flip_until_greedy(mesh, instant, unsure)
    return mesh, len(flips)


@final
class VerticalRules(Rules):
    """The canonical tiling of convex bodies: at any time the one built by the sweep.

    Attributes:
        cells: the vertical decomposition, with its certificates.
    """

    slides_are_plain: ClassVar[bool] = True
    only_angles: ClassVar[bool] = True

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self.cells: CertifiedCells = CertifiedCells(certified)

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return the greedy tiling of an instant."""
        return greedy_mesh(instant, VerticalDecomposition.at(instant))[0]

    def begin(self, instant: PredicatesAt) -> Mesh:
        """See `Rules.begin`."""
        self.cells.now = VerticalDecomposition.at(instant)
        mesh, flips = greedy_mesh(instant, self.cells.now.copy())
        self.log.stats.flips += flips
        return mesh

    def close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """See `Rules.close`."""
        super().close(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.diagonals())

    def audit(self, instant: PredicatesAt) -> None:
        """See `Rules.audit`."""
        static = VerticalDecomposition.at(instant)
        if list(static.vertex) != list(self.cells.now.vertex):
            raise AuditError(f"t = {instant.time}: the extreme vertices are not the static ones")
        pairs = [sorted(zip(c.left, c.right, strict=True)) for c in (self.cells.now, static)]
        if pairs[0] != pairs[1]:
            raise AuditError(
                f"t = {instant.time}: the vertical decomposition is not the static one"
            )

    def state(self) -> State:
        """See `Rules.state`."""
        return {"cells": self.cells.now.state()}

    def resume(self, state: State) -> None:
        """See `Rules.resume`."""
        vertices = self.certified.vertices
        self.cells.now.resume(
            Stored(state, "state")["cells"], len(vertices.bodies), len(vertices.all)
        )

    def has_part(self, kind: int, part: int) -> bool:
        """See `Rules.has_part`."""
        if kind == CELL:
            return part < len(self.cells.now.left)
        return kind == EXTREME and part < 4 * len(self.certified.vertices.bodies)

    def certify(self) -> None:
        """See `Rules.certify`."""
        self.cells.certify_everything()

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        self.cells.certify_body(i)

    # Changes of motions, insertion and removal of bodies

    def allows_plan(self, body: Body, t: QQ) -> bool:
        """See `Rules.allows_plan`: it must stay convex."""
        if _is_only_translated(body, t):
            return True
        alone = Vertices.of([body], t, self.certified.certifier.end)
        return not alone.bodies[0].is_tiled

    def allows_body(self, body: Body, t: QQ) -> bool:
        """See `Rules.allows_body`: it must stay convex."""
        alone = Vertices.of([body], t, self.certified.certifier.end)
        return all_stay_convex(PredicatesAt(alone, t))

    def enter(self, i: int) -> None:
        """See `Rules.enter`."""
        self.cells.enter(i)

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        self.cells.leave(i)

    def failed(self, certificates: list[CertificateId]) -> None:
        """See `Rules.failed`."""
        for certificate in certificates:
            if kind_of(certificate) == CELL:
                self.cells.certify(part_of(certificate))
            else:
                self.cells.certify_extreme(part_of(certificate))
        # In the plane rotated by rho (`exactpt.certificates.perturbation`, step 1) x is x - rho y.
        # Two vertices l and r that exchange their order now, l the left one before, do so
        # when x(r) - x(l) has decreased to rho (y(r) - y(l)): before now, and so before the
        # angles that fail now, if r is the upper one; after these angles if l is.
        self._repair_rising()

    # Repairs

    def is_violated(self) -> bool:
        """See `Rules.is_violated`."""
        return bool(self.cells.violated_extremes or self.cells.violated)

    def repair(self) -> None:
        """See `Rules.repair`."""
        after = self.certified.after()
        if self.cells.violated_extremes:
            self._move_extreme(min(self.cells.violated_extremes))
        else:
            self._exchange(min(self.cells.violated), after)

    def _repair_rising(self) -> None:
        """Exchange the pairs that, perturbed, exchange their order just before now."""
        before = OneSided(self.certified.certifier, before=True)
        rising = True
        while rising:
            rising = False
            for handle in sorted(self.cells.violated_extremes):
                if self.cells.is_rising(*self.cells.extreme_pair(handle)):
                    self.certified.failure_group.begin_repair()
                    self._move_extreme(handle)
                    rising = True
                    break
            for cell in sorted(self.cells.violated):
                if self.cells.is_rising(*self.cells.pair(cell)):
                    self.certified.failure_group.begin_repair()
                    self._exchange(cell, before)
                    rising = True
                    break

    def _move_extreme(self, handle: int) -> None:
        arc = handle >> 1
        vertices, v = self.certified.vertices, self.cells.now.vertex[arc]
        self.cells.now.vertex[arc] = vertices.behind(v) if handle % 2 else vertices.ahead(v)
        self.log.stats.count("internal")
        self.cells.certify_extreme(2 * arc)
        self.cells.certify_extreme(2 * arc + 1)
        for cell in sorted(self.cells.now.cells_of(arc)):
            self.cells.certify(cell)

    def _exchange(self, cell: int, predicates: OneSided) -> None:
        """Exchange the two arcs of a cell, whose bitangent is vertical now."""
        self.cells.violated.discard(cell)
        u, v = self.cells.pair(cell)
        rising = self.cells.is_rising(u, v)
        a, b = self.cells.now.swap(cell, left_is_lower=rising)
        for touched in sorted({cell, a, b}):
            self.cells.certify(touched)
        # If the bitangent rises from left to right, its theta passes from the smallest value to
        # the largest; if it falls, from the largest to the smallest.
        if rising:
            self._remove_diagonal(u, v, predicates)
        else:
            self._insert_bitangent(u, v, predicates)

    def check(self, touched: list[HalfEdge]) -> None:
        """See `Rules.check`."""
        m = self.certified.mesh.map
        nearby = [min(g, twin(g)) for h in touched if m.origin[h] >= 0 for g in (*m.face(h), h)]
        after = self.certified.after()
        try:
            flips = flip_until_greedy(self.certified.mesh, after, list(dict.fromkeys(nearby)))
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.log.stats.flips += 1
            self.log.record("diagonal", (old,), (new,))
            self.certified.recertify([h for h in changed if m.origin[h] >= 0])
        if self.certified.table.angles:
            raise RebuildNeeded

    def _edge(self, u: VertexId, v: VertexId) -> HalfEdge | None:
        m = self.certified.mesh.map
        for h in m.star(self.certified.mesh.ring_edge[u]):
            if m.origin[h ^ 1] == v:
                return h
        return None

    def _remove_diagonal(self, u: VertexId, v: VertexId, predicates: OneSided) -> None:
        """Replace a diagonal, which now has the largest theta, by its shadow edge."""
        h = self._edge(u, v)
        if h is None:
            self._require_check_around(u)
        elif not self.certified.mesh.is_hull(h):
            visits = shadow(self.certified.mesh, h, predicates)
            if visits is None:
                raise RebuildNeeded
            self._flip(h, visits, predicates)

    def _insert_bitangent(self, u: VertexId, v: VertexId, predicates: OneSided) -> None:
        """Replace a diagonal by its shadow edge uv, which now has the smallest theta."""
        if self._edge(u, v) is not None:
            return  # on the convex hull
        mesh = self.certified.mesh
        origin = mesh.map.origin
        g = facing_visit(mesh, mesh.map.star(mesh.ring_edge[u]), v, predicates)
        for h in [] if g is None else self._crossed_by(g, v, predicates):
            visits = shadow(mesh, h, predicates)
            if visits is not None and {origin[visits[0]], origin[visits[1]]} == {u, v}:
                self._flip(h, visits, predicates)
                return
        self._require_check_around(u)

    def _crossed_by(self, g: HalfEdge, v: VertexId, predicates: OneSided) -> list[HalfEdge]:
        """Return the diagonals of g's tile that a bitangent from g's origin to v may replace.

        It crosses such a diagonal into a tile with vertex v, or shares an end with it.
        """
        mesh = self.certified.mesh
        m = mesh.map
        u = m.origin[g]
        crossed, meeting = list[HalfEdge](), list[HalfEdge]()
        for h in m.face(g):
            if mesh.is_flippable(h):
                a, b = m.origin[h], m.origin[h ^ 1]
                if u in (a, b) or v in (a, b):
                    meeting.append(h)
                elif _is_visited(mesh, v, twin(h)) and crosses(u, v, a, b, predicates):
                    crossed.append(h)
        return crossed + meeting

    def _require_check_around(self, u: VertexId) -> None:
        """Leave a pair to the check of the failure group, which flips until the tiling is greedy.

        If several pairs on one vertical line are exchanged one by one, a diagonal may be missing
        that an earlier exchange should have inserted, or may have been inserted too early. By
        Lemma 4.2 it is sufficient that the check examines every diagonal s whose shadow edge s'
        may have a smaller theta now. It examines changed tiles. If the tiles of s have not
        changed, theta(s) < theta(s') just before now, and as the two cross, one of them is
        vertical now: a pair (u, v) that is exchanged. If this is s, it has been flipped. If it is
        s' (or its successor on the same line), u is a vertex of a tile of s, so s is an edge of
        a tile at u, and these are examined too.
        """
        mesh = self.certified.mesh
        self.certified.failure_group.require_check(mesh.map.star(mesh.ring_edge[u]))

    def _flip(self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge], predicates: OneSided) -> None:
        old = self.certified.mesh.ends(h)
        new = (self.certified.mesh.map.origin[visits[0]], self.certified.mesh.map.origin[visits[1]])
        changed = flip(self.certified.mesh, h, visits, predicates)
        self.log.record("diagonal", (old,), (new,))
        self.certified.recertify(changed)

    def turns_reflex(self, h: HalfEdge) -> None:
        """See `Rules.turns_reflex`: not allowed, since the bodies must stay convex."""
        vertex = self.certified.vertices.all[self.certified.mesh.map.origin[h]]
        body = self.certified.vertices.bodies[vertex.body].body
        raise AuditError(
            f"body {shorten(body.name)}: stops being convex at vertex {vertex.index}, "
            f"t = {float(self.certified.certifier.exact_now)}: "
            "this greedy tiling is for bodies that stay convex"
        )


def _is_only_translated(body: Body, t: QQ) -> bool:
    """Return True if a body keeps its shape and its directions from a time on."""
    piece = body.exact_piece_after(t)
    return piece.until is None and piece.translation is not None


def _is_visited(mesh: Mesh, v: VertexId, h: HalfEdge) -> bool:
    """Return True if a vertex is on the boundary of the face of a half-edge."""
    origin = mesh.map.origin
    for g in mesh.map.face(h):  # noqa: SIM110 - called at many events
        if origin[g] == v:
            return True
    return False
