"""Labels: the geodesics along each half-edge, and their changes at repairs.

The label of a half-edge h is the set of tree nodes whose geodesic traverses h in its
direction. They all belong to one ring of the polygon on the left, and form a path of ancestors
in its tree, from the deepest node, bot, up to the highest, top. (An edge shared by the
geodesics of two nested chains is shared by those of all chains in between.) The labels
determine the tiles of F1:

* A labelled half-edge whose bot is a leaf is an edge of the ring. Otherwise the tile on its
  left belongs to bot: it lies between the geodesic of bot and those of its children.
* The tile on the left of an unlabelled half-edge whose twin is labelled belongs to the parent
  of the twin's top; if top is the unpinned cycle, it is outside all relative hulls, in F2.
* If neither half-edge is labelled, the edge is one of F2 (or of the convex hull there).

Let three vertices become collinear, with m in the middle. If they form a corner with the edge
xy, then m now lies on that edge, and the geodesics along xy now run along xm and my. If they
form a reflex angle at m, the geodesics through both edges no longer bend at m and run along xy
from now on, except for those pinned at m. (Of the geodesics that end at m only that of the
root, a loop, runs through m too.) An edge without labels is then removed.

Source: the paper, section 5.2, with all cases worked out: shared edges, tails, and reflex
angles of which neither edge, or both edges, are removed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, final

from exactpt.errors import AuditError
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.kernel.stored import Stored
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import F2, FREE, INSIDE, Mesh, Tile
from exactpt.tiling.mixed.forest import NO_LABEL, Forest, Label, RingTree
from exactpt.tiling.mixed.tree import ROOT, TOP


@final
class LabelledMesh(Mesh):
    """A mesh with labels.

    Attributes:
        forest: the trees of the bodies.
        labels: for each half-edge, its label.
    """

    def __init__(self, vertices: int, forest: Forest) -> None:
        super().__init__(vertices)
        self.forest = forest
        self.labels: list[Label] = []

    def _mark(self, h: HalfEdge, *, boundary: bool) -> None:
        super()._mark(h, boundary=boundary)
        if h == len(self.labels):
            self.labels += (NO_LABEL, NO_LABEL)
        else:
            self.labels[h] = self.labels[h + 1] = NO_LABEL

    def is_fixed(self, h: HalfEdge) -> bool:
        """Return True if an edge is not a diagonal of F2 or inside a body."""
        return super().is_fixed(h) or bool(self.labels[h] or self.labels[h ^ 1])

    def tile(self, h: HalfEdge) -> Tile:
        """Return the body and the depth of the node to which the tile on the left of h belongs."""
        node = self.node(h)
        return F2 if node < 0 else Tile(self.forest.body(node), self.forest.depth[node])

    def node(self, h: HalfEdge) -> int:
        """Return the node whose tile is on the left of a half-edge of free space; -1 in F2."""
        return self.forest.node(self.labels[h], self.labels[h ^ 1])

    def geodesic(self, ring_tree: RingTree, k: int) -> list[HalfEdge]:
        """Return the half-edges along the geodesic of a node; the cycle of `TOP` starts anywhere.

        Where the geodesic passes a vertex twice, it continues along the first of its half-edges
        clockwise: on its left there is only the body or a pocket that it closes.

        Raises:
            AuditError: if the labels are not those of one path.
        """
        node = ring_tree.nodes[k]
        if k == TOP:
            last = NO_HALF_EDGE
            first = next(
                (h for h in self.geodesic(ring_tree, ROOT) if node in self.labels[h]), NO_HALF_EDGE
            )
        else:  # the last one is that from the end back along the ring
            last = twin(self.ring_edge[ring_tree.chain[ring_tree.tree.high[k] - 1]])
            first = self._clockwise(
                self.ring_edge[ring_tree.chain[ring_tree.tree.low[k]]], node, NO_HALF_EDGE
            )
        path: list[HalfEdge] = []
        h = first
        while h != NO_HALF_EDGE:
            path.append(h)
            if h ^ 1 == last:
                return path
            # The first one clockwise from the reversed half-edge.
            h = self._clockwise(self.map.following[h], node, last)
            if h == first:
                if k == TOP:
                    return path
                break
            if node not in self.labels[h]:
                return path
        raise AuditError(f"the geodesic of node {node} is not a path")

    def _clockwise(self, first: HalfEdge, node: int, last: HalfEdge) -> HalfEdge:
        """Return the first half-edge clockwise whose label has the node, or ``last``."""
        h = first
        while node not in self.labels[h] and h != last:
            h = self.map.following[h ^ 1]
            if h == first:
                raise AuditError(f"the geodesic of node {node} ends at vertex {self.map.origin[h]}")
        return h

    def stays(self, h: HalfEdge) -> tuple[bool, bool]:
        """As `Mesh.stays`: an edge of a body stays, and so does one with a remaining label."""
        if self.region[h] == INSIDE:
            return super().stays(h)
        before = self.map.previous[h]
        along, back = self._straightened(h)
        first, second = super().stays(h)
        return (
            first or self.labels[before] != along or self.labels[before ^ 1] != back,
            second or self.labels[h] != along or self.labels[h ^ 1] != back,
        )

    def _straightened(self, h: HalfEdge) -> tuple[Label, Label]:
        """Return the geodesics, in both directions, that no longer bend at the origin of h."""
        before, pinned = self.map.previous[h], self.forest.pinned
        kept = pinned.get(self.map.origin[h], NO_LABEL)
        return (
            (self.labels[before] & self.labels[h]) - kept,
            (self.labels[before ^ 1] & self.labels[h ^ 1]) - kept,
        )

    def _remove_straightened(self, h: HalfEdge) -> tuple[Label, Label]:
        """Remove these geodesics from the labels of the two edges at the origin of h."""
        along, back = self._straightened(h)
        for g in (self.map.previous[h], h):
            self.labels[g] -= along
            self.labels[g ^ 1] -= back
        return along, back

    def collapse_corner(self, h: HalfEdge, *, origin_moves: bool) -> None:
        """As `Mesh.collapse_corner`; the labels of the longer edge are added to the shorter one."""
        before = self.map.previous[h]
        long, short = (h, twin(before)) if origin_moves else (twin(before), h)
        self.labels[short] |= self.labels[long]
        self.labels[short ^ 1] |= self.labels[long ^ 1]
        super().collapse_corner(h, origin_moves=origin_moves)

    def dissolve_triangle(self, h: HalfEdge) -> None:
        """As `Mesh.dissolve_triangle`; the labels are added to the other two edges."""
        m, labels = self.map, self.labels
        for g in (m.following[h], m.previous[h]):
            labels[g ^ 1] |= labels[h]
            labels[g] |= labels[h ^ 1]
        super().dissolve_triangle(h)

    def straighten(self, h: HalfEdge, *, origin_moves: bool) -> None:
        """As `Mesh.straighten`; geodesics that no longer bend run along the new edge."""
        slid = h if origin_moves else self.map.previous[h]
        if self.region[h] != INSIDE:
            along, back = self._remove_straightened(h)
            self.labels[slid], self.labels[slid ^ 1] = along, back
        super().straighten(h, origin_moves=origin_moves)

    def cut_off(self, h: HalfEdge) -> HalfEdge:
        """As `Mesh.cut_off`; geodesics that no longer bend run along the new edge."""
        if self.region[h] == INSIDE:
            return super().cut_off(h)
        along, back = self._remove_straightened(h)
        e = super().cut_off(h)
        self.labels[e], self.labels[e ^ 1] = along, back
        return e

    def copy(self) -> LabelledMesh:
        """Return an independent copy, with the same trees."""
        other = LabelledMesh(0, self.forest)
        self._copy_to(other)
        other.labels = self.labels[:]
        return other

    def state(self) -> dict[str, list[Any]]:
        """As `Mesh.state`; with the labels."""
        return {**super().state(), "labels": [sorted(label) for label in self.labels]}

    def resume(self, state: Stored, vertices: int) -> None:
        """As `Mesh.resume`; with the labels."""
        super().resume(state, vertices)
        last = len(self.forest.parent) - 1
        labels = state["labels"].entries(len(self.region))
        self.labels = [frozenset(label.integers(0, last)) for label in labels]

    def labelling(self) -> list[Label]:
        """Return the labels."""
        return self.labels

    def relative_hulls(self) -> Callable[[int], list[VertexId]]:
        """See `Mesh.relative_hulls`: the unpinned cycles of the current bodies."""
        outlines = [outline for outline, *_ in self.forest.bodies]
        return lambda i: self.cycle(outlines[i])

    def cycle(self, ring_tree: RingTree) -> list[VertexId]:
        """Return the vertices along the unpinned cycle of a ring, from a determined one on.

        Around an outline, it is the shortest closed curve homotopic to it in free space.
        """
        cycle = self.geodesic(ring_tree, TOP)
        first = cycle.index(min(cycle))
        return [self.map.origin[h] for h in cycle[first:] + cycle[:first]]

    def audit_faces(self, half_edges: Iterable[HalfEdge]) -> None:
        """Check corners, that labels are paths, and that the edges of a tile agree on its node.

        Raises:
            AuditError: at the first fault.
        """
        todo = list(half_edges)
        super().audit_faces(todo)
        for h in todo:
            if self.map.origin[h] < 0:
                continue
            if not self.forest.is_path(self.labels[h]):
                raise AuditError(f"label {sorted(self.labels[h])} is not a path of ancestors")
            if self.region[h] == FREE and self.node(h) != self.node(self.map.following[h]):
                raise AuditError(f"half-edge {h} and the next one belong to different nodes")
