"""The real roots of a polynomial after a time: closed form up to degree 2, else Descartes.

Descartes' rule and a few bisections isolate most roots; close or multiple roots are left to
Sturm's sequence. The roots of a certificate are the times at which its sign may change.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

from exactpt.brief import record_in_brief
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.descartes import single_roots
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    greatest_common_divisor,
    negate,
    primitive,
    sign_at,
    square_free,
)
from exactpt.kernel.numbers import QQ, isqrt_rem
from exactpt.kernel.sturm import isolating_intervals, sturm_sequence

DIGITS: Final = 80
"""Bits of a square root; so many that a double seldom separates the bounds of the root."""


class Root(NamedTuple):
    """A real root of a polynomial.

    Attributes:
        time: the root itself.
        crossing: whether the polynomial changes sign there (odd multiplicity).
    """

    time: AlgebraicNumber
    crossing: bool

    def __repr__(self) -> str:
        return record_in_brief(self)


def roots_after(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    """Return the distinct real roots of f in (start, until], from left to right, lazily.

    Args:
        f: not zero.
        start: the open end; may itself be a root.
        until: the closed end.
    """
    if len(f) == 1 or start.compare_rational(until) >= 0:
        return iter(())
    if len(f) == 2:
        return _linear_root(f, start, until)
    if len(f) == 3:
        return _quadratic_roots(f, start, until)
    if sign_at(f, until) == 0:
        return _roots_by_sturm(f, sturm_sequence(primitive(f)), start, start.exact_low, until)
    return _roots_by_descartes(f, start, until)


def _linear_root(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    root = QQ(-f[0], f[1])
    if root <= until and start.compare_rational(root) < 0:
        yield Root(AlgebraicNumber(root), crossing=True)


def _roots_by_descartes(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    """Yield the roots of f after start, if ``until`` is not a root."""
    p: IntPoly = ()
    sequence: list[IntPoly] = []
    for low, high, alone in single_roots(f, start.exact_low, until):
        if alone:
            p = p or square_free(f)
            root = AlgebraicNumber.exact_root(p, low, high)
            if root.compare(start) > 0:
                yield Root(root, crossing=True)
        else:
            sequence = sequence or sturm_sequence(primitive(f))
            yield from _roots_by_sturm(f, sequence, start, low, high)


def _roots_by_sturm(
    f: IntPoly, sequence: list[IntPoly], start: AlgebraicNumber, low: QQ, high: QQ
) -> Iterator[Root]:
    """Yield the roots of f in (low, high] after start, by the Sturm sequence of f."""
    p = sequence[0]
    simple = len(p) == len(f)
    for left, right in isolating_intervals(sequence, low, high):
        root = AlgebraicNumber.exact_root(p, left, right)
        if root.compare(start) > 0:
            yield Root(root, crossing=simple or root.sign_before(f) != root.sign_after(f))


def _quadratic_roots(f: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    c0, c1, c2 = f
    d = c1 * c1 - 4 * c0 * c2
    if d < 0:
        return
    # The square root to so many bits that rounding to doubles seldom needs more.
    places = max(0, DIGITS - (d.bit_length() >> 1))
    s, rest = isqrt_rem(d << 2 * places)
    if rest == 0:
        s >>= places
        ends = sorted({QQ(-c1 - s, 2 * c2), QQ(-c1 + s, 2 * c2)})
        for value in ends:
            if value <= until and start.compare_rational(value) < 0:
                yield Root(AlgebraicNumber(value), crossing=s > 0)
        return
    if c2 < 0:
        f, c1, c2 = negate(f), -c1, -c2
    middle, unit = -c1 << places, c2 << places + 1
    p, q = start.exact_low.numerator * unit, start.exact_low.denominator
    for above in (middle - s, middle + s + 1):
        if above * q <= p:
            continue  # the root is before the start
        low, high = QQ(above - 1, unit), QQ(above, unit)
        if until <= low:
            return
        root = AlgebraicNumber.surd(f, low, high, larger=above > middle)
        if start.compare(root) < 0 and root.compare_rational(until) <= 0:
            yield Root(root, crossing=True)


def common_roots(f: IntPoly, g: IntPoly, start: AlgebraicNumber, until: QQ) -> Iterator[Root]:
    """Yield the common real roots of f and g in (start, until], from left to right.

    ``crossing`` carries no meaning here. If both are zero, nothing is yielded (every time
    is a common root, so none is the first).
    """
    common = greatest_common_divisor(f, g)
    if len(common) > 1:
        yield from roots_after(common, start, until)
