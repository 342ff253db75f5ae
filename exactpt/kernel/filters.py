"""Float filters: the sign of a polynomial now and its first root later, or "unsure".

A polynomial is given by doubles c[i] and bounds e[i] on their errors: the true
coefficient lies in [c[i] - e[i], c[i] + e[i]]. An answer is proved for every such
polynomial; "unsure" sends the caller to exact arithmetic. Every acceptance is a
positive test, so that a NaN, which compares false, ends as unsure.

Assumption (the caller's, see `exactpt.motion.image`): non-zero coefficients and
bounds lie far enough from the ends of the double range, in [2^-460, 2^460], that no
operation below overflows, and underflow loses less than `TINY`.

An answer is a triple (sign, low, high): the sign of the polynomial just after now,
and an enclosure of its first root after now, which is simple (a crossing); (inf, inf)
if there is none up to the horizon; sign 0 means unsure. Now is a time in
[now_low, now_high].

Sources: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
chapters 1 to 5 (the standard model, quadratic equations, Horner's rule); G. Farin,
*Curves and Surfaces for CAGD* (Bernstein coefficients are blossoms).
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

__all__ = ["UNSURE", "Answer", "linear", "polynomial", "quadratic"]

Answer: TypeAlias = tuple[int, float, float]

U: Final = 2.0**-53
SLACK: Final = 1.0 + 1e-10  # covers the rounding of a bound of fewer than 10^5 operations
TINY: Final = 1e-290
INFINITY: Final = math.inf
UNSURE: Final[Answer] = (0, 0.0, 0.0)


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
    """The answer for c0 + c1 t.

    With the true coefficients c0 + d0, c1 + d1, |d0| <= e0, |d1| <= e1 < |c1|, and
    r = fl(-c0 / c1), |r + c0 / c1| <= U |r| (1 + 2U):
    true root - r = (-d0 - d1 r') / (c1 + d1) + (r' - r), r' = -c0 / c1.

    ``at_root``: the polynomial is known to vanish now.
    """
    slope, size = abs(c1), abs(c0)
    if slope > e1:
        root = -c0 / c1
        error = ((e0 + e1 * abs(root)) / (slope - e1) + 4.0 * U * abs(root)) * SLACK + TINY
        s = 1 if c1 > 0.0 else -1
        if at_root or root + error <= now_low:
            return (s, INFINITY, INFINITY)
        low = root - error
        if low > now_high:
            if low > horizon:
                return (-s, INFINITY, INFINITY)
            return (-s, low, root + error)
        return UNSURE
    # No root up to the horizon if the constant outweighs the slope.
    reach = max(abs(now_low), abs(now_high), abs(horizon))
    if size > (e0 + (slope + e1) * reach) * SLACK + TINY:
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
    """The answer for c0 + c1 t + c2 t^2.

    Discriminant D = c1^2 - 4 c0 c2 with error
        eD = e1 (2|c1| + e1) + 4 (|c0| e2 + (|c2| + e2) e0) + 4U (c1^2 + 4 |c0 c2|):
    the first two terms are the propagated errors of the coefficients, the last the
    rounding of three products and a difference.

    For D > eD both roots are real and simple. q = -(c1 + sgn(c1) sqrt(D)) / 2 has no
    cancellation; the roots are q / c2 and c0 / q. |sqrt(D ± eD) - sqrt(D)| <= eD / sqrt(D),
    and the quotients are bounded as in `linear`. q / c2 is the smaller one if and only
    if c1 >= 0 and c2 > 0 or c1 < 0 and c2 < 0.

    ``at_root``: the polynomial is known to vanish now. The two enclosures are of two
    different roots; so if just one of them meets [now_low, now_high], that root is now.
    """
    if c2 == 0.0 and e2 == 0.0:
        return linear(c0, c1, e0, e1, now_low, now_high, horizon, at_root)
    square = c1 * c1
    product = 4.0 * c0 * c2
    d = square - product
    a0, a1, a2 = abs(c0), abs(c1), abs(c2)
    error_d = (
        e1 * (2.0 * a1 + e1) + 4.0 * (a0 * e2 + (a2 + e2) * e0) + 4.0 * U * (square + abs(product))
    ) * SLACK + TINY
    if d < -error_d:
        # Then 4 c0 c2 > eD >= 4 |c0| e2, so the sign of c2 is certain.
        return (1 if c2 > 0.0 else -1, INFINITY, INFINITY)
    if not d > error_d:
        return UNSURE
    root_d = math.sqrt(d)
    error_root = error_d / root_d * SLACK + 2.0 * U * root_d
    q = -0.5 * (c1 + root_d) if c1 >= 0.0 else -0.5 * (c1 - root_d)
    error_q = (0.5 * (e1 + error_root) + 2.0 * U * abs(q)) * SLACK
    if not abs(q) > error_q or not a2 > e2:
        return UNSURE
    near = c0 / q
    size = abs(near)
    error_near = ((e0 + size * error_q) / (abs(q) - error_q) + 8.0 * U * size) * SLACK + TINY
    far = q / c2
    size = abs(far)
    error_far = ((error_q + size * e2) / (a2 - e2) + 8.0 * U * size) * SLACK + TINY
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
    if after1:  # both roots are to come
        if not low2 > now_high:
            return UNSURE
        return (s, low1, high1) if low1 <= horizon else (s, INFINITY, INFINITY)
    if after2:
        return (-s, low2, high2) if low2 <= horizon else (-s, INFINITY, INFINITY)
    return (s, INFINITY, INFINITY)


def polynomial(
    c: list[float],
    e: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """The answer for sum(c[i] t^i) of any degree, by certified windows.

    A window [a, a + h] is settled if the Bernstein coefficients of the polynomial on
    it, with their error bound, all have one sign (no root), or change sign once from
    first to last (one simple root, by the variation diminishing property). The window
    starts now, as wide as the horizon allows; it is doubled after a success and cut to
    a quarter after a failure.

    ``at_root``: the polynomial is known to vanish now. If its derivative has one sign
    on [now_low, b], it has no other root there and the sign of the derivative after
    now; the search goes on at b.
    """
    length = horizon - now_low
    if not length > 0.0:
        return UNSURE
    a, s = now_low, 0
    if at_root:
        slope = [i * c[i] for i in range(1, len(c))]
        slope_error = [i * e[i] + U * abs(i * c[i]) for i in range(1, len(c))]
        h = length
        while s == 0:
            s = _one_sign(_bernstein(slope, a, h), _bernstein_error(slope, slope_error, a, h))
            if s == 0:
                h *= 0.125
                if not h > 1e-13 * length or not a + h > now_high:
                    return UNSURE
        a = (a + h) if h < length else horizon
    h = horizon - a
    step = 0
    while a < horizon:
        step += 1
        if step > 80 or not h > 1e-13 * length:
            return UNSURE
        b = _bernstein(c, a, h)
        error = _bernstein_error(c, e, a, h)
        first = 1 if b[0] > error else -1 if b[0] < -error else 0
        if s == 0:
            s = first
        if first == 0 or first != s:
            return UNSURE
        if _one_sign(b, error) == s:
            a += h
            h = min(2.0 * h, horizon - a)
        elif _one_change(b, error):
            low, high = _tighten(c, e, a, a + h, s)
            if low > now_high:
                return (s, low, high)
            return UNSURE
        else:
            h *= 0.25
    return (s, INFINITY, INFINITY)


def _bernstein(c: list[float], a: float, h: float) -> list[float]:
    """The Bernstein coefficients of sum(c[i] t^i) on [a, a + h], in floats.

    Taylor shift to a by repeated Horner, scaling by h^k / binomial(n, k), then n
    rounds of sums.
    """
    n = len(c) - 1
    b = c[:]
    for i in range(n):
        for j in range(n - 1, i - 1, -1):
            b[j] += a * b[j + 1]
    factor = 1.0
    for k in range(1, n + 1):
        factor *= h * k / (n - k + 1)
        b[k] *= factor
    for i in range(1, n + 1):
        for j in range(n, i - 1, -1):
            b[j] += b[j - 1]
    return b


def _bernstein_error(c: list[float], e: list[float], a: float, h: float) -> float:
    """A bound on the error of every coefficient of `_bernstein`.

    A Bernstein coefficient is the polar form of the polynomial at arguments a and
    a + h, so the monomial t^i adds at most T^i, T = |a| + h: the errors e[i] add up to
    sum(e[i] T^i). Rounding: a term goes through at most 2n operations in the shift, 3n
    in the scaling, n in the sums, and a + h itself is rounded (n more): relative error
    below 7n + 1 units, 9n + 13 with slack, on terms whose sum is at most
    sum(|c[i]| T^i).
    """
    t = abs(a) + h
    unit = (9 * len(c) + 13) * U * 1.5
    error = 0.0
    for i in range(len(c) - 1, -1, -1):
        error = error * t + (unit * abs(c[i]) + e[i])
    return error * SLACK + TINY


def _one_sign(b: list[float], error: float) -> int:
    """The common certain sign of all coefficients, or 0."""
    if b[0] > error:
        for x in b:
            if not x > error:
                return 0
        return 1
    for x in b:
        if not x < -error:
            return 0
    return -1


def _one_change(b: list[float], error: float) -> bool:
    """Whether the signs are certainly s ... s, at most one unknown, -s ... -s."""
    s = 1.0 if b[0] > 0.0 else -1.0
    k, n = 0, len(b)
    while k < n and s * b[k] > error:
        k += 1
    if k < n and not s * b[k] < -error:
        k += 1
    if k == n:
        return False
    while k < n:
        if not s * b[k] < -error:
            return False
        k += 1
    return True


def _tighten(
    c: list[float], e: list[float], low: float, high: float, s: int
) -> tuple[float, float]:
    """A narrower enclosure of the one root in (low, high), where the sign falls from s to -s.

    Newton's method, kept inside by bisection, proposes x; the signs at x - d and
    x + d, with Horner's error bound, dispose.
    """
    left, right = low, high
    x = 0.5 * (left + right)
    for _ in range(60):
        value, slope = 0.0, 0.0
        for i in range(len(c) - 1, -1, -1):
            slope = slope * x + value
            value = value * x + c[i]
        if value * s > 0.0:
            left = x
        else:
            right = x
        step = value / slope if slope != 0.0 else INFINITY
        following = x - step
        if not left < following < right:
            following = 0.5 * (left + right)
        if abs(following - x) <= 4.0 * U * abs(x):
            break
        x = following
    d = 8.0 * U * abs(x) + 1e-18 * (high - low)
    for _ in range(12):
        left, right = x - d, x + d
        if low < left and _sign(c, e, left) == s:
            low = left
        if right < high and _sign(c, e, right) == -s:
            high = right
        if low >= left and high <= right:
            break
        d *= 8.0
    return low, high


def _sign(c: list[float], e: list[float], x: float) -> int:
    """The certain sign at the double x, or 0.

    Horner's rule: |error| <= 2(n + 1) U sum(|c[i]| |x|^i), Higham section 5.1.
    """
    value, bound, t = 0.0, 0.0, abs(x)
    unit = 2 * (len(c) + 2) * U
    for i in range(len(c) - 1, -1, -1):
        value = value * x + c[i]
        bound = bound * t + (unit * abs(c[i]) + e[i])
    bound = bound * SLACK + TINY
    return 1 if value > bound else -1 if value < -bound else 0
