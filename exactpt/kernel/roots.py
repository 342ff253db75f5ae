"""The real roots of a polynomial after a time: closed form up to degree 2, else Sturm.

Descartes' rule comes first: it says at once that there is none, or one, most of the time.

The one question a certificate asks: what is its sign now, and when may it change?
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.descartes import sign_variations
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    greatest_common_divisor,
    primitive,
    sign_at,
    square_free,
)
from exactpt.kernel.numbers import QQ, is_square, isqrt
from exactpt.kernel.sturm import isolating_intervals, sturm_sequence

__all__ = ["Root", "common_roots", "roots_after"]


class Root(NamedTuple):
    """A real root of a polynomial.

    Attributes:
        time: where it is.
        crossing: whether the polynomial changes sign there (odd multiplicity).
    """

    time: AlgebraicNumber
    crossing: bool


def roots_after(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    """The distinct real roots of f in (start, until], from left to right, lazily.

    Args:
        f: not zero.
        start: the open end; may itself be a root.
        until: the closed end.
    """
    if start.compare_rational(until) >= 0 or len(f) == 1:
        return
    if len(f) == 2:
        root = QQ(-f[0], f[1])
        if root <= until and start.compare_rational(root) < 0:
            yield Root(AlgebraicNumber(root), crossing=True)
        return
    if len(f) == 3:
        yield from _quadratic_roots(f, start, until)
        return
    if sign_at(f, until) != 0:
        most = sign_variations(f, start.low, until)
        if most == 0:
            return
        if most == 1:
            only = AlgebraicNumber.root(square_free(f), start.low, until)
            if only.compare(start) > 0:
                yield Root(only, crossing=True)
            return
    # Multiplicities alternate the sign: carry it along instead of factoring.
    before = start.sign_after(f)
    sequence = sturm_sequence(primitive(f))
    p = sequence[0]
    simple = len(p) == len(f)
    for low, high in isolating_intervals(sequence, start.low, until):
        root_of_p = AlgebraicNumber.root(p, low, high)
        if root_of_p.compare(start) <= 0:
            continue
        after = -before if simple else root_of_p.sign_after(f)
        yield Root(root_of_p, crossing=after != before)
        before = after


def _quadratic_roots(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    c0, c1, c2 = f
    d = c1 * c1 - 4 * c0 * c2
    if d < 0:
        return
    if is_square(d):
        s = isqrt(d)
        ends = sorted({QQ(-c1 - s, 2 * c2), QQ(-c1 + s, 2 * c2)})
        for value in ends:
            if value <= until and start.compare_rational(value) < 0:
                yield Root(AlgebraicNumber(value), crossing=s > 0)
        return
    # Two irrational roots, on either side of the vertex of the parabola, and each
    # at most 1 + sqrt(d) / 2|c2| away from it.
    vertex = QQ(-c1, 2 * c2)
    reach = QQ(isqrt(d) + 1, 2 * abs(c2)) + 1
    for low, high in ((vertex - reach, vertex), (vertex, vertex + reach)):
        if high <= start.low or until <= low:
            continue
        root = AlgebraicNumber.root(f, low, high)
        if start.compare(root) < 0 and root.compare_rational(until) <= 0:
            yield Root(root, crossing=True)


def common_roots(f: IntPoly, g: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    """The common real roots of f and g in (start, until], from left to right.

    ``crossing`` says nothing here. If both are zero, nothing is yielded (every time
    is a common root, so no time is the first).
    """
    common = greatest_common_divisor(f, g)
    if len(common) > 1:
        yield from roots_after(common, start, until)
