"""The fan triangulation (paper, section 3.4), maintained at the events of the tiling.

Every point p is joined to all vertices of its chain C(p), ends included; the result is a
triangulation. `fan_edges` derives its edges from the two trees, `Fan` changes them at each event.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, final

from exactpt.indices import Ends, VertexId
from exactpt.planar.halfedge import edge_key
from exactpt.tiling.incremental.structure import Exchanged, IncrementalStructure
from exactpt.tiling.incremental.tree import TangentTree


def path(v: VertexId, tree: TangentTree) -> Iterator[VertexId]:
    """Yield the path from v that always continues to the last child."""
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
    """Yield the edges of the fan triangulation, each once, with the right end first."""
    for p in structure.order[1:]:
        for z in chain(structure, p):
            yield p, z


class FanChanges(NamedTuple):
    """Edges of the fan triangulation that have been removed and added, as of `edge_key`."""

    removed: tuple[Ends, ...]
    added: tuple[Ends, ...]


@final
class Fan:
    """The fan triangulation of points that move.

    `repair` and `exchange` take time in proportion to the change. They are for an event that is
    alone at its time; after several, between which points are out of order, `derive` is called.

    Attributes:
        edges: its edges, as of `edge_key`.
        changes: number of edges that have been added or removed at events.
    """

    def __init__(self) -> None:
        self.edges: set[Ends] = set()
        self.changes: int = 0
        # The changes since the last `take_changes`, without those that cancel each other.
        self._removed: set[Ends] = set()
        self._added: set[Ends] = set()

    def begin(self, structure: IncrementalStructure) -> None:
        """Derive the edges from the trees; this is not a change."""
        self.edges = {edge_key(p, z) for p, z in fan_edges(structure)}

    def derive(self, structure: IncrementalStructure) -> None:
        """Derive the edges from the trees, after simultaneous events; changes are counted."""
        old = self.edges
        self.begin(structure)
        for edge in old - self.edges:
            self._note(edge, is_added=False)
        for edge in self.edges - old:
            self._note(edge, is_added=True)

    def take_changes(self) -> FanChanges:
        """Return the changes since the last call, sorted, which then count as reported."""
        changes = FanChanges(tuple(sorted(self._removed)), tuple(sorted(self._added)))
        self._removed, self._added = set(), set()
        return changes

    def repair(
        self, structure: IncrementalStructure, side: int, moved: Ends, middle: VertexId
    ) -> None:
        """Change the edges when a tangent has come to pass through a vertex, or left it.

        The three points in line are p on the right, the middle one m, and z. The edge pz is
        added if the tangent leads to z now, or else removed; it stays if it is the other
        tangent. The tile beyond pz loses m from its chain, or else gets it; at the hull
        there is none.

        Args:
            structure: the structure after the repair.
            side: the tree of the tangent.
            moved: p and z.
            middle: m.
        """
        p, z = moved
        tree = structure.trees[side]
        tip = tree.after[tree.top(p)]
        if structure.trees[1 - side].parent[p] != z:
            self._change(p, z, is_added=tree.parent[p] == z)
        if tip >= 0:
            self._change(tip, middle, is_added=tree.parent[p] != z)

    def exchange(self, structure: IncrementalStructure, exchanged: Exchanged, q: VertexId) -> None:
        """Change the edges when q, that was next after p, has come before it.

        With K the chain that p and q see, p was joined to K from u(p) to r, and q from r to d(q).
        The vertex that separates their parts has moved along K from r to r'; the last point before
        q is on K between these. The edge pq stays.

        Args:
            structure: the structure after the exchange.
            exchanged: the changes of the exchange.
            q: the point that comes first now.
        """
        if exchanged.end < 0:
            return
        i = structure.rank[q]
        p, last = structure.order[i + 1], structure.order[i - 1]
        trees = structure.trees[exchanged.side], structure.trees[1 - exchanged.side]
        for tree, z in zip(trees, (exchanged.end, exchanged.old), strict=True):
            v = last
            while v != z:
                w = tree.parent[v]
                # The part between v and w, with the end next to r or to r', goes from p to q.
                self._change(p, v if z == exchanged.end else w, is_added=False)
                self._change(q, w if z == exchanged.end else v, is_added=True)
                v = w

    def _change(self, p: VertexId, z: VertexId, *, is_added: bool) -> None:
        edge = edge_key(p, z)
        if is_added:
            self.edges.add(edge)
        else:
            self.edges.discard(edge)
        self._note(edge, is_added=is_added)

    def _note(self, edge: Ends, *, is_added: bool) -> None:
        """Count a change, and keep it until it is reported or another one cancels it."""
        self.changes += 1
        there, opposite = self._added, self._removed
        if not is_added:
            there, opposite = opposite, there
        if edge in opposite:
            opposite.discard(edge)
        else:
            there.add(edge)
