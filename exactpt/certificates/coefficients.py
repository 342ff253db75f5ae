"""The polynomials of certificates, as doubles with error bounds.

Notation: unit u = 2^-53. The error of coefficient i of the enclosure of a translating
trajectory is at most ``errors[i]`` (0 while all are exact doubles), so that of a difference
of two is at most d[i] = 2 errors[i] plus its own rounding. Trajectories of one translation
differ by an exact constant: their higher coefficients are not formed at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from exactpt.certificates import cubics
from exactpt.kernel import filters
from exactpt.kernel.rounding import U
from exactpt.kernel.vectorized import Answers, quadratics
from exactpt.motion.image import Image

__all__ = ["linear_orientations", "linear_parts", "orientation", "x_difference"]


K: Final = 8.0 * U
"""Relative bound on the rounding of the linear and quadratic coefficients formed here.

The relative error of a difference of doubles is at most one unit, of a product of two of
them three, of a sum of up to four products six; two more units cover the rounding of the
bound itself.
"""
ONE: Final = [1.0]


def orientation(
    a: Image,
    b: Image,
    c: Image,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """The filter's answer for the orientation of three vertices."""
    if a.ws or b.ws or c.ws:
        return _turning(a, b, c, now_low, now_high, horizon, at_root)
    # The orientation is invariant under rotation of (a, b, c): rotate so that a and b
    # translate together, if any two do.
    if not (a.motion == b.motion and a.motion >= 0):
        if b.motion == c.motion and b.motion >= 0:
            a, b, c = b, c, a
        elif c.motion == a.motion and c.motion >= 0:
            a, b, c = c, a, b
        elif a.degree <= 1 and b.degree <= 1 and c.degree <= 1:
            return _three(a, b, c, errors, now_low, now_high, horizon, at_root)
        elif a.degree <= 3 and b.degree <= 3 and c.degree <= 3:
            return cubics.three(a, b, c, errors, now_low, now_high, horizon, at_root)
        else:
            return _any_degree(a, b, c, errors, now_low, now_high, horizon, at_root)
    if a.degree <= 1 and c.degree <= 1:
        return _pair(a, b, c, errors, now_low, now_high, horizon, at_root)
    if a.degree <= 3 and c.degree <= 3:
        return cubics.pair(a, b, c, errors, now_low, now_high, horizon, at_root)
    return _any_degree(a, b, c, errors, now_low, now_high, horizon, at_root)


def _pair(
    a: Image,
    b: Image,
    c: Image,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """The answer for linear motions, a and b together: (b - a) x (c - a) is linear in t.

    For exact u + du, v + dv: |(u + du)(v + dv) - u v| <= |u| dv + |v| du + du dv.
    """
    ux, uy = b.x0 - a.x0, b.y0 - a.y0
    vx, vy = c.x0 - a.x0, c.y0 - a.y0
    wx, wy = c.x1 - a.x1, c.y1 - a.y1
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
    a: Image,
    b: Image,
    c: Image,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """The answer for three linear motions: (b - a) x (c - a) is quadratic in t."""
    ux0, uy0, ux1, uy1 = b.x0 - a.x0, b.y0 - a.y0, b.x1 - a.x1, b.y1 - a.y1
    vx0, vy0, vx1, vy1 = c.x0 - a.x0, c.y0 - a.y0, c.x1 - a.x1, c.y1 - a.y1
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


def linear_parts(images: Sequence[Image]) -> NDArray[np.float64]:
    """The coefficients x0, y0, x1, y1 of each enclosure, one row each."""
    columns = (
        [i.x0 for i in images],
        [i.y0 for i in images],
        [i.x1 for i in images],
        [i.y1 for i in images],
    )
    return np.stack([np.array(column, dtype=np.float64) for column in columns], axis=1)


@np.errstate(all="ignore")
def linear_orientations(
    images: Sequence[Image],
    triples: NDArray[np.int64],
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: NDArray[np.float64],
) -> Answers:
    """The filter's answers for many triples (rows of indices), none at a root now.

    Only the answers for linear motions are valid.

    They are computed as in `_three`; if two vertices of a triple translate together they
    become a and b, and the higher coefficient of their difference is 0 without error, as in
    `_pair`.
    """
    motions = np.array([i.motion for i in images])[triples]
    values = linear_parts(images)[triples]
    rows = np.arange(len(triples))
    together = (motions == np.roll(motions, -1, axis=1)) & (motions >= 0)
    first = np.where(together.any(axis=1), together.argmax(axis=1), 0)
    a, b, c = (values[rows, (first + i) % 3] for i in range(3))
    ux0, uy0, ux1, uy1 = (b - a).T
    vx0, vy0, vx1, vy1 = (c - a).T
    linear = together.any(axis=1)
    ux1, uy1 = np.where(linear, 0.0, ux1), np.where(linear, 0.0, uy1)
    p, q = ux0 * vy0, uy0 * vx0
    c0, e0 = p - q, K * (abs(p) + abs(q))
    p, q, r, s = ux0 * vy1, uy0 * vx1, ux1 * vy0, uy1 * vx0
    c1, e1 = p - q + r - s, K * (abs(p) + abs(q) + abs(r) + abs(s))
    p, q = ux1 * vy1, uy1 * vx1
    c2, e2 = p - q, K * (abs(p) + abs(q))
    d0, d1 = 2.0 * errors[0], 2.0 * errors[1]
    t0 = abs(ux0) + abs(uy0) + abs(vx0) + abs(vy0)
    t1 = abs(ux1) + abs(uy1) + abs(vx1) + abs(vy1)
    e0 = (e0 + d0 * (t0 + 2.0 * d0)) * filters.SLACK
    e1 = (e1 + d1 * t0 + d0 * (t1 + 4.0 * d1)) * filters.SLACK
    e2 = np.where(linear, 0.0, (e2 + d1 * (t1 + 2.0 * d1)) * filters.SLACK)
    at_root = np.zeros(len(triples), dtype=np.bool_)
    return quadratics(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)


def _any_degree(
    a: Image,
    b: Image,
    c: Image,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """The answer for translations of any degree.

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
    return _answer(values, bounds, now_low, now_high, horizon, at_root)


def _turning(
    a: Image,
    b: Image,
    c: Image,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001
) -> filters.Answer:
    """The answer for any motions, by the determinant of the rows (x, y, w).

    The relative error of every coefficient of an enclosure is at most one unit, so that of a
    product of three is at most five, and a sum of at most 6 n^2 products adds 6 n^2.
    """
    aw, bw, cw = a.ws or ONE, b.ws or ONE, c.ws or ONE
    n = len(a.xs) + len(b.xs) + len(c.xs) - 2
    values, bounds = [0.0] * n, [0.0] * n
    _add_products(a.xs, b.ys, cw, c.ys, bw, values, bounds)
    _add_products(b.xs, c.ys, aw, a.ys, cw, values, bounds)
    _add_products(c.xs, a.ys, bw, b.ys, aw, values, bounds)
    unit = (6 * n * n + 16) * U
    return _answer(values, [unit * s for s in bounds], now_low, now_high, horizon, at_root)


def _add_products(
    x: list[float],
    y1: list[float],
    w1: list[float],
    y2: list[float],
    w2: list[float],
    values: list[float],
    sizes: list[float],
) -> None:
    """Add x (y1 w1 - y2 w2) to ``values``, and the absolute products to ``sizes``."""
    minor, size = _minor(y1, w1, y2, w2)
    for i in range(len(x)):
        p = x[i]
        if p != 0.0:
            for j in range(len(minor)):
                if size[j] != 0.0:
                    values[i + j] += p * minor[j]
                    sizes[i + j] += abs(p) * size[j]


def _minor(
    y1: list[float], w1: list[float], y2: list[float], w2: list[float]
) -> tuple[list[float], list[float]]:
    """y1 w1 - y2 w2, and |y1| |w1| + |y2| |w2|."""
    n = max(len(y1) + len(w1), len(y2) + len(w2)) - 1
    values, sizes = [0.0] * n, [0.0] * n
    for i in range(len(y1)):
        for j in range(len(w1)):
            p = y1[i] * w1[j]
            values[i + j] += p
            sizes[i + j] += abs(p)
    for i in range(len(y2)):
        for j in range(len(w2)):
            p = y2[i] * w2[j]
            values[i + j] -= p
            sizes[i + j] += abs(p)
    return values, sizes


def x_difference(
    a: Image,
    b: Image,
    errors: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    """The filter's answer for x(b) - x(a)."""
    if a.ws or b.ws:
        values, sizes = _minor(b.xs, a.ws or ONE, a.xs, b.ws or ONE)
        unit = (4 * len(values) + 8) * U
        return _answer(values, [unit * s for s in sizes], now_low, now_high, horizon, at_root)
    if a.degree <= 1 and b.degree <= 1:
        c0, e0, c1, e1 = b.x0 - a.x0, 2.0 * errors[0], 0.0, 0.0
        if not (a.motion == b.motion and a.motion >= 0):
            c1 = b.x1 - a.x1
            e1 = K * abs(c1) + 2.0 * errors[1]
        e0 += K * abs(c0)
        return filters.linear(c0, c1, e0, e1, now_low, now_high, horizon, at_root)
    if a.degree <= 3 and b.degree <= 3 and not (a.motion == b.motion and a.motion >= 0):
        return cubics.x_difference(a, b, errors, now_low, now_high, horizon, at_root)
    values = _differences(a.xs, b.xs, a, b)
    bounds = [K * abs(v) + 2.0 * errors[i] for i, v in enumerate(values)]
    return _answer(values, bounds, now_low, now_high, horizon, at_root)


def _differences(p: list[float], q: list[float], a: Image, b: Image) -> list[float]:
    """The coefficients of q - p; for vertices of one translation, the constant alone."""
    if a.motion == b.motion and a.motion >= 0:
        return [q[0] - p[0]]
    if len(p) == len(q):
        return [q[i] - p[i] for i in range(len(p))]
    n = max(len(p), len(q))
    p, q = p + [0.0] * (n - len(p)), q + [0.0] * (n - len(q))
    return [q[i] - p[i] for i in range(n)]


def _answer(
    values: list[float],
    bounds: list[float],
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> filters.Answer:
    n = len(values)
    while n > 1 and values[n - 1] == 0.0 and bounds[n - 1] == 0.0:
        n -= 1
    if n <= 2:
        c1, e1 = (values[1], bounds[1]) if n == 2 else (0.0, 0.0)
        return filters.linear(values[0], c1, bounds[0], e1, now_low, now_high, horizon, at_root)
    if n == 3:
        return filters.quadratic(
            values[0],
            values[1],
            values[2],
            bounds[0],
            bounds[1],
            bounds[2],
            now_low,
            now_high,
            horizon,
            at_root,
        )
    return filters.polynomial(values[:n], bounds[:n], now_low, now_high, horizon, at_root)
