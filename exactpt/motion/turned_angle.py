"""Angles of unit vectors, and polynomials on an interval: bounds in rational arithmetic."""

from __future__ import annotations

import math
from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.arctangents import Bounds, atan_bounds, pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, exponent, floor, show
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
    return _bound_on_unit(f(Polynomial([a, b - a])))


def _bound_on_unit(f: Polynomial) -> QQ:
    c = f.exact_coefficients
    n = len(c) - 1
    largest = QQ(0)
    for j in range(n + 1):
        check_budget()
        parts = (c[i] * QQ(math.comb(j, i), math.comb(n, i)) for i in range(j + 1))
        largest = max(largest, abs(sum(parts, QQ(0))))
    return largest


def bits_for(error: QQ, angle: QQ) -> int:
    """Bits after the binary point for a small part of an error, if an angle is multiplied."""
    bits = max(8, 5 - exponent(error)) + int(floor(abs(angle))).bit_length()
    if bits > _MAX_BITS:
        raise InputError(f"an error of {show(error)} is too small for angles up to {show(angle)}")
    return bits
