"""The filters of degree 1 and 2 for many polynomials at once, in numpy.

These are the operations of `exactpt.certificates.first_root` in the same order, so its proofs hold
here: arrays of doubles round as single ones do. The results are those of the scalar
filters, bit for bit; an early return there is a mask here.

They pay off from about 50 polynomials on, and are 6 to 8 times faster for thousands.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U2, U4, U8
from exactpt.kernel.doubles import Flags, Floats, Indices


class Answers(NamedTuple):
    """An `exactpt.filters.rounding.Answer` for each polynomial: sign 0 means unsure."""

    signs: Indices
    lows: Floats
    highs: Floats


@np.errstate(all="ignore")
def linears(
    c0: Floats,
    c1: Floats,
    e0: Floats,
    e1: Floats,
    now_low: Floats | float,
    now_high: Floats | float,
    horizon: Floats | float,
    at_root: Flags,
) -> Answers:
    """Return the results for c0 + c1 t: see `exactpt.certificates.first_root.linear`."""
    gap = abs(c1) - e1
    sloped = (gap > SMALL) & (gap < INFINITY)
    root = -c0 / c1
    size = abs(root)
    error = ((e0 + e1 * size) / gap + U4 * size) * SLACK + TINY
    low, high = root - error, root + error
    past = at_root | (high <= now_low)
    later = ~past & (low > now_high)
    size = abs(c0)
    reach = np.maximum(np.maximum(np.abs(now_low), np.abs(now_high)), np.abs(horizon))
    steady = (size < INFINITY) & (size > (e0 + (abs(c1) + e1) * reach) * SLACK + TINY)
    rising = _sign(c1)
    signs = np.where(
        sloped,
        np.where(past, rising, np.where(later, -rising, 0)),
        np.where(steady, _sign(c0), 0),
    )
    return _answers(signs, sloped & later & ~(low > horizon), low, high)


@np.errstate(all="ignore")
def quadratics(
    c0: Floats,
    c1: Floats,
    c2: Floats,
    e0: Floats,
    e1: Floats,
    e2: Floats,
    now_low: Floats | float,
    now_high: Floats | float,
    horizon: Floats | float,
    at_root: Flags,
) -> Answers:
    """Return the results for c0 + c1 t + c2 t^2: see `first_root.quadratic`."""
    square = c1 * c1
    product = 4.0 * c0 * c2
    d = square - product
    a2 = abs(c2)
    error_d = (
        e1 * (2.0 * abs(c1) + e1)
        + 4.0 * (abs(c0) * e2 + (a2 + e2) * e0)
        + U4 * (square + abs(product))
    ) * SLACK + TINY
    no_root = d < -error_d
    root_d = np.sqrt(d)
    error_root = error_d / root_d * SLACK + U2 * root_d
    q = np.where(c1 >= 0.0, -0.5 * (c1 + root_d), -0.5 * (c1 - root_d))
    size = abs(q)
    error_q = (0.5 * (e1 + error_root) + U2 * size) * SLACK
    gap_q, gap_2 = size - error_q, a2 - e2
    two_roots = (d > error_d) & (gap_q > SMALL) & (gap_2 > SMALL)
    near = c0 / q
    size = abs(near)
    error_near = ((e0 + size * error_q) / gap_q + U8 * size) * SLACK + TINY
    far = q / c2
    size = abs(far)
    error_far = ((error_q + size * e2) / gap_2 + U8 * size) * SLACK + TINY
    far_first = (c1 >= 0.0) == (c2 > 0.0)
    first, error_first = np.where(far_first, (far, error_far), (near, error_near))
    second, error_second = np.where(far_first, (near, error_near), (far, error_far))
    low1, high1 = first - error_first, first + error_first
    low2, high2 = second - error_second, second + error_second
    after1, after2 = low1 > now_high, low2 > now_high
    unclear1, unclear2 = ~after1 & ~(high1 <= now_low), ~after2 & ~(high2 <= now_low)
    clear = two_roots & np.where(at_root, unclear1 != unclear2, ~(unclear1 | unclear2))
    clear &= ~(after1 & (high1 >= low2))  # an enclosure must hold one root only
    between = ~after1 & after2
    s = _sign(c2)
    signs = np.where(no_root, s, np.where(clear, np.where(between, -s, s), 0))
    low, high = np.where(after1, (low1, high1), (low2, high2))
    answers = _answers(signs, clear & (after1 | after2) & (low <= horizon), low, high)
    flat = (d > error_d) & (gap_q > SMALL) & ~((gap_2 > SMALL) & (a2 > 4.0 * e2))
    if flat.any():
        reach = gap_q / ((a2 + e2) * SLACK + TINY) - TINY
        rising = np.where(c1 >= 0.0, 1, -1)
        ends = near - error_near, near + error_near
        alone = _near_alone(rising, *ends, reach, now_low, now_high, horizon, at_root)
        wanted = flat & ((alone.signs != 0) | ~(gap_2 > SMALL))
        answers = Answers(*map(np.where, [wanted] * 3, alone, answers))
    steady = ~no_root & ~((d > error_d) & (gap_q > SMALL))
    if steady.any():
        reach = np.maximum(np.maximum(np.abs(now_low), np.abs(now_high)), np.abs(horizon))
        rest = (e0 + ((abs(c1) + e1) + (a2 + e2) * reach) * reach) * SLACK + TINY
        steady &= (abs(c0) < INFINITY) & (abs(c0) > rest)
        nothing = np.full(len(c0), INFINITY)
        answers = Answers(
            *map(np.where, [steady] * 3, Answers(_sign(c0), nothing, nothing), answers)
        )
    straight = (c2 == 0.0) & (e2 == 0.0)
    if straight.any():
        others = linears(c0, c1, e0, e1, now_low, now_high, horizon, at_root)
        return Answers(*map(np.where, [straight] * 3, others, answers))
    return answers


def _near_alone(
    s: Indices,
    low: Floats,
    high: Floats,
    reach: Floats,
    now_low: Floats | float,
    now_high: Floats | float,
    horizon: Floats | float,
    at_root: Flags,
) -> Answers:
    """Return the results with one root alone: see `exactpt.certificates.first_root._near_alone`."""
    alone = (-reach < low) & (high < reach) & (-reach < now_low) & (now_high < reach)
    past = at_root | (high <= now_low)
    before = alone & past & (horizon < reach)
    later = alone & ~past & (low > now_high)
    signs = np.where(before, s, np.where(later, -s, 0))
    return _answers(signs, later & (low <= horizon), low, high)


def _sign(x: Floats) -> Indices:
    return np.where(x > 0.0, 1, -1)


def _answers(signs: Indices, found: Flags, low: Floats, high: Floats) -> Answers:
    nothing = np.where(signs == 0, 0.0, INFINITY)
    return Answers(signs, np.where(found, low, nothing), np.where(found, high, nothing))
