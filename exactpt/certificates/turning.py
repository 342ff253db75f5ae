"""The polynomials of certificates where a body turns, as doubles with error bounds.

A vertex that turns is at p(t) + r(t) / w(t), a pivot and an arm (`exactpt.motion.float_track.Arm`);
one that only translates is at p(t), its arm is 0 and w = 1. The relative error of each
coefficient is at most one unit u = 2^-53.

Two vertices a, b of one motion and a third vertex c. Let d = p(c) - p(a) and u the difference
of the arms of b and a, or of a and b themselves if they only translate. Thus
    (b - a) x (c - a) = u / w x (d + r(c) / w(c) - r(a) / w).
Since arms only turn, u x r(a) = r(b) x r(a) is k w^2 with a constant k, and w w(c) times the
orientation is
    u x (w(c) d + r(c)) - k w w(c),
of degree 6 at most, and of degree 5 if pivots move on lines. (If a and b only translate, u is
constant and k = 0.) So neither the place of the scene nor its width enters, but distances
alone.
"""

from __future__ import annotations

from typing import Final, TypeAlias

from exactpt.certificates import first_root as filters
from exactpt.certificates.sextics import sextic
from exactpt.filters.rounding import Answer, U
from exactpt.motion.float_track import Arm, FloatTrack

UNIT: Final = 32.0 * U

ONE: Final = [1.0]

Five: TypeAlias = tuple[float, float, float, float, float]
Six: TypeAlias = tuple[float, float, float, float, float, float]
Coefficients: TypeAlias = list[float]


def pair(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for the orientation of a and b of one motion, and a third vertex.

    The bound. With X[i] = |x[i](a)| + |x[i](b)|, u[i] is off by at most 2 units of X[i] and Y[i],
    and d likewise by two units of the sums of its parts. w(c) d + r(c) has sums of at most four
    terms and is off by 7 units; its products with u go through at most 5 sums and are off by
    15. k is off by 4 units of the sizes of its two products, and k w w(c) by 10. So the error
    of a coefficient is at most 16 units of the sum of all these sizes; `UNIT` is twice that,
    for the rounding of the bound.
    """
    arm, other = a.arm, b.arm
    if not (_has_pivot(a) and _has_pivot(b) and _has_pivot(c)):
        return three(a, b, c, now_low, now_high, horizon, at_root)
    k = size_k = 0.0
    ux1 = ux2 = uy1 = uy2 = 0.0
    v1 = v2 = w1 = w2 = 0.0
    w0 = 1.0
    if arm is not None and other is not None:
        ux0, ux1, ux2 = other.x0 - arm.x0, other.x1 - arm.x1, other.x2 - arm.x2
        uy0, uy1, uy2 = other.y0 - arm.y0, other.y1 - arm.y1, other.y2 - arm.y2
        v0 = abs(other.x0) + abs(arm.x0) + abs(other.y0) + abs(arm.y0)
        v1 = abs(other.x1) + abs(arm.x1) + abs(other.y1) + abs(arm.y1)
        v2 = abs(other.x2) + abs(arm.x2) + abs(other.y2) + abs(arm.y2)
        w0, w1, w2 = arm.w0, arm.w1, arm.w2
        p, q = other.x * arm.y, other.y * arm.x
        k, size_k = p - q, abs(p) + abs(q)
    else:
        ux0, uy0 = b.x0 - a.x0, b.y0 - a.y0
        v0 = abs(b.x0) + abs(a.x0) + abs(b.y0) + abs(a.y0)
    ap0, ap1, ap2, aq0, aq1, aq2 = _pivot(a)
    cp0, cp1, cp2, cq0, cq1, cq2 = _pivot(c)
    dx0, dx1, dx2, dy0, dy1, dy2 = cp0 - ap0, cp1 - ap1, cp2 - ap2, cq0 - aq0, cq1 - aq1, cq2 - aq2
    d0 = abs(cp0) + abs(ap0) + abs(cq0) + abs(aq0)
    d1 = abs(cp1) + abs(ap1) + abs(cq1) + abs(aq1)
    d2 = abs(cp2) + abs(ap2) + abs(cq2) + abs(aq2)
    # (x, y) = w(c) d + r(c), s the sizes of its terms, and m = w w(c), n the sizes of that
    third = c.arm
    if third is None:
        x0, x1, x2, x3, x4 = dx0, dx1, dx2, 0.0, 0.0
        y0, y1, y2, y3, y4 = dy0, dy1, dy2, 0.0, 0.0
        s0, s1, s2, s3, s4 = d0, d1, d2, 0.0, 0.0
        m0, m1, m2, m3, m4 = w0, w1, w2, 0.0, 0.0
        n0, n1, n2, n3, n4 = abs(w0), abs(w1), abs(w2), 0.0, 0.0
    else:
        g0, g1, g2 = third.w0, third.w1, third.w2
        x0, x1, x2, x3, x4 = _times(g0, g1, g2, dx0, dx1, dx2)
        y0, y1, y2, y3, y4 = _times(g0, g1, g2, dy0, dy1, dy2)
        x0, x1, x2 = x0 + third.x0, x1 + third.x1, x2 + third.x2
        y0, y1, y2 = y0 + third.y0, y1 + third.y1, y2 + third.y2
        m0, m1, m2, m3, m4 = _times(w0, w1, w2, g0, g1, g2)
        g0, g1, g2 = abs(g0), abs(g1), abs(g2)
        s0, s1, s2, s3, s4 = _times(g0, g1, g2, d0, d1, d2)
        s0 += abs(third.x0) + abs(third.y0)
        s1 += abs(third.x1) + abs(third.y1)
        s2 += abs(third.x2) + abs(third.y2)
        n0, n1, n2, n3, n4 = _times(abs(w0), abs(w1), abs(w2), g0, g1, g2)
    return sextic(
        (ux0 * y0 - uy0 * x0) - k * m0,
        (ux0 * y1 - uy0 * x1) + (ux1 * y0 - uy1 * x0) - k * m1,
        (ux0 * y2 - uy0 * x2) + (ux1 * y1 - uy1 * x1) + (ux2 * y0 - uy2 * x0) - k * m2,
        (ux0 * y3 - uy0 * x3) + (ux1 * y2 - uy1 * x2) + (ux2 * y1 - uy2 * x1) - k * m3,
        (ux0 * y4 - uy0 * x4) + (ux1 * y3 - uy1 * x3) + (ux2 * y2 - uy2 * x2) - k * m4,
        (ux1 * y4 - uy1 * x4) + (ux2 * y3 - uy2 * x3),
        ux2 * y4 - uy2 * x4,
        UNIT * (v0 * s0 + size_k * n0),
        UNIT * (v0 * s1 + v1 * s0 + size_k * n1),
        UNIT * (v0 * s2 + v1 * s1 + v2 * s0 + size_k * n2),
        UNIT * (v0 * s3 + v1 * s2 + v2 * s1 + size_k * n3),
        UNIT * (v0 * s4 + v1 * s3 + v2 * s2 + size_k * n4),
        UNIT * (v1 * s4 + v2 * s3),
        UNIT * (v2 * s4),
        now_low,
        now_high,
        horizon,
        at_root,
    )


def _pivot(float_track: FloatTrack) -> Six:
    """p0, p1, p2, q0, q1, q2: the path of the pivot, or of a vertex that only translates."""
    arm = float_track.arm
    if arm is None:
        return (
            float_track.x0,
            float_track.x1,
            float_track.x2,
            float_track.y0,
            float_track.y1,
            float_track.y2,
        )
    return arm.p0, arm.p1, arm.p2, arm.q0, arm.q1, arm.q2


def _times(f0: float, f1: float, f2: float, g0: float, g1: float, g2: float) -> Five:
    """Return the coefficients of the product of two polynomials of degree 2."""
    return f0 * g0, f0 * g1 + f1 * g0, f0 * g2 + f1 * g1 + f2 * g0, f1 * g2 + f2 * g1, f2 * g2


def three(
    a: FloatTrack,
    b: FloatTrack,
    c: FloatTrack,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for any three vertices, by the determinant of the rows (x, y, w).

    The entries of a row are off by at most 7 units of its sizes s, see `_row`. With at most m
    terms in each, a minor of b and c goes through at most 2m sums and is off by 2m + 15 units of
    s(b) s(c), its product with w by 3m + 17, the determinant by 3m + 19; the rest of `unit` is for
    the rounding of the bound.
    """
    origin = a.arm or b.arm or c.arm
    if not (_has_pivot(a) and _has_pivot(b) and _has_pivot(c)):
        origin = None
    ax, ay, aw, sa = _row(origin, a)
    bx, by, bw, sb = _row(origin, b)
    cx, cy, cw, sc = _row(origin, c)
    bc, ca, ab = _cross(bx, by, cx, cy), _cross(cx, cy, ax, ay), _cross(ax, ay, bx, by)
    values = _sum(_product(aw, bc), _sum(_product(bw, ca), _product(cw, ab)))
    aw, bw, cw = _absolute(aw), _absolute(bw), _absolute(cw)
    rest = _sum(_product(bw, sc), _product(cw, sb))
    bounds = _sum(_product(aw, _product(sb, sc)), _product(sa, rest))
    unit = (3 * max(len(sa), len(sb), len(sc)) + 30) * U
    bounds = [unit * x for x in bounds]
    return filters.any_degree(values, bounds, now_low, now_high, horizon, at_root)


def x_difference(
    a: FloatTrack,
    b: FloatTrack,
    now_low: float,
    now_high: float,
    horizon: float,
    at_root: bool,  # noqa: FBT001 - positional for speed
) -> Answer:
    """Return the result for x(b) - x(a): the sign of x(b) w(a) - x(a) w(b).

    A product is off by three units and goes through at most m + 1 sums.
    """
    ax, aw, bx, bw = a.xs, a.ws or ONE, b.xs, b.ws or ONE
    values = _sum(_product(bx, aw), [-x for x in _product(ax, bw)])
    ax, aw, bx, bw = _absolute(ax), _absolute(aw), _absolute(bx), _absolute(bw)
    unit = (max(len(ax), len(bx)) + 8) * U
    bounds = [unit * x for x in _sum(_product(bx, aw), _product(ax, bw))]
    return filters.any_degree(values, bounds, now_low, now_high, horizon, at_root)


def _has_pivot(float_track: FloatTrack) -> bool:
    return float_track.arm is not None or (float_track.degree <= 2 and not float_track.ws)


def _row(
    origin: Arm | None, float_track: FloatTrack
) -> tuple[Coefficients, Coefficients, Coefficients, Coefficients]:
    """x, y and w of a vertex, and the sizes of the terms of x and y together.

    They are relative to the pivot of ``origin``: w d + r as in `pair`. Without ``origin`` they
    are the coefficients of the enclosure.
    """
    if origin is None:
        sizes = _sum(_absolute(float_track.xs), _absolute(float_track.ys))
        return float_track.xs, float_track.ys, float_track.ws or ONE, sizes
    arm = float_track.arm
    if arm is origin:
        x, y = [arm.x0, arm.x1, arm.x2], [arm.y0, arm.y1, arm.y2]
        return x, y, [arm.w0, arm.w1, arm.w2], _sum(_absolute(x), _absolute(y))
    p0, p1, p2, q0, q1, q2 = _pivot(float_track)
    dx, dy = [p0 - origin.p0, p1 - origin.p1], [q0 - origin.q0, q1 - origin.q1]
    sizes = [
        abs(p0) + abs(origin.p0) + abs(q0) + abs(origin.q0),
        abs(p1) + abs(origin.p1) + abs(q1) + abs(origin.q1),
    ]
    size = abs(p2) + abs(origin.p2) + abs(q2) + abs(origin.q2)
    if size > 0.0:
        dx.append(p2 - origin.p2)
        dy.append(q2 - origin.q2)
        sizes.append(size)
    if arm is None:
        return dx, dy, ONE, sizes
    x, y, w = [arm.x0, arm.x1, arm.x2], [arm.y0, arm.y1, arm.y2], [arm.w0, arm.w1, arm.w2]
    sizes = _sum(_product(_absolute(w), sizes), _sum(_absolute(x), _absolute(y)))
    return _sum(_product(dx, w), x), _sum(_product(dy, w), y), w, sizes


def _cross(ux: Coefficients, uy: Coefficients, vx: Coefficients, vy: Coefficients) -> Coefficients:
    values = [0.0] * (len(ux) + len(vx) - 1)
    for i in range(len(ux)):
        x, y = ux[i], uy[i]
        for j in range(len(vx)):
            values[i + j] += x * vy[j] - y * vx[j]
    return values


def _product(f: Coefficients, g: Coefficients) -> Coefficients:
    if len(f) == 1:
        first = f[0]
        return [first * x for x in g]
    values = [0.0] * (len(f) + len(g) - 1)
    for i in range(len(f)):
        x = f[i]
        for j in range(len(g)):
            values[i + j] += x * g[j]
    return values


def _sum(f: Coefficients, g: Coefficients) -> Coefficients:
    if len(f) < len(g):
        f, g = g, f
    values = f[:]
    for i in range(len(g)):
        values[i] += g[i]
    return values


def _absolute(f: Coefficients) -> Coefficients:
    return [abs(x) for x in f]
