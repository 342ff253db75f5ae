"""Common to all float filters: the type of their answers and the model of rounding.

The standard model: the relative error of a sum, difference, product, quotient or square
root of doubles is at most the unit roundoff U, unless it overflows or underflows.

- Overflow gives an infinity or a NaN, never a wrong finite number. Bounds are written so
  that one of them ends as "unsure": every acceptance is a positive test, false for NaN.
- Underflow adds an absolute error of at most 2^-1075 to a product or quotient (sums and
  differences have none). The guards of each filter bound the growth of that error, so
  that it ends below `TINY`, which every bound contains.

So no filter assumes anything about its arguments: out of range, the answer is "unsure".

Source: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
sections 2.2 and 2.4 (the standard model, with underflow).
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

__all__ = ["INFINITY", "SLACK", "SMALL", "TINY", "UNSURE", "Answer", "U"]

Answer: TypeAlias = tuple[int, float, float]
"""(sign, low, high): the sign of a function just after now, and an enclosure of its first
root after now, which is simple (a crossing); (inf, inf) if there is none up to the
horizon. Sign 0 means unsure."""

INFINITY: Final = math.inf
UNSURE: Final[Answer] = (0, 0.0, 0.0)
U: Final = 2.0**-53
"""Unit roundoff of doubles."""
SLACK: Final = 1.0 + 1e-10
"""Factor that covers the rounding of a bound of fewer than 10^5 operations."""
SMALL: Final = 2.0**-300
"""Smallest divisor of an error in any filter."""
TINY: Final = 2.0**-500
"""Absolute error that covers all underflow."""
