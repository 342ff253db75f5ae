"""Trajectories: the position of one vertex over time, in homogeneous integer polynomials."""

from __future__ import annotations

from collections.abc import Hashable
from fractions import Fraction
from typing import NamedTuple, final

from exactpt.kernel.integer_polynomial import IntPoly, evaluate
from exactpt.kernel.numbers import QQ, ZZ, Rational, gcd, place, rational
from exactpt.kernel.packed import coefficient_bits, pack
from exactpt.kernel.polynomial import Polynomial

__all__ = ["Track", "Turning", "track"]


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
            their distances for ever: they translate together, or (if w is not constant)
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
        """The exact position at a rational time."""
        return place(self._at(rational(t)))

    def _at(self, t: QQ) -> tuple[QQ, QQ]:
        if len(self.w) == 1:
            return evaluate(self.x, t) / self.w[0], evaluate(self.y, t) / self.w[0]
        w = evaluate(self.w, t)
        return evaluate(self.x, t) / w, evaluate(self.y, t) / w

    def __repr__(self) -> str:
        return f"Track({self.x}, {self.y}, {self.w})"


def track(x: Polynomial, y: Polynomial, w: Polynomial | None, turning: Hashable) -> Track:
    """The trajectory (x / w, y / w) with integer coefficients; ``w`` None stands for 1.

    ``turning`` identifies the motion of a vertex that turns; the motion of a vertex that
    only translates is identified by its coefficients of t, t^2, ...
    """
    if w is None:
        motion: Hashable = (x._coefficients[1:], y._coefficients[1:])
        parts = [x._coefficients, y._coefficients]
    else:
        motion = turning
        parts = [x._coefficients, y._coefficients, w._coefficients]
    denominator = ZZ(1)
    for part in parts:
        for c in part:
            if denominator % c.denominator:
                denominator = _lcm(denominator, ZZ(c.denominator))
    scaled = [
        tuple([ZZ(c.numerator) * (denominator // c.denominator) for c in part]) for part in parts
    ]
    return Track(scaled[0], scaled[1], scaled[2] if w is not None else (denominator,), motion)


def _lcm(a: ZZ, b: ZZ) -> ZZ:
    return a * (b // gcd(a, b))
