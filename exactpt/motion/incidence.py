"""Incidences of a vertex with an edge or a vertex, decided exactly at an algebraic time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, subtract, trimmed
from exactpt.kernel.packed import unpack, width_for
from exactpt.motion.track import Track


class Touch(NamedTuple):
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


def vertex_touch(body: int, vertex: int, other: int, other_vertex: int) -> Touch:
    """Return the incidence of two vertices, that of the lower body first."""
    if other < body:
        return Touch(other, other_vertex, body, -1, vertex)
    return Touch(body, vertex, other, -1, other_vertex)


def renumbered(touches: Iterable[Touch], first: int, second: int) -> set[Touch]:
    """Incidences of the bodies 0 and 1, of two vertices once, with other numbers of the bodies."""
    two = first, second
    return {
        Touch(two[i], v, two[j], edge, -1) if edge >= 0 else vertex_touch(two[i], v, two[j], w)
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
