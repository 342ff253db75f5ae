"""Quotients of polynomials at algebraic times, as doubles."""

from __future__ import annotations

import math
import sys

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, range_on, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ, nearest_float

__all__ = ["exponent", "nearest_quotient"]


def exponent(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> int:
    """About the binary exponent of p / w at a time; the least integer if p vanishes there."""
    if time.sign_of(p) == 0:
        return -sys.maxsize
    while True:
        low, high = _range(p, w, time._low, time._high)
        least = low if low > 0 else -high
        if least > 0:
            return least.numerator.bit_length() - least.denominator.bit_length()
        time.refine()


def nearest_quotient(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> float:
    """The double nearest to p / w at a time, at which w is positive."""
    if time.sign_of(p) == 0:
        return 0.0
    while True:
        low, high = _range(p, w, time._low, time._high)
        a, b = nearest_float(low), nearest_float(high)
        if a == b:
            return a
        if b == math.nextafter(a, math.inf) and math.isfinite(a + b):
            middle = (QQ(*a.as_integer_ratio()) + QQ(*b.as_integer_ratio())) / 2
            f = subtract(scale(p, ZZ(middle.denominator)), scale(w, ZZ(middle.numerator)))
            s = time.sign_of(f)
            return nearest_float(middle) if s == 0 else b if s > 0 else a
        time.refine()


def _range(p: IntPoly, w: IntPoly, low: QQ, high: QQ) -> tuple[QQ, QQ]:
    a, b = range_on(p, low, high)
    c, d = range_on(w, low, high)
    if c <= 0:
        c = QQ(1, 1 << 4096)  # w is positive: any positive bound will do until refinement
    return (a / d if a > 0 else a / c), (b / c if b > 0 else b / d)
