"""From bodies to rows of filters: each body once, in doubles, with bounds on what these lose.

A body becomes a row for each piece of its motion. Most bodies are one ring or one point whose
numbers are doubles; they are read without rationals. Others go through `straight_pieces`, which
rounds them, relative to a point near them if they are far from the origin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias, final

from exactpt.filters.rows import EXACT, FRAME, PATH_Y, STRAIGHT, Errors, Piece, Table
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, enclosing_floats, of_double
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.outline import Straight, far_origin, straight_pieces
from exactpt.pair.straight import Span, span_of

if TYPE_CHECKING:
    from exactpt.scene.body_arrays import BodyArrays


Point: TypeAlias = "tuple[QQ, QQ]"
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
        span: the time span of the question.
        extra: what is added to the radius of each body.
        origin: a point that doubles are relative to; None for the origin of coordinates.

    Attributes:
        bodies: as given.
        span: as given.
        table: the rows, in doubles.
        spans: of each row the exact span of its piece of motion, within the time span.
        has_radius: whether a body has a radius.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        span: Span,
        extra: QQ = NOTHING,
        origin: Point | None = None,
    ) -> None:
        self.bodies = bodies
        self.span = span
        self.table = Table()
        self.spans: list[Span] = []
        self.has_radius = False
        self._extra = extra
        self._origin = origin
        self._motions: dict[int, Straight] = {}

    def moving_point(self, row: int, vertex: int) -> MovingPoint:
        """Return the exact motion of a vertex of a row."""
        straight = self._motions.get(row)
        if straight is not None:
            (px, py), (cx, cy, vx, vy) = straight.point(vertex), straight.line()
            return MovingPoint(cx + px, cy + py, vx, vy)
        table, at = self.table, int(FRAME) * row
        place, frames = table.place[row] + vertex, table.frames
        at_y = at + int(PATH_Y)
        return MovingPoint(
            of_double(frames[at]) + of_double(table.xs[place]),
            of_double(frames[at_y]) + of_double(table.ys[place]),
            of_double(frames[at + 1]),
            of_double(frames[at_y + 1]),
        )

    def ends_of(self, row: int, edge: int) -> tuple[int, int]:
        """Return the vertices at the ends of an edge of a row; of a point both are its vertex."""
        number = self.table.edge[row] + edge
        return self.table.begins[number], self.table.ends[number]

    def with_body(self, body: Body) -> Rows | None:
        """Return these rows with those of one more body; None if it does not move straight."""
        more = Rows((*self.bodies, body), self.span, self._extra, self._origin)
        more.table, more.spans = self.table.copy(), self.spans.copy()
        more.has_radius = self.has_radius
        more._motions = self._motions.copy()
        return more if more.add_from(len(self.bodies)) else None

    def add_exact_ones(self) -> int:
        """Add the bodies up to the first that doubles do not have exactly; return its number."""
        for number, body in enumerate(self.bodies):
            if number % OFTEN == 0:
                check_budget()
            if not self._add_doubles(number, body):
                return number
        return len(self.bodies)

    def add_from(self, first: int) -> bool:
        """Add the bodies from a number on; return False if one of them does not move straight."""
        for number in range(first, len(self.bodies)):
            check_budget()
            body = self.bodies[number]
            is_added = self._origin is None and self._add_doubles(number, body)
            if not is_added and not self._add_rounded(number, body):
                return False
        return True

    def add_arrays(self, bodies: BodyArrays) -> bool:
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
            reach = self._reach(QQ(radii[number]))
            self._add_exact(number, outline, (x, y), reach, is_ring=closed[number])
        return True

    def _add_doubles(self, number: int, body: Body) -> bool:
        """Add a body of one ring or chain in one straight piece, if doubles have it exactly."""
        doubles, motion = body.exact_shape.doubles, body.motion
        if doubles is None or type(motion) is not Translation or body.has_rings:
            return False
        x, y = motion.x.exact_doubles, motion.y.exact_doubles
        if x is None or y is None or len(x) > 2 or len(y) > 2:
            return False
        self._add_exact(
            number, doubles, (x, y), self._reach(body.exact_radius), is_ring=body.closed
        )
        return True

    def _add_exact(
        self,
        number: int,
        outline: tuple[list[float], list[float]],
        path: tuple[Sequence[float], Sequence[float]],
        radius: float,
        *,
        is_ring: bool,
    ) -> None:
        """Add a body whose places and translation are doubles."""
        (xs, ys), (x, y) = outline, path
        span, size = self.span, len(xs)
        self.spans.append(span)
        if size == 1 or (is_ring and size > 2):
            self.table.add_straight(number, span.low, span.high, xs, ys, tuple(x), tuple(y), radius)
            return
        edges = [(k, k + 1) for k in range(size - 1)]
        self.table.add_piece(
            Piece(
                body=number,
                kind=int(STRAIGHT),
                start=span.low,
                end=span.high,
                place=self.table.add_places(xs, ys),
                size=size,
                edge=self.table.add_edges(edges),
                edges=len(edges),
                frame=frame_of(x, y),
                box=(min(xs), max(xs), min(ys), max(ys)),
                errors=EXACT,
                radius=radius,
                deforms=False,
            )
        )

    def _add_rounded(self, number: int, body: Body) -> bool:
        """Add a body whose numbers are rounded; return False if it does not move straight."""
        pieces = straight_pieces(body, origin=self._origin)
        if pieces is None:
            return False
        table, shape = self.table, pieces[0][0].shape
        place = table.add_places(shape.xs, shape.ys)
        edges = body.edges or [(0, 0)]
        edge = table.add_edges(edges)
        box = (shape.low_x, shape.high_x, shape.low_y, shape.high_y)
        radius = self._reach(body.exact_radius)
        for straight, span in _during(pieces, self.span):
            self._motions[len(self.spans)] = straight
            self.spans.append(span)
            table.add_piece(
                Piece(
                    body=number,
                    kind=int(STRAIGHT),
                    start=span.low,
                    end=span.high,
                    place=place,
                    size=body.size,
                    edge=edge,
                    edges=len(edges),
                    frame=frame_of((straight.cx, straight.vx), (straight.cy, straight.vy)),
                    box=box,
                    errors=Errors(shape.error, straight.c_error, straight.v_error),
                    radius=radius,
                    deforms=False,
                )
            )
        return True

    def _reach(self, radius: QQ) -> float:
        """Return a double that is at least a radius and what is added; 0 only if that is 0."""
        self.has_radius |= radius > 0
        reach = radius + self._extra
        return enclosing_floats(reach)[1] if reach else 0.0


def frame_of(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Return the frame of a translation whose coefficients are two at most."""
    frame = [0.0] * int(FRAME)
    frame[: len(x)] = x
    frame[int(PATH_Y) : int(PATH_Y) + len(y)] = y
    return frame


def _during(
    pieces: Sequence[tuple[Straight, QQ | None]], span: Span
) -> Iterator[tuple[Straight, Span]]:
    """Yield the pieces of a motion within a span, each with its own."""
    since = span.start
    for straight, until in pieces:
        if until is None or until >= span.end:
            yield straight, span_of(since, span.end)
            return
        if until > since:
            yield straight, span_of(since, until)
            since = until


def straight_rows(bodies: Sequence[Body], span: Span, extra: QQ = NOTHING) -> Rows | None:
    """Return the rows of some bodies; None unless all move straight, and doubles have the span.

    Args:
        bodies: the bodies.
        span: the time span of the question.
        extra: what is added to the radius of each body.
    """
    if not (math.isfinite(span.low) and math.isfinite(span.high)):
        return None  # of the table, times are finite
    rows = Rows(bodies, span, extra)
    if not isinstance(bodies, (tuple, list)):
        from exactpt.scene.body_arrays import BodyArrays  # it imports numpy

        if isinstance(bodies, BodyArrays):
            return rows if rows.add_arrays(bodies) else None
    first = rows.add_exact_ones()
    if first < len(bodies):
        origin = far_origin(bodies)
        if origin is not None:
            rows, first = Rows(bodies, span, extra, origin), 0
        if not rows.add_from(first):
            return None
    return rows
