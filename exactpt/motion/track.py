"""Trajectories: the position of one vertex over time, in homogeneous integer polynomials."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from fractions import Fraction
from typing import Final, NamedTuple, final

from exactpt.kernel.integer_polynomial import IntPoly, derivative, evaluate
from exactpt.kernel.numbers import QQ, ZZ, Rational, gcd, place, rational
from exactpt.kernel.packed import coefficient_bits, pack
from exactpt.kernel.polynomial import Polynomial

_ONE: Final = ZZ(1)


class Turning(NamedTuple):
    """The identity of a rigid motion that turns.

    Attributes:
        half_turn: the tangent of half the angle.
        x, y: the path of the pivot.
    """

    half_turn: Polynomial
    x: Polynomial
    y: Polynomial


@final
class Track:
    """The trajectory (x / w, y / w) of a vertex, with integer polynomials x, y, w in t.

    Internal to the package: its integers are gmpy2's.

    Attributes:
        x, y: numerators.
        w: their denominator, positive at every time; a constant unless the body turns.
        motion: the identity of the rigid motion. Trajectories with equal ``motion`` keep
            their distances for all times: they translate together, or (if w is not constant)
            turn together. ``None`` is equal to nothing.
        length: the maximum number of coefficients of x, y and w.
    """

    __slots__ = ("_bits", "_packed", "length", "motion", "w", "x", "y")

    def __init__(self, x: IntPoly, y: IntPoly, w: IntPoly, motion: Hashable) -> None:
        self.x = x
        self.y = y
        self.w = w
        self.motion = motion
        self.length: int = max(len(x), len(y), len(w))
        self._bits: int = -1
        # One tuple with its width, read at once: other threads may share the trajectory.
        self._packed: tuple[int, tuple[ZZ, ZZ, ZZ]] = (0, (ZZ(0), ZZ(0), ZZ(0)))

    @property
    def bits(self) -> int:
        """The bit length of the largest coefficient."""
        if self._bits < 0:
            self._bits = coefficient_bits(self.x, self.y, self.w)
        return self._bits

    def packed(self, width: int) -> tuple[ZZ, ZZ, ZZ]:
        """x, y and w as integers (`exactpt.kernel.packed`), cached for the last width."""
        kept, packed = self._packed
        if kept != width:
            packed = (pack(self.x, width), pack(self.y, width), pack(self.w, width))
            self._packed = width, packed
        return packed

    def at(self, t: Rational) -> tuple[Fraction, Fraction]:
        """Return the exact position at a rational time."""
        return place(self._at(rational(t)))

    def _at(self, t: QQ) -> tuple[QQ, QQ]:
        if not t:
            w = self.w[0]
            return QQ(self.x[0] if self.x else 0, w), QQ(self.y[0] if self.y else 0, w)
        if len(self.w) == 1:
            return evaluate(self.x, t) / self.w[0], evaluate(self.y, t) / self.w[0]
        at_t = evaluate(self.w, t)
        return evaluate(self.x, t) / at_t, evaluate(self.y, t) / at_t

    def velocity(self, t: QQ) -> tuple[QQ, QQ]:
        """Return the derivative of the position."""
        w, dw = evaluate(self.w, t), evaluate(derivative(self.w), t)
        x, y = (
            (evaluate(derivative(f), t) * w - evaluate(f, t) * dw) / (w * w)
            for f in (self.x, self.y)
        )
        return x, y

    def __repr__(self) -> str:
        return f"Track({self.x}, {self.y}, {self.w})"


def track(x: Polynomial, y: Polynomial, w: Polynomial | None, turning: Hashable) -> Track:
    """Return the trajectory (x / w, y / w) with integer coefficients; ``w`` None stands for 1.

    ``turning`` identifies the motion of a vertex that turns.
    """
    if w is None:
        return translated(x._coefficients, y._coefficients)
    parts = (x._coefficients, y._coefficients, w._coefficients)
    denominator = _denominator(parts)
    a, b, c = (_times(denominator, part) for part in parts)
    return Track(a, b, c, turning)


def translated(x: tuple[QQ, ...], y: tuple[QQ, ...]) -> Track:
    """Return the trajectory of a vertex that only translates.

    Its motion is identified by the coefficients of t, t^2, ...
    """
    denominator = _denominator((x, y))
    motion = (x[1:], y[1:])
    return Track(_times(denominator, x), _times(denominator, y), (denominator,), motion)


def _denominator(parts: Iterable[tuple[QQ, ...]]) -> ZZ:
    """Return the least common denominator of all coefficients."""
    common = _ONE
    for part in parts:
        for c in part:
            d = c.denominator
            if d != 1 and common % d:
                common = _lcm(common, ZZ(d))
    return common


def _times(denominator: ZZ, part: tuple[QQ, ...]) -> IntPoly:
    if denominator == 1:
        return tuple([ZZ(c.numerator) for c in part])
    return tuple([ZZ(c.numerator) * (denominator // c.denominator) for c in part])


def _lcm(a: ZZ, b: ZZ) -> ZZ:
    return a * (b // gcd(a, b))
