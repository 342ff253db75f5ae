"""The exact times at which a vertex is on an edge, both in straight motion.

Numbers are integers, times a power of two that is common to all of them, so nothing here needs
rationals: a time is a fraction of two integers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, TypeAlias

__all__ = [
    "ALWAYS", "Fraction", "as_integers", "between", "common", "compared", "distance", "fraction",
    "touching",
]  # fmt: skip

Fraction: TypeAlias = tuple[int, int]
"""A numerator, and a denominator that is positive."""


def as_integers(doubles: Sequence[float]) -> tuple[list[int], int]:
    """Return doubles as integers times 2^e, and e."""
    parts = [math.frexp(x) for x in doubles]
    least = min((e for m, e in parts if m), default=0) - 53
    return [int(m * 2.0**53) << (e - 53 - least) if m else 0 for m, e in parts], least


def compared(f: Fraction, t: float) -> int:
    """Return the sign of a fraction less a double, which may be infinite."""
    if math.isinf(t):
        return -1 if t > 0 else 1
    n, d = t.as_integer_ratio()
    left, right = f[0] * d, n * f[1]
    return (left > right) - (left < right)


def fraction(n: int, d: int) -> Fraction:
    """Return n / d."""
    return (n, d) if d > 0 else (-n, -d)


ALWAYS: Final = ((-1, 0), (1, 0))
"""The span of two features that touch all the time: the fractions compare as infinities."""


def touching(numbers: Sequence[int]) -> tuple[Fraction, Fraction] | None:
    """Return the first and the last time of a vertex on an edge, by the numbers of a row."""
    px, py, qx, qy, rx, ry, ax, ay, avx, avy, bx, by, bvx, bvy = numbers
    zx, zy, wx, wy = px - qx + ax - bx, py - qy + ay - by, avx - bvx, avy - bvy
    ux, uy = rx - qx, ry - qy
    if ux == uy == 0:
        if zx * wy != zy * wx:
            return None
        if wx == wy == 0:
            return ALWAYS if zx == zy == 0 else None
        time = fraction(-zx, wx) if wx else fraction(-zy, wy)
        return time, time
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    z_along, w_along, squared = zx * ux + zy * uy, wx * ux + wy * uy, ux * ux + uy * uy
    if c1:
        n, d = time = fraction(-c0, c1)
        return (time, time) if 0 <= z_along * d + w_along * n <= squared * d else None
    if c0:
        return None
    if not w_along:
        return ALWAYS if 0 <= z_along <= squared else None
    at_begin, at_end = fraction(-z_along, w_along), fraction(squared - z_along, w_along)
    return (at_begin, at_end) if w_along > 0 else (at_end, at_begin)


def distance(f: Fraction, t: float) -> float:
    """Return the distance of a fraction and a finite double, rounded."""
    n, d = t.as_integer_ratio()
    return abs(f[0] * d - n * f[1]) / (f[1] * d)


def between(least: int, most: int, c: int, w: int) -> tuple[Fraction, Fraction] | None:
    """Return the first and the last time at which least <= c + w t <= most."""
    if not w:
        return ALWAYS if least <= c <= most else None
    at_least, at_most = fraction(least - c, w), fraction(most - c, w)
    return (at_least, at_most) if w > 0 else (at_most, at_least)


def common(
    f: tuple[Fraction, Fraction] | None, g: tuple[Fraction, Fraction] | None
) -> tuple[Fraction, Fraction] | None:
    """Return the part of two spans of time that is in both."""
    if f is None or g is None:
        return None
    first = f[0] if is_less(g[0], f[0]) else g[0]
    last = f[1] if is_less(f[1], g[1]) else g[1]
    return None if is_less(last, first) else (first, last)


def is_less(f: Fraction, g: Fraction) -> bool:
    """Return True if f < g; the ends of `ALWAYS` are less and more than all other times."""
    if f[1] == 0 or g[1] == 0:
        return f != g and (f == ALWAYS[0] or g == ALWAYS[1])
    return f[0] * g[1] < g[0] * f[1]
