"""The exact times at which a vertex is on an edge, both in straight motion.

Numbers are integers, times a power of two that is common to all of them, so nothing here needs
rationals: a time is a fraction of two integers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, TypeAlias

__all__ = [
    "ALWAYS",
    "Fraction",
    "Span",
    "as_integers",
    "between",
    "common",
    "compared",
    "distance",
    "fraction",
    "touching",
]

Fraction: TypeAlias = tuple[int, int]
"""A numerator, and a denominator that is positive."""
Span: TypeAlias = tuple[Fraction, Fraction]
"""The first and the last of some times."""


def as_integers(doubles: Sequence[float]) -> tuple[list[int], int]:
    """Return doubles as integers times 2^e, and e."""
    parts = [math.frexp(x) for x in doubles]
    least = min((e for m, e in parts if m), default=0) - 53
    return [int(m * 2.0**53) << (e - 53 - least) if m else 0 for m, e in parts], least


def compared(f: Fraction, t: float) -> int:
    """Return the sign of a fraction less a double, which may be infinite."""
    if math.isinf(t):
        return -1 if t > 0 else 1
    f_n, f_d = f
    t_n, t_d = t.as_integer_ratio()
    left = f_n * t_d
    right = t_n * f_d
    return (left > right) - (left < right)


def fraction(n: int, d: int) -> Fraction:
    """Return n / d."""
    return (n, d) if d > 0 else (-n, -d)


ALWAYS: Final[Span] = ((-1, 0), (1, 0))
"""The span of two features that touch all the time: the fractions compare as infinities."""


def touching(numbers: Sequence[int]) -> Span | None:
    """Return the first and the last time of a vertex on an edge, by the numbers of a row.

    The vertex is at z + w t from one end of the edge, u leads from there to the other end.
    """
    px, py, qx, qy, rx, ry, ax, ay, avx, avy, bx, by, bvx, bvy = numbers
    zx = px - qx + ax - bx
    zy = py - qy + ay - by
    wx = avx - bvx
    wy = avy - bvy
    ux = rx - qx
    uy = ry - qy
    if ux == uy == 0:
        return _at_origin(zx, zy, wx, wy)
    # The vertex is on the line of the edge if u x z + (u x w) t = 0.
    z_beside = ux * zy - uy * zx
    w_beside = ux * wy - uy * wx
    # Its foot is on the edge from 0 to |u|^2 of u . z + (u . w) t.
    z_along = zx * ux + zy * uy
    w_along = wx * ux + wy * uy
    squared = ux * ux + uy * uy
    if w_beside:
        time = fraction(-z_beside, w_beside)
        n, d = time
        is_on_edge = 0 <= z_along * d + w_along * n <= squared * d
        return (time, time) if is_on_edge else None
    if z_beside:
        return None
    return between(0, squared, z_along, w_along)  # along the line all the time


def _at_origin(zx: int, zy: int, wx: int, wy: int) -> Span | None:
    """Return the first and the last time at which z + w t is 0."""
    if zx * wy != zy * wx:
        return None
    if wx == wy == 0:
        return ALWAYS if zx == zy == 0 else None
    time = fraction(-zx, wx) if wx else fraction(-zy, wy)
    return time, time


def distance(f: Fraction, t: float) -> float:
    """Return the distance of a fraction and a finite double, rounded."""
    f_n, f_d = f
    t_n, t_d = t.as_integer_ratio()
    return abs(f_n * t_d - t_n * f_d) / (f_d * t_d)


def between(least: int, most: int, c: int, w: int) -> Span | None:
    """Return the first and the last time at which least <= c + w t <= most."""
    if not w:
        return ALWAYS if least <= c <= most else None
    at_least = fraction(least - c, w)
    at_most = fraction(most - c, w)
    return (at_least, at_most) if w > 0 else (at_most, at_least)


def common(f: Span | None, g: Span | None) -> Span | None:
    """Return the part of two spans of time that is in both."""
    if f is None or g is None:
        return None
    f_first, f_last = f
    g_first, g_last = g
    first = f_first if is_less(g_first, f_first) else g_first
    last = f_last if is_less(f_last, g_last) else g_last
    return None if is_less(last, first) else (first, last)


def is_less(f: Fraction, g: Fraction) -> bool:
    """Return True if f < g; the ends of `ALWAYS` are less and more than all other times."""
    f_n, f_d = f
    g_n, g_d = g
    if f_d == 0 or g_d == 0:
        before_all, after_all = ALWAYS
        return f != g and (f == before_all or g == after_all)
    return f_n * g_d < g_n * f_d
