"""Rational bounds of arc tangents and of pi."""

from __future__ import annotations

from functools import lru_cache

from exactpt.kernel.numbers import QQ, floor, power_of_two

Bounds = tuple[QQ, QQ]

_GUARD = 16
"""Bits beyond those that are asked for."""


@lru_cache(maxsize=64)
def pi_bounds(bits: int) -> Bounds:
    """Return bounds of pi, at most 2^-bits apart, by Machin's formula."""
    (a, b), (c, d) = _series(QQ(1, 5), bits + 6), _series(QQ(1, 239), bits + 6)
    return 16 * a - 4 * d, 16 * b - 4 * c


def atan_bounds(x: QQ, bits: int) -> Bounds:
    """Return bounds of the arc tangent of x, |x| <= 1.

    They are at most 2^-bits apart, up to 10,000 bits.
    """
    if x < 0:
        low, high = atan_bounds(-x, bits)
        return -high, -low
    if 2 * x <= 1:
        return _series(x, bits)
    low, high = _series((1 - x) / (1 + x), bits + 1)  # pi / 4 is their sum
    p, q = pi_bounds(bits + 1)
    return p / 4 - high, q / 4 - low


def _series(x: QQ, bits: int) -> Bounds:
    """Return bounds of the arc tangent of x, for 0 <= x <= 1/2, by its series.

    In units u = 2^-n: rounding x down changes the arc tangent by less than u. Let e be the error of
    a computed power P <= 1/2 of x, s that of the square S <= 1/4: s < 1, and the error of the next
    power is less than e S + P s + 1 < e / 4 + 3/2. So e < 2 always, and each term, divided by an
    odd number and rounded down, errs by less than 3. The powers end when one is below u; the
    next term, and with it the rest of the alternating series, is less than e + 1 < 3.
    """
    n = bits + _GUARD
    power = floor(x * power_of_two(n))
    square = (power * power) >> n
    total, terms, divisor = power * 0, 0, 1
    while power:
        total += -(power // divisor) if terms % 2 else power // divisor
        power = (power * square) >> n
        terms, divisor = terms + 1, divisor + 2
    off, unit = 3 * terms + 4, power_of_two(-n)
    return (total - off) * unit, (total + off) * unit
