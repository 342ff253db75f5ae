"""The rows of one body: what is exact becomes doubles, with bounds on the rounding.

All pieces of a body share its edges, and those of one *anchor* share its places. Places are
relative to the anchor, which the path of a piece carries:

    straight or curved    the first vertex; the origin, if doubles are in the units of the scene
    turning               the pivot
    affine                the origin

So in units of its own a place is rounded by U of the size of the body, however far away it is.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Sequence
from itertools import count
from typing import Final, NamedTuple, TypeAlias, final

from exactpt.filters.rounding import LARGEST, SLACK, SMALLEST, TINY, U
from exactpt.filters.rows import (
    AFFINE,
    CURVED,
    FRAME,
    GENERAL,
    LINE,
    NO_BOX,
    OWN,
    OWN_Y,
    PATH_Y,
    STRAIGHT,
    TURNING,
    WAITING,
    Box,
    Errors,
    Piece,
    Table,
)
from exactpt.kernel.numbers import QQ, nearest_float, of_double, power_of_two
from exactpt.kernel.polynomial import Polynomial, substituted
from exactpt.motion import course, shape
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Rigid, Translation
from exactpt.motion.normalization import Normalization
from exactpt.motion.outline import may_touch_itself
from exactpt.motion.shape import are_constant
from exactpt.motion.spin import Spin
from exactpt.pair.straight import Span

Point: TypeAlias = "tuple[QQ, QQ]"

TERMS: Final = int(OWN_Y)
"""Coefficients of a polynomial of a frame: it has a degree of 3 at most."""
LONG_AGO: Final = 16.0
"""A piece that is so many of its durations from time 0 has an origin of its own."""
NOTHING: Final = QQ(0)
ONE: Final = QQ(1)


class Row(NamedTuple):
    """A row, and the exact start and end of its piece of motion."""

    start: QQ
    end: QQ
    piece: Piece


class Anchored(NamedTuple):
    """Places of the vertices of a body, relative to an anchor.

    Attributes:
        number: that of the first place in the table.
        box: of all of them.
        error: a bound of what rounding has changed.
        farthest_squared: the largest squared distance of a place from the anchor, rounded.
    """

    number: int
    box: Box
    error: float
    farthest_squared: float

    @property
    def turned_box(self) -> Box:
        """A box of all turns of the places about the anchor.

        The square root of three rounded operations is off by less than 4 U of itself.
        """
        reach = (math.sqrt(self.farthest_squared) + 2.0 * self.error) * SLACK + TINY
        return -reach, reach, -reach, reach


@final
class MotionNumbers:
    """Numbers of motions, from 1 on: equal motions have equal ones, also in several threads."""

    def __init__(self) -> None:
        self._known: dict[Hashable, int] = {}
        self._next = count(1)

    def of(self, motion: Hashable) -> int:
        """Return the number of a motion."""
        known = self._known.get(motion)
        return self._known.setdefault(motion, next(self._next)) if known is None else known


@final
class BodyRows:
    """The rows of one body.

    Args:
        table: takes the places and edges.
        units: what doubles are relative to.
        number: the number of the body.
        body: the body.
        radius: at least its radius and what is added to it, in units.
        numbers: those of motions that several bodies may have in common; None if they do not
            matter.
    """

    def __init__(
        self,
        table: Table,
        units: Normalization,
        number: int,
        body: Body,
        radius: float,
        numbers: MotionNumbers | None,
    ) -> None:
        self._numbers = numbers
        self._table = table
        self._units = units
        self._number = number
        self._body = body
        self._radius = radius
        given = body.exact_shape
        self._rests = given.near is not None or (
            not given.keyframes and are_constant(given.positions)
        )
        if body.closed and body.size > 2 and not body.has_rings:
            self._edges = body.size
            self._edge = table.add_ring(body.size)
        else:
            edges = body.edges or [(0, 0)]
            self._edges = len(edges)
            self._edge = table.add_edges(edges)
        self._places: dict[Point, Anchored] = {}

    def adding_to(self, table: Table, radius: float) -> BodyRows:
        """Return what reads the same body into another table, with another radius."""
        number, body = self._number, self._body
        return BodyRows(table, self._units, number, body, radius, self._numbers)

    def waiting(self, span: Span) -> Row | None:
        """Return a row that stands for all pieces; None if these are to be made at once.

        A body that turns about a pivot stays within a distance of it, its farthest vertex's.
        """
        motion = self._body.motion
        if not isinstance(motion, Spin) or not self._rests:
            return None
        if not _are_short(motion.x, motion.y):
            return None
        places = self._places_from(motion.exact_pivot)
        errors: Errors | None
        if max(motion.x.degree, motion.y.degree) < int(LINE):
            frame, errors = self._line(motion, motion.exact_pivot, places)
            origin, terms = 0.0, int(LINE)
        else:
            origin, terms, errors = _origin(span.low, span.high), 0, None
            frame = self._path(motion, motion.exact_pivot, origin)
        box = places.turned_box
        piece = self._piece(
            span, WAITING, frame=frame, box=box, errors=errors, origin=origin, terms=terms
        )
        return Row(span.start, span.end, piece._replace(size=0, edges=0))

    def row_after(self, start: QQ, span: Span) -> Row:
        """Return the row of the piece of motion just after a time, up to the end of a span."""
        piece = self._body.exact_piece_after(start)
        end = span.end if piece.until is None else min(piece.until, span.end)
        within = Span(start, end, *self._units.time(start), self._units.time(end)[1])
        return Row(start, end, self._read(piece, within))

    def _read(self, piece: course.Piece, span: Span) -> Piece:
        """Return the row of a piece of motion."""
        motion = piece.motion
        origin = _origin(span.low, span.high)
        if self._rests:
            if isinstance(motion, Translation) and _are_short(motion.x, motion.y):
                return self._translated(motion, span, origin)
            if isinstance(motion, Rigid) and _are_short(motion.x, motion.y, motion.half_turn):
                return self._turning(motion, span, origin)
            if isinstance(motion, Affine) and _are_short(
                motion.x, motion.y, *motion.matrix[0], *motion.matrix[1]
            ):
                return self._affine(motion, span, origin)
        own = self._own(piece, span.start, origin)
        if own is None:
            return self._general(piece, span, origin)
        place = self._table.add_own(own)
        return self._piece(span, OWN, place=place, origin=origin)

    def _translated(self, motion: Translation, span: Span, origin: float) -> Piece:
        """Return the row of a body that keeps its places."""
        anchor = (
            (NOTHING, NOTHING) if self._units.is_identity else self._body.exact_shape.rest_place(0)
        )
        places = self._places_from(anchor)
        if max(motion.x.degree, motion.y.degree) > 1:
            frame = self._path(motion, anchor, origin)
            path = _numbers(motion.x)[1:], _numbers(motion.y)[1:]
            piece = self._piece(span, CURVED, places, frame=frame, origin=origin)
            return piece._replace(together=self._number_of(path))
        frame, errors = self._line(motion, anchor, places)
        return self._piece(span, STRAIGHT, places, frame=frame, errors=errors)

    def _line(
        self, motion: Translation | Spin, anchor: Point, places: Anchored
    ) -> tuple[list[float], Errors]:
        """Return the frame of a path of degree 1, and the errors of a row with these places."""
        x = self._rounded(self._exactly_along(motion.x, anchor[0], 0, 0.0))
        y = self._rounded(self._exactly_along(motion.y, anchor[1], 1, 0.0))
        path, speed = max(x.errors[0], y.errors[0]), max(x.errors[1], y.errors[1])
        return frame_of(x.near, y.near), Errors(places.error, path, speed)

    def _turning(self, motion: Rigid, span: Span, origin: float) -> Piece:
        """Return the row of a body that turns about a pivot."""
        places = self._places_from(motion.exact_pivot)
        frame = self._path(motion, motion.exact_pivot, origin)
        frame += _padded(self._near(self._of_time(motion.half_turn, origin)))
        cosine, sine = motion.exact_orientation
        # Of a sine below the doubles the error is 2^-1075 at most: `TINY` in `scaled` covers it.
        frame += [0.0, 0.0] if cosine == 1 else [nearest_float(cosine), nearest_float(sine)]
        piece = self._piece(
            span, TURNING, places, frame=frame, box=places.turned_box, origin=origin
        )
        formulas = motion.half_turn, motion.x, motion.y
        together = self._number_of((*map(_numbers, formulas), motion.exact_pivot))
        return piece._replace(together=together)

    def _number_of(self, motion: Hashable) -> int:
        """Return the number of a motion that bodies may have in common; 0 if it does not matter."""
        return 0 if self._numbers is None else self._numbers.of(motion)

    def _affine(self, motion: Affine, span: Span, origin: float) -> Piece:
        """Return the row of a body whose places are mapped by a matrix."""
        nowhere = NOTHING, NOTHING
        places = self._places_from(nowhere)
        frame = self._path(motion, nowhere, origin)
        for row in motion.matrix:
            for entry in row:
                frame += _padded(self._near(self._of_time(entry, origin)))
        return self._piece(span, AFFINE, places, frame=frame, origin=origin)

    def _own(self, piece: course.Piece, start: QQ, origin: float) -> list[float] | None:
        """Return the coefficients of vertices that move by themselves.

        None if one of them is a quotient, or of a degree that is too high.
        """
        if self._units.is_identity and not origin:
            deforming = self._deforming(piece, start)
            if deforming is not None:
                return deforming
        found: list[float] = []
        for vertex in range(self._body.size):
            track = piece.track(vertex)
            if len(track.w) > 1 or max(len(track.x), len(track.y)) > TERMS:
                return None
            for axis, f in enumerate((track.x, track.y)):
                coefficients = [QQ(c, track.w[0]) for c in f]
                found += _padded(self._near_path(self._place_in_time(coefficients, axis, origin)))
        return found

    def _deforming(self, piece: course.Piece, start: QQ) -> list[float] | None:
        """Return the coefficients of vertices that deform, and do nothing else, in plain units.

        None if they do something else, or are of a degree that is too high.
        """
        motion = piece.motion
        if not isinstance(motion, Translation) or motion.x.degree >= 0 or motion.y.degree >= 0:
            return None
        found: list[float] = []
        for position in self._body.exact_shape.after(start):
            for f in position:
                if f.degree >= TERMS:
                    return None
                doubles = f.exact_doubles
                exact = f.exact_coefficients if doubles is None else doubles
                found += _padded(self._near_path(exact))
        return found

    def _general(self, piece: course.Piece, span: Span, origin: float) -> Piece:
        """Return the row of vertices at (x / w, y / w) from an anchor: where the first one is."""
        anchor_x, anchor_y = self._near_anchor(piece, origin)
        polynomials: list[list[QQ]] = []
        for vertex in range(self._body.size):
            track = piece.track(vertex)
            w = [QQ(c) for c in track.w]
            x, y = ([QQ(c) for c in f] for f in (track.x, track.y))
            w_in_time = self._in_time(w, origin)
            scale = 1 / w_in_time[0]  # w > 0, and its first coefficient becomes 1
            of_vertex = [
                _less(self._place_in_time(x, 0, origin, w), anchor_x, w_in_time),
                _less(self._place_in_time(y, 1, origin, w), anchor_y, w_in_time),
                w_in_time,
            ]
            polynomials += [[c * scale for c in f] for f in of_vertex]
        terms = max(map(len, polynomials))
        numbers: list[float] = []
        for f in polynomials:
            numbers += _padded(self._near(f), terms)
        place = self._table.add_general(numbers)
        frame = frame_of([anchor_x], [anchor_y])
        return self._piece(span, GENERAL, place=place, frame=frame, origin=origin, terms=terms)

    def _near_anchor(self, piece: course.Piece, origin: float) -> tuple[float, float]:
        """Return about where the first vertex is at the origin of the time, in units."""
        units = self._units
        x, y = piece.track(0).exact_at(units.exact_time(origin))
        scale = power_of_two(-units.scale[0])
        near = [(x - units.center[0]) * scale, (y - units.center[1]) * scale]
        anchor_x, anchor_y = (c if math.isfinite(c) else 0.0 for c in map(nearest_float, near))
        return anchor_x, anchor_y

    def _piece(
        self,
        span: Span,
        kind: int,
        places: Anchored | None = None,
        *,
        place: int = 0,
        frame: Sequence[float] = (),
        box: Box | None = None,
        errors: Errors | None = None,
        origin: float = 0.0,
        terms: int = 0,
    ) -> Piece:
        """Return a row with the numbers that are given, and with what all rows of the body have."""
        place_error = 0.0
        if places is not None:
            place, place_error = places.number, places.error
            box = box or places.box
        if errors is None:
            errors = Errors(place_error, _tiny_path(span, origin), 0.0)
        return Piece(
            body=self._number,
            kind=int(kind),
            start=span.low,
            end=span.high,
            place=place,
            size=self._body.size,
            edge=self._edge,
            edges=self._edges,
            frame=_padded(frame, int(FRAME)),
            box=box or NO_BOX,
            errors=errors,
            radius=self._radius,
            deforms=kind >= AFFINE and self._body.size > 1 and may_touch_itself(self._body),
            origin=origin,
            terms=terms,
        )

    def _places_from(self, anchor: Point) -> Anchored:
        """Return the places relative to an anchor; added to the table once."""
        known = self._places.get(anchor)
        if known is not None:
            return known
        near = self._body.exact_shape.near
        if self._units.is_identity and near is not None and not any(anchor):
            xs, ys, is_exact = near
        else:
            xs, ys, is_exact = self._moved_in_doubles(anchor) or self._moved(anchor)
        box = min(xs), max(xs), min(ys), max(ys)
        error = 0.0 if is_exact else _off(max(map(abs, box)))
        farthest_squared = max([x * x + y * y for x, y in zip(xs, ys, strict=True)])
        places = Anchored(self._table.add_places(xs, ys), box, error, farthest_squared)
        self._places[anchor] = places
        return places

    def _moved_in_doubles(self, anchor: Point) -> shape.Places | None:
        """Return the places relative to an anchor, if doubles have both exactly: rounded once."""
        near = self._body.exact_shape.near
        if near is None or not (near.is_exact and self._units.is_identity):
            return None
        x, y = nearest_float(anchor[0]), nearest_float(anchor[1])
        if x != anchor[0] or y != anchor[1]:
            return None
        return shape.Places([a - x for a in near.xs], [b - y for b in near.ys], is_exact=False)

    def _moved(self, anchor: Point) -> shape.Places:
        """Return the places relative to an anchor, in units: rounded once."""
        scale = power_of_two(-self._units.scale[0])
        exact = [self._body.exact_shape.rest_place(k) for k in range(self._body.size)]
        xs_exact = [(x - anchor[0]) * scale for x, _ in exact]
        ys_exact = [(y - anchor[1]) * scale for _, y in exact]
        xs, ys = [*map(nearest_float, xs_exact)], [*map(nearest_float, ys_exact)]
        is_exact = _are_doubles(xs_exact, xs) and _are_doubles(ys_exact, ys)
        return shape.Places(xs, ys, is_exact=is_exact)

    def _path(
        self, motion: Translation | Rigid | Affine | Spin, anchor: Point, origin: float
    ) -> list[float]:
        """Return the coefficients of the path of an anchor, each within U of itself."""
        x = self._near_path(self._along(motion.x, anchor[0], 0, origin))
        y = self._near_path(self._along(motion.y, anchor[1], 1, origin))
        return _padded(x) + _padded(y)

    def _along(self, f: Polynomial, anchor: QQ, axis: int, origin: float) -> Sequence[QQ | float]:
        """Return the path of a coordinate of an anchor, in units: each coefficient within U."""
        doubles, near = f.exact_doubles, nearest_float(anchor)
        if self._units.is_identity and doubles is not None and not origin and near == anchor:
            return ((doubles[0] if doubles else 0.0) + near, *doubles[1:])
        return self._exactly_along(f, anchor, axis, origin)

    def _exactly_along(
        self, f: Polynomial, anchor: QQ, axis: int, origin: float
    ) -> Sequence[QQ | float]:
        """Return the path of a coordinate of an anchor, in units."""
        doubles = f.exact_doubles
        if self._units.is_identity and doubles is not None and not origin and not anchor:
            return doubles
        first, *rest = f.exact_coefficients or (NOTHING,)
        return self._place_in_time([first + anchor, *rest], axis, origin)

    def _place_in_time(
        self, f: Sequence[QQ], axis: int, origin: float, w: Sequence[QQ] = (ONE,)
    ) -> list[QQ]:
        """Return a polynomial for a coordinate, of which w is the denominator, in units."""
        center, scale = self._units.center[axis], power_of_two(-self._units.scale[axis])
        moved = list(f)
        if center:
            moved += [NOTHING] * (len(w) - len(moved))
            for i, c in enumerate(w):
                moved[i] -= center * c
        if self._units.scale[axis]:
            moved = [c * scale for c in moved]
        return self._in_time(moved, origin)

    def _of_time(self, f: Polynomial, origin: float) -> Sequence[QQ | float]:
        """Return a polynomial without unit in the time since an origin, in units."""
        doubles = f.exact_doubles
        if self._units.is_identity and doubles is not None and not origin:
            return doubles
        return self._in_time(f.exact_coefficients, origin)

    def _in_time(self, f: Sequence[QQ], origin: float) -> list[QQ]:
        """Return a polynomial in the time of the scene as one in the time since an origin."""
        units = self._units
        if not origin and units.origin == 0 and not units.time_scale:
            return list(f)
        step = power_of_two(units.time_scale)
        return substituted(f, units.origin + of_double(origin) * step, step)

    def _rounded(self, f: Sequence[QQ | float]) -> Rounded:
        """Return the first two coefficients as doubles, with bounds on their errors."""
        near, errors = [0.0, 0.0], [0.0, 0.0]
        for k, c in enumerate(f):
            near[k] = c if isinstance(c, float) else nearest_float(c)
            if near[k] != c:
                errors[k] = _off(abs(near[k]))
        return Rounded(near, errors)

    def _near(self, f: Sequence[QQ | float]) -> list[float]:
        """Return the nearest doubles: NaN where the error may be more than U of the number."""
        return [_in_range(c) for c in f]

    def _near_path(self, f: Sequence[QQ | float]) -> list[float]:
        """Return the nearest doubles of the coefficients of a path: 0 for the tiniest.

        What that loses is in the error of the path, see `_tiny_path`.
        """
        return [0.0 if -SMALLEST < c < SMALLEST else _in_range(c) for c in f]


class Rounded(NamedTuple):
    """Coefficients of a polynomial of degree 1, and bounds on their errors."""

    near: list[float]
    errors: list[float]


def frame_of(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Return the frame of a translation whose coefficients are two at most."""
    frame = [0.0] * int(FRAME)
    frame[: len(x)] = x
    frame[int(PATH_Y) : int(PATH_Y) + len(y)] = y
    return frame


def _less(f: Sequence[QQ], anchor: float, w: Sequence[QQ]) -> list[QQ]:
    """Return f - anchor w."""
    by = of_double(anchor)
    size = max(len(f), len(w))
    f = [*f, *[NOTHING] * (size - len(f))]
    w = [*w, *[NOTHING] * (size - len(w))]
    return [a - by * b for a, b in zip(f, w, strict=True)]


def _numbers(f: Polynomial) -> tuple[QQ | float, ...]:
    """Return the coefficients: equal ones are equal as doubles and as rationals."""
    return f.exact_coefficients if f.exact_doubles is None else f.exact_doubles


def _are_short(*polynomials: Polynomial) -> bool:
    """Return True if a frame has room for polynomials."""
    return all(f.degree < TERMS for f in polynomials)


def _origin(low: float, high: float) -> float:
    """Return the origin of the time of a piece: 0 if that is near."""
    middle = 0.5 * (low + high)
    if not abs(middle) > LONG_AGO * (high - low):
        return 0.0
    mantissa, exponent = math.frexp(middle)
    return math.ldexp(round(mantissa * 2.0**20), exponent - 20)  # of few digits


def _padded(values: Iterable[float], count: int = TERMS) -> list[float]:
    found = list(values)
    return found + [0.0] * (count - len(found))


def _in_range(c: QQ | float) -> float:
    near = c if isinstance(c, float) else nearest_float(c)
    if not c or SMALLEST <= abs(near) <= LARGEST:
        return near
    return math.nan


def _tiny_path(span: Span, origin: float) -> float:
    """Return a bound of what a path loses if coefficients below 2^-300 become 0.

    With T the latest time since the origin, it is at most 2^-300 (1 + T + T^2 + T^3). Nothing that
    moves in these units is as small, so it is a part of all errors and asks for no care.
    """
    latest = max(1.0, abs(span.low - origin), abs(span.high - origin))
    return float(TERMS) * SMALLEST * latest * latest * latest * SLACK


def _are_doubles(values: Sequence[QQ], near: Sequence[float]) -> bool:
    return all(a == b for a, b in zip(values, near, strict=True))


def _off(size: float) -> float:
    """Return a bound on the distance of a number to its nearest double, of this size at most."""
    return 2.0 * U * size + TINY
