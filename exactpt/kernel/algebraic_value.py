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
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    evaluate,
    greatest_common_divisor,
    primitive,
    quotient,
    range_on,
    scale,
    square_free,
    subtract,
    trimmed,
)
from exactpt.kernel.numbers import QQ, ZZ, ceil, exponent, floor, is_square, isqrt, power_of_two
from exactpt.kernel.sturm import count_roots, sturm_sequence

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
    sequence = sturm_sequence(f)
    while True:
        low, high = bounds()
        if low == high:
            return AlgebraicNumber(low)
        low, high = _rounded_out(low, high)
        if count_roots(sequence, low, high) == 1 and evaluate(f, low) != 0:
            return AlgebraicNumber.exact_root(f, low, high)
        number.refine()


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
    """Return the product of g over the complex roots of p, by Euclid's algorithm.

    With leading coefficients a of p and b of g, and degrees k and m, it is
    (-1)^(k m) b^k / a^m times the product of p over the roots of g.
    """
    over, under = [QQ(c) for c in g], [QQ(c) for c in p]
    product = QQ(1)
    while True:
        over = _remainder(over, under)
        if not over:
            return QQ(0)
        k, m = len(under) - 1, len(over) - 1
        product *= over[-1] ** k
        if m == 0:
            return product
        product *= (-1) ** (k * m) / under[-1] ** m
        over, under = under, over


def _remainder(f: list[QQ], g: list[QQ]) -> list[QQ]:
    rest = f[:]
    while len(rest) >= len(g):
        factor = rest[-1] / g[-1]
        shift = len(rest) - len(g)
        for i, c in enumerate(g[:-1]):
            rest[shift + i] -= factor * c
        rest.pop()
    while rest and rest[-1] == 0:
        rest.pop()
    return rest
