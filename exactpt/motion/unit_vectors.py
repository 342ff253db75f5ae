"""Rational unit vectors near angles, and tangents rounded to a grid: the same on every machine.

No result of a mathematical library in doubles gets into them, as these differ between machines. A
tangent is rounded from proved bounds, so it does not depend on the approximation with which the
search for it begins.
"""

from __future__ import annotations

from typing import Final

from exactpt.kernel.arctangents import atan_bounds, pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, floor, nearest_float, power_of_two, rational
from exactpt.motion.turned_angle import bits_for

_MORE_BITS: Final = 16
"""Bits of bounds beyond those of the result: they decide its rounding but for one in 2^13."""
_BITS_OF_DOUBLES: Final = 45
"""Bits to which the approximation by doubles is right, at the least."""
_PARTIAL_DENOMINATORS: Final = (19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0)
"""Of the continued fraction of the tangent, from the last one that is needed for doubles."""

Vector = tuple[QQ, QQ]
"""The cosine and the sine of an angle."""


def vector_near(angle: QQ, error: QQ) -> Vector:
    """Return a rational unit vector near an angle, with few digits.

    It is a function of the angle and the error alone. Its angle differs from the given one by about
    an eighth of the error at most; whoever needs a bound proves one (`exactpt.motion.path_error`).

    Args:
        angle: in radians.
        error: the error of the angle that is allowed, in radians.

    Raises:
        InputError: if the error is too small for an angle of this size.
    """
    quarter = pi_bounds(bits_for(error, angle) + 8)[0] / 2
    quarters = floor(angle / quarter + QQ(1, 2))
    m = tangent_near((angle - quarters * quarter) / 2, bits_for(error, QQ(0)))
    c, s = (1 - m * m) / (1 + m * m), 2 * m / (1 + m * m)
    for _ in range(quarters % 4):
        c, s = -s, c
    return c, s


def tangent_near(angle: QQ, bits: int) -> QQ:
    """Return the multiple of 2^-bits that is nearest to the tangent of an angle.

    By the mean value theorem, with d = angle - arctan m,

        tan(angle) - m = d (1 + x^2)    with x between m and tan(angle).

    Let |m| <= 1 and |d| <= 1/16. The arc tangents of m and of x are at most 1/16 apart, and that of
    m is at most pi / 4, so |x| < 2 and 1 <= 1 + x^2 < 5. Closer: |x - m| <= |tan(angle) - m| <= 5
    |d|, so 1 + x^2 differs from 1 + m^2 by at most |x - m| |x + m| <= 15 |d|. A bound D >= |d| and
    bounds of arctan m thus give bounds of the tangent. If both round to one multiple, this is the
    result; if they do not, they are computed with more bits. The tangent of a rational angle other
    than 0 is irrational, and never halfway between two multiples, so this ends.

    Args:
        angle: in radians, between -3/4 and 3/4; or beyond these by little.
        bits: at least 0.
    """
    if not angle:
        return QQ(0)
    more = _MORE_BITS
    m = _tangent_in_doubles(angle)
    known = _BITS_OF_DOUBLES
    while True:
        check_budget()
        wanted = bits + more
        while known < wanted:  # Newton's method doubles the bits that are right, but for three
            known = min(2 * known - 3, wanted)
            low, _ = atan_bounds(m, known + 3)
            m = rounded(m + (angle - low) * (1 + m * m), known + 3)
        least, most = tangent_bounds(angle, m, wanted)
        result = rounded(least, bits)
        if result == rounded(most, bits):
            return result
        more *= 2


def tangent_bounds(angle: QQ, m: QQ, bits: int) -> tuple[QQ, QQ]:
    """Return bounds of the tangent of an angle, from an approximation m with |m| <= 1.

    They are derived above. They are close if m is; they are bounds if |angle - arctan m| < 1/16.
    """
    low, high = atan_bounds(m, bits)
    d = angle - high, angle - low
    spread = 15 * max(map(abs, d))
    slope = 1 + m * m
    products = [x * (slope + y) for x in d for y in (-spread, spread)]
    return m + min(products), m + max(products)


def _tangent_in_doubles(angle: QQ) -> QQ:
    """Return an approximation, at most 1, by Lambert's continued fraction x / (1 - x^2 / (3 - ...).

    Divisions of doubles are the same on every machine; and the result does not depend on them.
    """
    x = nearest_float(angle)
    square, denominator = x * x, 21.0
    for partial in _PARTIAL_DENOMINATORS:
        denominator = partial - square / denominator
    return max(min(rational(x / denominator), QQ(1)), QQ(-1))


def rounded(value: QQ, bits: int) -> QQ:
    """Return the multiple of 2^-bits that is nearest to a number; the greater one of two."""
    unit = power_of_two(bits)
    return floor(value * unit + QQ(1, 2)) / unit
