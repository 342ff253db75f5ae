"""Successive headings: how far a body turns from one to the next.

A heading stands for a direction, which full turns do not change; an angle does not. Between two
angles that differ by d a body turns by d. From a log of headings the smaller of the two turns is
meant, which is at most pi. No rational number is an odd multiple of pi, so two rational headings
are never as far apart one way as the other: the nearest is unique.

**Rounding.** Unwrapped, a heading differs from the one in the log by k full turns, and 2 k pi is
irrational. It is replaced by k T, where T is rational and |T - 2 pi| <= r. So angles are off by at
most K r, K the largest |k|, and between samples, where they are weighted means of the angles of
two samples, by no more.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.arctangents import pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, ZZ, exponent, floor, nearest_float

_BITS: Final = 64
"""Bits of pi at first; twice as many as long as they do not decide."""
_SPARE_BITS: Final = 10
"""The rounding of angles is at most the error over this power of two."""


def check_headings(angles: Sequence[QQ]) -> None:
    """Refuse successive angles that differ by more than pi.

    Raises:
        InputError: if there are such, with the row of the second one.
    """
    for i, (before, angle) in enumerate(pairwise(angles), 1):
        if turns_to_nearest(before, angle):
            raise InputError(
                f"row {i}: the angle changes by {nearest_float(angle - before):.6g}, more than pi; "
                f"angles are in radians; if they are headings, unwrap=True takes the nearest"
            )


def unwrapped(headings: Sequence[QQ], error: QQ) -> tuple[list[QQ], QQ]:
    """Return angles for headings, each at most pi from the one before, and a bound on their error.

    Args:
        headings: angles in radians.
        error: a positive number; angles are off by at most a thousandth of it.
    """
    turns = [ZZ(0)] * len(headings[:1])
    for before, heading in pairwise(headings):
        turns.append(turns[-1] + turns_to_nearest(before, heading))
    most = max(map(abs, turns), default=ZZ(0))
    if not most:
        return list(headings), QQ(0)
    bits = max(_BITS, _SPARE_BITS + 3 + exponent(QQ(most)) - exponent(error))
    low, high = pi_bounds(bits)
    angles = [heading + 2 * low * k for heading, k in zip(headings, turns, strict=True)]
    return angles, 2 * (high - low) * most


def turns_to_nearest(before: QQ, heading: QQ) -> ZZ:
    """Return how many full turns are added to a heading to bring it within pi of another angle."""
    if abs(heading - before) < 3:
        return ZZ(0)
    bits = _BITS
    while True:
        check_budget()
        # k is the integer nearest to (before - heading) / (2 pi).
        turns = {floor((before - heading) / (2 * pi) + QQ(1, 2)) for pi in pi_bounds(bits)}
        if len(turns) == 1:
            return turns.pop()
        bits *= 2
