"""By which angle a motion in pieces turns: a proof that it is omega t, but for an error.

On a piece let h be the half turn, and

    e(t) = (angle of the orientation) + 2 arctan h(t) - omega t - 2 pi k

with one integer k, so that e is continuous. At sample times e is enclosed in rational bounds. From
there to the middle between two of them it changes by at most the distance times the largest slope,
e' = (2 h' - omega (1 + h^2)) / (1 + h^2); the denominator is at least 1, and the numerator at
most the largest of its Bernstein coefficients on the piece.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.arctangents import Bounds, atan_bounds, pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, exponent, floor, show
from exactpt.kernel.polynomial import ONE, Polynomial
from exactpt.motion.motions import Pieces, Rigid

_SAMPLES: Final = 8
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
    places = {(turn.pivot, turn.x, turn.y) for turn in turns}
    spans = zip(pairwise(pieces._until), turns[1:-1], strict=True)
    return len(places) == 1 and all(
        _is_piece_within(turn, a, b, omega, error) for (a, b), turn in spans
    )


def _is_piece_within(turn: Rigid, a: QQ, b: QQ, omega: QQ, error: QQ) -> bool:
    check_budget()
    h = turn.half_turn
    slope = bound_on(2 * h.derivative() - omega * (ONE + h * h), a, b)
    between = slope * (b - a) / (2 * _SAMPLES)
    times = [a + (b - a) * QQ(i, _SAMPLES) for i in range(_SAMPLES + 1)]
    if between > error or any(abs(h._at(t)) > 1 for t in times):
        return False
    bits = bits_for(error, omega * max(abs(a), abs(b))) + 8
    turned = angle_of(turn._orientation, bits)
    full = tuple(2 * bound for bound in pi_bounds(bits))
    errors = []
    for t in times:
        half = atan_bounds(h._at(t), bits)
        errors.append([p + 2 * q - omega * t for p, q in zip(turned, half, strict=True)])
    k = floor(errors[0][0] / full[0] + QQ(1, 2))
    turns = sorted((k * full[0], k * full[1]))
    return all(max(high - turns[0], turns[1] - low) + between <= error for low, high in errors)


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
    c = f(Polynomial([a, b - a]))._coefficients
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
