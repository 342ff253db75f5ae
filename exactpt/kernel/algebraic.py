"""Real algebraic numbers: the times of events, compared exactly.

Two numbers are compared by refining their isolating intervals until these are disjoint;
if they go on overlapping, a gcd decides equality. The sign of a polynomial at a number is
found in the same way.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 10.4 (real roots by isolating intervals).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import InputError
from exactpt.kernel.approximation import (
    canonical_interval,
    enclosing_doubles,
    multiple_before,
    rational_between,
)
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    greatest_common_divisor,
    positive_remainder,
    sign_at,
    sign_near,
    sign_on,
    square_free,
)
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    finite,
    place,
    power_of_two,
    rational,
    shorten,
    sign,
)
from exactpt.kernel.real_number import RealNumber

if TYPE_CHECKING:
    from exactpt.kernel.sympy_adapter import Expression

__all__ = ["AlgebraicNumber", "linear_root", "multiple_before", "rational_between"]

COARSE: Final = power_of_two(-30)
"""Down to this width a number is refined before a sign at it is asked of polynomials."""
LINEAR: Final = 2
QUADRATIC: Final = 3
"""Numbers of coefficients. At a root of a quadratic polynomial others become linear."""
FINE: Final = power_of_two(-100)
"""Interval width below which two overlapping numbers are tested for equality by a gcd."""


@final
class AlgebraicNumber(RealNumber):
    """A real algebraic number: a root of an integer polynomial, or a rational.

    Comparisons with algebraic numbers and with rationals are exact; they refine the
    isolating interval in place, which changes no result. ``float(x)`` is the nearest
    double. Equal numbers have equal hashes, whatever their polynomials. (A string compares
    as the number it denotes, but has the hash of a string.)
    """

    __slots__ = ()

    def compare(self, other: AlgebraicNumber) -> int:
        """-1, 0 or 1 as this number is smaller than, equal to, or larger than ``other``."""
        differ = False
        while True:
            check_budget()
            if self.exact_high < other.exact_low:
                return -1
            if self.exact_low > other.exact_high:
                return 1
            if other.exact_low == other.exact_high:
                return self.compare_rational(other.exact_low)
            if self.exact_low == self.exact_high:
                return -other.compare_rational(self.exact_low)
            width, width_of_other = (
                self.exact_high - self.exact_low,
                other.exact_high - other.exact_low,
            )
            if not differ and (
                max(width, width_of_other) <= FINE
                or self.exact_polynomial == other.exact_polynomial
            ):
                if self._shares_root(other):
                    return 0
                differ = True
            # Refine the wider one: a surd doubles its digits at each step, others gain a bit.
            (self if width >= width_of_other else other).refine()

    def _shares_root(self, other: AlgebraicNumber) -> bool:
        low, high = max(self.exact_low, other.exact_low), min(self.exact_high, other.exact_high)
        if low >= high:
            return False
        common = self.exact_polynomial
        if common != other.exact_polynomial:
            common = greatest_common_divisor(common, other.exact_polynomial)
        # common divides self.exact_polynomial, which has one simple root in
        # [self.exact_low, self.exact_high]. Its sign changes in [low, high], whose ends are no
        # roots, if and only if that root is common.
        return len(common) > 1 and sign_at(common, low) * sign_at(common, high) < 0

    def sign_of(self, f: IntPoly) -> int:
        """Return the sign of f at this number."""
        if self.exact_low == self.exact_high:
            return sign_at(f, self.exact_low)
        if len(f) > LINEAR and len(self.exact_polynomial) > QUADRATIC:
            # Most signs are not 0, and a few steps show them. A common factor takes longer to find.
            s = self._sign_down_to(f, COARSE)
            if s:
                return s
        if len(f) >= len(self.exact_polynomial):
            f = positive_remainder(f, self.exact_polynomial)
        if len(f) <= 1:
            return sign(f[0]) if f else 0
        if len(f) == LINEAR:
            return sign(f[1]) * self.compare_rational(QQ(-f[0], f[1]))
        common = greatest_common_divisor(f, self.exact_polynomial)
        if (
            len(common) > 1
            and sign_at(common, self.exact_low) * sign_at(common, self.exact_high) < 0
        ):
            return 0
        return self._sign_down_to(f, QQ(0))

    def _sign_down_to(self, f: IntPoly, width: QQ) -> int:
        """Return the sign of f here, or 0 if it is not known when this number is to this width."""
        while True:
            s = sign_on(f, self.exact_low, self.exact_high)
            s = s or sign_near(f, self.exact_low, self.exact_high)
            if s or self.exact_high - self.exact_low <= width:
                return s
            check_budget()
            self.refine()

    def sign_after(self, f: IntPoly) -> int:
        """Return the sign of f just after this number: 0 if and only if f is the zero polynomial.

        It is the sign of the first of f, f', f'', ... that is not 0 here.
        """
        while f:
            check_budget()
            s = self.sign_of(f)
            if s:
                return s
            f = derivative(f)
        return 0

    def sign_before(self, f: IntPoly) -> int:
        """Return the sign of f just before this number; 0 only for the zero polynomial."""
        factor = 1
        while f:
            check_budget()
            s = self.sign_of(f)
            if s:
                return factor * s
            f, factor = derivative(f), -factor
        return 0

    def canonical_interval(self) -> tuple[Fraction, Fraction]:
        """Rational bounds that depend on the number and its polynomial alone.

        The dyadic neighbours m/2^k and (m+1)/2^k that enclose the number, for the first k
        of 64, 128, 256, ... with no other root of the polynomial between them. They are
        the same on every machine, whatever comparisons have refined the number. For a
        rational, even one not yet known to be rational, both bounds are the number.
        """
        return place(self.exact_canonical_interval())

    def exact_canonical_interval(self) -> tuple[QQ, QQ]:
        """Return `canonical_interval` in rationals of GMP."""
        return canonical_interval(self)

    def enclosure(self) -> tuple[float, float]:
        """Doubles lo <= x <= hi: equal if x is a double, else neighbours.

        Infinite beyond the largest double.
        """
        return enclosing_doubles(self)

    def exact_as_root_of(self, f: IntPoly) -> AlgebraicNumber:
        """Return this number, represented as a root of f if it is irrational.

        Args:
            f: a nonzero polynomial that vanishes at this number.
        """
        if self.simplified().is_rational:
            return self
        p = square_free(f)
        slope = derivative(p)
        # An interval on which p is monotone isolates the root.
        while not sign_on(slope, self.exact_low, self.exact_high):
            check_budget()
            self.refine()
        return AlgebraicNumber.exact_root(p, self.exact_low, self.exact_high)

    def minimal_polynomial(self) -> tuple[int, ...]:
        """Return the irreducible integer polynomial with this root, constant term first.

        It is primitive with a positive leading coefficient; for a rational p/q it is (-p, q).
        A polynomial of degree 3 or more is factored by python-flint, or else by SymPy.

        Raises:
            ImportError: if a polynomial must be factored and neither is installed.
        """
        f = self.simplified().exact_polynomial
        if len(f) > 3:
            from exactpt.kernel.factors import irreducible_factors

            # f is square-free: exactly one of its factors changes sign around the root.
            f = next(
                g
                for g in irreducible_factors(f)
                if sign_at(g, self.exact_low) * sign_at(g, self.exact_high) < 0
            )
        return tuple(map(int, f))

    def to_sympy(self) -> Expression:
        """Return the number as a SymPy expression (a rational, a surd or a ``CRootOf``)."""
        from exactpt.kernel.sympy_adapter import algebraic_to_sympy

        return algebraic_to_sympy(self)

    def as_integer_ratio(self) -> tuple[int, int]:
        """Numerator and positive denominator, without a common factor, of a rational number.

        With this method a rational number is accepted wherever exactpt takes a number.

        Raises:
            InputError: if the number is irrational.
        """
        if not self.simplified().is_rational:
            raise InputError(
                f"an irrational number, {shorten(self)}: use .low, .high or float(); "
                "positions of bodies at it are decimals, by at(time, digits=30)"
            )
        return int(self.exact_low.numerator), int(self.exact_low.denominator)

    def __hash__(self) -> int:
        """Return the hash of the rational, or of the double nearest to an irrational number."""
        return hash(self.exact_low) if self.simplified().is_rational else hash(float(self))

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

    def to_json(self) -> dict[str, object]:
        """Return the number as a JSON object, see docs/format.md; a canonical form of it."""
        number = self.simplified()
        low, high = number.exact_canonical_interval()
        return {
            "approx": finite(float(number)),
            "low": str(low),
            "high": str(high),
            "polynomial": [str(c) for c in number.exact_polynomial],
        }


def linear_root(f: IntPoly) -> AlgebraicNumber | None:
    """Return the root of a polynomial of degree 1; None if it has another degree."""
    return AlgebraicNumber(QQ(-f[0], f[1])) if len(f) == 2 else None
