"""Real roots by their definition: SymPy, FLINT and `Fraction`, no module of `exactpt`.

A real algebraic number is here an irreducible integer polynomial (FLINT factors) and an
isolating interval (SymPy isolates), refined by bisection over `Fraction`. Two such
numbers are equal if and only if their polynomials are and their places among its roots
are, so no question below needs a numerical tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cmp_to_key
from typing import Any, Final, TypeAlias

import flint
import sympy

__all__ = [
    "RealRoot",
    "compare",
    "compare_with_rational",
    "exact",
    "is_nearest_double",
    "is_root",
    "nearest_double",
    "real_roots",
    "separate",
    "sign_at_root",
    "sign_just_after",
    "value",
]

T: Final = sympy.Symbol("t")

Ratio: TypeAlias = Any
"""A rational number of any library."""

Coefficients: TypeAlias = Sequence[Any]
"""Integers of any type, the constant first."""


def exact(q: Ratio) -> Fraction:
    """Return the `Fraction` of any rational; by way of its text it had 4,300 digits at most."""
    return Fraction(int(q.numerator), int(q.denominator))


def value(f: Coefficients, t: Fraction) -> Fraction:
    """Return f(t)."""
    result = Fraction(0)
    for c in reversed(f):
        result = result * t + Fraction(int(c))
    return result


def _sign(x: Fraction | int) -> int:
    return (x > 0) - (x < 0)


def _sign_at(f: Coefficients, t: Fraction) -> int:
    """Return the sign of f(t), in integers: the sum of c[i] p^i q^(n-i)."""
    p, q, result, power = t.numerator, t.denominator, 0, 1
    for c in reversed(f):
        result = result * p + c * power
        power *= q
    return _sign(result)


@dataclass(eq=False)
class RealRoot:
    """The ``index``-th real root of an irreducible polynomial, inside [low, high]."""

    factor: tuple[int, ...]
    index: int
    low: Fraction
    high: Fraction
    multiplicity: int = 1

    @property
    def is_rational(self) -> bool:
        """Whether its polynomial is linear."""
        return len(self.factor) == 2

    def refine(self) -> None:
        """Halve the interval."""
        if self.is_rational:
            return
        middle = (self.low + self.high) / 2
        if _sign_at(self.factor, middle) == _sign_at(self.factor, self.low):
            self.low = middle
        else:
            self.high = middle

    def refine_to(self, width: Fraction) -> None:
        """Halve the interval until it is not wider."""
        while self.high - self.low > width:
            self.refine()

    def same(self, other: RealRoot) -> bool:
        """Return True if it is the same number."""
        return (self.factor, self.index) == (other.factor, other.index)


def _sympy_poly(f: Coefficients) -> sympy.Poly:
    return sympy.Poly([int(c) for c in reversed(f)], T)


def real_roots(f: Coefficients) -> list[RealRoot]:
    """Return the distinct real roots of f in increasing order, with their multiplicities."""
    return [RealRoot(*root) for root in _real_roots(tuple(int(c) for c in f))]


@cache
def _real_roots(f: tuple[int, ...]) -> list[tuple[tuple[int, ...], int, Fraction, Fraction, int]]:
    found = []
    for factor, multiplicity in flint.fmpz_poly(list(f)).factor()[1]:
        coefficients = tuple(int(c) for c in factor.coeffs())
        if coefficients[-1] < 0:
            coefficients = tuple(-c for c in coefficients)
        if len(coefficients) == 2:
            q = Fraction(-coefficients[0], coefficients[1])
            found.append(RealRoot(coefficients, 0, q, q, multiplicity))
            continue
        for i, ((low, high), _) in enumerate(_sympy_poly(coefficients).intervals()):
            ends = Fraction(int(low.p), int(low.q)), Fraction(int(high.p), int(high.q))
            found.append(RealRoot(coefficients, i, *ends, multiplicity))
    found.sort(key=cmp_to_key(compare))
    return [(r.factor, r.index, r.low, r.high, r.multiplicity) for r in found]


def compare(a: RealRoot, b: RealRoot) -> int:
    """Return -1, 0 or 1 as a is smaller than, equal to, or larger than b."""
    if a.same(b):
        return 0
    while True:
        # Only a rational root is an end of its own interval, so meeting ends separate too.
        if a.high <= b.low:
            return -1
        if b.high <= a.low:
            return 1
        a.refine()
        b.refine()


def separate(a: RealRoot, b: RealRoot) -> None:
    """Refine until a rational fits strictly between the intervals of a < b."""
    while a.high >= b.low:
        a.refine()
        b.refine()


def compare_with_rational(a: RealRoot, q: Fraction) -> int:
    """Return -1, 0 or 1 as a is smaller than, equal to, or larger than q."""
    if a.is_rational:
        return _sign(a.low - q)
    while a.low < q < a.high:
        a.refine()
    return 1 if q <= a.low else -1


def sign_at_root(g: Coefficients, a: RealRoot) -> int:
    """Return the sign of g at a: 0 if the irreducible polynomial of a divides g."""
    if not any(g):
        return 0
    if not divmod(flint.fmpq_poly([int(c) for c in g]), flint.fmpq_poly(list(a.factor)))[1]:
        return 0
    if a.is_rational:
        return _sign(value(g, a.low))
    poly = _sympy_poly(g)
    while poly.count_roots(_rational(a.low), _rational(a.high)):
        a.refine()
    return _sign(value(g, a.high))


def sign_just_after(g: Coefficients, a: RealRoot) -> int:
    """Return the sign of g on (a, a + epsilon): between a and the next root of g."""
    later = [r for r in real_roots(g) if compare(a, r) < 0]
    if later:
        nearest = later[0]
        separate(a, nearest)
        return _sign(value(g, (a.high + nearest.low) / 2))
    return _sign(g[-1])


def _rational(q: Fraction) -> sympy.Rational:
    return sympy.Rational(q.numerator, q.denominator)


def is_root(polynomial: Coefficients, low: Ratio, high: Ratio, a: RealRoot) -> bool:
    """Return True if a is the only root of ``polynomial`` in [low, high]."""
    low, high = exact(low), exact(high)
    return (
        sign_at_root(polynomial, a) == 0
        and compare_with_rational(a, low) >= 0
        and compare_with_rational(a, high) <= 0
        and _sympy_poly(polynomial).count_roots(_rational(low), _rational(high)) == 1
    )


def nearest_double(a: RealRoot) -> float:
    """Return the nearest double: Python rounds a quotient of integers correctly."""
    if a.is_rational:
        return _round(a.low)
    # Irrational, so no tie: both ends round to the same double in the end.
    while _round(a.low) != _round(a.high):
        a.refine()
    return _round(a.low)


def _round(q: Fraction) -> float:
    try:
        return q.numerator / q.denominator
    except OverflowError:
        return math.inf if q > 0 else -math.inf


def is_nearest_double(x: float, q: Fraction) -> bool:
    """Return True if no neighbour of x is nearer to q, and x is even if one is as near."""
    if math.isinf(x):
        limit = Fraction(2) ** 1024 - Fraction(2) ** 970
        return q >= limit if x > 0 else q <= -limit
    distance = abs(Fraction(x) - q)
    for y in (math.nextafter(x, math.inf), math.nextafter(x, -math.inf)):
        beyond = Fraction(2) ** 1024 if y > 0 else -(Fraction(2) ** 1024)
        other = abs((beyond if math.isinf(y) else Fraction(y)) - q)
        if other < distance or (other == distance and _is_odd(x)):
            return False
    return True


def _is_odd(x: float) -> bool:
    unit = Fraction(math.ulp(x))
    return (Fraction(x) / unit).numerator % 2 == 1
