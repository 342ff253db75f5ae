"""The nearest features of two bodies at one time.

Doubles leave a few pairs of features that may be nearest, and of edges that may meet
(`exactpt.filters.nearest`); exact arithmetic decides among them. Only their vertices have exact
places, unless it is not certain in doubles that the bodies are outside of each other.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Final, NamedTuple, final

from exactpt.cached_property import cached_property
from exactpt.filters.nearest import Nearest
from exactpt.filters.rounding import TINY, check_rounding
from exactpt.filters.rows import FRAME, NO_BOX, STRAIGHT, Errors, Piece, Table
from exactpt.filters.starts import snapshot_of
from exactpt.geometry.polygon import segments_meet
from exactpt.geometry.predicates import Point
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.course import NearPositions
from exactpt.motion.inside import one_is_inside
from exactpt.motion.track import Incidence, vertex_touch

NOW: Final = 0.0
"""The time of the table: positions at one time are those of bodies at rest."""
LARGEST_EXPONENT: Final = 64
"""Binary exponents of coordinates that keep their unit are at most of this size."""


class Apart(NamedTuple):
    """A pair of features, and the square of its distance.

    Attributes:
        squared: the square.
        features: a vertex, and a vertex or an edge of the other body; the bodies are 0 and 1.
    """

    squared: QQ
    features: Incidence


@final
class TwoAtTime:
    """The cores of two bodies at a rational time.

    Args:
        a: a body.
        b: another body.
        t: the time.
        within: the square of a distance: it matters only whether, and how, the bodies are at most
            so far from each other. None if it has no limit.
    """

    def __init__(self, a: Body, b: Body, t: QQ, within: QQ | None = None) -> None:
        check_rounding()
        check_budget()
        self._two = a, b
        self._t = t
        self._places: tuple[dict[int, Point], dict[int, Point]] = {}, {}
        self._table = table = Table()
        origin = self._place(0, 0)
        positions = [body.near_places_at(t, origin) for body in self._two]
        exponent = _exponent_of_unit(positions)
        for body, near in zip(self._two, positions, strict=True):
            _add(table, body, near, exponent)
        limit = math.inf
        if within is not None:
            limit = enclosing_floats(within * power_of_two(-2 * exponent))[1]
        self._near = Nearest(snapshot_of(table, 0, NOW), snapshot_of(table, 1, NOW), limit)

    @cached_property
    def nearest(self) -> list[Apart]:
        """The nearest pairs of features, a vertex being one of each; two vertices once.

        Beyond the limit there may be none. If bodies cross there may be none; then all that are at
        the distance 0 are here.
        """
        found = list(self._pairs())
        least = min((pair.squared for pair in found), default=None)
        return [pair for pair in found if pair.squared == least]

    @property
    def squared(self) -> QQ | None:
        """The square of the distance; None if it is larger than the limit."""
        least = self.nearest[0].squared if self.nearest else None
        if least is not None and not least:
            return least
        return QQ(0) if self.intersect_apart_from_vertices else least

    @cached_property
    def intersect_apart_from_vertices(self) -> bool:
        """Whether the cores have a common point, if no vertex of one is on the other."""
        near = self._near
        return near.cross or self._edges_meet() or not (near.is_outside() or self._is_outside())

    def _pairs(self) -> Iterator[Apart]:
        """Yield the pairs that may be nearest, once each, with their squared distances."""
        for pair in self._near.features():
            check_budget()
            one, v = pair.one, self._place(pair.one, pair.vertex)
            if pair.edge < 0:
                w = self._place(pair.other, pair.other_vertex)
                touch = vertex_touch(one, pair.vertex, pair.other, pair.other_vertex)
                yield Apart(squared_length(v, w), touch)
                continue
            squared = squared_from_interior(v, *self._ends(pair.other, pair.edge))
            if squared is not None:
                yield Apart(squared, Incidence(one, pair.vertex, pair.other, pair.edge, -1))

    def _edges_meet(self) -> bool:
        met = list(self._near.met)
        return any(
            segments_meet(*self._ends(0, edge), *self._ends(1, other))
            for edge, other in zip(met[::2], met[1::2], strict=True)
        )

    def _is_outside(self) -> bool:
        """Return True if no core is inside of the other; their boundaries are disjoint."""
        (a, b), t = self._two, self._t
        return not one_is_inside(a, a.exact_at(t), b, b.exact_at(t))

    def _place(self, body: int, vertex: int) -> Point:
        known = self._places[body].get(vertex)
        if known is None:
            known = self._places[body][vertex] = self._two[body].exact_place_at(vertex, self._t)
        return known

    def _ends(self, body: int, edge: int) -> tuple[Point, Point]:
        number = self._table.edge[body] + edge
        begin, end = self._table.begins[number], self._table.ends[number]
        return self._place(body, begin), self._place(body, end)


def _exponent_of_unit(positions: Iterable[NearPositions]) -> int:
    """Return the binary exponent of a unit in which products do not overflow or underflow."""
    size = max(max(*map(abs, some.xs), *map(abs, some.ys), 0.0) for some in positions)
    exponent = math.frexp(size)[1] if math.isfinite(size) else 0
    return exponent if abs(exponent) > LARGEST_EXPONENT else 0


def _add(table: Table, body: Body, near: NearPositions, exponent: int) -> None:
    """Add a body as it is at one time.

    Args:
        table: takes the body.
        body: the body.
        near: its vertices.
        exponent: the binary exponent of the unit. To divide by a unit is exact but for underflow,
            for which the error has room (`TINY`).
    """
    xs, ys, error = near
    if exponent:
        xs = [math.ldexp(x, -exponent) for x in xs]
        ys = [math.ldexp(y, -exponent) for y in ys]
        error = math.ldexp(error, -exponent) + TINY
    is_ring = body.closed and body.size > 2 and not body.has_rings
    edges = [] if is_ring else body.edges or [(0, 0)]
    table.add_piece(
        Piece(
            body=table.count(),
            kind=int(STRAIGHT),
            start=NOW,
            end=NOW,
            place=table.add_places(xs, ys),
            size=body.size,
            edge=table.add_ring(body.size) if is_ring else table.add_edges(edges),
            edges=body.size if is_ring else len(edges),
            frame=[0.0] * int(FRAME),
            box=NO_BOX,
            errors=Errors(error, 0.0, 0.0),
            radius=0.0,
            deforms=False,
        )
    )


def squared_length(u: Point, v: Point) -> QQ:
    """Return the squared distance of two points."""
    return (u[0] - v[0]) ** 2 + (u[1] - v[1]) ** 2


def squared_from_segment(v: Point, segment: tuple[Point, Point]) -> QQ:
    """Return the squared distance of a point from a segment."""
    inside = squared_from_interior(v, *segment)
    if inside is not None:
        return inside
    return min(squared_length(v, end) for end in segment)


def squared_from_interior(v: Point, a: Point, b: Point) -> QQ | None:
    """Return the squared distance of v from ab; None if the nearest point is an end."""
    x, y = b[0] - a[0], b[1] - a[1]
    along, length = x * (v[0] - a[0]) + y * (v[1] - a[1]), x * x + y * y
    if not 0 < along < length:
        return None
    return (x * (v[1] - a[1]) - y * (v[0] - a[0])) ** 2 / length
