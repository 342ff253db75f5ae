"""Tight enclosures of times: one Newton step in arithmetic of twice the precision."""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias

import numpy as np

from exactpt.arrays.relative import Coefficient
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.double_double import Double2, add2, exact_sum, multiply2
from exactpt.kernel.doubles import Floats

Plane2: TypeAlias = tuple[Double2, Double2]

QUARTER: Final = 0.25 * U
"""A quarter of the least relative distance of doubles is more than this."""


class ExactRelative(NamedTuple):
    """Vertices relative to edges, as polynomials in the time t.

    Attributes:
        u: the coefficients of b - a in x and in y, exactly.
        w: those of p - a, less ``shift``.
        shift: a displacement of p; None for 0.
    """

    u: tuple[Plane2, ...]
    w: tuple[Plane2, ...]
    shift: Plane2 | None


@np.errstate(all="ignore")
def sharpened(
    r: ExactRelative, cs: list[Coefficient], start: Floats, low: Floats, high: Floats
) -> tuple[Floats, Floats]:
    """Doubles that enclose the times start + s, for zeros s of orientations in [low, high].

    Args:
        r: the vertices and edges.
        cs: at most three coefficients of the orientation as a polynomial in s, with bounds.
        start: the starts of the time spans.
        low: lower bounds of the zeros, since the start.
        high: upper bounds.

    Let f be the orientation, t = start + m for a double m in [low, high]. The zero is
    t - f(t) / f'(x) for some x in the enclosure. |f'(m)| >= slope, and |f'(x) / f'(m) - 1| <=
    bend / slope, with ``bend`` a bound on the change of f' within the enclosure, and on the error
    of the computed one. f(t) is off by at most ``error`` (`_value`). So the zero is h + l + step,
    where h + l = t, up to e = |step| bend / slope + error / slope, and rounding of l + step.

    If e is below a quarter of the distance of doubles, the zero is between the neighbours of the
    nearest double to that sum, and on the side on which the sum is, if it is off by more than e.
    """
    m = 0.5 * (low + high)
    c1, e1 = cs[1]
    derivative, bend = c1, e1 + 2.0 * U * np.abs(c1)
    if len(cs) == 3:
        c2, e2 = cs[2]
        derivative = c1 + 2.0 * c2 * m
        size = np.abs(c1) + 2.0 * np.abs(c2) * m
        bend = e1 + 2.0 * e2 * high + 2.0 * (np.abs(c2) + e2) * (high - low) + 4.0 * U * size
    slope = np.abs(derivative) - 2.0 * bend * SLACK
    h, l = exact_sum(start, m)
    value, error = _value(r, (h, l))
    step = -value / derivative
    rest = l + step
    e = (np.abs(step) * bend + error + TINY) / slope
    e = (e + 4.0 * U * (np.abs(step) + np.abs(rest))) * SLACK + TINY
    near, off = exact_sum(h, rest)
    good = (slope > 0.0) & (e < QUARTER * np.abs(near))
    lows = np.where(off > e, near, np.nextafter(near, -np.inf))
    highs = np.where(off < -e, near, np.nextafter(near, np.inf))
    wide_low, wide_high = start + low, start + high
    shifted = start != 0.0
    wide_low = np.where(shifted, np.nextafter(wide_low, -np.inf), low)
    wide_high = np.where(shifted, np.nextafter(wide_high, np.inf), high)
    return np.where(good, lows, wide_low), np.where(good, highs, wide_high)


def _value(r: ExactRelative, t: Double2) -> tuple[Floats, Floats]:
    """Return the orientation at a time, and a bound on its error.

    In units of U^2: a step of Horner's rule adds at most 15 to the relative error with respect to
    the sum of the absolute values of all terms, so u and w have at most 15 times their degrees,
    with a shift 5 more; a product has 11 more, and the difference 5. Rounding to a double adds
    one U of the value.
    An underflow in u or w is multiplied by the other.
    """
    (ux, uy), (wx, wy) = _at(r.u, None, t), _at(r.w, r.shift, t)
    x, y = multiply2(ux[0], wy[0]), multiply2(uy[0], wx[0])
    value = add2(x, (-y[0], -y[1]))[0]
    size = ux[1] * wy[1] + uy[1] * wx[1]
    units = 15.0 * (len(r.u) + len(r.w) - 2) + 21.0
    lost = TINY * (ux[1] + uy[1] + wx[1] + wy[1])
    return value, 2.0 * units * U * U * size + U * np.abs(value) + lost


def _at(
    f: tuple[Plane2, ...], shift: Plane2 | None, t: Double2
) -> tuple[tuple[Double2, Floats], tuple[Double2, Floats]]:
    """Return the value in x and in y, each with the sum of the absolute values of its terms."""
    found = []
    far = np.abs(t[0]) * SLACK
    for axis in (0, 1):
        value = f[-1][axis]
        size = np.abs(value[0])
        for c in f[-2::-1]:
            value = add2(multiply2(value, t), c[axis])
            size = size * far + np.abs(c[axis][0])
        if shift is not None:
            value = add2(value, shift[axis])
            size = size + np.abs(shift[axis][0])
        found.append((value, size * SLACK))
    return found[0], found[1]
