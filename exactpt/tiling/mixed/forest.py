"""The trees of all rings, and labels: sets of their nodes."""

from __future__ import annotations

from collections.abc import Sequence, Set
from typing import Final, NamedTuple, TypeAlias, final

from exactpt.indices import VertexId
from exactpt.motion.vertices import MovingBody, Vertices
from exactpt.tiling.mixed.tree import ROOT, TOP, GeodesicTree, tree_of_size

Label: TypeAlias = frozenset[int]
"""A set of nodes; the nodes of all rings are numbered consecutively, two for each vertex."""

NO_LABEL: Final[Label] = frozenset()


class RingTree(NamedTuple):
    """The tree of one ring, an outline or a hole.

    Attributes:
        tree: its shape, shared by all rings of one size.
        nodes: for each node of the tree, its number among the nodes of all rings.
        chain: the ring with its first vertex repeated: the vertices 0 to n of the tree.
        is_hole: whether the free space that it borders is inside it.
    """

    tree: GeodesicTree
    nodes: list[int]
    chain: list[VertexId]
    is_hole: bool


@final
class Forest:
    """The trees of all rings, with consecutive numbers for their nodes.

    A ring of n vertices has a tree of 2 n nodes. So each vertex id stands for two numbers,
    which are reused when the id is.

    Attributes:
        vertices: the moving vertices.
        bodies: for each body, the trees of its rings.
        parent, depth: for each node, its parent (-1 for a `TOP`) and its depth.
        leaves: the nodes that are leaves.
        pinned: for vertex 0 of each ring, the root, whose loop passes it and is pinned there.
    """

    def __init__(self, vertices: Vertices) -> None:
        self.vertices = vertices
        self.bodies: list[list[RingTree]] = []
        self.parent: list[int] = []
        self.depth: list[int] = []
        self.leaves: set[int] = set()
        self.pinned: dict[VertexId, Label] = {}
        for moving in vertices.bodies:
            self.add(moving)

    def add(self, moving: MovingBody) -> list[RingTree]:
        """Add the trees of a new body, the last one."""
        is_hole = [k > 0 for rings in moving.body.parts for k in range(len(rings))]
        trees = [self._grow(*ring) for ring in zip(moving.rings, is_hole, strict=True)]
        self.bodies.append(trees)
        return trees

    def _grow(self, ring: Sequence[VertexId], is_hole: bool) -> RingTree:  # noqa: FBT001
        tree = tree_of_size(len(ring))
        nodes = [2 * v + side for v in ring for side in (0, 1)]
        missing = 2 * len(self.vertices.all) - len(self.parent)
        self.parent += [-1] * missing
        self.depth += [0] * missing
        for node, parent, depth in zip(nodes, tree.parent, tree.depth, strict=True):
            self.parent[node] = nodes[parent] if parent >= 0 else -1
            self.depth[node] = depth
        self.leaves.update(nodes[leaf] for leaf in tree.leaf)
        self.pinned[ring[0]] = frozenset((nodes[ROOT],))
        return RingTree(tree, nodes, [*ring, ring[0]], is_hole)

    def remove(self, i: int) -> None:
        """Remove the trees of a body; the last body takes over its number."""
        removed, last = self.bodies[i], self.bodies.pop()
        if i < len(self.bodies):
            self.bodies[i] = last
        for tree in removed:
            self.leaves.difference_update(tree.nodes)
            del self.pinned[tree.chain[0]]

    def body(self, node: int) -> int:
        """Return the number of the body to which a node belongs."""
        return self.vertices.all[VertexId(node >> 1)].body

    def has_hole(self, nodes: Set[int]) -> bool:
        """Return True if some of these nodes, which include their ancestors, are of a hole."""
        bodies = {self.body(node) for node in nodes}
        trees = (tree for i in bodies for tree in self.bodies[i] if tree.is_hole)
        return any(tree.nodes[TOP] in nodes for tree in trees)

    def bot(self, label: Label) -> int:
        """Return the deepest node of a label."""
        return max(label, key=self.depth.__getitem__)

    def top(self, label: Label) -> int:
        """Return the highest node of a label."""
        return min(label, key=self.depth.__getitem__)

    def is_path(self, label: Label) -> bool:
        """Return True if a label is a path of ancestors."""
        return not label or (
            self.depth[self.bot(label)] - self.depth[self.top(label)] + 1 == len(label)
            and all(self.parent[v] in label for v in label if v != self.top(label))
        )

    def node(self, label: Label, twin: Label) -> int:
        """Return the node whose tile is on the left of a half-edge with these labels; -1 in F2."""
        if label:
            return self.bot(label)
        return self.parent[self.top(twin)] if twin else -1
