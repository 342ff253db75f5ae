"""Shapes with few vertices on a small grid, up to translation; and the symmetries of the grid.

Integer geometry that shares no code with the package under test.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise, permutations, product
from typing import Final, NamedTuple, TypeAlias

__all__ = [
    "SYMMETRIES",
    "Matrix",
    "Shape",
    "Vector",
    "contains",
    "corner",
    "edges",
    "image",
    "meet",
    "on_segment",
    "shape_of",
    "shapes",
    "turned",
]

Vector: TypeAlias = tuple[int, int]
Matrix: TypeAlias = tuple[int, int, int, int]

SYMMETRIES: Final[tuple[Matrix, ...]] = tuple(
    matrix for u, v in product((1, -1), repeat=2) for matrix in ((u, 0, 0, v), (0, u, v, 0))
)
"""The eight symmetries of the grid, as row-major matrices; the identity is the first."""


class Shape(NamedTuple):
    """A point, a segment, an open chain or a simple polygon.

    Attributes:
        vertices: vertices with minimum x and minimum y 0; the lexicographically first listing.
        closed: whether it is a polygon.
    """

    vertices: tuple[Vector, ...]
    closed: bool

    @property
    def kind(self) -> str:
        """The kind of shape in one word, with the number of vertices if that varies."""
        size = len(self.vertices)
        if size < 3:
            return ("point", "segment")[size - 1]
        if not self.closed:
            return f"{size}-chain"
        return "triangle" if size == 3 else "quadrilateral"


def turned(matrix: Matrix, v: Vector) -> Vector:
    """The image of a vector."""
    a, b, c, d = matrix
    return a * v[0] + b * v[1], c * v[0] + d * v[1]


def corner(vertices: Sequence[Vector]) -> Vector:
    """The minimum x and the minimum y."""
    return min(x for x, _ in vertices), min(y for _, y in vertices)


def shape_of(vertices: tuple[Vector, ...], *, closed: bool) -> Shape:
    """The shape with these vertices, translated to the corner and listed canonically."""
    left, low = corner(vertices)
    moved = tuple((x - left, y - low) for x, y in vertices)
    listings = [moved, moved[::-1]]
    if closed:
        listings = [way[i:] + way[:i] for way in listings for i in range(len(way))]
    return Shape(min(listings), closed)


@cache
def image(matrix: Matrix, shape: Shape) -> Shape:
    """The image of a shape under a symmetry."""
    return shape_of(tuple(turned(matrix, v) for v in shape.vertices), closed=shape.closed)


@cache
def shapes(size: int, *, closed: bool, grid: int = 3) -> tuple[Shape, ...]:
    """All simple shapes of ``size`` vertices that fit on a square grid, up to translation.

    Straight angles are allowed at vertices; polygons have positive area.
    """
    places = [(x, y) for x in range(grid) for y in range(grid)]
    found = {
        shape_of(vertices, closed=closed)
        for vertices in permutations(places, size)
        if corner(vertices) == (0, 0) and vertices <= vertices[::-1]
    }
    return tuple(sorted(shape for shape in found if _is_simple(shape)))


def edges(shape: Shape) -> list[tuple[Vector, Vector]]:
    """The edges by their ends; a point is an edge from itself to itself."""
    v = shape.vertices
    found = [*pairwise(v)] or [(v[0], v[0])]
    if shape.closed:
        found.append((v[-1], v[0]))
    return found


def _is_simple(shape: Shape) -> bool:
    sides = edges(shape)
    for j, (c, d) in enumerate(sides):
        for i, (a, b) in enumerate(sides[:j]):
            if i + 1 == j and _folded(a, b, d):
                return False
            if shape.closed and (i, j) == (0, len(sides) - 1) and _folded(c, d, b):
                return False
            if not {a, b} & {c, d} and meet(a, b, c, d):
                return False
    return True


def _folded(a: Vector, b: Vector, c: Vector) -> bool:
    """Return True if two edges, from a to b and from b to c, overlap."""
    return _side(a, b, c) == 0 and (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0


def _side(a: Vector, b: Vector, c: Vector) -> int:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def on_segment(p: Vector, a: Vector, b: Vector) -> bool:
    """Return True if p lies on the closed segment ab."""
    return (
        _side(a, b, p) == 0
        and min(a[0], b[0]) <= p[0] <= max(a[0], b[0])
        and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])
    )


def meet(a: Vector, b: Vector, c: Vector, d: Vector) -> bool:
    """Return True if the closed segments ab and cd share a point."""
    if _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0:
        return True
    return on_segment(c, a, b) or on_segment(d, a, b) or on_segment(a, c, d) or on_segment(b, c, d)


def contains(vertices: Sequence[Vector], p: Vector) -> bool:
    """Return True if p is inside a simple polygon; undefined for points of its boundary."""
    inside = False
    for a, b in _around(vertices):
        if (a[1] > p[1]) != (b[1] > p[1]) and (_side(a, b, p) > 0) == (b[1] > a[1]):
            inside = not inside
    return inside


def _around(vertices: Sequence[Vector]) -> Iterator[tuple[Vector, Vector]]:
    return zip(vertices, [*vertices[1:], vertices[0]], strict=True)
