"""Whether two pieces are disjoint at one time: what the filter claims, against rationals.

``python -m fuzz.adversaries.starts --rows 1000000 --seed 1``. A row is a pair of pieces at one
time. Most are aimed: a vertex of one is on a vertex or on an edge of the other, edges overlap, one
piece or a part of it is just inside the other, or in a hole of it; then one is moved by a few
roundings, or not at all. Half of them get radii; those of disjoint pieces add up to their distance
but for a few roundings. Stated errors are used in full. If the true pieces have a point in common,
the filter must not claim that they are disjoint. The last column is how often it claims so if they
are: of pairs that are placed at random, it should be nearly always.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import reduce
from itertools import pairwise
from math import cos, lcm, pi, sin
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt.filters.rounding import U
from exactpt.filters.rows import (
    AFFINE,
    CURVED,
    EXACT,
    FRAME,
    GENERAL,
    OWN,
    PATH_X,
    PATH_Y,
    STRAIGHT,
    TURNING,
    Errors,
    Table,
)
from exactpt.filters.starts import Starts
from exactpt.kernel.numbers import QQ, nearest_float, rational
from exactpt.pair.nearest_at import squared_from_segment
from fuzz.adversaries.boxes import show
from fuzz.adversaries.pieces import KINDS, TURNS, Piece, Point, Polynomial, power, value

__all__ = ["Found", "Row", "Shape", "attack", "drawn", "share_a_point"]

ROUNDED: Final = 0.5
"""The part of the pairs that get radii."""
SMALL: Final = 100
"""Pairs of vertices up to which the distance of two shapes is computed."""

Edges: TypeAlias = list[tuple[int, int]]


class Node(NamedTuple):
    """A point with integer coordinates."""

    x: int
    y: int


Grid: TypeAlias = list[Node]


class Shape(NamedTuple):
    """Points at one time, and the edges between them."""

    points: list[Point]
    edges: Edges


@dataclass
class Found:
    """What an attack found.

    Attributes:
        rows: how many pairs were asked.
        near: of how many one piece was moved by at most a few roundings from where they touch.
        common: how many have a point in common.
        wrong: of how many of these the filter claimed that they are disjoint.
        first: the first of these.
        random: how many disjoint pairs were placed at random.
        told: of how many of these the filter said so.
    """

    rows: int = 0
    near: int = 0
    common: int = 0
    wrong: int = 0
    first: str = ""
    random: int = 0
    told: int = 0

    def line(self, name: str) -> str:
        """Return a line of the table."""
        told = 100.0 * self.told / max(self.random, 1)
        counts = f"{self.rows:>11,}{self.near:>11,}{self.common:>11,}{self.wrong:>7}"
        return f"{name:20}{counts}{self.random:>11,}{told:>9.2f} %"


def attack(kind: int, rows: int, seed: int) -> Found:
    """Attack with a piece of one kind of motion and one of any kind."""
    rng, found = Random(f"radii {seed}"), Found()
    for row in drawn(kind, rows, seed):
        is_common = share_a_point(row.first, row.second)
        is_rounded = rng.random() < ROUNDED and _is_small(row)
        if is_rounded:
            squared = QQ(0) if is_common else _squared_distance(row.first, row.second)
            is_common |= _add_radii(rng, row, squared)
        claim = Starts(row.table, row.t).are_disjoint(row.i, row.j)
        found.rows += 1
        found.near += is_rounded or not row.is_random
        if is_common:
            found.common += 1
            if claim:
                found.wrong += 1
                radii = f", radii {list(row.table.radius)}" if is_rounded else ""
                found.first = found.first or f"{row.first} and {row.second} at {row.t}{radii}"
        elif row.is_random and not is_rounded:
            found.random += 1
            found.told += claim
    return found


class Row(NamedTuple):
    """Two pieces at one time.

    Attributes:
        table: has the pieces.
        i, j: their numbers.
        t: the time.
        first, second: their shapes at the time, exactly.
        is_random: whether they are placed at random, not aimed at each other.
    """

    table: Table
    i: int
    j: int
    t: float
    first: Shape
    second: Shape
    is_random: bool


def drawn(kind: int, rows: int, seed: int) -> Iterator[Row]:
    """Yield pairs of a piece of one kind of motion and one of any kind."""
    rng = Random(seed)
    for _ in range(rows):
        p = _shape(rng)
        q = _shape(rng)
        aim = rng.choice(AIMS)
        is_random = aim is _at_random
        p, q = aim(rng, p, q)
        if not is_random:
            q = _nudged(rng, q)
        yield _row(rng, kind, (p, q), is_random=is_random)


def _row(rng: Random, kind: int, shapes: tuple[Shape, Shape], *, is_random: bool) -> Row:
    """Return two pieces that have two shapes at some time."""
    t = rng.choice((0.0, 1.0, rng.uniform(-9.0, 9.0)))
    first_shape, second_shape = shapes
    of_kind = _moving(rng, first_shape, kind, t)
    other_kind = rng.choice(list(KINDS.values()))
    pieces = [of_kind, _moving(rng, second_shape, other_kind, t)]
    rng.shuffle(pieces)  # the filter may ask about them in either order
    table = Table()
    i, j = (piece.add_to(table, body, t - 1.0, t + 1.0) for body, piece in enumerate(pieces))
    # What is claimed is about the true pieces, which the rows of the table are only near.
    first, second = (Shape(piece.at(rational(t)), piece.edges) for piece in pieces)
    return Row(table, i, j, t, first, second, is_random)


def _is_small(row: Row) -> bool:
    return len(row.first.points) * len(row.second.points) <= SMALL


def _add_radii(rng: Random, row: Row, squared: QQ) -> bool:
    """Add radii whose sum is the distance of the pieces but for a few roundings, or less or more.

    Args:
        rng: draws.
        row: the pieces.
        squared: the square of their distance; if it is 0, the radii are any.

    Returns:
        Whether the rounded pieces have a point in common.
    """
    distance = math.sqrt(nearest_float(squared)) or rng.random()
    steps = rng.choice((0, 1, -1, 2, -2, 3, -3, 20, -20, 1000, -1000))
    both = distance * rng.choice((1.0, 1.0, 1.0, 1.0, 0.9, 1.1)) * (1.0 + steps * U)
    one = both * rng.choice((0.0, 0.5, rng.random()))
    other = both - one
    row.table.radius[row.i], row.table.radius[row.j] = one, other
    return squared <= (rational(one) + rational(other)) ** 2


def _squared_distance(p: Shape, q: Shape) -> QQ:
    """Return the squared distance of two shapes that have no common point."""
    return min(
        squared_from_segment(v, (one.points[i], one.points[j]))
        for one, other in ((p, q), (q, p))
        for v in other.points
        for i, j in one.edges
    )


def share_a_point(p: Shape, q: Shape) -> bool:
    """Return True if edges meet, or a vertex of one has an odd number of edges to its right."""
    of_p, of_q = _on_grid(p, q)
    for i, j in p.edges:
        for k, n in q.edges:
            if _meet(of_p[i], of_p[j], of_q[k], of_q[n]):
                return True
    is_q_inside = any(_is_inside(v, of_p, p.edges) for v in of_q)
    return is_q_inside or any(_is_inside(v, of_q, q.edges) for v in of_p)


def _on_grid(p: Shape, q: Shape) -> tuple[Grid, Grid]:
    """Return the points times the common denominator of all coordinates."""
    points = p.points + q.points
    scale = QQ(reduce(lcm, (int(c.denominator) for point in points for c in point)))
    grid = [Node(int(x * scale), int(y * scale)) for x, y in points]
    return grid[: len(p.points)], grid[len(p.points) :]


def _turn(a: Node, b: Node, c: Node) -> int:
    """Return 1 if the path a, b, c turns to the left, -1 to the right, 0 if it is straight."""
    cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
    return (cross > 0) - (cross < 0)


def _meet(a: Node, b: Node, c: Node, d: Node) -> bool:
    """Return True if two closed segments have a common point."""
    # Segments of one line have it just if their boxes have one; for these all turns are 0.
    if max(a.x, b.x) < min(c.x, d.x) or max(c.x, d.x) < min(a.x, b.x):
        return False
    if max(a.y, b.y) < min(c.y, d.y) or max(c.y, d.y) < min(a.y, b.y):
        return False
    is_ab_between = _turn(c, d, a) * _turn(c, d, b) <= 0
    is_cd_between = _turn(a, b, c) * _turn(a, b, d) <= 0
    return is_ab_between and is_cd_between


def _is_inside(v: Node, points: Grid, edges: Edges) -> bool:
    """Return True if an odd number of edges of rings crosses the ray to the right of a point."""
    is_open = all(j - i in {0, 1} for i, j in edges)  # a chain, or a point
    if is_open:
        return False
    inside = False
    for i, j in edges:
        a = points[i]
        b = points[j]
        if (a.y > v.y) == (b.y > v.y):
            continue  # both ends are on one side of the ray's line
        upward = 1 if b.y > a.y else -1
        is_right_of_v = _turn(a, b, v) * upward > 0
        inside ^= is_right_of_v
    return inside


def _shape(rng: Random) -> Shape:
    """Return a shape of small integers, perhaps scaled."""
    points, edges = rng.choice(SHAPES)(rng)
    scale = rng.choice((QQ(1), QQ(1), QQ(1, 3), QQ(5, 7), power(-40), power(30)))
    return Shape([(x * scale, y * scale) for x, y in points], edges)


def _ring(first: int, n: int) -> Edges:
    """Return the edges of a ring of n vertices."""
    return [(first + i, first + (i + 1) % n) for i in range(n)]


TWO_SQUARES: Final = _ring(0, 4) + _ring(4, 4)
"""The edges of two rings of four vertices."""


def _some(rng: Random, n: int) -> list[Point]:
    """Return points of a small grid."""
    return [(QQ(rng.randint(-9, 9)), QQ(rng.randint(-9, 9))) for _ in range(n)]


def _point(rng: Random) -> Shape:
    return Shape(_some(rng, 1), [(0, 0)])


def _chain(rng: Random) -> Shape:
    n = rng.randint(2, 6)
    return Shape(_some(rng, n), list(pairwise(range(n))))


def _large(rng: Random) -> Shape:
    """A star of so many edges that edges of two are compared by strips."""
    return _star_of(rng, rng.randint(20, 30))


def _star(rng: Random) -> Shape:
    return _star_of(rng, rng.randint(3, 9))


def _star_of(rng: Random, n: int) -> Shape:
    """A polygon around the origin, convex or not; of doubles."""
    radii = [rng.uniform(1.0, 9.0) if rng.random() < 0.7 else 5.0 for _ in range(n)]
    angles = sorted(rng.uniform(0.0, 2.0 * pi) for _ in range(n))
    around = zip(radii, angles, strict=True)
    points = [(rational(r * cos(a)), rational(r * sin(a))) for r, a in around]
    return Shape(points, _ring(0, n))


def _corner(rng: Random) -> Shape:
    """An L on the grid: many vertices at equal heights."""
    width = rng.randint(2, 9)
    height = rng.randint(2, 9)
    x = rng.randint(1, width - 1)
    y = rng.randint(1, height - 1)
    corners = [(0, 0), (width, 0), (width, y), (x, y), (x, height), (0, height)]
    return Shape([(QQ(x), QQ(y)) for x, y in corners], _ring(0, 6))


def _rectangle(left: int, bottom: int, width: int, height: int) -> list[Point]:
    """Return the corners of a rectangle, counter-clockwise."""
    right = left + width
    top = bottom + height
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    return [(QQ(x), QQ(y)) for x, y in corners]


def _frame(rng: Random) -> Shape:
    """A square with a hole."""
    size = rng.randint(4, 9)
    outline = _rectangle(0, 0, size, size)
    hole = _rectangle(1, 1, size - 2, size - 2)
    clockwise = hole[::-1]
    return Shape(outline + clockwise, TWO_SQUARES)


def _two_parts(rng: Random) -> Shape:
    """Two squares that are far from each other."""
    x = rng.randint(9, 20)
    y = rng.randint(-9, 9)
    return Shape(_rectangle(0, 0, 2, 2) + _rectangle(x, y, 2, 1), TWO_SQUARES)


SHAPES: Final = (_point, _chain, _star, _star, _large, _corner, _frame, _two_parts)


def _shifted(shape: Shape, dx: QQ, dy: QQ) -> Shape:
    return Shape([(x + dx, y + dy) for x, y in shape.points], shape.edges)


def _scaled(shape: Shape, factor: QQ) -> Shape:
    return Shape([(x * factor, y * factor) for x, y in shape.points], shape.edges)


def _on(rng: Random, shape: Shape) -> Point:
    """Return a point of an edge, often an end."""
    (ax, ay), (bx, by) = (shape.points[k] for k in rng.choice(shape.edges))
    part = rng.choice((QQ(0), QQ(0), QQ(1, 2), QQ(3, 8), QQ(2, 7)))
    return ax + part * (bx - ax), ay + part * (by - ay)


def _at_random(rng: Random, p: Shape, q: Shape) -> tuple[Shape, Shape]:
    """Make both of one size, and place them so that their boxes meet often."""
    p = _scaled(p, 9 / _size(p))
    q = _scaled(q, 9 / _size(q))
    dx = rational(rng.uniform(-27.0, 27.0))
    dy = rational(rng.uniform(-27.0, 27.0))
    return p, _shifted(q, dx, dy)


def _size(shape: Shape) -> QQ:
    """Return the largest size of a coordinate; 1 if all are 0."""
    return max(abs(c) for point in shape.points for c in point) or QQ(1)


def _center(shape: Shape) -> Point:
    """Return the mean of the vertices."""
    n = len(shape.points)
    x = sum((x for x, _ in shape.points), QQ(0))
    y = sum((y for _, y in shape.points), QQ(0))
    return x / n, y / n


def _touching(rng: Random, p: Shape, q: Shape) -> tuple[Shape, Shape]:
    """Place a vertex of q on an edge or a vertex of p."""
    x, y = _on(rng, p)
    vx, vy = rng.choice(q.points)
    return p, _shifted(q, x - vx, y - vy)


def _outside(rng: Random, p: Shape, q: Shape) -> tuple[Shape, Shape]:
    """Place q beyond an extreme vertex of p, with an extreme vertex on it: they only touch."""
    axis = rng.choice((0, 1))
    x, y = max(p.points, key=lambda point: point[axis])
    vx, vy = min(q.points, key=lambda point: point[axis])
    return p, _shifted(q, x - vx, y - vy)


def _overlapping(rng: Random, p: Shape, _: Shape) -> tuple[Shape, Shape]:
    """Turn p by half about a point of one of its edges: this edge overlaps with its image."""
    x, y = _on(rng, p)
    return p, Shape([(2 * x - a, 2 * y - b) for a, b in p.points], p.edges)


def _nested(rng: Random, p: Shape, q: Shape) -> tuple[Shape, Shape]:
    """Place a small q, or one part of it, near the middle of p, or just inside of a vertex."""
    small = _scaled(q, rng.choice((QQ(1, 20), QQ(1, 100), power(-40))))
    if _size(small) > _size(p) / 9:
        small = _scaled(small, _size(p) / 9 / _size(small))
    corner_x, corner_y = rng.choice(p.points)
    center_x, center_y = _center(p)
    part = rng.choice((QQ(1), QQ(1, 2), power(-30)))  # of the way from the corner to the center
    x = corner_x + part * (center_x - corner_x)
    y = corner_y + part * (center_y - corner_y)
    vx, vy = rng.choice(small.points)
    return p, _shifted(small, x - vx, y - vy)


def _at_a_height(rng: Random, p: Shape, _: Shape) -> tuple[Shape, Shape]:
    """Place a small square at the height of a vertex of p, to the left of it."""
    vertex_x, y = rng.choice(p.points)
    left = min(x for x, _ in p.points)
    x = left + (vertex_x - left) * QQ(rng.randint(1, 7), 8)
    return p, Shape(_square((x, y), _size(p) / 64), _ring(0, 4))


def _part_inside(rng: Random, p: Shape, _: Shape) -> tuple[Shape, Shape]:
    """Place one of two small squares, which are one piece, inside p, and the other one outside."""
    size = _size(p)
    inside = _square(_center(p), size / 50)
    outside = [(x + 4 * size, y) for x, y in inside]
    parts = inside + outside if rng.random() < 0.5 else outside + inside
    return p, Shape(parts, TWO_SQUARES)


def _square(corner: Point, side: QQ) -> list[Point]:
    """Return the corners of a square, from the lower left one on."""
    x, y = corner
    return [(x + side * dx, y + side * dy) for dx, dy in _rectangle(0, 0, 1, 1)]


AIMS: Final = (
    _at_random,
    _touching,
    _touching,
    _outside,
    _overlapping,
    _nested,
    _at_a_height,
    _part_inside,
)


NUDGES: Final = (0, 0, 0, 1, -1, 3, -20, 1000)
"""Numbers of roundings by which a shape is moved."""


def _nudged(rng: Random, q: Shape) -> Shape:
    """Move a shape by a few roundings of its coordinates, or not at all."""
    rounding = max(abs(c) for point in q.points for c in point) * rational(U)
    steps_x = rng.choice(NUDGES)
    steps_y = rng.choice(NUDGES)
    return _shifted(q, steps_x * rounding, steps_y * rounding)


def _moving(rng: Random, shape: Shape, kind: int, t: float) -> Piece:
    """Return a piece that has a shape at a time, with a row that is as far off as it may be."""
    origin = 0.0
    if kind != STRAIGHT and rng.random() < 0.5:
        origin = rng.choice((t, t - 1.0, rng.uniform(-99.0, 99.0)))
    piece = _since_0(rng, shape, kind, rational(t) - rational(origin))
    return replace(piece, origin=origin)


def _since_0(rng: Random, shape: Shape, kind: int, at: QQ) -> Piece:
    """Return a piece whose polynomials are in the time since 0."""
    if kind == OWN:
        return _own(rng, shape, at)
    if kind == GENERAL:
        return _general(rng, shape, at)
    frame = [_polynomial(rng, terms) for terms in TERMS[kind]]
    turn = rng.choice(TURNS) if kind == TURNING else TURNS[0]
    matrix = _matrix(frame[2:], kind, turn, at)
    if matrix.determinant == 0:
        return _since_0(rng, shape, kind, at)
    path_x = value(frame[0], at)
    path_y = value(frame[1], at)
    places = [matrix.solve(x - path_x, y - path_y) for x, y in shape.points]
    near, error = _near(rng, places)
    return Piece(
        kind=kind,
        places=places,
        frame=frame,
        own=[],
        near_places=near,
        near_frame=[nearest_float(c) for polynomial in frame for c in polynomial],
        near_own=[],
        errors=Errors(place=error, path=0.0, speed=0.0),
        edges=shape.edges,
        turn=turn,
    )


TERMS: Final = {
    STRAIGHT: [2, 2],
    CURVED: [4, 4],
    TURNING: [4, 4, 2],
    AFFINE: [4, 4, 2, 2, 2, 2],
}
"""How many coefficients the polynomials of a frame have: the path, then the turn or the matrix."""


class Matrix(NamedTuple):
    """(a, b; c, d)."""

    a: QQ
    b: QQ
    c: QQ
    d: QQ

    @property
    def determinant(self) -> QQ:
        """a d - b c."""
        return self.a * self.d - self.b * self.c

    def solve(self, x: QQ, y: QQ) -> Point:
        """Return what the matrix takes to (x, y), by Cramer's rule."""
        place_x = (self.d * x - self.b * y) / self.determinant
        place_y = (self.a * y - self.c * x) / self.determinant
        return place_x, place_y


def _matrix(polynomials: list[Polynomial], kind: int, turn: tuple[QQ, QQ], at: QQ) -> Matrix:
    """Return the matrix of a piece at a time; of the rest of its frame, after the path."""
    values = [value(f, at) for f in polynomials]
    if kind == AFFINE:
        return Matrix(*values)
    if kind != TURNING:
        return Matrix(QQ(1), QQ(0), QQ(0), QQ(1))
    (h,) = values
    cosine = (1 - h * h) / (1 + h * h)
    sine = 2 * h / (1 + h * h)
    turn_cosine, turn_sine = turn
    cosine_of_both = cosine * turn_cosine - sine * turn_sine
    sine_of_both = sine * turn_cosine + cosine * turn_sine
    return Matrix(cosine_of_both, -sine_of_both, sine_of_both, cosine_of_both)


def _polynomial(rng: Random, terms: int) -> Polynomial:
    """Return small coefficients, and zeros up to four of them."""
    small = tuple(QQ(rng.randint(-4, 4)) for _ in range(terms))
    return small + (QQ(0),) * (4 - terms)


def _own(rng: Random, shape: Shape, t: QQ) -> Piece:
    """Return a piece of which each vertex moves by itself."""

    def through(x: QQ) -> Polynomial:
        """Return a parabola that has this value at t."""
        slope = QQ(rng.randint(-3, 3))
        bend = QQ(rng.randint(-3, 3))
        return x - slope * t - bend * t * t, slope, bend, QQ(0)

    own = [(through(x), through(y)) for x, y in shape.points]
    return Piece(
        kind=OWN,
        places=[],
        frame=[],
        own=own,
        near_places=[],
        near_frame=[0.0] * int(FRAME),
        near_own=[nearest_float(c) for of_vertex in own for f in of_vertex for c in f],
        errors=EXACT,
        edges=shape.edges,
    )


def _general(rng: Random, shape: Shape, t: QQ) -> Piece:
    """Return a piece of vertices that are quotients of polynomials of degree 5."""

    def through(x: QQ) -> Polynomial:
        """Return a polynomial of degree 5 that has this value at t."""
        rest = [QQ(rng.randint(-3, 3), 2**i) for i in range(1, 6)]
        return x - value((QQ(0), *rest), t), *rest

    def near(c: QQ) -> float:
        """Return the coordinate of an anchor, near a vertex or not."""
        return rng.choice((0.0, nearest_float(c), 1.0 / 3.0))

    first_x, first_y = shape.points[0]
    anchor_x = near(first_x)
    anchor_y = near(first_y)
    frame = [0.0] * int(FRAME)
    frame[int(PATH_X)] = anchor_x
    frame[int(PATH_Y)] = anchor_y
    vertices: list[tuple[Polynomial, Polynomial, Polynomial]] = []
    for x, y in shape.points:
        c = QQ(rng.randint(-3, 3), 8)
        w = (QQ(1), 2 * c, c * c + QQ(1, 64), QQ(0), QQ(0), QQ(0))  # (1 + c t)^2 + (t / 8)^2
        w_at_t = value(w, t)
        of_x = through((x - rational(anchor_x)) * w_at_t)
        of_y = through((y - rational(anchor_y)) * w_at_t)
        vertices.append((of_x, of_y, w))
    return Piece(
        kind=GENERAL,
        places=[],
        frame=[],
        own=[],
        near_places=[],
        near_frame=frame,
        near_own=[],
        errors=EXACT,
        edges=shape.edges,
        general=vertices,
    )


def _near(rng: Random, places: list[Point]) -> tuple[list[tuple[float, float]], float]:
    """Return doubles near places, rounded or farther off, and a bound on what they are off."""
    size = max(abs(c) for place in places for c in place) or QQ(1)
    off = size * rng.choice((QQ(0), QQ(0), power(-45), power(-20)))

    def moved(c: QQ) -> float:
        return nearest_float(c + rng.choice((-1, 1)) * off)

    near = [(moved(x), moved(y)) for x, y in places]
    errors = [
        abs(rational(near_coordinate) - coordinate)
        for near_place, place in zip(near, places, strict=True)
        for near_coordinate, coordinate in zip(near_place, place, strict=True)
    ]
    worst = max(errors)
    bound = nearest_float(worst)
    if rational(bound) < worst:  # it was rounded down
        bound *= 1.0 + 2.0 * U
    return near, bound


def main() -> None:
    """Attack, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    heads = f"{'rows':>11}{'near':>11}{'common':>11}{'wrong':>7}{'random':>11}{'told':>9}"
    show(f"{'':20}{heads}")
    for name, kind in KINDS.items():
        found = attack(kind, options.rows // len(KINDS), options.seed)
        show(f"{found.line(f'starts, {name}')} {found.first}")


if __name__ == "__main__":
    main()
