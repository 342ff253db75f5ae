"""Sturm sequences: how many real roots lie in an interval, and which is the first.

Source: S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*,
2nd ed., section 2.2.2 (Sturm's theorem) and section 10.1 (Cauchy's bound).
"""

from __future__ import annotations

from collections.abc import Iterator

from exactpt.errors import InputError
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    negate,
    positive_remainder,
    primitive,
    quotient,
    sign_at,
)
from exactpt.kernel.numbers import QQ


def sturm_sequence(f: IntPoly) -> list[IntPoly]:
    """f, f', then the negated remainders, all divided by the last that is not zero.

    That last one is gcd(f, f'). Without the division every term vanishes at a
    multiple root of f, and the count in an interval that ends there would be wrong.

    Raises:
        InputError: if f is zero.
    """
    if not f:
        raise InputError("the zero polynomial has no Sturm sequence")
    sequence = [f]
    following = primitive(derivative(f))
    while following:
        check_budget()
        sequence.append(following)
        following = negate(positive_remainder(sequence[-2], following))
    common = sequence[-1]
    if len(common) > 1:
        sequence = [quotient(g, common) for g in sequence]
    return sequence


def _variations(sequence: list[IntPoly], t: QQ) -> int:
    return sign_changes([sign_at(f, t) for f in sequence])


def sign_changes(signs: list[int]) -> int:
    """Return the number of sign changes in a sequence of signs; zeros are ignored."""
    count, last = 0, 0
    for s in signs:
        if s and s != last:
            count += last != 0
            last = s
    return count


def count_roots(sequence: list[IntPoly], lo: QQ, hi: QQ) -> int:
    """Return the number of distinct real roots of ``sequence[0]`` in (lo, hi].

    Args:
        sequence: a Sturm sequence, from `sturm_sequence`.
        lo: the open end of the interval.
        hi: the closed end, ``>= lo``.

    Raises:
        InputError: if ``lo > hi``.
    """
    if lo > hi:
        raise InputError(f"empty interval: lo = {lo} > hi = {hi}")
    return _variations(sequence, lo) - _variations(sequence, hi)


def cauchy_bound(f: IntPoly) -> QQ:
    """Return a power of two above the absolute value of every complex root of f (not zero)."""
    largest = max(abs(c) for c in f)
    bits = largest.bit_length() - abs(f[-1]).bit_length() + 2
    return QQ(1 << bits)


def isolating_intervals(sequence: list[IntPoly], lo: QQ, hi: QQ) -> Iterator[tuple[QQ, QQ]]:
    """Isolating intervals (l, r] of the real roots of sequence[0] in (lo, hi], left to right.

    Lazy: a caller who takes only the first root pays for no other. A root found to be r
    itself has the interval (r, r).

    Args:
        sequence: a Sturm sequence, from `sturm_sequence`.
        lo: the open end of the range.
        hi: its closed end, ``>= lo``.
    """
    stack = [(lo, hi, _variations(sequence, lo), _variations(sequence, hi))]
    while stack:
        check_budget()
        left, right, below, above = stack.pop()
        if below == above:
            continue
        if below - above == 1:
            yield (right, right) if sign_at(sequence[0], right) == 0 else (left, right)
            continue
        middle = (left + right) / 2
        between = _variations(sequence, middle)
        stack.append((middle, right, between, above))
        stack.append((left, middle, below, between))
