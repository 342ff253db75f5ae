"""The float filter of degree 3 to 6, such as of an orientation in cubic motion.

Windows of time [a, b] are decided by the signs of Bernstein coefficients as in
`exactpt.certificates.root_windows`, but written out for degree 6, with every number in a variable
of its own. (A polynomial of lower degree has zeros as its higher coefficients.)

The bound. Let b = fl(a + h) and T = |a| + h. Bernstein coefficients are polar forms at
arguments a and a + h, in which the terms of c[i] have sizes that add up to at most
|c[i]| T^i. Each goes through at most 12 operations in the Taylor shift, 7 in the scaling
and 6 in the sums; six arguments are off by at most u T where they should be b. That is
31 units; Horner's rule at a time of size at most T makes 12. So with
    g[i] = 32 u |c[i]| + e[i],
sum(g[i] T^i) bounds the error of both. The sign at a is known without it if a is the end
of another window.

A root now, at r. Then p = (t - r) q, and coefficient k of p on [r, b] is k (b - r) / 6
times coefficient k - 1 of q. It is also (b - r) / 6 times the sum of k polar forms of the
derivative p', each at five arguments r and b. The computed value is that sum times h / (6 k),
with arguments a and a + h: Bernstein coefficients without the constant term, divided by
k. The terms of c[i] have sizes of at most (h / 6) i |c[i]| T^(i-1) <= (h / T) |c[i]| T^i
and go through one operation more. Each of the five arguments is off by at most u T, or by
the width w of now, which changes p' by at most i (i - 1) / 5 |c[i]| T^(i-2) times that. With
|c[i]| + g[i], which bounds the true coefficient, the bound is
    (h / T) (sum(g[i] T^i) + 5 (w / T) sum((|c[i]| + g[i]) T^i)), without i = 0,
and without i = 1 in the second sum.
(For r = b too, since q(r) = p'(r).)

Range. T < 2^66 and h > 2^-150, so max(1, T)^6 < 2^400 and h^6 > 2^-900: powers of h
neither overflow nor underflow, and other underflow ends below TINY, as it does in
`exactpt.certificates.root_windows`. (Cutting h to a quarter multiplies by powers of two: exact, or
one more underflow.) An overflow stays infinite or NaN and reaches the last Bernstein
coefficient, the sum of all, which must be finite.
"""

from __future__ import annotations

from typing import Final, TypeAlias

from exactpt.filters.rounding import INFINITY, SLACK, TINY, UNSURE, Answer, U

Six: TypeAlias = tuple[float, float, float, float, float, float]
Seven: TypeAlias = tuple[float, float, float, float, float, float, float]

UNIT: Final = 32.0 * U
"""Relative rounding error of the terms, as shown above."""
SHORTEST: Final = 2.0**-150
"""Minimum length h of a window."""
FARTHEST: Final = 2.0**66
"""Upper bound on T."""
SIXTH: Final = 1.0 / 6.0
FIFTEENTH: Final = 1.0 / 15.0
TWENTIETH: Final = 1.0 / 20.0


def sextic(
    c0: float, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float,
    e0: float, e1: float, e2: float, e3: float, e4: float, e5: float, e6: float,
    now_low: float, now_high: float, horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:  # fmt: skip
    """Return the result for c0 + c1 t + ... + c6 t^6.

    The window starts now, as wide as the horizon allows; it is doubled after a success
    and cut to a quarter after a failure.

    ``at_root``: the polynomial is known to vanish now.
    """
    a, h = now_low, horizon - now_low
    shortest = max(1e-13 * h, SHORTEST)
    if not (h > shortest and abs(a) + h < FARTHEST):
        return UNSURE
    g0, g1, g2 = UNIT * abs(c0) + e0, UNIT * abs(c1) + e1, UNIT * abs(c2) + e2
    g3, g4 = UNIT * abs(c3) + e3, UNIT * abs(c4) + e4
    g5, g6 = UNIT * abs(c5) + e5, UNIT * abs(c6) + e6
    q0, q1, q2, q3, q4, q5, q6 = _scaled(c0, c1, c2, c3, c4, c5, c6, a, h)
    m2 = m3 = m4 = m5 = m6 = 0.0
    if at_root:
        q0 = 0.0
        m2, m3, m4 = abs(c2) + g2, abs(c3) + g3, abs(c4) + g4
        m5, m6 = abs(c5) + g5, abs(c6) + g6
    rising = (q1 if at_root else q0) > 0.0  # the sign after now, if it is certain
    s = 1.0 if rising else -1.0
    known, last = False, True
    for _ in range(80):
        t = abs(a) + h
        b = horizon if last else a + h
        b0 = s * q0
        b1, b2, b3, b4, b5, b6 = _sums(b0, s * q1, s * q2, s * q3, s * q4, s * q5, s * q6)
        if at_root:
            b2, b3, b4, b5, b6 = b2 / 2.0, b3 / 3.0, b4 / 4.0, b5 / 5.0, b6 / 6.0
            error = _bound(0.0, g1, g2, g3, g4, g5, g6, t)
            error += 5.0 * ((now_high - now_low) / t) * _bound(0.0, 0.0, m2, m3, m4, m5, m6, t)
            error = error * (h / t) * SLACK + TINY
        else:
            error = _bound(g0, g1, g2, g3, g4, g5, g6, t)
        # The first coefficient that is not certainly positive is the k-th.
        k, y, z, one = 0.0, b0, b1, False
        first = b1 if at_root else b0
        if not (known or first > error):
            # If the sign now is uncertain, it is uncertain on every window.
            if not (at_root or first > _bound(g0, g1, g2, g3, g4, g5, g6, abs(a))):
                return UNSURE
        elif not b1 > error:
            one = b2 < -error and b3 < -error and b4 < -error and b5 < -error
        elif not b2 > error:
            k, y, z = 1.0, b1, b2
            one = b3 < -error and b4 < -error and b5 < -error
        elif not b3 > error:
            k, y, z = 2.0, b2, b3
            one = b4 < -error and b5 < -error
        elif not b4 > error:
            k, y, z = 3.0, b3, b4
            one = b5 < -error
        elif not b5 > error:
            k, y, z, one = 4.0, b4, b5, True
        elif not b6 > error:
            k, y, z, one = 5.0, b5, b6, True
        elif not b6 < INFINITY:
            return UNSURE
        else:  # no root in the window
            if last:
                return (1 if rising else -1, INFINITY, INFINITY)
            a, h, rest = b, 2.0 * h, horizon - b
            last = not h < rest
            if last:
                h = rest
            if not h > shortest:
                return UNSURE
            known, at_root = True, False
            q0, q1, q2, q3, q4, q5, q6 = _scaled(c0, c1, c2, c3, c4, c5, c6, a, h)
            continue
        if one and -INFINITY < b6 < -error:  # one root in the window
            x = a + h * (k + y / (y - z)) * SIXTH if y > z else b
            low, high = _tighten(c0, c1, c2, c3, c4, c5, c6, g0, g1, g2, g3, g4, g5, g6, a, b, x, s)
            return (1 if rising else -1, low, high) if low > now_high else UNSURE
        h *= 0.25
        if not h > shortest or (at_root and not a + h > now_high):
            return UNSURE
        q1 *= 2.0**-2
        q2 *= 2.0**-4
        q3 *= 2.0**-6
        q4 *= 2.0**-8
        q5 *= 2.0**-10
        q6 *= 2.0**-12
        last = False
    return UNSURE


def _scaled(
    c0: float, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float,
    a: float, h: float,
) -> Seven:  # fmt: skip
    """Return the Taylor coefficients at a, by repeated Horner, times h^k / binomial(6, k)."""
    c5 += a * c6
    c4 += a * c5
    c3 += a * c4
    c2 += a * c3
    c1 += a * c2
    c0 += a * c1
    c5 += a * c6
    c4 += a * c5
    c3 += a * c4
    c2 += a * c3
    c1 += a * c2
    c5 += a * c6
    c4 += a * c5
    c3 += a * c4
    c2 += a * c3
    c5 += a * c6
    c4 += a * c5
    c3 += a * c4
    c5 += a * c6
    c4 += a * c5
    c5 += a * c6
    h2 = h * h
    h3 = h2 * h
    return (
        c0,
        c1 * (SIXTH * h),
        c2 * (FIFTEENTH * h2),
        c3 * (TWENTIETH * h3),
        c4 * (FIFTEENTH * (h2 * h2)),
        c5 * (SIXTH * (h2 * h3)),
        c6 * (h3 * h3),
    )


def _sums(b0: float, b1: float, b2: float, b3: float, b4: float, b5: float, b6: float) -> Six:
    """Return the Bernstein coefficients after the first, sums of scaled Taylor coefficients."""
    b6 += b5
    b5 += b4
    b4 += b3
    b3 += b2
    b2 += b1
    b1 += b0
    b6 += b5
    b5 += b4
    b4 += b3
    b3 += b2
    b2 += b1
    b6 += b5
    b5 += b4
    b4 += b3
    b3 += b2
    b6 += b5
    b5 += b4
    b4 += b3
    b6 += b5
    b5 += b4
    b6 += b5
    return b1, b2, b3, b4, b5, b6


def _bound(
    g0: float, g1: float, g2: float, g3: float, g4: float, g5: float, g6: float, t: float
) -> float:
    """Return the bound on all errors at times of size at most t: see the module's proof."""
    return ((((((g6 * t + g5) * t + g4) * t + g3) * t + g2) * t + g1) * t + g0) * SLACK + TINY


def _tighten(
    c0: float, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float,
    g0: float, g1: float, g2: float, g3: float, g4: float, g5: float, g6: float,
    low: float, high: float, x: float, s: float,
) -> tuple[float, float]:  # fmt: skip
    """Return a narrower enclosure of the one root in (low, high), from sign s to -s.

    Newton's method from x, safeguarded by bisection, proposes a root x; the certain signs
    at x - d and x + d confirm it.
    """
    left, right, slope = low, high, 0.0
    near = 1e-8 * (high - low) + 4.0 * U * (abs(low) + abs(high))
    for _ in range(40):
        if not left < x < right:
            x = 0.5 * (left + right)
        y5 = c6 * x + c5
        y4 = y5 * x + c4
        y3 = y4 * x + c3
        y2 = y3 * x + c2
        y1 = y2 * x + c1
        value = y1 * x + c0
        slope = ((((c6 * x + y5) * x + y4) * x + y3) * x + y2) * x + y1
        if value * s > 0.0:
            left = x
        else:
            right = x
        step = value / slope if slope != 0.0 else INFINITY
        x -= step
        if abs(step) <= near:
            break
    slope, size, radius, factor = abs(slope), abs(x), 1e-6 * (high - low), 1.5
    for _ in range(10):
        error = _bound(g0, g1, g2, g3, g4, g5, g6, size + radius)
        d = min(radius, factor * error / slope + 2.0 * U * size) if slope > 0.0 else radius
        left, right = x - d, x + d
        if low < left < high and INFINITY > s * _value(c0, c1, c2, c3, c4, c5, c6, left) > error:
            low = left
        if low < right < high and INFINITY > -s * _value(c0, c1, c2, c3, c4, c5, c6, right) > error:
            high = right
        if low >= left and high <= right:
            break
        radius *= 8.0
        factor *= 8.0
    return low, high


def _value(
    c0: float, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float, t: float
) -> float:
    """Return the value at t, by Horner's rule."""
    return (((((c6 * t + c5) * t + c4) * t + c3) * t + c2) * t + c1) * t + c0
