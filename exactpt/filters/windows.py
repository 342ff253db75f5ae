"""The vertices of a piece in a window of time: models of their coordinates, and one bound.

A piece takes the place (dx, dy) of a vertex to

    x = p_x(t) + a(t) dx + b(t) dy,    y = p_y(t) + c(t) dx + d(t) dy.

The path p and the matrix (a, b; c, d) become models (`exactpt.filters.models`) once for all
vertices. What is left for a vertex is six sums of three terms: x0 + x1 s + x2 s^2 and y0 + y1 s +
y2 s^2. Both are right within `Window.rho` for all s in [-1, 1].

The bound of x, and that of y with c and d. |f| is the sum of the sizes of the coefficients of a
model, r_f its remainder, D the largest |dx| or |dy| of the piece:

* r_p + (r_a + r_b) D, from the models;
* ``place_error`` (|a| + r_a + |b| + r_b), from places that are off by so much;
* ``path_error`` + ``speed_error`` |t|, from the path;
* 16 U (|p| + (|a| + |b|) D), from rounding: a term goes through 3 operations.

NaN and infinity. 0 times the sum of all places is 0, or a NaN if one of them is no finite number.
It is added to D. So a NaN in a place or a coefficient ends as rho = NaN, and then no box excludes
anything.
"""

from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.models import (
    ROUNDING,
    Model,
    inverse,
    moved,
    of_long_polynomial,
    of_polynomial,
    rest_of,
    size_of,
    times,
    turn,
    turned,
)
from exactpt.filters.rounding import INFINITY, SLACK, TINY
from exactpt.filters.rows import (
    AFFINE,
    COEFFICIENTS,
    COSINE,
    FRAME,
    GENERAL,
    HALF_TURN,
    MATRIX_A,
    MATRIX_B,
    MATRIX_C,
    MATRIX_D,
    OWN,
    OWN_Y,
    PATH_X,
    PATH_Y,
    POLYNOMIALS,
    SINE,
    STRAIGHT,
    TURNING,
    Table,
)

ROW: Final[i64] = 6
"""Numbers of a vertex: x0, x1, x2, y0, y1, y2."""
X0: Final[i64] = 0
X1: Final[i64] = 1
X2: Final[i64] = 2
Y0: Final[i64] = 3
Y1: Final[i64] = 4
Y2: Final[i64] = 5
NOTHING: Final = 0.0
"""A factor that makes a NaN of an infinity and keeps a NaN."""


class Window:
    """All vertices of a piece in a window of time.

    Attributes:
        piece: the number of the piece in the table.
        rows: `ROW` numbers a vertex.
        rho: bounds the errors of all of them, in x and in y.
        remainder: the part of rho that comes from remainders: what a shorter window makes smaller.
        left, right, bottom, top: the box of all vertices during the window.
        has_rigid_edges: whether all edges keep their lengths.
        is_coarse: whether the piece turns too far for a model of its turn: a shorter window has
            one.
    """

    def __init__(self) -> None:
        self.piece: i64 = -1
        self.rows = vec[float]()
        self.rho = 0.0
        self.remainder = 0.0
        self.left = 0.0
        self.right = 0.0
        self.bottom = 0.0
        self.top = 0.0
        self.has_rigid_edges = True
        self.is_coarse = False

    def fill(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of a piece in [middle - half, middle + half], and the box of them."""
        n, kind = table.size[piece], table.kind[piece]
        while len(self.rows) < ROW * n:
            self.rows = append(self.rows, 0.0)
        self.piece = piece
        self.has_rigid_edges = kind < AFFINE
        self.is_coarse = False
        middle -= table.origin[piece]
        if kind == GENERAL:
            self._fill_general(table, piece, middle, half)
        elif kind == OWN:
            self._fill_own(table, piece, middle, half)
        elif kind == TURNING:
            self._fill_turning(table, piece, middle, half)
        elif kind == AFFINE:
            self._fill_affine(table, piece, middle, half)
        else:
            self._fill_translated(table, piece, middle, half)
        self._find_box(n)

    def _fill_own(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of vertices that move by themselves."""
        rows = self.rows
        own = table.own
        first = table.place[piece]
        n = table.size[piece]
        remainder = 0.0
        v: i64 = 0
        while v < n:
            at = COEFFICIENTS * (first + v)
            x0, x1, x2, x_rest = of_polynomial(own, at, middle, half)
            y0, y1, y2, y_rest = of_polynomial(own, at + OWN_Y, middle, half)
            row = ROW * v
            rows[row + X0] = x0
            rows[row + X1] = x1
            rows[row + X2] = x2
            rows[row + Y0] = y0
            rows[row + Y1] = y1
            rows[row + Y2] = y2
            remainder = larger(remainder, larger(x_rest, y_rest))
            v += 1
        self.rho = (remainder + given_error(table, piece, middle, half, 1.0)) * SLACK
        self.remainder = remainder

    def _fill_general(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of vertices at (x / w, y / w)."""
        rows = self.rows
        n = table.size[piece]
        remainder = 0.0
        v: i64 = 0
        while v < n:
            x, y = quotients(table, piece, v, middle, half)
            x0, x1, x2, x_rest = x
            y0, y1, y2, y_rest = y
            row = ROW * v
            rows[row + X0] = x0
            rows[row + X1] = x1
            rows[row + X2] = x2
            rows[row + Y0] = y0
            rows[row + Y1] = y1
            rows[row + Y2] = y2
            remainder = larger(remainder, larger(x_rest, y_rest))
            v += 1
        self.is_coarse = remainder == INFINITY and has_models_at(table, piece, middle)
        self.rho = remainder * SLACK
        self.remainder = remainder

    def _fill_translated(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of vertices that keep their places beside a path: a = d = 1, b = c = 0."""
        at = FRAME * piece
        path_x = of_polynomial(table.frames, at + PATH_X, middle, half)
        path_y = of_polynomial(table.frames, at + PATH_Y, middle, half)
        px0, px1, px2, px_rest = path_x
        py0, py1, py2, py_rest = path_y
        rows = self.rows
        xs = table.xs
        ys = table.ys
        first = table.place[piece]
        n = table.size[piece]
        reach = 0.0
        total = 0.0
        v: i64 = 0
        while v < n:
            x = xs[first + v]
            y = ys[first + v]
            reach = max(reach, abs(x))
            reach = max(reach, abs(y))
            total += x + y
            row = ROW * v
            rows[row + X0] = px0 + x
            rows[row + X1] = px1
            rows[row + X2] = px2
            rows[row + Y0] = py0 + y
            rows[row + Y1] = py1
            rows[row + Y2] = py2
            v += 1
        place = reach + NOTHING * total
        path_size = larger(size_of(path_x), size_of(path_y))
        remainder = larger(px_rest, py_rest)
        rounding = ROUNDING * (path_size + place)
        given = given_error(table, piece, middle, half, 1.0)
        self.rho = (remainder + rounding + given) * SLACK
        self.remainder = 0.0 if table.kind[piece] == STRAIGHT else remainder

    def _fill_turning(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of vertices that turn: a = d is the cosine, c = -b is the sine."""
        at = FRAME * piece
        path_x = of_polynomial(table.frames, at + PATH_X, middle, half)
        path_y = of_polynomial(table.frames, at + PATH_Y, middle, half)
        half_turn = of_polynomial(table.frames, at + HALF_TURN, middle, half)
        cosine, sine = turn(half_turn)
        is_unknown = rest_of(cosine) == 1.0  # see `turn`
        constant_c = table.frames[at + COSINE]
        constant_s = table.frames[at + SINE]
        if constant_c != 0.0 or constant_s != 0.0:
            cosine, sine = turned(cosine, sine, constant_c, constant_s)
        px0, px1, px2, px_rest = path_x
        py0, py1, py2, py_rest = path_y
        c0, c1, c2, c_rest = cosine
        s0, s1, s2, s_rest = sine
        rows = self.rows
        xs = table.xs
        ys = table.ys
        first = table.place[piece]
        n = table.size[piece]
        reach = 0.0
        total = 0.0
        v: i64 = 0
        while v < n:
            x = xs[first + v]
            y = ys[first + v]
            reach = max(reach, abs(x))
            reach = max(reach, abs(y))
            total += x + y
            row = ROW * v
            rows[row + X0] = px0 + (c0 * x - s0 * y)
            rows[row + X1] = px1 + (c1 * x - s1 * y)
            rows[row + X2] = px2 + (c2 * x - s2 * y)
            rows[row + Y0] = py0 + (s0 * x + c0 * y)
            rows[row + Y1] = py1 + (s1 * x + c1 * y)
            rows[row + Y2] = py2 + (s2 * x + c2 * y)
            v += 1
        place = reach + NOTHING * total
        path_size = larger(size_of(path_x), size_of(path_y))
        size = size_of(cosine) + size_of(sine)
        rest = c_rest + s_rest
        remainder = larger(px_rest, py_rest) + rest * place
        rounding = ROUNDING * (path_size + size * place)
        given = given_error(table, piece, middle, half, size + rest)
        self.rho = (remainder + rounding + given) * SLACK
        self.remainder = remainder
        self.is_coarse = is_unknown and self.rho < INFINITY

    def _fill_affine(self, table: Table, piece: i64, middle: float, half: float) -> None:
        """Set the rows of vertices in a frame of four polynomials a, b, c, d."""
        at = FRAME * piece
        path_x = of_polynomial(table.frames, at + PATH_X, middle, half)
        path_y = of_polynomial(table.frames, at + PATH_Y, middle, half)
        a = of_polynomial(table.frames, at + MATRIX_A, middle, half)
        b = of_polynomial(table.frames, at + MATRIX_B, middle, half)
        c = of_polynomial(table.frames, at + MATRIX_C, middle, half)
        d = of_polynomial(table.frames, at + MATRIX_D, middle, half)
        px0, px1, px2, px_rest = path_x
        py0, py1, py2, py_rest = path_y
        a0, a1, a2, a_rest = a
        b0, b1, b2, b_rest = b
        c0, c1, c2, c_rest = c
        d0, d1, d2, d_rest = d
        rows = self.rows
        xs = table.xs
        ys = table.ys
        first = table.place[piece]
        n = table.size[piece]
        reach = 0.0
        total = 0.0
        v: i64 = 0
        while v < n:
            x = xs[first + v]
            y = ys[first + v]
            reach = max(reach, abs(x))
            reach = max(reach, abs(y))
            total += x + y
            row = ROW * v
            rows[row + X0] = px0 + (a0 * x + b0 * y)
            rows[row + X1] = px1 + (a1 * x + b1 * y)
            rows[row + X2] = px2 + (a2 * x + b2 * y)
            rows[row + Y0] = py0 + (c0 * x + d0 * y)
            rows[row + Y1] = py1 + (c1 * x + d1 * y)
            rows[row + Y2] = py2 + (c2 * x + d2 * y)
            v += 1
        place = reach + NOTHING * total
        path_size = larger(size_of(path_x), size_of(path_y))
        size = larger(size_of(a) + size_of(b), size_of(c) + size_of(d))
        rest = larger(a_rest + b_rest, c_rest + d_rest)
        remainder = larger(px_rest, py_rest) + rest * place
        rounding = ROUNDING * (path_size + size * place)
        given = given_error(table, piece, middle, half, size + rest)
        self.rho = (remainder + rounding + given) * SLACK
        self.remainder = remainder

    def _find_box(self, n: i64) -> None:
        """Set the box of all vertices; the margin is that of `edge_box`."""
        rows = self.rows
        left = INFINITY
        right = -INFINITY
        bottom = INFINITY
        top = -INFINITY
        v: i64 = 0
        while v < n:
            row = ROW * v
            x = rows[row + X0]
            x_way = abs(rows[row + X1]) + abs(rows[row + X2])
            y = rows[row + Y0]
            y_way = abs(rows[row + Y1]) + abs(rows[row + Y2])
            left = min(left, x - x_way)
            right = max(right, x + x_way)
            bottom = min(bottom, y - y_way)
            top = max(top, y + y_way)
            v += 1
        size = abs(left) + abs(right) + abs(bottom) + abs(top)
        margin = (self.rho + ROUNDING * size) * SLACK
        self.left = left - margin
        self.right = right + margin
        self.bottom = bottom - margin
        self.top = top + margin


def are_apart(p: Window, q: Window, distance: float) -> bool:
    """Return True if the boxes of two windows are farther apart than a distance, in x or in y."""
    d = distance * SLACK + TINY
    is_beside = p.left > q.right + d or q.left > p.right + d
    return is_beside or p.bottom > q.top + d or q.bottom > p.top + d


def quotients(table: Table, piece: i64, v: i64, middle: float, half: float) -> tuple[Model, Model]:
    """Return the models of the coordinates of a vertex of a `GENERAL` piece.

    They are x / w and y / w from the anchor. It is near the piece: were it not for that, x and w
    would be nearly proportional, which models do not know.

    Args:
        table: has the coefficients.
        piece: the number of the piece.
        v: the number of the vertex.
        middle: the middle of the window, since the origin of the piece.
        half: half its width.
    """
    coefficients = table.general
    terms = table.terms[piece]
    at_x = table.place[piece] + POLYNOMIALS * terms * v
    at_y = at_x + terms
    at_w = at_y + terms
    x = of_long_polynomial(coefficients, at_x, terms, middle, half)
    y = of_long_polynomial(coefficients, at_y, terms, middle, half)
    w = of_long_polynomial(coefficients, at_w, terms, middle, half)
    inverse_w = inverse(w)
    anchor = FRAME * piece
    return (
        moved(times(x, inverse_w), table.frames[anchor + PATH_X]),
        moved(times(y, inverse_w), table.frames[anchor + PATH_Y]),
    )


def has_models_at(table: Table, piece: i64, time: float) -> bool:
    """Return True if all vertices of a `GENERAL` piece have models at one time since its origin."""
    v: i64 = 0
    while v < table.size[piece]:
        x, y = quotients(table, piece, v, time, 0.0)
        has_x = rest_of(x) < INFINITY  # not a NaN either
        has_y = rest_of(y) < INFINITY
        if not (has_x and has_y):
            return False
        v += 1
    return True


def given_error(table: Table, piece: i64, middle: float, half: float, factor: float) -> float:
    """Return a bound of what the errors of places and of the path make of a vertex.

    Args:
        table: has the errors.
        piece: the number of the piece.
        middle: the middle of the window, since the origin of the piece.
        half: half its width.
        factor: bounds |a| + |b| and |c| + |d| in the window.
    """
    latest = abs(middle) + half
    path = table.path_error[piece] + table.speed_error[piece] * latest
    return path + table.place_error[piece] * factor


def larger(x: float, y: float) -> float:
    """Return the larger number; a NaN if one is."""
    if x > y:
        return x
    return y if y >= x else x + y


def edge_box(rows: vec[float], i: i64, j: i64, d: float) -> tuple[float, float, float, float]:
    """Return the left, right, lower and upper sides of a box of an edge in a window.

    A coordinate x0 + x1 s + x2 s^2 is within |x1| + |x2| of x0.

    Args:
        rows: those of `Window`.
        i: the number of one end.
        j: that of the other end.
        d: a distance by which the box is grown. It should be 2 rho or more: one rho for the error
            of the rows, and one for the rounding of x0 -+ (|x1| + |x2|) here and of the
            coordinates that the caller compares; rho is at least 16 U of the size of each row.
    """
    row_i = ROW * i
    x_i = rows[row_i + X0]
    y_i = rows[row_i + Y0]
    x_way_i = abs(rows[row_i + X1]) + abs(rows[row_i + X2])
    y_way_i = abs(rows[row_i + Y1]) + abs(rows[row_i + Y2])
    row_j = ROW * j
    x_j = rows[row_j + X0]
    y_j = rows[row_j + Y0]
    x_way_j = abs(rows[row_j + X1]) + abs(rows[row_j + X2])
    y_way_j = abs(rows[row_j + Y1]) + abs(rows[row_j + Y2])
    left = min(x_i - x_way_i, x_j - x_way_j)
    right = max(x_i + x_way_i, x_j + x_way_j)
    bottom = min(y_i - y_way_i, y_j - y_way_j)
    top = max(y_i + y_way_i, y_j + y_way_j)
    margin = d + ROUNDING * (abs(left) + abs(right) + abs(bottom) + abs(top))
    return left - margin, right + margin, bottom - margin, top + margin
