"""The square root of a rational number: exactly, or the nearest double, also of it less another."""

from __future__ import annotations

from typing import Final, NamedTuple, final

from exactpt.kernel.numbers import (
    QQ,
    exponent,
    floor,
    isqrt,
    isqrt_rem,
    nearest_float,
    power_of_two,
)

BITS: Final = 64
"""Bits of the integer square root, at least: more than a double and its rounding bit have."""
BOUND_BITS: Final = 24
"""Significant bits of rational bounds of a square root, at least."""


def nearest_square_root(value: QQ) -> float:
    """Return the double nearest to the square root of a number >= 0; inf beyond the largest double.

    For n / d and an even shift s, floor(sqrt(n 2^s / d)) = r has `BITS` bits or more, and the root
    is in [r, r + 1) / 2^(s/2). If it is not r itself, r + 1/2 takes its place: no double and no
    midpoint of two doubles lies strictly between r and r + 1, since these have at most 54 bits.
    """
    if value == 0:
        return 0.0
    shift = 2 * BITS + value.denominator.bit_length() - value.numerator.bit_length()
    shift += shift % 2
    scaled = value * power_of_two(shift)
    whole = scaled.numerator // scaled.denominator
    r, rest = isqrt_rem(whole)
    is_exact = rest == 0 and scaled.denominator == 1
    root = QQ(r) if is_exact else QQ(2 * r + 1, 2)
    return nearest_float(root * power_of_two(-shift // 2))


def exact_square_root(value: QQ) -> QQ | None:
    """Return the square root of a number >= 0 if it is rational, else None."""
    root = QQ(isqrt(value.numerator), isqrt(value.denominator))
    return root if root * root == value else None


@final
class RootBounds(NamedTuple):
    """Rational bounds of a square root; both are the root if it is rational."""

    low: QQ
    high: QQ


def root_bounds(value: QQ) -> RootBounds:
    """Return rational bounds of the square root of a number >= 0.

    If the root is irrational, the larger bound is less than 1 + 2^-23 times the smaller one.

    >>> root_bounds(QQ(9, 4)).high == QQ(3, 2)
    True
    >>> bounds = root_bounds(QQ(2))
    >>> bounds.low**2 < 2 < bounds.high**2
    True
    """
    exact = exact_square_root(value)
    if exact is not None:
        return RootBounds(exact, exact)
    unit = power_of_two(exponent(value) // 2 - BOUND_BITS)
    units = isqrt(floor(value / (unit * unit)))
    return RootBounds(QQ(units) * unit, QQ(units + 1) * unit)


def nearest_root_less(value: QQ, less: QQ) -> float:
    """Return the double nearest to sqrt(value) - less, for numbers >= 0.

    An irrational root less a rational is neither a double nor a midpoint of two: with enough bits,
    both bounds of it have the same nearest double.
    """
    if less == 0:
        return nearest_square_root(value)
    exact = exact_square_root(value)
    if exact is not None:
        return nearest_float(exact - less)
    shift = 2 * BITS + value.denominator.bit_length()
    while True:
        unit = power_of_two(-shift)
        scaled = value / (unit * unit)
        low = QQ(isqrt(scaled.numerator // scaled.denominator)) * unit - less
        near = nearest_float(low)
        if near == nearest_float(low + unit):
            return near
        shift *= 2


def root_above(squared: QQ) -> QQ:
    """Return a number a little above a square root; 0 for 0."""
    n, d = squared.numerator, squared.denominator
    shift = max(0, BITS - (n * d).bit_length() // 2)
    return QQ(isqrt(n * d << 2 * shift) + 1, d << shift) if n else QQ(0)
