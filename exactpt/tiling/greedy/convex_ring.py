"""Searches on convex rings in O(log n) steps: extreme vertices, chains, tangents.

`Predicates.left_of` is the order of the vertices along one direction, near the horizontal
(step 1 of `exactpt.certificates.perturbation`). So along a convex ring, counter-clockwise, it
falls to the leftmost vertex and rises to the rightmost one, once each; and a chain from the one
to the other is sorted by it, and its edges by slope.
"""

from __future__ import annotations

from typing import Final, final

from exactpt.certificates.predicates import Predicates
from exactpt.indices import Ends, VertexId

FEW: Final = 12
"""Rings of at most so many vertices are searched one by one."""


@final
class Chain:
    """The vertices of a convex ring from its leftmost to its rightmost, along one side.

    Attributes:
        count: the number of its vertices.
    """

    __slots__ = ("_first", "_ring", "_step", "count")

    def __init__(self, ring: list[VertexId], first: int, step: int, count: int) -> None:
        self._ring = ring
        self._first = first
        self._step = step
        self.count = count

    def vertex(self, k: int) -> VertexId:
        """Return the k-th vertex from the left."""
        return self._ring[(self._first + k * self._step) % len(self._ring)]

    @property
    def ends(self) -> Ends:
        """The leftmost and the rightmost vertex of the ring."""
        return self.vertex(0), self.vertex(self.count - 1)


def chains_of(predicates: Predicates, ring: list[VertexId]) -> tuple[Chain, Chain]:
    """Return the lower and the upper chain of a convex ring."""
    n = len(ring)
    first, last = _extreme(predicates, ring, 1), _extreme(predicates, ring, -1)
    along = (last - first) % n
    back = (first - last) % n
    return Chain(ring, first, 1, along + 1), Chain(ring, first, -1, back + 1)


def _extreme(predicates: Predicates, ring: list[VertexId], sense: int) -> int:
    """Return the place of the leftmost (1) or rightmost (-1) vertex of a convex ring."""
    n = len(ring)
    if n <= FEW:
        best = 0
        for i in range(1, n):
            if _is_beyond(predicates, ring[i], ring[best], sense):
                best = i
        return best
    nears = _is_beyond(predicates, ring[1], ring[0], sense)
    low, high = 0, n  # the extreme vertex is after `low`, and not after `high`
    while high - low > 1:
        middle = (low + high) // 2
        here = ring[middle]
        beyond_first = _is_beyond(predicates, here, ring[0], sense)
        if _is_beyond(predicates, ring[(middle + 1) % n], here, sense):
            is_before = beyond_first or not nears
        else:
            is_before = not (beyond_first or nears)
        if is_before:
            low = middle
        else:
            high = middle
    return high % n


def _is_beyond(predicates: Predicates, v: VertexId, w: VertexId, sense: int) -> bool:
    """Return True if v is left of w, or with the sense -1 right of it."""
    return predicates.left_of(v, w) if sense > 0 else predicates.left_of(w, v)


def is_above(predicates: Predicates, lower: Chain, v: VertexId) -> bool:
    """Return True if v, which is vertically above or below a convex body, is above it."""
    low, high = 0, lower.count - 1  # the vertex `low` is left of v, `high` is not
    while high - low > 1:
        middle = (low + high) // 2
        if predicates.left_of(lower.vertex(middle), v):
            low = middle
        else:
            high = middle
    return predicates.orientation(lower.vertex(low), lower.vertex(high), v) >= 0


def near_tangent(predicates: Predicates, a: Chain, b: Chain, side_a: int, side_b: int) -> Ends:
    """Return vertices of two chains at or next to which their bitangent touches, if there is one.

    A line from left to right that has the body of a chain on its left touches the lower chain,
    else the upper one. Seen from a vertex of the other body, the following vertex of the chain is
    on the wrong side of the line up to the vertex at which the tangent touches, and on the right
    one from there on: where the line is steeper than an edge of a lower chain, it was so at all
    vertices before. (Along an edge, a point above its line is seen under a growing slope,
    a point below it under a falling slope; and slopes of edges grow.)

    Args:
        predicates: the predicates.
        a: the chain at the left end of the bitangent.
        b: the chain at its right end.
        side_a: 1 for a lower chain, -1 for an upper one.
        side_b: likewise for b.
    """
    low, high = 0, a.count - 1
    while low < high:
        middle = (low + high) // 2
        v = a.vertex(middle)
        w = _seen_from(predicates, v, b, side_b)
        if side_a * predicates.orientation(v, w, a.vertex(middle + 1)) < 0:
            low = middle + 1
        else:
            high = middle
    v = a.vertex(low)
    return v, _seen_from(predicates, v, b, side_b)


def _seen_from(predicates: Predicates, v: VertexId, b: Chain, side: int) -> VertexId:
    """Return the vertex of a chain at which the tangent from a vertex on its left touches."""
    low, high = 0, b.count - 1
    while low < high:
        middle = (low + high) // 2
        if side * predicates.orientation(v, b.vertex(middle), b.vertex(middle + 1)) < 0:
            low = middle + 1
        else:
            high = middle
    return b.vertex(low)
