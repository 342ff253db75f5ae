"""The polynomials of certificates, as doubles with error bounds.

Notation: unit u = 2^-53. The error of coefficient i of the enclosure of a translating
trajectory is at most ``errors[i]`` (0 while all are exact doubles), so that of a difference
of two is at most d[i] = 2 errors[i] plus its own rounding. Trajectories of one translation
differ by an exact constant: their higher coefficients are not formed at all.
"""

from __future__ import annotations

from typing import Final

from librt.vecs import vec
from mypy_extensions import i64

from exactpt.certificates import cubics, turning
from exactpt.certificates import first_root as filters
from exactpt.filters.rounding import U
from exactpt.motion.float_track import FloatTrack
from exactpt.motion.vertices import MOTION

K: Final = 8.0 * U
"""Relative bound on the rounding of the linear and quadratic coefficients formed here.

The relative error of a difference of doubles is at most one unit, of a product of two of
them three, of a sum of up to four products six; two more units cover the rounding of the
bound itself.
"""


def orientation(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """Return the filter's result for the orientation of three vertices."""
    # The orientation is invariant under rotation of (a, b, c): rotate so that a and b
    # have one motion, if any two do.
    if a.ws or b.ws or c.ws:
        if not (a.motion == b.motion and a.motion >= 0):
            if b.motion == c.motion and b.motion >= 0:
                a, b, c = b, c, a
            elif c.motion == a.motion and c.motion >= 0:
                a, b, c = c, a, b
            else:
                return turning.three(a, b, c, now_low, now_high, horizon, at_root)
        return turning.pair(a, b, c, now_low, now_high, horizon, at_root)
    if not (a.motion == b.motion and a.motion >= 0):
        if b.motion == c.motion and b.motion >= 0:
            a, b, c = b, c, a
        elif c.motion == a.motion and c.motion >= 0:
            a, b, c = c, a, b
        elif a.degree <= 1 and b.degree <= 1 and c.degree <= 1:
            ux0, uy0, ux1, uy1 = b.x0 - a.x0, b.y0 - a.y0, b.x1 - a.x1, b.y1 - a.y1
            vx0, vy0, vx1, vy1 = c.x0 - a.x0, c.y0 - a.y0, c.x1 - a.x1, c.y1 - a.y1
            bounds = errors, now_low, now_high, horizon, at_root
            return _three(ux0, uy0, ux1, uy1, vx0, vy0, vx1, vy1, *bounds)
        elif a.degree <= 3 and b.degree <= 3 and c.degree <= 3:
            return cubics.orientation(a, b, c, errors, now_low, now_high, horizon, at_root)
        else:
            return _any_degree(a, b, c, errors, now_low, now_high, horizon, at_root)
    if a.degree <= 1 and c.degree <= 1:
        ux, uy, vx, vy = b.x0 - a.x0, b.y0 - a.y0, c.x0 - a.x0, c.y0 - a.y0
        wx, wy = c.x1 - a.x1, c.y1 - a.y1
        return _pair(ux, uy, vx, vy, wx, wy, errors, now_low, now_high, horizon, at_root)
    if a.degree <= 3 and c.degree <= 3:
        return cubics.orientation_same_motion(a, b, c, errors, now_low, now_high, horizon, at_root)
    return _any_degree(a, b, c, errors, now_low, now_high, horizon, at_root)


def linear_orientation(
    places: vec[float],
    a: i64,
    b: i64,
    c: i64,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """Return the filter's result for the orientation of three vertices in `Vertices.places`.

    a, b and c are their first indices there; the motion of none is `OTHER_MOTION`.
    """
    m, n = places[a + MOTION], places[b + MOTION]
    if not (m == n and m >= 0.0):
        o = places[c + MOTION]
        if n == o and n >= 0.0:
            a, b, c = b, c, a
        elif o == m and o >= 0.0:
            a, b, c = c, a, b
        else:
            x, y, sx, sy = places[a], places[a + 1], places[a + 2], places[a + 3]
            ux0, uy0, ux1, uy1 = (
                places[b] - x, places[b + 1] - y, places[b + 2] - sx, places[b + 3] - sy
            )  # fmt: skip
            vx0, vy0, vx1, vy1 = (
                places[c] - x, places[c + 1] - y, places[c + 2] - sx, places[c + 3] - sy
            )  # fmt: skip
            return _three(
                ux0, uy0, ux1, uy1, vx0, vy0, vx1, vy1, errors, now_low, now_high, horizon, at_root
            )  # fmt: skip
    x, y = places[a], places[a + 1]
    ux, uy, vx, vy = places[b] - x, places[b + 1] - y, places[c] - x, places[c + 1] - y
    wx, wy = places[c + 2] - places[a + 2], places[c + 3] - places[a + 3]
    return _pair(ux, uy, vx, vy, wx, wy, errors, now_low, now_high, horizon, at_root)


def _pair(
    ux: float,
    uy: float,
    vx: float,
    vy: float,
    wx: float,
    wy: float,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """Return the result for linear motions, a and b together: (b - a) x (c - a) is linear in t.

    b - a is (ux, uy), c - a is (vx, vy) + t (wx, wy).

    For exact u + du, v + dv: |(u + du)(v + dv) - u v| <= |u| dv + |v| du + du dv.
    """
    p, q = ux * vy, uy * vx
    c0, e0 = p - q, K * (abs(p) + abs(q))
    p, q = ux * wy, uy * wx
    c1, e1 = p - q, K * (abs(p) + abs(q))
    d0, d1 = 2.0 * errors[0], 2.0 * errors[1]
    if d0 > 0.0 or d1 > 0.0:
        u = abs(ux) + abs(uy)
        e0 = (e0 + d0 * (u + abs(vx) + abs(vy) + 2.0 * d0)) * filters.SLACK
        e1 = (e1 + d1 * u + d0 * (abs(wx) + abs(wy) + 2.0 * d1)) * filters.SLACK
    return filters.linear(c0, c1, e0, e1, now_low, now_high, horizon, at_root)


def _three(
    ux0: float,
    uy0: float,
    ux1: float,
    uy1: float,
    vx0: float,
    vy0: float,
    vx1: float,
    vy1: float,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """Return the result for three linear motions: (b - a) x (c - a) is quadratic in t.

    b - a is (ux0, uy0) + t (ux1, uy1), c - a is (vx0, vy0) + t (vx1, vy1).
    """
    p, q = ux0 * vy0, uy0 * vx0
    c0, e0 = p - q, K * (abs(p) + abs(q))
    p, q, r, s = ux0 * vy1, uy0 * vx1, ux1 * vy0, uy1 * vx0
    c1, e1 = p - q + r - s, K * (abs(p) + abs(q) + abs(r) + abs(s))
    p, q = ux1 * vy1, uy1 * vx1
    c2, e2 = p - q, K * (abs(p) + abs(q))
    d0, d1 = 2.0 * errors[0], 2.0 * errors[1]
    if d0 > 0.0 or d1 > 0.0:
        t0 = abs(ux0) + abs(uy0) + abs(vx0) + abs(vy0)
        t1 = abs(ux1) + abs(uy1) + abs(vx1) + abs(vy1)
        e0 = (e0 + d0 * (t0 + 2.0 * d0)) * filters.SLACK
        e1 = (e1 + d1 * t0 + d0 * (t1 + 4.0 * d1)) * filters.SLACK
        e2 = (e2 + d1 * (t1 + 2.0 * d1)) * filters.SLACK
    return filters.quadratic(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)


def _any_degree(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """Return the result for translations of any degree.

    A coefficient is a sum of at most 2n products, each with an error of three units: 2n + 3
    units, and 4n + 8 cover the rounding of the bound.
    """
    ux, uy = _differences(a.xs, b.xs, a, b), _differences(a.ys, b.ys, a, b)
    vx, vy = _differences(a.xs, c.xs, a, c), _differences(a.ys, c.ys, a, c)
    n = len(ux) + len(vx) - 1
    values, bounds = [0.0] * n, [0.0] * n
    unit = (4 * n + 8) * U
    for i in range(len(ux)):
        di, uxi, uyi = 2.0 * errors[i], ux[i], uy[i]
        for j in range(len(vx)):
            dj, vxj, vyj = 2.0 * errors[j], vx[j], vy[j]
            p, q = uxi * vyj, uyi * vxj
            values[i + j] += p - q
            bounds[i + j] += (
                unit * (abs(p) + abs(q))
                + di * (abs(vxj) + abs(vyj) + 2.0 * dj)
                + dj * (abs(uxi) + abs(uyi))
            )
    return filters.any_degree(values, bounds, now_low, now_high, horizon, at_root)


def x_difference(
    a: FloatTrack,
    b: FloatTrack,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """Return the filter's result for x(b) - x(a)."""
    if a.ws or b.ws:
        return turning.x_difference(a, b, now_low, now_high, horizon, at_root)
    if a.degree <= 1 and b.degree <= 1:
        c0, c1 = b.x0 - a.x0, b.x1 - a.x1
        is_rigid = a.motion == b.motion and a.motion >= 0
        return _linear_difference(c0, c1, is_rigid, errors, now_low, now_high, horizon, at_root)
    if a.degree <= 3 and b.degree <= 3 and not (a.motion == b.motion and a.motion >= 0):
        return cubics.x_difference(a, b, errors, now_low, now_high, horizon, at_root)
    values = _differences(a.xs, b.xs, a, b)
    bounds = [K * abs(v) + 2.0 * errors[i] for i, v in enumerate(values)]
    return filters.any_degree(values, bounds, now_low, now_high, horizon, at_root)


def linear_x_difference(
    places: vec[float],
    a: i64,
    b: i64,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """Return the filter's result for x(b) - x(a) of two vertices in `Vertices.places`.

    a and b are their first indices there; the motion of none is `OTHER_MOTION`.
    """
    c0, c1, m = places[b] - places[a], places[b + 2] - places[a + 2], places[a + MOTION]
    is_rigid = m == places[b + MOTION] and m >= 0.0
    return _linear_difference(c0, c1, is_rigid, errors, now_low, now_high, horizon, at_root)


def _linear_difference(
    c0: float,
    c1: float,
    is_rigid: bool,  # noqa: FBT001 - positional for speed
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """Return the result for c0 + c1 t, rounded differences; if it is rigid, for c0 alone."""
    e0, e1 = 2.0 * errors[0] + K * abs(c0), K * abs(c1) + 2.0 * errors[1]
    if is_rigid:
        c1 = e1 = 0.0
    return filters.linear(c0, c1, e0, e1, now_low, now_high, horizon, at_root)


def _differences(p: list[float], q: list[float], a: FloatTrack, b: FloatTrack) -> list[float]:
    """Return the coefficients of q - p; for vertices of one translation, the constant alone."""
    if a.motion == b.motion and a.motion >= 0:
        return [q[0] - p[0]]
    if len(p) == len(q):
        return [q[i] - p[i] for i in range(len(p))]
    n = max(len(p), len(q))
    p, q = p + [0.0] * (n - len(p)), q + [0.0] * (n - len(q))
    return [q[i] - p[i] for i in range(n)]
