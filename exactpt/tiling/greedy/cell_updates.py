"""Insertion and removal of bodies in the vertical decomposition, cell by cell.

   | T0 |   T1  |              A body between the walls of its left extreme l and its
 --l----+-------r--     =>     right extreme r, with a row of cells above it and a row
L  |  S0   | S1 | R            below it. When it is removed, the walls that ended on it
                               are extended, and the two rows merge, from L to R.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cmp_to_key
from itertools import pairwise

from exactpt.certificates.predicates import Predicates
from exactpt.indices import Ends, VertexId
from exactpt.tiling.greedy.vertical import NO_ARC, VerticalDecomposition


def cell_along(
    cells: VerticalDecomposition, predicates: Predicates, v: VertexId, cell: int, *, over: bool
) -> int:
    """Return the cell of a row that contains a vertex.

    Args:
        cells: the decomposition.
        predicates: the predicates of the time.
        v: a vertex above the row's body (or below it), not left of the first cell.
        cell: the first cell of the row.
        over: whether the row lies above its body.
    """
    step = cells.right_down if over else cells.right_up
    while (arc := cells.right[cell]) != NO_ARC and predicates.left_of(cells.vertex[arc], v):
        cell = step[arc]
    return cell


def add_body(
    cells: VerticalDecomposition,
    predicates: Predicates,
    extremes: Ends,
    first: int,
    is_above: Callable[[VertexId], bool],
) -> list[int]:
    """Add a convex body as the last one.

    Args:
        cells: the decomposition.
        predicates: the predicates of the time.
        extremes: the leftmost and the rightmost vertex of the body.
        first: the cell that contains the leftmost vertex.
        is_above: whether a vertex between the extremes is above the body.

    Returns:
        The cells that are new or have a new end.
    """
    l = len(cells.vertex)
    r = l + 1
    for v in extremes:
        cells.add_arc(v)
    row, tops, bottoms = _crossed(cells, predicates, first, extremes[1], is_above)
    spare = row[1:-1][::-1]
    if len(row) > 1:
        last = row[-1]
    else:
        last = cells.add_cell(NO_ARC)
        _take_right_end(cells, first, last)
    rows = [
        [spare.pop() if spare else cells.add_cell(NO_ARC) for _ in [l, *w]] for w in (tops, bottoms)
    ]
    _link_row(cells, rows[0], [l, *tops, r], from_above=True)
    _link_row(cells, rows[1], [l, *bottoms, r], from_above=False)
    cells.left_up[l] = cells.left_down[l] = first
    cells.right_up[r] = cells.right_down[r] = last
    cells.right[first], cells.left[last] = l, r
    return [first, *rows[0], *rows[1], last]


def _crossed(
    cells: VerticalDecomposition,
    predicates: Predicates,
    first: int,
    last: VertexId,
    is_above: Callable[[VertexId], bool],
) -> tuple[list[int], list[int], list[int]]:
    """Return the cells that a new body crosses, and the arcs above and below it."""
    row, tops, bottoms = [first], list[int](), list[int]()
    while (arc := cells.right[row[-1]]) != NO_ARC and predicates.left_of(cells.vertex[arc], last):
        above = is_above(cells.vertex[arc])
        (tops if above else bottoms).append(arc)
        row.append((cells.right_down if above else cells.right_up)[arc])
    return row, tops, bottoms


def remove_body(
    cells: VerticalDecomposition, predicates: Predicates, i: int
) -> tuple[list[int], list[int]]:
    """Remove a body from the cells; its arcs remain, until `rename_body` drops them.

    Returns:
        The cells that have a new end, and the cells that are unused now.
    """
    l, r = 2 * i, 2 * i + 1
    first, last = cells.left_up[l], cells.right_up[r]
    walls: dict[int, bool] = {}
    spare: list[int] = []
    for above, step in ((True, cells.right_down), (False, cells.right_up)):
        cell = cells.right_up[l] if above else cells.right_down[l]
        spare.append(cell)
        while (arc := cells.right[cell]) != r:
            walls[arc] = above
            cell = step[arc]
            spare.append(cell)
    if not walls:
        _take_right_end(cells, last, first)
        return [first], [*spare, last]

    def order(a: int, b: int) -> int:
        return -1 if predicates.left_of(cells.vertex[a], cells.vertex[b]) else 1

    row = sorted(walls, key=cmp_to_key(order))
    inner = [spare.pop() for _ in row[1:]]
    for (before, after), arc in zip(pairwise([first, *inner, last]), row, strict=True):
        _link_wall(cells, arc, before, after, from_above=walls[arc])
    return [first, *inner, last], spare


def rename_body(cells: VerticalDecomposition, old: int, new: int) -> None:
    """Give the last body the number of a removed one, whose arcs are dropped."""
    for side in (0, 1):
        a, b = 2 * old + side, 2 * new + side
        if a != b:
            for cell in cells.cells_of(a):
                if cells.left[cell] == a:
                    cells.left[cell] = b
                if cells.right[cell] == a:
                    cells.right[cell] = b
    for side in (1, 0):
        cells.remove_arc(2 * new + side)


def rename_cell(cells: VerticalDecomposition, new: int) -> int:
    """Give the last cell the number of an unused one; returns its old number."""
    old = len(cells.left) - 1
    if old != new:
        cells.left[new], cells.right[new] = cells.left[old], cells.right[old]
        for of_arc in (cells.left_up, cells.left_down, cells.right_up, cells.right_down):
            for arc in (cells.left[new], cells.right[new]):
                if arc != NO_ARC and of_arc[arc] == old:
                    of_arc[arc] = new
    cells.remove_cell()
    return old


def _take_right_end(cells: VerticalDecomposition, old: int, new: int) -> None:
    """Let cell ``new`` end on the right where cell ``old`` has ended."""
    arc = cells.right[new] = cells.right[old]
    if arc != NO_ARC:
        for of_arc in (cells.left_up, cells.left_down):
            if of_arc[arc] == old:
                of_arc[arc] = new


def _link_row(
    cells: VerticalDecomposition, row: list[int], arcs: list[int], *, from_above: bool
) -> None:
    """Link a row of cells above a body (or below it) with the walls between them."""
    l, *walls, r = arcs
    for (before, after), arc in zip(pairwise(row), walls, strict=True):
        _link_wall(cells, arc, before, after, from_above=from_above)
    cells.left[row[0]], cells.right[row[-1]] = l, r
    (cells.right_up if from_above else cells.right_down)[l] = row[0]
    (cells.left_up if from_above else cells.left_down)[r] = row[-1]


def _link_wall(
    cells: VerticalDecomposition, arc: int, before: int, after: int, *, from_above: bool
) -> None:
    """Make the wall that runs down from an arc (or up) the one between two cells."""
    cells.right[before] = cells.left[after] = arc
    if from_above or arc % 2 == 0:
        cells.left_down[arc] = before
    if not from_above or arc % 2 == 0:
        cells.left_up[arc] = before
    if from_above or arc % 2 == 1:
        cells.right_down[arc] = after
    if not from_above or arc % 2 == 1:
        cells.right_up[arc] = after
