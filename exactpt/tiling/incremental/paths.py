"""Searchable chains: a tree of tangents whose paths are searched in O(log n).

A path of last children (`exactpt.tiling.incremental.tree`) is represented by a splay tree,
ordered from the top of the path down. Every point is a node of one splay tree. An event cuts
and joins O(1) paths, and finds the end of a tangent by descent, each in amortized O(log n).

Source: D. D. Sleator, R. E. Tarjan, *Self-adjusting binary search trees*, J. ACM 32 (1985).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import final

from exactpt.indices import VertexId
from exactpt.tiling.incremental.tree import NONE, TangentTree


@final
class SearchableTree(TangentTree):
    """A tree of tangents with splay trees over its paths."""

    def __init__(self, size: int) -> None:
        super().__init__(size)
        self._up: list[VertexId] = [NONE] * size
        self._left: list[VertexId] = [NONE] * size
        self._right: list[VertexId] = [NONE] * size

    @classmethod
    def of(cls, tree: TangentTree) -> SearchableTree:
        """Return the same tree, with splay trees; it takes over the lists."""
        self = cls(0)
        self.parent, self.first, self.last = tree.parent, tree.first, tree.last
        self.before, self.after, self.steps = tree.before, tree.after, tree.steps
        self.changed = tree.changed
        # Each splay tree begins as a list; any initial shape costs O(n log n) in all.
        self._left = [NONE] * len(tree.parent)
        self._right = tree.last[:]
        self._up = [z if z >= 0 and tree.last[z] == v else NONE for v, z in enumerate(tree.parent)]
        return self

    def append(self, z: VertexId, v: VertexId) -> None:
        """Make v, which has no parent, the last child of z."""
        if self.last[z] >= 0:
            self._cut_below(z)
        super().append(z, v)
        self._join(z, v)

    def detach(self, v: VertexId) -> None:
        """Detach v, with its subtree."""
        z = self.parent[v]
        was_last = self.last[z] == v
        if was_last:
            self._cut_below(z)
        super().detach(v)
        if was_last and self.last[z] >= 0:
            self._join(z, self.last[z])

    def top(self, v: VertexId) -> VertexId:
        """Return the top of the path of last children through v."""
        self._splay(v)
        while self._left[v] >= 0:
            v = self._left[v]
            self.steps += 1
        self._splay(v)
        return v

    def tangent_end(
        self, p: VertexId, bottom: VertexId, hides: Callable[[VertexId, VertexId], bool]
    ) -> VertexId:
        """See `TangentTree.tangent_end`."""
        end = self.parent[p]
        if end == bottom:
            return end
        self._splay(bottom)
        w = node = bottom
        while node >= 0:
            w = node
            self.steps += 1
            if hides(self.parent[w], w):
                node = self._left[w]
            else:
                end, node = w, self._right[w]
        self._splay(w)
        return end

    def _cut_below(self, z: VertexId) -> None:
        """Cut the path through z below z; the part below becomes a path."""
        self._splay(z)
        below = self._right[z]
        if below >= 0:
            self._up[below] = NONE
            self._right[z] = NONE

    def _join(self, z: VertexId, v: VertexId) -> None:
        """Append the path that begins with v to the one that ends with z."""
        self._splay(z)
        self._splay(v)
        self._right[z] = v
        self._up[v] = z

    def _splay(self, v: VertexId) -> None:
        """Make v the root of its splay tree."""
        up, left = self._up, self._left
        while (z := up[v]) >= 0:
            g = up[z]
            if g >= 0:
                same = (left[z] == v) == (left[g] == z)
                self._rotate(z if same else v)
            self._rotate(v)

    def _rotate(self, v: VertexId) -> None:
        """Rotate v above its parent."""
        up, left, right = self._up, self._left, self._right
        z = up[v]
        g = up[z]
        if left[z] == v:
            middle = right[v]
            left[z], right[v] = middle, z
        else:
            middle = left[v]
            right[z], left[v] = middle, z
        if middle >= 0:
            up[middle] = z
        up[z], up[v] = v, g
        if g >= 0:
            if left[g] == z:
                left[g] = v
            else:
                right[g] = v
