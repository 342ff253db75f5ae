"""The kinetic greedy vertical pseudo-triangulation of convex bodies (paper, section 4.2).

Corners and bends are repaired as in any tiling; of two diagonals that become one line
the one with the larger theta gives way. Diagonals that become vertical, and bitangents
that do and so become the smallest of all, are found by the vertical decomposition.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import CELL, kind_of, part_of
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import crosses, facing_visit, flip, flip_until_greedy, shadow
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.greedy.certified_cells import CertifiedCells
from exactpt.tiling.greedy.sweep import greedy_diagonals
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.repairs import RebuildNeeded
from exactpt.tiling.rules import Rules
from exactpt.tiling.tiling import State

__all__ = ["VerticalRules", "greedy_mesh"]


def greedy_mesh(instant: PredicatesAt, cells: VerticalDecomposition) -> tuple[Mesh, int]:
    """The greedy tiling, and how many flips were needed after the sweep.

    None, unless the sweep met two bitangents on one line; then these are checked. Uses up the
    vertical decomposition.
    """
    diagonals, tied = greedy_diagonals(instant, cells)
    mesh = build_mesh(instant, diagonals)
    doubtful = [h for h in mesh.diagonals() if edge_key(*mesh.ends(h)) in tied] if tied else []
    flips = flip_until_greedy(mesh, instant, doubtful)
    return mesh, len(flips)


@final
class VerticalRules(Rules):
    """The canonical tiling of convex bodies: at any time the one that the sweep builds.

    Attributes:
        cells: the vertical decomposition, with its certificates.
    """

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        super().__init__(certified, log)
        self.cells: CertifiedCells = CertifiedCells(certified)

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """The greedy tiling of an instant."""
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
        if static.vertex != self.cells.now.vertex:
            raise AuditError(f"t = {instant.time}: other extreme vertices than the static ones")
        pairs = [sorted(zip(c.left, c.right, strict=True)) for c in (self.cells.now, static)]
        if pairs[0] != pairs[1]:
            raise AuditError(
                f"t = {instant.time}: another vertical decomposition than the static one"
            )

    def state(self) -> State:
        """See `Rules.state`."""
        return {"cells": self.cells.now.state()}

    def resume(self, state: State) -> None:
        """See `Rules.resume`."""
        self.cells.now.resume(state["cells"])

    def certify(self) -> None:
        """See `Rules.certify`."""
        self.cells.certify_everything()

    def certify_body(self, i: int) -> None:
        """See `Rules.certify_body`."""
        self.cells.certify_body(i)

    # Bodies that come and go

    def allows_plan(self, body: Body, t: QQ) -> bool:
        """See `Rules.allows_plan`: it must stay convex."""
        alone = Vertices.of([body], t, self.certified.certifier.end)
        return not alone.bodies[0].is_tiled

    def allows_body(self, body: Body, t: QQ) -> bool:
        """See `Rules.allows_body`: it must stay convex."""
        alone = Vertices.of([body], t, self.certified.certifier.end)
        return PredicatesAt(alone, t).all_stay_convex()

    def enter(self, i: int) -> None:
        """See `Rules.enter`."""
        self.cells.enter(i)

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        self.cells.leave(i)

    def failed(self, certificates: list[int]) -> None:
        """See `Rules.failed`."""
        for certificate in certificates:
            if kind_of(certificate) == CELL:
                self.cells.certify(part_of(certificate))
            else:
                self.cells.certify_extreme(part_of(certificate))
        # In the plane turned by rho (`exactpt.certificates.perturbation`, step 1) x is x - rho y.
        # Two vertices l and r that exchange their order now, l the left one before, do so
        # when x(r) - x(l) has fallen to rho (y(r) - y(l)): before now, and so before the
        # angles that fail now, if r is the upper one; after them if l is.
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
            self._pass_vertical(min(self.cells.violated), after)

    def _repair_rising(self) -> None:
        """Exchange the pairs that do so just before now."""
        before = OneSided(self.certified.certifier, before=True)
        rising = True
        while rising:
            rising = False
            for handle in sorted(self.cells.violated_extremes):
                if self.cells.is_rising(*self.cells.extreme_pair(handle)):
                    self.certified.batch.begin_repair()
                    self._move_extreme(handle)
                    rising = True
                    break
            for cell in sorted(self.cells.violated):
                if self.cells.is_rising(*self.cells.pair(cell)):
                    self.certified.batch.begin_repair()
                    self._pass_vertical(cell, before)
                    rising = True
                    break

    def _move_extreme(self, handle: int) -> None:
        arc = handle >> 1
        vertex = self.certified.vertices.all[self.cells.now.vertex[arc]]
        self.cells.now.vertex[arc] = vertex.behind if handle % 2 else vertex.ahead
        self.log.stats.count("internal")
        self.cells.certify_extreme(2 * arc)
        self.cells.certify_extreme(2 * arc + 1)
        for cell in sorted(self.cells.now.cells_of(arc)):
            self.cells.certify(cell)

    def _pass_vertical(self, cell: int, moment: OneSided) -> None:
        """The two arcs of a cell exchange their order: their bitangent is vertical now."""
        self.cells.violated.discard(cell)
        u, v = self.cells.pair(cell)
        rising = self.cells.is_rising(u, v)
        a, b = self.cells.now.swap(cell, left_is_lower=rising)
        for touched in sorted({cell, a, b}):
            self.cells.certify(touched)
        # Rising from the left one to the right one, it goes from the smallest theta to the
        # largest; falling, from the largest to the smallest.
        if rising:
            self._leave(u, v, moment)
        else:
            self._enter(u, v, moment)

    def check(self, touched: list[int]) -> None:
        """See `Rules.check`."""
        m = self.certified.mesh.map
        nearby = [g for h in touched if m.origin[h] >= 0 for g in (*m.face(h), h)]
        after = self.certified.after()
        try:
            flips = flip_until_greedy(self.certified.mesh, after, nearby)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.log.stats.flips += 1
            self.log.record("diagonal", (old,), (new,))
            self.certified.recertify([h for h in changed if m.origin[h] >= 0])
        if self.certified.table.angles:
            raise RebuildNeeded

    def _edge(self, u: int, v: int) -> int | None:
        m = self.certified.mesh.map
        return next((h for h in m.fan(self.certified.mesh.ring_edge[u]) if m.target(h) == v), None)

    def _leave(self, u: int, v: int, moment: OneSided) -> None:
        """A diagonal has become the one of largest theta: its shadow takes its place."""
        h = self._edge(u, v)
        if h is None:
            self._doubt_around(u)
        elif not self.certified.mesh.is_hull(h):
            visits = shadow(self.certified.mesh, h, moment)
            if visits is None:
                raise RebuildNeeded
            self._flip(h, visits, moment)

    def _enter(self, u: int, v: int, moment: OneSided) -> None:
        """A bitangent has become the one of smallest theta: it replaces its diagonal."""
        if self._edge(u, v) is not None:
            return  # on the convex hull
        m = self.certified.mesh.map
        around = m.fan(self.certified.mesh.ring_edge[u])
        g = facing_visit(self.certified.mesh, around, v, moment)
        tile = [] if g is None else [h for h in m.face(g) if self.certified.mesh.is_flippable(h)]
        # It crosses its diagonal into the tile across, which v is in; or both share an end.
        meeting = [
            h for h in tile if u in self.certified.mesh.ends(h) or v in self.certified.mesh.ends(h)
        ]
        crossed = [
            h
            for h in tile
            if h not in meeting
            and v in [m.origin[e] for e in m.face(h ^ 1)]
            and crosses(u, v, *self.certified.mesh.ends(h), moment)
        ]
        for h in (*crossed, *meeting):
            visits = shadow(self.certified.mesh, h, moment)
            if visits is not None and {m.origin[visits[0]], m.origin[visits[1]]} == {u, v}:
                self._flip(h, visits, moment)
                return
        self._doubt_around(u)

    def _doubt_around(self, u: int) -> None:
        """Leave a pair to the check of the batch, which flips until the tiling is greedy.

        Of several pairs on one vertical line the exchanges, one by one, may find a diagonal that
        an earlier one should have made, or one that it has made too soon. By Lemma 4.2 it is
        enough if the check looks at every diagonal s that its shadow s' may have passed. Tiles
        changed now are looked at. If those of s are as they were, theta(s) was less than
        theta(s') just before now, and as the two cross, one of them is vertical now: a pair
        (u, v) that is exchanged. If it is s, s was there and has been flipped. If it is s' (or
        what s' has become, on the same line), u is in a tile of s: s is an edge of a tile at u.
        """
        mesh = self.certified.mesh
        self.certified.batch.doubt(mesh.map.fan(mesh.ring_edge[u]))

    def _flip(self, h: int, visits: tuple[int, int], moment: OneSided) -> None:
        old = self.certified.mesh.ends(h)
        new = (self.certified.mesh.map.origin[visits[0]], self.certified.mesh.map.origin[visits[1]])
        changed = flip(self.certified.mesh, h, visits, moment)
        self.log.record("diagonal", (old,), (new,))
        self.certified.recertify(changed)

    def turns_reflex(self, h: int) -> None:
        """See `Rules.turns_reflex`: none may."""
        vertex = self.certified.vertices.all[self.certified.mesh.map.origin[h]]
        body = self.certified.vertices.bodies[vertex.body].body
        raise AuditError(
            f"body {body.name!r}: stops being convex at vertex {vertex.index}, "
            f"t = {float(self.certified.certifier.exact_now)}: "
            "this greedy tiling is for bodies that stay so"
        )
