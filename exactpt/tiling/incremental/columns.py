"""Columns: points of equal x, sorted as a whole instead of by exchanges of pairs.

If k points of equal x change their order, up to k (k - 1) / 2 exchanges would be needed. But
only the points of the column are affected: a point to the right that hangs in the upper tree
on a point of the column hangs on the topmost one, which is on the upper hull of the column
and all points to its left, whatever the order within the column. So the sweep of the paper,
section 3.1, is run through the column alone, from the hull of the points to its left, which
is the path from the last of them to the root.

In the midst of other repairs of the same time the trees may be invalid. If the points to the
right would not keep their places, nothing is changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.coincidence import coordinate_order
from exactpt.certificates.predicates import Predicates
from exactpt.indices import VertexId
from exactpt.tiling.incremental.structure import IncrementalStructure
from exactpt.tiling.incremental.tree import NONE, TangentTree


class _Swept(NamedTuple):
    """The result of the sweep of a column in one tree.

    Attributes:
        parents: the new parent of each point of the column.
        hull: the points of the column on the hull after the sweep, from left to right.
        covered: the points left of the column that are on the hull before, but not after.
    """

    parents: dict[VertexId, VertexId]
    hull: list[VertexId]
    covered: list[VertexId]


def column_around(
    certifier: Certifier, structure: IncrementalStructure, p: VertexId
) -> tuple[int, int]:
    """Return the range of ranks, its end excluded, of the points with the x of p now."""
    order, rank, vertices = structure.order, structure.rank, certifier.all
    low = high = rank[p]
    while low > 0 and not coordinate_order(certifier, vertices[order[low - 1]], vertices[p], 0):
        low -= 1
    while high + 1 < len(order) and not coordinate_order(
        certifier, vertices[order[high + 1]], vertices[p], 0
    ):
        high += 1
    return low, high + 1


def resweep(
    structure: IncrementalStructure, column: Sequence[VertexId], predicates: Predicates
) -> tuple[set[VertexId], set[VertexId]] | None:
    """Reorder points that are consecutive in the x-order.

    Args:
        structure: the structure, changed in place.
        column: the points in their new order.
        predicates: the predicates of the time.

    Returns:
        For each tree, the right ends of the edges that may need new certificates. None if
        the rest of the structure does not allow the order, and nothing has changed.
    """
    order, rank = structure.order, structure.rank
    i = min(rank[p] for p in column)
    upper, lower = structure.trees
    before = order[i - 1] if i else NONE
    above = _sweep(upper, before, column, predicates, wanted=1)
    below = _sweep(lower, before, column, predicates, wanted=-1)
    end = i + len(column)
    if not (_fits(upper, above, rank, end) and _fits(lower, below, rank, end)):
        return None
    old = order[i:end]
    changed = _hang(upper, above, old, rank), _hang(lower, below, old, rank)
    order[i:end] = column
    for k, p in enumerate(column, i):
        rank[p] = k
    return changed


def _sweep(
    tree: TangentTree,
    before: VertexId,
    column: Sequence[VertexId],
    predicates: Predicates,
    *,
    wanted: int,
) -> _Swept:
    """Sweep through a column, without changing the tree.

    Args:
        tree: the upper or the lower tree.
        before: the last point left of the column.
        column: its points in their new order.
        predicates: the predicates of the time.
        wanted: the sign at a vertex of the hull that has to be popped.
    """
    parents: dict[VertexId, VertexId] = {}
    hull: list[VertexId] = []
    covered: list[VertexId] = []
    left = before
    for p in column:
        while True:
            last = hull[-1] if hull else left
            if len(hull) > 1:
                previous = hull[-2]
            else:
                previous = left if hull else tree.parent[left] if left >= 0 else NONE
            if previous < 0 or predicates.orientation(previous, last, p) != wanted:
                break
            if hull:
                hull.pop()
            else:
                covered.append(left)
                left = previous
        parents[p] = last
        hull.append(p)
    return _Swept(parents, hull, covered)


def _fits(tree: TangentTree, swept: _Swept, rank: list[int], end: int) -> bool:
    """Return True if the children right of a column still hang on the hull, in preorder."""
    if any(tree.last[z] >= 0 and rank[tree.last[z]] >= end for z in swept.covered):
        return False
    ranks = [rank[c] for z in reversed(swept.hull) for c in _later(tree, z, rank, end)]
    hidden = swept.parents.keys() - set(swept.hull)
    return all(a < b for a, b in pairwise(ranks)) and not any(
        _later(tree, z, rank, end) for z in hidden
    )


def _later(tree: TangentTree, z: VertexId, rank: list[int], end: int) -> list[VertexId]:
    """Return the children of a point that are right of its column, in x-order."""
    children = []
    c = tree.last[z]
    while c >= 0 and rank[c] >= end:
        children.append(c)
        c = tree.before[c]
    return children[::-1]


def _hang(tree: TangentTree, swept: _Swept, old: list[VertexId], rank: list[int]) -> set[VertexId]:
    """Hang the points of a column on their new parents; returns the changed edges.

    Args:
        tree: the upper or the lower tree.
        swept: the result of the sweep.
        old: the points in their old order.
        rank: the ranks before the change.
    """
    parents, end = swept.parents, rank[old[-1]] + 1
    changed = set(old)
    later = {z: _later(tree, z, rank, end) for z in old}
    for p in reversed(old):
        changed.add(tree.before[p])
        for c in reversed(later[p]):
            tree.detach(c)
        if tree.parent[p] >= 0:
            tree.detach(p)
    for p, z in parents.items():
        following = [] if z in parents or z < 0 else _later(tree, z, rank, end)
        if following:
            tree.insert_before(following[0], p)
        elif z >= 0:
            tree.append(z, p)
        changed.add(tree.before[p])
    for p, children in later.items():
        for c in children:
            tree.append(p, c)
            changed.add(c)
    return {c for c in changed if c >= 0}
