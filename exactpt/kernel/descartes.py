"""Descartes' rule of signs: most intervals hold no root, or one, and need no Sturm sequence.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 2.2.1 (Descartes' law of signs) and section 10.2 (in an interval).
"""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, ZZ, sign
from exactpt.kernel.sturm import sign_changes

__all__ = ["sign_variations"]


def sign_variations(f: IntPoly, low: QQ, high: QQ) -> int:
    """A bound for the roots of f in the open interval (low, high), each with its multiplicity.

    It exceeds their number by an even number: so 0 and 1 are that number.

    t = (low + high s) / (1 + s) maps the positive s to the interval. The variations of a
    positive multiple of (1 + s)^deg(f) f(t) are counted: f is shifted to low, stretched by
    high - low, reversed, and shifted by 1.

    Args:
        f: not zero.
        low: the left end.
        high: the right end, larger.
    """
    width = high - low
    scale = low.denominator * width.denominator
    g = _stretch(f[::-1], ZZ(scale))[::-1]  # scale^deg(f) f(t / scale)
    _shift(g, ZZ(low.numerator * width.denominator))
    g = _stretch(g, ZZ(width.numerator * low.denominator))[::-1]
    _shift(g, ZZ(1))
    return sign_changes([sign(c) for c in g])


def _stretch(g: Sequence[ZZ], factor: ZZ) -> list[ZZ]:
    """The coefficients of g(factor t)."""
    power = ZZ(1)
    result = []
    for c in g:
        result.append(c * power)
        power *= factor
    return result


def _shift(g: list[ZZ], by: ZZ) -> None:
    """Let g(t) become g(t + by), by Horner's scheme."""
    if by:
        for i in range(len(g) - 1):
            for j in range(len(g) - 2, i - 1, -1):
                g[j] += by * g[j + 1]
