"""Common to all float filters: the type of their results and the model of rounding.

The standard model: the relative error of a sum, difference, product, quotient or square
root of doubles is at most the unit roundoff U, unless it overflows or underflows.

- Overflow gives an infinity or a NaN, never a wrong finite number. Bounds are written so
  that one of them ends as "unsure": every acceptance is a positive test, false for NaN.
- Underflow adds an absolute error of at most 2^-1075 to a product or quotient (sums and
  differences have none). The guards of each filter bound the growth of that error, so
  that it ends below `TINY`, which every bound contains.

So no filter assumes anything about its arguments: out of range, the result is "unsure".

The model is that of IEEE 754 with its default attributes: rounding to nearest and gradual
underflow. A thread can change both (``fesetround``, the bits FTZ and DAZ of MXCSR), and then
no bound here holds:

- In a directed mode the unit roundoff is 2 U, an overflow may give the largest double, and the
  error of a sum need not be a double (`exactpt.filters.error_free`, ``double_double``); a sum
  that is widened by its bound, or by ``nextafter`` from the nearest double, may miss the value.
- If subnormal numbers are flushed to zero, sums underflow too, so a difference of different
  doubles may be 0; and products and quotients lose up to 2^-1022, which exceeds the errors
  claimed for scaled data near 2^-1074.

Wider bounds would cover some filters, not those that rely on exact differences, nearest doubles
or neighbours. So `check_rounding` refuses such a thread instead; the results of a float filter
are for those who have called it since they last ran code of others.

Source: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
sections 2.2 and 2.4 (the standard model, with underflow).
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

from exactpt.errors import RoundingError

Answer: TypeAlias = tuple[int, float, float]
"""(sign, low, high): the sign of a function just after now, and an enclosure of its first
root after now, which is simple (a crossing); (inf, inf) if there is none up to the
horizon. Sign 0 means unsure."""

INFINITY: Final = math.inf
UNSURE: Final[Answer] = (0, 0.0, 0.0)
U: Final = 2.0**-53
"""Unit roundoff of doubles."""
U2: Final = 2.0 * U
U4: Final = 4.0 * U
U8: Final = 8.0 * U
SLACK: Final = 1.0 + 1e-10
"""Factor that covers the rounding of a bound of fewer than 10^5 operations."""
SMALL: Final = 2.0**-300
"""Smallest divisor of an error in any filter."""
TINY: Final = 2.0**-500
"""Absolute error that covers all underflow."""
SMALLEST: Final = 2.0**-300
LARGEST: Final = 2.0**100
"""Range of the size of nonzero coefficients that the filters accept.

Certificates are sums of products of two differences, or of three coefficients. A difference
of doubles of size 2^-300 or more is 0 or at least 2^-352. So no product underflows.
"""
FAR: Final = 2.0**20
"""Ratio of distance from the origin to extent above which doubles are relative to a point."""


def as_lower(x: float) -> float:
    """Return a lower bound: -infinity for a NaN, which bounds nothing."""
    if x >= -INFINITY:
        return x
    return -INFINITY


def as_upper(x: float) -> float:
    """Return an upper bound: infinity for a NaN, which bounds nothing."""
    if x <= INFINITY:
        return x
    return INFINITY


_less_than_half_ulp: float = 2.0**-60  # not Final: a compiler must not compute with these
_least_normal: float = 2.0**-1022


def check_rounding() -> None:
    """Check that this thread rounds to nearest and does not flush subnormal numbers to zero.

    1 + 2^-60 rounds to 1 + 2^-52 upward only; 1 - 2^-60 rounds to 1 - 2^-53 downward and towards
    zero. So both round to the same double if and only if the mode is "to nearest". The product is
    2^-1023: flushed to zero as a result (FTZ), or as an operand of the comparison (DAZ).

    Raises:
        RoundingError: if it does not.
    """
    if 1.0 + _less_than_half_ulp != 1.0 - _less_than_half_ulp:
        raise RoundingError("the floating-point unit of this thread does not round to nearest")
    if not 0.5 * _least_normal > 0.0:
        raise RoundingError(
            "the floating-point unit of this thread flushes subnormal numbers to zero "
            "(loading a library built with -ffast-math may cause this)"
        )
