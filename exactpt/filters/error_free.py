"""Computations in doubles without rounding errors: the doubles are the exact result.

The error of a sum, and of a product, is itself a double, as long as nothing overflows and no
product of nonzero numbers is below 2^-900.

Source: D. E. Knuth, *The Art of Computer Programming*, vol. 2, 3rd ed., 4.2.2, theorem B
(TwoSum); T. J. Dekker, *A floating-point technique for extending the available precision*,
Numerische Mathematik 18 (1971) (the product).
"""

from __future__ import annotations

from typing import Final

NOT_EXACT: Final = 2
"""Instead of a sign: something would have been rounded."""
_SPLITTER: Final = 2.0**27 + 1.0


def is_exact_sum(a: float, b: float, total: float) -> bool:
    """Return True if a + b is the double that it is rounded to."""
    of_b = total - a
    return (a - (total - of_b)) + (b - of_b) == 0.0


def is_exact_product(a: float, b: float, product: float) -> bool:
    """Return True if a b is a double next to it, for numbers of at most 2^900."""
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
    """Return the sign of (b - a) x (d - c), if that is computed without rounding; else `NOT_EXACT`.

    Coordinates are 0 or of size 2^-300 to 2^100: so a difference is 0 or at least 2^-352, and
    nothing underflows.
    """
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
