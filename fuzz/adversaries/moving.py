"""Pieces of motion in rationals, and the rows of a filter's table that stand for them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from exactpt.filters.rounding import TINY
from exactpt.filters.rows import (
    AFFINE,
    EXACT,
    FRAME,
    GENERAL,
    OWN,
    PATH_X,
    PATH_Y,
    TURNING,
    Errors,
    Piece,
    Table,
)
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, of_double
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.track import Track, track
from fuzz.adversaries.pieces import TURNS

__all__ = ["Moving", "add_row", "positions", "tracks"]

Place: TypeAlias = tuple[QQ, QQ]
ZERO = QQ(0)
DEGREE = 4  # coefficients of a polynomial in the table


@dataclass(frozen=True)
class Moving:
    """A piece of motion, exactly.

    Attributes:
        kind: its kind in the table.
        start, end: its span.
        places: those of its vertices; none if they move by themselves.
        path: two polynomials.
        frame: the tangent of half the angle, or the four polynomials of a matrix.
        own: two polynomials a vertex that moves by itself.
        edges: the numbers of the ends of edges.
        radius: its radius.
        blur: about how far its row is off, in places and in the path.
        turn: the cosine and the sine of a constant turn, after which it turns.
        origin: a double; the polynomials of its row are in the time since it.
        is_general: whether its row has quotients of polynomials.
    """

    kind: int
    start: QQ
    end: QQ
    places: tuple[Place, ...]
    path: tuple[Polynomial, Polynomial]
    frame: tuple[Polynomial, ...]
    own: tuple[tuple[Polynomial, Polynomial], ...]
    edges: tuple[tuple[int, int], ...]
    radius: QQ
    blur: QQ
    turn: tuple[QQ, QQ] = TURNS[0]
    origin: QQ = ZERO
    is_general: bool = False

    @property
    def size(self) -> int:
        """The number of vertices."""
        return len(self.own) if self.kind == OWN else len(self.places)

    def signed(self) -> list[tuple[Place, int]]:
        """Return the places, and 1 and -1 in turn."""
        return [(place, (-1) ** k) for k, place in enumerate(self.places)]


def homogeneous(piece: Moving) -> list[tuple[Polynomial, Polynomial, Polynomial]]:
    """Return x, y, w of each vertex: it is at (x / w, y / w)."""
    one = Polynomial([1])
    if piece.kind == OWN:
        return [(x, y, one) for x, y in piece.own]
    path_x, path_y = piece.path
    if piece.kind == TURNING:
        (h,) = piece.frame
        w = one + h * h
        cosine, sine = piece.turn
        c, s = (one - h * h) * cosine - 2 * h * sine, 2 * h * cosine + (one - h * h) * sine
        return [
            (path_x * w + c * dx - s * dy, path_y * w + s * dx + c * dy, w)
            for dx, dy in piece.places
        ]
    if piece.kind == AFFINE:
        a, b, c, d = piece.frame
        return [
            (path_x + a * dx + b * dy, path_y + c * dx + d * dy, one) for dx, dy in piece.places
        ]
    return [(path_x + dx, path_y + dy, one) for dx, dy in piece.places]


def tracks(piece: Moving) -> list[Track]:
    """Return the trajectories of its vertices."""
    return [track(x, y, w, None) for x, y, w in homogeneous(piece)]


def positions(piece: Moving, t: QQ) -> list[Place]:
    """Return the places of its vertices at a time."""
    found = []
    for x, y, w in homogeneous(piece):
        at_t = w.exact_at(t)
        found.append((x.exact_at(t) / at_t, y.exact_at(t) / at_t))
    return found


def add_row(table: Table, body: int, piece: Moving) -> None:
    """Add the row of a piece: the doubles nearest to its numbers, with bounds on their errors."""
    edge = table.add_edges(list(piece.edges))
    frame = [0.0] * FRAME
    xs, ys, errors = [0.0], [0.0], EXACT
    kind, terms = piece.kind, 0

    def local(f: Polynomial) -> Polynomial:
        return f(Polynomial([piece.origin, 1])) if piece.origin else f

    if piece.is_general:
        kind = GENERAL
        anchor = [nearest_float(c) for c in positions(piece, piece.origin)[0]]
        frame[int(PATH_X)], frame[int(PATH_Y)] = anchor
        ax, ay = map(of_double, anchor)
        around = [(x - ax * w, y - ay * w, w) for x, y, w in homogeneous(piece)]
        numbers, terms = quotients([tuple(map(local, vertex)) for vertex in around])
        first = table.add_general(numbers)
    elif piece.kind == OWN:
        own = (f for pair in piece.own for f in pair)
        first = table.add_own([c for f in own for c in coefficients(local(f))])
    else:
        xs = [nearest_float(x + sign * piece.blur) for (x, _), sign in piece.signed()]
        ys = [nearest_float(y - sign * piece.blur) for (_, y), sign in piece.signed()]
        first = table.add_places(xs, ys)
        path = [blurred(local(f), piece.blur) for f in piece.path]
        frame = [c for near, _, _ in path for c in near]
        frame += [c for f in piece.frame for c in coefficients(local(f))]
        if piece.turn != TURNS[0]:
            frame += map(nearest_float, piece.turn)
        frame += [0.0] * (FRAME - len(frame))
        place = largest_error(piece.places, xs, ys)
        errors = Errors(place, max(path[0][1], path[1][1]), max(path[0][2], path[1][2]))
    reach = max(map(math.hypot, xs, ys)) * (1.0 + 1e-10) + 2.0 * errors.place
    box = min(xs), max(xs), min(ys), max(ys)
    if piece.kind == TURNING:
        box = -reach, reach, -reach, reach
    row = Piece(
        body=body,
        kind=int(kind),
        start=enclosing_floats(piece.start)[0],
        end=enclosing_floats(piece.end)[1],
        place=first,
        size=piece.size,
        edge=edge,
        edges=len(piece.edges),
        frame=frame,
        box=box,
        errors=errors,
        radius=enclosing_floats(piece.radius)[1],
        deforms=kind >= AFFINE,
        origin=nearest_float(piece.origin),
        terms=terms,
    )
    table.add_piece(row)


def coefficients(f: Polynomial) -> list[float]:
    """Return the doubles nearest to the coefficients."""
    near = [nearest_float(c) for c in f.exact_coefficients]
    return near + [0.0] * (DEGREE - len(near))


def quotients(vertices: Sequence[tuple[Polynomial, ...]]) -> tuple[list[float], int]:
    """Return the numbers of vertices x, y, w, of which w begins with 1, and terms of each."""
    exact = []
    for vertex in vertices:
        scale = 1 / vertex[2].exact_coefficients[0]
        exact += [[c * scale for c in f.exact_coefficients] for f in vertex]
    terms = max(1, *map(len, exact))
    numbers = [nearest_float(c) for f in exact for c in [*f, *[QQ(0)] * (terms - len(f))]]
    return numbers, terms


def blurred(f: Polynomial, blur: QQ) -> tuple[list[float], float, float]:
    """Return doubles that stand for a path, and the errors of the first two."""
    near = coefficients(f)
    if not blur:
        return near, 0.0, 0.0
    exact = [*f.exact_coefficients, QQ(0), QQ(0)][:2]
    for k in (0, 1):
        near[k] = nearest_float(exact[k] + blur)
    path, speed = (upward(abs(of_double(near[k]) - exact[k])) for k in (0, 1))
    return near, path, speed


def upward(x: QQ) -> float:
    """Return a double that is not below a number, for the sum of it and what underflows."""
    return enclosing_floats(x)[1] + TINY


def largest_error(places: Sequence[Place], xs: list[float], ys: list[float]) -> float:
    """Return a double above all errors of places."""
    errors = [
        abs(of_double(near) - exact)
        for (x, y), near_x, near_y in zip(places, xs, ys, strict=True)
        for near, exact in ((near_x, x), (near_y, y))
    ]
    worst = max(errors)
    return upward(worst) if worst else 0.0
