"""Pairs of edges of a polygon or chain of many vertices that may intersect."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Final, TypeAlias

import numpy as np

from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.geometry.boxes import overlapping_pairs
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats, Indices

Pairs: TypeAlias = tuple[Indices, Indices]
Extents: TypeAlias = list[tuple[Floats, Floats]]
"""Along each of some axes the least and the greatest coordinates of edges or of chains."""

AXES: Final = ((1, 0), (0, 1), (0.5, 0.5), (0.5, -0.5), (0.5, 0.25), (0.25, -0.5), (0.25, 0.5),
               (0.5, -0.25))  # fmt: skip
"""Axes along which edges are compared; along the first two by a sweep."""
LENGTH: Final = 4
"""Number of consecutive edges that are compared together first."""
CHUNK: Final = 1 << 10
"""Number of pairs of these that are compared at once, so that their numbers stay in the cache."""


def near_edges(
    first: Floats, last: Floats, error: float, *, closed: bool, neighbours: bool = False
) -> Iterator[Pairs]:
    """Yield the pairs i < j of edges that may intersect, in chunks; without neighbours by default.

    The coordinate of a vertex along an axis of `AXES` is off by at most ``error``, and by U times
    the largest coordinate as its one sum is rounded; `TINY` covers underflow. ``off`` covers twice
    that, and the rounding of its subtraction.

    Args:
        first: shape (n, 2), where the edges start, in finite numbers.
        last: where they end; the next one starts there.
        error: a bound on the errors of all coordinates.
        closed: whether the first edge starts where the last one ends.
        neighbours: whether to yield neighbours, too; then edges may start anywhere.
    """
    n, (x, y), (u, v) = len(first), first.T.copy(), last.T.copy()
    off = 4.0 * (error + U * float(np.abs(first).max())) * SLACK + TINY
    edges: Extents = []
    for p, q in AXES:
        a, b = p * x + q * y, p * u + q * v
        edges.append((np.minimum(a, b) - off, np.maximum(a, b)))
    starts = np.arange(0, n, LENGTH)
    chains = [
        (np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)) for low, high in edges
    ]
    boxes = np.stack((*chains[0], *chains[1]), axis=1)
    each = np.arange(len(starts))
    for one, other in chain([(each, each)], overlapping_pairs(boxes)):
        for k in range(0, len(one), CHUNK):
            check_budget()
            i, j = _overlapping(chains[2:], one[k : k + CHUNK], other[k : k + CHUNK])
            i, j = _edges_of(i, j)
            wanted = (j > i) & (j < n)
            if not neighbours:
                wanted &= (j > i + 1) & ~(closed & (j - i == n - 1))
            yield _overlapping(edges, i[wanted], j[wanted])


def _overlapping(extents: Extents, i: Indices, j: Indices) -> Pairs:
    """Return the pairs that overlap along all axes."""
    for low, high in extents:
        left = np.flatnonzero((low[i] <= high[j]) & (low[j] <= high[i]))
        i, j = i[left], j[left]
    return i, j


def _edges_of(i: Indices, j: Indices) -> Pairs:
    """Return all pairs of an edge of the chain i and one of the chain j."""
    p, q = np.divmod(np.arange(LENGTH * LENGTH), LENGTH)
    return (LENGTH * i[:, None] + p).ravel(), (LENGTH * j[:, None] + q).ravel()
