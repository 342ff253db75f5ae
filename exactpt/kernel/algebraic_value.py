"""Values of quotients of polynomials at algebraic numbers, and square roots, as algebraic numbers.

For a root t of p, the value y = n(t) / d(t) is a root of R(y), the product of n - y d over all
roots of p: up to a factor, the resultant of p and n - y d. The degree of R is at most that of p,
so its values at that many points and one determine it.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*, 2nd ed.,
section 4.2 (resultants).
"""

from __future__ import annotations

from collections.abc import Callable
from math import lcm
from typing import Final, final

from exactpt.errors import InputError
from exactpt.kernel.algebraic import FINE, AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    evaluate,
    greatest_common_divisor,
    primitive,
    quotient,
    range_on,
    scale,
    sign_at,
    sign_on,
    square_free,
    subtract,
    trimmed,
)
from exactpt.kernel.numbers import QQ, ZZ, ceil, exponent, floor, is_square, isqrt, power_of_two

RELATIVE_BITS: Final = 8
"""Binary digits of the first bounds of the square root of a rational."""


def lowest_terms(n: IntPoly, d: IntPoly) -> tuple[IntPoly, IntPoly]:
    """Numerator and denominator of the same quotient, without a common factor."""
    if not n:
        return n, (ZZ(1),)
    common = greatest_common_divisor(n, d)
    if len(common) <= 1:
        return n, d
    p, q = quotient(n, common), quotient(d, common)
    factor = QQ(n[-1] * q[-1], d[-1] * p[-1])
    return scale(p, ZZ(factor.numerator)), scale(q, ZZ(factor.denominator))


@final
class LateQuotient:
    """The value of a quotient of polynomials at an algebraic number, computed when it is read.

    Args:
        n: the numerator.
        d: the denominator.
        time: the number.
    """

    __slots__ = ("_of", "_value")

    def __init__(self, n: IntPoly, d: IntPoly, time: AlgebraicNumber) -> None:
        self._of = n, d, time
        self._value: AlgebraicNumber | None = None

    def value(self) -> AlgebraicNumber:
        """Return the value."""
        if self._value is None:
            self._value = quotient_at(*self._of)
        return self._value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, LateQuotient) and (
            self._of == other._of or self.value() == other.value()
        )

    def __hash__(self) -> int:
        return hash(self.value())


def quotient_at(n: IntPoly, d: IntPoly, t: AlgebraicNumber) -> AlgebraicNumber:
    """n(t) / d(t).

    Raises:
        InputError: if d vanishes at t and n does not; where both do, the limit is returned.
    """
    n, d = lowest_terms(n, d)
    if t.sign_of(d) == 0:
        raise InputError("the denominator vanishes")
    if not n or t.is_rational:
        return AlgebraicNumber(evaluate(n, t.exact_low) / evaluate(d, t.exact_low))
    p = t.exact_polynomial
    common = greatest_common_divisor(p, d)
    if len(common) > 1:
        p = quotient(p, common)
    return _root_near(_norm_in_y(p, n, d), lambda: _range(n, d, t), t)


def quotient_range(n: IntPoly, d: IntPoly, t: AlgebraicNumber, close: QQ) -> tuple[QQ, QQ]:
    """Return bounds of n(t) / d(t), which is not negative; d does not vanish at t.

    They differ by at most a given part of the upper one, unless t is already known to 2^-100.
    """
    low, high = _range(n, d, t)
    while high - low > close * high and t.exact_high - t.exact_low > FINE:
        t.refine()
        low, high = _range(n, d, t)
    return low, high


def square_root(y: AlgebraicNumber) -> AlgebraicNumber:
    """Return the square root of a number >= 0."""
    if y.compare_rational(0) == 0:
        return AlgebraicNumber(0)
    polynomial: list[ZZ] = []
    for c in y.exact_polynomial:
        polynomial += [c, ZZ(0)]
    return _root_near(trimmed(polynomial), lambda: _range_of_root(y), y)


def _root_near(
    f: IntPoly, bounds: Callable[[], tuple[QQ, QQ]], number: AlgebraicNumber
) -> AlgebraicNumber:
    """Return the root of f between bounds that depend on a number.

    The number is refined only while its present enclosure does not suffice. Callers ask about the
    same number again and again, and each step of refinement doubles its digits.
    """
    f = square_free(f)
    slope = derivative(f)
    while True:
        low, high = bounds()
        if low == high:
            return AlgebraicNumber(low)
        low, high = _rounded_out(low, high)
        if _is_only_root(f, slope, low, high):
            return AlgebraicNumber.exact_root(f, low, high)
        number.refine()


def _is_only_root(f: IntPoly, slope: IntPoly, low: QQ, high: QQ) -> bool:
    """Return True if f has one root above low and up to high, by signs alone; else perhaps one.

    A function whose derivative has one sign has at most one root. The polynomials here have up to
    a hundred coefficients of thousands of digits: their Sturm sequences take seconds.
    """
    at_low, at_high = sign_at(f, low), sign_at(f, high)
    is_crossed = at_low not in (0, at_high)
    return is_crossed and sign_on(slope, low, high) != 0


def _rounded_out(low: QQ, high: QQ) -> tuple[QQ, QQ]:
    """Dyadic bounds with few digits, farther apart by at most an eighth.

    Bounds computed from others have their digits times the degree, however wide they are.
    """
    unit = power_of_two(exponent(high - low) - 5)  # at most a sixteenth of the width
    return floor(low / unit) * unit, ceil(high / unit) * unit


def _range(n: IntPoly, d: IntPoly, t: AlgebraicNumber) -> tuple[QQ, QQ]:
    """Return bounds of n(t) / d(t), by an enclosure of t on which d does not vanish."""
    low, high = range_on(d, t.exact_low, t.exact_high)
    while low <= 0 <= high:
        t.refine()
        low, high = range_on(d, t.exact_low, t.exact_high)
    ends = [x / y for x in range_on(n, t.exact_low, t.exact_high) for y in (low, high)]
    return min(ends), max(ends)


def _range_of_root(y: AlgebraicNumber) -> tuple[QQ, QQ]:
    """Return bounds of the square root of y, by an enclosure of it that is positive."""
    while y.exact_low <= 0 and not y.is_rational:
        y.refine()
    if y.is_rational and is_square(y.exact_low.numerator) and is_square(y.exact_low.denominator):
        root = QQ(isqrt(y.exact_low.numerator), isqrt(y.exact_low.denominator))
        return root, root
    size = exponent(y.exact_high) // 2
    bits = (
        RELATIVE_BITS - size if y.is_rational else size - exponent(y.exact_high - y.exact_low) + 4
    )
    unit = power_of_two(-bits)
    low, high = (isqrt(floor(v / (unit * unit))) for v in (y.exact_low, y.exact_high))
    return low * unit, (high + 1) * unit


def _norm_in_y(p: IntPoly, n: IntPoly, d: IntPoly) -> IntPoly:
    """Return the product of n - y d over the roots of p, as a polynomial in y, up to a factor."""
    count = len(p)
    table = [_norm(p, subtract(n, scale(d, ZZ(y)))) for y in range(count)]
    for k in range(1, count):  # Newton's divided differences
        for i in range(count - 1, k - 1, -1):
            table[i] = (table[i] - table[i - 1]) / k
    result = [QQ(0)]
    for k in range(count - 1, -1, -1):  # Horner's rule on the Newton form
        result = [QQ(0), *result]
        for i in range(len(result) - 1):
            result[i] -= k * result[i + 1]
        result[0] += table[k]
    common = lcm(*(c.denominator for c in result))
    return primitive(trimmed([ZZ(c * common) for c in result]))


def _norm(p: IntPoly, g: IntPoly) -> QQ:
    """Return the product of g over the complex roots of p: their resultant, by p's leading part.

    With the leading coefficient a of p and the degree m of g, the resultant is a^m times it.
    """
    if not g:
        return QQ(0)
    return QQ(_resultant(p, g), p[-1] ** (len(g) - 1))


def _resultant(f: IntPoly, g: IntPoly) -> ZZ:
    """Return the resultant of two polynomials that are not zero, by their subresultants.

    Each remainder of integer coefficients is divided by the factor that it is known to have, so
    the digits grow with the degree alone. Euclid's algorithm on rationals spends its time on
    greatest common divisors of numbers.

    Source: H. Cohen, *A Course in Computational Algebraic Number Theory*, algorithm 3.3.7.
    """
    sign = 1
    if len(f) < len(g):
        f, g = g, f
        sign = _sign_of_exchange(f, g)
    lead, height = ZZ(1), ZZ(1)
    while len(g) > 1:
        check_budget()
        drop = len(f) - len(g)
        sign *= _sign_of_exchange(f, g)
        known = lead * height**drop
        rest = _pseudo_remainder(f, g)
        f, g = g, tuple(c // known for c in rest)
        if not g:
            return ZZ(0)  # a common factor
        lead = f[-1]
        height = _power_over(lead, height, drop)
    last: ZZ = _power_over(g[0], height, len(f) - 1)
    return last if sign > 0 else -last


def _sign_of_exchange(f: IntPoly, g: IntPoly) -> int:
    """Return the factor of the resultant when the polynomials change places."""
    return -1 if (len(f) - 1) * (len(g) - 1) % 2 else 1


def _power_over(base: ZZ, under: ZZ, exponent: int) -> ZZ:
    """Return base^k / under^(k - 1), an integer in subresultants, for an exponent k >= 0."""
    if exponent == 0:
        return under
    power: ZZ = base**exponent // under ** (exponent - 1)
    return power


def _pseudo_remainder(f: IntPoly, g: IntPoly) -> IntPoly:
    """Return the remainder of f times lead(g)^(deg f - deg g + 1) by g."""
    rest = list(f)
    lead = g[-1]
    while len(rest) >= len(g):
        top = rest.pop()
        shift = len(rest) - (len(g) - 1)
        rest = [lead * c for c in rest]
        for i, c in enumerate(g[:-1]):
            rest[shift + i] -= top * c
    return trimmed(rest)
