"""Computations in doubles without rounding errors: the doubles are the exact result.

The error of a sum or a product of two doubles is itself a double, and a few operations compute
it. So it can be noticed that it is 0: on grids of small numbers, that is always so.

*Sums* (TwoSum). The computed error is exact for all doubles, subnormal ones included, as a sum
never underflows. If something overflows, it is an infinity or a NaN, and so is not 0.

*Products* (Dekker). By a product with 2^27 + 1, each factor is split into two halves of 26 bits,
of which all products are exact; so is each sum, in this order. This needs two things:

- Nothing overflows: factors are at most 2^960.
- The last bits of the product of the last bits are not lost: they are at least 2^-1074. Factors are
  multiples of ulp(a) and ulp(b), where |a| < 2^53 ulp(a). So ulp(a) ulp(b) > 2^-106 |a b|, which is
  enough if |a b| is at least 2^-960. Splitting a subnormal number needs only integer multiples of
  2^-1074.

Out of this range, a product does not count as exact, unless a factor is 0.

Source: D. E. Knuth, *The Art of Computer Programming*, vol. 2, 3rd ed., 4.2.2, theorem B
(TwoSum); S. Boldo, S. Graillat, J.-M. Muller, *On the robustness of the 2Sum and Fast2Sum
algorithms*, ACM Trans. Math. Softw. 44 (2017) (its overflow); T. J. Dekker, *A floating-point
technique for extending the available precision*, Numerische Mathematik 18 (1971) (the product).
"""

from __future__ import annotations

from typing import Final

NOT_EXACT: Final = 2
"""Instead of a sign: something would have been rounded."""
SMALLEST_PRODUCT: Final = 2.0**-960
LARGEST_FACTOR: Final = 2.0**960
_SPLITTER: Final = 2.0**27 + 1.0


def is_exact_sum(a: float, b: float, total: float) -> bool:
    """Return True if a + b is exactly the double that it is rounded to, ``total``."""
    of_b = total - a
    return (a - (total - of_b)) + (b - of_b) == 0.0


def is_exact_product(a: float, b: float, product: float) -> bool:
    """Return True if a b certainly is a double, which is a b rounded or a double next to that."""
    if product == 0.0:
        return a == 0.0 or b == 0.0
    if not (
        abs(product) >= SMALLEST_PRODUCT and abs(a) <= LARGEST_FACTOR and abs(b) <= LARGEST_FACTOR
    ):
        return False
    c = _SPLITTER * a
    a_high = c - (c - a)
    a_low = a - a_high
    c = _SPLITTER * b
    b_high = c - (c - b)
    b_low = b - b_high
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return error == 0.0


def exact_cross_sign(
    a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], d: tuple[float, float]
) -> int:
    """Return the sign of (b - a) x (d - c), if nothing was rounded; else `NOT_EXACT`."""
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = a, b, c, d
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    if not (
        is_exact_sum(bx, -ax, ux)
        and is_exact_sum(by, -ay, uy)
        and is_exact_sum(dx, -cx, vx)
        and is_exact_sum(dy, -cy, vy)
    ):
        return NOT_EXACT
    p, q = ux * vy, uy * vx
    if not (is_exact_product(ux, vy, p) and is_exact_product(uy, vx, q)):
        return NOT_EXACT
    return 1 if p > q else -1 if p < q else 0


class Exactly:
    """Sums and products of doubles that notice whether one of them was rounded.

    Attributes:
        holds: whether no operation so far was rounded, so that all results are exact.
    """

    def __init__(self) -> None:
        self.holds = True

    def plus(self, a: float, b: float) -> float:
        """Return a + b."""
        total = a + b
        if not is_exact_sum(a, b, total):
            self.holds = False
        return total

    def minus(self, a: float, b: float) -> float:
        """Return a - b."""
        return self.plus(a, -b)

    def times(self, a: float, b: float) -> float:
        """Return a b."""
        product = a * b
        if not is_exact_product(a, b, product):
            self.holds = False
        return product

    def cross(self, ax: float, ay: float, bx: float, by: float) -> float:
        """Return a x b = ax by - ay bx."""
        return self.minus(self.times(ax, by), self.times(ay, bx))

    def dot(self, ax: float, ay: float, bx: float, by: float) -> float:
        """Return a . b = ax bx + ay by."""
        return self.plus(self.times(ax, bx), self.times(ay, by))
