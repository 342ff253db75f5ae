"""The nodes of a subdivision in doubles, and a node near a point: where a walk starts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias, final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, Rational, finite, nearest_float, rational

Given: TypeAlias = Point | tuple[float, float]
"""A point or a vector: exact, or two doubles, which are made exact only where it matters."""


def exact(point: Given | Sequence[Rational]) -> Point:
    """Return a point or a vector in rationals."""
    return rational(point[0]), rational(point[1])


def difference(p: Given, q: Given) -> tuple[float, float]:
    """Return the doubles nearest to the vector from p to q."""
    (a, b), (x, y) = p, q
    if type(a) is type(b) is type(x) is type(y) is float:
        return x - a, y - b
    (a, b), (x, y) = exact(p), exact(q)
    return nearest_float(x - a), nearest_float(y - b)


@final
class Nodes:
    """The positions of nodes as the nearest doubles, relative to an origin of doubles, in a grid.

    No result depends on the grid: a walk from anywhere ends in the face that contains the point.

    Args:
        points: the positions.

    Attributes:
        xs, ys: the coordinates, perhaps infinite.
        size: the largest absolute value of a coordinate.
    """

    __slots__ = ("_cells", "_columns", "_origin", "_side", "_x", "_y", "size", "xs", "ys")

    def __init__(self, points: Sequence[Point]) -> None:
        first = points[0] if points else (QQ(0), QQ(0))
        # Near the first node; doubles minus doubles need no rational number.
        self._origin = finite(nearest_float(first[0])), finite(nearest_float(first[1]))
        ox, oy = exact(self._origin)
        self.xs = [nearest_float(x - ox) for x, _ in points]
        self.ys = [nearest_float(y - oy) for _, y in points]
        self.size = max(map(abs, (*self.xs, *self.ys)), default=0.0)
        self._x, self._y = min(self.xs, default=0.0), min(self.ys, default=0.0)
        wide = max(max(self.xs, default=0.0) - self._x, max(self.ys, default=0.0) - self._y)
        self._columns = max(1, math.isqrt(len(points)))
        self._side = wide / self._columns if wide < math.inf else 0.0
        self._cells: dict[tuple[int, int], list[int]] = {}
        if self._side > 0.0:
            for node, (x, y) in enumerate(zip(self.xs, self.ys, strict=True)):
                self._cells.setdefault(self.cell(x, y), []).append(node)

    def of(self, point: Given) -> tuple[float, float]:
        """Return the doubles nearest to the position of a point relative to the origin."""
        return difference(self._origin, point)

    def near(self, point: Given) -> int:
        """Return a node that is probably near a point."""
        x, y = self.of(point)
        if not self._cells:
            return 0
        column, row = self.cell(x, y)
        for ring in range(3):
            near = [
                node
                for i in range(column - ring, column + ring + 1)
                for j in range(row - ring, row + ring + 1)
                for node in self._cells.get((i, j), ())
            ]
            if near:
                return min(near, key=lambda node: math.hypot(self.xs[node] - x, self.ys[node] - y))
        sample = range(0, len(self.xs), max(1, len(self.xs) // self._columns))
        return min(sample, key=lambda node: math.hypot(self.xs[node] - x, self.ys[node] - y))

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Return the cell of a point relative to the origin; of one outside, a cell at the border.

        Without a grid there is only one.
        """
        if self._side == 0.0:
            return 0, 0
        last = self._columns - 1
        column, row = (x - self._x) / self._side, (y - self._y) / self._side
        return int(min(max(column, 0.0), last)), int(min(max(row, 0.0), last))

    def middle(self, cell: tuple[int, int]) -> tuple[float, float]:
        """Return doubles in the middle of a cell, or near it."""
        x, y = (k * self._side + 0.5 * self._side for k in cell)
        return finite(self._origin[0] + self._x + x), finite(self._origin[1] + self._y + y)
