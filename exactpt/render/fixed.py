"""Fixed point: exact numbers as integers in units of a power of two, rounded down.

What is drawn is shifted and scaled exactly before it becomes a double, so a scene far from
the origin, or very large or small, is drawn as well as any other.
"""

from __future__ import annotations

from typing import Final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, floor, power_of_two

__all__ = ["BITS", "exponent_above", "fixed", "near"]

BITS: Final = 192
"""How fine pictures are: a time is known to 2**-192 of the time span, a place of the scene."""


def exponent_above(extent: QQ) -> int:
    """The least e with ``extent <= 2**e``; 0 if the extent is 0."""
    if extent == 0:
        return 0
    e = int(extent.numerator).bit_length() - int(extent.denominator).bit_length()
    return e if extent <= power_of_two(e) else e + 1


def fixed(value: AlgebraicNumber | QQ, bits: int) -> int:
    """The integer n with n <= value * 2**bits < n + 1."""
    scale = power_of_two(bits)
    if not isinstance(value, AlgebraicNumber):
        return int(floor(value * scale))
    # Once a rational number is known to be one, the ends meet; an irrational one is inside
    # a unit, and the ends get there too.
    number = value.simplified()
    while (n := floor(number._low * scale)) != floor(number._high * scale):
        number.refine()
    return int(n)


def near(value: AlgebraicNumber, span: QQ) -> QQ:
    """A rational at most 2**-192 of the span (rounded up to a power of two) below a number.

    A rational number is itself.
    """
    number = value.simplified()
    if number.is_rational:
        return number._low
    bits = BITS - exponent_above(span)
    return fixed(number, bits) * power_of_two(-bits)
