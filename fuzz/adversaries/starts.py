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
from exactpt.filters.rows import AFFINE, CURVED, GENERAL, OWN, STRAIGHT, TURNING, Errors, Table
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
Grid: TypeAlias = list[tuple[int, int]]


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
        p, q = _shape(rng), _shape(rng)
        aim = rng.choice(AIMS)
        p, q = aim(rng, p, q)
        if aim is not _at_random:
            q = _nudged(rng, q)
        yield _row(rng, kind, (p, q), is_random=aim is _at_random)


def _row(rng: Random, kind: int, shapes: tuple[Shape, Shape], *, is_random: bool) -> Row:
    """Return two pieces that have two shapes at some time."""
    t = rng.choice((0.0, 1.0, rng.uniform(-9.0, 9.0)))
    pieces = [
        _moving(rng, shapes[0], kind, t),
        _moving(rng, shapes[1], rng.choice(list(KINDS.values())), t),
    ]
    rng.shuffle(pieces)
    table = Table()
    i, j = (piece.add_to(table, k, t - 1.0, t + 1.0) for k, piece in enumerate(pieces))
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
    a, b = _on_grid(p, q)
    if any(_meet(a[i], a[j], b[k], b[n]) for i, j in p.edges for k, n in q.edges):
        return True
    return any(_is_inside(v, a, p.edges) for v in b) or any(_is_inside(v, b, q.edges) for v in a)


def _on_grid(p: Shape, q: Shape) -> tuple[Grid, Grid]:
    """Return the points times the common denominator of all coordinates."""
    points = p.points + q.points
    scale = reduce(lcm, (int(c.denominator) for point in points for c in point))
    grid = [
        (
            int(x.numerator) * (scale // int(x.denominator)),
            int(y.numerator) * (scale // int(y.denominator)),
        )
        for x, y in points
    ]
    return grid[: len(p.points)], grid[len(p.points) :]


def _turn(a: tuple[int, int], b: tuple[int, int], c: tuple[int, int]) -> int:
    cross = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (cross > 0) - (cross < 0)


def _meet(a: tuple[int, int], b: tuple[int, int], c: tuple[int, int], d: tuple[int, int]) -> bool:
    """Return True if two closed segments have a common point."""
    for i in (0, 1):
        if max(a[i], b[i]) < min(c[i], d[i]) or max(c[i], d[i]) < min(a[i], b[i]):
            return False
    return _turn(a, b, c) * _turn(a, b, d) <= 0 and _turn(c, d, a) * _turn(c, d, b) <= 0


def _is_inside(v: tuple[int, int], points: Grid, edges: Edges) -> bool:
    """Return True if an odd number of edges of rings crosses the ray to the right of a point."""
    if all(j - i in {0, 1} for i, j in edges):
        return False  # chains and points
    inside = False
    for i, j in edges:
        a, b = points[i], points[j]
        if (a[1] > v[1]) != (b[1] > v[1]):
            upward = 1 if b[1] > a[1] else -1
            inside ^= _turn(a, b, v) * upward > 0
    return inside


def _shape(rng: Random) -> Shape:
    """Return a shape of small integers, perhaps scaled."""
    points, edges = rng.choice(SHAPES)(rng)
    scale = rng.choice((QQ(1), QQ(1), QQ(1, 3), QQ(5, 7), power(-40), power(30)))
    return Shape([(x * scale, y * scale) for x, y in points], edges)


def _ring(first: int, n: int) -> Edges:
    return [(first + i, first + (i + 1) % n) for i in range(n)]


def _some(rng: Random, n: int) -> list[Point]:
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
    w, h = rng.randint(2, 9), rng.randint(2, 9)
    u, v = rng.randint(1, w - 1), rng.randint(1, h - 1)
    corners = [(0, 0), (w, 0), (w, v), (u, v), (u, h), (0, h)]
    return Shape([(QQ(x), QQ(y)) for x, y in corners], _ring(0, 6))


def _rectangle(x: int, y: int, w: int, h: int) -> list[Point]:
    corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
    return [(QQ(a), QQ(b)) for a, b in corners]


def _frame(rng: Random) -> Shape:
    """A square with a hole."""
    size = rng.randint(4, 9)
    hole = _rectangle(1, 1, size - 2, size - 2)
    return Shape(_rectangle(0, 0, size, size) + hole[::-1], _ring(0, 4) + _ring(4, 4))


def _two_parts(rng: Random) -> Shape:
    """Two squares that are far from each other."""
    x, y = rng.randint(9, 20), rng.randint(-9, 9)
    return Shape(_rectangle(0, 0, 2, 2) + _rectangle(x, y, 2, 1), _ring(0, 4) + _ring(4, 4))


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
    p, q = (_scaled(s, 9 / _size(s)) for s in (p, q))
    dx, dy = (rational(rng.uniform(-27.0, 27.0)) for _ in range(2))
    return p, _shifted(q, dx, dy)


def _size(shape: Shape) -> QQ:
    return max(abs(c) for point in shape.points for c in point) or QQ(1)


def _center(shape: Shape) -> Point:
    x, y = (sum((point[axis] for point in shape.points), QQ(0)) for axis in (0, 1))
    return x / len(shape.points), y / len(shape.points)


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
    (x, y), (mx, my) = rng.choice(p.points), _center(p)
    part = rng.choice((QQ(1), QQ(1, 2), power(-30)))
    vx, vy = rng.choice(small.points)
    return p, _shifted(small, x + part * (mx - x) - vx, y + part * (my - y) - vy)


def _at_a_height(rng: Random, p: Shape, _: Shape) -> tuple[Shape, Shape]:
    """Place a small square at the height of a vertex of p, to the left of it."""
    x, y = rng.choice(p.points)
    left = min(a for a, _ in p.points)
    at = left + (x - left) * QQ(rng.randint(1, 7), 8)
    side = _size(p) / 64
    points = [(at + side * a, y + side * b) for a, b in _rectangle(0, 0, 1, 1)]
    return p, Shape(points, _ring(0, 4))


def _part_inside(rng: Random, p: Shape, _: Shape) -> tuple[Shape, Shape]:
    """Place one of two small squares, which are one piece, inside p, and the other one outside."""
    side, (x, y) = _size(p) / 50, _center(p)
    square = [(x + side * a, y + side * b) for a, b in _rectangle(0, 0, 1, 1)]
    far = [(a + 4 * _size(p), b) for a, b in square]
    parts = square + far if rng.random() < 0.5 else far + square
    return p, Shape(parts, _ring(0, 4) + _ring(4, 4))


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


def _nudged(rng: Random, q: Shape) -> Shape:
    """Move a shape by a few roundings of its coordinates, or not at all."""
    size = max(abs(c) for point in q.points for c in point)
    steps = [rng.choice((0, 0, 0, 1, -1, 3, -20, 1000)) for _ in range(2)]
    dx, dy = (size * step * rational(U) for step in steps)
    return _shifted(q, dx, dy)


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
    degrees = {STRAIGHT: [2, 2], CURVED: [4, 4], TURNING: [4, 4, 2], AFFINE: [4, 4, 2, 2, 2, 2]}
    frame: list[Polynomial] = [
        tuple(QQ(rng.randint(-4, 4)) for _ in range(n)) + (QQ(0),) * (4 - n) for n in degrees[kind]
    ]
    a, b, c, d = QQ(1), QQ(0), QQ(0), QQ(1)
    turn = rng.choice(TURNS) if kind == TURNING else TURNS[0]
    if kind == TURNING:
        h = value(frame[2], at)
        cosine, sine = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
        a, c = cosine * turn[0] - sine * turn[1], sine * turn[0] + cosine * turn[1]
        b, d = -c, a
    elif kind == AFFINE:
        a, b, c, d = (value(f, at) for f in frame[2:])
        if a * d == b * c:
            return _since_0(rng, shape, kind, at)
    px, py, det = value(frame[0], at), value(frame[1], at), a * d - b * c
    around = [(x - px, y - py) for x, y in shape.points]
    places = [((d * x - b * y) / det, (a * y - c * x) / det) for x, y in around]
    near, error = _near(rng, places)
    near_frame = [nearest_float(v) for f in frame for v in f]
    errors = Errors(error, 0.0, 0.0)
    return Piece(kind, places, frame, [], near, near_frame, [], errors, shape.edges, turn=turn)


def _own(rng: Random, shape: Shape, t: QQ) -> Piece:
    """Return a piece of which each vertex moves by itself."""

    def through(x: QQ) -> Polynomial:
        slope, bend = QQ(rng.randint(-3, 3)), QQ(rng.randint(-3, 3))
        return x - slope * t - bend * t * t, slope, bend, QQ(0)

    own = [(through(x), through(y)) for x, y in shape.points]
    near = [nearest_float(c) for pair in own for f in pair for c in f]
    return Piece(OWN, [], [], own, [], [0.0] * 24, near, Errors(0.0, 0.0, 0.0), shape.edges)


def _general(rng: Random, shape: Shape, t: QQ) -> Piece:
    """Return a piece of vertices that are quotients of polynomials of degree 5."""

    def through(x: QQ) -> Polynomial:
        rest = [QQ(rng.randint(-3, 3), 2**i) for i in range(1, 6)]
        return x - value((QQ(0), *rest), t), *rest

    frame = [0.0] * 24
    frame[0], frame[4] = (rng.choice((0.0, nearest_float(c), 1.0 / 3.0)) for c in shape.points[0])
    ax, ay = rational(frame[0]), rational(frame[4])
    vertices: list[tuple[Polynomial, Polynomial, Polynomial]] = []
    for x, y in shape.points:
        c = QQ(rng.randint(-3, 3), 8)
        w = (QQ(1), 2 * c, c * c + QQ(1, 64), QQ(0), QQ(0), QQ(0))  # (1 + c t)^2 + (t / 8)^2
        at_t = value(w, t)
        vertices.append((through((x - ax) * at_t), through((y - ay) * at_t), w))
    exact = Errors(0.0, 0.0, 0.0)
    return Piece(GENERAL, [], [], [], [], frame, [], exact, shape.edges, general=vertices)


def _near(rng: Random, places: list[Point]) -> tuple[list[tuple[float, float]], float]:
    """Return doubles near places, rounded or farther off, and a bound on what they are off."""
    size = max(abs(c) for place in places for c in place) or QQ(1)
    off = size * rng.choice((QQ(0), QQ(0), power(-45), power(-20)))

    def moved(c: QQ) -> float:
        return nearest_float(c + rng.choice((-1, 1)) * off)

    near = [(moved(x), moved(y)) for x, y in places]
    pairs = zip(near, places, strict=True)
    worst = max(abs(rational(v) - c) for one, two in pairs for v, c in zip(one, two, strict=True))
    bound = nearest_float(worst)
    return near, bound if rational(bound) >= worst else bound * (1.0 + 2.0 * U)


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
