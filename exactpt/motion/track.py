"""Trajectories: the position of one vertex over time, in homogeneous integer polynomials.

Incidences of a vertex with an edge or a vertex are decided exactly at an algebraic time.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from fractions import Fraction
from typing import Final, NamedTuple, final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    add,
    coefficient_bits,
    derivative,
    evaluate,
    multiply,
    pack,
    subtract,
    trimmed,
    unpack,
    width_for,
)
from exactpt.kernel.numbers import QQ, ZZ, Rational, gcd, place, rational
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
        """x, y and w as integers (see `pack`), cached for the last width."""
        kept, packed = self._packed
        if kept != width:
            packed = (pack(self.x, width), pack(self.y, width), pack(self.w, width))
            self._packed = width, packed
        return packed

    def at(self, t: Rational) -> tuple[Fraction, Fraction]:
        """Return the exact position at a rational time."""
        return place(self.exact_at(rational(t)))

    def exact_at(self, t: QQ) -> tuple[QQ, QQ]:
        """Return the place at a time as rationals of GMP."""
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
        return translated(x.exact_coefficients, y.exact_coefficients)
    parts = (x.exact_coefficients, y.exact_coefficients, w.exact_coefficients)
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


# Incidences


class Incidence(NamedTuple):
    """A vertex on an edge, or on a vertex, numbered as in the scene.

    Attributes:
        body, vertex: the vertex.
        other: the body it touches.
        edge: the edge of ``other``, or -1.
        other_vertex: the vertex of ``other``, or -1.
    """

    body: int
    vertex: int
    other: int
    edge: int
    other_vertex: int


def vertex_touch(body: int, vertex: int, other: int, other_vertex: int) -> Incidence:
    """Return the incidence of two vertices, that of the lower body first."""
    if other < body:
        return Incidence(other, other_vertex, body, -1, vertex)
    return Incidence(body, vertex, other, -1, other_vertex)


def renumbered(touches: Iterable[Incidence], first: int, second: int) -> set[Incidence]:
    """Incidences of the bodies 0 and 1, of two vertices once, with other numbers of the bodies."""
    two = first, second
    return {
        Incidence(two[i], v, two[j], edge, -1) if edge >= 0 else vertex_touch(two[i], v, two[j], w)
        for i, v, j, edge, w in touches
    }


def difference(p: IntPoly, pw: IntPoly, q: IntPoly, qw: IntPoly) -> IntPoly:
    """q pw - p qw: a positive multiple of q / qw - p / pw."""
    if len(pw) == len(qw) == 1 and len(p) == len(q):
        v, w = pw[0], qw[0]
        return trimmed([b * v - a * w for a, b in zip(p, q, strict=True)])
    return subtract(multiply(q, pw), multiply(p, qw))


def vector(a: Track, b: Track) -> tuple[IntPoly, IntPoly]:
    """Return the vector from a to b, times a positive factor."""
    return difference(a.x, a.w, b.x, b.w), difference(a.y, a.w, b.y, b.w)


def dot(u: tuple[IntPoly, IntPoly], v: tuple[IntPoly, IntPoly]) -> IntPoly:
    """Return the scalar product of two vectors."""
    return add(multiply(u[0], v[0]), multiply(u[1], v[1]))


def orientation_polynomial(a: Track, b: Track, c: Track) -> IntPoly:
    """Return a positive multiple of the orientation of three trajectories.

    It is the determinant of the rows (x, y, w), positive where a, b, c turn left.
    """
    length = a.length + b.length + c.length - 2
    width = width_for(a.bits + b.bits + c.bits, length, 3)
    ax, ay, aw = a.packed(width)
    bx, by, bw = b.packed(width)
    cx, cy, cw = c.packed(width)
    f = ax * (by * cw - cy * bw) + bx * (cy * aw - ay * cw) + cx * (ay * bw - by * aw)
    return unpack(f, width, length)


def coincide(a: Track, b: Track, t: AlgebraicNumber) -> bool:
    """Return True if two vertices coincide."""
    return (
        t.sign_of(difference(a.x, a.w, b.x, b.w)) == 0
        and t.sign_of(difference(a.y, a.w, b.y, b.w)) == 0
    )


def lies_on(v: Track, a: Track, b: Track, t: AlgebraicNumber) -> bool:
    """Return True if v is in the closed segment ab: on its line, and (a - v) . (b - v) <= 0."""
    if t.sign_of(orientation_polynomial(a, b, v)) != 0:
        return False
    along = dot(vector(v, a), vector(v, b))
    # Both products have the denominator w(v)^2 w(a) w(b).
    return t.sign_of(along) <= 0
