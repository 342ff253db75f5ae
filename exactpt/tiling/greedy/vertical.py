"""The vertical decomposition of the plane around convex bodies, static and kinetic.

From the leftmost and the rightmost vertex of every body a wall runs up and down to the
next body. An *arc* is such an extreme: ``2 * body`` is the left one, ``2 * body + 1``
the right one. A *cell* lies between two walls, below one body and above another.

A diagonal s of the greedy pseudo-triangulation is flipped when s, or its shadow edge,
becomes vertical (paper, section 4.2). A free bitangent that becomes vertical touches both
its bodies at extremes which see each other vertically: they are the left and the right arc
of one cell, which collapses. So the decomposition replaces the shadow edges of 2k diagonals,
with six certificates each and events that change nothing. It has at most 3k + 1 cells with
one linear certificate each, x(left arc) < x(right arc), which fails only where a bitangent
is flipped. Which vertex of a body is its leftmost or rightmost changes where an edge of the
body becomes vertical: never in a translation, in other motions by a certificate of its own,
whose event changes the vertex of an arc and no cell.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, Final, final

from librt.vecs import append, pop, vec
from mypy_extensions import i64

from exactpt.certificates.at_time import PredicatesAt, sorted_by_x
from exactpt.indices import NO_VERTEX, VertexId, vertex_vec
from exactpt.kernel.budget import check_budget
from exactpt.kernel.stored import Stored
from exactpt.tiling.greedy.convex_ring import Chain, chains_of, is_above

NO_ARC: Final = -1
NO_CELL: Final = -1


@final
class VerticalDecomposition:
    """Cells and the arcs that bound them.

    Attributes:
        vertex: for each arc, the extreme vertex.
        left, right: for each cell, the arcs at its ends; `NO_ARC` at infinity.
        left_up, left_down, right_up, right_down: for each arc, the cell on that side of
            its wall, above or below its vertex. Left of a left extreme both are the same
            cell, as are those right of a right extreme.
    """

    def __init__(self, bodies: int) -> None:
        arcs = 2 * bodies
        self.vertex: vec[VertexId] = vertex_vec([NO_VERTEX] * arcs)
        self.left: vec[i64] = vec[i64]()
        self.right: vec[i64] = vec[i64]()
        self.left_up: vec[i64] = vec[i64]([NO_CELL] * arcs)
        self.left_down: vec[i64] = vec[i64]([NO_CELL] * arcs)
        self.right_up: vec[i64] = vec[i64]([NO_CELL] * arcs)
        self.right_down: vec[i64] = vec[i64]([NO_CELL] * arcs)

    def copy(self) -> VerticalDecomposition:
        """Return an independent copy."""
        other = VerticalDecomposition(0)
        other.vertex = self.vertex[:]
        other.left, other.right = self.left[:], self.right[:]
        other.left_up, other.left_down = self.left_up[:], self.left_down[:]
        other.right_up, other.right_down = self.right_up[:], self.right_down[:]
        return other

    def state(self) -> dict[str, list[Any]]:
        """Return the cells and arcs, as a JSON object."""
        return {
            "vertex": list(self.vertex),
            "left": list(self.left),
            "right": list(self.right),
            "left_up": list(self.left_up),
            "left_down": list(self.left_down),
            "right_up": list(self.right_up),
            "right_down": list(self.right_down),
        }

    def resume(self, state: Stored, bodies: int, vertices: int) -> None:
        """Restore these cells and arcs.

        Args:
            state: what `state` returned.
            bodies: the number of bodies, each of which has two arcs.
            vertices: the number of vertex ids.

        Raises:
            InputError: if the lists do not belong together, or an entry is out of range.
        """
        arcs = 2 * bodies
        self.vertex = vertex_vec(
            map(VertexId, state["vertex"].integers(0, vertices - 1, length=arcs))
        )
        self.left = vec[i64](state["left"].integers(NO_ARC, arcs - 1))
        cells = len(self.left)
        self.right = vec[i64](state["right"].integers(NO_ARC, arcs - 1, length=cells))

        def cells_beside(name: str) -> vec[i64]:
            return vec[i64](state[name].integers(0, cells - 1, length=arcs))

        self.left_up, self.left_down = cells_beside("left_up"), cells_beside("left_down")
        self.right_up, self.right_down = cells_beside("right_up"), cells_beside("right_down")

    def add_cell(self, left: int) -> int:
        """Add a cell with an arc at its left end, and none yet at its right end; returns it."""
        self.left = append(self.left, left)
        self.right = append(self.right, NO_ARC)
        return len(self.left) - 1

    def remove_cell(self) -> None:
        """Remove the last cell."""
        self.left, _ = pop(self.left)
        self.right, _ = pop(self.right)

    def add_arc(self, v: VertexId) -> None:
        """Add an arc with its extreme vertex, and no cells yet."""
        self.vertex = append(self.vertex, v)
        self.left_up, self.left_down = (
            append(self.left_up, NO_CELL),
            append(self.left_down, NO_CELL),
        )
        self.right_up = append(self.right_up, NO_CELL)
        self.right_down = append(self.right_down, NO_CELL)

    def remove_arc(self, arc: int) -> None:
        """Remove an arc; the last one takes over its number, but the cells keep it."""
        self.vertex[arc] = self.vertex[-1]
        self.left_up[arc], self.left_down[arc] = self.left_up[-1], self.left_down[-1]
        self.right_up[arc], self.right_down[arc] = self.right_up[-1], self.right_down[-1]
        self.vertex, _ = pop(self.vertex)
        self.left_up, _ = pop(self.left_up)
        self.left_down, _ = pop(self.left_down)
        self.right_up, _ = pop(self.right_up)
        self.right_down, _ = pop(self.right_down)

    def cells_of(self, arc: int) -> set[i64]:
        """Return the cells on both sides of the wall of an arc."""
        return {
            self.left_up[arc],
            self.left_down[arc],
            self.right_up[arc],
            self.right_down[arc],
        }

    def swap(self, cell: int, *, left_is_lower: bool) -> tuple[int, int]:
        """Exchange the two arcs of a collapsing cell.

        With l the lower and r the upper of the two vertices, and l on the left before:

                 |              |                 The cell between them (right above l,
          A      |r      =>  A  |r     B          left below r) is replaced by the one
              g  |              | g               left above l and right below r; the
            |l   B            . |l  .             cells A (left above l) and B (right
            |                   |                 below r) now reach r and l.

        The other case is the mirror image, with up and down exchanged.

        Returns:
            A and B.
        """
        l, r = self.left[cell], self.right[cell]
        # "Up" for l is "down" for r.
        a = self.left_up[l] if left_is_lower else self.left_down[l]
        b = self.right_down[r] if left_is_lower else self.right_up[r]
        self._replace_left(r, cell, a)
        self._replace_right(l, cell, b)
        self._replace_left(l, a, cell)
        self._replace_right(r, b, cell)
        self.right[a], self.left[b] = r, l
        self.left[cell], self.right[cell] = r, l
        return a, b

    def _replace_left(self, arc: i64, old: i64, new: i64) -> None:
        """Replace a cell on the left of a wall, in its upper and its lower half."""
        if self.left_up[arc] == old:
            self.left_up[arc] = new
        if self.left_down[arc] == old:
            self.left_down[arc] = new

    def _replace_right(self, arc: i64, old: i64, new: i64) -> None:
        """As `_replace_left`, on the right."""
        if self.right_up[arc] == old:
            self.right_up[arc] = new
        if self.right_down[arc] == old:
            self.right_down[arc] = new

    @classmethod
    def at(cls, instant: PredicatesAt) -> VerticalDecomposition:
        """Return the decomposition just after an instant: a sweep from left to right.

        O(k log n) comparisons of positions for k bodies with n vertices.
        """
        vertices = instant.vertices
        self = cls(len(vertices.bodies))
        lower: list[Chain] = []
        for i, body in enumerate(vertices.bodies):
            chain, _ = chains_of(instant, body.ring)
            lower.append(chain)
            self.vertex[2 * i], self.vertex[2 * i + 1] = chain.ends
        arc_of = {v: arc for arc, v in enumerate(self.vertex)}
        active: list[int] = []  # bodies on the sweep line, from bottom to top
        gaps = [self.add_cell(NO_ARC)]  # the cells between them
        for v in sorted_by_x(instant, list(self.vertex)):
            check_budget()
            arc = arc_of[v]
            own = arc >> 1
            at = bisect_left(
                active, 1, key=lambda i: i != own and not is_above(instant, lower[i], v)
            )
            if arc % 2 == 0:
                gaps[at : at + 1] = self._open(arc, gaps[at])
                active.insert(at, own)
            else:
                at -= 1
                gaps[at : at + 2] = [self._close(arc, gaps[at], gaps[at + 1])]
                del active[at]
        return self

    def _open(self, arc: int, cell: int) -> list[int]:
        """End a cell at a left extreme; the cells below and above its body begin there."""
        self.right[cell] = arc
        below, above = self.add_cell(arc), self.add_cell(arc)
        self.left_up[arc] = self.left_down[arc] = cell
        self.right_down[arc], self.right_up[arc] = below, above
        return [below, above]

    def _close(self, arc: int, below: int, above: int) -> int:
        """End the cells below and above a body at its right extreme; one cell begins there."""
        self.right[below] = self.right[above] = arc
        cell = self.add_cell(arc)
        self.left_down[arc], self.left_up[arc] = below, above
        self.right_up[arc] = self.right_down[arc] = cell
        return cell
