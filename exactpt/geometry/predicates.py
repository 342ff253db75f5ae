"""Predicates of points.

`orient2d` uses + - * only, so it works over any ring: over the rationals it is a static
predicate, over polynomials in t the function of a certificate. (Certificates themselves
take it from homogeneous coordinates, `exactpt.motion.track.orientation_polynomial`.)
"""

from __future__ import annotations

from typing import Protocol, Self, TypeVar

from exactpt.kernel.numbers import QQ, sign


class Ring(Protocol):
    """The operations that `orient2d` needs on coordinates: no division, no comparison."""

    def __add__(self, other: Self, /) -> Self: ...
    def __sub__(self, other: Self, /) -> Self: ...
    def __mul__(self, other: Self, /) -> Self: ...


R = TypeVar("R", bound=Ring)

Point = tuple[QQ, QQ]
"""A point with rational coordinates."""


def orient2d(a: tuple[R, R], b: tuple[R, R], c: tuple[R, R]) -> R:
    """Return twice the signed area of the triangle abc.

    Positive if a, b, c turn left (counter-clockwise), negative if they turn right,
    zero if they are collinear.
    """
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def orientation(a: Point, b: Point, c: Point) -> int:
    """1, 0 or -1 as c lies left of, on, or right of the line from a to b."""
    return sign(orient2d(a, b, c))


def crossing_of_lines(a: Point, b: Point, c: Point, d: Point) -> Point:
    """Return the common point of two lines ab and cd that are not parallel."""
    ux, uy = b[0] - a[0], b[1] - a[1]
    vx, vy = d[0] - c[0], d[1] - c[1]
    wx, wy = c[0] - a[0], c[1] - a[1]
    share = (wx * vy - wy * vx) / (ux * vy - uy * vx)
    return a[0] + share * ux, a[1] + share * uy


def is_left_of_path(before: Point, at: Point, after: Point, p: Point) -> bool:
    """Return True if p, seen from the middle of a path of three points, is on its left.

    The point p is on neither of the two rays from the middle through the ends of the path.
    """
    first, second = orientation(before, at, p) > 0, orientation(at, after, p) > 0
    return first and second if orientation(before, at, after) > 0 else first or second


def in_triangle(p: Point, a: Point, b: Point, c: Point) -> bool:
    """Return True if p is in the closed triangle abc, which is counter-clockwise."""
    return orientation(a, b, p) >= 0 and orientation(b, c, p) >= 0 and orientation(c, a, p) >= 0


def between(a: Point, b: Point, c: Point) -> bool:
    """Return True if c lies in the closed segment ab, if it is on the line ab (or if a = b)."""
    return all(min(u, v) <= w <= max(u, v) for u, v, w in zip(a, b, c, strict=True))
