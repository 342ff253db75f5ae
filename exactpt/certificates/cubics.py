"""The polynomials of certificates for motions of degree 2 and 3, as doubles with error bounds.

As `exactpt.certificates.coefficients`, but with every number in a variable of its own; a
motion of degree 2 is a cubic one with zeros.

A coefficient of an orientation is a sum of at most eight products of differences: the
relative error of a difference of doubles is at most one unit, of a product of two of them
three, of the difference of two products four, of a sum of four of these seven. `K` is eight
units, and covers the rounding of the bound itself. Coefficients of enclosures are 0 or of
size at least 2^-300: nothing underflows, and a bound is 0 only if its coefficient is.
"""

from __future__ import annotations

from typing import Final

from exactpt.certificates import first_root as filters
from exactpt.certificates.sextics import sextic
from exactpt.filters.rounding import SLACK, Answer, U
from exactpt.motion.float_track import FloatTrack

K: Final = 8.0 * U


def orientation(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for three cubic motions: (b - a) x (c - a) is of degree 6 in t.

    With X[i] = |ux[i]| + |vx[i]| and Y likewise, the products of coefficient k have sizes
    that add up to at most the sum of X[i] Y[k - i], and the errors of the enclosures add
        sum(X[i] d[k - i] + d[i] Y[k - i] + 2 d[i] d[k - i]).
    """
    ux0, ux1, ux2, ux3 = b.x0 - a.x0, b.x1 - a.x1, b.x2 - a.x2, b.x3 - a.x3
    uy0, uy1, uy2, uy3 = b.y0 - a.y0, b.y1 - a.y1, b.y2 - a.y2, b.y3 - a.y3
    vx0, vx1, vx2, vx3 = c.x0 - a.x0, c.x1 - a.x1, c.x2 - a.x2, c.x3 - a.x3
    vy0, vy1, vy2, vy3 = c.y0 - a.y0, c.y1 - a.y1, c.y2 - a.y2, c.y3 - a.y3
    c0 = ux0 * vy0 - uy0 * vx0
    c1 = (ux0 * vy1 - uy0 * vx1) + (ux1 * vy0 - uy1 * vx0)
    c2 = (ux0 * vy2 - uy0 * vx2) + (ux1 * vy1 - uy1 * vx1) + (ux2 * vy0 - uy2 * vx0)
    c3 = (
        (ux0 * vy3 - uy0 * vx3)
        + (ux1 * vy2 - uy1 * vx2)
        + (ux2 * vy1 - uy2 * vx1)
        + (ux3 * vy0 - uy3 * vx0)
    )
    c4 = (ux1 * vy3 - uy1 * vx3) + (ux2 * vy2 - uy2 * vx2) + (ux3 * vy1 - uy3 * vx1)
    c5 = (ux2 * vy3 - uy2 * vx3) + (ux3 * vy2 - uy3 * vx2)
    c6 = ux3 * vy3 - uy3 * vx3
    x0, x1, x2, x3 = (
        abs(ux0) + abs(vx0),
        abs(ux1) + abs(vx1),
        abs(ux2) + abs(vx2),
        abs(ux3) + abs(vx3),
    )
    y0, y1, y2, y3 = (
        abs(uy0) + abs(vy0),
        abs(uy1) + abs(vy1),
        abs(uy2) + abs(vy2),
        abs(uy3) + abs(vy3),
    )
    f0, f1, f2, f3 = K * y0, K * y1, K * y2, K * y3
    d0, d1, d2 = 2.0 * errors[0], 2.0 * errors[1], 2.0 * errors[2]
    d3 = 2.0 * errors[3] if len(errors) > 3 else 0.0
    if d0 + d1 + d2 + d3 > 0.0:
        f0, f1, f2, f3 = f0 + d0, f1 + d1, f2 + d2, f3 + d3
        y0, y1, y2, y3 = y0 + 2.0 * d0, y1 + 2.0 * d1, y2 + 2.0 * d2, y3 + 2.0 * d3
        e0 = (x0 * f0 + d0 * y0) * SLACK
        e1 = (x0 * f1 + x1 * f0 + d0 * y1 + d1 * y0) * SLACK
        e2 = (x0 * f2 + x1 * f1 + x2 * f0 + d0 * y2 + d1 * y1 + d2 * y0) * SLACK
        e3 = (
            (x0 * f3 + x1 * f2 + x2 * f1 + x3 * f0) + (d0 * y3 + d1 * y2 + d2 * y1 + d3 * y0)
        ) * SLACK
        e4 = (x1 * f3 + x2 * f2 + x3 * f1 + d1 * y3 + d2 * y2 + d3 * y1) * SLACK
        e5 = (x2 * f3 + x3 * f2 + d2 * y3 + d3 * y2) * SLACK
        e6 = (x3 * f3 + d3 * y3) * SLACK
    else:
        e0 = x0 * f0
        e1 = x0 * f1 + x1 * f0
        e2 = x0 * f2 + x1 * f1 + x2 * f0
        e3 = x0 * f3 + x1 * f2 + x2 * f1 + x3 * f0
        e4 = x1 * f3 + x2 * f2 + x3 * f1
        e5 = x2 * f3 + x3 * f2
        e6 = x3 * f3
    if e3 == 0.0 and e4 == 0.0 and e5 == 0.0 and e6 == 0.0:
        # Without cubic terms, and all accelerations are equal, as under gravity.
        return filters.quadratic(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)
    return sextic(
        c0, c1, c2, c3, c4, c5, c6, e0, e1, e2, e3, e4, e5, e6, now_low, now_high, horizon, at_root
    )


def orientation_same_motion(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result where a and b share a cubic motion: (b - a) x (c - a) has degree 3."""
    ux, uy = b.x0 - a.x0, b.y0 - a.y0
    vx0, vx1, vx2, vx3 = c.x0 - a.x0, c.x1 - a.x1, c.x2 - a.x2, c.x3 - a.x3
    vy0, vy1, vy2, vy3 = c.y0 - a.y0, c.y1 - a.y1, c.y2 - a.y2, c.y3 - a.y3
    p0, p1, p2, p3 = ux * vy0, ux * vy1, ux * vy2, ux * vy3
    q0, q1, q2, q3 = uy * vx0, uy * vx1, uy * vx2, uy * vx3
    e0, e1 = K * (abs(p0) + abs(q0)), K * (abs(p1) + abs(q1))
    e2, e3 = K * (abs(p2) + abs(q2)), K * (abs(p3) + abs(q3))
    d0, d1, d2 = 2.0 * errors[0], 2.0 * errors[1], 2.0 * errors[2]
    d3 = 2.0 * errors[3] if len(errors) > 3 else 0.0
    if d0 + d1 + d2 + d3 > 0.0:
        u = abs(ux) + abs(uy)
        e0 = (e0 + d0 * (u + abs(vx0) + abs(vy0) + 2.0 * d0)) * SLACK
        e1 = (e1 + d1 * u + d0 * (abs(vx1) + abs(vy1) + 2.0 * d1)) * SLACK
        e2 = (e2 + d2 * u + d0 * (abs(vx2) + abs(vy2) + 2.0 * d2)) * SLACK
        e3 = (e3 + d3 * u + d0 * (abs(vx3) + abs(vy3) + 2.0 * d3)) * SLACK
    return _cubic(
        p0 - q0, p1 - q1, p2 - q2, p3 - q3, e0, e1, e2, e3, now_low, now_high, horizon, at_root
    )


def x_difference(
    a: FloatTrack,
    b: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for two different cubic motions: x(b) - x(a) is of degree 3 in t."""
    c0, c1, c2, c3 = b.x0 - a.x0, b.x1 - a.x1, b.x2 - a.x2, b.x3 - a.x3
    e0, e1 = K * abs(c0) + 2.0 * errors[0], K * abs(c1) + 2.0 * errors[1]
    e2 = K * abs(c2) + 2.0 * errors[2]
    e3 = K * abs(c3) + (2.0 * errors[3] if len(errors) > 3 else 0.0)
    return _cubic(c0, c1, c2, c3, e0, e1, e2, e3, now_low, now_high, horizon, at_root)


def _cubic(
    c0: float,
    c1: float,
    c2: float,
    c3: float,
    e0: float,
    e1: float,
    e2: float,
    e3: float,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    if e3 == 0.0:
        return filters.quadratic(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)
    return sextic(
        c0,
        c1,
        c2,
        c3,
        0.0,
        0.0,
        0.0,
        e0,
        e1,
        e2,
        e3,
        0.0,
        0.0,
        0.0,
        now_low,
        now_high,
        horizon,
        at_root,
    )
