"""The kinetic greedy vertical pseudo-triangulation of convex bodies (paper, section 4.2).

Corners and bends are repaired as in any tiling; of two diagonals that become one line
the one with the larger theta gives way. Diagonals that become vertical, and bitangents
that do and so become the smallest of all, are found by the vertical decomposition.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import CELL, EXTREME, kind_of, pack, part_of
from exactpt.certificates.coincidence import coordinate_order
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import crosses, facing_visit, flip, flip_until_greedy, shadow
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.greedy import cells
from exactpt.tiling.greedy.sweep import greedy_diagonals
from exactpt.tiling.greedy.vertical import NO_ARC, VerticalDecomposition, is_above, lower_chain
from exactpt.tiling.greedy.vertical_view import seen_from
from exactpt.tiling.populated import PopulatedTiling
from exactpt.tiling.repairs import RebuildNeeded

__all__ = ["GreedyTiling", "greedy_mesh"]


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
class GreedyTiling(PopulatedTiling):
    """The canonical tiling of convex bodies: at any time the one that the sweep builds.

    Attributes:
        cells: the vertical decomposition.
    """

    name = "greedy"
    cells: VerticalDecomposition

    def _build(self, time: QQ) -> None:
        instant = PredicatesAt(self.vertices, time, exact_only=self.certifier.exact_only)
        self.cells = VerticalDecomposition.at(instant)
        self.mesh, flips = greedy_mesh(instant, self.cells.copy())
        self.stats.flips += flips

    def _close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        super()._close(mesh, instant)
        flip_until_greedy(mesh, instant, mesh.diagonals())

    @classmethod
    def mesh_at(cls, instant: PredicatesAt) -> Mesh:
        """The greedy tiling of an instant."""
        return greedy_mesh(instant, VerticalDecomposition.at(instant))[0]

    def _clear_notes(self) -> None:
        self._due_cells: set[int] = set()
        self._due_extremes: set[int] = set()

    def _certify_everything(self) -> None:
        self._clear_notes()
        super()._certify_everything()
        for cell in range(len(self.cells.left)):
            self._certify_cell(cell)
        for i in range(len(self.vertices.bodies)):
            self._certify_extremes(i)

    # Certificates of the vertical decomposition

    def _certify_cell(self, cell: int) -> None:
        slot = pack(CELL, cell)
        self._due_cells.discard(cell)
        left, right = self.cells.left[cell], self.cells.right[cell]
        if NO_ARC in (left, right) or left >> 1 == right >> 1:
            self.queue.cancel(slot)
            return
        a, b = self._cell_pair(cell)
        if not self._certify_x_order(slot, a, b):
            self._due_cells.add(cell)

    def _certify_x_order(self, slot: int, a: int, b: int) -> bool:
        """Certify that a is left of b; whether it is so just after now."""
        if self.certifier.keeps_x_order(a, b):
            self.certifier.skipped += 1
            self.queue.cancel(slot)
            # What is kept may be wrong only in the midst of simultaneous events.
            return not self._careful or OneSided(self.certifier, before=False).left_of(a, b)
        s, time = self.certifier.x_order(a, b)
        if s < 0 or time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)
        return s > 0

    def _certify_extremes(self, i: int) -> None:
        for arc in (2 * i, 2 * i + 1):
            self._certify_extreme(2 * arc)
            self._certify_extreme(2 * arc + 1)

    def _certify_extreme(self, handle: int) -> None:
        """Certify that an extreme vertex is so against one neighbour on its ring.

        Args:
            handle: twice the arc, plus 1 for the neighbour behind.
        """
        slot = pack(EXTREME, handle)
        self._due_extremes.discard(handle)
        a, b = self._extreme_pair(handle)
        if not self._certify_x_order(slot, a, b):
            self._due_extremes.add(handle)

    def _certify_body(self, i: int) -> list[int]:
        vanishing = super()._certify_body(i)
        self._certify_extremes(i)
        for arc in (2 * i, 2 * i + 1):
            for cell in sorted(self.cells.cells_of(arc)):
                self._certify_cell(cell)
        return vanishing

    # Bodies that come and go

    def takes(self, body: Body, t: QQ) -> bool:
        """Whether a body can be added at a time: if it is convex from then on."""
        alone = Vertices.of([body], t, self.certifier.end)
        return PredicatesAt(alone, t).all_stay_convex()

    def _enter_body(self, i: int) -> None:
        after = OneSided(self.certifier, before=False)
        chain = lower_chain(after, self.vertices.bodies[i].ring)
        changed = cells.add_body(
            self.cells,
            after,
            (chain[0], chain[-1]),
            self._cell_around(chain[0], after),
            lambda v: is_above(after, chain, v),
        )
        self._certify_extremes(i)
        for cell in changed:
            self._certify_cell(cell)

    def _cell_around(self, v: int, after: OneSided) -> int:
        """The cell that a vertex which bounds none is in: over what it sees below, or under."""
        for up in (False, True):
            h = seen_from(self.mesh, after, v, up=up)
            if h is not None:
                arc = 2 * self.vertices.all[self.mesh.map.origin[h]].body
                row = self.cells.right_down if up else self.cells.right_up
                return cells.cell_along(self.cells, after, v, row[arc], over=not up)
        return cells.cell_along(self.cells, after, v, self.cells.left.index(NO_ARC), over=True)

    def _leave_body(self, i: int) -> None:
        last = len(self.vertices.bodies) - 1
        changed, spare = cells.remove_body(self.cells, OneSided(self.certifier, before=False), i)
        for k in range(4):
            self._move_slot(pack(EXTREME, 4 * last + k), pack(EXTREME, 4 * i + k))
        cells.rename_body(self.cells, last, i)
        for cell in sorted(spare, reverse=True):
            old = cells.rename_cell(self.cells, cell)
            self._move_slot(pack(CELL, old), pack(CELL, cell))
            changed = [cell if c == old else c for c in changed]
        for cell in changed:
            self._certify_cell(cell)

    def _recheck(self, slots: list[int]) -> None:
        for slot in slots:
            if kind_of(slot) == CELL:
                self._certify_cell(part_of(slot))
            else:
                self._certify_extreme(part_of(slot))
        # In the plane turned by rho (`exactpt.certificates.perturbation`, step 1) x is x - rho y.
        # Two vertices l and r that exchange their order now, l the left one before, do so
        # when x(r) - x(l) has fallen to rho (y(r) - y(l)): before now, and so before the
        # angles that fail now, if r is the upper one; after them if l is.
        self._repair_rising()

    # Repairs

    def _has_more(self) -> bool:
        return bool(self._due_extremes or self._due_cells)

    def _repair_more(self) -> None:
        after = OneSided(self.certifier, before=False)
        if self._due_extremes:
            self._move_extreme(min(self._due_extremes))
        else:
            self._pass_vertical(min(self._due_cells), after)

    def _repair_rising(self) -> None:
        """Exchange the pairs that do so just before now."""
        before = OneSided(self.certifier, before=True)
        rising = True
        while rising:
            rising = False
            for handle in sorted(self._due_extremes):
                if self._is_rising(*self._extreme_pair(handle)):
                    self._batch.begin_repair()
                    self._move_extreme(handle)
                    rising = True
                    break
            for cell in sorted(self._due_cells):
                if self._is_rising(*self._cell_pair(cell)):
                    self._batch.begin_repair()
                    self._pass_vertical(cell, before)
                    rising = True
                    break

    def _is_rising(self, left: int, right: int) -> bool:
        u, v = self.vertices.all[left], self.vertices.all[right]
        return coordinate_order(self.certifier, u, v, 1) > 0

    def _cell_pair(self, cell: int) -> tuple[int, int]:
        vertex = self.cells.vertex
        return vertex[self.cells.left[cell]], vertex[self.cells.right[cell]]

    def _extreme_pair(self, handle: int) -> tuple[int, int]:
        """An extreme vertex and its neighbour on the ring, as they should be from left to right."""
        arc = handle >> 1
        vertex = self.vertices.all[self.cells.vertex[arc]]
        neighbour = vertex.behind if handle % 2 else vertex.ahead
        return (vertex.id, neighbour) if arc % 2 == 0 else (neighbour, vertex.id)

    def _move_extreme(self, handle: int) -> None:
        arc = handle >> 1
        vertex = self.vertices.all[self.cells.vertex[arc]]
        self.cells.vertex[arc] = vertex.behind if handle % 2 else vertex.ahead
        self.stats.count("internal")
        self._certify_extreme(2 * arc)
        self._certify_extreme(2 * arc + 1)
        for cell in sorted(self.cells.cells_of(arc)):
            self._certify_cell(cell)

    def _pass_vertical(self, cell: int, moment: OneSided) -> None:
        """The two arcs of a cell exchange their order: their bitangent is vertical now."""
        self._due_cells.discard(cell)
        u, v = self._cell_pair(cell)
        rising = self._is_rising(u, v)
        a, b = self.cells.swap(cell, left_is_lower=rising)
        for touched in sorted({cell, a, b}):
            self._certify_cell(touched)
        # Rising from the left one to the right one, it goes from the smallest theta to the
        # largest; falling, from the largest to the smallest.
        if rising:
            self._leave(u, v, moment)
        else:
            self._enter(u, v, moment)

    def _check_batch(self, touched: list[int]) -> None:
        super()._check_batch(touched)
        m = self.mesh.map
        nearby = [g for h in touched if m.origin[h] >= 0 for g in (*m.face(h), h)]
        after = OneSided(self.certifier, before=False)
        try:
            flips = flip_until_greedy(self.mesh, after, nearby)
        except AuditError:
            raise RebuildNeeded from None
        for old, new, changed in flips:
            self.stats.flips += 1
            self._record("diagonal", (old,), (new,))
            self._recertify([h for h in changed if m.origin[h] >= 0])
        if self._due:
            raise RebuildNeeded

    def _edge(self, u: int, v: int) -> int | None:
        m = self.mesh.map
        return next((h for h in m.fan(self.mesh.ring_edge[u]) if m.target(h) == v), None)

    def _leave(self, u: int, v: int, moment: OneSided) -> None:
        """A diagonal has become the one of largest theta: its shadow takes its place."""
        h = self._edge(u, v)
        if h is None:
            raise RebuildNeeded
        if not self.mesh.is_hull(h):
            visits = shadow(self.mesh, h, moment)
            if visits is None:
                raise RebuildNeeded
            self._flip(h, visits, moment)

    def _enter(self, u: int, v: int, moment: OneSided) -> None:
        """A bitangent has become the one of smallest theta: it replaces its diagonal."""
        if self._edge(u, v) is not None:
            return  # on the convex hull
        m = self.mesh.map
        around = m.fan(self.mesh.ring_edge[u])
        g = facing_visit(self.mesh, around, v, moment)
        tile = [] if g is None else [h for h in m.face(g) if self.mesh.is_flippable(h)]
        # It crosses its diagonal into the tile across, which v is in; or both share an end.
        meeting = [h for h in tile if u in self.mesh.ends(h) or v in self.mesh.ends(h)]
        crossed = [
            h
            for h in tile
            if h not in meeting
            and v in [m.origin[e] for e in m.face(h ^ 1)]
            and crosses(u, v, *self.mesh.ends(h), moment)
        ]
        for h in (*crossed, *meeting):
            visits = shadow(self.mesh, h, moment)
            if visits is not None and {m.origin[visits[0]], m.origin[visits[1]]} == {u, v}:
                self._flip(h, visits, moment)
                return
        raise RebuildNeeded

    def _flip(self, h: int, visits: tuple[int, int], moment: OneSided) -> None:
        old = self.mesh.ends(h)
        new = (self.mesh.map.origin[visits[0]], self.mesh.map.origin[visits[1]])
        changed = flip(self.mesh, h, visits, moment)
        self._record("diagonal", (old,), (new,))
        self._recertify(changed)

    def _repair_convex_vertex(self, h: int, kind: str) -> None:  # noqa: ARG002
        vertex = self.vertices.all[self.mesh.map.origin[h]]
        body = self.vertices.bodies[vertex.body].body
        raise AuditError(
            f"body {body.name!r}: stops being convex at vertex {vertex.index}, "
            f"t = {float(self.now)}: this greedy tiling is for bodies that stay so"
        )
