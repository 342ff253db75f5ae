"""The certificates of the vertical decomposition.

A cell is valid as long as its left extreme vertex is left of its right one; an extreme
vertex is valid as long as it is extreme compared with both neighbours on its ring.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.certificate import CELL, EXTREME, pack
from exactpt.certificates.coincidence import coordinate_order
from exactpt.certificates.one_sided import OneSided
from exactpt.indices import CertificateId, Ends, VertexId
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.greedy import cell_updates
from exactpt.tiling.greedy.convex_ring import chains_of, is_above
from exactpt.tiling.greedy.vertical import NO_ARC, VerticalDecomposition
from exactpt.tiling.greedy.visibility import seen_from


@final
class CertifiedCells:
    """The vertical decomposition just after the current time, with its certificates.

    Attributes:
        now: the decomposition.
        violated: the cells whose certificate is violated just after now.
        violated_extremes: the same for extreme vertices; the certificate of an arc with the
            neighbour ahead is twice the arc, with the neighbour behind one more.
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

    def _certify_x_order(self, certificate: CertificateId, a: VertexId, b: VertexId) -> bool:
        """Certify that a is left of b; returns whether it is so just after now."""
        if self._certified.certifier.keeps_x_order(a, b):
            self._certified.certifier.skipped += 1
            self._certified.table.pending.cancel(certificate)
            # An order that cannot change may be wrong in the midst of simultaneous repairs.
            return not self._certified.checks_rigid or self._certified.after().left_of(a, b)
        table = self._certified.table
        if table.watch_x_order(certificate, a, b) < 0:
            table.pending.cancel(certificate)
            return False
        return True

    def _certify_extremes(self, i: int) -> None:
        for arc in (2 * i, 2 * i + 1):
            self.certify_extreme(2 * arc)
            self.certify_extreme(2 * arc + 1)

    def certify_extreme(self, handle: int) -> None:
        """Certify that an extreme vertex is extreme compared with one neighbour on its ring.

        Args:
            handle: twice the arc, plus 1 for the neighbour behind.
        """
        certificate = pack(EXTREME, handle)
        self.violated_extremes.discard(handle)
        a, b = self.extreme_pair(handle)
        if not self._certify_x_order(certificate, a, b):
            self.violated_extremes.add(handle)

    def certify_body(self, i: int) -> None:
        """Certify again what depends on the motion of a body."""
        self._certify_extremes(i)
        for arc in (2 * i, 2 * i + 1):
            for cell in sorted(self.now.cells_of(arc)):
                self.certify(cell)

    def is_rising(self, left: VertexId, right: VertexId) -> bool:
        """Return True if, of two vertices of equal x, the right one just before is the upper."""
        u, v = self._certified.vertices.all[left], self._certified.vertices.all[right]
        return coordinate_order(self._certified.certifier, u, v, 1) > 0

    def pair(self, cell: int) -> Ends:
        """Return the extreme vertices at the left and the right end of a cell."""
        vertex = self.now.vertex
        return vertex[self.now.left[cell]], vertex[self.now.right[cell]]

    def extreme_pair(self, handle: int) -> Ends:
        """Return an extreme vertex and its neighbour on the ring, in their certified x-order."""
        arc = handle >> 1
        vertices, v = self._certified.vertices, self.now.vertex[arc]
        neighbour = vertices.behind(v) if handle % 2 else vertices.ahead(v)
        return (v, neighbour) if arc % 2 == 0 else (neighbour, v)

    def enter(self, i: int) -> None:
        """Insert a new body into the decomposition."""
        after = self._certified.after()
        chain, _ = chains_of(after, self._certified.vertices.bodies[i].ring)
        changed = cell_updates.add_body(
            self.now,
            after,
            chain.ends,
            self._cell_around(chain.vertex(0), after),
            lambda v: is_above(after, chain, v),
        )
        self._certify_extremes(i)
        for cell in changed:
            self.certify(cell)

    def _cell_around(self, v: VertexId, after: OneSided) -> int:
        """Return the cell that contains a vertex, above the body below it or the converse."""
        for up in (False, True):
            h = seen_from(self._certified.mesh, after, v, up=up)
            if h is not None:
                arc = 2 * self._certified.vertices.all[self._certified.mesh.map.origin[h]].body
                row = self.now.right_down if up else self.now.right_up
                return cell_updates.cell_along(self.now, after, v, row[arc], over=not up)
        return cell_updates.cell_along(
            self.now, after, v, list(self.now.left).index(NO_ARC), over=True
        )

    def leave(self, i: int) -> None:
        """Remove a body from the decomposition; the last body takes over its number."""
        last = len(self._certified.vertices.bodies) - 1
        changed, spare = cell_updates.remove_body(self.now, self._certified.after(), i)
        for k in range(4):
            self._certified.table.move(pack(EXTREME, 4 * last + k), pack(EXTREME, 4 * i + k))
        cell_updates.rename_body(self.now, last, i)
        for cell in sorted(spare, reverse=True):
            old = cell_updates.rename_cell(self.now, cell)
            self._certified.table.move(pack(CELL, old), pack(CELL, cell))
            changed = [cell if c == old else c for c in changed]
        for cell in changed:
            self.certify(cell)
