"""Float filters: the sign of a polynomial now and its first root later, or "unsure".

A polynomial is given by doubles c[i] and bounds e[i] on their errors: the true
coefficient lies in [c[i] - e[i], c[i] + e[i]]. An `Answer` is proved for every such
polynomial, whatever the doubles; "unsure" sends the caller to exact arithmetic. "Now" is
a time in [now_low, now_high].

Source: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
section 1.8 (quadratic equations).
"""

from __future__ import annotations

import math

from exactpt.certificates.root_windows import polynomial
from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U2, U4, U8, UNSURE, Answer

__all__ = ["SLACK", "UNSURE", "Answer", "any_degree", "linear", "polynomial", "quadratic"]


def any_degree(
    c: list[float],
    e: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for sum(c[i] t^i), whose leading coefficients may be 0."""
    n = len(c)
    while n > 1 and c[n - 1] == 0.0 and e[n - 1] == 0.0:
        n -= 1
    if n <= 2:
        c1, e1 = (c[1], e[1]) if n == 2 else (0.0, 0.0)
        return linear(c[0], c1, e[0], e1, now_low, now_high, horizon, at_root)
    if n == 3:
        return quadratic(
            c[0], c[1], c[2], e[0], e[1], e[2], now_low, now_high, horizon, at_root
        )  # fmt: skip
    return polynomial(c[:n], e[:n], now_low, now_high, horizon, at_root)


def linear(
    c0: float,
    c1: float,
    e0: float,
    e1: float,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for c0 + c1 t.

    With the true coefficients c0 + d0, c1 + d1, |d0| <= e0, |d1| <= e1 < |c1|, and
    root = fl(-c0 / c1), |root - r| <= U |r| for r = -c0 / c1:
        true root - root = (-d0 - d1 r) / (c1 + d1) + (r - root).

    Underflow: e1 |root| is off by 2^-1074 / gap <= 2^-774 after the division; r itself
    is off by 2^-1075, which e1 / gap <= 2^53 may multiply.

    ``at_root``: the polynomial is known to vanish now.
    """
    gap = abs(c1) - e1
    if SMALL < gap < INFINITY:
        root = -c0 / c1
        size = abs(root)
        error = ((e0 + e1 * size) / gap + U4 * size) * SLACK + TINY
        s = 1 if c1 > 0.0 else -1
        if at_root or root + error <= now_low:
            return (s, INFINITY, INFINITY)
        low = root - error
        if low > now_high:
            if low > horizon:
                return (-s, INFINITY, INFINITY)
            return (-s, low, root + error)
        return UNSURE
    # No root exists up to the horizon if the constant term dominates.
    reach = max(abs(now_low), abs(now_high), abs(horizon))
    if INFINITY > abs(c0) > (e0 + (abs(c1) + e1) * reach) * SLACK + TINY:
        return (1 if c0 > 0.0 else -1, INFINITY, INFINITY)
    return UNSURE


def quadratic(
    c0: float,
    c1: float,
    c2: float,
    e0: float,
    e1: float,
    e2: float,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for c0 + c1 t + c2 t^2.

    Discriminant D = c1^2 - 4 c0 c2 with error
        eD = e1 (2|c1| + e1) + 4 (|c0| e2 + (|c2| + e2) e0) + 4U (c1^2 + 4 |c0 c2|):
    the first two terms are the propagated errors of the coefficients, the last the
    rounding of three products and a difference.

    For D > eD both roots are real and simple. q = -(c1 + sgn(c1) sqrt(D)) / 2 has no
    cancellation; the roots are q / c2 and c0 / q. |sqrt(D ± eD) - sqrt(D)| <= eD / sqrt(D),
    and the quotients are bounded as in `linear`. q / c2 is the smaller one if and only
    if c1 >= 0 and c2 > 0 or c1 < 0 and c2 < 0.

    Underflow: in D by a few 2^-1074, below `TINY`. So D > 2^-500, sqrt(D) and |q| are
    above 2^-252, and any underflow before the quotients is far below the rounding of
    sqrt(D) and q. The quotients' own bounds are those of `linear`.

    If c2 may be 0, the bound of c0 / q holds as it stands, and the root q / c2, if there is
    one, is of size at least (|q| - eq) / (|c2| + e2): see `_near_alone`.

    ``at_root``: the polynomial is known to vanish now. The two enclosures are of two
    different roots; so if only one of them intersects [now_low, now_high], that root is now.
    """
    if c2 == 0.0 and e2 == 0.0:
        return linear(c0, c1, e0, e1, now_low, now_high, horizon, at_root)
    square = c1 * c1
    product = 4.0 * c0 * c2
    d = square - product
    a2 = abs(c2)
    error_d = (
        e1 * (2.0 * abs(c1) + e1)
        + 4.0 * (abs(c0) * e2 + (a2 + e2) * e0)
        + U4 * (square + abs(product))
    ) * SLACK + TINY
    if d < -error_d:
        # Then 4 c0 c2 > eD >= 4 |c0| e2, so the sign of c2 is certain.
        return (1 if c2 > 0.0 else -1, INFINITY, INFINITY)
    if not d > error_d:
        return _constant(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon)
    root_d = math.sqrt(d)
    error_root = error_d / root_d * SLACK + U2 * root_d
    q = -0.5 * (c1 + root_d) if c1 >= 0.0 else -0.5 * (c1 - root_d)
    size = abs(q)
    error_q = (0.5 * (e1 + error_root) + U2 * size) * SLACK
    gap_q, gap_2 = size - error_q, a2 - e2
    if not gap_q > SMALL:
        return _constant(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon)
    near = c0 / q
    size = abs(near)
    error_near = ((e0 + size * error_q) / gap_q + U8 * size) * SLACK + TINY
    if not (gap_2 > SMALL and a2 > 4.0 * e2):
        s = 1 if c1 >= 0.0 else -1
        reach = gap_q / ((a2 + e2) * SLACK + TINY) - TINY
        answer = _near_alone(
            s, near - error_near, near + error_near, reach, now_low, now_high, horizon, at_root
        )
        if answer[0] != 0 or not gap_2 > SMALL:
            return answer
    far = q / c2
    size = abs(far)
    error_far = ((error_q + size * e2) / gap_2 + U8 * size) * SLACK + TINY
    if (c1 >= 0.0) == (c2 > 0.0):
        low1, high1 = far - error_far, far + error_far
        low2, high2 = near - error_near, near + error_near
    else:
        low1, high1 = near - error_near, near + error_near
        low2, high2 = far - error_far, far + error_far
    after1, after2 = low1 > now_high, low2 > now_high
    unclear1 = not after1 and not high1 <= now_low
    unclear2 = not after2 and not high2 <= now_low
    if at_root:
        if unclear1 == unclear2:
            return UNSURE
    elif unclear1 or unclear2:
        return UNSURE
    s = 1 if c2 > 0.0 else -1
    if after1:  # both roots are after now; the enclosure must hold only the first
        if high1 >= low2:
            return UNSURE
        return (s, low1, high1) if low1 <= horizon else (s, INFINITY, INFINITY)
    if after2:
        return (-s, low2, high2) if low2 <= horizon else (-s, INFINITY, INFINITY)
    return (s, INFINITY, INFINITY)


def _near_alone(
    s: int,
    low: float,
    high: float,
    reach: float,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for a quadratic whose other root, if any, is of size at least ``reach``.

    ``s`` is the sign of the slope at the root in [low, high]. That is the sign of c1: with
    s = sgn(c1) the root is t = (-c1 + s sqrt(D)) / (2 c2), so c1 + 2 c2 t = s sqrt(D). (For
    c2 = 0, t = -c0 / c1, and s sqrt(D) = c1.) Should the sign of the double c1 be wrong,
    both formulas hold with the wrong sign too, as long as q is not 0.

    Between -reach and reach the polynomial vanishes in [low, high] alone, and only once. If
    it vanishes now, the vanishing root is that one.
    """
    if not (-reach < low and high < reach and -reach < now_low and now_high < reach):
        return UNSURE
    if at_root or high <= now_low:
        return (s, INFINITY, INFINITY) if horizon < reach else UNSURE
    if low > now_high:
        if low <= horizon:
            return (-s, low, high)
        return (-s, INFINITY, INFINITY)
    return UNSURE


def _constant(
    c0: float,
    c1: float,
    c2: float,
    e0: float,
    e1: float,
    e2: float,
    now_low: float,
    now_high: float,
    horizon: float,
) -> Answer:
    """Return the sign of a quadratic without a root up to the horizon (its constant wins)."""
    reach = max(abs(now_low), abs(now_high), abs(horizon))
    rest = (e0 + ((abs(c1) + e1) + (abs(c2) + e2) * reach) * reach) * SLACK + TINY
    if INFINITY > abs(c0) > rest:
        return (1 if c0 > 0.0 else -1, INFINITY, INFINITY)
    return UNSURE
