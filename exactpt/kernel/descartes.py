"""Descartes' rule of signs: most intervals hold no root, or one, and need no Sturm sequence.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 2.2.1 (Descartes' law of signs) and section 10.2 (in an interval, and
isolation by halving).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import Final

from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, ZZ, sign
from exactpt.kernel.sturm import sign_changes

__all__ = ["single_roots"]

HALVINGS: Final = 8
"""So often an interval is halved at most: roots as close as that are left to Sturm."""


def single_roots(f: IntPoly, low: QQ, high: QQ) -> Iterator[tuple[QQ, QQ, bool]]:
    """Open intervals from left to right that hold all roots of f in (low, high), lazily.

    With each, whether it is known to hold just one root, a simple one; else it may hold
    any number. No end of an interval is a root but ``low`` or ``high``.

    Args:
        f: not zero.
        low: the left end.
        high: the right end, larger.
    """
    stack = [(_on_unit_interval(f, low, high), low, high, HALVINGS)]
    while stack:
        g, left, right, halvings = stack.pop()
        most = _variations(g)
        if most == 0:
            continue
        if most == 1 or halvings == 0:
            yield left, right, most == 1
            continue
        degree = len(g) - 1
        first = [c << (degree - i) for i, c in enumerate(g)]  # 2^degree g(s / 2)
        second = _shifted_by_one(first)
        if second[0] == 0:
            yield left, right, False
            continue
        middle = (left + right) / 2
        stack.append((second, middle, right, halvings - 1))
        stack.append((first, left, middle, halvings - 1))


def _on_unit_interval(f: IntPoly, low: QQ, high: QQ) -> list[ZZ]:
    """A positive multiple of f(low + (high - low) s)."""
    width = high - low
    scale = low.denominator * width.denominator
    g = _stretch(f[::-1], ZZ(scale))[::-1]  # scale^deg(f) f(t / scale)
    by = ZZ(low.numerator * width.denominator)
    if by:
        for i in range(len(g) - 1):
            for j in range(len(g) - 2, i - 1, -1):
                g[j] += by * g[j + 1]
    return _stretch(g, ZZ(width.numerator * low.denominator))


def _variations(g: list[ZZ]) -> int:
    """A bound for the roots of g in the open unit interval, each with its multiplicity.

    It exceeds their number by an even number: so 0 and 1 are that number. How often the
    coefficients of (1 + s)^deg(g) g(1 / (1 + s)) change their sign: 1 / (1 + s) maps the
    positive s to the interval.
    """
    return sign_changes([sign(c) for c in _shifted_by_one(g[::-1])])


def _stretch(g: Sequence[ZZ], factor: ZZ) -> list[ZZ]:
    """The coefficients of g(factor s)."""
    power = ZZ(1)
    result = []
    for c in g:
        result.append(c * power)
        power *= factor
    return result


def _shifted_by_one(g: list[ZZ]) -> list[ZZ]:
    """The coefficients of g(s + 1): Horner's scheme is to add up from the leading one."""
    rest, result = g[::-1], []
    while rest:
        rest = list(accumulate(rest))
        result.append(rest.pop())
    return result
