"""One real root of an integer polynomial, in a rational isolating interval.

The polynomial is square-free, so it changes sign at the root: a rational in the interval
lies below the root if and only if the polynomial has there the sign that it has at the low
end.

Sources: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 10.4 (real roots by isolating intervals); J. Abbott, *Quadratic interval
refinement for real roots*, ACM Communications in Computer Algebra 48 (2014).
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Final, Self

from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    evaluate,
    negate,
    primitive,
    sign_at,
)
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    Rational,
    floor,
    fraction,
    is_square,
    isqrt,
    power_of_two,
    rational,
)

FIRST_STEPS: Final = 6
"""Number of initial refinements by bisection; most numbers need no more."""


class IsolatedRoot:
    """A real root of an integer polynomial, or a rational, whose interval is refined in place.

    Refining narrows the interval of the number, not the number itself.

    The polynomial is square-free and primitive with a positive leading coefficient; for a
    rational p/q it is ``(-p, q)``. No other real root of it lies in [low, high], and
    ``low == high`` if and only if the number is known to be rational. If ``low < high``,
    neither end is a root.
    """

    __slots__ = ("_below", "_bits", "exact_high", "exact_low", "exact_polynomial")

    def __init__(self, value: Rational) -> None:
        self.exact_polynomial: IntPoly
        self.exact_low: QQ
        self.exact_high: QQ
        self._below: int  # the sign of the polynomial at low
        self._bits: int  # bits the next step tries to gain; below 1: bisection
        self._become(rational(value))

    @classmethod
    def root(cls, polynomial: Iterable[int], low: Rational, high: Rational) -> Self:
        """Return the root of a square-free polynomial in (low, high], where it has exactly one.

        ``low`` may be another root; ``low == high`` states that it is the root.
        """
        return cls.exact_root(tuple(map(ZZ, polynomial)), rational(low), rational(high))

    @classmethod
    def exact_root(cls, polynomial: IntPoly, low: QQ, high: QQ) -> Self:
        """Return `root` of numbers of GMP."""
        self = cls.__new__(cls)
        if low == high:
            self._become(high)
            return self
        polynomial = primitive(polynomial)
        if polynomial[-1] < 0:
            polynomial = negate(polynomial)
        if len(polynomial) == 3 and is_square(d := _discriminant(polynomial)):
            c1, c2 = polynomial[1], polynomial[2]
            smaller = QQ(-c1 - isqrt(d), 2 * c2)
            value = smaller if low < smaller <= high else QQ(-c1 + isqrt(d), 2 * c2)
            self._become(value)
            return self
        if len(polynomial) == 2:
            self._become(QQ(-polynomial[0], polynomial[1]))
            return self
        self.exact_polynomial, self.exact_low, self.exact_high = polynomial, low, high
        self._bits = -FIRST_STEPS
        self._below = sign_at(polynomial, low)
        if sign_at(polynomial, high) == 0:
            self._become(high)
        elif self._below == 0:
            self._leave_low_end()
        return self

    @classmethod
    def surd(cls, quadratic: IntPoly, low: QQ, high: QQ, *, larger: bool) -> Self:
        """Return one of the two irrational roots of a quadratic, alone in (low, high).

        Args:
            quadratic: with positive leading coefficient.
            low: a rational below the root.
            high: a rational above it.
            larger: whether it is the larger root.
        """
        self = cls.__new__(cls)
        self.exact_polynomial, self.exact_low, self.exact_high = primitive(quadratic), low, high
        self._bits = -FIRST_STEPS
        self._below = -1 if larger else 1
        return self

    def _leave_low_end(self) -> None:
        # The root is inside (low, high), and low is a (simple) root as well: the sign
        # just right of it is that of the derivative. Bisect until low is not a root.
        self._below = sign_at(derivative(self.exact_polynomial), self.exact_low)
        while True:
            check_budget()
            middle = (self.exact_low + self.exact_high) / 2
            s = sign_at(self.exact_polynomial, middle)
            if s == 0:
                self._become(middle)
                return
            if s == self._below:
                self.exact_low = middle
                return
            self.exact_high = middle

    def _become(self, value: QQ) -> None:
        self.exact_polynomial = (-ZZ(value.numerator), ZZ(value.denominator))
        self.exact_low = self.exact_high = value
        self._below = self._bits = 0

    @property
    def polynomial(self) -> tuple[int, ...]:
        """An integer polynomial with the number as a simple root, constant term first."""
        return tuple(map(int, self.exact_polynomial))

    @property
    def low(self) -> Fraction:
        """A rational at most the number."""
        return fraction(self.exact_low)

    @property
    def high(self) -> Fraction:
        """A rational at least the number."""
        return fraction(self.exact_high)

    @property
    def is_rational(self) -> bool:
        """True if it is known to be rational; a number of degree 3 or more may be unrecognised."""
        return self.exact_low == self.exact_high

    def refine(self) -> None:
        """Shrink the interval at least to a half; close to the root, quadratically.

        An interval around 0 is cut there, so that 0 is found and a tiny number has a sign.
        """
        if self.exact_low == self.exact_high:
            return
        if len(self.exact_polynomial) == 3:
            self._refine_quadratic()
            return
        if self._bits > 1 and not self.exact_low < 0 < self.exact_high:
            self._refine_by_secant()
            return
        self.compare_rational(
            QQ(0)
            if self.exact_low < 0 < self.exact_high
            else (self.exact_low + self.exact_high) / 2
        )
        self._bits = self._bits + 1 if self._bits < 1 else 4

    def _refine_by_secant(self) -> None:
        """One step of Abbott's QIR: of 2^bits equal cells, try the one that the secant hits.

        Where the polynomial is nearly linear the root is in that cell, and the next step
        squares the number of cells. Otherwise the next step takes its square root, and the
        interval is bisected.
        """
        low, width = self.exact_low, self.exact_high - self.exact_low
        at_low, at_high = (abs(evaluate(self.exact_polynomial, t)) for t in (low, self.exact_high))
        cell = width * power_of_two(-self._bits)
        left = low + floor(at_low / (at_low + at_high) / power_of_two(-self._bits)) * cell
        if self.compare_rational(left) > 0 > self.compare_rational(left + cell):
            self._bits *= 2
        else:
            self._bits //= 2
            if self.exact_high - self.exact_low > width / 2:
                self.compare_rational((self.exact_low + self.exact_high) / 2)

    def _refine_quadratic(self) -> None:
        # (-c1 ± sqrt(d)) / 2 c2, the square root to enough bits to double the precision.
        c0, c1, c2 = self.exact_polynomial
        width = self.exact_high - self.exact_low
        bits = 2 * max(8, width.denominator.bit_length() - width.numerator.bit_length()) + 8
        root = isqrt(_discriminant((c0, c1, c2)) << 2 * bits)
        centre = QQ(-c1, 2 * c2)
        unit = QQ(ZZ(1), 2 * c2 << bits)
        # c2 > 0, so the polynomial is positive left of the smaller root.
        if self._below > 0:
            low, high = centre - (root + 1) * unit, centre - root * unit
        else:
            low, high = centre + root * unit, centre + (root + 1) * unit
        self.exact_low, self.exact_high = max(self.exact_low, low), min(self.exact_high, high)

    def refine_to(self, width: QQ) -> None:
        """Refine until ``high - low <= width`` (positive)."""
        while self.exact_high - self.exact_low > width:
            check_budget()
            self.refine()

    def compare_rational(self, number: Rational) -> int:
        """-1, 0 or 1 as this number is smaller than, equal to, or larger than a rational."""
        q = rational(number)  # it may become an end of the interval
        if self.exact_high < q:
            return -1
        if self.exact_low > q:
            return 1
        if self.exact_low == self.exact_high:
            return 0
        s = sign_at(self.exact_polynomial, q)
        if s == 0:
            self._become(q)
            return 0
        if s == self._below:
            self.exact_low = q
            return 1
        self.exact_high = q
        return -1

    def simplified(self) -> Self:
        """Return this number, recognised as rational in place if it is.

        A rational root p/q of an integer polynomial has q dividing the leading
        coefficient c (Gauss), so c * root is an integer: one candidate is left once
        the interval is narrower than 1/c.
        """
        if self.exact_low < self.exact_high and len(self.exact_polynomial) > 3:
            lead = self.exact_polynomial[-1]
            self.refine_to(QQ(ZZ(1), 2 * lead))
            self.compare_rational(QQ(floor(self.exact_high * lead), lead))
        return self

    def __reduce__(self) -> tuple[object, ...]:
        kind = type(self)
        if self.exact_low == self.exact_high:
            return kind, (str(self.exact_low),)
        return kind.root, (self.polynomial, str(self.exact_low), str(self.exact_high))


def _discriminant(f: IntPoly) -> ZZ:
    return f[1] * f[1] - 4 * f[0] * f[2]
