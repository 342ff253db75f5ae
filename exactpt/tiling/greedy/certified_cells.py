"""The certificates of the vertical decomposition: what is violated, what may be.

A cell is there while its left extreme vertex is left of its right one; an extreme vertex
is one while it is so against both its neighbours on the ring.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.certificate import CELL, EXTREME, pack
from exactpt.certificates.coincidence import coordinate_order
from exactpt.certificates.one_sided import OneSided
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.greedy import cells
from exactpt.tiling.greedy.vertical import NO_ARC, VerticalDecomposition, is_above, lower_chain
from exactpt.tiling.greedy.vertical_view import seen_from

__all__ = ["CertifiedCells"]


@final
class CertifiedCells:
    """The vertical decomposition just after the current time, with its certificates.

    Attributes:
        now: the decomposition.
        violated: the cells whose certificate is violated just after now.
        violated_extremes: the same of extreme vertices, each as twice the arc, plus 1 for the
            neighbour behind.
    """

    def __init__(self, certified: CertifiedMesh) -> None:
        self.now: VerticalDecomposition = VerticalDecomposition(0)
        self._certified: CertifiedMesh = certified
        self.violated: set[int] = certified.table.violated[CELL]
        self.violated_extremes: set[int] = certified.table.violated[EXTREME]

    def certify_everything(self) -> None:
        """Certify all cells and extreme vertices."""
        self.violated.clear()
        self.violated_extremes.clear()
        for cell in range(len(self.now.left)):
            self.certify(cell)
        for i in range(len(self._certified.vertices.bodies)):
            self._certify_extremes(i)

    def certify(self, cell: int) -> None:
        """Certify that the left extreme vertex of a cell is left of its right one."""
        certificate = pack(CELL, cell)
        self.violated.discard(cell)
        left, right = self.now.left[cell], self.now.right[cell]
        if NO_ARC in (left, right) or left >> 1 == right >> 1:
            self._certified.table.pending.cancel(certificate)
            return
        a, b = self.pair(cell)
        if not self._certify_x_order(certificate, a, b):
            self.violated.add(cell)

    def _certify_x_order(self, certificate: int, a: int, b: int) -> bool:
        """Certify that a is left of b; whether it is so just after now."""
        if self._certified.certifier.keeps_x_order(a, b):
            self._certified.certifier.skipped += 1
            self._certified.table.pending.cancel(certificate)
            # What is kept may be wrong only in the midst of simultaneous events.
            return not self._certified.is_careful or self._certified.after().left_of(a, b)
        s, time = self._certified.certifier.x_order(a, b)
        self._certified.table.schedule(certificate, None if s < 0 else time)
        return s > 0

    def _certify_extremes(self, i: int) -> None:
        for arc in (2 * i, 2 * i + 1):
            self.certify_extreme(2 * arc)
            self.certify_extreme(2 * arc + 1)

    def certify_extreme(self, handle: int) -> None:
        """Certify that an extreme vertex is so against one neighbour on its ring.

        Args:
            handle: twice the arc, plus 1 for the neighbour behind.
        """
        certificate = pack(EXTREME, handle)
        self.violated_extremes.discard(handle)
        a, b = self.extreme_pair(handle)
        if not self._certify_x_order(certificate, a, b):
            self.violated_extremes.add(handle)

    def certify_body(self, i: int) -> None:
        """Certify anew what depends on a body."""
        self._certify_extremes(i)
        for arc in (2 * i, 2 * i + 1):
            for cell in sorted(self.now.cells_of(arc)):
                self.certify(cell)

    def is_rising(self, left: int, right: int) -> bool:
        """Whether the right one of two vertices on one vertical line is the upper one."""
        u, v = self._certified.vertices.all[left], self._certified.vertices.all[right]
        return coordinate_order(self._certified.certifier, u, v, 1) > 0

    def pair(self, cell: int) -> tuple[int, int]:
        """The extreme vertices at the left and the right end of a cell."""
        vertex = self.now.vertex
        return vertex[self.now.left[cell]], vertex[self.now.right[cell]]

    def extreme_pair(self, handle: int) -> tuple[int, int]:
        """An extreme vertex and its neighbour on the ring, as they should be from left to right."""
        arc = handle >> 1
        vertex = self._certified.vertices.all[self.now.vertex[arc]]
        neighbour = vertex.behind if handle % 2 else vertex.ahead
        return (vertex.id, neighbour) if arc % 2 == 0 else (neighbour, vertex.id)

    def enter(self, i: int) -> None:
        """Put a new body into the decomposition."""
        after = self._certified.after()
        chain = lower_chain(after, self._certified.vertices.bodies[i].ring)
        changed = cells.add_body(
            self.now,
            after,
            (chain[0], chain[-1]),
            self._cell_around(chain[0], after),
            lambda v: is_above(after, chain, v),
        )
        self._certify_extremes(i)
        for cell in changed:
            self.certify(cell)

    def _cell_around(self, v: int, after: OneSided) -> int:
        """The cell that a vertex which bounds none is in: over what it sees below, or under."""
        for up in (False, True):
            h = seen_from(self._certified.mesh, after, v, up=up)
            if h is not None:
                arc = 2 * self._certified.vertices.all[self._certified.mesh.map.origin[h]].body
                row = self.now.right_down if up else self.now.right_up
                return cells.cell_along(self.now, after, v, row[arc], over=not up)
        return cells.cell_along(self.now, after, v, self.now.left.index(NO_ARC), over=True)

    def leave(self, i: int) -> None:
        """Take a body out of the decomposition; the last one gets its number."""
        last = len(self._certified.vertices.bodies) - 1
        changed, spare = cells.remove_body(self.now, self._certified.after(), i)
        for k in range(4):
            self._certified.table.move(pack(EXTREME, 4 * last + k), pack(EXTREME, 4 * i + k))
        cells.rename_body(self.now, last, i)
        for cell in sorted(spare, reverse=True):
            old = cells.rename_cell(self.now, cell)
            self._certified.table.move(pack(CELL, old), pack(CELL, cell))
            changed = [cell if c == old else c for c in changed]
        for cell in changed:
            self.certify(cell)
