"""The table of the filters: one row for each piece of motion of a body, in doubles.

The idea: a body is read once, and from then on a search is arithmetic on vectors of doubles. A body
that moves by one formula all the time has one row; one whose motion changes has a row for each
formula, a *piece*. All of its rows share its places and its edges.

A piece takes a place (dx, dy), which is a vertex of the body at rest, to

    x = p_x(t) + a(t) dx + b(t) dy
    y = p_y(t) + c(t) dx + d(t) dy.

The kind of the piece says what p, a, b, c, d are; all polynomials are of degree 3 at most:

    `STRAIGHT`   a = d = 1, b = c = 0, and p is of degree 1 at most.
    `CURVED`     the same, and p is of degree 3 at most.
    `TURNING`    (a, b; c, d) is a constant turn, and after it the turn by the angle of which the
                 half has the tangent h(t).
    `AFFINE`     a, b, c, d are polynomials.
    `OWN`        no places: each vertex has two polynomials of its own.
    `GENERAL`    no places: each vertex is at (x / w, y / w), with three polynomials of any degree,
                 from an anchor, which is p: two numbers.
    `WAITING`    a body of which the pieces are not known yet (`exactpt.search.reading` makes them
                 when they are needed): p, and a box of everything else. It has no vertices.

Polynomials are in the time since the *origin* of the piece, a double: a piece of a long motion
is short, and the powers of t would be large beside it.
"""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias

from librt.vecs import append, pop, vec
from mypy_extensions import i64

from exactpt.filters.blocks import Blocks

STRAIGHT: Final[i64] = 0
CURVED: Final[i64] = 1
TURNING: Final[i64] = 2
AFFINE: Final[i64] = 3
OWN: Final[i64] = 4
GENERAL: Final[i64] = 5
WAITING: Final[i64] = 6

FRAME: Final[i64] = 24
"""Coefficients of the frame of a piece: six polynomials, of each those of 1, t, t^2, t^3."""
PATH_X: Final[i64] = 0
PATH_Y: Final[i64] = 4
HALF_TURN: Final[i64] = 8
COSINE: Final[i64] = 12
SINE: Final[i64] = 13
MATRIX_A: Final[i64] = 8
MATRIX_B: Final[i64] = 12
MATRIX_C: Final[i64] = 16
MATRIX_D: Final[i64] = 20
"""Where polynomials of a frame begin: p_x, p_y; then h (`TURNING`), or a, b, c, d (`AFFINE`).

The cosine and the sine of the constant turn are two numbers; both are 0 if there is none.
"""

COEFFICIENTS: Final[i64] = 8
"""Coefficients of a vertex that moves by itself: of x, and from `OWN_Y` on of y."""
OWN_Y: Final[i64] = 4
LINE: Final[i64] = 2
"""Coefficients of a path of degree 1."""
POLYNOMIALS: Final[i64] = 3
"""Polynomials of a vertex of a `GENERAL` piece: x, y, w."""

BOX: Final[i64] = 4
"""Numbers of a box in a vector of boxes."""
LEFT: Final[i64] = 0
RIGHT: Final[i64] = 1
BOTTOM: Final[i64] = 2
TOP: Final[i64] = 3

Box: TypeAlias = tuple[float, float, float, float]
"""left, right, bottom, top: no record, as compiled code makes no object of a tuple of floats."""

NO_BOX: Box = (0.0, 0.0, 0.0, 0.0)
"""The box of a piece of which each vertex moves by itself; a constant tuple of floats must not be
Final, or compiled modules find no value."""


class Errors(NamedTuple):
    """How far the doubles of a piece may be from the numbers they stand for.

    Attributes:
        place: of each coordinate of a place.
        path: of the coefficients of 1 in p_x and p_y.
        speed: of the coefficients of t in p_x and p_y.
    """

    place: float
    path: float
    speed: float


EXACT: Final = Errors(0.0, 0.0, 0.0)


class Piece(NamedTuple):
    """A row of the table; `Table` says what each number is."""

    body: int
    kind: int
    start: float
    end: float
    place: int
    size: int
    edge: int
    edges: int
    frame: list[float]
    box: Box
    errors: Errors
    radius: float
    deforms: bool
    origin: float = 0.0
    terms: int = 0
    together: int = 0


class Mark(NamedTuple):
    """The lengths of the vectors of a table at a time."""

    rows: int
    places: int
    own: int
    general: int
    edges: int


class Table:
    """The rows of all pieces: vectors, linked by numbers.

    Row k is a piece of the body with the number ``body[k]``. Its vertices are the ``size[k]``
    places from number ``place[k]`` on. Its edges are the ``edges[k]`` ones from number ``edge[k]``
    on, whose ends are numbered from the first vertex of the piece. A triangle with the first place
    7 and the first edge 4::

        place[k] = 7, size[k] = 3 ---.                 edge[k] = 4, edges[k] = 3 ---.
                                     |                                              |
                                     v                                              v
        number   ...  5   6  |  7   8   9 | 10 ...     number   ...  2   3  |  4   5   6 | 7 ...
        xs, ys   ...         | v0  v1  v2 |            begins   ...         |  0   1   2 |
                                                       ends     ...         |  1   2   0 |

    So edge 1 of the piece, which has the number 4 + 1, leads from its vertex 1 to its vertex 2:
    from place 7 + 1 to place 7 + 2. The edges of a piece are rings, or they are open chains. A body
    of one point has one edge, from its vertex to itself. Pieces of one body may have the same
    places and the same edges.

    Units: times are in units of time, coordinates in units of length. The coefficient of t^i is in
    lengths by time^i (of h, a, b, c, d: by time^i). Times and places are finite. Any other number
    that is out of range is NaN, or its error is infinite: what depends on it may touch anything.

    Attributes:
        xs, ys: the places of all pieces; relative to the pivot of a piece that turns.
        own: `COEFFICIENTS` numbers for each vertex that moves by itself; relative errors at most U.
        general: ``terms[k]`` coefficients of each of `POLYNOMIALS` polynomials of a vertex, with
            relative errors at most U.
        begins, ends: the vertices at the ends of edges, numbered within the piece.
        body: the number of the body of each piece.
        kind: the kind of its motion.
        start, end: the times between which it lasts: the last double that is not after the exact
            start, and the first one that is not before the exact end.
        origin: the time since which its polynomials are; 0 if it is `STRAIGHT`.
        terms: the number of coefficients of a polynomial, if the piece is `GENERAL`; `LINE` if it
            is `WAITING` and its path is that of a `STRAIGHT` piece.
        place: the number of its first place (`OWN`: of its first vertex in ``own``; `GENERAL`:
            where its first vertex begins in ``general``).
        size: the number of its vertices.
        edge, edges: the number of its first edge, and the number of its edges.
        frames: `FRAME` numbers a piece; beside the errors below, relative errors at most U, and of
            `STRAIGHT` pieces none.
        boxes: `BOX` numbers a piece: a box of its places; if it turns, of all turns of them; if it
            is `WAITING`, of what is added to its path.
        place_error, path_error, speed_error: bounds as in `Errors`, in lengths (speed: by time).
        radius: at least the radius, with what the question adds to it; larger by at most 2 U of it.
        together: rows with the same number, unless it is 0, keep their places beside each other.
        deforms: 1 if vertices of the piece may touch its own edges, else 0.
        vertex_blocks, edge_blocks: those of the places of pieces of many vertices, by the number of
            the first place; made when they are needed.
    """

    def __init__(self) -> None:
        self.vertex_blocks: dict[int, Blocks] = {}
        self.edge_blocks: dict[int, Blocks] = {}
        self.xs = vec[float]()
        self.ys = vec[float]()
        self.own = vec[float]()
        self.general = vec[float]()
        self.begins = vec[i64]()
        self.ends = vec[i64]()
        self.body = vec[i64]()
        self.kind = vec[i64]()
        self.start = vec[float]()
        self.end = vec[float]()
        self.origin = vec[float]()
        self.terms = vec[i64]()
        self.together = vec[i64]()
        self.place = vec[i64]()
        self.size = vec[i64]()
        self.edge = vec[i64]()
        self.edges = vec[i64]()
        self.frames = vec[float]()
        self.boxes = vec[float]()
        self.place_error = vec[float]()
        self.path_error = vec[float]()
        self.speed_error = vec[float]()
        self.radius = vec[float]()
        self.deforms = vec[i64]()

    def copy(self) -> Table:
        """Return a table of the same rows, to which others can be added."""
        other = Table()
        other.vertex_blocks, other.edge_blocks = self.vertex_blocks.copy(), self.edge_blocks.copy()
        other.xs, other.ys, other.own = self.xs[:], self.ys[:], self.own[:]
        other.general = self.general[:]
        other.origin, other.terms = self.origin[:], self.terms[:]
        other.together = self.together[:]
        other.begins, other.ends = self.begins[:], self.ends[:]
        other.body, other.kind = self.body[:], self.kind[:]
        other.start, other.end = self.start[:], self.end[:]
        other.place, other.size = self.place[:], self.size[:]
        other.edge, other.edges = self.edge[:], self.edges[:]
        other.frames, other.boxes = self.frames[:], self.boxes[:]
        other.place_error = self.place_error[:]
        other.path_error = self.path_error[:]
        other.speed_error = self.speed_error[:]
        other.radius, other.deforms = self.radius[:], self.deforms[:]
        return other

    def mark(self) -> Mark:
        """Return what `cut` needs to remove all that is added from now on."""
        places, own, general = len(self.xs), len(self.own), len(self.general)
        return Mark(len(self.body), places, own, general, len(self.begins))

    def cut(self, mark: Mark) -> None:
        """Remove what has been added since a mark."""
        n = mark.rows
        for blocks in (self.vertex_blocks, self.edge_blocks):
            for place in [place for place in blocks if place >= mark.places]:
                del blocks[place]
        self.xs, self.ys = cut_floats(self.xs, mark.places), cut_floats(self.ys, mark.places)
        self.own, self.general = (
            cut_floats(self.own, mark.own),
            cut_floats(self.general, mark.general),
        )
        self.begins = cut_numbers(self.begins, mark.edges)
        self.ends = cut_numbers(self.ends, mark.edges)
        self.body, self.kind = cut_numbers(self.body, n), cut_numbers(self.kind, n)
        self.start, self.end = cut_floats(self.start, n), cut_floats(self.end, n)
        self.origin, self.terms = cut_floats(self.origin, n), cut_numbers(self.terms, n)
        self.together = cut_numbers(self.together, n)
        self.place, self.size = cut_numbers(self.place, n), cut_numbers(self.size, n)
        self.edge, self.edges = cut_numbers(self.edge, n), cut_numbers(self.edges, n)
        self.frames = cut_floats(self.frames, FRAME * n)
        self.boxes = cut_floats(self.boxes, BOX * n)
        self.place_error = cut_floats(self.place_error, n)
        self.path_error = cut_floats(self.path_error, n)
        self.speed_error = cut_floats(self.speed_error, n)
        self.radius, self.deforms = cut_floats(self.radius, n), cut_numbers(self.deforms, n)

    def count(self) -> int:
        """Return the number of rows."""
        return len(self.body)

    def box(self, k: i64) -> Box:
        """Return the box of the places of a piece."""
        boxes, at = self.boxes, BOX * k
        return boxes[at + LEFT], boxes[at + RIGHT], boxes[at + BOTTOM], boxes[at + TOP]

    def add_places(self, xs: list[float], ys: list[float]) -> int:
        """Add places; return the number of the first."""
        first = len(self.xs)
        for x in xs:
            self.xs = append(self.xs, x)
        for y in ys:
            self.ys = append(self.ys, y)
        return first

    def add_own(self, coefficients: list[float]) -> int:
        """Add vertices of `COEFFICIENTS` numbers each; return the number of the first."""
        first: i64 = len(self.own)
        for c in coefficients:
            self.own = append(self.own, c)
        return int(first // COEFFICIENTS)

    def add_general(self, coefficients: list[float]) -> int:
        """Add vertices of `POLYNOMIALS` polynomials each; return where the first begins."""
        first = len(self.general)
        for c in coefficients:
            self.general = append(self.general, c)
        return first

    def add_edges(self, ends: list[tuple[int, int]]) -> int:
        """Add edges between vertices of one piece; return the number of the first."""
        first = len(self.begins)
        for i, j in ends:
            self.begins = append(self.begins, i64(i))
            self.ends = append(self.ends, i64(j))
        return first

    def add_ring(self, n: int) -> int:
        """Add the edges of a ring of n vertices; return the number of the first."""
        first = len(self.begins)
        size: i64 = n
        i: i64 = 0
        while i < size:
            self.begins = append(self.begins, i)
            self.ends = append(self.ends, i + 1 if i + 1 < size else 0)
            i += 1
        return first

    def add_piece(self, piece: Piece) -> None:
        """Add a row, after its places (or vertices) and its edges."""
        self.body = append(self.body, i64(piece.body))
        self.kind = append(self.kind, i64(piece.kind))
        self.start = append(self.start, piece.start)
        self.end = append(self.end, piece.end)
        self.origin = append(self.origin, piece.origin)
        self.terms = append(self.terms, i64(piece.terms))
        self.together = append(self.together, i64(piece.together))
        self.place = append(self.place, i64(piece.place))
        self.size = append(self.size, i64(piece.size))
        self.edge = append(self.edge, i64(piece.edge))
        self.edges = append(self.edges, i64(piece.edges))
        for c in piece.frame:
            self.frames = append(self.frames, c)
        left, right, bottom, top = piece.box
        self.boxes = append_box(self.boxes, left, right, bottom, top)
        self.place_error = append(self.place_error, piece.errors.place)
        self.path_error = append(self.path_error, piece.errors.path)
        self.speed_error = append(self.speed_error, piece.errors.speed)
        self.radius = append(self.radius, piece.radius)
        self.deforms = append(self.deforms, i64(1) if piece.deforms else i64(0))

    def add_excerpt(self, source: Table, k: i64, vertices: vec[i64], edges: i64) -> None:
        """Add a piece of another table with some of its vertices, after its edges.

        Args:
            source: the other table.
            k: the number of the piece.
            vertices: the numbers of the vertices.
            edges: how many of the last edges are those of the piece.
        """
        kind = source.kind[k]
        place: i64 = len(self.xs)
        if kind == OWN:
            place = i64(len(self.own)) // COEFFICIENTS
        elif kind == GENERAL:
            place = len(self.general)
        n: i64 = 0
        while n < len(vertices):
            v = vertices[n]
            if kind == OWN:
                self.own = extended(self.own, source.own, source.place[k] + v, COEFFICIENTS)
            elif kind == GENERAL:
                width = POLYNOMIALS * source.terms[k]
                at = source.place[k] + width * v
                self.general = appended(self.general, source.general, at, width)
            else:
                self.xs = append(self.xs, source.xs[source.place[k] + v])
                self.ys = append(self.ys, source.ys[source.place[k] + v])
            n += 1
        self.body, self.kind = append(self.body, source.body[k]), append(self.kind, kind)
        self.start = append(self.start, source.start[k])
        self.end = append(self.end, source.end[k])
        self.origin = append(self.origin, source.origin[k])
        self.terms = append(self.terms, source.terms[k])
        self.together = append(self.together, source.together[k])
        self.place, self.size = append(self.place, place), append(self.size, n)
        self.edge = append(self.edge, i64(len(self.begins)) - edges)
        self.edges = append(self.edges, edges)
        self.frames = extended(self.frames, source.frames, k, FRAME)
        self.boxes = extended(self.boxes, source.boxes, k, BOX)
        self.place_error = append(self.place_error, source.place_error[k])
        self.path_error = append(self.path_error, source.path_error[k])
        self.speed_error = append(self.speed_error, source.speed_error[k])
        self.radius = append(self.radius, source.radius[k])
        self.deforms = append(self.deforms, source.deforms[k])

    def add_straight(
        self,
        body: int,
        start: float,
        end: float,
        xs: list[float],
        ys: list[float],
        x: tuple[float, ...],
        y: tuple[float, ...],
        radius: float,
    ) -> None:
        """Add a body without errors, a ring or one point, and its only row, of the kind `STRAIGHT`.

        A scene of many bodies is read by this alone, so it makes no record: a `Piece` takes more
        time than the whole of this.

        Args:
            body: as in the table.
            start: as in the table.
            end: as in the table.
            xs: the places, which are added here.
            ys: their other coordinates.
            x: the coefficients of the path, two at most.
            y: likewise.
            radius: as in the table.
        """
        n: i64 = len(xs)
        left, right = bounds(xs)
        bottom, top = bounds(ys)
        self.place = append(self.place, i64(self.add_places(xs, ys)))
        self.size = append(self.size, n)
        self.edge = append(self.edge, i64(self.add_ring(len(xs))))
        self.edges = append(self.edges, n)
        self.boxes = append_box(self.boxes, left, right, bottom, top)
        self.body = append(self.body, i64(body))
        self.kind = append(self.kind, STRAIGHT)
        self.start = append(self.start, start)
        self.end = append(self.end, end)
        self.origin = append(self.origin, 0.0)
        self.terms = append(self.terms, 0)
        self.together = append(self.together, 0)
        self.frames = append_straight(self.frames, x, y)
        self.place_error = append(self.place_error, 0.0)
        self.path_error = append(self.path_error, 0.0)
        self.speed_error = append(self.speed_error, 0.0)
        self.radius = append(self.radius, radius)
        self.deforms = append(self.deforms, 0)


def extended(values: vec[float], source: vec[float], k: i64, width: i64) -> vec[float]:
    """Return a vector with one more group of numbers: group k of another vector."""
    return appended(values, source, k * width, width)


def appended(values: vec[float], source: vec[float], at: i64, count: i64) -> vec[float]:
    """Return a vector with more numbers, those of another vector from a place on."""
    n: i64 = 0
    while n < count:
        values = append(values, source[at + n])
        n += 1
    return values


def cut_floats(values: vec[float], n: i64) -> vec[float]:
    """Return the first n values, without a copy: what is appended later replaces the others."""
    while len(values) > n:
        values, _ = pop(values)
    return values


def cut_numbers(values: vec[i64], n: i64) -> vec[i64]:
    """Return the first n values, as `cut_floats` does."""
    while len(values) > n:
        values, _ = pop(values)
    return values


def bounds(values: list[float]) -> tuple[float, float]:
    """Return the least and the greatest of some finite numbers."""
    least = most = values[0]
    for v in values:
        least = min(least, v)
        most = max(most, v)
    return least, most


def append_box(
    boxes: vec[float], left: float, right: float, bottom: float, top: float
) -> vec[float]:
    """Return a vector of boxes with one more."""
    boxes = append(boxes, left)
    boxes = append(boxes, right)
    boxes = append(boxes, bottom)
    return append(boxes, top)


def append_straight(frames: vec[float], x: tuple[float, ...], y: tuple[float, ...]) -> vec[float]:
    """Return a vector of frames with one more: a path of degree 1 at most, and no turn."""
    frames = append_line(frames, x)
    frames = append_line(frames, y)
    k = HALF_TURN
    while k < FRAME:
        frames = append(frames, 0.0)
        k += 1
    return frames


def append_line(frames: vec[float], c: tuple[float, ...]) -> vec[float]:
    """Return a vector with one more polynomial, of degree 1 at most."""
    n = len(c)
    frames = append(frames, c[0] if n > 0 else 0.0)
    frames = append(frames, c[1] if n > 1 else 0.0)
    frames = append(frames, 0.0)
    return append(frames, 0.0)
