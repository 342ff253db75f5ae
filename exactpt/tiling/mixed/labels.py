"""Labels: which geodesics run along a half-edge, and how repairs change that.

The label of a half-edge h is the set of tree nodes whose geodesic traverses h in its
direction. All belong to one polygon, the one on the left, and they are a path in its tree
of ancestors: from bot, the deepest, up to top. (Geodesics of nested chains that share an
edge share it with all in between.) The tiling of F1 is told by its labels alone:

* A labelled half-edge whose bot is a leaf is an edge of the polygon; else the tile on its
  left belongs to bot: it lies between the geodesic of bot and those of its children.
* Left of an unlabelled half-edge whose twin is labelled is the tile of the parent of the
  twin's top; if top is the unpinned cycle, what is outside all relative hulls: F2.
* If neither is labelled, it is an edge of F2 (or of the convex hull there).

Three vertices become collinear, the middle one m. If they were a corner with the edge xy,
m has come to lie on that edge, and its geodesics now run along xm and my. If they were a
bend at m, the geodesics through both edges lose their bend there and run along xy from now
on; but those that end at m keep it. (They are the nodes pinned at m, of which only the
root, a loop, runs through m too.) An edge that no geodesic needs any more gives way.

Source: the paper, section 5.2, worked out for all cases: shared edges, tails, and bends
of which neither edge or both edges give way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final, NamedTuple, TypeAlias, final

from exactpt.errors import AuditError
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import NOTHING
from exactpt.pseudotriangulation.mesh import F2, FREE, INSIDE, Mesh, Tile
from exactpt.tiling.mixed.loops import loop_along
from exactpt.tiling.mixed.tree import ROOT, TOP, GeodesicTree, tree_of_size

__all__ = ["NO_LABEL", "BodyTree", "Forest", "Label", "LabelledMesh"]

Label: TypeAlias = frozenset[int]
"""Nodes, numbered through all bodies: two for each vertex."""

NO_LABEL: Final[Label] = frozenset()


class BodyTree(NamedTuple):
    """The tree of one body.

    Attributes:
        tree: its shape; shared by all polygons of one size.
        nodes: of each node of the tree, its number among the nodes of all bodies.
        chain: the ring, and its first vertex again: the vertices 0 to n of the tree.
    """

    tree: GeodesicTree
    nodes: list[int]
    chain: list[int]


@final
class Forest:
    """The trees of all bodies, with their nodes numbered through.

    A ring of n vertices has a tree of 2 n nodes. So two numbers go with each vertex, and
    are used again with it.

    Attributes:
        vertices: of the bodies.
        bodies: of each body, its tree.
        parent, depth: of each node; the parent of a `TOP` is -1.
        leaves: the nodes that are leaves.
        pinned: of each vertex 0, the root, whose loop runs through it and is pinned there.
    """

    def __init__(self, vertices: Vertices) -> None:
        self.vertices = vertices
        self.bodies: list[BodyTree] = []
        self.parent: list[int] = []
        self.depth: list[int] = []
        self.leaves: set[int] = set()
        self.pinned: dict[int, Label] = {}
        for moving in vertices.bodies:
            self.add(moving.ring)

    def add(self, ring: Sequence[int]) -> BodyTree:
        """Add the tree of a body that has come as the last one."""
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
        self.bodies.append(BodyTree(tree, nodes, [*ring, ring[0]]))
        return self.bodies[-1]

    def remove(self, i: int) -> None:
        """Remove the tree of a body; the last body gets its number."""
        _, nodes, chain = self.bodies[i]
        last = self.bodies.pop()
        if i < len(self.bodies):
            self.bodies[i] = last
        self.leaves.difference_update(nodes)
        del self.pinned[chain[0]]

    def body(self, node: int) -> int:
        """Whose a node is."""
        return self.vertices.all[node >> 1].body

    def bot(self, label: Label) -> int:
        """The deepest node of a label."""
        return max(label, key=self.depth.__getitem__)

    def top(self, label: Label) -> int:
        """The highest node of a label."""
        return min(label, key=self.depth.__getitem__)

    def is_path(self, label: Label) -> bool:
        """Whether a label is a path of ancestors."""
        return not label or (
            self.depth[self.bot(label)] - self.depth[self.top(label)] + 1 == len(label)
            and all(self.parent[v] in label for v in label if v != self.top(label))
        )

    def node(self, label: Label, twin: Label) -> int:
        """The node whose tile is on the left of a half-edge with these labels; -1 in F2."""
        if label:
            return self.bot(label)
        return self.parent[self.top(twin)] if twin else -1


@final
class LabelledMesh(Mesh):
    """A mesh with labels.

    Attributes:
        forest: the trees.
        labels: of each half-edge.
    """

    def __init__(self, vertices: int, forest: Forest) -> None:
        super().__init__(vertices)
        self.forest = forest
        self.labels: list[Label] = []

    def _mark(self, h: int, *, boundary: bool) -> None:
        super()._mark(h, boundary=boundary)
        if h == len(self.labels):
            self.labels += (NO_LABEL, NO_LABEL)
        else:
            self.labels[h] = self.labels[h + 1] = NO_LABEL

    def is_fixed(self, h: int) -> bool:
        """Whether an edge is no diagonal of F2 (or inside a body)."""
        return super().is_fixed(h) or bool(self.labels[h] or self.labels[h ^ 1])

    def tile(self, h: int) -> Tile:
        """The body and the level of the node that the tile on the left of h belongs to."""
        node = self.node(h)
        return F2 if node < 0 else Tile(self.forest.body(node), self.forest.depth[node])

    def node(self, h: int) -> int:
        """The node whose tile is on the left of a half-edge of free space; -1 in F2."""
        return self.forest.node(self.labels[h], self.labels[h ^ 1])

    def geodesic(self, of: BodyTree, k: int) -> list[int]:
        """The half-edges along the geodesic of a node of a body, the cycle of `TOP` from any.

        Where it passes a vertex twice, what is on its left tells how it goes on: the body,
        or what it has pulled shut, and nothing else of the same geodesic.

        Raises:
            AuditError: if the labels are not those of one path.
        """
        node = of.nodes[k]
        if k == TOP:
            last = NOTHING
            first = next((h for h in self.geodesic(of, ROOT) if node in self.labels[h]), NOTHING)
        else:  # the last one is that from the end back along the ring
            last = self.ring_edge[of.chain[of.tree.high[k] - 1]] ^ 1
            first = self._clockwise(self.ring_edge[of.chain[of.tree.low[k]]], node, NOTHING)
        path: list[int] = []
        h = first
        while h != NOTHING:
            path.append(h)
            if h ^ 1 == last:
                return path
            # The first one to the left: clockwise from where it comes from.
            h = self._clockwise(self.map.following[h], node, last)
            if h == first:
                if k == TOP:
                    return path
                break
            if node not in self.labels[h]:
                return path
        raise AuditError(f"the geodesic of node {node} is no path")

    def _clockwise(self, first: int, node: int, last: int) -> int:
        """The next half-edge around a vertex that a geodesic runs along, or the last one."""
        h = first
        while node not in self.labels[h] and h != last:
            h = self.map.following[h ^ 1]
            if h == first:
                raise AuditError(f"the geodesic of node {node} ends at vertex {self.map.origin[h]}")
        return h

    def stays(self, h: int) -> tuple[bool, bool]:
        """Whether an edge of a body, or one that is labelled still, is at either side."""
        if self.region[h] == INSIDE:
            return super().stays(h)
        before = self.map.previous[h]
        along, back = self._straightened(h)
        first, second = super().stays(h)
        return (
            first or self.labels[before] != along or self.labels[before ^ 1] != back,
            second or self.labels[h] != along or self.labels[h ^ 1] != back,
        )

    def _straightened(self, h: int) -> tuple[Label, Label]:
        """The geodesics, either way, that lose their bend at the origin of h."""
        before, pinned = self.map.previous[h], self.forest.pinned
        kept = pinned.get(self.map.origin[h], NO_LABEL)
        return (
            (self.labels[before] & self.labels[h]) - kept,
            (self.labels[before ^ 1] & self.labels[h ^ 1]) - kept,
        )

    def _take_out(self, h: int) -> tuple[Label, Label]:
        along, back = self._straightened(h)
        for g in (self.map.previous[h], h):
            self.labels[g] -= along
            self.labels[g ^ 1] -= back
        return along, back

    def collapse_corner(self, h: int, *, origin_moves: bool) -> None:
        """As `Mesh.collapse_corner`; the labels of the longer edge go to the shorter one too."""
        before = self.map.previous[h]
        long, short = (h, before ^ 1) if origin_moves else (before ^ 1, h)
        self.labels[short] |= self.labels[long]
        self.labels[short ^ 1] |= self.labels[long ^ 1]
        super().collapse_corner(h, origin_moves=origin_moves)

    def dissolve_triangle(self, h: int) -> None:
        """As `Mesh.dissolve_triangle`; the labels go to the two edges in its place."""
        m, labels = self.map, self.labels
        for g in (m.following[h], m.previous[h]):
            labels[g ^ 1] |= labels[h]
            labels[g] |= labels[h ^ 1]
        super().dissolve_triangle(h)

    def straighten(self, h: int, *, origin_moves: bool) -> None:
        """As `Mesh.straighten`; geodesics without a bend any more go along the new edge."""
        slid = h if origin_moves else self.map.previous[h]
        if self.region[h] != INSIDE:
            along, back = self._take_out(h)
            self.labels[slid], self.labels[slid ^ 1] = along, back
        super().straighten(h, origin_moves=origin_moves)

    def cut_off(self, h: int) -> int:
        """As `Mesh.cut_off`; geodesics without a bend any more go along the new edge."""
        if self.region[h] == INSIDE:
            return super().cut_off(h)
        along, back = self._take_out(h)
        e = super().cut_off(h)
        self.labels[e], self.labels[e ^ 1] = along, back
        return e

    def copy(self) -> LabelledMesh:
        """An independent copy, of the same trees."""
        other = LabelledMesh(0, self.forest)
        self._copy_to(other)
        other.labels = self.labels[:]
        return other

    def state(self) -> dict[str, list[Any]]:
        """As `Mesh.state`; with the labels."""
        return {**super().state(), "labels": [sorted(label) for label in self.labels]}

    def resume(self, state: dict[str, list[Any]]) -> None:
        """As `Mesh.resume`; with the labels."""
        super().resume(state)
        self.labels = [frozenset(label) for label in state["labels"]]

    def labelling(self) -> Sequence[Label]:
        """The labels."""
        return self.labels

    def relative_hulls(self) -> Callable[[int], list[int]]:
        """See `Mesh.relative_hulls`: the cycles that are pinned nowhere, of the bodies now."""
        tops = [of.nodes[TOP] for of in self.forest.bodies]
        return lambda i: loop_along(self.map, self.labels, tops[i])

    def audit_faces(self, half_edges: Iterable[int]) -> None:
        """Check corners, that labels are paths, and that the edges of a tile agree on its node.

        Raises:
            AuditError: if that is not so.
        """
        todo = list(half_edges)
        super().audit_faces(todo)
        for h in todo:
            if self.map.origin[h] < 0:
                continue
            if not self.forest.is_path(self.labels[h]):
                raise AuditError(f"label {sorted(self.labels[h])} is no path of ancestors")
            if self.region[h] == FREE and self.node(h) != self.node(self.map.following[h]):
                raise AuditError(f"half-edge {h} and the next one are of different nodes")
