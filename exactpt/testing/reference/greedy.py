"""The greedy vertical pseudo-triangulation of convex bodies: every free bitangent, sorted.

Points count as discs of radius 0: their four bitangents have one geometry but four labels.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cmp_to_key
from itertools import combinations, pairwise
from typing import NamedTuple, TypeAlias

from exactpt.geometry.predicates import Point, orientation
from exactpt.kernel.numbers import Rational, rational, sign
from exactpt.testing.reference.shapes import segments_cross

__all__ = ["ConvexBodies", "Tangent"]

Corner: TypeAlias = tuple[int, int]
"""A vertex: the number of the body, and its number there."""

RANK: dict[tuple[int, int], int] = {(1, -1): 0, (1, 1): 1, (-1, -1): 1, (-1, 1): 2}
"""The order of bitangents with one geometry, by the sides of their bodies."""


class Tangent(NamedTuple):
    """A bitangent from left to right: from vertex a of body i to vertex b of body j.

    Attributes:
        side_i, side_j: +1 if that body is on its left, -1 if on its right.
    """

    i: int
    a: int
    j: int
    b: int
    side_i: int
    side_j: int

    @property
    def corners(self) -> tuple[Corner, Corner]:
        """The two vertices."""
        return (self.i, self.a), (self.j, self.b)


class ConvexBodies:
    """Disjoint convex bodies in general position.

    >>> bodies = ConvexBodies([[(0, 0)], [(4, 1)]])
    >>> bodies.edges(bodies.greedy())
    {((0, 0), (1, 0))}

    Args:
        bodies: for each the vertices, counter-clockwise; one or two for a point or a segment.
    """

    def __init__(self, bodies: Iterable[Sequence[tuple[Rational, Rational]]]) -> None:
        self.bodies: list[list[Point]] = [
            [(rational(x), rational(y)) for x, y in body] for body in bodies
        ]

    def bitangents(self) -> list[Tangent]:
        """Return all free bitangents, four for each pair of bodies that see each other.

        Raises:
            ValueError: if a line touches three bodies.
        """
        return [
            tangent
            for i, j in combinations(range(len(self.bodies)), 2)
            for tangent in self._of_two(i, j)
            if self._is_free(tangent)
        ]

    def _of_two(self, i: int, j: int) -> Iterator[Tangent]:
        for a, p in enumerate(self.bodies[i]):
            for b, q in enumerate(self.bodies[j]):
                for side_i in self._sides(i, p, q):
                    for side_j in self._sides(j, p, q):
                        if _left_to_right(p, q):
                            yield Tangent(i, a, j, b, side_i, side_j)
                        else:
                            yield Tangent(j, b, i, a, -side_j, -side_i)

    def _sides(self, i: int, p: Point, q: Point) -> list[int]:
        """Return the sides of the line pq on which a body may be; none if it is on both."""
        sides = {orientation(p, q, v) for v in self.bodies[i]} - {0}
        if len(sides) > 1:
            return []
        return sorted(sides) or [-1, 1]

    def _is_free(self, tangent: Tangent) -> bool:
        p, q = self.ends(tangent)
        for k, body in enumerate(self.bodies):
            if k in (tangent.i, tangent.j):
                continue
            if any(orientation(p, q, v) == 0 for v in body):
                raise ValueError("three bodies on one line: not generic")
            if any(segments_cross(p, q, u, v) for u, v in pairwise([*body, body[0]])):
                return False
        return True

    def ends(self, tangent: Tangent) -> tuple[Point, Point]:
        """Return the two ends, the left one first."""
        (i, a), (j, b) = tangent.corners
        return self.bodies[i][a], self.bodies[j][b]

    def theta_order(self, s: Tangent, t: Tangent) -> int:
        """Return a negative number if s comes before t: by direction, then by label."""
        (p, q), (u, v) = self.ends(s), self.ends(t)
        turn = sign((q[0] - p[0]) * (v[1] - u[1]) - (q[1] - p[1]) * (v[0] - u[0]))
        return turn or RANK[s.side_i, s.side_j] - RANK[t.side_i, t.side_j]

    def crosses(self, s: Tangent, t: Tangent) -> bool:
        """Return True if two bitangents cross, inside or at a common end (the paper, 4.1)."""
        if s.corners == t.corners:
            return {(s.side_i, s.side_j), (t.side_i, t.side_j)} == {(1, -1), (-1, 1)}
        for at_s, at_t in ((0, 0), (0, 1), (1, 0), (1, 1)):
            if s.corners[at_s] == t.corners[at_t]:
                return self._crosses_at(s, at_s, t, at_t)
        return segments_cross(*self.ends(s), *self.ends(t))

    def _crosses_at(self, s: Tangent, at_s: int, t: Tangent, at_t: int) -> bool:
        """Return True if they cross at a common end, the left (0) or the right one (1) of each."""
        # The side of the body as seen along the segment, leaving the common end.
        side_s = -s.side_j if at_s else s.side_i
        side_t = -t.side_j if at_t else t.side_i
        if side_s == side_t:
            return False
        ends_of_s, ends_of_t = self.ends(s), self.ends(t)
        turn = orientation(ends_of_s[at_s], ends_of_s[1 - at_s], ends_of_t[1 - at_t])
        return turn < 0 if side_s > 0 else turn > 0

    def greedy(self) -> list[Tangent]:
        """Return the bitangents that cross none of those before them, in the order of theta."""
        chosen: list[Tangent] = []
        for tangent in sorted(self.bitangents(), key=cmp_to_key(self.theta_order)):
            if not any(self.crosses(tangent, other) for other in chosen):
                chosen.append(tangent)
        return chosen

    def edges(self, tangents: Iterable[Tangent]) -> set[tuple[Corner, Corner]]:
        """Return bitangents without their labels: the two vertices of each, the lower first."""
        return {(min(t.corners), max(t.corners)) for t in tangents}


def _left_to_right(p: Point, q: Point) -> bool:
    return (p[0], -p[1]) < (q[0], -q[1])
