"""A first tiling of any disjoint simple polygons: a plane sweep from left to right.

Between two edges that are adjacent on the sweep line lies a *gap*. A gap has a chain of
vertices that bounds its tiles so far on the right: from the last vertex of its lower edge
to that of its upper one, convex to the right. A new vertex in the gap is joined to the
chain by its two tangents; the chain between their ends becomes the third side of a
pseudo-triangle. For points this is the incremental pseudo-triangulation (paper, section
3.1); a vertex on an edge of a gap needs one tangent, and where two edges end at one vertex, the
chain between them closes the gap.

The result is a pseudo-triangulation, but not one with the fewest faces
(`exactpt.pseudotriangulation.pointed`). Time O(n log n) plus the lengths of the chains
traversed.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cmp_to_key
from typing import final

from exactpt.certificates.at_time import PredicatesAt, sorted_by_x
from exactpt.certificates.predicates import Predicates
from exactpt.indices import NO_VERTEX, VertexId
from exactpt.kernel.budget import check_budget
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, SOLID, Diagonal


@final
class SweptEdge:
    """An edge from left to right, the kind of region above it, and the chain of its gap."""

    __slots__ = ("chain", "left", "region", "right")

    def __init__(self, left: VertexId, right: VertexId, region: int) -> None:
        self.left = left
        self.right = right
        self.region = region
        self.chain: list[VertexId] = []


def sweep_diagonals(instant: PredicatesAt) -> list[Diagonal]:
    """Return the diagonals of a pseudo-triangulation of the free space, hull edges included.

    The interiors of bodies that deform are tiled too, those of rigid bodies are not.
    """
    return Sweep(instant, body_edges(instant)).run()


def body_edges(instant: PredicatesAt) -> list[SweptEdge]:
    """Return the edges of all bodies; a body is above its edges that lead right."""
    vertices = instant.vertices
    edges = []
    for body in vertices.bodies:
        inside = INSIDE if body.is_tiled else SOLID
        for v in body.ring:
            ahead = vertices.ahead(v)
            if instant.left_of(v, ahead):
                edges.append(SweptEdge(v, ahead, inside))
            else:
                edges.append(SweptEdge(ahead, v, FREE))
    return edges


@final
class Sweep:
    """A sweep over edges that do not cross.

    Args:
        predicates: the predicates of the time.
        edges: the edges; the region above each is tiled unless it is `SOLID`.
        triangulate: join a vertex to all of the chain that it sees, not only by tangents.
        around: the kind of region outside all edges.
    """

    def __init__(
        self,
        predicates: Predicates,
        edges: Iterable[SweptEdge],
        *,
        triangulate: bool = False,
        around: int = FREE,
    ) -> None:
        self.predicates = predicates
        self.triangulate = triangulate
        self.diagonals: list[Diagonal] = []
        # From bottom to top; the first is not an edge but stands for the gap below all edges.
        self.active: list[SweptEdge] = [SweptEdge(NO_VERTEX, NO_VERTEX, around)]
        self.starting: dict[VertexId, list[SweptEdge]] = {}
        self.ends: dict[VertexId, None] = {}
        for edge in edges:
            self.starting.setdefault(edge.left, []).append(edge)
            self.ends[edge.left] = self.ends[edge.right] = None

    def run(self) -> list[Diagonal]:
        """Return the diagonals of all gaps, from left to right."""
        for v in sorted_by_x(self.predicates, self.ends):
            check_budget()
            edges = self.starting.get(v, [])
            self._pass(v, self._from_bottom_to_top(edges))
        return self.diagonals

    def _from_bottom_to_top(self, edges: list[SweptEdge]) -> list[SweptEdge]:
        """Return edges with a common left end, sorted from bottom to top."""

        def order(a: SweptEdge, b: SweptEdge) -> int:
            return -self.predicates.orientation(a.left, a.right, b.right)

        return sorted(edges, key=cmp_to_key(order)) if len(edges) > 1 else edges

    def _pass(self, v: VertexId, starting: list[SweptEdge]) -> None:
        first = self._first_not_below(v)
        last = first
        while last < len(self.active) and self.active[last].right == v:
            last += 1
        below = self.active[first - 1]
        ending = self.active[first:last]
        if not ending:
            # Inside a gap: v sees its chain between two tangents.
            lower, upper = self._split_chain(v, below.chain, below.region)
        else:
            lower = self._upper_end(v, below.chain, below.region)
            upper = self._lower_end(v, ending[-1].chain, ending[-1].region)
            if self.triangulate:
                for edge in ending[:-1]:
                    if edge.region != SOLID:
                        self._join_part(v, edge.chain, 1, len(edge.chain) - 2, edge.region)
        if starting:
            for edge in starting[:-1]:
                edge.chain = [v]
            starting[-1].chain = upper
            below.chain = lower
        else:
            below.chain = lower + upper[1:]
        self.active[first:last] = starting

    def _first_not_below(self, v: VertexId) -> int:
        """Return the position of the lowest edge that is above v or ends there."""
        low, high = 1, len(self.active)
        while low < high:
            middle = (low + high) // 2
            edge = self.active[middle]
            if edge.right != v and self.predicates.orientation(edge.left, edge.right, v) > 0:
                low = middle + 1
            else:
                high = middle
        return low

    def _join_part(
        self, v: VertexId, chain: list[VertexId], low: int, high: int, region: int
    ) -> None:
        """Join v to the ends of a part of a chain, or to all its vertices."""
        step = 1 if self.triangulate else max(high - low, 1)
        for i in range(low, high + 1, step):
            self.diagonals.append(Diagonal(chain[i], v, region))

    def _sees(self, v: VertexId, chain: list[VertexId], i: int) -> bool:
        """Return True if v sees edge i of a chain: it lies to the right of the edge, going up."""
        return self.predicates.orientation(chain[i], chain[i + 1], v) < 0

    def _split_chain(
        self, v: VertexId, chain: list[VertexId], region: int
    ) -> tuple[list[VertexId], list[VertexId]]:
        """Return the chains below and above v, a vertex that splits a gap."""
        if not chain or region == SOLID:
            return [v], [v]
        low, high = 0, len(chain) - 1
        seen = [i for i in range(high) if self._sees(v, chain, i)]
        if seen:
            low, high = seen[0], seen[-1] + 1
        else:
            low = high = self._only_visible(chain)
        self._join_part(v, chain, low, high, region)
        return [*chain[: low + 1], v], [v, *chain[high:]]

    def _only_visible(self, chain: list[VertexId]) -> int:
        """Return the end of a chain that is seen by a vertex which sees no edge of it.

        It is the lower end, if its wedge between the gap's lower edge (which leads right) and
        the chain is more than pi: then the chain starts to the left. The directions of
        the chain turn to the left on the way up, so then it ends to the left as well, and
        the wedge at its upper end is less than pi.
        """
        leans_left = len(chain) > 1 and self.predicates.left_of(chain[1], chain[0])
        return 0 if leans_left else len(chain) - 1

    def _upper_end(self, v: VertexId, chain: list[VertexId], region: int) -> list[VertexId]:
        """Return the chain of a gap whose upper edge ends at v, to the neighbour of v."""
        if region == SOLID:
            return [v]
        i = len(chain) - 1
        while i > 0 and self._sees(v, chain, i - 1):
            i -= 1
        if i < len(chain) - 1:
            last = len(chain) - 2 if self.triangulate else i
            self._join_part(v, chain, i, last, region)
        return [*chain[: i + 1], v]

    def _lower_end(self, v: VertexId, chain: list[VertexId], region: int) -> list[VertexId]:
        """Return the chain of a gap whose lower edge ends at v, from the neighbour of v."""
        if region == SOLID:
            return [v]
        i = 0
        while i < len(chain) - 1 and self._sees(v, chain, i):
            i += 1
        if i > 0:
            self._join_part(v, chain, 1 if self.triangulate else i, i, region)
        return [v, *chain[i:]]
