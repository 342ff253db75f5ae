"""Descartes' rule of signs: isolates most roots without a Sturm sequence.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 2.2.1 (Descartes' law of signs) and section 10.2 (on an interval, and
isolation by bisection).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate
from typing import Final

from exactpt.kernel.budget import LONG, check_budget
from exactpt.kernel.integer_polynomial import IntPoly, on_unit_interval
from exactpt.kernel.numbers import QQ, ZZ, sign
from exactpt.kernel.sturm import sign_changes

HALVINGS: Final = 8
"""Maximum number of bisections; roots closer than that are left to Sturm's sequence."""


def single_roots(f: IntPoly, low: QQ, high: QQ) -> Iterator[tuple[QQ, QQ, bool]]:
    """Open intervals from left to right that contain all roots of f in (low, high), lazily.

    Each comes with a flag: true if it is known to contain exactly one root, a simple one;
    otherwise it may contain any number. Apart from ``low`` and ``high``, no end of an
    interval is a root.

    Args:
        f: not zero.
        low: the left end.
        high: the right end, greater than ``low``.
    """
    stack = [(on_unit_interval(f, low, high), low, high, HALVINGS)]
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


def _variations(g: list[ZZ]) -> int:
    """Return an upper bound on the number of roots of g in (0, 1), counted with multiplicity.

    It is the number of sign changes of the coefficients of (1 + s)^deg(g) g(1 / (1 + s)):
    1 / (1 + s) maps the positive s onto (0, 1). The bound exceeds the number of roots by an
    even number, so 0 and 1 are exact.
    """
    return sign_changes([sign(c) for c in _shifted_by_one(g[::-1])])


def _shifted_by_one(g: list[ZZ]) -> list[ZZ]:
    """Return the coefficients of g(s + 1), by repeated Horner."""
    rest, result = g[::-1], []
    is_long = len(rest) > LONG
    while rest:
        if is_long:
            check_budget()
        rest = list(accumulate(rest))
        result.append(rest.pop())
    return result
