"""The greedy vertical pseudo-triangulation of convex bodies, by a rotational sweep.

The direction of the decomposition is rotated clockwise by pi from the vertical. A cell ends
exactly at a greedy bitangent, which is a wall from then on. O(k log k) steps and O(k)
bitangents, each found by O(log^2 n) orientations for bodies of n vertices.

Source: the paper, section 4.1, after M. Pocchiola, G. Vegter, *Topologically sweeping
visibility complexes via pseudo-triangulations*, DCG 16 (1996); the rules for the cells
were derived for exactpt and are checked against the definition in the tests.
"""

from __future__ import annotations

from typing import Final, final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import AuditError
from exactpt.indices import Ends, VertexId
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.mesh import Diagonal
from exactpt.tiling.greedy.bitangent import Bitangent, tangent_pair
from exactpt.tiling.greedy.convex_ring import Chain, chains_of, near_tangent
from exactpt.tiling.greedy.vertical import NO_ARC, NO_CELL, VerticalDecomposition

FEW: Final = 16
"""Number of bitangents from one look at the budget to the next."""
MANY: Final = 48
"""Number of vertices of two bodies from which on their bitangent is searched by bisection."""

WIDTH: Final[i64] = 5
"""Number of integers of a bitangent in the rows of a sweep."""


def greedy_diagonals(
    instant: PredicatesAt, decomposition: VerticalDecomposition
) -> tuple[list[Diagonal], set[Ends]]:
    """Return the 3k - 3 bitangents of the pseudo-triangulation, each directed from left to right.

    The second result is the set of the ends of bitangents that share a line. Their
    order is that of the perturbation, and the caller may check them: the result is greedy for
    the order of the sweep, so a bitangent whose shadow edge has smaller theta shares a line
    with it. The order of parallel bitangents on different lines does not matter: either order
    results if the bodies are moved a little, and nothing else changes.

    Args:
        instant: the predicates.
        decomposition: the vertical decomposition of the instant; it is used up.

    Raises:
        AuditError: if the number of bitangents is not 3k - 3.
    """
    sweep = _Sweep(instant, decomposition)
    found = sweep.run()
    k = len(instant.vertices.bodies)
    if len(found) != max(3 * k - 3, 0):
        raise AuditError(f"{len(found)} greedy bitangents of {k} bodies, not {3 * k - 3}")
    return found, sweep.tied


@final
class _Sweep:
    """The sweep over a decomposition; bitangents are rows of numbers, the next one on a heap.

    Two are compared as objects only if their keys are equal.
    """

    def __init__(self, instant: PredicatesAt, cells: VerticalDecomposition) -> None:
        self.instant = instant
        self.cells = cells
        self.dead: vec[bool] = vec[bool]([False] * len(cells.left))
        # Of each bitangent: its ends, the cell in which it was found, and the arcs of that cell.
        self._rows: vec[i64] = vec[i64]()
        self._made: dict[i64, Bitangent] = {}
        self._heap_key: vec[float] = vec[float]()
        self._heap: vec[i64] = vec[i64]()
        self._heap_size: i64 = 0
        self.tied: set[Ends] = set()
        self._chains: dict[int, tuple[Chain, Chain]] = {}
        self._sizes: list[int] = [len(body.ring) for body in instant.vertices.bodies]
        self._all_are_small: bool = 2 * max(self._sizes, default=0) <= MANY

    def run(self) -> list[Diagonal]:
        found: list[Diagonal] = []
        cells = self.cells
        for cell in range(len(cells.left)):
            self._push(cell)
        previous: i64 = -1
        previous_key = 0.0
        on_line: dict[QQ, Diagonal] = {}  # of the bitangents parallel to the previous one
        popped: i64 = 0
        while self._heap_size:
            if popped % FEW == 0:
                check_budget()
            popped += 1
            key, number = self._heap_key[0], self._heap[0]
            self._pop()
            rows, at = self._rows, WIDTH * number
            cell, x, y = rows[at + 2], rows[at + 3], rows[at + 4]
            if (
                self.dead[cell]
                or cells.left[cell] != x
                or cells.right[cell] != y
                or not self._is_ready(cell)
            ):
                continue
            found.append(Diagonal(VertexId(rows[at]), VertexId(rows[at + 1])))
            if previous >= 0 and key == previous_key and self._are_parallel(previous, number, key):
                on_line.setdefault(self._bitangent(previous, key).offset(), found[-2])
                other = on_line.setdefault(self._bitangent(number, key).offset(), found[-1])
                if other is not found[-1]:
                    self.tied |= {edge_key(d.u, d.v) for d in (other, found[-1])}
            else:
                on_line.clear()
            previous, previous_key = number, key
            self._pass(cell, x, y)
        return found

    def _are_parallel(self, s: i64, t: i64, key: float) -> bool:
        """Return True if two bitangents with one key are parallel at the instant."""
        return self._bitangent(s, key).is_parallel(self._bitangent(t, key))

    def _bitangent(self, number: i64, key: float) -> Bitangent:
        """Return a bitangent as an object."""
        made = self._made.get(number)
        if made is None:
            rows, at = self._rows, WIDTH * number
            ends = VertexId(rows[at]), VertexId(rows[at + 1])
            sides = _sides(rows[at + 3], rows[at + 4])
            made = self._made[number] = Bitangent(self.instant, ends, sides, key, number)
        return made

    # The heap: the comparisons are those of ``heapq``, so that counts of decisions are too.

    def _is_before(self, key: float, s: i64, other_key: float, t: i64) -> bool:
        """Return True if the sweep reaches bitangent s before t."""
        if key != other_key:
            return key < other_key
        return self._bitangent(s, key) < self._bitangent(t, key)

    def _rise(self, key: float, number: i64, n: i64) -> None:
        """Put a bitangent into place n of the heap, or above."""
        keys, heap = self._heap_key, self._heap
        while n > 0:
            up = (n - 1) >> 1
            if not self._is_before(key, number, keys[up], heap[up]):
                break
            keys[n], heap[n] = keys[up], heap[up]
            n = up
        keys[n], heap[n] = key, number

    def _pop(self) -> None:
        """Remove the first bitangent from the heap."""
        keys, heap, n = self._heap_key, self._heap, self._heap_size - 1
        self._heap_size = n
        key, number = keys[n], heap[n]
        i: i64 = 0
        j: i64 = 1
        while j < n:
            right = j + 1
            if right < n and not self._is_before(keys[j], heap[j], keys[right], heap[right]):
                j = right
            keys[i], heap[i] = keys[j], heap[j]
            i = j
            j = 2 * i + 1
        if n > 0:
            self._rise(key, number, i)

    def _is_ready(self, cell: int) -> bool:
        """Return True if only its two arcs bound the cell, so that it ends at their bitangent."""
        cells = self.cells
        x, y = cells.left[cell], cells.right[cell]
        if NO_ARC in (x, y) or x >> 1 == y >> 1:
            return False
        return (cells.right_up[x] == cell or (x % 2 == 1 and cells.right_down[x] == cell)) and (
            cells.left_down[y] == cell or (y % 2 == 0 and cells.left_up[y] == cell)
        )

    def _push(self, cell: int) -> None:
        if cell == NO_CELL or self.dead[cell] or not self._is_ready(cell):
            return
        x, y = self.cells.left[cell], self.cells.right[cell]
        side_x, side_y = _sides(x, y)
        a, b = self._near_tangent(x, y, side_x, side_y)
        a, b = tangent_pair(self.instant, a, b, side_x, side_y)
        if not self.instant.left_of(a, b):
            return
        key, number, n = self.instant.descent(a, b), len(self._rows) // WIDTH, self._heap_size
        self._rows = append(append(append(self._rows, a), b), cell)
        self._rows = append(append(self._rows, x), y)
        if n == len(self._heap):
            self._heap_key, self._heap = append(self._heap_key, key), append(self._heap, number)
        self._heap_size = n + 1
        self._rise(key, number, n)

    def _near_tangent(self, x: int, y: int, side_x: int, side_y: int) -> Ends:
        """Return vertices of the bodies of two arcs from which `tangent_pair` is not far.

        Those of the arcs, if the bodies have few vertices.
        """
        if self._all_are_small or self._sizes[x >> 1] + self._sizes[y >> 1] <= MANY:
            return self.cells.vertex[x], self.cells.vertex[y]
        a, b = self._chain(x, side_x), self._chain(y, side_y)
        return near_tangent(self.instant, a, b, side_x, side_y)

    def _ring(self, arc: int) -> list[VertexId]:
        return self.instant.vertices.bodies[arc >> 1].ring

    def _chain(self, arc: int, side: int) -> Chain:
        """Return the lower (1) or upper (-1) chain of the body of an arc."""
        pair = self._chains.get(arc >> 1)
        if pair is None:
            pair = self._chains[arc >> 1] = chains_of(self.instant, self._ring(arc))
        return pair[0] if side > 0 else pair[1]

    def _pass(self, cell: int, x: int, y: int) -> None:
        """Pass the bitangent of arcs x and y, where their cell ends.

        The cell on the left above x is now left of y, the cell on the right below y is right
        of x; the cells below x and above y, if any, continue along the new wall.
        """
        c = self.cells
        self.dead[cell] = True
        new_left, new_right = c.left_up[x], c.right_down[y]
        below = c.right_down[x] if x % 2 == 0 else NO_CELL
        above = c.left_up[y] if y % 2 == 1 else NO_CELL
        c.left_down[y] = new_left
        if y % 2 == 0:
            c.left_up[y] = new_left
        c.right_up[x] = new_right
        if x % 2 == 1:
            c.right_down[x] = new_right
        c.right_down[y] = below
        if y % 2 == 1:
            c.right_up[y] = c.left_up[y] = NO_CELL
        c.left_up[x] = above
        if x % 2 == 0:
            c.left_down[x] = c.right_down[x] = NO_CELL
        if new_left != NO_CELL:
            c.right[new_left] = y
        if new_right != NO_CELL:
            c.left[new_right] = x
        if below != NO_CELL:
            c.left[below] = y
        if above != NO_CELL:
            c.right[above] = x
        for touched in (new_left, new_right, below, above):
            self._push(touched)


def _sides(x: i64, y: i64) -> tuple[int, int]:
    """Return the sides of the bitangent of a left and a right arc, see `tangent_pair`.

    The line passes a left arc with the body on its right, a right arc on its left.
    """
    return (-1 if x % 2 == 0 else 1), (-1 if y % 2 == 0 else 1)
