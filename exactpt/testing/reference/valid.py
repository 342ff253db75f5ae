"""Whether rings are those of a valid body, and such a body cut into convex ones.

Vertical lines through all vertices and crossings cut the plane into slabs, and edges cut a slab
into trapezoids. A body is valid if its edges have no common piece, and each trapezoid is outside,
or in one part and none of its holes, or in one hole of one part or more; and if the trapezoids of
each part hang together by sides of positive length.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise
from typing import NamedTuple, TypeAlias

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.motion.body import Body

__all__ = ["Point", "Rings", "dissected", "is_valid"]

Rings: TypeAlias = Sequence[Sequence[Point]]
"""The outline of a part, and its holes."""


class _Edge(NamedTuple):
    """An edge that is not upright, from left to right.

    Attributes:
        part, ring: the numbers of its part and of its ring there; 0 for the outline.
        a, b: its ends.
    """

    part: int
    ring: int
    a: Point
    b: Point

    def height(self, x: QQ) -> QQ:
        """Return y at x."""
        (u, v), (p, q) = self.a, self.b
        return v + (q - v) * (x - u) / (p - u)


class _Cell(NamedTuple):
    """A trapezoid between two edges and two upright lines.

    Attributes:
        left, right: x of the lines.
        below, above: the edges.
        inside: the rings that it is in, by part and ring.
    """

    left: QQ
    right: QQ
    below: _Edge
    above: _Edge
    inside: frozenset[tuple[int, int]]

    def side(self, x: QQ) -> tuple[QQ, QQ]:
        """Return the ends of its side on one of the lines."""
        return self.below.height(x), self.above.height(x)

    @property
    def corners(self) -> list[Point]:
        """The corners, each once."""
        (a, d), (b, c) = self.side(self.left), self.side(self.right)
        around = [(self.left, a), (self.right, b), (self.right, c), (self.left, d)]
        return list(dict.fromkeys(around))

    def owner(self) -> int | None:
        """Return the part of which it is inside; None if it is outside of all, or none can be."""
        in_parts = {part for part, _ in self.inside}
        owners = [part for part in in_parts if self._holes(part) == 0]
        return owners[0] if len(owners) == 1 else None

    def is_possible(self) -> bool:
        """Return True unless it is in a hole without its outline, in two holes, or in two parts."""
        in_parts = {part for part, _ in self.inside}
        in_holes = [part for part in in_parts if self._holes(part)]
        if any((part, 0) not in self.inside or self._holes(part) > 1 for part in in_holes):
            return False
        return len(in_parts) - len(in_holes) <= 1

    def _holes(self, part: int) -> int:
        return sum(1 for p, ring in self.inside if p == part and ring)


def _crossing(e: _Edge, f: _Edge) -> QQ | None:
    """Return x of the common point of the lines of two edges; None if they are parallel."""
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = e.a, e.b, f.a, f.b
    slope = (by - ay) * (dx - cx) - (dy - cy) * (bx - ax)
    if not slope:
        return None
    at_zero_e = ay * (bx - ax) - ax * (by - ay)
    at_zero_f = cy * (dx - cx) - cx * (dy - cy)
    return (at_zero_f * (bx - ax) - at_zero_e * (dx - cx)) / slope


def _cells(parts: Sequence[Rings]) -> list[_Cell] | None:
    """Return all bounded cells; None if edges of two rings have a common piece."""
    edges: list[_Edge] = []
    for part, rings in enumerate(parts):
        for ring, points in enumerate(rings):
            for p, q in zip(points, [*points[1:], points[0]], strict=True):
                if p[0] != q[0]:
                    edges.append(_Edge(part, ring, min(p, q), max(p, q)))
    lines = {p[0] for rings in parts for points in rings for p in points}
    for e, f in combinations(edges, 2):
        x = _crossing(e, f)
        if x is not None and max(e.a[0], f.a[0]) < x < min(e.b[0], f.b[0]):
            lines.add(x)
    cells: list[_Cell] = []
    for left, right in pairwise(sorted(lines)):
        middle = (left + right) / 2
        across = [e for e in edges if e.a[0] <= left and right <= e.b[0]]
        across.sort(key=lambda e: e.height(middle))
        inside: frozenset[tuple[int, int]] = frozenset()
        for below, above in pairwise(across):
            if below.height(middle) == above.height(middle):
                return None
            inside ^= {(below.part, below.ring)}
            cells.append(_Cell(left, right, below, above, inside))
    return cells


def _uprights(parts: Sequence[Rings]) -> list[tuple[int, int, QQ, QQ, QQ]]:
    """Return the upright edges: part, ring, x, and y of the lower and of the upper end."""
    return [
        (part, ring, p[0], min(p[1], q[1]), max(p[1], q[1]))
        for part, rings in enumerate(parts)
        for ring, points in enumerate(rings)
        for p, q in zip(points, [*points[1:], points[0]], strict=True)
        if p[0] == q[0]
    ]


def is_valid(parts: Sequence[Sequence[Sequence[tuple[Rational, Rational]]]]) -> bool:
    """Return True if simple rings are those of a valid body.

    A hole may touch the outline in a point, but a hole that cuts a part in two is none.

    >>> outline = [(0, 0), (8, 0), (8, 8), (0, 8)]
    >>> is_valid([[outline, [(4, 0), (5, 2), (3, 2)]]])
    True
    >>> is_valid([[outline, [(4, 0), (8, 2), (4, 8)]]])
    False

    Args:
        parts: for each part the points of its outline and of its holes, each ring simple.
    """
    exact = [[[(rational(x), rational(y)) for x, y in ring] for ring in part] for part in parts]
    cells, uprights = _cells(exact), _uprights(exact)
    if cells is None:
        return False
    for e, f in combinations(uprights, 2):
        if e[:2] != f[:2] and e[2] == f[2] and max(e[3], f[3]) < min(e[4], f[4]):
            return False
    if not all(cell.is_possible() for cell in cells):
        return False
    return all(_hangs_together(k, cells, uprights) for k in range(len(parts)))


def _hangs_together(
    part: int, cells: Sequence[_Cell], uprights: Sequence[tuple[int, int, QQ, QQ, QQ]]
) -> bool:
    """Return True if the cells of a part are connected by sides of positive length."""
    own = [cell for cell in cells if cell.owner() == part]
    left_over = set(range(len(own)))
    ahead = [left_over.pop()]
    while ahead:
        one = own[ahead.pop()]
        near = [k for k in left_over if _share_a_side(part, one, own[k], uprights)]
        left_over.difference_update(near)
        ahead += near
    return not left_over


def _share_a_side(
    part: int, one: _Cell, other: _Cell, uprights: Sequence[tuple[int, int, QQ, QQ, QQ]]
) -> bool:
    """Return True if two cells have more than points in common that are on no upright edge."""
    if one.right != other.left:
        if other.right != one.left:
            return False
        one, other = other, one
    x = one.right
    (low, high), (bottom, top) = one.side(x), other.side(x)
    low, high = max(low, bottom), min(high, top)
    walls = sorted((e[3], e[4]) for e in uprights if e[0] == part and e[2] == x)
    for bottom, top in walls:
        if low < min(bottom, high):
            return True
        low = max(low, top)
    return low < high


def dissected(body: Body) -> list[Body]:
    """Return simple convex bodies whose union is a body that keeps its shape.

    >>> notched = Body("b", [(0, 0), (8, 0), (8, 8), (0, 8)], holes=[[(4, 0), (5, 2), (3, 2)]])
    >>> len(dissected(notched))
    6

    Args:
        body: the body; if it has one ring it is returned as it is.
    """
    if not body.has_rings:
        return [body]
    place = [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in body.vertices]
    cells = _cells([[[place[i] for i in ring] for ring in rings] for rings in body.parts])
    assert cells is not None  # noqa: S101 - the body is valid
    return [
        Body(f"{body.name}.{k}", cell.corners, body.motion, radius=body.radius)
        for k, cell in enumerate(cells)
        if cell.owner() is not None
    ]
