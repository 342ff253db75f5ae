"""The tree of upper tangents, or of lower ones, of an incremental pseudo-triangulation.

Every point but the first hangs on the left end of its tangent. The children of a point are
sorted in x-order, and then *the preorder of the tree is the x-order of the points*: the left
end of a tangent from p was on the hull of the points left of p, and no tangent of a later
point passes p to a point that p has covered.

So the part of the chain C(p) between u(p) and the predecessor of p is a path of the upper
tree, from the sibling before p always to the last child. These paths, one through every
point, are the chains of the paper. Here they are walked along, without a data structure of
their own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from exactpt.indices import VertexId

NONE: Final = VertexId(-1)
"""No point."""


class TangentTree:
    """An ordered tree on the points 0 .. size - 1, in parallel lists.

    Attributes:
        parent: for each point, its parent; `NONE` for the root.
        first, last: for each point, its first and its last child.
        before, after: for each point, the siblings next to it.
        steps: number of vertices of chains that have been passed.
        changed: the points with other links than before; None if they are not recorded.
    """

    def __init__(self, size: int) -> None:
        self.parent: list[VertexId] = [NONE] * size
        self.first: list[VertexId] = [NONE] * size
        self.last: list[VertexId] = [NONE] * size
        self.before: list[VertexId] = [NONE] * size
        self.after: list[VertexId] = [NONE] * size
        self.steps: int = 0
        self.changed: set[VertexId] | None = None

    def append(self, z: VertexId, v: VertexId) -> None:
        """Make v, which has no parent, the last child of z."""
        old = self.last[z]
        self.parent[v] = z
        self.before[v] = old
        self.last[z] = v
        if old >= 0:
            self.after[old] = v
        else:
            self.first[z] = v
        if self.changed is not None:
            self.changed |= {v, z, old}

    def insert_before(self, w: VertexId, v: VertexId) -> None:
        """Make v, which has no parent, the sibling just before w."""
        z, old = self.parent[w], self.before[w]
        self.parent[v] = z
        self.before[v], self.after[v] = old, w
        self.before[w] = v
        if old >= 0:
            self.after[old] = v
        else:
            self.first[z] = v
        if self.changed is not None:
            self.changed |= {v, w, old}

    def insert_after(self, w: VertexId, v: VertexId) -> None:
        """Make v, which has no parent, the sibling just after w."""
        old = self.after[w]
        if old < 0:
            self.append(self.parent[w], v)
        else:
            self.insert_before(old, v)

    def prepend(self, z: VertexId, v: VertexId) -> None:
        """Make v, which has no parent, the first child of z."""
        old = self.first[z]
        if old < 0:
            self.append(z, v)
        else:
            self.insert_before(old, v)

    def detach(self, v: VertexId) -> None:
        """Detach v, with its subtree."""
        z, l, r = self.parent[v], self.before[v], self.after[v]
        if l >= 0:
            self.after[l] = r
        else:
            self.first[z] = r
        if r >= 0:
            self.before[r] = l
        else:
            self.last[z] = l
        self.parent[v] = self.before[v] = self.after[v] = NONE
        if self.changed is not None:
            self.changed |= {v, z, l, r}

    # Chains

    def top(self, v: VertexId) -> VertexId:
        """Return the top of the path of last children through v."""
        parent, last = self.parent, self.last
        z = parent[v]
        while z >= 0 and last[z] == v:
            v, z = z, parent[z]
            self.steps += 1
        return v

    def tangent_end(
        self, p: VertexId, bottom: VertexId, hides: Callable[[VertexId, VertexId], bool]
    ) -> VertexId:
        """Return the end on the chain of p of the tangent from a new point just left of p.

        Args:
            p: a point other than the root.
            bottom: the point before p in the x-order, where the path ends.
            hides: called with the parent z of a vertex w on the path, and w: whether w lies
                behind the line from z to the new point. True for the vertices from some point
                of the path on, false before.

        Returns:
            The last vertex of the path for which ``hides`` is false; the parent of p if it is
            true for all.
        """
        parent = self.parent
        start = parent[p]
        w = bottom
        while w != start and hides(parent[w], w):
            w = parent[w]
            self.steps += 1
        return w
