"""Quotients of polynomials at algebraic times, correctly rounded: doubles and decimals."""

from __future__ import annotations

import math
import sys
from decimal import MAX_EMAX, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import IntPoly, range_on, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ, nearest_float
from exactpt.kernel.real_number import rounded_decimal


def exponent(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> int:
    """About the binary exponent of p / w at a time; the least integer if p vanishes there."""
    if time.sign_of(p) == 0:
        return -sys.maxsize
    while True:
        check_budget()
        low, high = _range(p, w, time._low, time._high)
        least = low if low > 0 else -high
        if least > 0:
            return least.numerator.bit_length() - least.denominator.bit_length()
        time.refine()


def nearest_quotient(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> float:
    """Return the double nearest to p / w at a time, at which w is positive."""
    if time.sign_of(p) == 0:
        return 0.0
    while True:
        check_budget()
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


def decimal_quotient(p: IntPoly, w: IntPoly, time: AlgebraicNumber, digits: int) -> Decimal:
    """Return the decimal nearest to p / w at a time, at which w is positive; of two, the even one.

    Args:
        p: the numerator.
        w: the denominator.
        time: any real algebraic number; it is refined.
        digits: the number of significant digits, at least 1.

    Raises:
        InputError: if ``digits`` is less than 1.
    """
    if digits < 1:
        raise InputError(f"digits: at least 1: {digits}")
    context = Context(digits, ROUND_HALF_EVEN, MIN_EMIN, MAX_EMAX)
    if time.sign_of(p) == 0:
        return Decimal(0)
    while True:
        check_budget()
        low, high = _range(p, w, time._low, time._high)
        a, b = rounded_decimal(low, context), rounded_decimal(high, context)
        if a == b:
            return a
        if b == context.next_plus(a):
            middle = (QQ(*a.as_integer_ratio()) + QQ(*b.as_integer_ratio())) / 2
            f = subtract(scale(p, ZZ(middle.denominator)), scale(w, ZZ(middle.numerator)))
            s = time.sign_of(f)
            return rounded_decimal(middle, context) if s == 0 else b if s > 0 else a
        time.refine()


def _range(p: IntPoly, w: IntPoly, low: QQ, high: QQ) -> tuple[QQ, QQ]:
    a, b = range_on(p, low, high)
    c, d = range_on(w, low, high)
    if c <= 0:
        c = QQ(1, 1 << 4096)  # w is positive: any positive bound will do until refinement
    return (a / d if a > 0 else a / c), (b / c if b > 0 else b / d)
