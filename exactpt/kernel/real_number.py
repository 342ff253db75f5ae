"""Arithmetic of algebraic numbers with rationals, rounding and text."""

from __future__ import annotations

import math
import re
from decimal import localcontext
from fractions import Fraction
from typing import Final, Self

from exactpt.errors import InputError
from exactpt.kernel.approximation import nearest_double, rounded_decimal, rounding_context
from exactpt.kernel.integer_polynomial import trimmed
from exactpt.kernel.isolated_root import IsolatedRoot
from exactpt.kernel.numbers import QQ, ZZ, Rational, floor, fraction, rational

ONE: Final = QQ(1)
LONGEST: Final = 120
"""Most characters of a number or of coefficients in ``str`` and ``repr``."""


class RealNumber(IsolatedRoot):
    """The part of `exactpt.AlgebraicNumber` that needs no second irrational number."""

    __slots__ = ()

    def __float__(self) -> float:
        return nearest_double(self)

    def __add__(self, other: Rational) -> Self:
        """Return the sum with a rational number, exactly.

        Raises:
            TypeError: for an irrational number; `to_sympy` has sums of these.
        """
        return self._affine(ONE, _operand(other))

    __radd__ = __add__

    def __sub__(self, other: Rational) -> Self:
        """Return the difference to a rational number, exactly; errors as of a sum."""
        return self._affine(ONE, -_operand(other))

    def __rsub__(self, other: Rational) -> Self:
        return self._affine(-ONE, _operand(other))

    def __mul__(self, other: Rational) -> Self:
        """Return the product with a rational number, exactly; errors as of a sum."""
        return self._affine(_operand(other), QQ(0))

    __rmul__ = __mul__

    def __truediv__(self, other: Rational) -> Self:
        """Return the quotient by a rational number, exactly; errors as of a sum."""
        return self._affine(1 / _operand(other), QQ(0))

    def __neg__(self) -> Self:
        return self._affine(-ONE, QQ(0))

    def _affine(self, a: QQ, b: QQ) -> Self:
        """Return a x + b."""
        low, high = self.exact_low, self.exact_high
        if low == high or not a:
            return type(self)(a * low + b)
        row: list[QQ] = []  # Horner's rule for the polynomial at (y - b) / a
        for c in reversed(self.exact_polynomial):
            shifted = [QQ(0), *(r / a for r in row)]
            for i, r in enumerate(row):
                shifted[i] -= r * b / a
            shifted[0] += c
            row = shifted
        common = math.lcm(*(int(c.denominator) for c in row))
        ends = sorted((a * low + b, a * high + b))
        polynomial = trimmed(ZZ(c * common) for c in row)
        return type(self).exact_root(polynomial, ends[0], ends[1])

    def __round__(self, digits: int | None = None) -> int | Fraction:
        """Return the nearest integer, or multiple of 10^-digits; of two, the even one."""
        unit = QQ(1) if digits is None else QQ(10) ** -digits
        below = self._multiple_below(unit)
        side = self.compare_rational((below + QQ(1, 2)) * unit)
        count = below + (side > 0 or (side == 0 and below % 2 == 1))
        return int(count) if digits is None else fraction(count * unit)

    def _multiple_below(self, unit: QQ) -> ZZ:
        """Return the largest n with n times the unit at most this number."""
        while floor(self.exact_low / unit) != floor(self.exact_high / unit):
            multiple = floor(self.exact_high / unit)
            if self.compare_rational(multiple * unit) >= 0:
                return multiple
            self.refine()
        return floor(self.exact_low / unit)

    def __format__(self, spec: str) -> str:
        """Return ``str(x)`` without a specification; with one, that of the nearest double.

        With "e", "f", "g" or "%" and more than 15 digits, all digits are right.
        """
        if not spec:
            return str(self)
        match = re.search(r"\.(\d+)[eEfFgG%]$", spec)
        if match is None or int(match[1]) <= 15:
            return format(float(self), spec)
        units = self._multiple_below(QQ(1))
        context = rounding_context(int(match[1]) + len(str(units)) + 30)
        while True:
            ends = [rounded_decimal(q, context) for q in (self.exact_low, self.exact_high)]
            with localcontext(context):  # Python rounds by the caller's context otherwise
                low, high = (format(end, spec) for end in ends)
            if low == high:
                return low
            self.refine()

    def __int__(self) -> int:
        """Return the integer part, towards zero."""
        below = int(self._multiple_below(QQ(1)))
        return below + (below < 0 and self.compare_rational(below) > 0)

    def __str__(self) -> str:
        if self.exact_low == self.exact_high:
            return _cut(str(self.exact_low))
        coefficients = f"({', '.join(map(str, self.exact_polynomial))})"
        if len(coefficients) > LONGEST:
            coefficients = f"a polynomial of degree {len(self.exact_polynomial) - 1}"
        return f"{float(self)!r}... (root of {coefficients})"

    def __repr__(self) -> str:
        if self.exact_low == self.exact_high:
            return f"AlgebraicNumber('{_cut(str(self.exact_low))}')"
        degree = len(self.exact_polynomial) - 1
        return f"<{float(self)!r}... (root of a polynomial of degree {degree})>"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST // 2]}...{text[-8:]}"


def _operand(value: Rational) -> QQ:
    """Return a rational operand.

    Raises:
        TypeError: if it is an irrational number, or no number.
    """
    if isinstance(value, IsolatedRoot) and not value.simplified().is_rational:
        raise TypeError("both numbers are irrational: use x.to_sympy() for exact arithmetic")
    try:
        return rational(value)
    except InputError as error:
        raise TypeError(str(error)) from None
