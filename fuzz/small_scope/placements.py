"""Placements: two shapes that touch without overlapping, and the directions that separate them.

Lengths are in half units of the grid, so that midpoints of edges are integral.
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

Whether a small translation separates two touching shapes depends on its direction only by
the signs of cross products with edges: these 32 represent all directions.
"""

FINE: Final = 256
"""A small translation is a direction divided by this. The cross product of a direction with an
edge is at most 9 times 6 in absolute value, and that of lattice vectors is an integer: so a small
translation changes no sign except 0."""

TOUCH, EDGE, ALONG = (1 << (len(DIRECTIONS) + k) for k in range(3))
ALL: Final = TOUCH - 1


class Placement(NamedTuple):
    """Two shapes that touch.

    Attributes:
        a, b: the shapes.
        offset: position of the corner of a relative to that of b, in half units.
        free: bit i is set if a small translation of a in direction i separates them.
        place: what touches: "vertex" if only vertices coincide, "edge" if a vertex is in the
            interior of an edge, "along" if edges share more than a point.
    """

    a: Shape
    b: Shape
    offset: Vector
    free: int
    place: str

    @property
    def kinds(self) -> str:
        """The kinds of the shapes, independent of the order of the shapes."""
        ranked = sorted((self.a, self.b), key=lambda s: (len(s.vertices), s.closed))
        return " and ".join(shape.kind for shape in ranked)


@lru_cache(1 << 18)
def _blocked(v: Vector, w: Vector, r: Vector) -> int:
    """How the edge from r to r + v meets the edge from 0 to w.

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
    """The union of the bits of `_blocked` over all pairs of edges, and those of an overlap."""
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
    """The bits of the directions (or opposite ones) in which p, moved slightly, is inside.

    Correct if p is then not on the boundary; the other cases are covered by `_blocked`.
    """
    fine = [(FINE * x, FINE * y) for x, y in polygon.vertices]
    return sum(
        1 << i
        for i, (x, y) in enumerate(DIRECTIONS)
        if contains(fine, (FINE * p[0] + sense * x, FINE * p[1] + sense * y))
    )


def disjoint(a: Shape, b: Shape, offset: Vector) -> bool:
    """Return True if two shapes neither touch nor overlap, a at an offset in half units."""
    return _meeting(_doubled(a), _doubled(b), offset) == 0


def placements(a: Shape, b: Shape) -> Iterator[Placement]:
    """All placements in which a touches b and can be separated from it in some direction.

    Vertices are placed on vertices, on lattice points inside edges and, if an edge has none, on
    its midpoint. (Overlapping lattice edges have a vertex at such a point.)
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
    """The vertices of a doubled shape, and lattice points or else midpoints of its edges."""
    found = set(shape.vertices)
    for p, q in edges(shape):
        v = (q[0] - p[0], q[1] - p[1])
        parts = gcd(*v) // 2
        parts = 2 if parts == 1 else parts
        found.update((p[0] + i * v[0] // parts, p[1] + i * v[1] // parts) for i in range(1, parts))
    return found


def small_shapes(least: int, most: int, grid: int = 3) -> list[Shape]:
    """The shapes with ``least`` to ``most`` vertices."""
    sizes = range(least, most + 1)
    return [
        shape
        for size, closed in product(sizes, (False, True))
        if size > 2 or not closed
        for shape in shapes(size, closed=closed, grid=grid)
    ]


@cache
def complete() -> tuple[Placement, ...]:
    """Every placement of two shapes with up to 3 vertices, or 4 and up to 2, up to symmetry."""
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
    """The actions on the offset of the symmetries of a pair of shapes; None if it is not canonical.

    A pair is canonical if no symmetry maps it to a lesser one. Symmetries may exchange the shapes.
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
    """The offset of the images of two shapes; with ``exchanged``, that of the other shape."""
    x, y = turned(matrix, offset)
    left, low = corner([turned(matrix, v) for v in a.vertices])
    other_left, other_low = corner([turned(matrix, v) for v in b.vertices])
    x, y = x + 2 * (left - other_left), y + 2 * (low - other_low)
    return (-x, -y) if exchanged else (x, y)
