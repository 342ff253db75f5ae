"""Polynomials over the integers as plain tuples: the functions whose signs certificates are.

``f[i]`` is the coefficient of t**i; the last entry is never 0, and the zero
polynomial is ``()``. A certificate needs only a sign, so positive factors are
dropped freely and integer coefficients suffice.

Sources: D. E. Knuth, *TAOCP* vol. 2, section 4.6.1 (pseudo-division, gcd of
primitive parts); J. von zur Gathen, J. Gerhard, *Modern Computer Algebra*,
section 14.6 (square-free part); B. Char, K. Geddes, G. Gonnet, *GCDHEU: heuristic
polynomial GCD algorithm based on integer GCD computation*, J. Symbolic Computation 7
(1989) (common factors detected from values); Gathen and Gerhard, section 8.4 (Kronecker
substitution).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from typing import Final, TypeAlias

from exactpt.kernel.budget import LONG, check_budget
from exactpt.kernel.numbers import QQ, ZZ, digits, gcd, sign

IntPoly: TypeAlias = "tuple[ZZ, ...]"

SLACK: Final = 32
"""Extra bits of the evaluation point in the test for common factors."""
TESTED: Final = 3
"""The least number of coefficients with the test; a linear polynomial is divided as fast."""


def trimmed(coefficients: Iterable[ZZ]) -> IntPoly:
    """Return the polynomial with these coefficients, leading zeros dropped."""
    f = list(coefficients)
    while f and f[-1] == 0:
        f.pop()
    return tuple(f)


def add(f: IntPoly, g: IntPoly) -> IntPoly:
    """f + g."""
    if len(f) < len(g):
        f, g = g, f
    if len(f) > len(g):
        return (*[a + b for a, b in zip(f, g, strict=False)], *f[len(g) :])
    return trimmed([a + b for a, b in zip(f, g, strict=True)])


def negate(f: IntPoly) -> IntPoly:
    """-f."""
    return tuple([-c for c in f])


def subtract(f: IntPoly, g: IntPoly) -> IntPoly:
    """f - g."""
    if len(f) == len(g):
        return trimmed([a - b for a, b in zip(f, g, strict=True)])
    if len(f) > len(g):
        return (*[a - b for a, b in zip(f, g, strict=False)], *f[len(g) :])
    return (*[a - b for a, b in zip(f, g, strict=False)], *[-b for b in g[len(f) :]])


def scale(f: IntPoly, factor: ZZ) -> IntPoly:
    """factor * f."""
    return tuple([factor * c for c in f]) if factor else ()


def multiply(f: IntPoly, g: IntPoly) -> IntPoly:
    """f * g."""
    if len(f) > len(g):
        f, g = g, f
    if not f:
        return ()
    if len(f) == 1:
        a = f[0]
        return tuple([a * b for b in g])
    product = [ZZ(0)] * (len(f) + len(g) - 1)
    is_long = len(g) > LONG
    for i, a in enumerate(f):
        if is_long:
            check_budget()
        if a:
            for j, b in enumerate(g):
                product[i + j] += a * b
    return tuple(product)


def derivative(f: IntPoly) -> IntPoly:
    """df/dt."""
    return tuple([i * c for i, c in enumerate(f) if i])


def evaluate(f: IntPoly, t: QQ) -> QQ:
    """f(t)."""
    value = QQ(0)
    for c in reversed(f):
        value = value * t + c
    return value


def sign_at(f: IntPoly, t: QQ) -> int:
    """Return the sign of f(t): Horner's rule on q**deg(f) * f(p/q), integers only."""
    if not f:
        return 0
    p, q = t.numerator, t.denominator
    value = f[-1]
    if q == 1:
        for c in f[-2::-1]:
            value = value * p + c
        return sign(value)
    power = q
    for c in f[-2::-1]:
        value = value * p + c * power
        power *= q
    return sign(value)


def sign_on(f: IntPoly, low: QQ, high: QQ) -> int:
    """Return the constant sign of f on [low, high] if interval Horner proves one, else 0."""
    a, b = range_on(f, low, high)
    return 1 if a > 0 else -1 if b < 0 else 0


def sign_near(f: IntPoly, low: QQ, high: QQ) -> int:
    """Return the constant sign of f on [low, high] if its Taylor polynomial proves one, else 0.

    At the middle, in units of half the width, f differs from its constant term by at most the sum
    of the sizes of the others. Far from 0, where terms of f are large and cancel, that is much
    less than what `sign_on` loses; it takes longer.
    """
    constant, *others = on_unit_interval(f, (low + high) / 2, high)
    change = sum(map(abs, others), ZZ(0))
    return sign(constant) if abs(constant) > change else 0


def on_unit_interval(f: IntPoly, low: QQ, high: QQ) -> list[ZZ]:
    """Return a positive multiple of f(low + (high - low) s)."""
    width = high - low
    scale = low.denominator * width.denominator
    g = stretch(f[::-1], ZZ(scale))[::-1]  # scale^deg(f) f(t / scale)
    by = ZZ(low.numerator * width.denominator)
    if by:
        for i in range(len(g) - 1):
            if len(g) > LONG:
                check_budget()
            for j in range(len(g) - 2, i - 1, -1):
                g[j] += by * g[j + 1]
    return stretch(g, ZZ(width.numerator * low.denominator))


def stretch(g: Sequence[ZZ], factor: ZZ) -> list[ZZ]:
    """Return the coefficients of g(factor s)."""
    power = ZZ(1)
    result = []
    for c in g:
        result.append(c * power)
        power *= factor
    return result


def range_on(f: IntPoly, low: QQ, high: QQ) -> tuple[QQ, QQ]:
    """Return bounds of f on [low, high], by Horner's rule in interval arithmetic."""
    if not f:
        return QQ(0), QQ(0)
    a = b = QQ(f[-1])
    if low >= 0:
        for c in f[-2::-1]:
            a, b = a * (low if a >= 0 else high) + c, b * (high if b >= 0 else low) + c
        return a, b
    for c in f[-2::-1]:
        products = (a * low, a * high, b * low, b * high)
        a, b = min(products) + c, max(products) + c
    return a, b


def primitive(f: IntPoly) -> IntPoly:
    """f divided by the positive gcd of its coefficients."""
    content = gcd(*f) if f else ZZ(1)
    return tuple([c // content for c in f]) if content > 1 else f


def positive_remainder(f: IntPoly, g: IntPoly) -> IntPoly:
    """Return the remainder of a *positive* multiple of f on division by g: primitive.

    Ordinary pseudo-division multiplies f by a power of the leading coefficient of g, which
    may be negative. Here |leading coefficient| is used, so the remainder has the sign of
    the rational one, as Sturm's sequence requires.
    """
    lead, size = g[-1], len(g)
    positive, lead = (lead, lead) if lead > 0 else (-lead, lead)
    remainder = list(f)
    while len(remainder) >= size:
        if size > LONG:
            check_budget()
        top = remainder.pop()
        if top == 0:
            continue
        shift = len(remainder) + 1 - size
        factor = top if lead > 0 else -top
        remainder = [positive * c for c in remainder]
        for i in range(size - 1):
            remainder[shift + i] -= factor * g[i]
    return primitive(trimmed(remainder))


def quotient(f: IntPoly, g: IntPoly) -> IntPoly:
    """f / g up to a positive factor, where g divides f over the rationals: primitive."""
    lead, size = g[-1], len(g)
    remainder, result = list(f), [ZZ(0)] * (len(f) - size + 1)
    positive = abs(lead)
    for shift in range(len(f) - size, -1, -1):
        if size > LONG:
            check_budget()
        # Multiply everything by |lead|, so that the next coefficient is an integer.
        remainder = [positive * c for c in remainder]
        result = [positive * c for c in result]
        factor = remainder[shift + size - 1] // lead
        result[shift] = factor
        for i in range(size):
            remainder[shift + i] -= factor * g[i]
    return primitive(trimmed(result))


def greatest_common_divisor(f: IntPoly, g: IntPoly) -> IntPoly:
    """Return the primitive gcd over the rationals, with positive leading coefficient."""
    f, g = primitive(f), primitive(g)
    if min(len(f), len(g)) >= TESTED and _are_coprime_at_a_point(f, g):
        return (ZZ(1),)
    while g:
        f, g = g, positive_remainder(f, g) if len(f) >= len(g) else f
    return negate(f) if f and f[-1] < 0 else f


def _are_coprime_at_a_point(f: IntPoly, g: IntPoly) -> bool:
    """Return True if the values of primitive f and g at an integer show no common factor.

    A common factor h, primitive and not constant, divides both over the integers (Gauss), so
    h(N) divides both values at N. Its roots are roots of both, so at most 2^bits in size where
    all coefficients of one of them are below that (Cauchy). So |h(N)| >= N - 2^bits > N / 2 for
    N = 2^width below. A smaller gcd of the values proves that no h exists; without one, the gcd
    is larger only by chance.
    """
    width = min(coefficient_bits(f), coefficient_bits(g)) + SLACK
    return gcd(pack(f, width), pack(g, width)).bit_length() < width


def square_free(f: IntPoly) -> IntPoly:
    """Return the square-free part of f: primitive, with the sign of f's leading coefficient."""
    f = primitive(f)
    if len(f) <= 2:
        return f
    if len(f) == 3:
        if f[1] * f[1] != 4 * f[0] * f[2]:
            return f
        # c2 (t + c1 / 2 c2)^2: half the derivative is c2 (t + c1 / 2 c2).
        return primitive((f[1], 2 * f[2]))
    common = greatest_common_divisor(f, derivative(f))
    return f if len(common) == 1 else quotient(f, common)


# Packed polynomials: single integers, their values at 2^width. A sum of products of polynomials
# becomes a sum of products of integers, each a single call of GMP, and the coefficients of the
# result are its signed digits in base 2^width. Determinants of short polynomials are built several
# times faster than coefficient by coefficient.


def coefficient_bits(*polynomials: IntPoly) -> int:
    """Return the bit length of the largest coefficient."""
    return max([c.bit_length() for f in polynomials for c in f], default=0)


def width_for(bits: int, length: int, factors: int) -> int:
    """Return a width that fits every coefficient of a sum of at most 8 products.

    Each coefficient of a product of polynomials of ``bits`` bits in total is a sum of at
    most length^(factors - 1) products of coefficients: one coefficient of each factor but
    the last can be chosen freely. So the sum is below 2^(width - 1). The width is a power
    of two, so that one width serves most of a scene.

    Args:
        bits: the sum of the coefficient bit lengths of the factors.
        length: the length of the result, and so at least that of each factor.
        factors: the number of factors in each product.
    """
    digits_needed = bits + (factors - 1) * length.bit_length() + 3 + 1
    return 1 << (digits_needed - 1).bit_length()


def pack(f: IntPoly, width: int) -> ZZ:
    """f(2^width)."""
    value = ZZ(0)
    for c in reversed(f):
        value = (value << width) + c
    return value


def unpack(value: ZZ, width: int, length: int) -> IntPoly:
    """Return the polynomial with this value at 2^width.

    Args:
        value: the value of a polynomial with coefficients below 2^(width - 1) in size.
        width: see `width_for`.
        length: the maximum number of its coefficients.
    """
    half, halves = _halves(width, length)
    f = [digit - half for digit in digits(value + halves, width)]
    while f and not f[-1]:
        f.pop()
    return tuple(f)


@cache
def _halves(width: int, length: int) -> tuple[ZZ, ZZ]:
    """Half the base, and the number with all digits equal to it: added, no digit is negative."""
    half = ZZ(1) << (width - 1)
    return half, pack((half,) * length, width)
