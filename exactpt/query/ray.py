"""A ray in a subdivision: on which side of it nodes are, and where it crosses edges.

Doubles are those of `exactpt.query.nodes`. Let M be the largest size of a coordinate of a node or
of the origin, as doubles, and S = |dx| + |dy| that of the direction. A nearest double is off by U
of itself.

The side of a node is the sign of v = (dx y - dy x) - c, where c = dx oy - dy ox. A product is off
by 3 U of its size: its two factors and its own rounding; so each of the two differences of products
is off by 3 U M S, and by U M S more for its rounding; the difference of both, of size 2 M S, by
2 U M S. In all, v is off by less than B = 10 U M S.

The place along the ray at which it crosses the edge from a to b, where v has the values p and q of
opposite signs, is t = dx (x - ox) + dy (y - oy) with x = ax + w (bx - ax), w = p / (p - q): the
parameter times the square of the length of the direction. A partial derivative of w is at most
1 / |p - q| in all, so w is off by B / g, g = |p - q| - 2 B, and by 3 U for its rounding. With the
errors of the coordinates (U M) and of the operations on numbers of size 2 M, x - ox is off by less
than (B / g) |bx - ax| + 20 U M. So t, with 8 U M S for its own operations and the direction, is off
by less than S (B / g) (|bx - ax| + |by - ay|) + 28 U M S, of which the last term is below 3 B.

A goal, or the origin, is to the left of the edge from a to b if
(bx - ax) (gy - ay) - (by - ay) (gx - ax) > 0. Let M be at least the size of its coordinates, too. A
difference is off by less than 5 U M, a product of two of size 2 M by 20 U M^2 and its rounding by
4 U M^2, and their difference by 8 U M^2: in all, less than 64 U M^2.

SLACK covers terms of second order, TINY underflow, since all numbers are below 2^400.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, final

from exactpt.cached_property import cached_property
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.geometry.predicates import Point, orientation
from exactpt.indices import HalfEdge, VertexId
from exactpt.kernel.numbers import QQ, sign
from exactpt.query.nodes import Given, difference, exact
from exactpt.query.subdivision import On, Spot, Subdivision, cross

_LARGEST: Final = 2.0**400


@final
class Ray:
    """The points origin + s * direction, s >= 0; the direction is not (0, 0).

    Attributes:
        goal: the point with parameter 1; None if it does not matter.
        given, along: the origin and the direction as they were given; no direction with a goal.
        line: numbers dx, dy, c; the node (x, y) is to the left of the ray if dx y - dy x - c > 0.
        off: a bound on the errors of these numbers, for all nodes.
    """

    def __init__(
        self,
        plane: Subdivision,
        origin: Given,
        direction: Given | None = None,
        goal: Given | None = None,
    ) -> None:
        self.given, self.along = origin, direction
        self.goal = goal
        self._plane = plane
        self._sides: dict[VertexId, int] = {}
        ox, oy = plane.nodes.of(origin)
        dx, dy = difference((0.0, 0.0) if goal is None else origin, goal or direction or origin)
        self._near = ox, oy
        self.line = dx, dy, dx * oy - dy * ox
        size, length = max(plane.nodes.size, abs(ox), abs(oy)), abs(dx) + abs(dy)
        in_range = size < _LARGEST and length < _LARGEST
        self.off = 10.0 * U * size * length * SLACK + TINY if in_range else math.inf
        self._goal = gx, gy = (ox, oy) if goal is None else plane.nodes.of(goal)
        size = max(size, abs(gx), abs(gy))
        self._edge_off = 64.0 * U * size * size * SLACK + TINY if size < _LARGEST else math.inf

    @cached_property
    def origin(self) -> Point:
        """The start."""
        return exact(self.given)

    @cached_property
    def direction(self) -> Point:
        """The direction."""
        if self.along is not None:
            return exact(self.along)
        (x, y), (ox, oy) = exact(self.goal or self.given), self.origin
        return x - ox, y - oy

    def place_of(self, h: HalfEdge) -> tuple[float, float]:
        """Return bounds of t, a positive multiple of the parameter at which it crosses an edge.

        Doubles decide on which side the ends of the edge are.
        """
        origin, nodes = self._plane.map.origin, self._plane.nodes
        u, v = origin[h], origin[h ^ 1]
        ax, ay, bx, by = nodes.xs[u], nodes.ys[u], nodes.xs[v], nodes.ys[v]
        (dx, dy, c), (ox, oy), off = self.line, self._near, self.off
        p, q = dx * ay - dy * ax - c, dx * by - dy * bx - c
        ux, uy, w = bx - ax, by - ay, p / (p - q)
        t = dx * (ax + w * ux - ox) + dy * (ay + w * uy - oy)
        share = (abs(dx) + abs(dy)) * (abs(ux) + abs(uy)) * off / (abs(p - q) - 2.0 * off)
        error = (share + 3.0 * off) * SLACK + TINY
        return t - error, t + error

    def side(self, node: VertexId) -> int:
        """1, 0 or -1 if a node is to the left of, on, or to the right of the line of the ray."""
        known = self._sides.get(node)
        if known is None:
            (dx, dy, c), off, nodes = self.line, self.off, self._plane.nodes
            value = dx * nodes.ys[node] - dy * nodes.xs[node] - c
            known = 1 if value > off else -1 if value < -off else self._exact_side(node)
            self._sides[node] = known
        return known

    def _exact_side(self, node: VertexId) -> int:
        (x, y), (ox, oy), (dx, dy) = self._plane.points[node], self.origin, self.direction
        return sign(dx * (y - oy) - dy * (x - ox))

    def beyond_goal(self, end: Spot) -> int:
        """Return 1, 0 or -1 if the end of a step is beyond, at or before the goal, if there is one.

        Of an edge, see `beyond_at_edge`.
        """
        if end.on is On.EDGE:
            return self.beyond_at_edge(HalfEdge(end.handle))
        return -1 if self.goal is None else sign(self.parameter(end) - 1)

    def beyond_at_edge(self, h: HalfEdge) -> int:
        """Return the same for an edge that the ray crosses, from its left side to its right one."""
        if self.goal is None:
            return -1
        return self._side_of_edge(h, self.goal, self._goal)

    def begins_outside(self) -> bool:
        """Return True if the origin is outside of the hull; False if it is not, or not seen to be.

        It is if it is to the left of an edge of the face there.
        """
        hull = self._plane.hull
        return hull is not None and self.begins_before(hull.edge_before(*self._near))

    def begins_before(self, h: HalfEdge) -> bool:
        """Return True if the origin is to the left of an edge."""
        return self._side_of_edge(h, self.given, self._near) > 0

    def _side_of_edge(self, h: HalfEdge, point: Given, near: tuple[float, float]) -> int:
        origin, nodes = self._plane.map.origin, self._plane.nodes
        u, v, (x, y) = origin[h], origin[h ^ 1], near
        ax, ay = nodes.xs[u], nodes.ys[u]
        value = (nodes.xs[v] - ax) * (y - ay) - (nodes.ys[v] - ay) * (x - ax)
        if abs(value) > self._edge_off:
            return 1 if value > 0.0 else -1
        return orientation(self._plane.points[u], self._plane.points[v], exact(point))

    def parameter(self, spot: Spot) -> QQ:
        """Return the parameter at a node of the ray, or an edge not parallel to it; 0 in a face."""
        return _parameter(self.origin, self.direction, self.ends(spot))

    def ends(self, spot: Spot) -> tuple[Point, ...]:
        """Return the position of a node, or of the ends of an edge; nothing of a face."""
        if spot.on is On.FACE:
            return ()
        points, origin = self._plane.points, self._plane.map.origin
        if spot.on is On.NODE:
            return (points[spot.handle],)
        return points[origin[spot.handle]], points[origin[spot.handle ^ 1]]


def reach(start: Given, along: Given, ends: Sequence[Point]) -> tuple[Point, QQ]:
    """Return the point of a ray at some ends (`Ray.ends`), and its parameter."""
    (ox, oy), (dx, dy) = origin, direction = exact(start), exact(along)
    at = _parameter(origin, direction, ends)
    return (ox + at * dx, oy + at * dy), at


def _parameter(origin: Point, direction: Point, ends: Sequence[Point]) -> QQ:
    """Return the parameter at which a ray crosses the line of an edge, or reaches a node of it."""
    if not ends:
        return QQ(0)
    (ox, oy), (dx, dy), (x, y) = origin, direction, ends[0]
    # At a node, the line at a right angle to the ray.
    along = (ends[1][0] - x, ends[1][1] - y) if len(ends) > 1 else (-dy, dx)
    return cross((x - ox, y - oy), along) / cross(direction, along)
