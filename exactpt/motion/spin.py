"""Turning at a constant rate: rational turns whose angle differs from omega t by a proven error.

The cosine and the sine of omega t are not rational functions of t. A `Spin` consists of pieces,
each a `Rigid` motion that leads from one rational unit vector to the next; each of these vectors is
found for its own time, so that errors do not add up. How they are found needs no proof, for
`exactpt.motion.turned_angle` proves the error of any pieces.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Final, final

from exactpt.brief import call_in_brief
from exactpt.errors import InputError
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    exponent,
    floor,
    fraction,
    power_of_two,
    rational,
    rationals,
    shorten,
    show,
)
from exactpt.kernel.polynomial import ZERO, Polynomial
from exactpt.motion.motions import Coefficients, Pieces, Rigid, SimpleMotion
from exactpt.motion.turned_angle import bits_for, is_within
from exactpt.motion.unit_vectors import Vector, rounded, vector_near

_MOST: Final = 100_000
_DEGREES: Final = range(1, 32, 2)
_SHORTEST: Final = 1 / 32
"""Radians of a piece; for shorter ones the degree is raised (but for the last of a `Spin`)."""


@final
class Spin(Pieces):
    """A turn about a pivot at a constant rate: by the angle omega t at the time t.

    The angle of the pieces differs from omega t by at most the error, at every time in the span;
    so a point at a distance r from the pivot is at most r times the error from where it should be.
    Before the span the body does not turn, nor after it.

    >>> wheel = Spin(2, (1, 1), time=(0, 10), error="1/1000")
    >>> len(wheel.pieces), wheel.error
    (88, Fraction(1, 1000))

    Args:
        omega: the angle by which the body turns in one unit of time, in radians, counter-clockwise.
        pivot: the centre of rotation.
        time: the start and the end of the span.
        error: the largest error of the angle, in radians. Pieces have a half turn of degree 1
            for errors from about 2 10^-6 on, of higher degrees for smaller ones.
        degree: the degree of the half turns, 1, 3, 5, ..., in place of the one chosen by the error.
        x: a translation, as in `Translation`, applied last.
        y: likewise.

    Attributes:
        angle: omega t, a polynomial.

    Raises:
        InputError: if an argument is invalid, or more than 100,000 pieces are needed.
    """

    __slots__ = ("angle", "exact_error", "exact_omega")

    def __init__(
        self,
        omega: Rational,
        pivot: Sequence[Rational] = (0, 0),
        *,
        time: Sequence[Rational],
        error: Rational = "1/1000000",
        degree: int | None = None,
        x: Coefficients = ZERO,
        y: Coefficients = ZERO,
    ) -> None:
        if degree is not None and not (type(degree) is int and degree in _DEGREES):
            raise InputError(f"the degree of a half turn is odd, from 1 to 31: {shorten(degree)}")
        rate, most = _rates(omega, error)
        start, end = rationals(time, 2, "a span has a start and an end")
        if start >= end:
            raise InputError(f"a span ends after it starts: {show(start)}, then {show(end)}")
        bits_for(most, rate * max(abs(start), abs(end)))  # raises if the error is too small
        degree, step = _first_try(rate, most, end - start, degree)
        while True:
            turns = _Turns(rate, most, degree).between(start, end, step)
            pieces: list[tuple[Rational | None, SimpleMotion]] = [
                (until, Rigid(half, pivot=pivot, x=x, y=y, orientation=turned))
                for until, half, turned in turns
            ]
            super().__init__(pieces)
            if is_within(self, rate, most):
                break
            step /= 2
        self._hold(rate, most)

    def _hold(self, omega: QQ, error: QQ) -> None:
        self.exact_omega, self.exact_error = omega, error
        self.angle = Polynomial([0, omega])

    @classmethod
    def of_pieces(
        cls,
        pieces: Sequence[tuple[Rational | None, SimpleMotion]],
        omega: Rational,
        error: Rational,
    ) -> Spin:
        """Return the spin that consists of given pieces, after a proof that it is one.

        Args:
            pieces: as for `Pieces`: rigid motions, the first and the last without a turn.
            omega: see `Spin`.
            error: see `Spin`.

        Raises:
            InputError: if their angle differs from omega t by more than the error.
        """
        self = cls.__new__(cls)
        Pieces.__init__(self, pieces)
        rate, most = _rates(omega, error)
        if not is_within(self, rate, most):
            raise InputError(f"the pieces do not turn by {show(rate)} t within {show(most)}")
        self._hold(rate, most)
        return self

    @property
    def omega(self) -> Fraction:
        """The angle by which the body turns in one unit of time, in radians."""
        return fraction(self.exact_omega)

    @property
    def pivot(self) -> tuple[Fraction, Fraction]:
        """The centre of rotation."""
        turn = next(turn for turn in self.motions if isinstance(turn, Rigid))
        return turn.pivot

    @property
    def error(self) -> Fraction:
        """The largest error of the angle, in radians."""
        return fraction(self.exact_error)

    @property
    def pieces(self) -> tuple[tuple[Fraction | None, SimpleMotion], ...]:
        """The motions, each with the time until which it holds."""
        return tuple(zip((*self.until, None), self.motions, strict=True))

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        (pieces,), _ = super()._given()
        return (pieces, str(self.exact_omega), str(self.exact_error)), {}

    def __reduce__(self) -> tuple[object, ...]:
        return Spin.of_pieces, self._given()[0]

    def __repr__(self) -> str:
        span = str(self.exact_until[0]), str(self.exact_until[-1])
        return call_in_brief("Spin", str(self.exact_omega), time=span, error=str(self.exact_error))


def _rates(omega: Rational, error: Rational) -> tuple[QQ, QQ]:
    rate, most = rational(omega), rational(error)
    if most <= 0:
        raise InputError(f"an error is positive: {show(most)}")
    return rate, most


def _radians(degree: int, error: QQ) -> float:
    """Return an estimate of the largest angle of a piece.

    With the beginning of the Taylor series of the tangent as half turn, and its last coefficient
    chosen for the end of the piece, the angle is off by about 0.77 c (a / 2)^(d + 2) for a
    piece of a radians and the degree d, where c = 2 (2 / pi)^(d + 3) is the next coefficient. At
    most half the error is left for it.
    """
    scale = math.log2(1.54) + (degree + 3) * math.log2(2 / math.pi) - (degree + 2)
    return min(1.5, math.exp2((exponent(error) - 2 - scale) / (degree + 2)))


def _first_try(omega: QQ, error: QQ, span: QQ, given: int | None) -> tuple[int, QQ]:
    """Return a degree, the given one if any, and a duration that is likely to be short enough."""
    degree = 1 if given is None else given
    while (radians := _radians(degree, error)) < _SHORTEST and given is None:
        degree += 2
    if abs(omega) * span <= rational(radians):
        return degree, span
    step = rational(radians) / abs(omega)
    unit = power_of_two(exponent(step) - 3)  # times with few digits
    step = max(floor(step / unit), 1) * unit
    if span / step > _MOST:
        raise InputError(f"more than {_MOST} pieces are needed for {show(omega * span)} radians")
    return degree, step


@final
class _Turns:
    """Pieces of a turn, with half turns of a degree; no proof."""

    def __init__(self, omega: QQ, error: QQ, degree: int) -> None:
        self.omega = omega
        self.error = error
        tangent = [QQ(0), QQ(1)]  # its Taylor series, by tan' = 1 + tan^2
        while len(tangent) < degree:
            k = len(tangent)
            tangent.append(sum((tangent[i] * tangent[k - 1 - i] for i in range(k)), QQ(0)) / k)
        self.tangent = tangent[:degree]
        self._known: dict[QQ, list[QQ]] = {}

    def between(self, start: QQ, end: QQ, step: QQ) -> list[tuple[QQ | None, Polynomial, Vector]]:
        """Until when, half turn and orientation of each piece."""
        a, u = start, vector_near(self.omega * start, self.error)
        turns: list[tuple[QQ | None, Polynomial, Vector]] = [(start, ZERO, u)]
        while a < end:
            check_budget()
            b = min(a + step, end)
            v = vector_near(self.omega * b, self.error)
            turns.append((b, self._half_turn(a, b, u, v), u))
            a, u = b, v
        return [*turns, (None, ZERO, u)]

    def _half_turn(self, a: QQ, b: QQ, u: Vector, v: Vector) -> Polynomial:
        """Return the half turn that is 0 at a, and leads from u to v at b."""
        series = self._series(b - a)
        whole = (u[0] * v[1] - u[1] * v[0]) / (1 + u[0] * v[0] + u[1] * v[1])
        last = whole - sum(series, QQ(0))
        return Polynomial.exact_from([*series, last])(Polynomial([-a / (b - a), 1 / (b - a)]))

    def _series(self, duration: QQ) -> list[QQ]:
        """Return the coefficients of the tangent, but for the last, of the part of a duration."""
        known = self._known.get(duration)
        if known is None:
            half, bits = self.omega * duration / 2, bits_for(self.error, QQ(0))
            known = [rounded(c * half**k, bits) for k, c in enumerate(self.tangent)]
            self._known[duration] = known
        return known
