"""The float filter of a polynomial of any degree: certified windows of time.

A window [a, a + h] is decided if the Bernstein coefficients of the polynomial on it,
within their error bound, all have one sign (no root), or change sign once from first to
last (one simple root, by the variation diminishing property).

Range. With degree n <= 64, T = |a| + h for every window and M = max(1, T)^n, the guards
are M < 2^400 and h^n > 2^-900, and an error bound counts only beside finite coefficients.
- The factors h^k / binomial(n, k) are at least 2^-964: they do not underflow.
- An underflow in the Taylor shift, in the scaling, or in Horner's rule is an error of
  2^-1075. Multiplications by a, h and binomials follow, at most n of them by a or h: it
  grows to at most 4^n M 2^-1075. There are fewer than 2 n^2 such underflows, and
  2 n^2 4^n M 2^-1075 < 2^(13 + 128 + 400 - 1075) < TINY / 2.
- An overflow stays infinite or NaN and reaches the last coefficient, the sum of all.

Sources: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
chapter 5 (Horner's rule); G. Farin, *Curves and Surfaces for CAGD* (Bernstein
coefficients are blossoms).
"""

from __future__ import annotations

from exactpt.certificates.sextics import sextic
from exactpt.filters.rounding import INFINITY, SLACK, TINY, UNSURE, Answer, U


def polynomial(
    c: list[float],
    e: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for sum(c[i] t^i) of degree 1 or more.

    The window starts now, as wide as the horizon allows; it is doubled after a success
    and cut to a quarter after a failure. The last window ends at the horizon, from which
    a + h differs by rounding; `_bernstein_error` counts that. Up to degree 6 see
    `exactpt.certificates.sextics`.

    ``at_root``: the polynomial is known to vanish now. If its derivative has one sign on
    [now_low, b], the polynomial has no other root there and, after now, the sign of the
    derivative; the search goes on at b.
    """
    n = len(c) - 1
    if n <= 6:
        zeros = [0.0] * (6 - n)
        c0, c1, c2, c3, c4, c5, c6 = c + zeros
        e0, e1, e2, e3, e4, e5, e6 = e + zeros
        return sextic(
            c0,
            c1,
            c2,
            c3,
            c4,
            c5,
            c6,
            e0,
            e1,
            e2,
            e3,
            e4,
            e5,
            e6,
            now_low,
            now_high,
            horizon,
            at_root,
        )
    length = horizon - now_low
    shortest = max(1e-13 * length, 2.0 ** (-900.0 / n))
    if not (length > shortest and abs(now_low) + length < 2.0 ** (400.0 / n) and n <= 64):
        return UNSURE
    a, s = now_low, 0
    if at_root:
        slope = [i * c[i] for i in range(1, len(c))]
        slope_error = [i * e[i] + U * abs(i * c[i]) for i in range(1, len(c))]
        h = length
        while s == 0:
            s = _one_sign(*_window(slope, slope_error, a, h))
            if s == 0:
                h *= 0.125
                if not h > shortest or not a + h > now_high:
                    return UNSURE
        if not h < length:
            return (s, INFINITY, INFINITY)
        a += h
    h = horizon - a
    step = 0
    while True:
        step += 1
        if step > 80 or not h > shortest:
            return UNSURE
        b, error = _window(c, e, a, h)
        first = 1 if b[0] > error else -1 if b[0] < -error else 0
        if s == 0:
            s = first
        if first == 0 or first != s:
            return UNSURE
        if _one_sign(b, error) == s:
            if not h < horizon - a:
                break
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


def _window(c: list[float], e: list[float], a: float, h: float) -> tuple[list[float], float]:
    """Return the Bernstein coefficients on [a, a + h], and a bound on the error of each."""
    b = _bernstein(c, a, h)
    error = _bernstein_error(c, e, a, h) if -INFINITY < b[-1] < INFINITY else INFINITY
    return b, error


def _bernstein(c: list[float], a: float, h: float) -> list[float]:
    """Return the Bernstein coefficients of sum(c[i] t^i) on [a, a + h], in floats.

    Computed by a Taylor shift to a (repeated Horner), scaling by h^k / binomial(n, k), and
    n rounds of sums.
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
    """Return a bound on the error of every coefficient of `_bernstein`.

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
    """Return the certain common sign of all coefficients, or 0."""
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
    """Return True if the signs are certainly s, ..., s, at most one unknown, then -s, ..., -s."""
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
    """Return a narrower enclosure of the one root in (low, high), from sign s to -s.

    Newton's method, safeguarded by bisection, proposes a root x; the signs at x - d and
    x + d, certain by Horner's error bound, confirm it.
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
    """Return the sign at the double x, or 0 if it is not certain.

    Horner's rule: |error| <= 2(n + 1) U sum(|c[i]| |x|^i), Higham section 5.1.
    """
    value, bound, t = 0.0, 0.0, abs(x)
    unit = 2 * (len(c) + 2) * U
    for i in range(len(c) - 1, -1, -1):
        value = value * x + c[i]
        bound = bound * t + (unit * abs(c[i]) + e[i])
    bound = bound * SLACK + TINY
    return 1 if INFINITY > value > bound else -1 if -INFINITY < value < -bound else 0
