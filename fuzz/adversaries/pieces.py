"""Pieces of motion with rational numbers, and their rows of doubles, as far off as stated.

A row of the table stands for every piece of which the numbers are within its errors. Here the true
numbers are at the ends of what the errors allow, or between: exact, off by the stated error, thirds
and sevenths that were rounded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise
from random import Random
from typing import Final, TypeAlias

from exactpt.filters.rounding import U
from exactpt.filters.rows import AFFINE, CURVED, GENERAL, OWN, STRAIGHT, TURNING, Errors, Table
from exactpt.filters.rows import Piece as Row
from exactpt.kernel.numbers import QQ, nearest_float, rational

__all__ = ["KINDS", "STYLES", "TURNS", "Piece", "Point", "Polynomial", "made", "power"]

Polynomial: TypeAlias = tuple[QQ, ...]
Point: TypeAlias = tuple[QQ, QQ]

KINDS: Final = {
    "straight": int(STRAIGHT),
    "curved": int(CURVED),
    "turning": int(TURNING),
    "affine": int(AFFINE),
    "own": int(OWN),
    "general": int(GENERAL),
}
TURNS: Final = tuple(
    (QQ(a, c), QQ(b, c))
    for a, b, c in ((1, 0, 1), (3, -4, 5), (-5, 12, 13), (0, 1, 1), (-1, 0, 1), (-9999, 200, 10001))
)
"""Cosines and sines of constant turns."""
STYLES: Final = ("grid", "random", "far", "tiny", "subnormal", "thirds", "stated")
"""Small integers; doubles; places far from 0; below 2^-200; the least doubles; rounded rationals;
and errors that are much larger than rounding."""


@dataclass(frozen=True)
class Piece:
    """A piece of motion: the true numbers, and those of its row.

    Attributes:
        kind: as in the table.
        places: the true places; none if vertices move by themselves.
        frame: the true polynomials: p_x and p_y, then h, or a, b, c, d.
        own: of each vertex that moves by itself, the true polynomials of x and y.
        near_places, near_frame, near_own: the doubles near them.
        errors: bounds on what they are off.
        edges: pairs of vertices.
        radius: a bound of the radius, and the radius.
        turn: the true cosine and sine of a constant turn, after which the piece turns.
        general: of each vertex at (x / w, y / w) from an anchor the true polynomials, of one
            length; the anchor is in the frame.
        origin: the time since which all polynomials are.
    """

    kind: int
    places: list[Point]
    frame: list[Polynomial]
    own: list[tuple[Polynomial, Polynomial]]
    near_places: list[tuple[float, float]]
    near_frame: list[float]
    near_own: list[float]
    errors: Errors
    edges: list[tuple[int, int]]
    radius: float = 0.0
    turn: tuple[QQ, QQ] = TURNS[0]
    general: list[tuple[Polynomial, Polynomial, Polynomial]] = field(default_factory=list)
    origin: float = 0.0

    @property
    def size(self) -> int:
        """The number of vertices."""
        return len(self.places) or len(self.own) or len(self.general)

    def at(self, t: QQ) -> list[Point]:
        """Return where the vertices are at a time."""
        t -= rational(self.origin)
        if self.kind == GENERAL:
            ax, ay = rational(self.near_frame[0]), rational(self.near_frame[4])
            of_w = [(x, y, value(w, t)) for x, y, w in self.general]
            return [(ax + value(x, t) / w, ay + value(y, t) / w) for x, y, w in of_w]
        if self.kind == OWN:
            return [(value(x, t), value(y, t)) for x, y in self.own]
        px, py = value(self.frame[0], t), value(self.frame[1], t)
        a, b, c, d = self._matrix(t)
        return [(px + a * x + b * y, py + c * x + d * y) for x, y in self.places]

    def _matrix(self, t: QQ) -> tuple[QQ, QQ, QQ, QQ]:
        if self.kind == TURNING:
            h = value(self.frame[2], t)
            c, s = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
            turn_c, turn_s = self.turn
            cosine, sine = c * turn_c - s * turn_s, s * turn_c + c * turn_s
            return cosine, -sine, sine, cosine
        if self.kind == AFFINE:
            a, b, c, d = (value(f, t) for f in self.frame[2:])
            return a, b, c, d
        return QQ(1), QQ(0), QQ(0), QQ(1)

    def add_to(self, table: Table, body: int, start: float, end: float) -> int:
        """Add the row to a table; return its number."""
        xs, ys = [x for x, _ in self.near_places], [y for _, y in self.near_places]
        place = self._add_vertices(table, xs, ys)
        edge = table.add_edges(self.edges)
        box = (0.0, 0.0, 0.0, 0.0)
        if self.kind == TURNING:
            reach = max(map(math.hypot, xs, ys)) * (1.0 + 1e-10)
            box = (-reach, reach, -reach, reach)
        elif self.kind not in {OWN, GENERAL}:
            box = (min(xs), max(xs), min(ys), max(ys))
        row = Row(
            body=body,
            kind=self.kind,
            start=start,
            end=end,
            place=place,
            size=self.size,
            edge=edge,
            edges=len(self.edges),
            frame=self._frame(),
            box=box,
            errors=self.errors,
            radius=self.radius,
            deforms=self.kind >= AFFINE,
            origin=self.origin,
            terms=len(self.general[0][0]) if self.general else 0,
        )
        table.add_piece(row)
        return table.count() - 1

    def _add_vertices(self, table: Table, xs: list[float], ys: list[float]) -> int:
        """Add the vertices to a table; return the number of the first."""
        if self.kind == OWN:
            return table.add_own(self.near_own)
        if self.kind == GENERAL:
            polynomials = (f for vertex in self.general for f in vertex)
            return table.add_general([nearest_float(c) for f in polynomials for c in f])
        return table.add_places(xs, ys)

    def _frame(self) -> list[float]:
        """Return the numbers of a frame."""
        frame = self.near_frame + [0.0] * (24 - len(self.near_frame))
        if self.kind == TURNING and self.turn != TURNS[0]:
            frame[12:14] = map(nearest_float, self.turn)
        return frame


def value(f: Polynomial, t: QQ) -> QQ:
    """Return the value of a polynomial."""
    total = QQ(0)
    for c in reversed(f):
        total = total * t + c
    return total


def power(exponent: int) -> QQ:
    """Return a power of two."""
    return QQ(2) ** exponent if exponent >= 0 else 1 / QQ(2) ** -exponent


def made(rng: Random, kind: int, style: str, sides: int) -> Piece:
    """Return a piece of so many vertices: a ring, a chain, or one point."""
    piece = _since_0(rng, kind, style, sides)
    if kind == STRAIGHT or rng.random() < 0.5:
        return piece
    origin = rng.choice((1.5, 1.0 / 3.0, rng.uniform(-1.0, 1.0) * 2.0 ** rng.randint(-20, 20)))
    return replace(piece, origin=origin)


def _since_0(rng: Random, kind: int, style: str, sides: int) -> Piece:
    """Return a piece whose polynomials are in the time since 0."""
    edges = [*pairwise(range(sides)), (sides - 1, 0)]
    if sides == 2 or (sides > 2 and rng.random() < 0.2):
        edges.pop()
    if kind == OWN:
        own = [(_polynomial(rng, style, 4), _polynomial(rng, style, 4)) for _ in range(sides)]
        near = [c for x, y in own for c in _doubles(x) + _doubles(y)]
        return Piece(kind, [], [], own, [], [0.0] * 24, near, Errors(0.0, 0.0, 0.0), edges)
    if kind == GENERAL:
        return _general(rng, style, sides, edges)
    near_places = [(_double(rng, style), _double(rng, style)) for _ in range(sides)]
    error, places = _places(rng, style, near_places)
    degrees = {STRAIGHT: [2, 2], CURVED: [4, 4], TURNING: [4, 4, 4], AFFINE: [4] * 6}[kind]
    frame = [_polynomial(rng, style, n) for n in degrees]
    near_frame = [c for f in frame for c in _doubles(f)]
    path, speed = 0.0, 0.0
    if style == "stated":
        path, speed = 2.0 ** -rng.randint(10, 50), 2.0 ** -rng.randint(10, 50)
        off_path, off_speed = rational(path), rational(speed)
        for k in (0, 1):
            c0, c1, *rest = frame[k]
            c0 += rng.choice((-1, 1)) * off_path
            c1 += rng.choice((-1, 1)) * off_speed
            frame[k] = (c0, c1, *rest)
    errors = Errors(error, path, speed)
    turn = rng.choice(TURNS) if kind == TURNING else TURNS[0]
    return Piece(kind, places, frame, [], near_places, near_frame, [], errors, edges, turn=turn)


def _general(rng: Random, style: str, sides: int, edges: list[tuple[int, int]]) -> Piece:
    """Return a piece of vertices at (x / w, y / w); w is 1, or positive at all times."""
    terms = rng.randint(1, 7)
    vertices = []
    for _ in range(sides):
        x, y = _polynomial(rng, style, terms), _polynomial(rng, style, terms)
        w = [QQ(1)] + [QQ(0)] * (terms - 1)
        if rng.random() < 0.7:
            for i in range(2, terms, 2):
                w[i] = abs(_coefficient(rng, style))
        if terms > 2 and rng.random() < 0.5:  # (1 + c t)^2 + t^2 / 9
            c = QQ(rng.randint(-9, 9), rng.choice((3, 8)))
            w[1], w[2] = 2 * c, c * c + QQ(1, 9)
        vertices.append((x, y, tuple(w)))
    exact = Errors(0.0, 0.0, 0.0)
    frame = [0.0] * 24
    if rng.random() < 0.7:
        frame[0], frame[4] = _double(rng, style), _double(rng, style)
    return Piece(GENERAL, [], [], [], [], frame, [], exact, edges, general=vertices)


def _double(rng: Random, style: str) -> float:
    """Return a coordinate of a place."""
    if style == "far":
        return rng.choice((-1.0, 1.0)) * 2.0 ** rng.randint(20, 60) + rng.uniform(-9, 9)
    if style == "tiny":
        return rng.uniform(-1.0, 1.0) * 2.0 ** -rng.randint(200, 280)
    if style == "subnormal":
        return rng.randint(-9, 9) * 2.0**-1074
    if style == "thirds":
        return rng.randint(-20, 20) / rng.choice((3, 7))
    if style == "random":
        return rng.uniform(-9.0, 9.0) * 2.0 ** rng.randint(-5, 5)
    return float(rng.randint(-9, 9))


def _places(rng: Random, style: str, near: list[tuple[float, float]]) -> tuple[float, list[Point]]:
    """Return a bound on errors of places, and true places as far off."""
    size = max(abs(v) for place in near for v in place)
    if style == "thirds":
        bound = U * size
    elif style == "stated":
        bound = 2.0 ** -rng.randint(5, 50)
    else:
        bound = 0.0
    off = rational(bound)

    def moved(v: float) -> QQ:
        return rational(v) + rng.choice((-1, 0, 1)) * off

    return bound, [(moved(x), moved(y)) for x, y in near]


def _polynomial(rng: Random, style: str, terms: int) -> Polynomial:
    """Return true coefficients; their nearest doubles are off by at most U of them."""
    degree = rng.randint(1, terms)
    found = [_coefficient(rng, style) for _ in range(degree)]
    return (*found, *[QQ(0)] * (terms - degree))


def _coefficient(rng: Random, style: str) -> QQ:
    if style == "thirds":
        return QQ(rng.randint(-20, 20), rng.choice((3, 7)))
    if style == "tiny":
        return rational(rng.uniform(-1.0, 1.0)) * power(-rng.randint(200, 280))
    if style == "far" and rng.random() < 0.3:
        return rational(rng.uniform(-1.0, 1.0)) * power(rng.randint(20, 60))
    if style in {"random", "far"}:
        exact = rational(rng.uniform(-9.0, 9.0) * 2.0 ** rng.randint(-9, 5))
        return exact * (1 + rng.choice((-1, 0, 1)) * rational(U) * QQ(99, 200))
    return QQ(rng.randint(-9, 9))


def _doubles(f: Polynomial) -> list[float]:
    found = [nearest_float(c) for c in f]
    return found + [0.0] * (4 - len(found))
