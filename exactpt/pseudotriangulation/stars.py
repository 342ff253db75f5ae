"""The stars of many vertices at once: edges around a vertex sorted by angles in doubles.

The order by doubles is checked: each edge against the next one of its star, by the predicates. A
star that does not pass is sorted by the predicates alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from exactpt.certificates.at_time import PredicatesAt
from exactpt.indices import HalfEdge, VertexId
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats, Indices

Sort: TypeAlias = "Callable[[VertexId, HalfEdge, list[HalfEdge]], list[HalfEdge]]"
"""Sorts the half-edges out of a vertex, counter-clockwise from a reference among them."""


def follow_stars(
    instant: PredicatesAt, origin: Indices, ring: Sequence[VertexId], ahead: Indices, sort: Sort
) -> Indices:
    """Return the half-edge after each one around its face, for edges of rings and diagonals.

    Counter-clockwise around a vertex there are the edge to the next vertex of the ring, the edge
    to the vertex before, and the diagonals, all of them in free space.

    Args:
        instant: the predicates.
        origin: of each half-edge; the first ones are those of the edges of rings.
        ring: the vertices with rings: half-edge 2 k leads from ring[k] to the next vertex.
        ahead: of each vertex, the next one on its ring.
        sort: sorts a star that is not in order.
    """
    n, ids = len(ring), np.array(ring, np.int64)
    out = np.zeros(len(ahead), np.int64)
    out[ids] = 2 * np.arange(n)
    behind = np.zeros(len(ahead), np.int64)
    behind[ahead[ids]] = out[ids] + 1
    h = np.arange(2 * n, len(origin))
    of = origin[h]
    base, to = origin[behind[of] ^ 1], origin[h ^ 1]
    order = np.lexsort((_turn(instant, of, base, to), of))
    h, of, base, to = h[order], of[order], base[order], to[order]
    same = of[1:] == of[:-1]
    check_budget()
    is_paired = np.zeros(len(h), np.bool_)
    is_paired[1:] |= same
    is_paired[:-1] |= same
    half = np.zeros(len(h), np.int64)
    half[is_paired] = instant.signs_of(np.stack((of, base, to), axis=1)[is_paired])
    at = np.flatnonzero(same)
    level = at[half[at] == half[at + 1]]
    turns = np.zeros(len(h), np.int64)
    turns[level] = instant.signs_of(np.stack((of[level], to[level], to[level + 1]), axis=1))
    wrong = at[(half[at] < half[at + 1]) | ((half[at] == half[at + 1]) & (turns[at] <= 0))]
    for v in sorted(set(of[wrong].tolist())):
        first, last = np.searchsorted(of, v), np.searchsorted(of, v, side="right")
        star = sorted(h[first:last].tolist())  # as they were added
        h[first:last] = sort(v, HalfEdge(int(behind[v])), star)
    v = np.concatenate((ids, ids, of))
    kind = np.repeat((0, 1, 2), (n, n, len(h)))
    stars = np.concatenate((out[ids], behind[ids], h))
    order = np.lexsort((np.arange(len(v)), kind, v))
    v, stars = v[order], stars[order]
    before = np.roll(stars, 1)
    firsts = np.flatnonzero(np.concatenate(([True], v[1:] != v[:-1])))
    lasts = np.concatenate((firsts[1:], [len(v)])) - 1
    before[firsts] = stars[lasts]
    following = np.empty(len(origin), np.int64)
    following[stars ^ 1] = before
    return following


@np.errstate(all="ignore")
def _turn(instant: PredicatesAt, v: Indices, base: Indices, to: Indices) -> Floats:
    """Return the angles at v from the directions to base to those to ``to``, about."""
    x, y = instant.coordinates
    from_base = np.arctan2(y[base] - y[v], x[base] - x[v])
    return (np.arctan2(y[to] - y[v], x[to] - x[v]) - from_base) % (2.0 * np.pi)
