"""From bodies to rows of filters: each body once, in doubles, with bounds on what these lose.

A body becomes a row for each piece of its motion. Most bodies are one ring or one point in straight
motion whose numbers are doubles; they are read without rationals. Others go through `BodyRows`
(`exactpt.search.body_rows`), which rounds them. Rows of a scene that is far from the origin, or
tiny, are in units of their own (`exactpt.search.units`).

A body that turns at a constant rate has as many pieces as one asks for. It gets a row of the kind
`WAITING` at first, and pieces only when another body comes near that (`Rows.make_pieces`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import count
from typing import TYPE_CHECKING, Final, NamedTuple, final

from exactpt.filters.rows import EXACT, FRAME, PATH_Y, STRAIGHT, Piece, Table
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, enclosing_floats, of_double, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.normalization import Normalization
from exactpt.pair.straight import Span
from exactpt.scene.scene import Scene
from exactpt.search.body_rows import BodyRows, MotionNumbers, Row, frame_of
from exactpt.search.units import (
    PLAIN,
    are_plain_places,
    are_plain_times,
    suits_high_degrees,
    units_of,
)

if TYPE_CHECKING:
    from exactpt.scene.body_arrays import BodyArrays


NOTHING: Final = QQ(0)
OFTEN: Final = 64
"""Number of bodies read without rationals between two looks at the budget."""


class MovingPoint(NamedTuple):
    """A point at (x, y) + t (vx, vy)."""

    x: QQ
    y: QQ
    vx: QQ
    vy: QQ


@final
class Rows:
    """The rows of some bodies, and what exact arithmetic needs of them.

    Args:
        bodies: the bodies.
        start: the start of the time span.
        end: its end.
        extra: what is added to the radius of each body.
        units: what doubles are relative to.

    Attributes:
        bodies: as given.
        units: as given.
        span: the time span: exactly, and in doubles.
        table: the rows, in doubles.
        spans: of each row the exact start and end of its piece of motion, within the time span.
        has_radius: whether a body has a radius.
        are_straight: whether all pieces are straight.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        start: QQ,
        end: QQ,
        extra: QQ = NOTHING,
        units: Normalization = PLAIN,
    ) -> None:
        self.bodies = bodies
        self.units = units
        self.span = Span(start, end, *units.time(start), units.time(end)[1])
        self.table = Table()
        self.spans: list[tuple[QQ, QQ]] = []
        self.has_radius = False
        self.are_straight = True
        self._extra = extra
        self._waiting: dict[int, BodyRows] = {}
        self._paths: dict[int, MovingPoint] = {}
        self._numbers = MotionNumbers()

    def is_exact(self, row: int) -> bool:
        """Return True if doubles have a row of the kind `STRAIGHT` exactly."""
        table = self.table
        errors = table.place_error[row], table.path_error[row], table.speed_error[row]
        return self.units.is_identity and errors == (0.0, 0.0, 0.0)

    def moving_point(self, row: int, vertex: int) -> MovingPoint:
        """Return the exact motion of a vertex of a row of the kind `STRAIGHT`."""
        table = self.table
        if not self.is_exact(row):
            cx, cy, vx, vy = self._path_of(row)
            x, y = self.bodies[table.body[row]].exact_shape.rest_place(vertex)
            return MovingPoint(cx + x, cy + y, vx, vy)
        at, place = int(FRAME) * row, table.place[row] + vertex
        at_y, frames = at + int(PATH_Y), table.frames
        return MovingPoint(
            of_double(frames[at]) + of_double(table.xs[place]),
            of_double(frames[at_y]) + of_double(table.ys[place]),
            of_double(frames[at + 1]),
            of_double(frames[at_y + 1]),
        )

    def _path_of(self, row: int) -> MovingPoint:
        """Return the exact translation of a row of the kind `STRAIGHT`: where it takes 0."""
        known = self._paths.get(row)
        if known is None:
            body = self.bodies[self.table.body[row]]
            motion = body.exact_piece_after(self.spans[row][0]).motion
            assert isinstance(motion, Translation)  # noqa: S101 - the kind says so
            x, y = ([*f.exact_coefficients, NOTHING, NOTHING] for f in (motion.x, motion.y))
            self._paths[row] = known = MovingPoint(x[0], y[0], x[1], y[1])
        return known

    def ends_of(self, row: int, edge: int) -> tuple[int, int]:
        """Return the vertices at the ends of an edge of a row; of a point both are its vertex."""
        number = self.table.edge[row] + edge
        return self.table.begins[number], self.table.ends[number]

    def copy(self) -> Rows:
        """Return equal rows, to which others can be added without a change of these."""
        return self._copied(self.span.start, self.span.end, self._extra)

    def during(self, start: QQ, end: QQ) -> Rows:
        """Return these rows for another time span, within that of these."""
        is_same = (start, end) == (self.span.start, self.span.end)
        if is_same and not self._waiting:
            return self
        return self._copied(start, end, self._extra)

    def grown(self, extra: QQ) -> Rows:
        """Return these rows with larger radii, by what is added to the radius of each body."""
        rows = self._copied(self.span.start, self.span.end, self._extra + extra)
        table = rows.table
        reach = [rows.reach(body.exact_radius) for body in rows.bodies]
        for row in range(table.count()):
            table.radius[row] = reach[table.body[row]]
        return rows

    def _copied(self, start: QQ, end: QQ, extra: QQ) -> Rows:
        """Return a copy, for a time span, with what is added to each radius.

        Rows that wait have no pieces before the start.
        """
        other = Rows(self.bodies, start, end, extra, self.units)
        other.table, other.spans = self.table.copy(), self.spans.copy()
        other.has_radius, other.are_straight = self.has_radius, self.are_straight
        other._numbers = self._numbers
        for row, reader in self._waiting.items():
            radius = other.reach(self.bodies[self.table.body[row]].exact_radius)
            other._waiting[row] = reader.adding_to(other.table, radius)
            other.spans[row] = max(start, self.spans[row][0]), end
            other.table.start[row] = max(other.span.low, self.table.start[row])
        return other

    @contextmanager
    def with_body(self, body: Body) -> Iterator[None]:
        """Have the rows of one more body, for a while. No row of the others may wait."""
        assert not self._waiting  # noqa: S101 - their pieces would be cut off with the body
        before, mark, first = self.bodies, self.table.mark(), len(self.spans)
        has_radius, are_straight = self.has_radius, self.are_straight
        number = len(before)
        self.bodies = (*before, body)
        try:
            if not (self.units.is_identity and self._add_doubles(number, body)):
                self._add_rounded(number, body, None)
            yield
        finally:
            self.bodies = before
            self.table.cut(mark)
            del self.spans[first:]
            self.has_radius, self.are_straight = has_radius, are_straight
            self._waiting.pop(first, None)
            for row in [row for row in self._paths if row >= first]:
                del self._paths[row]

    def add_all(self) -> bool:
        """Add all bodies; return True if all are straight and given in doubles."""
        bodies = self.bodies
        if self.units.is_identity and not isinstance(bodies, (tuple, list)):
            from exactpt.scene.body_arrays import BodyArrays  # it imports numpy

            if isinstance(bodies, BodyArrays) and self._add_arrays(bodies):
                return True
        is_exact = True
        for number, body in enumerate(bodies):
            if number % OFTEN == 0:
                check_budget()
            if not (self.units.is_identity and self._add_doubles(number, body)):
                check_budget()
                self._add_rounded(number, body, self._numbers)
                is_exact = False
        return is_exact

    def _add_rounded(self, number: int, body: Body, numbers: MotionNumbers | None) -> None:
        """Add a body in any motion, or a row that waits for its pieces."""
        radius = self.reach(body.exact_radius)
        reader = BodyRows(self.table, self.units, number, body, radius, numbers)
        waiting = reader.waiting(self.span)
        if waiting is None:
            self._add_pieces(reader, self.span.start, self.span.end)
        else:
            self._waiting[len(self.spans)] = reader
            self._add(waiting)

    def _add_arrays(self, bodies: BodyArrays) -> bool:
        """Add bodies in arrays, without making them; return False if one does not move straight."""
        if bodies.coefficients[:, :, 2:].any():
            return False
        ends, vertices = bodies.offsets.tolist(), bodies.vertices.tolist()
        closed, radii = bodies.closed.tolist(), bodies.radii.tolist()
        for number, (x, y) in enumerate(bodies.coefficients.tolist()):
            if number % OFTEN == 0:
                check_budget()
            some = vertices[ends[number] : ends[number + 1]]
            if closed[number] and len(some) > 3 and some[0] == some[-1]:
                some.pop()  # as in a `Body`, a ring may repeat its first vertex
            outline = [place[0] for place in some], [place[1] for place in some]
            reach = self.reach(QQ(radii[number]))
            size = len(some)
            edges = None
            if size > 1 and (size == 2 or not closed[number]):
                edges = [(k, k + 1) for k in range(size - 1)]
            self._add_exact(number, outline, (x, y), reach, edges)
        return True

    def make_pieces(self, row: int, since: float, until: float, most: int) -> float:
        """Add the next pieces of a row that is `WAITING`, as far as they are needed.

        The row lasts from then on.

        Args:
            row: the row.
            since: a double: nothing touches the row before it.
            until: a double: pieces that begin after it are not needed now.
            most: the maximum number of pieces.

        Returns:
            A time up to which there are pieces; infinite if these are all that are needed.
        """
        start, end = self.spans[row]
        if math.isfinite(since):
            start = max(start, min(end, self.units.exact_time(since)))
        last = min(end, self.units.exact_time(until)) if math.isfinite(until) else end
        made = self._add_pieces(self._waiting[row], start, last, most)
        low = self.units.time(made)[0] if made < end else math.inf
        self.spans[row] = made, end
        self.table.start[row] = low
        return low if made < last else math.inf

    def make_all_pieces(self) -> None:
        """Add the pieces of all rows that are `WAITING`."""
        for row in self._waiting:
            while self.make_pieces(row, -math.inf, math.inf, OFTEN) < math.inf:
                check_budget()
        self._waiting = {}

    def _add_pieces(self, reader: BodyRows, start: QQ, until: QQ, most: int | None = None) -> QQ:
        """Add the pieces of a body from a time on, until one ends at a time or after it.

        Args:
            reader: reads the body.
            start: the begin of the first piece.
            until: the time.
            most: the maximum number of pieces; None for no limit.

        Returns:
            The end of the last piece.
        """
        for _ in count() if most is None else range(most):
            row = reader.row_after(start, self.span)
            self._add(row)
            start = row.end
            if start >= until:
                break
            check_budget()
        return start

    def _add(self, row: Row) -> None:
        self.spans.append((row.start, row.end))
        self.table.add_piece(row.piece)
        self.are_straight &= row.piece.kind == STRAIGHT

    def _add_doubles(self, number: int, body: Body) -> bool:
        """Add a body in one straight piece, if doubles have it exactly."""
        doubles, motion = body.exact_shape.doubles, body.motion
        if doubles is None or type(motion) is not Translation:
            return False
        x, y = motion.x.exact_doubles, motion.y.exact_doubles
        if x is None or y is None or len(x) > 2 or len(y) > 2:
            return False
        size, radius = len(doubles[0]), self.reach(body.exact_radius)
        edges = None
        if size > 1 and (body.has_rings or not body.closed or size == 2):
            edges = body.edges
        self._add_exact(number, doubles, (x, y), radius, edges)
        return True

    def _add_exact(
        self,
        number: int,
        outline: tuple[list[float], list[float]],
        path: tuple[Sequence[float], Sequence[float]],
        radius: float,
        edges: list[tuple[int, int]] | None,
    ) -> None:
        """Add a body whose places and translation are doubles; a ring or a point without edges."""
        (xs, ys), (x, y) = outline, path
        span = self.span
        self.spans.append((span.start, span.end))
        if edges is None:
            self.table.add_straight(number, span.low, span.high, xs, ys, tuple(x), tuple(y), radius)
            return
        self.table.add_piece(
            Piece(
                body=number,
                kind=int(STRAIGHT),
                start=span.low,
                end=span.high,
                place=self.table.add_places(xs, ys),
                size=len(xs),
                edge=self.table.add_edges(edges),
                edges=len(edges),
                frame=frame_of(x, y),
                box=(min(xs), max(xs), min(ys), max(ys)),
                errors=EXACT,
                radius=radius,
                deforms=False,
            )
        )

    def reach(self, radius: QQ) -> float:
        """Return a double that is at least a radius and what is added; 0 only if that is 0."""
        self.has_radius |= radius > 0
        reach = radius + self._extra
        if not reach:
            return 0.0
        return enclosing_floats(reach * power_of_two(-self.units.scale[0]))[1]


def rows_of(bodies: Sequence[Body], start: QQ, end: QQ, extra: QQ = NOTHING) -> Rows:
    """Return the rows of some bodies.

    Args:
        bodies: the bodies.
        start: the start of the time span of the question.
        end: its end.
        extra: what is added to the radius of each body.
    """
    plain = Rows(bodies, start, end, extra)
    low, high = plain.span.low, plain.span.high
    if are_plain_times(low, high):
        is_exact = plain.add_all()
        has_high_degrees = len(plain.table.general) > 0
        is_timely = not has_high_degrees or suits_high_degrees(low, high)
        if is_timely and (is_exact or are_plain_places(plain.table, low)):
            return plain
    rows = Rows(bodies, start, end, extra, units_of(bodies, start, end))
    rows.add_all()
    return rows


def rows_of_scene(scene: Scene, extra: QQ = NOTHING) -> Rows:
    """Return the rows of the bodies of a scene, which keeps them for the next question.

    Args:
        scene: the scene.
        extra: what is added to the radius of each body.

    Returns:
        The rows. Other threads may have the same ones: who changes them changes a copy.
    """
    start, end = scene.exact_start, scene.exact_end
    kept = scene.kept_rows
    if not isinstance(kept, Rows):
        scene.kept_rows = kept = rows_of(scene.bodies, start, end)
    rows = kept.during(start, end)  # pieces are made for one question: threads may share a scene
    return rows.grown(extra) if extra else rows
