"""One half of an incremental pseudo-triangulation: the tree of its upper, or lower, tangents.

Every point but the first hangs on the left end of its tangent. The children of a point are
kept in x-order, and then *the preorder of the tree is the x-order of the points*: a point
that is reached by a tangent from p was on the hull of the points left of p, and no tangent
of a later point passes p to reach what p has covered.

So the part of the chain C(p) between u(p) and the predecessor of p is a path of the upper
tree: from the sibling before p on, always to the last child. These paths, one through
every point, are the chains of the paper. Here they are not kept, but walked.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

__all__ = ["NONE", "TangentTree"]

NONE: Final = -1
"""No point."""


class TangentTree:
    """An ordered tree on the points 0 .. size - 1, in parallel lists.

    Attributes:
        parent: where a point hangs; `NONE` for the root.
        first, last: the outermost children of a point.
        before, after: the siblings next to a point.
        steps: how many vertices of chains have been walked past.
    """

    def __init__(self, size: int) -> None:
        self.parent: list[int] = [NONE] * size
        self.first: list[int] = [NONE] * size
        self.last: list[int] = [NONE] * size
        self.before: list[int] = [NONE] * size
        self.after: list[int] = [NONE] * size
        self.steps: int = 0

    def append(self, z: int, v: int) -> None:
        """Let v, which hangs nowhere, become the last child of z."""
        old = self.last[z]
        self.parent[v] = z
        self.before[v] = old
        self.last[z] = v
        if old >= 0:
            self.after[old] = v
        else:
            self.first[z] = v

    def insert_before(self, w: int, v: int) -> None:
        """Let v, which hangs nowhere, become the sibling just before w."""
        z, old = self.parent[w], self.before[w]
        self.parent[v] = z
        self.before[v], self.after[v] = old, w
        self.before[w] = v
        if old >= 0:
            self.after[old] = v
        else:
            self.first[z] = v

    def insert_after(self, w: int, v: int) -> None:
        """Let v, which hangs nowhere, become the sibling just after w."""
        old = self.after[w]
        if old < 0:
            self.append(self.parent[w], v)
        else:
            self.insert_before(old, v)

    def prepend(self, z: int, v: int) -> None:
        """Let v, which hangs nowhere, become the first child of z."""
        old = self.first[z]
        if old < 0:
            self.append(z, v)
        else:
            self.insert_before(old, v)

    def detach(self, v: int) -> None:
        """Take v, with all that hangs on it, out of the tree."""
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

    # Chains

    def top(self, v: int) -> int:
        """The point at which the path of last children through v begins."""
        parent, last = self.parent, self.last
        z = parent[v]
        while z >= 0 and last[z] == v:
            v, z = z, parent[z]
            self.steps += 1
        return v

    def tangent_end(self, p: int, bottom: int, hides: Callable[[int, int], bool]) -> int:
        """Where the tangent ends that a point just left of p sends to the chain of p.

        Args:
            p: not the root.
            bottom: the point before p in x-order, where the path ends.
            hides: of the parent z of a vertex w on the path, and w: whether w lies behind
                the line from z to the new point. True for the vertices at the end of the
                path, false for those before them.

        Returns:
            The last vertex of the path for which that is false; the parent of p if it is
            true for all.
        """
        parent = self.parent
        start = parent[p]
        w = bottom
        while w != start and hides(parent[w], w):
            w = parent[w]
            self.steps += 1
        return w
