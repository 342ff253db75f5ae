"""What the float filters share: their answers, and how they account for rounding.

The standard model: a sum, difference, product, quotient or square root of doubles is
right to one unit U of itself, unless it overflows or underflows.

- Overflow gives an infinity or a NaN, never a wrong finite number. Bounds are written so
  that one of them ends as "unsure": every acceptance is a positive test, false for NaN.
- Underflow adds an absolute error of at most 2^-1075 to a product or quotient (sums and
  differences have none). What may happen to that error afterwards is bounded by the
  guards of each filter, so that it ends below `TINY`, which every bound contains.

So no filter assumes anything of its arguments: what is out of range is unsure.

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
SLACK: Final = 1.0 + 1e-10
"""Covers the rounding of a bound of fewer than 10^5 operations."""
SMALL: Final = 2.0**-300
"""No filter divides an error by less."""
TINY: Final = 2.0**-500
"""Covers all underflow."""
