"""Real algebraic numbers: the times of events, compared exactly.

A number is a square-free integer polynomial and an interval that holds exactly one
of its real roots; or a rational. Nearly every comparison ends with disjoint
intervals; equality is decided by a gcd.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 10.4 (real roots by isolating intervals).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Final, final

from exactpt.errors import InputError
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    greatest_common_divisor,
    negate,
    positive_remainder,
    primitive,
    sign_at,
)
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    Rational,
    enclosing_floats,
    floor,
    is_square,
    isqrt,
    nearest_float,
    power_of_two,
    rational,
    sign,
)
from exactpt.kernel.sturm import count_roots, sturm_sequence

if TYPE_CHECKING:
    import sympy

__all__ = ["AlgebraicNumber", "rational_between"]

FINE: Final = power_of_two(-100)
"""Intervals narrower than this are not refined before the gcd is asked for."""


@final
class AlgebraicNumber:
    """A real algebraic number: a root of an integer polynomial, or a rational.

    Compares exactly with other numbers and with rationals. ``float(x)`` is the
    nearest double. Comparing refines the interval in place, which changes no
    answer; there is no hash, since one number has many polynomials.

    Attributes:
        polynomial: square-free, integer, primitive, leading coefficient positive,
            constant term first; of a rational p/q it is ``(-p, q)``.
        low: a rational at most the number.
        high: a rational at least the number; no other real root of ``polynomial``
            lies in [low, high], and ``low == high`` if and only if the number is
            known to be rational. Where ``low < high``, neither end is a root.
    """

    __slots__ = ("high", "low", "polynomial")
    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __init__(self, value: Rational) -> None:
        q = rational(value)
        self.polynomial: IntPoly = (-ZZ(q.numerator), ZZ(q.denominator))
        self.low = q
        self.high = q

    @classmethod
    def root(cls, polynomial: IntPoly, low: QQ, high: QQ) -> AlgebraicNumber:
        """The root of a square-free polynomial in (low, high], where it has exactly one.

        ``low`` itself may be another root; ``low == high`` says that it is the root.
        """
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
        self.polynomial, self.low, self.high = polynomial, low, high
        if sign_at(polynomial, high) == 0:
            self._become(high)
        elif sign_at(polynomial, low) == 0:
            self._leave_low_end()
        return self

    def _leave_low_end(self) -> None:
        # The root is inside (low, high), and low is a (simple) root as well: the sign
        # just right of it is that of the derivative. Halve until low is no root.
        right_of_low = sign_at(derivative(self.polynomial), self.low)
        while True:
            middle = (self.low + self.high) / 2
            s = sign_at(self.polynomial, middle)
            if s == 0:
                self._become(middle)
                return
            if s == right_of_low:
                self.low = middle
                return
            self.high = middle

    def _become(self, value: QQ) -> None:
        self.polynomial = (-ZZ(value.numerator), ZZ(value.denominator))
        self.low = self.high = value

    @property
    def is_rational(self) -> bool:
        """Whether the number is known to be rational (a root of degree 3 or more may hide one)."""
        return self.low == self.high

    def refine(self) -> None:
        """Shrink the interval: to about the square of its width for degree 2, else to a half."""
        if self.low == self.high:
            return
        if len(self.polynomial) == 3:
            self._refine_quadratic()
            return
        middle = (self.low + self.high) / 2
        s = sign_at(self.polynomial, middle)
        if s == 0:
            self._become(middle)
        elif s == sign_at(self.polynomial, self.low):
            self.low = middle
        else:
            self.high = middle

    def _refine_quadratic(self) -> None:
        # (-c1 ± sqrt(d)) / 2 c2, the square root to as many bits as double the precision.
        c0, c1, c2 = self.polynomial
        width = self.high - self.low
        bits = 2 * max(8, width.denominator.bit_length() - width.numerator.bit_length()) + 8
        root = isqrt(_discriminant((c0, c1, c2)) << 2 * bits)
        centre = QQ(-c1, 2 * c2)
        unit = QQ(ZZ(1), 2 * c2 << bits)
        # The sign at low tells the branch: c2 > 0, so positive left of the smaller root.
        if sign_at(self.polynomial, self.low) > 0:
            low, high = centre - (root + 1) * unit, centre - root * unit
        else:
            low, high = centre + root * unit, centre + (root + 1) * unit
        self.low, self.high = max(self.low, low), min(self.high, high)

    def refine_to(self, width: QQ) -> None:
        """Refine until ``high - low <= width`` (positive)."""
        while self.high - self.low > width:
            self.refine()

    def compare(self, other: AlgebraicNumber) -> int:
        """-1, 0 or 1 as this number is smaller than, equal to, or larger than ``other``."""
        if self.high < other.low:
            return -1
        if self.low > other.high:
            return 1
        if other.low == other.high:
            return self.compare_rational(other.low)
        if self.low == self.high:
            return -other.compare_rational(self.low)
        self.refine_to(FINE)
        other.refine_to(FINE)
        if self.low == self.high or other.low == other.high:
            return self.compare(other)
        if self._shares_root(other):
            return 0
        while True:
            if self.high <= other.low:  # the ends are no roots, so never equal
                return -1
            if self.low >= other.high:
                return 1
            self.refine()
            other.refine()

    def _shares_root(self, other: AlgebraicNumber) -> bool:
        low, high = max(self.low, other.low), min(self.high, other.high)
        if low >= high:
            return False
        common = self.polynomial
        if common != other.polynomial:
            common = greatest_common_divisor(common, other.polynomial)
        # common divides self.polynomial, which has one simple root in [self.low, self.high];
        # its sign changes in [low, high] (the ends are no roots) iff that root is common.
        return len(common) > 1 and sign_at(common, low) * sign_at(common, high) < 0

    def compare_rational(self, q: QQ) -> int:
        """-1, 0 or 1 as this number is smaller than, equal to, or larger than ``q``."""
        if self.high < q:
            return -1
        if self.low > q:
            return 1
        if self.low == self.high:
            return 0
        s = sign_at(self.polynomial, q)
        if s == 0:
            self._become(q)
            return 0
        if s == sign_at(self.polynomial, self.low):
            self.low = q
            return 1
        self.high = q
        return -1

    def sign_of(self, f: IntPoly) -> int:
        """The sign of f at this number."""
        if self.low == self.high:
            return sign_at(f, self.low)
        if len(f) >= len(self.polynomial):
            f = positive_remainder(f, self.polynomial)
        if len(f) <= 1:
            return sign(f[0]) if f else 0
        if len(f) == 2:
            return sign(f[1]) * self.compare_rational(QQ(-f[0], f[1]))
        s = _sign_on(f, self.low, self.high)
        if s:
            return s
        common = greatest_common_divisor(f, self.polynomial)
        if len(common) > 1 and sign_at(common, self.low) * sign_at(common, self.high) < 0:
            return 0
        while not s:
            self.refine()
            if self.low == self.high:
                return sign_at(f, self.low)
            s = _sign_on(f, self.low, self.high)
        return s

    def sign_after(self, f: IntPoly) -> int:
        """The sign of f just after this number: 0 if and only if f is the zero polynomial.

        It is the sign of the first of f, f', f'', ... that is not 0 here.
        """
        while f:
            s = self.sign_of(f)
            if s:
                return s
            f = derivative(f)
        return 0

    def sign_before(self, f: IntPoly) -> int:
        """The sign of f just before this number: 0 if and only if f is the zero polynomial."""
        factor = 1
        while f:
            s = self.sign_of(f)
            if s:
                return factor * s
            f, factor = derivative(f), -factor
        return 0

    def simplified(self) -> AlgebraicNumber:
        """The same number, a rational one recognised whatever the degree of its polynomial.

        A rational root p/q of an integer polynomial has q dividing the leading
        coefficient c (Gauss), so c * root is an integer: one candidate is left once
        the interval is narrower than 1/c.
        """
        if self.low == self.high or len(self.polynomial) == 3:
            return self
        lead = self.polynomial[-1]
        self.refine_to(QQ(ZZ(1), 2 * lead))
        candidate = QQ(floor(self.high * lead), lead)
        if candidate >= self.low and sign_at(self.polynomial, candidate) == 0:
            return AlgebraicNumber(candidate)
        return self

    def canonical_interval(self) -> tuple[QQ, QQ]:
        """Rational bounds that depend on the number and its polynomial alone.

        Two dyadic neighbours m/2^k, (m+1)/2^k that enclose the number, with the
        first k of 64, 128, 256, ... for which no other root of the polynomial is in
        between; so the same on every machine, by whatever comparisons the number has
        been refined. Of a rational: the number twice.
        """
        if self.low == self.high:
            return self.low, self.high
        bits = 64
        while True:
            grid = power_of_two(-bits)
            self.refine_to(grid / 2)
            m = floor(self.low / grid)
            while self.compare_rational((m + 1) * grid) > 0:
                m += 1
            if self.low == self.high:
                return self.low, self.high
            low, high = m * grid, (m + 1) * grid
            if self._is_alone_in(low, high):
                return low, high
            bits *= 2

    def _is_alone_in(self, low: QQ, high: QQ) -> bool:
        if self.low <= low and high <= self.high:
            return True
        return (
            sign_at(self.polynomial, low) != 0
            and count_roots(sturm_sequence(self.polynomial), low, high) == 1
        )

    def enclosure(self) -> tuple[float, float]:
        """Doubles lo <= x <= hi, neighbours or equal; infinite beyond the largest double."""
        if self.low == self.high:
            return enclosing_floats(self.low)
        while True:
            lo, _ = enclosing_floats(self.low)
            _, hi = enclosing_floats(self.high)
            if hi <= math.nextafter(math.nextafter(lo, math.inf), math.inf):
                return lo, hi
            self.refine()

    def __float__(self) -> float:
        """The nearest double (ties, which only a rational can have, to even)."""
        while True:
            low, high = nearest_float(self.low), nearest_float(self.high)
            if low == high:
                return low
            if high == math.nextafter(low, math.inf) and math.isfinite(low + high):
                # Rounding changes at the middle between two neighbours.
                middle = (QQ(*low.as_integer_ratio()) + QQ(*high.as_integer_ratio())) / 2
                side = self.compare_rational(middle)
                return nearest_float(middle) if side == 0 else high if side > 0 else low
            self.refine()

    def to_sympy(self) -> sympy.Expr:
        """The number as a SymPy expression (a rational, a surd or a ``CRootOf``)."""
        from exactpt.kernel.sympy_door import algebraic_to_sympy

        return algebraic_to_sympy(self)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, AlgebraicNumber):
            return self.compare(other) == 0
        try:
            return self.compare_rational(rational(other)) == 0  # type: ignore[arg-type]
        except InputError:
            return NotImplemented

    def __lt__(self, other: AlgebraicNumber | Rational) -> bool:
        return self._compare_any(other) < 0

    def __le__(self, other: AlgebraicNumber | Rational) -> bool:
        return self._compare_any(other) <= 0

    def __gt__(self, other: AlgebraicNumber | Rational) -> bool:
        return self._compare_any(other) > 0

    def __ge__(self, other: AlgebraicNumber | Rational) -> bool:
        return self._compare_any(other) >= 0

    def _compare_any(self, other: AlgebraicNumber | Rational) -> int:
        if isinstance(other, AlgebraicNumber):
            return self.compare(other)
        return self.compare_rational(rational(other))

    def __repr__(self) -> str:
        if self.low == self.high:
            return f"AlgebraicNumber('{self.low}')"
        coefficients = ", ".join(map(str, self.polynomial))
        return f"<root of ({coefficients}) near {float(self)!r}>"


def rational_between(x: AlgebraicNumber, y: AlgebraicNumber) -> QQ:
    """The dyadic rational of least denominator strictly between x and y, x < y.

    (The least such in size of the exponent; the leftmost if there are several.) It does
    not depend on how far x and y have been refined.
    """
    bits = 0
    while True:
        grid = power_of_two(-bits)
        m = floor(x.low / grid) + 1
        while x.compare_rational(m * grid) >= 0:
            m += 1
        if y.compare_rational(m * grid) > 0:
            return m * grid
        bits += 1


def _discriminant(f: IntPoly) -> ZZ:
    return f[1] * f[1] - 4 * f[0] * f[2]


def _sign_on(f: IntPoly, low: QQ, high: QQ) -> int:
    """The sign of f on all of [low, high] if Horner's rule on intervals shows it, else 0."""
    a = b = QQ(f[-1])
    for c in f[-2::-1]:
        products = (a * low, a * high, b * low, b * high)
        a, b = min(products) + c, max(products) + c
    return 1 if a > 0 else -1 if b < 0 else 0
