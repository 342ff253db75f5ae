"""Integer polynomials as single integers: their values at 2^width.

A sum of products of polynomials becomes a sum of products of integers, each a single call
of GMP, and the coefficients of the result are its signed digits in base 2^width.
Determinants of short polynomials are built several times faster than coefficient by
coefficient.

Source: Kronecker substitution; J. von zur Gathen, J. Gerhard, *Modern Computer Algebra*,
section 8.4.
"""

from __future__ import annotations

from functools import cache

from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import ZZ, digits


def coefficient_bits(*polynomials: IntPoly) -> int:
    """Return the bit length of the largest coefficient."""
    return max([c.bit_length() for f in polynomials for c in f], default=0)


def width_for(bits: int, length: int, factors: int) -> int:
    """Return a width that fits every coefficient of a sum of at most 8 products.

    Each coefficient of a product of polynomials of ``bits`` bits in total is a sum of at
    most length^(factors - 1) products of coefficients: one coefficient of each factor but
    the last can be chosen freely. So the sum is below 2^(width - 1). The width is a power
    of two, so that one width serves most of a scene.

    Args:
        bits: the sum of the coefficient bit lengths of the factors.
        length: the length of the result, and so at least that of each factor.
        factors: the number of factors in each product.
    """
    digits_needed = bits + (factors - 1) * length.bit_length() + 3 + 1
    return 1 << (digits_needed - 1).bit_length()


def pack(f: IntPoly, width: int) -> ZZ:
    """f(2^width)."""
    value = ZZ(0)
    for c in reversed(f):
        value = (value << width) + c
    return value


def unpack(value: ZZ, width: int, length: int) -> IntPoly:
    """Return the polynomial with this value at 2^width.

    Args:
        value: the value of a polynomial with coefficients below 2^(width - 1) in size.
        width: see `width_for`.
        length: the maximum number of its coefficients.
    """
    half, halves = _halves(width, length)
    f = [digit - half for digit in digits(value + halves, width)]
    while f and not f[-1]:
        f.pop()
    return tuple(f)


@cache
def _halves(width: int, length: int) -> tuple[ZZ, ZZ]:
    """Half the base, and the number with all digits equal to it: added, no digit is negative."""
    half = ZZ(1) << (width - 1)
    return half, pack((half,) * length, width)
