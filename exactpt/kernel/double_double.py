"""Arrays of unevaluated sums of two doubles: about 106 bits.

With unit u = 2^-53, sums and products here have an absolute error of at most 4 u^2 (|x| + |y|)
and 10 u^2 |x y|, a little more after further operations, unless they overflow (then the result
is a NaN or infinite) or underflow (an absolute error of a few 2^-1074).

Source: M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for basic building
blocks of double-word arithmetic*, ACM Transactions on Mathematical Software 44 (2017).
"""

from __future__ import annotations

from typing import Final, TypeAlias

from exactpt.kernel.doubles import Floats

Double2: TypeAlias = tuple[Floats, Floats]
"""A sum of two doubles, of which the first is the nearest to it."""

SPLITTER: Final = 2.0**27 + 1.0


def exact_sum(a: Floats, b: Floats) -> Double2:
    """a + b, exactly."""
    s = a + b
    of_b = s - a
    return s, (a - (s - of_b)) + (b - of_b)


def exact_difference(a: Floats, b: Floats) -> Double2:
    """a - b, exactly."""
    return exact_sum(a, -b)


def add2(x: Double2, y: Double2) -> Double2:
    """x + y.

    The sum s of the leading parts is exact with its error e, |e| <= u |s|. The sum of the three
    small parts, each at most u (|x| + |y|), has three of them and two roundings.
    """
    s, e = exact_sum(x[0], y[0])
    return exact_sum(s, e + (x[1] + y[1]))


def multiply2(x: Double2, y: Double2) -> Double2:
    """x y.

    The product of the leading parts is exact with its error. The product of the small parts, at
    most u^2 |x y|, is left out; the mixed ones, at most u |x y| each, and three sums are rounded.
    """
    p, e = _exact_product(x[0], y[0])
    return exact_sum(p, e + (x[0] * y[1] + x[1] * y[0]))


def _exact_product(a: Floats, b: Floats) -> Double2:
    """a b, exactly: T. J. Dekker, by halves of 26 bits."""
    p = a * b
    (ah, al), (bh, bl) = _halves(a), _halves(b)
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


def _halves(a: Floats) -> Double2:
    c = SPLITTER * a
    high = c - (c - a)
    return high, a - high
