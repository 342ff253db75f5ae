"""Bitangents of two disjoint convex bodies, and their order by direction.

A bitangent is directed from left to right. theta(s) is the clockwise angle from "up" to
its direction, in (0, pi]; pi is vertical. Larger slope means smaller theta.
"""

from __future__ import annotations

from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import difference
from exactpt.tiling.greedy.slope import Slope, slope_terms

__all__ = ["Bitangent", "tangent_pair"]


def tangent_pair(
    instant: PredicatesAt, a: int, b: int, side_a: int, side_b: int
) -> tuple[int, int]:
    """The vertices at which the bitangent from the body of a to that of b touches.

    Each end moves along its ring while a neighbour is on the wrong side of the line. A
    vertex whose two neighbours are on the right side is the tangent point as seen from
    the other end, since the ring is convex. Of vertices that stay on the line the
    nearest one is taken: it sticks out (`exactpt.certificates.perturbation`).

    Args:
        instant: the predicates.
        a: a vertex of a convex ring to start from.
        b: one of another ring, disjoint from the first.
        side_a: 1 if the body of a shall be on the left of the line, -1 on the right.
        side_b: the same for the body of b.

    Raises:
        AuditError: if the walk does not end (the bodies are not convex or not disjoint).
    """
    vertices = instant.vertices.all
    steps = 0
    settled = 0
    while settled < 2:
        for n in (vertices[a].ahead, vertices[a].behind):
            s = side_a * instant.sign(a, b, n)
            if s < 0 or (s == 0 and instant.nearer(b, n, a)):
                a = n
                settled = 0
                break
        else:
            settled += 1
            if settled < 2:
                for n in (vertices[b].ahead, vertices[b].behind):
                    s = side_b * instant.sign(a, b, n)
                    if s < 0 or (s == 0 and instant.nearer(a, n, b)):
                        b = n
                        settled = 0
                        break
                else:
                    settled += 1
        steps += 1
        if steps > 2 * len(vertices) + 100:
            raise AuditError(
                f"no bitangent of {instant.vertices.name(a)} and {instant.vertices.name(b)}"
            )
    return a, b


@final
class Bitangent:
    """A bitangent with its place in the order of the sweep.

    Attributes:
        a, b: its left and its right vertex.
        key: -slope, rounded down; never in the wrong order, but equal for slopes that are close.
        cell: the cell of the sweep in which it was found.
        left, right: the arcs at the ends of that cell then.
    """

    __slots__ = (
        "_instant",
        "_known_slope",
        "_sides",
        "a",
        "b",
        "cell",
        "key",
        "left",
        "number",
        "right",
    )

    def __init__(
        self,
        instant: PredicatesAt,
        ends: tuple[int, int],
        sides: tuple[int, int],
        cell: int,
        arcs: tuple[int, int],
        number: int,
    ) -> None:
        self.a, self.b = ends
        self.cell = cell
        self.left, self.right = arcs
        self.number = number
        self._instant = instant
        self._sides = sides
        self._known_slope: Slope | None = None
        self.key: float = instant.descent(self.a, self.b)

    def __lt__(self, other: Bitangent) -> bool:
        """Whether the sweep meets it first, for equal keys: a total order.

        By theta at the instant; of parallel ones by their lines, since none crosses one of
        another line, so that it does not matter which of them comes first; on one line by
        theta just after the instant, perturbed.
        """
        now = self._instant.turn_now(self.a, self.b, other.a, other.b)
        if now:
            return now < 0
        mine, its = self.offset(), other.offset()
        if mine != its:
            return mine < its
        order = self._instant.first_sign(slope_terms(self._slope(), other._slope()))
        return order < 0 if order else self.number < other.number

    def is_parallel(self, other: Bitangent) -> bool:
        """Whether two bitangents are parallel at the instant."""
        return (
            self.key == other.key and self._instant.turn_now(self.a, self.b, other.a, other.b) == 0
        )

    def offset(self) -> QQ:
        """Where the line is among those parallel to it: its y at x = 0, or its x if vertical."""
        (ax, ay), (bx, by) = self._instant.position(self.a), self._instant.position(self.b)
        return ax if ax == bx else (ay * bx - by * ax) / (bx - ax)

    def _slope(self) -> Slope:
        if self._known_slope is None:
            self._known_slope = self._new_slope()
        return self._known_slope

    def _new_slope(self) -> Slope:
        vertices = self._instant.vertices.all
        a, b = vertices[self.a], vertices[self.b]
        # Of zero width, at the time if that is asked for, else for ever.
        is_upright = self._instant.position(self.a)[0] == self._instant.position(self.b)[0]
        upright = is_upright and (
            not self._instant.after or not difference(a.track.x, a.track.w, b.track.x, b.track.w)
        )
        return Slope(a, b, self._sides, upright=upright)
