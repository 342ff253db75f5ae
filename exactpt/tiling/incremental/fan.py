"""The fan triangulation (paper, section 3.4), and how often it changes.

Every point p is joined to all vertices of its chain C(p), ends included; the result is a
triangulation. Its edges are derived from the two trees.
"""

from __future__ import annotations

from collections.abc import Iterator

from exactpt.indices import Ends, VertexId
from exactpt.tiling.incremental.structure import Exchanged, IncrementalStructure
from exactpt.tiling.incremental.tree import TangentTree

__all__ = ["chain", "changes_of_exchange", "fan_edges", "path"]


def path(v: VertexId, tree: TangentTree) -> Iterator[VertexId]:
    """The path from v that always continues to the last child."""
    while v >= 0:
        yield v
        v = tree.last[v]


def chain(structure: IncrementalStructure, p: VertexId) -> list[VertexId]:
    """C(p) from u(p) to d(p); only u(p) = d(p) if p is collinear with all points left of it.

    Args:
        structure: the structure.
        p: a point other than the first.
    """
    upper, lower = structure.trees
    above = [upper.parent[p], *path(upper.before[p], upper)]
    below = [lower.parent[p], *path(lower.before[p], lower)]
    return above + below[-2::-1]


def fan_edges(structure: IncrementalStructure) -> Iterator[Ends]:
    """The edges of the fan triangulation, each once, with the right end first."""
    for p in structure.order[1:]:
        for z in chain(structure, p):
            yield p, z


def changes_of_exchange(structure: IncrementalStructure, exchanged: Exchanged, q: VertexId) -> int:
    """The number of edges that an exchange has removed and added.

    With K the chain that p and q see, p was joined to K from u(p) to r, and q from r to d(q).
    Now q comes before p, and the vertex that separates their parts has moved along K from r
    to r'.

    Args:
        structure: the structure after the exchange.
        exchanged: the changes of the exchange.
        q: the point that comes first now.
    """
    if exchanged.end < 0:
        return 0
    point = structure.order[structure.rank[q] - 1]
    tree, other = structure.trees[exchanged.side], structure.trees[1 - exchanged.side]
    return 2 * (
        _depth_below(tree, exchanged.end, point) + _depth_below(other, exchanged.old, point)
    )


def _depth_below(tree: TangentTree, z: VertexId, v: VertexId) -> int:
    """The depth of v in the subtree of z."""
    depth = 0
    while v != z:
        v = tree.parent[v]
        depth += 1
    return depth
