"""The first time at which a vertex touches an edge: enclosures, and undecided pairs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from exactpt.arrays.relative import Coefficient, Relative, orientations, sides
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.doubles import Flags, Floats, Indices
from exactpt.kernel.vectorized import Answers, linears, quadratics

INFINITY: Final = np.inf


class Span(NamedTuple):
    """The lengths of time spans: doubles at most and at least the exact ones."""

    low: Floats
    high: Floats

    def take(self, index: Indices) -> Span:
        """Return the entries at the given places."""
        return Span(self.low[index], self.high[index])


class IncidenceTimes(NamedTuple):
    """An enclosure of the first time s at which a vertex is on its edge.

    Both are infinite if it never is during the span; if ``low`` alone is finite, it is open
    whether it is, and the time is at least ``low``. Where both are finite, the vertex is inside
    the edge at that time, and on it at no earlier one.
    """

    low: Floats
    high: Floats


@np.errstate(all="ignore")
def first_incidences(r: Relative, span: Span, reach: Floats | None = None) -> IncidenceTimes:
    """Return the first incidences during 0 <= s <= span, the start included.

    Of cores that keep a distance R (``reach``, with a relative error of at most U) and that are
    farther apart at the start, the first times at which the vertex is at this distance from the
    edge, its foot on it. A vertex is at that distance from the line where the orientation f is
    -h or h, h = R |u|. Where f is linear, only the smaller of the two roots may be a first contact,
    as from it to the larger one the vertex is in the strip -h <= f <= h: that of f + sgn(c1) h;
    where the sign of c1 is not known, that of the side of the strip next to which f is at the
    start. R, |u| and their
    product are off by at most 5 U of h, and by `TINY` |u| if R is not normal, the sum with c0 by
    U (|c0| + h).
    """
    cs = orientations(r)
    if reach is None:
        return _first_incidences(r, cs, span)
    (c0, e0), (c1, e1) = cs[:2]
    ux, uy = r.u[0]
    h = reach * np.hypot(ux, uy)
    e0 = e0 + (16.0 * U * h + 2.0 * U * np.abs(c0)) * SLACK + TINY * (1.0 + np.abs(ux) + np.abs(uy))
    shifts = [h, -h] if len(cs) > 2 else [np.copysign(h, np.where(np.abs(c1) > e1, c1, -c0))]
    found = [_first_incidences(r, [(c0 + shift, e0), *cs[1:]], span) for shift in shifts]
    low, high = (np.minimum.reduce(columns) for columns in zip(*found, strict=True))
    for each in found:
        high[(each.low <= high) & (each.low < INFINITY) & (each.high == INFINITY)] = INFINITY
    if r.length is not None:  # points: two vertices
        low[r.length == 0.0] = high[r.length == 0.0] = INFINITY
    return IncidenceTimes(low, high)


def _first_incidences(r: Relative, cs: Sequence[Coefficient], span: Span) -> IncidenceTimes:
    """Return the first incidences, by the polynomials that vanish while a vertex is on its line.

    A vertex is on the line of its edge at the zeros of the orientation. The first zero after the
    start is looked at, and where the vertex surely is beside the edge there, the second. A zero
    at the start is open, unless the vertex surely is beside the edge. At last, an open result is
    closed where the vertex is beside the edge at all times.
    """
    c0, e0 = cs[0]
    starts = (c0 == 0.0) & (e0 == 0.0)
    signs, low, high = _first_zeros(cs, 0.0, 0.0, span.high, starts)
    unsure = (signs == 0) | ~(starts | (np.abs(c0) > e0))
    low[unsure], high[unsure] = 0.0, INFINITY
    _settle(r, cs, span, low, high)
    high[high > span.low] = INFINITY
    at_start = np.flatnonzero(starts)
    if len(at_start):
        now = np.zeros(len(at_start))
        met = at_start[~sides(r.take(at_start), now, now)[1]]
        low[met], high[met] = 0.0, INFINITY
    left = np.flatnonzero((high == INFINITY) & (low < INFINITY))
    if len(left):
        beside = sides(r.take(left), low[left], span.high[left])[1]
        low[left[beside]] = INFINITY
    return IncidenceTimes(low, high)


def _settle(r: Relative, cs: Sequence[Coefficient], span: Span, low: Floats, high: Floats) -> None:
    """Look where the vertex is at the zeros in [low, high]; in place."""
    found = np.flatnonzero(high < INFINITY)
    first_low, first_high = low[found], high[found]
    inside, beside = sides(r.take(found), first_low, first_high)
    high[found[~inside]] = INFINITY
    past = found[beside]
    if len(cs) != 3 or not len(past):
        low[past] = INFINITY
        return
    rest = [(c[past], e[past]) for c, e in cs]
    known = np.ones(len(past), dtype=np.bool_)
    answers = _first_zeros(rest, first_low[beside], first_high[beside], span.high[past], known)
    clear = answers.signs != 0
    past, lows, highs = past[clear], answers.lows[clear], answers.highs[clear]
    low[past], high[past] = lows, highs
    found = past[highs < INFINITY]
    inside, beside = sides(r.take(found), low[found], high[found])
    high[found[~inside]] = INFINITY
    low[found[beside]] = INFINITY


def _first_zeros(
    cs: Sequence[Coefficient], now_low: Floats | float, now_high: Floats | float,
    horizon: Floats, at_root: Flags,
) -> Answers:  # fmt: skip
    """Return each polynomial's first zero after now, up to the horizon; sign 0 if undecided."""
    if len(cs) == 2:
        (c0, e0), (c1, e1) = cs
        return linears(c0, c1, e0, e1, now_low, now_high, horizon, at_root)
    if len(cs) == 3:
        (c0, e0), (c1, e1), (c2, e2) = cs
        return quadratics(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)
    return _without_zeros(cs, horizon)


def _without_zeros(cs: Sequence[Coefficient], horizon: Floats) -> Answers:
    """Return the rows whose constant term outweighs the others; the other rows are undecided."""
    most = np.zeros_like(horizon)
    for c, e in cs[:0:-1]:
        most = (most + np.abs(c) + e) * horizon
    c0, e0 = cs[0]
    steady = np.abs(c0) > (e0 + most) * SLACK + TINY
    nothing = np.where(steady, INFINITY, 0.0)
    return Answers(steady.astype(np.int64), nothing, nothing.copy())
