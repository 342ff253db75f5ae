"""Pieces of rigid motion along a path of poses, each proved to be within the errors.

The pieces turn by half turns of degree 3 from one rational unit vector near the angle to the next,
so that they fit exactly and errors do not add up. (Degree 1 needs fifty times as many pieces within
10^-6; with degree 5, equations of contacts are of a degree at which a search takes many times as
long.) How they are found needs no proof, for `exactpt.motion.path_error` proves the error of any.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final, final

from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    ceil,
    exponent,
    floor,
    nearest_float,
    power_of_two,
    rational,
)
from exactpt.kernel.polynomial import ZERO, Polynomial
from exactpt.motion.motions import Rigid, SimpleMotion
from exactpt.motion.path_error import Pose, angle_error, place_error_squared
from exactpt.motion.turned_angle import bits_for
from exactpt.motion.unit_vectors import Vector, rounded, tangent_near, vector_near

MOST: Final = 100_000
"""The largest number of pieces of a path, or of a `Spin` in a span."""
DEGREE: Final = 3
"""Of half turns, and of translations at most."""
_NODES: Final = (rational("3/10"), rational("7/10"))
"""Where a piece interpolates, as part of its duration; near those of Chebyshev, stretched."""
_STRAIGHT: Final = rational("24/25")
"""The least cosine of the angle by which a piece turns; longer pieces are slower to search."""
_SHORTEST: Final = power_of_two(-64)


def pieces_along(
    spans: list[tuple[QQ, QQ, Pose]], error: QQ, place_error: QQ, pivot: Point
) -> list[tuple[Rational | None, SimpleMotion]]:
    """Return pieces along a path, with rest before and after it.

    Args:
        spans: beginning, end, and pose as polynomials of t of each piece of the path.
        error: the largest error of the angle, in radians.
        place_error: the largest error of the translation; 0 to take x and y as they are.
        pivot: the point about which the pieces turn.

    Raises:
        InputError: if the error is too small, or more than 100,000 pieces are needed.
    """
    return PieceMaker(error, place_error, pivot, vector_error=error).along(spans)


@final
class PieceMaker:
    """Makes pieces along a path, each proved to be within the errors.

    A piece is a function of the arguments of this class and of `piece` alone.

    Args:
        error: the largest error of the angle, in radians.
        place_error: the largest error of the translation; 0 to take x and y as they are.
        pivot: the point about which the pieces turn.
        vector_error: the error for `vector_near` of the unit vectors at the ends of pieces.
    """

    def __init__(self, error: QQ, place_error: QQ, pivot: Point, *, vector_error: QQ) -> None:
        self._error, self._place_error, self._pivot = error, place_error, pivot
        self._vector_error = vector_error
        self._bits = bits_for(error, QQ(0)) + 2
        self._place_bits = bits_for(place_error, QQ(0)) + 2 if place_error else 0
        self._vectors: dict[QQ, Vector] = {}

    def along(self, spans: list[tuple[QQ, QQ, Pose]]) -> list[tuple[Rational | None, SimpleMotion]]:
        """Return the pieces along the path, with rest before and after it."""
        pieces: list[tuple[Rational | None, SimpleMotion]] = []
        pieces.append((spans[0][0], self._rest(spans[0][0], spans[0][2])))
        step: QQ | None = None
        for begin, end, pose in spans:
            a = begin
            step = end - a if step is None else step
            while a < end:
                check_budget()
                b = _next(a, end, step)
                turn, rate = self.piece(a, b, pose)
                if turn is None:
                    step = (b - a) * rational(round(min(0.8, max(0.05, 0.9 * rate)), 3))
                    if step < (end - a) * _SHORTEST:
                        raise InputError(self._too_many())
                    continue
                step = (b - a) * rational(round(min(2.0, max(0.5, 0.93 * rate)), 3))
                pieces.append((b, turn))
                a = b
                if len(pieces) + (end - a) / (8 * step) > MOST:  # at an eighth of this rate, too
                    raise InputError(self._too_many())
        return [*pieces, (None, self._rest(spans[-1][1], spans[-1][2]))]

    def _too_many(self) -> str:
        return (
            f"more than {MOST} pieces are needed for an error of {nearest_float(self._error):.6g}"
        )

    def vector(self, t: QQ, angle: Polynomial) -> Vector:
        """Return the orientation at a time: the same for both pieces that end or begin at it."""
        if t not in self._vectors:
            self._vectors[t] = vector_near(angle.exact_at(t), self._vector_error)
        return self._vectors[t]

    def _rest(self, t: QQ, pose: Pose) -> Rigid:
        x, y, angle = pose
        return Rigid(
            ZERO,
            pivot=self._pivot,
            x=self._place(x.exact_at(t)),
            y=self._place(y.exact_at(t)),
            orientation=self.vector(t, angle),
        )

    def _place(self, c: QQ) -> QQ:
        return rounded(c, self._place_bits) if self._place_error else c

    def piece(self, a: QQ, b: QQ, pose: Pose) -> tuple[Rigid | None, float]:
        """Return a piece, None if it is not within the errors; and by how much it may be longer."""
        x, y, angle = pose
        u, v = self.vector(a, angle), self.vector(b, angle)
        cos = u[0] * v[0] + u[1] * v[1]
        whole = (u[0] * v[1] - u[1] * v[0]) / (1 + cos) if cos >= _STRAIGHT else QQ(2)
        local = Polynomial([a, b - a])
        theta = angle(local)
        first = theta.exact_at(QQ(0))
        if cos < _STRAIGHT or any(abs(theta.exact_at(s) - first) > 1 for s in _NODES):
            return None, 0.5

        def half(s: QQ) -> QQ:
            return tangent_near((theta.exact_at(s) - first) / 2, self._bits)

        back = Polynomial([-a / (b - a), 1 / (b - a)])
        if theta.degree > 0:
            h = _cubic(half, QQ(0), whole, self._bits)(back)
        else:
            h = ZERO
        px, py, off = x, y, QQ(0)
        if self._place_error:
            px, py = (self._fit(f(local))(back) for f in (x, y))
        turn = Rigid(h, pivot=self._pivot, x=px, y=py, orientation=u)
        if self._place_error:
            off = place_error_squared(turn, a, b, x, y) / self._place_error**2
        err = angle_error(turn, a, b, angle, self._error) / self._error
        rate = min(_rate(err, 1), _rate(off, 2))
        return (turn if err <= 1 and off <= 1 else None), rate

    def _fit(self, f: Polynomial) -> Polynomial:
        """Return a cubic near a polynomial on [0, 1], with rounded ends."""
        ends = self._place(f.exact_at(QQ(0))), self._place(f.exact_at(QQ(1)))
        return _cubic(f.exact_at, *ends, self._place_bits)


def _rate(part: QQ, power: int) -> float:
    """Return how much longer a piece may be, with an error that is a part of the allowed one.

    Args:
        part: the error, over the allowed one; to the power of 1 or of 2.
        power: 1 or 2.
    """
    if not part:
        return 4.0
    # Square roots of doubles are the same on every machine; powers are not.
    fourth_root = math.sqrt(math.sqrt(nearest_float(part)))
    return 1 / (fourth_root if power == 1 else math.sqrt(fourth_root))


def _next(a: QQ, end: QQ, step: QQ) -> QQ:
    """Return the end of the next piece: one of equal parts, rounded to few digits."""
    n = ceil((end - a) / step)
    if n <= 1:
        return end
    unit = power_of_two(exponent((end - a) / n) - 4)
    b = floor((a + (end - a) / n) / unit) * unit
    return b if a < b < end else a + (end - a) / n


def _cubic(f: Callable[[QQ], QQ], first: QQ, last: QQ, bits: int) -> Polynomial:
    """Return a cubic through (0, first) and (1, last), and near f at the nodes."""
    p, q = _NODES
    at_p, at_q = ((f(s) - first - (last - first) * s) / (s * (1 - s)) for s in _NODES)
    slope = (at_q - at_p) / (q - p)
    rest = Polynomial([rounded(at_p - slope * p, bits), rounded(slope, bits)])
    return Polynomial([first, last - first]) + rest * Polynomial([0, 1, -1])
