"""The fan triangulation (paper, section 3.4), and how often it changes.

Every point p is joined to all of its chain C(p), ends included: a triangulation. It needs no
structure of its own, since its edges are read off the two trees.
"""

from __future__ import annotations

from collections.abc import Iterator

from exactpt.tiling.incremental.structure import Exchanged, IncrementalStructure
from exactpt.tiling.incremental.tree import TangentTree

__all__ = ["chain", "changes_of_exchange", "fan_edges", "path"]


def path(v: int, tree: TangentTree) -> Iterator[int]:
    """From v always to the last child."""
    while v >= 0:
        yield v
        v = tree.last[v]


def chain(structure: IncrementalStructure, p: int) -> list[int]:
    """C(p) from u(p) to d(p); of a point on one line with all those left of it, just that end.

    Args:
        structure: the structure.
        p: not the first point.
    """
    upper, lower = structure.trees
    above = [upper.parent[p], *path(upper.before[p], upper)]
    below = [lower.parent[p], *path(lower.before[p], lower)]
    return above + below[-2::-1]


def fan_edges(structure: IncrementalStructure) -> Iterator[tuple[int, int]]:
    """The edges of the fan triangulation, each once, with the right end first."""
    for p in structure.order[1:]:
        for z in chain(structure, p):
            yield p, z


def changes_of_exchange(structure: IncrementalStructure, exchanged: Exchanged, q: int) -> int:
    """How many edges an exchange has removed and added.

    With K the chain that p and q see, p was joined to K from u(p) to r, and q from r to d(q).
    Now q has come before p, and the border between them has moved along K from r to r'.

    Args:
        structure: after the exchange.
        exchanged: what it has changed.
        q: the point that has come before the other.
    """
    if exchanged.end < 0:
        return 0
    point = structure.order[structure.rank[q] - 1]
    tree, other = structure.trees[exchanged.side], structure.trees[1 - exchanged.side]
    return 2 * (
        _depth_below(tree, exchanged.end, point) + _depth_below(other, exchanged.old, point)
    )


def _depth_below(tree: TangentTree, z: int, v: int) -> int:
    """How far v hangs below z."""
    depth = 0
    while v != z:
        v = tree.parent[v]
        depth += 1
    return depth
