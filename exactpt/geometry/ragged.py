"""Many bodies in one array of vertices: their edges, and a filter that finds them simple.

Body k has the vertices ``offsets[k]`` to ``offsets[k + 1]`` - 1. A filter, never a decision:
the other bodies are for `exactpt.geometry.polygon.first_self_touch`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.geometry.edge_pairs import near_edges
from exactpt.kernel.doubles import Flags, Floats, Indices, native

K: Final = 8.0 * U
"""Relative bound on the rounding of an orientation: see `segments_meet`."""
MAX_EDGES: Final = 64
"""Maximum number of edges of a body whose pairs of edges are all compared."""
_CHUNK: Final = 1 << 16
"""Maximum number of pairs of edges in a chunk."""


class Edges(NamedTuple):
    """The edges of many bodies; a point has one, from itself to itself.

    Attributes:
        first, last: their vertices.
        offsets: body k has the edges ``offsets[k]`` to ``offsets[k + 1]`` - 1; its edge i starts
            at its vertex i.
    """

    first: Indices
    last: Indices
    offsets: Indices


def spread(counts: Indices) -> tuple[Indices, Indices]:
    """For each k the numbers 0 to ``counts[k]`` - 1, as arrays of k and of these numbers."""
    ends = np.cumsum(counts)
    owner = np.repeat(np.arange(len(counts)), native(counts))
    return owner, np.arange(len(owner)) - np.repeat(ends - counts, native(counts))


def ranges(counts: Indices, most: int) -> list[tuple[int, int]]:
    """Consecutive ranges of counts, each with a sum of at most ``most`` or of one entry."""
    ends = np.cumsum(counts)
    cuts, first = [], 0
    while first < len(counts):
        before = int(ends[first - 1]) if first else 0
        last = max(first + 1, int(np.searchsorted(ends, before + most, side="right")))
        cuts.append((first, last))
        first = last
    return cuts


def edges_of(offsets: Indices, closed: Flags) -> Edges:
    """Return the edges of bodies: polygons if closed and of three or more vertices."""
    sizes = np.diff(offsets)
    rings, points = closed & (sizes > 2), sizes == 1
    counts = np.where(rings | points, sizes, sizes - 1)
    ends = np.cumsum(counts)
    first = np.arange(counts.sum()) + np.repeat(offsets[:-1] - (ends - counts), native(counts))
    last = first + 1
    back = rings | points
    last[ends[back] - 1] = offsets[:-1][back]
    return Edges(first, last, np.concatenate(([0], ends)))


@np.errstate(all="ignore")
def segments_meet(
    u: tuple[Floats, Floats],
    v: tuple[Floats, Floats],
    p: tuple[Floats, Floats],
    error: Floats | float,
    off: Floats | float = 0.0,
) -> tuple[Flags, Flags]:
    """For pairs of closed segments ab and cd: whether they surely are disjoint, surely cross.

    Two that cross have one common point, inside both.

    Args:
        u: b - a, each coordinate with a relative error of at most U.
        v: d - c, likewise.
        p: c - a, each coordinate with a relative error of at most U and an absolute one.
        error: that absolute error.
        off: absolute errors of the coordinates of u and v, beside the relative ones.

    With q = d - a the orientations are u x p, u x q of ab and c, d, and v x -p, v x (u - p) of cd
    and a, b. A computed coordinate of q is off by at most 3 U (|p| + |v|) + error, one of u - p
    likewise; with the product and the difference, the errors of the orientations are at most 6 U
    times the sum of the products of absolute values, and ``error`` times the sum of the
    coordinates of u or v; two more units cover the rounding of the bound. ``off`` is added to the
    errors of u, v, q and u - p; with those of the other factor, of which the absolute error is at
    most ``error`` + ``off``, it adds at most ``off`` (|u| + |v| + |p| + 2 (``error`` + ``off``)).
    """
    (ux, uy), (vx, vy), (px, py) = u, v, p
    ax, ay, bx, by, cx, cy = (np.abs(x) for x in (ux, uy, vx, vy, px, py))
    more = off * (ax + ay + bx + by + cx + cy + 2.0 * (error + off))
    off_u = (error * (ax + ay) + more) * SLACK + TINY
    off_v = (error * (bx + by) + more) * SLACK + TINY
    c = _sign(ux * py - uy * px, K * (ax * cy + ay * cx) + off_u)
    d = _sign(ux * (py + vy) - uy * (px + vx), K * (ax * (cy + by) + ay * (cx + bx)) + off_u)
    a = _sign(vy * px - vx * py, K * (bx * cy + by * cx) + off_v)
    b = _sign(vx * (uy - py) - vy * (ux - px), K * (bx * (ay + cy) + by * (ax + cx)) + off_v)
    apart = (c * d > 0) | (a * b > 0)
    beyond = error + 2.0 * off
    apart |= _beside(ux, px, vx, beyond) | _beside(uy, py, vy, beyond)
    return apart, (c * d < 0) & (a * b < 0)


def _beside(u: Floats, p: Floats, v: Floats, error: Floats | float) -> Flags:
    """Return True if the interval from 0 to u and that from p to p + v surely are disjoint.

    p + v is off by at most 3 U (|p| + |v|) + error, and u by U |u|; ``error`` includes all
    absolute errors.
    """
    q = p + v
    margin = (K * (np.abs(u) + np.abs(p) + np.abs(v)) + error) * SLACK + TINY
    gap = np.minimum(p, q) - np.maximum(u, 0.0)
    gap = np.maximum(gap, np.minimum(u, 0.0) - np.maximum(p, q))
    beside: Flags = gap > margin
    return beside


def cross_signs(
    u: tuple[Floats, Floats], v: tuple[Floats, Floats], off: Floats | float = 0.0
) -> NDArray[np.int8]:
    """Return the signs of u x v, rounded differences of coordinates; 0 where they are not certain.

    Args:
        u: shape (n,) each, with a relative error of at most U, and ``off``.
        v: likewise.
        off: a bound on the absolute errors of the exact differences.
    """
    (ux, uy), (vx, vy) = u, v
    p, q = ux * vy, uy * vx
    size = np.abs(ux) + np.abs(uy) + np.abs(vx) + np.abs(vy)
    return _sign(p - q, K * (np.abs(p) + np.abs(q)) + off * (size + 2.0 * off) * SLACK + TINY)


def _sign(value: Floats, error: Floats) -> NDArray[np.int8]:
    return (value > error).astype(np.int8) - (value < -error).astype(np.int8)


@np.errstate(all="ignore")
def surely_simple(
    vertices: Floats, offsets: Indices, closed: Flags, rounded: Floats | None = None
) -> Flags:
    """For each body, whether it surely is a simple polygon or chain, at rest.

    Args:
        vertices: shape (N, 2).
        offsets: shape (n + 1,).
        closed: shape (n,).
        rounded: shape (n,), if vertices are the doubles nearest to the exact ones: bounds on the
            errors of their coordinates. Doubles that differ are nearest to numbers that do.

    A difference of doubles is 0 only if they are equal, and has the sign of the exact one. A
    polygon that turns the same way at every vertex, by less than a half turn, and whose edges
    change from downward to upward once, turns by 2 pi: it is convex. So is each one of which the
    vertices are that near, since all turns on the way to it have the same sign.
    """
    sizes = np.diff(offsets)
    edges = edges_of(offsets, closed)
    first, last = vertices[edges.first], vertices[edges.last]
    d = last - first
    dx, dy = d[:, 0], d[:, 1]
    before = np.arange(len(d)) - 1
    before[edges.offsets[:-1]] = edges.offsets[1:] - 1
    off = None if rounded is None else 2.0 * SLACK * rounded
    each = 0.0 if off is None else np.repeat(off, native(np.diff(edges.offsets)))
    turn = cross_signs((dx[before], dy[before]), (dx, dy), each)
    upward = (dy > 0.0) | ((dy == 0.0) & (dx > 0.0))
    starts = native(edges.offsets[:-1])
    rings = closed & (sizes > 2)
    one_way = np.abs(np.add.reduceat(turn, starts, dtype=np.int64)) == sizes
    rises = np.add.reduceat(upward & ~upward[before], starts, dtype=np.int64)
    convex = rings & one_way & (rises == 1)
    distinct = ~np.logical_or.reduceat((dx == 0.0) & (dy == 0.0), starts)
    short = (sizes == 1) | ((sizes == 2) & distinct)
    inner = turn != 0
    inner[starts[~rings]] = True  # a chain does not turn at its ends
    bends = np.logical_and.reduceat(inner, starts)
    simple: Flags = short | convex
    candidates = np.flatnonzero(~simple & distinct & bends)
    counts = np.diff(edges.offsets)[candidates]
    few, many = candidates[counts <= MAX_EDGES], candidates[counts > MAX_EDGES]
    for start, stop in ranges(counts[counts <= MAX_EDGES] ** 2, _CHUNK):
        some = few[start:stop]
        simple[some] = _apart_from_itself(first, d, edges, some, rings[some], off)
    for k in many.tolist():
        own = slice(edges.offsets[k], edges.offsets[k + 1])
        wide = 0.0 if off is None else float(off[k])
        pairs = near_edges(first[own], last[own], wide, closed=bool(rings[k]))
        simple[k] = all(_surely_apart(first[own], d[own], i, j, wide).all() for i, j in pairs)
    return simple


def _apart_from_itself(
    first: Floats, d: Floats, edges: Edges, some: Indices, rings: Flags, off: Floats | None
) -> Flags:
    """Return True if no two edges of a body intersect that are not neighbours.

    ``off`` bounds the errors of the differences of two vertices of each body.
    """
    sizes = edges.offsets[some + 1] - edges.offsets[some]
    owner, position = spread(sizes * sizes)
    i, j = np.divmod(position, sizes[owner])
    near = (i + 1 >= j) | ((i == 0) & (j == sizes[owner] - 1) & rings[owner])
    owner, i, j = owner[~near], i[~near], j[~near]
    e, f = edges.offsets[some[owner]] + i, edges.offsets[some[owner]] + j
    error = 0.0 if off is None else off[some[owner]]
    apart = _surely_apart(first, d, e, f, error)
    simple: Flags = np.bincount(owner[~apart], minlength=len(some)) == 0
    return simple


def _surely_apart(first: Floats, d: Floats, e: Indices, f: Indices, off: Floats | float) -> Flags:
    """Return True for the pairs (e, f) of edges that surely are disjoint.

    They start at ``first``, their vectors are ``d``. ``off`` bounds the errors of the differences
    of two vertices, in each coordinate.
    """
    p = first[f] - first[e]
    u, v = (d[e, 0], d[e, 1]), (d[f, 0], d[f, 1])
    return segments_meet(u, v, (p[:, 0], p[:, 1]), off, off)[0]


@np.errstate(all="ignore")
def unclear_pairs(
    x: Sequence[float], y: Sequence[float], edges: Sequence[tuple[int, int]], error: float
) -> Iterator[tuple[int, int]]:
    """Yield the pairs i < j of edges that may have more in common than an end of both.

    Args:
        x: coordinates of points.
        y: the other coordinates.
        edges: pairs of these points.
        error: a bound on the errors of all coordinates.
    """
    points = np.array((x, y)).T
    starts, ends = np.array(edges).T
    first, last = points[starts], points[ends]
    d = last - first
    off = 2.0 * SLACK * error
    for i, j in near_edges(first, last, error, closed=False, neighbours=True):
        joined = (starts[i] == starts[j]) | (starts[i] == ends[j])
        joined |= (ends[i] == starts[j]) | (ends[i] == ends[j])
        bend = cross_signs((d[i, 0], d[i, 1]), (d[j, 0], d[j, 1]), off) != 0
        clear = np.where(joined, bend, _surely_apart(first, d, i, j, off))
        yield from zip(i[~clear].tolist(), j[~clear].tolist(), strict=True)
