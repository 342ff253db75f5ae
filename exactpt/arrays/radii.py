"""Bodies with radii in arrays: distances of cores at the start, and vertices at a distance.

Two of which one has a radius touch where the distance of their cores is R, the sum of the radii:
a vertex and an edge as in `exactpt.arrays.incidence_times`; two vertices, z apart, at the zeros of
F = |z|^2 - R^2, a polynomial in s that is positive before the first contact. R is the rounded sum
of two doubles, with a relative error of at most U.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import Final

import numpy as np

from exactpt.arrays.candidates import Candidates, all_candidates, shifted
from exactpt.arrays.incidence_times import INFINITY, IncidenceTimes
from exactpt.arrays.motions import Motions
from exactpt.arrays.outlines import Outlines
from exactpt.arrays.relative import Coefficient
from exactpt.filters.rounding import SLACK, SMALL, TINY, U
from exactpt.kernel.doubles import Floats, Indices, native
from exactpt.kernel.vectorized import quadratics

K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms, and of products of two."""
DEPTH: Final = 12
"""Maximum number of times that an interval is halved."""
STEPS: Final = 6
"""Number of Newton steps to a zero."""


@np.errstate(all="ignore")
def core_distances(o: Outlines, i: Indices, j: Indices, motions: Motions) -> tuple[Floats, Floats]:
    """Return bounds of the distances of disjoint cores at the start (vertices from edges).

    The distance of a point from a segment changes by at most the displacements of the point and
    of the ends relative to it: of u and w, U (|u| + |w|) and the absolute error of w. With the
    foot at an inexact ratio of the ends, the computed distance is too large by at most the
    displacement of the foot, 6 U |w|: the ratio is off by 6 U |w| / |u|, if |u|^2 is not tiny and
    (|u| + |w|)^2, which bounds u . u and the products of u . w, does not overflow. Computing it
    takes 7 U (|u| + |w|) more.
    """
    candidates, starts = all_candidates(o, i, j)
    r = candidates.relative(o, motions)
    (ux, uy), (wx, wy) = r.u[0], r.w[0]
    square = ux * ux + uy * uy
    at = np.clip((ux * wx + uy * wy) / square, 0.0, 1.0)
    if r.length is not None:
        at *= r.length
    far = np.hypot(wx - at * ux, wy - at * uy)
    size = np.abs(ux) + np.abs(uy) + np.abs(wx) + np.abs(wy)
    error = 2.0 * K * size
    error = (error + (0.0 if r.off_w[0] is None else 2.0 * r.off_w[0])) * SLACK + TINY
    sure = (square > SMALL) & (size * size < INFINITY)
    least = np.where(sure, far - error, -INFINITY)
    low, high = (
        np.minimum.reduceat(f, native(starts)).reshape(2, -1).min(axis=0)
        for f in (least, far + error)
    )
    return low, high


@np.errstate(all="ignore")
def vertex_incidences(
    o: Outlines, motions: Motions, c: Candidates, reach: Floats, until: Floats
) -> IncidenceTimes:
    """Return the first times at which pairs of vertices are at a distance.

    Args:
        o: the outlines.
        motions: those of the pairs of bodies, which are farther apart at the start.
        c: the vertices.
        reach: the distance of each pair of bodies.
        until: times after which an incidence does not count.
    """
    pair, moved = c.pair, motions.coefficients
    x, y, off = shifted(
        o.x[c.vertex] - o.x[c.corner], o.y[c.vertex] - o.y[c.corner],
        moved[pair, 0, 0], moved[pair, 1, 0], motions.off[pair, 0],
    )  # fmt: skip
    z = [(x, y, off)]
    for k in range(1, motions.degree + 1):
        z += [(moved[pair, 0, k], moved[pair, 1, k], motions.off[pair, k])]
    fs, end = _squares(z, reach[pair]), until[pair]
    if len(fs) > 3:
        return _first_zeros(fs, end)
    (c0, e0), (c1, e1), (c2, e2) = fs
    nothing = np.zeros(len(pair), dtype=np.bool_)
    signs, low, high = quadratics(c0, c1, c2, e0, e1, e2, 0.0, 0.0, end, nothing)
    low[signs == 0], high[signs == 0] = 0.0, INFINITY
    return IncidenceTimes(low, high)


def _squares(z: Sequence[tuple[Floats, Floats, Floats]], reach: Floats) -> list[Coefficient]:
    """Return the coefficients of x^2 + y^2 - R^2, and bounds on their errors.

    A product of coefficients with the absolute errors d, e is off by d e and, for each factor, by
    its absolute value times the error of the other.
    """
    found: list[Coefficient] = []
    for k in range(2 * len(z) - 1):
        value, error = np.zeros_like(reach), np.zeros_like(reach)
        for a in range(max(0, k - len(z) + 1), min(k, len(z) - 1) + 1):
            (x, y, d), (u, v, e) = z[a], z[k - a]
            p, q = x * u, y * v
            value = value + (p + q)
            error = error + (np.abs(x) + np.abs(y)) * e + (np.abs(u) + np.abs(v)) * d
            error = error + 2.0 * d * e + len(z) * K * (np.abs(p) + np.abs(q))
        found.append((value, error * SLACK + TINY))
    square = reach * reach
    value, error = found[0]
    found[0] = value - square, error + K * (square + np.abs(value))
    return found


def _first_zeros(fs: Sequence[Coefficient], until: Floats) -> IncidenceTimes:
    """Return the first zeros in [0, until] of polynomials that are positive at 0.

    A polynomial on an interval is between the least and the greatest of its Bernstein coefficients
    b_0, ..., b_n there, and so is its derivative between those of the n (b_k+1 - b_k), over the
    length. Intervals in which it is surely positive are left out, and those at whose start it is
    surely negative: a zero is before. The others are halved, until it surely falls from a positive
    to a negative number: there it has one zero. Where all b_k are within their error, so are those
    of the halves: such an interval stays undecided.

    The b_k are sums of shares of the terms c_k t^k, whose errors add up to at most ``off``, if no
    power of t underflows; a halving adds at most n U times the largest b_k of the whole interval.
    """
    n = len(fs) - 1
    until = np.minimum(until, 1.0 / TINY)  # so late, powers overflow
    terms, size, off, power = [], np.zeros_like(until), np.zeros_like(until), np.ones_like(until)
    for c, e in fs:
        terms.append(c * power)
        size, off, power = size + np.abs(terms[-1]), off + e * power, power * until
    b = np.array([
        sum(comb(k, m) / comb(n, m) * terms[m] for m in range(k + 1)) for k in range(n + 1)
    ])  # fmt: skip
    off = (off + (8 + 4 * n + n * DEPTH) * U * size) * SLACK + TINY
    off[~(power > TINY)] = INFINITY
    low, high, undecided = (np.full(len(until), INFINITY) for _ in range(3))
    row, begin, width = np.arange(len(until)), np.zeros(len(until)), 1.0
    for depth in range(DEPTH + 1):
        e = off[row]
        may = ~(b.min(axis=0) > e) & ~(b[0] < -e) & ~(begin * until[row] > high[row])
        lost = may if depth == DEPTH else may & ~(np.abs(b).max(axis=0) > e)
        np.minimum.at(undecided, row[lost], begin[lost] * until[row[lost]] * (1.0 - 4.0 * U))
        may = may & ~lost
        b, row, begin = b[:, may], row[may], begin[may]
        if not len(row):
            break
        e, fall = off[row], -np.diff(b, axis=0).max(axis=0)
        alone = (fall > 2.0 * e) & (b[0] > e) & (b[-1] < -e)
        if alone.any():
            some = row[alone]
            start, length = begin[alone] * until[some], width * until[some]
            slope = n * (fall - 2.0 * e)[alone] / length
            zero, error = _zero([(c[some], e[some]) for c, e in fs], start, start + length, slope)
            # fmax and fmin take the other number instead of a NaN, which bounds nothing.
            np.minimum.at(low, some, np.fmax(zero - error, start * (1.0 - 4.0 * U)))
            np.fmin.at(high, some, zero + error)
        b, row, begin = b[:, ~alone], row[~alone], begin[~alone]
        left, right = [b[0]], [b[-1]]
        for _ in range(n):
            b = 0.5 * (b[:-1] + b[1:])
            left.append(b[0])
            right.append(b[-1])
        width *= 0.5
        b = np.concatenate((left, right[::-1]), axis=1)
        row, begin = np.tile(row, 2), np.concatenate((begin, begin + width))
    high[undecided <= high] = INFINITY
    return IncidenceTimes(np.minimum(low, undecided), high)


def _zero(
    fs: Sequence[Coefficient], low: Floats, high: Floats, slope: Floats
) -> tuple[Floats, Floats]:
    """Return the zero in [low, high] of polynomials that fall there, and a bound on its error.

    By the mean value theorem it is at most (|f| + the error of f) / slope off, where f is the value
    at a number in the interval, and the slope at least ``slope``.
    """
    t = 0.5 * (low + high)
    for _ in range(STEPS):
        value, derivative = np.zeros_like(t), np.zeros_like(t)
        for c, _e in reversed(fs):
            derivative = derivative * t + value
            value = value * t + c
        t = np.clip(t - value / derivative, low, high)
    value, error, size = np.zeros_like(t), np.zeros_like(t), np.zeros_like(t)
    for c, e in reversed(fs):
        value, error, size = value * t + c, error * t + e, size * t + np.abs(c)
    error = error + 4.0 * len(fs) * U * size
    return t, ((np.abs(value) + error) / slope + 4.0 * U * t) * SLACK + TINY
