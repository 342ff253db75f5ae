"""The double nearest to the square root of a rational number."""

from __future__ import annotations

from typing import Final

from exactpt.kernel.numbers import QQ, isqrt_rem, nearest_float, power_of_two

__all__ = ["nearest_square_root"]

BITS: Final = 64
"""Bits of the integer square root, at least: more than a double and its rounding bit have."""


def nearest_square_root(value: QQ) -> float:
    """The double nearest to the square root of a number >= 0; inf beyond the largest double.

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
