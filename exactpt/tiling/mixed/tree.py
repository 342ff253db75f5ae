"""The balanced tree over the vertices of a polygon; each node has a geodesic.

Node (a, b), 0 <= a < b <= n, has the geodesic from vertex a to vertex b along the
polygon; its children are (a, m) and (m, b), with m in the middle, where their geodesics are
pinned to the boundary and its own is not. The leaves are the edges. Above the root (0, n), a
loop pinned at vertex 0, is `TOP`, the unpinned cycle: the relative geodesic cycle of the
polygon. The shape depends on n alone and never changes.

Source: the paper, section 5.1, after J. Basch et al., *Kinetic collision detection for two
simple polygons*, CGTA 27 (2004).
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final, final

TOP: Final = 0
ROOT: Final = 1


@final
class GeodesicTree:
    """The tree over n vertices; nodes are numbered, parents before children.

    Attributes:
        size: n.
        low, high: for each node, its interval (a, b).
        parent: for each node, its parent; -1 for `TOP`.
        depth: for each node, its depth; 0 for `TOP`.
        child: for each node, the first of its two children, of which the second is the next node;
            -1 for `TOP` and for a leaf.
        leaf: for each edge, its node.
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self.low: list[int] = [0, 0]
        self.high: list[int] = [size, size]
        self.parent: list[int] = [-1, TOP]
        self.depth: list[int] = [0, 1]
        self.child: list[int] = [-1, -1]
        self.leaf: list[int] = [-1] * size
        node = ROOT
        while node < len(self.low):
            a, b = self.low[node], self.high[node]
            if b - a == 1:
                self.leaf[a] = node
            else:
                middle = (a + b) // 2
                self.child[node] = len(self.low)
                for low, high in ((a, middle), (middle, b)):
                    self.low.append(low)
                    self.high.append(high)
                    self.parent.append(node)
                    self.depth.append(self.depth[node] + 1)
                    self.child.append(-1)
            node += 1


@lru_cache(maxsize=256)
def tree_of_size(size: int) -> GeodesicTree:
    """Return the tree over this many vertices, built once and shared."""
    return GeodesicTree(size)
