"""Directions in which two bodies that touch vertex on vertex are pushed apart.

Let v be a vertex of A in the place of a vertex w of B, and r its velocity relative to w: v came
from -r, so -r leads out of B, and r out of A.

If the exterior of B at w, where -r is, is an angle below pi, w is an inner corner: v must keep to
the right side of both edges, so there are two directions, the normals of these. Likewise if v is
an inner corner of A. Otherwise a line through the point separates the bodies, and one direction
is enough: a normal n of such a line with n . -r > 0, so that A is on the side to which it is
pushed. The line between the centers of the bodies is taken if it is such a normal, then -r, then
the normal of an edge.

All is in doubles: a response is a choice; whether the bodies separate is decided by the run.
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.motion.body import Body

Vector: TypeAlias = tuple[float, float]

TINY: Final = 1e-9
"""Sine of the angle by which a line may cut into a body: rounding is less."""


def normals_at(
    first: tuple[Body, int], second: tuple[Body, int], velocity: Vector, t: QQ
) -> list[Vector]:
    """Return unit vectors that push the first of two vertices off the second.

    Args:
        first: a body and the index of its vertex.
        second: another body and the index of its vertex, in the same place at the time, or nearly.
        velocity: of the first vertex relative to the second.
        t: the time.
    """
    a, b = _edges_at(*first, t), _edges_at(*second, t)
    center = _between_centers(first[0], second[0], t)
    back = _unit(-velocity[0], -velocity[1]) or center
    inner = _inner_corner(b, back) or [(-x, -y) for x, y in _inner_corner(a, (-back[0], -back[1]))]
    if inner:
        return inner
    edges = [*b, *((-x, -y) for x, y in a)]
    sides = [n for x, y in edges for n in ((y, -x), (-y, x))]
    fit = [n for n in (center, back, *sides) if all(_dot(n, e) <= TINY for e in edges)]
    if fit and _dot(center, back) > TINY and fit[0] == center:
        return [center]
    return [max(fit, key=lambda n: _dot(n, back), default=back)]


def _inner_corner(edges: list[Vector], inside: Vector) -> list[Vector]:
    """Return the normals of two edges towards a direction in their angle below pi."""
    if len(edges) != 2:
        return []
    e, f = edges if _cross(*edges) > 0 else edges[::-1]
    if _cross(e, f) <= TINY or _cross(e, inside) < -TINY or _cross(inside, f) < -TINY:
        return []
    return [(-e[1], e[0]), (f[1], -f[0])]


def _edges_at(body: Body, vertex: int, t: QQ) -> list[Vector]:
    """Return the directions of the edges at a vertex."""
    points = body.exact_at(t)
    (x, y) = points[vertex]
    ends = [points[j if i == vertex else i] for i, j in body.edges if vertex in (i, j)]
    return [u for p, q in ends if (u := _direction(p - x, q - y)) is not None]


def _between_centers(a: Body, b: Body, t: QQ) -> Vector:
    """Return the direction from the centroid of the vertices of b to that of a."""
    (ax, ay), (bx, by) = (
        [sum((p[k] for p in body.exact_at(t)), QQ(0)) / body.size for k in (0, 1)]
        for body in (a, b)
    )
    return _direction(ax - bx, ay - by) or (1.0, 0.0)


def _direction(x: QQ, y: QQ) -> Vector | None:
    size = max(abs(x), abs(y))
    return _unit(nearest_float(x / size), nearest_float(y / size)) if size else None


def _unit(x: float, y: float) -> Vector | None:
    length = math.hypot(x, y)
    return (x / length, y / length) if length else None


def _dot(u: Vector, v: Vector) -> float:
    return u[0] * v[0] + u[1] * v[1]


def _cross(u: Vector, v: Vector) -> float:
    return u[0] * v[1] - u[1] * v[0]
