"""Bitangents of two disjoint convex bodies, and their order by direction.

A bitangent is directed from left to right. theta(s) is the clockwise angle from "up" to
its direction, in (0, pi]; pi is vertical. Larger slope means smaller theta.
"""

from __future__ import annotations

from math import isinf
from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import AuditError
from exactpt.indices import Ends, VertexId
from exactpt.kernel.numbers import QQ
from exactpt.motion.track import difference
from exactpt.tiling.greedy.slope import Slope, slope_terms


def tangent_pair(instant: PredicatesAt, a: VertexId, b: VertexId, side_a: int, side_b: int) -> Ends:
    """Return the vertices at which the bitangent from the body of a to that of b touches.

    Each end moves along its ring while a neighbour is on the wrong side of the line. A
    vertex whose two neighbours are on the right side is the tangent point as seen from
    the other end, since the ring is convex. Of vertices that are on the line for all times, the
    nearest one is taken: by the perturbation it sticks out
    (`exactpt.certificates.perturbation`).

    Args:
        instant: the predicates.
        a: a vertex of a convex ring.
        b: a vertex of another ring, disjoint from the first.
        side_a: 1 for the tangent with the body of a on its left, -1 on its right.
        side_b: likewise for the body of b.

    Raises:
        AuditError: if the walk does not end (the bodies are not convex or not disjoint).
    """
    for _ in range(2 * len(instant.vertices.all) + 100):
        n = _wrong_neighbour(instant, (a, b), a, b, side_a)
        if n != a:
            a = n
            continue
        n = _wrong_neighbour(instant, (a, b), b, a, side_b)
        if n == b:
            return a, b
        b = n
    raise AuditError(f"no bitangent of {instant.vertices.name(a)} and {instant.vertices.name(b)}")


def _wrong_neighbour(
    instant: PredicatesAt, line: Ends, end: VertexId, other: VertexId, side: int
) -> VertexId:
    """Return a neighbour of one end of a line on its wrong side, or nearer to the other end on it.

    The end itself if there is none.
    """
    a, b = line
    vertices = instant.vertices
    for n in (vertices.ahead(end), vertices.behind(end)):
        s = side * instant.orientation(a, b, n)
        if s < 0 or (s == 0 and instant.nearer(other, n, end)):
            return n
    return end


@final
class Bitangent:
    """A bitangent, comparable by its position in the order of the sweep.

    Attributes:
        a, b: its left and its right vertex.
        key: its `PredicatesAt.descent`: monotone, but equal for slopes that are close.
        number: the number of bitangents found before it.
    """

    __slots__ = ("_instant", "_known_slope", "_sides", "a", "b", "key", "number")

    def __init__(
        self, instant: PredicatesAt, ends: Ends, sides: tuple[int, int], key: float, number: int
    ) -> None:
        self.a, self.b = ends
        self.number = number
        self._instant = instant
        self._sides = sides
        self._known_slope: Slope | None = None
        self.key: float = key

    def __lt__(self, other: Bitangent) -> bool:
        """Return True if the sweep reaches it first, for bitangents with equal keys: a total order.

        By theta at the instant. Parallel bitangents on different lines do not cross, so their
        order does not matter; it is that of their lines. On one line they are ordered by theta
        just after the instant, perturbed.
        """
        now = self._instant.cross_sign_now(self.a, self.b, other.a, other.b)
        if now:
            return now < 0
        side = self._side_of(other)
        if side:
            return side > 0
        order = self._instant.first_sign(slope_terms(self._slope(), other._slope()))
        return order < 0 if order else self.number < other.number

    def is_parallel(self, other: Bitangent) -> bool:
        """Return True if two bitangents are parallel at the instant."""
        return (
            self.key == other.key
            and self._instant.cross_sign_now(self.a, self.b, other.a, other.b) == 0
        )

    def _side_of(self, other: Bitangent) -> int:
        """1 if the line of a parallel bitangent has the larger `offset`, -1 if the smaller one."""
        if isinf(self.key):  # perhaps vertical
            mine, its = self.offset(), other.offset()
            return (its > mine) - (its < mine)
        return (
            0
            if self.a == other.a
            else self._instant.cross_sign_now(self.a, self.b, self.a, other.a)
        )

    def offset(self) -> QQ:
        """Return the offset of the line among its parallels: y at x = 0, or x if vertical."""
        (ax, ay), (bx, by) = self._instant.position(self.a), self._instant.position(self.b)
        return ax if ax == bx else (ay * bx - by * ax) / (bx - ax)

    def _slope(self) -> Slope:
        if self._known_slope is None:
            self._known_slope = self._new_slope()
        return self._known_slope

    def _new_slope(self) -> Slope:
        vertices = self._instant.vertices.all
        a, b = vertices[self.a], vertices[self.b]
        # Of zero width at the time itself, or for all times, as the predicates are.
        is_upright = self._instant.position(self.a)[0] == self._instant.position(self.b)[0]
        upright = is_upright and (
            not self._instant.after or not difference(a.track.x, a.track.w, b.track.x, b.track.w)
        )
        return Slope(a, b, self._sides, upright=upright)
