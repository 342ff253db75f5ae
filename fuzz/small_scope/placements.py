"""Placements: two shapes that touch without overlapping, and ways to take them apart.

Lengths are in half units of the grid: the middle of an edge is a place, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, lru_cache, partial
from itertools import product
from math import gcd
from typing import Final, NamedTuple

from fuzz.small_scope.shapes import (
    SYMMETRIES,
    Matrix,
    Shape,
    Vector,
    contains,
    corner,
    edges,
    image,
    meet,
    on_segment,
    shapes,
    turned,
)

__all__ = [
    "DIRECTIONS",
    "Placement",
    "complete",
    "disjoint",
    "move_offset",
    "placements",
    "small_shapes",
]

DIRECTIONS: Final[tuple[Vector, ...]] = tuple(
    sorted({turned(m, v) for m in SYMMETRIES for v in ((1, 0), (8, 1), (2, 1), (3, 2), (1, 1))})
)
"""The slopes of edges on a 3 x 3 grid, and one direction between any two of these.

Whether two shapes that touch come apart by a small translation depends on its direction only
by the signs of cross products with edges: these 32 stand for all directions.
"""

FINE: Final = 256
"""A small translation is a direction divided by this. A cross product of a direction and an
edge is less in size (at most 9 times 6), and of lattice vectors an integer: so a translation
changes no sign but that of 0."""

TOUCH, EDGE, ALONG = (1 << (len(DIRECTIONS) + k) for k in range(3))
ALL: Final = TOUCH - 1


class Placement(NamedTuple):
    """Two shapes that touch.

    Attributes:
        a, b: the shapes.
        offset: where the corner of a is, if that of b is at 0, in half units.
        free: bit i is set if a small translation of a in direction i takes them apart.
        place: what touches: "vertex" on vertices only, "edge" if a vertex is inside an
            edge, "along" if edges have more than a point in common.
    """

    a: Shape
    b: Shape
    offset: Vector
    free: int
    place: str

    @property
    def kinds(self) -> str:
        """What the shapes are, in the same order for both orders of the shapes."""
        ranked = sorted((self.a, self.b), key=lambda s: (len(s.vertices), s.closed))
        return " and ".join(shape.kind for shape in ranked)


@lru_cache(1 << 18)
def _blocked(v: Vector, w: Vector, r: Vector) -> int:
    """How the edge from r to r + v meets that from 0 to w.

    Returns:
        `TOUCH` if it does, with `EDGE` and `ALONG` as in `Placement.place`; and the bits of
        the directions in which it still does after a small translation.
    """
    d = (w[0] * FINE, w[1] * FINE)

    def hit(step: Vector) -> bool:
        a = (r[0] * FINE + step[0], r[1] * FINE + step[1])
        return meet(a, (a[0] + v[0] * FINE, a[1] + v[1] * FINE), (0, 0), d)

    if not hit((0, 0)):
        return 0
    far = (r[0] + v[0], r[1] + v[1])
    ends = {r, far} & {(0, 0), w}
    inside = {p for p in (r, far) if p not in ends and on_segment(p, (0, 0), w)}
    inside |= {p for p in ((0, 0), w) if p not in ends and on_segment(p, r, far)}
    found = TOUCH | (EDGE if inside else 0)
    if v != (0, 0) and w != (0, 0) and len(ends | inside) > 1:
        found |= ALONG
    return found | sum(1 << i for i, step in enumerate(DIRECTIONS) if hit(step))


def _doubled(shape: Shape) -> Shape:
    return Shape(tuple((2 * x, 2 * y) for x, y in shape.vertices), shape.closed)


def _meeting(a: Shape, b: Shape, offset: Vector) -> int:
    """The bits of `_blocked` for any edges of two doubled shapes, or for an overlap."""
    found = 0
    for p, q in edges(a):
        v = (q[0] - p[0], q[1] - p[1])
        at = (p[0] + offset[0], p[1] + offset[1])
        for s, t in edges(b):
            found |= _blocked(v, (t[0] - s[0], t[1] - s[1]), (at[0] - s[0], at[1] - s[1]))
    if found & ALL != ALL:
        first, other = a.vertices[0], b.vertices[0]
        at = (first[0] + offset[0] - other[0], first[1] + offset[1] - other[1])
        if b.closed:
            found |= _covered(b, (at[0] + other[0], at[1] + other[1]), 1)
        if a.closed:
            found |= _covered(a, (first[0] - at[0], first[1] - at[1]), -1)
    return found


@lru_cache(1 << 16)
def _covered(polygon: Shape, p: Vector, sense: int) -> int:
    """The bits of the directions (or opposite ones) in which p, moved a little, is inside.

    Right where p is not on the boundary then; of others `_blocked` knows.
    """
    fine = [(FINE * x, FINE * y) for x, y in polygon.vertices]
    return sum(
        1 << i
        for i, (x, y) in enumerate(DIRECTIONS)
        if contains(fine, (FINE * p[0] + sense * x, FINE * p[1] + sense * y))
    )


def disjoint(a: Shape, b: Shape, offset: Vector) -> bool:
    """Whether two shapes neither touch nor overlap, a at an offset in half units."""
    return _meeting(_doubled(a), _doubled(b), offset) == 0


def placements(a: Shape, b: Shape) -> Iterator[Placement]:
    """All ways to let a touch b so that they come apart in some direction.

    With vertices on vertices, on the lattice points inside edges, and, of an edge that has
    none, on its middle. (Edges along edges of lattices have a vertex on such a point.)
    """
    p, q = _doubled(a), _doubled(b)
    offsets = {(u[0] - v[0], u[1] - v[1]) for u in _points(q) for v in p.vertices}
    offsets |= {(u[0] - v[0], u[1] - v[1]) for u in q.vertices for v in _points(p)}
    for offset in sorted(offsets):
        found = _meeting(p, q, offset)
        if free := ALL & ~found:
            place = "along" if found & ALONG else "edge" if found & EDGE else "vertex"
            yield Placement(a, b, offset, free, place)


def _points(shape: Shape) -> set[Vector]:
    """The vertices of a doubled shape, and the lattice points or else the middles of edges."""
    found = set(shape.vertices)
    for p, q in edges(shape):
        v = (q[0] - p[0], q[1] - p[1])
        parts = gcd(*v) // 2
        parts = 2 if parts == 1 else parts
        found.update((p[0] + i * v[0] // parts, p[1] + i * v[1] // parts) for i in range(1, parts))
    return found


def small_shapes(least: int, most: int, grid: int = 3) -> list[Shape]:
    """The shapes of so many vertices."""
    sizes = range(least, most + 1)
    return [
        shape
        for size, closed in product(sizes, (False, True))
        if size > 2 or not closed
        for shape in shapes(size, closed=closed, grid=grid)
    ]


@cache
def complete() -> tuple[Placement, ...]:
    """Every placement of two shapes of up to 3 vertices, or of 4 and up to 2, up to symmetry."""
    small = small_shapes(1, 3)
    pairs = [(a, b) for a in small for b in small if _key(b) <= _key(a)]
    pairs += product(small_shapes(4, 4), small_shapes(1, 2))
    found: list[Placement] = []
    for a, b in pairs:
        symmetries = _stabilizer(a, b)
        if symmetries is not None:
            found += (
                placement
                for placement in placements(a, b)
                if all(placement.offset <= move(placement.offset) for move in symmetries)
            )
    return tuple(found)


def _key(shape: Shape) -> tuple[int, bool, Shape]:
    return len(shape.vertices), shape.closed, shape


def _stabilizer(a: Shape, b: Shape) -> list[Callable[[Vector], Vector]] | None:
    """What symmetries of a pair of shapes do to the offset; None if the pair has a lesser image.

    A symmetry may exchange the shapes.
    """
    own = (_key(a), _key(b))
    moves: list[Callable[[Vector], Vector]] = []
    for matrix in SYMMETRIES:
        c, d = image(matrix, a), image(matrix, b)
        images = [(_key(c), _key(d)), (_key(d), _key(c))]
        if max(images) < own:
            return None
        moves += [
            partial(move_offset, matrix, a, b, exchanged=exchanged)
            for exchanged in (False, True)
            if images[exchanged] == own
        ]
    return moves


def move_offset(matrix: Matrix, a: Shape, b: Shape, offset: Vector, *, exchanged: bool) -> Vector:
    """The offset of the images of two shapes, or with ``exchanged`` that of the other one."""
    x, y = turned(matrix, offset)
    left, low = corner([turned(matrix, v) for v in a.vertices])
    other_left, other_low = corner([turned(matrix, v) for v in b.vertices])
    x, y = x + 2 * (left - other_left), y + 2 * (low - other_low)
    return (-x, -y) if exchanged else (x, y)
