"""Angles of unit vectors, and polynomials on an interval: bounds in rational arithmetic."""

from __future__ import annotations

import math
from itertools import pairwise
from math import lcm
from typing import Final, NamedTuple, Self

from exactpt.errors import InputError
from exactpt.kernel.arctangents import Bounds, atan_bounds, pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, ZZ, exponent, floor, show
from exactpt.kernel.polynomial import Polynomial

_MAX_BITS: Final = 512


def angle_of(vector: tuple[QQ, QQ], bits: int) -> Bounds:
    """Return bounds of an angle of a unit vector."""
    (c, s), quarters = vector, 0
    while c <= 0 or abs(s) > c:
        c, s, quarters = s, -c, quarters + 1
    low, high = atan_bounds(s / (1 + c), bits)
    p, q = pi_bounds(bits)
    return 2 * low + quarters * p / 2, 2 * high + quarters * q / 2


def bound_on(f: Polynomial, a: QQ, b: QQ) -> QQ:
    """Return a bound on |f| in [a, b]: the largest of its Bernstein coefficients."""
    return _Bernstein.on(f, a, b).bound()


def bounds_on_parts(f: Polynomial, halvings: int) -> list[QQ]:
    """Return bounds on |f| in the equal parts of [0, 1] after some halvings, as `bound_on` does."""
    parts = [_Bernstein.on(f, QQ(0), QQ(1))]
    for _ in range(halvings):
        check_budget()
        parts = [half for part in parts for half in part.halves()]
    return [part.bound() for part in parts]


class _Bernstein(NamedTuple):
    """The Bernstein coefficients of a polynomial on an interval: integers over a common one.

    Sums of rationals would take the greatest common divisor of each.
    """

    numerators: list[ZZ]
    denominator: ZZ

    @classmethod
    def on(cls, f: Polynomial, a: QQ, b: QQ) -> Self:
        """Return those of f on [a, b].

        With t = a + (b - a) s and the sum of c_i s^i, coefficient j is the sum of
        c_i binomial(j, i) / binomial(n, i) over i <= j.
        """
        is_unit_interval = a == 0 and b == 1
        local = f if is_unit_interval else f(Polynomial([a, b - a]))
        rationals = local.exact_coefficients or (QQ(0),)
        n = len(rationals) - 1
        choices = [ZZ(math.comb(n, i)) for i in range(n + 1)]
        common = lcm(*(c.denominator for c in rationals)) * lcm(*choices)
        scaled = [
            c.numerator * (common // (c.denominator * choice))
            for c, choice in zip(rationals, choices, strict=True)
        ]
        numerators = [
            sum((math.comb(j, i) * scaled[i] for i in range(j + 1)), ZZ(0)) for j in range(n + 1)
        ]
        return cls(numerators, common)

    def bound(self) -> QQ:
        """Return the largest absolute value of a coefficient."""
        return QQ(max(map(abs, self.numerators)), self.denominator)

    def halves(self) -> tuple[Self, Self]:
        """Return the coefficients on the two halves of the interval.

        By de Casteljau's algorithm, with sums in place of means: after k steps they are 2^k times
        the means, and a common factor 2^n of all coefficients makes up for it.
        """
        n = len(self.numerators) - 1
        row = self.numerators
        left, right = [], []
        for k in range(n + 1):
            left.append(row[0] << (n - k))
            right.append(row[-1] << (n - k))
            row = [p + q for p, q in pairwise(row)]
        denominator = self.denominator << n
        made = type(self)
        return made(left, denominator), made(right[::-1], denominator)


def bits_for(error: QQ, angle: QQ) -> int:
    """Bits after the binary point for a small part of an error, if an angle is multiplied."""
    bits = max(8, 5 - exponent(error)) + int(floor(abs(angle))).bit_length()
    if bits > _MAX_BITS:
        raise InputError(f"an error of {show(error)} is too small for angles up to {show(angle)}")
    return bits
