"""Fixed-point numbers: exact numbers as integer multiples of a power of two, rounded down.

Coordinates are translated and scaled exactly before they become doubles, so that a scene far
from the origin, very large or very small, is drawn with the same precision as any other.
"""

from __future__ import annotations

from typing import Final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, floor, power_of_two

BITS: Final = 192
"""Precision in bits: 2**-192 of the time span for times, of the size of the scene for points."""


def exponent_above(extent: QQ) -> int:
    """Return the least integer e with ``extent <= 2**e``; 0 if the extent is 0."""
    if extent == 0:
        return 0
    e = int(extent.numerator).bit_length() - int(extent.denominator).bit_length()
    return e if extent <= power_of_two(e) else e + 1


def fixed(value: AlgebraicNumber | QQ, bits: int) -> int:
    """Return the integer n with n <= value * 2**bits < n + 1."""
    scale = power_of_two(bits)
    if not isinstance(value, AlgebraicNumber):
        return int(floor(value * scale))
    # Refinement ends: a rational number gets an interval with equal ends, an irrational one
    # lies strictly between two consecutive multiples.
    number = value.simplified()
    while (n := floor(number.exact_low * scale)) != floor(number.exact_high * scale):
        number.refine()
    return int(n)


def near(value: AlgebraicNumber, span: QQ) -> QQ:
    """Return a rational at most 2**-192 of the span (rounded up to a power of two) below a number.

    A rational number is returned unchanged.
    """
    number = value.simplified()
    if number.is_rational:
        return number.exact_low
    bits = BITS - exponent_above(span)
    return fixed(number, bits) * power_of_two(-bits)
