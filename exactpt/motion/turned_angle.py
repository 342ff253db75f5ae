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

_SAMPLES: Final = (3, 8)
"""Numbers of parts of a piece between samples: the second one where the first proves nothing."""
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
    half = turn.half_turn(Polynomial([a, b - a]))  # on [0, 1]
    slope = _bound_on_unit(2 * half.derivative() - omega * (b - a) * (ONE + half * half))
    bits = bits_for(error, omega * max(abs(a), abs(b))) + 8
    turned = angle_of(turn._orientation, bits)

    def is_within_by(samples: int) -> bool:
        between = slope / (2 * samples)
        if between > error:
            return False
        full = tuple(2 * bound for bound in pi_bounds(bits))
        errors = []
        for i in range(samples + 1):
            h, t = half._at(QQ(i, samples)), a + (b - a) * QQ(i, samples)
            if abs(h) > 1:
                return False
            by = zip(turned, atan_bounds(h, bits), strict=True)
            errors.append([p + 2 * q - omega * t for p, q in by])
        k = floor(errors[0][0] / full[0] + QQ(1, 2))
        turns = sorted((k * full[0], k * full[1]))
        return all(max(high - turns[0], turns[1] - low) + between <= error for low, high in errors)

    return any(map(is_within_by, _SAMPLES))


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
    c = f._coefficients
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
