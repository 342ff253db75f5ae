"""Decimal expansions of exact numbers, correctly rounded."""

from __future__ import annotations

from decimal import MAX_EMAX, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import lowest_terms, value_bounds
from exactpt.kernel.budget import ask
from exactpt.kernel.integer_polynomial import IntPoly, evaluate, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ

__all__ = ["decimal_quotient_at"]


def decimal_quotient_at(n: IntPoly, d: IntPoly, t: AlgebraicNumber, digits: int) -> Decimal:
    """n(t) / d(t), rounded to significant digits; a value halfway between two, to the even one.

    Bounds of the value are narrowed until both are rounded to the same decimal: rounding is
    monotone. That ends unless the value is 0 or halfway between two decimals, which is decided
    by the sign of a polynomial at t.

    Args:
        n: the numerator.
        d: the denominator, which does not vanish at t.
        t: any real algebraic number.
        digits: the number of significant digits, at least 1.

    Raises:
        InputError: if ``digits`` is less than 1.
    """
    if digits < 1:
        raise InputError(f"digits: at least 1: {digits}")
    context = Context(digits, ROUND_HALF_EVEN, MIN_EMIN, MAX_EMAX)
    n, d = lowest_terms(n, d)
    if t.sign_of(n) == 0:
        return Decimal(0)
    if t.is_rational:
        return _rounded(evaluate(n, t._low) / evaluate(d, t._low), context)
    while True:
        ask()
        low, high = (_rounded(bound, context) for bound in value_bounds(n, d, t))
        if low == high:
            return low
        if context.next_plus(low) == high:
            middle = (QQ(*low.as_integer_ratio()) + QQ(*high.as_integer_ratio())) / 2
            p, q = ZZ(middle.numerator), ZZ(middle.denominator)
            if t.sign_of(subtract(scale(n, q), scale(d, p))) == 0:
                return _rounded(middle, context)
        t.refine()


def _rounded(value: QQ, context: Context) -> Decimal:
    return context.divide(Decimal(int(value.numerator)), Decimal(int(value.denominator)))
