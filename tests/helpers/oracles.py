"""The other way to know: SymPy, FLINT and `Fraction`, never the code under test.

A real algebraic number is here an irreducible integer polynomial (FLINT factors) and an
isolating interval (SymPy isolates), refined by bisection over `Fraction`. Two such
numbers are equal if and only if their polynomials are and their places among its roots
are, so no question below needs a numerical tolerance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cmp_to_key
from typing import Any

import flint
import sympy

__all__ = [
    "RealRoot",
    "body_at",
    "compare",
    "compare_with_rational",
    "exact",
    "is_nearest_double",
    "is_root",
    "motion_at",
    "nearest_double",
    "real_roots",
    "separate",
    "sign_at_root",
    "sign_just_after",
    "value",
]

T = sympy.Symbol("t")


def exact(q) -> Fraction:
    """The `Fraction` of any rational (by way of its text it would be limited to 4,300 digits)."""
    return Fraction(int(q.numerator), int(q.denominator))


def value(f, t):
    """f(t), coefficients constant term first."""
    result = Fraction(0)
    for c in reversed(f):
        result = result * t + Fraction(int(c))
    return result


def _sign(x):
    return (x > 0) - (x < 0)


def _sign_at(f, t):
    """The sign of f(t), in integers: the sum of c[i] p^i q^(n-i)."""
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
    def is_rational(self):
        return len(self.factor) == 2

    def refine(self):
        if self.is_rational:
            return
        middle = (self.low + self.high) / 2
        if _sign_at(self.factor, middle) == _sign_at(self.factor, self.low):
            self.low = middle
        else:
            self.high = middle

    def refine_to(self, width):
        while self.high - self.low > width:
            self.refine()

    def same(self, other):
        return (self.factor, self.index) == (other.factor, other.index)


def _sympy_poly(f):
    return sympy.Poly([int(c) for c in reversed(f)], T)


def real_roots(f) -> list[RealRoot]:
    """The distinct real roots of f in increasing order, with their multiplicities."""
    return [RealRoot(*root) for root in _real_roots(tuple(int(c) for c in f))]


@cache
def _real_roots(f):
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
    """-1, 0 or 1 as a is smaller than, equal to, or larger than b."""
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
    """-1, 0 or 1 as a is smaller than, equal to, or larger than q."""
    if a.is_rational:
        return _sign(a.low - q)
    while a.low < q < a.high:
        a.refine()
    return 1 if q <= a.low else -1


def sign_at_root(g, a: RealRoot) -> int:
    """The sign of g at a: 0 if the irreducible polynomial of a divides g."""
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


def sign_just_after(g, a: RealRoot) -> int:
    """The sign of g on (a, a + epsilon): between a and the next root of g."""
    later = [r for r in real_roots(g) if compare(a, r) < 0]
    if later:
        nearest = later[0]
        separate(a, nearest)
        return _sign(value(g, (a.high + nearest.low) / 2))
    return _sign(g[-1])


def _rational(q):
    return sympy.Rational(q.numerator, q.denominator)


def is_root(polynomial, low, high, a: RealRoot) -> bool:
    """Whether a is the only root of ``polynomial`` in [low, high]."""
    low, high = exact(low), exact(high)
    return (
        sign_at_root(polynomial, a) == 0
        and compare_with_rational(a, low) >= 0
        and compare_with_rational(a, high) <= 0
        and _sympy_poly(polynomial).count_roots(_rational(low), _rational(high)) == 1
    )


def nearest_double(a: RealRoot) -> float:
    """The nearest double: Python rounds a quotient of integers correctly."""
    if a.is_rational:
        return _round(a.low)
    # Irrational, so no tie: both ends round to the same double in the end.
    while _round(a.low) != _round(a.high):
        a.refine()
    return _round(a.low)


def _round(q):
    try:
        return q.numerator / q.denominator
    except OverflowError:
        return math.inf if q > 0 else -math.inf


def is_nearest_double(x: float, q: Fraction) -> bool:
    """Whether no neighbour of x is nearer to q, and x is even if one is as near."""
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


def _is_odd(x):
    unit = Fraction(math.ulp(x))
    return (Fraction(x) / unit).numerator % 2 == 1


# Scenes: the contract's formulas, read straight from the JSON data.

Json = dict[str, Any]


def motion_at(motion: Json | None, x: Fraction, y: Fraction, t: Fraction):
    """Where a motion of the contract carries the point (x, y) at time t."""
    if motion is None:
        return x, y
    if "pieces" in motion:
        for piece in motion["pieces"]:
            if "until" not in piece or t <= Fraction(str(piece["until"])):
                return motion_at(piece["motion"], x, y, t)
    if "rigid" in motion:
        rigid = motion["rigid"]
        px, py = (Fraction(str(c)) for c in rigid.get("pivot", ["0", "0"]))
        h = _at(rigid["half_turn"], t)
        cosine, sine = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
        c, s = (Fraction(str(part)) for part in rigid.get("orientation", ["1", "0"]))
        dx, dy = c * (x - px) - s * (y - py), s * (x - px) + c * (y - py)
        return (
            px + cosine * dx - sine * dy + _at(rigid.get("x", []), t),
            py + sine * dx + cosine * dy + _at(rigid.get("y", []), t),
        )
    if "affine" in motion:
        affine = motion["affine"]
        (a, b), (c, d) = affine["matrix"]
        return (
            _at(a, t) * x + _at(b, t) * y + _at(affine.get("x", []), t),
            _at(c, t) * x + _at(d, t) * y + _at(affine.get("y", []), t),
        )
    return x + _at(motion.get("x", []), t), y + _at(motion.get("y", []), t)


def _at(coefficients, t):
    return sum((Fraction(str(c)) * t**i for i, c in enumerate(coefficients)), Fraction(0))


def body_at(body: Json, t: Fraction) -> list[tuple[Fraction, Fraction]]:
    """The vertices of a body of the contract at time t."""
    return [motion_at(body.get("motion"), x, y, t) for x, y in _shape_at(body, t)]


def _shape_at(body, t):
    if "keyframes" in body:
        frames = [
            (
                Fraction(str(f["t"])),
                [(Fraction(str(x)), Fraction(str(y))) for x, y in f["vertices"]],
            )
            for f in body["keyframes"]
        ]
        before = [f for f in frames if f[0] <= t]
        after = [f for f in frames if f[0] > t]
        if not before:
            return after[0][1]
        if not after:
            return before[-1][1]
        (t0, p), (t1, q) = before[-1], after[0]
        s = (t - t0) / (t1 - t0)
        return [
            ((1 - s) * a + s * c, (1 - s) * b + s * d) for (a, b), (c, d) in zip(p, q, strict=True)
        ]
    return [
        (_at(v.get("x", []), t), _at(v.get("y", []), t))
        if isinstance(v, dict)
        else (Fraction(str(v[0])), Fraction(str(v[1])))
        for v in body["vertices"]
    ]
