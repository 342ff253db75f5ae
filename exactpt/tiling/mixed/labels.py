"""Labels: which geodesics run along a half-edge.

The label of a half-edge h is the set of tree nodes whose geodesic traverses h in its
direction. All belong to one polygon, the one on the left, and they are a path in its tree
of ancestors: from bot, the deepest, up to top. (Geodesics of nested chains that share an
edge share it with all in between.) The tiling of F1 is told by its labels alone:

* A labelled half-edge whose bot is a leaf is an edge of the polygon; else the tile on its
  left belongs to bot: it lies between the geodesic of bot and those of its children.
* Left of an unlabelled half-edge whose twin is labelled is the tile of the parent of the
  twin's top; if top is the unpinned cycle, what is outside all relative hulls: F2.
* If neither is labelled, it is an edge of F2 (or of the convex hull there).
"""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias, final

from exactpt.motion.vertices import Vertices
from exactpt.tiling.mixed.tree import GeodesicTree, tree_of_size

__all__ = ["NO_LABEL", "BodyTree", "Forest", "Label", "TileOf"]

Label: TypeAlias = frozenset[int]
"""Nodes, numbered through all bodies."""

NO_LABEL: Final[Label] = frozenset()


class TileOf(NamedTuple):
    """Where a tile is: in F1, the body and the depth of its node; body -1 in F2."""

    body: int
    depth: int


F2: Final = TileOf(-1, 0)


class BodyTree(NamedTuple):
    """The tree of one body.

    Attributes:
        tree: its shape; shared by all polygons of one size.
        first: the number of its `TOP` among the nodes of all bodies.
        chain: the ring from the vertex that is vertex 0 of the tree on, which is again the
            last: n + 1 vertices.
    """

    tree: GeodesicTree
    first: int
    chain: list[int]


@final
class Forest:
    """The trees of all bodies, with their nodes numbered through.

    Attributes:
        bodies: of each body, its tree.
        parent, depth: of each node; the parent of a `TOP` is -1.
        body: of each node, whose it is.
        leaves: the nodes that are leaves.
        pinned: of each vertex, the nodes whose geodesic ends there and may run through it
            all the same: the root, at vertex 0, if the unpinned cycle does not end there.
    """

    def __init__(self, vertices: Vertices, starts: list[int]) -> None:
        self.bodies: list[BodyTree] = []
        self.parent: list[int] = []
        self.depth: list[int] = []
        self.body: list[int] = []
        self.leaves: set[int] = set()
        self.pinned: dict[int, int] = {}
        for i, moving in enumerate(vertices.bodies):
            ring, n = moving.ring, len(moving.ring)
            tree = tree_of_size(n)
            first = len(self.parent)
            chain = [ring[(starts[i] + j) % n] for j in range(n + 1)]
            self.bodies.append(BodyTree(tree, first, chain))
            self.parent += [p + first if p >= 0 else -1 for p in tree.parent]
            self.depth += tree.depth
            self.body += [i] * len(tree)
            self.leaves.update(first + leaf for leaf in tree.leaf)
            self.pinned[chain[0]] = first + 1

    def bot(self, label: Label) -> int:
        """The deepest node of a label."""
        return max(label, key=self.depth.__getitem__)

    def top(self, label: Label) -> int:
        """The highest node of a label."""
        return min(label, key=self.depth.__getitem__)

    def tile(self, label: Label, twin: Label) -> TileOf | None:
        """What is on the left of a half-edge with these labels; None inside a body."""
        if label:
            node = self.bot(label)
            return None if node in self.leaves else TileOf(self.body[node], self.depth[node])
        if twin:
            node = self.parent[self.top(twin)]
            return F2 if node < 0 else TileOf(self.body[node], self.depth[node])
        return F2
