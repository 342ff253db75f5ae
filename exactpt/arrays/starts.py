"""Bodies that touch or overlap at the start: surely, surely not, or open."""

from __future__ import annotations

from typing import Final

import numpy as np

from exactpt.arrays.candidates import shifted
from exactpt.arrays.motions import Motions
from exactpt.arrays.outlines import Outlines
from exactpt.arrays.radii import core_distances
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.geometry.ragged import ranges, segments_meet, spread
from exactpt.kernel.doubles import Flags, Floats, Indices

CHUNK: Final = 1 << 14
"""Maximum number of pairs of edges in a chunk."""


@np.errstate(all="ignore")
def at_start(
    o: Outlines, i: Indices, j: Indices, motions: Motions, reach: Floats | None = None
) -> tuple[Flags, Flags]:
    """Return which pairs surely overlap without an incidence, and the undecided pairs.

    They overlap if two edges cross or, if no edges intersect, one contains a vertex of the other;
    or if their cores are nearer than a distance (``reach``), if there is one. Bodies whose boxes
    are apart do not.
    """
    overlaps = np.zeros(len(i), dtype=np.bool_)
    shift, off = motions.coefficients[:, :, 0], motions.off[:, 0]
    gap = np.maximum(o.low[j] - o.high[i] - shift, o.low[i] - o.high[j] + shift)
    limit = np.zeros(len(i)) if reach is None else reach
    size = limit[:, None] + np.maximum(np.abs(o.low[i]), np.abs(o.high[i])) + np.abs(shift)
    size += np.maximum(np.abs(o.low[j]), np.abs(o.high[j]))
    margin = (4.0 * U * size + off[:, None]) * SLACK
    unclear: Flags = ~np.any(gap > margin + limit[:, None], axis=1, keepdims=False)
    near = np.flatnonzero(unclear)
    counts = o.edge_count[i[near]] * o.edge_count[j[near]]
    for first, last in ranges(counts, CHUNK):
        k = near[first:last]
        overlaps[k], unclear[k] = _meet(o, i[k], j[k], motions.take(k))
        if reach is not None:
            k = k[~overlaps[k]]
            least, most = core_distances(o, i[k], j[k], motions.take(k))
            overlaps[k] = most < reach[k] * (1.0 - 4.0 * U)
            unclear[k] = ~overlaps[k] & (unclear[k] | ~(least > reach[k] * (1.0 + 4.0 * U)))
    return overlaps, unclear


def _meet(o: Outlines, i: Indices, j: Indices, motions: Motions) -> tuple[Flags, Flags]:
    owner, position = spread(o.edge_count[i] * o.edge_count[j])
    across = o.edge_count[j][owner]
    e = o.first_edge[i][owner] + position // across
    f = o.first_edge[j][owner] + position % across
    shift = motions.coefficients[:, :, 0]
    px, py = o.ax[f] - o.ax[e], o.ay[f] - o.ay[e]
    error: Floats | float = 0.0
    if not motions.plain:
        x, y = shift[owner].T
        px, py, error = shifted(px, py, -x, -y, motions.off[owner, 0])
    off = 0.0 if motions.edges is None else motions.edges[owner]
    apart, cross = segments_meet((o.ux[e], o.uy[e]), (o.ux[f], o.uy[f]), (px, py), error, off)
    n = len(i)
    crossing = np.bincount(owner[cross], minlength=n) > 0
    unclear = np.bincount(owner[~(apart | cross)], minlength=n) > 0
    for a, b, sign in ((i, j, 1.0), (j, i, -1.0)):
        left = np.flatnonzero(~(unclear | crossing) & o.rings[b])
        if len(left):
            contained, unsure = _first_inside(o, a[left], b[left], sign, motions.take(left))
            crossing[left] |= contained
            unclear[left] |= unsure
    return crossing & ~unclear, unclear


def _first_inside(
    o: Outlines, a: Indices, b: Indices, sign: float, motions: Motions
) -> tuple[Flags, Flags]:
    """Return whether the first vertex p of a is inside polygon b, and the undecided rows.

    A vertex on the boundary of b is not expected here.

    ``sign`` times the motions are those of a relative to b.

    A ray from p to the right crosses the edges of which one end is above p and the other is not,
    and p is on the left of an upward edge, or on the right of a downward one. Without an error a
    difference of doubles has its exact sign, also 0.
    """
    owner, position = spread(o.edge_count[b])
    e = o.first_edge[b][owner] + position
    v = o.first_vertex[a][owner]
    wx, wy = o.x[v] - o.ax[e], o.y[v] - o.ay[e]
    error: Floats | float = 0.0
    off = 0.0 if motions.edges is None else motions.edges[owner]
    plain = motions.plain
    if not plain:
        x, y = sign * motions.coefficients[owner, :, 0].T
        wx, wy, error = shifted(wx, wy, x, y, motions.off[owner, 0])
    start, end = -wy, o.uy[e] - wy
    margin = error
    if plain:
        end = o.y[o.edges.last[e]] - o.y[v]
    else:
        margin = (error + off + 2.0 * U * (np.abs(o.uy[e]) + np.abs(wy))) * SLACK
    ux, uy = o.ux[e], o.uy[e]
    turn = ux * wy - uy * wx
    bound = 8.0 * U * (np.abs(ux * wy) + np.abs(uy * wx)) + TINY
    bound += error * (np.abs(ux) + np.abs(uy) + 2.0 * off) * SLACK
    bound += off * (np.abs(wx) + np.abs(wy)) * SLACK
    straddles = (start > 0.0) != (end > 0.0)
    crossed = straddles & ((turn > 0.0) == (end > 0.0))
    sure = straddles & (np.abs(turn) > bound) | ~straddles
    if not plain:
        sure &= (np.abs(start) > margin) & (np.abs(end) > margin)
    n = len(a)
    inside = np.bincount(owner[crossed], minlength=n) % 2 == 1
    unsure = np.bincount(owner[~sure], minlength=n) > 0
    return inside & ~unsure, unsure
