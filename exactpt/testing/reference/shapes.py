"""Two bodies at one rational time: common points, points inside, distances of features.

Everything is a sign or a rational function of coordinates; every edge is compared with every edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import TypeAlias

from exactpt.geometry.predicates import Point, between, orient2d, orientation
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body

Points: TypeAlias = Sequence[Point]
"""The vertices of a body at one time, numbered as in the body."""


def edges_of(body: Body) -> list[tuple[int, int]]:
    """Return the edges as pairs of vertices; a point is an edge from itself to itself."""
    return body.edges or [(0, 0)]


def is_on_segment(v: Point, a: Point, b: Point) -> bool:
    """Return True if v is in the closed segment ab."""
    return orientation(a, b, v) == 0 and between(a, b, v)


def segments_cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return True if the segments ab and cd have one common point, an inner point of both."""
    return (
        orientation(a, b, c) * orientation(a, b, d) < 0
        and orientation(c, d, a) * orientation(c, d, b) < 0
    )


def segments_meet(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return True if the closed segments ab and cd share a point."""
    c_side, d_side = orientation(a, b, c), orientation(a, b, d)
    a_side, b_side = orientation(c, d, a), orientation(c, d, b)
    if c_side * d_side < 0 and a_side * b_side < 0:
        return True
    return (
        (c_side == 0 and between(a, b, c))
        or (d_side == 0 and between(a, b, d))
        or (a_side == 0 and between(c, d, a))
        or (b_side == 0 and between(c, d, b))
    )


def is_inside(v: Point, body: Body, p: Points) -> bool:
    """Return True if a point that is on no edge of a body is in its interior.

    The edges that a ray to the right crosses are counted. The count is odd in an outline and even
    in a hole of it.
    """
    crossed = 0
    for i, j in body.edges:
        a, b = p[i], p[j]
        if (a[1] > v[1]) != (b[1] > v[1]):
            lower, upper = (a, b) if a[1] < b[1] else (b, a)
            crossed += orient2d(lower, upper, v) > 0
    return body.has_interior and crossed % 2 == 1


def bodies_meet(a: Body, p: Points, b: Body, q: Points) -> bool:
    """Return True if two bodies share a point; bodies without radii, or the cores of others."""
    if any(
        segments_meet(p[i], p[j], q[k], q[l])
        for (i, j), (k, l) in product(edges_of(a), edges_of(b))
    ):
        return True
    return any(is_inside(p[ring.start], b, q) for ring in a.rings) or any(
        is_inside(q[ring.start], a, p) for ring in b.rings
    )


def squared_distance(u: Point, v: Point) -> QQ:
    """Return the squared distance of two points."""
    return (v[0] - u[0]) ** 2 + (v[1] - u[1]) ** 2


def squared_to_interior(v: Point, a: Point, b: Point) -> QQ | None:
    """Return the squared distance of v from its foot on the line ab.

    None if the foot is not an inner point of the segment.
    """
    length = squared_distance(a, b)
    if length == 0:
        return None
    along = (v[0] - a[0]) * (b[0] - a[0]) + (v[1] - a[1]) * (b[1] - a[1])
    if not 0 < along < length:
        return None
    return orient2d(a, b, v) ** 2 / length
