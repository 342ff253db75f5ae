"""Polynomials whose signs are the predicates of points that move along polynomials."""

from __future__ import annotations

from typing import TypeAlias

from exactpt.kernel.polynomial import Polynomial

MovingPoint: TypeAlias = tuple[Polynomial, Polynomial]
"""The coordinates x and y of a point over time."""


def x_order(p: MovingPoint, q: MovingPoint) -> Polynomial:
    """Positive where p is left of q: the difference of their x coordinates."""
    return q[0] - p[0]


def orientation(p: MovingPoint, q: MovingPoint, r: MovingPoint) -> Polynomial:
    """Positive where p, q, r turn left: twice the signed area of their triangle."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def squared_distance(p: MovingPoint, q: MovingPoint) -> Polynomial:
    """Return the square of the distance of p and q."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    return dx * dx + dy * dy
