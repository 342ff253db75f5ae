"""By which angle a motion in pieces turns: a proof that it is omega t, but for an error.

On a piece [a, b] let s = (t - a) / (b - a), h the half turn as a polynomial in s, and

    e(s) = (angle of the orientation) - omega a - 2 pi k + g(s),
    g(s) = 2 arctan h(s) - omega (b - a) s

with one integer k, so that e is continuous. At sample times g is enclosed in rational bounds. From
there to the middle between two of them it changes by at most the distance times the largest slope,
g' = (2 h' - omega (b - a) (1 + h^2)) / (1 + h^2); the denominator is at least 1, and the numerator
at most the largest of its Bernstein coefficients on the piece.

Pieces of a `Spin` of one duration differ in the last coefficient of h alone, by little. Where
s >= 0, h(s) increases with this coefficient, and g(s) with h(s): the upper bound of g for the
greatest of these coefficients, and the lower one for the least, hold for all these pieces, and no
piece needs its own. They are used only if a part of the error is left, so that programs which
compute bounds for each piece (`exactpt.proof_check`) get along, too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple

from exactpt.errors import InputError
from exactpt.kernel.arctangents import Bounds, atan_bounds, pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, exponent, floor, show
from exactpt.kernel.polynomial import ONE, Polynomial
from exactpt.motion.motions import Pieces, Rigid

_SAMPLES: Final = (3, 8)
"""Numbers of parts of a piece between samples: the second one where the first proves nothing."""
_SPARE: Final = 256
"""One over the part of the error that is left where bounds hold for several pieces."""
_MAX_BITS: Final = 512


def is_within(pieces: Pieces, omega: QQ, error: QQ) -> bool:
    """Return True if it is proved that pieces turn by omega t with at most this error.

    From the end of the first piece to the beginning of the last one, which do not turn; and about
    one pivot, with one translation.

    Raises:
        InputError: if the error is too small for angles of this size.
    """
    turns = [motion for motion in pieces.motions if isinstance(motion, Rigid)]
    if len(turns) < max(len(pieces.motions), 3):
        return False
    if turns[0].half_turn.degree > 0 or turns[-1].half_turn.degree > 0:
        return False
    if len({(turn.exact_pivot, turn.x, turn.y) for turn in turns}) > 1:
        return False
    groups: dict[tuple[QQ, ...], list[_Start]] = {}
    for (a, b), turn in zip(pairwise(pieces.exact_until), turns[1:-1], strict=True):
        h = turn.half_turn(Polynomial([a, b - a])).exact_coefficients or (QQ(0),)
        if abs(h[0]) > 1:
            return False
        start = _Start(a, turn.exact_orientation, h[0], h[-1])
        groups.setdefault((b - a, *h[:-1]), []).append(start)
    return all(_are_within(group, starts, omega, error) for group, starts in groups.items())


class _Start(NamedTuple):
    """The time and the orientation at which a piece starts; h(0), and the last coefficient of h."""

    time: QQ
    orientation: tuple[QQ, QQ]
    first: QQ
    last: QQ


def _are_within(group: tuple[QQ, ...], starts: Sequence[_Start], omega: QQ, error: QQ) -> bool:
    """Return True if it is proved of pieces with a duration and all but the last coefficient."""
    (duration, *shape), lasts = group, [start.last for start in starts]
    latest = max(abs(start.time) for start in starts) + duration
    bits = bits_for(error, omega * latest) + 8
    offs = [_off_at(start, omega, bits) for start in starts]
    off = min(low for low, _ in offs), max(high for _, high in offs)
    extremes = [Polynomial([*shape, last]) for last in sorted({min(lasts), max(lasts)})]
    allowed = error if len(starts) == 1 else error - error / _SPARE
    for samples in _SAMPLES:
        swing = _range_of(extremes, omega * duration, samples, bits)
        if swing and -allowed <= off[0] + swing[0] and off[1] + swing[1] <= allowed:
            return True
    return len(starts) > 1 and all(_are_within(group, [one], omega, error) for one in starts)


def _off_at(start: _Start, omega: QQ, bits: int) -> Bounds:
    """Return bounds of e(0) - g(0)."""
    check_budget()
    low, high = angle_of(start.orientation, bits)
    turned, (p, q) = omega * start.time, pi_bounds(bits)
    k = 2 * floor((low + 2 * atan_bounds(start.first, bits)[0] - turned) / (2 * p) + QQ(1, 2))
    least, most = sorted((k * p, k * q))
    return low - turned - most, high - turned - least


def _range_of(extremes: Sequence[Polynomial], angle: QQ, samples: int, bits: int) -> Bounds | None:
    """Return bounds of g, for half turns between the first and the last one; None if unknown."""
    slopes = (2 * h.derivative() - angle * (ONE + h * h) for h in extremes)
    between = max(map(_bound_on_unit, slopes)) / (2 * samples)
    lows, highs = [], []
    for i in range(samples + 1):
        s = QQ(i, samples)
        least, most = extremes[0].exact_at(s), extremes[-1].exact_at(s)
        if least < -1 or most > 1:
            return None
        lows.append(2 * atan_bounds(least, bits)[0] - angle * s)
        highs.append(2 * atan_bounds(most, bits)[1] - angle * s)
    return min(lows) - between, max(highs) + between


def angle_of(vector: tuple[QQ, QQ], bits: int) -> Bounds:
    """Return bounds of an angle of a unit vector."""
    (c, s), quarters = vector, 0
    while c <= 0 or abs(s) > c:
        c, s, quarters = s, -c, quarters + 1
    low, high = atan_bounds(s / (1 + c), bits)
    p, q = pi_bounds(bits)
    return 2 * low + quarters * p / 2, 2 * high + quarters * q / 2


def bound_on(f: Polynomial, a: QQ, b: QQ) -> QQ:
    """Return a bound on |f| in [a, b]: the largest of its Bernstein coefficients."""
    return _bound_on_unit(f(Polynomial([a, b - a])))


def _bound_on_unit(f: Polynomial) -> QQ:
    c = f.exact_coefficients
    n = len(c) - 1
    largest = QQ(0)
    for j in range(n + 1):
        check_budget()
        parts = (c[i] * QQ(math.comb(j, i), math.comb(n, i)) for i in range(j + 1))
        largest = max(largest, abs(sum(parts, QQ(0))))
    return largest


def bits_for(error: QQ, angle: QQ) -> int:
    """Bits after the binary point for a small part of an error, if an angle is multiplied."""
    bits = max(8, 5 - exponent(error)) + int(floor(abs(angle))).bit_length()
    if bits > _MAX_BITS:
        raise InputError(f"an error of {show(error)} is too small for angles up to {show(angle)}")
    return bits
