"""Sums of square roots of rational numbers: their signs, exactly, and their nearest doubles.

Terms whose radicands have a rational ratio of roots are added up: sqrt(m) is a rational multiple
of sqrt(n) if and only if m n is a square. The roots that remain, of integers no two of which have
a square as their product, are linearly independent over the rationals (A. S. Besicovitch, *On
the linear independence of fractional powers of integers*, J. London Math. Soc. 15, 1940). So a sum
is zero if and only if no term remains, and the sign of any other is found by enclosing it in
intervals, more and more narrow, until one excludes zero.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, ZZ, is_square, isqrt, nearest_float, power_of_two

Terms: TypeAlias = "dict[ZZ, QQ]"
"""The sum of c sqrt(n), for the coefficient c of each integer n."""

_FIRST_BITS = 64


def root_sum_sign(coefficients: Mapping[QQ, int]) -> int:
    """Return the sign of a sum of c sqrt(r), for the coefficient c of each rational r >= 0."""
    terms = _independent(coefficients.items())
    if not terms:
        return 0
    bits = _FIRST_BITS
    while True:
        low, high = _enclosure(terms, bits)
        if low > 0:
            return 1
        if high < 0:
            return -1
        bits *= 2
        check_budget()


def nearest_root_sum(radicands: Iterable[QQ]) -> float:
    """Return the double nearest to the sum of the square roots of rationals >= 0.

    If a root of a non-square remains, the sum is irrational: neither a double nor the midpoint of
    two, so that the ends of a narrow enough enclosure are rounded to the same double.
    """
    terms = _independent((r, 1) for r in radicands)
    if set(terms) <= {1}:
        return nearest_float(sum(terms.values(), QQ(0)))
    bits = _FIRST_BITS
    while True:
        low, high = map(nearest_float, _enclosure(terms, bits))
        if low == high:
            return low
        bits *= 2
        check_budget()


def _independent(terms: Iterable[tuple[QQ, int]]) -> Terms:
    """Return the sum with roots that are linearly independent, and no coefficient zero."""
    result: Terms = {}
    for radicand, count in terms:
        # sqrt(p / q) = sqrt(p q) / q
        n, c = ZZ(radicand.numerator * radicand.denominator), QQ(count, radicand.denominator)
        if n == 0 or count == 0:
            continue
        if is_square(n):
            n, c = ZZ(1), c * isqrt(n)
        elif n not in result:
            m = next((m for m in result if is_square(m * n)), n)
            if m != n:  # sqrt(n) = sqrt(m n) / m * sqrt(m)
                n, c = m, c * isqrt(m * n) / m
        result[n] = result.get(n, QQ(0)) + c
    return {n: c for n, c in result.items() if c}


def _enclosure(terms: Terms, bits: int) -> tuple[QQ, QQ]:
    """Return bounds of a sum, from each root to within 2^-bits."""
    unit = power_of_two(-bits)
    low = high = QQ(0)
    for n, c in terms.items():
        root = isqrt(n << (2 * bits))
        ends = c * root, c * (root + 1)
        low, high = low + min(ends), high + max(ends)
    return low * unit, high * unit
