"""A ray through a subdivision, from face to face, in exact arithmetic.

A point of the ray is in a face, on an edge or at a node, and each of the three cases determines
how the ray continues. Rays through vertices, along edges and along straight chains are thus no
exceptions; every decision is the sign of a rational, which doubles decide within a bound.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Final, NamedTuple, final

from mypy_extensions import i64

from exactpt.geometry.predicates import Point
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.kernel.numbers import QQ, nearest_float, sign
from exactpt.kernel.rounding import SLACK, TINY, U
from exactpt.planar.halfedge import twin
from exactpt.query.subdivision import OUTSIDE, Subdivision, cross

_LARGEST: Final = 2.0**500


class On(Enum):
    """The type of cell that contains a point."""

    FACE = "face"
    EDGE = "edge"
    NODE = "node"


class Spot(NamedTuple):
    """The cell of the subdivision that contains a point.

    Attributes:
        on: the interior of a face, the interior of an edge, or a node.
        handle: the face; a half-edge of the edge; or the node.
    """

    on: On
    handle: i64


class RayStep(NamedTuple):
    """A maximal part of a ray within one face or along one edge.

    Attributes:
        through: the face, or the half-edge in the direction of the ray, that contains the
            interior of the step.
        end: the edge or the node that contains its end; None if the step is unbounded.
    """

    through: Spot
    end: Spot | None


@final
class Ray:
    """The points origin + s * direction, s >= 0; the direction is not (0, 0)."""

    __slots__ = (
        "_near",
        "_nodes",
        "_norm",
        "_off",
        "_plane",
        "_points",
        "direction",
        "origin",
        "sides",
    )

    def __init__(self, plane: Subdivision, origin: Point, direction: Point) -> None:
        self.origin = origin
        self.direction = direction
        self._norm = direction[0] * direction[0] + direction[1] * direction[1]
        self._plane, self._points = plane, plane.points
        self.sides: dict[VertexId, int] = {}
        self._nodes = nodes = plane.nodes
        ox, oy = nodes.of(origin)
        dx, dy = nearest_float(direction[0]), nearest_float(direction[1])
        self._near = ox, oy, dx, dy
        size = max(nodes.size, abs(ox), abs(oy))
        in_range = size < _LARGEST and abs(dx) < _LARGEST and abs(dy) < _LARGEST
        self._off = 5.0 * U * size * (abs(dx) + abs(dy)) if in_range else math.inf

    def side(self, node: VertexId) -> int:
        """1, 0 or -1 if a node is to the left of, on, or to the right of the line of the ray."""
        known = self.sides.get(node)
        if known is None:
            known = self.sides[node] = self._filtered_side(node) or self._exact_side(node)
        return known

    def _filtered_side(self, node: VertexId) -> int:
        """Return the side of a node by doubles; 0 if they do not decide it.

        Let M be the largest size of a coordinate of a node or of the origin, as doubles. Each is
        off by at most U M (1 + 2U), as a nearest double, and a difference of two, of size at most
        2 M, by U of it more: by less than 5 U M. The direction is off by U of itself. So a product
        p of a coordinate of the direction d and such a difference is off by less than
        5 U M |d| + 4 U |p|, its own rounding included, and the difference of two products by
        U (|p| + |q|) more. SLACK covers terms of second order, TINY underflow, since all numbers
        are below 2^500.
        """
        ox, oy, dx, dy = self._near
        p, q = dx * (self._nodes.ys[node] - oy), dy * (self._nodes.xs[node] - ox)
        bound = (self._off + 5.0 * U * (abs(p) + abs(q))) * SLACK + TINY
        return 1 if p - q > bound else -1 if p - q < -bound else 0

    def _exact_side(self, node: VertexId) -> int:
        (x, y), (ox, oy), (dx, dy) = self._points[node], self.origin, self.direction
        return sign(dx * (y - oy) - dy * (x - ox))

    def parameter(self, spot: Spot) -> QQ:
        """Return the parameter at a node of the ray, or an edge not parallel to it; 0 in a face."""
        if spot.on is On.FACE:
            return QQ(0)
        if spot.on is On.NODE:
            return self.reaches(VertexId(spot.handle))
        origin = self._plane.map.origin
        return self.crosses(origin[spot.handle], origin[spot.handle ^ 1])

    def reaches(self, node: VertexId) -> QQ:
        """Return the parameter of a node on the line of the ray."""
        (x, y), (ox, oy), (dx, dy) = self._points[node], self.origin, self.direction
        return ((x - ox) * dx + (y - oy) * dy) / self._norm

    def crosses(self, u: VertexId, v: VertexId) -> QQ:
        """Return the parameter at which the line of the ray crosses the edge from u to v."""
        a, b = self._points[u], self._points[v]
        along = b[0] - a[0], b[1] - a[1]
        return cross((a[0] - self.origin[0], a[1] - self.origin[1]), along) / cross(
            self.direction, along
        )

    def point(self, at: QQ) -> Point:
        """Return the point with parameter ``at``."""
        return (
            self.origin[0] + at * self.direction[0],
            self.origin[1] + at * self.direction[1],
        )


def next_step(plane: Subdivision, ray: Ray, spot: Spot) -> RayStep:
    """Return the step of a ray that starts at a spot of it; in a face, at its origin."""
    if spot.on is On.FACE:
        return _through_face(plane, ray, spot.handle, spot)
    if spot.on is On.EDGE:
        h = HalfEdge(spot.handle)
        # The ray has a point of the edge, whose target is on the side `side` of it.
        turn = -ray.side(plane.map.target(h))
        if turn == 0:
            return _along(plane, h if _ahead(plane, ray, h) else twin(h))
        h = h if turn > 0 else twin(h)
        return _through_face(plane, ray, plane.face[h], spot, h)
    h, along = _sector(plane, ray, VertexId(spot.handle))
    if along:
        return _along(plane, h)
    return _through_face(plane, ray, plane.face[h], spot)


def _ahead(plane: Subdivision, ray: Ray, h: HalfEdge) -> bool:
    """Return True if a half-edge on the line of the ray has the direction of the ray."""
    (x, y), (dx, dy) = plane.direction(h), ray.direction
    return x * dx + y * dy > 0


def _along(plane: Subdivision, h: HalfEdge) -> RayStep:
    return RayStep(Spot(On.EDGE, h), Spot(On.NODE, plane.map.target(h)))


def _sector(plane: Subdivision, ray: Ray, node: VertexId) -> tuple[HalfEdge, bool]:
    """Return the half-edge whose sector contains the direction, and if it is parallel.

    The sector of h lies between h and the next half-edge counter-clockwise: the corner of the
    face on the left of h.
    """
    star = plane.map.star(plane.out[node])
    turns = [-ray.side(plane.map.target(h)) for h in star]  # the ray contains the node
    for h, turn in zip(star, turns, strict=True):
        if turn == 0 and _ahead(plane, ray, h):
            return h, True
    for i, h in enumerate(star):
        # The direction is left of h and right of g, or the sector is wider than pi.
        g, after = star[(i + 1) % len(star)], turns[(i + 1) % len(star)]
        wide = len(star) == 1 or cross(plane.direction(h), plane.direction(g)) <= 0
        inside = (turns[i] > 0 or after < 0) if wide else (turns[i] > 0 and after < 0)
        if inside or len(star) == 1:
            return h, False
    return star[0], False


def _through_face(
    plane: Subdivision, ray: Ray, face: int, since: Spot, entry: HalfEdge = NO_HALF_EDGE
) -> RayStep:
    """Return the step through a face from a spot on, perhaps from its entry edge.

    From the interior of an edge a ray enters a bounded face, and leaves it: there is one end at
    least, and parameters are compared only if there are several.
    """
    following, origin, sides = plane.map.following, plane.map.origin, ray.sides
    ends: list[Spot] = []
    for first in plane.cycles[face]:
        h, s = first, ray.side(origin[first])
        while True:
            v = origin[h ^ 1]
            t = sides[v] if v in sides else ray.side(v)
            if s == 0:
                ends.append(Spot(On.NODE, origin[h]))
            elif s * t < 0 and h != entry:
                ends.append(Spot(On.EDGE, h))
            h, s = following[h], t
            if h == first:
                break
    through = Spot(On.FACE, face)
    if len(ends) == 1 and entry != NO_HALF_EDGE and face != OUTSIDE:
        return RayStep(through, ends[0])
    at = ray.parameter(since)
    later = [(when, k) for k, end in enumerate(ends) if (when := ray.parameter(end)) > at]
    return RayStep(through, ends[min(later)[1]] if later else None)
