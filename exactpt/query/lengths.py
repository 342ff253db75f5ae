"""Lengths of polylines: sums of square roots of rationals, compared exactly."""

from __future__ import annotations

import math
from collections import Counter
from typing import final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.kernel.radicals import root_sum_sign
from exactpt.kernel.square_root import nearest_square_root


def squared_distance(p: Point, q: Point) -> QQ:
    """Return the square of the Euclidean distance."""
    x, y = q[0] - p[0], q[1] - p[1]
    return x * x + y * y


@final
class Length:
    """A length and one more leg.

    Doubles enclose it; only where the enclosures of two lengths overlap, is the sign of their
    difference computed.

    Attributes:
        before: the length without the leg; None for zero.
        square: the squared length of the leg.
        low: a double that is at most the length.
        high: a double that is at least the length.
    """

    __slots__ = ("before", "high", "low", "square")

    def __init__(self, before: Length | None, square: QQ) -> None:
        self.before = before
        self.square = square
        root = nearest_square_root(square)
        low: float = before.low if before else 0.0
        high: float = before.high if before else 0.0
        # The root is in the interval of the neighbours of its nearest double, and a sum of
        # doubles in that of the neighbours of its nearest one.
        self.low: float = max(0.0, math.nextafter(low + math.nextafter(root, 0.0), 0.0))
        self.high: float = math.nextafter(high + math.nextafter(root, math.inf), math.inf)

    def __lt__(self, other: Length) -> bool:
        if self.high < other.low:
            return True
        if self.low >= other.high:
            return False
        legs = self._legs()
        legs.subtract(other._legs())
        return root_sum_sign(legs) < 0

    def _legs(self) -> Counter[QQ]:
        """How often each squared length of a leg occurs."""
        legs: Counter[QQ] = Counter()
        length: Length | None = self
        while length is not None:
            legs[length.square] += 1
            length = length.before
        return legs
