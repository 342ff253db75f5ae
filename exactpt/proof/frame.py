"""Items of a certificate in an interval of time: doubles near their control points.

Doubles propose moving lines, and show on which side of them items are, if by more than `ERROR`.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from fractions import Fraction
from itertools import chain, groupby
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import numpy as np

from exactpt.cached_property import cached_property
from exactpt.check_apart import Interval, planes_of, side_of
from exactpt.kernel.doubles import Floats
from exactpt.kernel.numbers import QQ, fraction, of_double, rational
from exactpt.proof.paths import DIRECTIONS, Items, Moved, Paths, Place, Plane, short

if TYPE_CHECKING:
    from exactpt.proof.whole import WholeBodies

Extents: TypeAlias = "tuple[Floats, Floats]"
Points: TypeAlias = "list[tuple[float, float, float]]"

ERROR: Final = 1e-12
"""Bound of the error of a test, relative to the sum of the largest sizes of its terms.

Coordinates of control points are within 4 * 2^-53 of the size: correctly rounded quotients, or
sums of two or three doubles near numbers that are not larger than it. A test is a sum of four
products, or of six if a body's shape and its displacement are apart: its error is below
32 * 2^-53 of that sum.
"""
TINY: Final = 2.0**-1060
"""Bound of the error of a test by underflow, relative to the sum of |n|, |v|, the length and 1.

Numbers below 2^-1022 are within 2^-1075 (four of a control point, times |n|; a time, times |v|; v,
times the length; c, and the products).
"""
EXACT: Final = 2**53
"""Integers up to this size are doubles."""


class Cut(NamedTuple):
    """A moving line: its direction, its places at both ends of an interval, and the room it has."""

    worth: float
    direction: tuple[int, int]
    places: tuple[float, float]
    gap: float


class Table(NamedTuple):
    """The vertices of the items of a frame.

    Attributes:
        points: (x, y, t) of their control points.
        starts: where those of each begin, and their number.
        ends_of: the two vertices of each item.
        first_vertices: the first vertex of each body.
    """

    points: Floats
    starts: Items
    ends_of: Items
    first_vertices: list[int]


@final
class Frame:
    """Items in an interval of time, in doubles relative to an integer point near them.

    Attributes:
        time: the interval.
        start, length: of the interval.
        items: as given.
        bodies: those that have items, in order.
        row_of: the place of each of them in ``bodies``.
        whole: the bodies as wholes, if they have been compared as such.
    """

    whole: WholeBodies | None = None

    @np.errstate(all="ignore")  # the checker's exact test decides about infinities and NaN
    def __init__(self, paths: Paths, items: Items, start: Fraction, end: Fraction) -> None:
        self.time, self.start, self.length = Interval(start, end), start, float(end - start)
        self._paths, self.items = paths, items
        self.bodies = [*dict.fromkeys(paths.body[items].tolist())]
        self.row_of = {i: k for k, i in enumerate(self.bodies)}
        self._moved = {i: paths.translation(i, *self._span) for i in self.bodies}
        first = paths.items[int(items[0])].u
        self._origin, self._size = self._near(first, self._moved[self.bodies[0]]), 0.0
        self._moves = self._moves_of_all()

    def _moves_of_all(self) -> Floats | None:
        """Return the displacements of the bodies at the start and at the end, (2, bodies, 2).

        None unless all have all of their items here, and a `Paths.translation`.
        """
        moved, first = [*self._moved.values()], self._paths.first_item
        count = sum(first[i + 1] - first[i] for i in self.bodies)
        if None in moved or len(self.items) < count or max(map(abs, self._origin)) > EXACT:
            return None
        first_and_last = [of.first for of in moved if of], [of.last for of in moved if of]
        moves: Floats = np.array(first_and_last)
        moved_by = float(np.abs(moves).max()) + max(map(abs, self._origin))
        self._size = max(moved_by, self._paths.shapes.size)
        relative: Floats = moves - self._origin
        return relative

    @cached_property
    def _table(self) -> Table:
        """The vertices of the items, and their control points."""
        ends = [self._paths.items[i].ends for i in self.items.tolist()]
        row = {v: k for k, v in enumerate(dict.fromkeys(chain.from_iterable(ends)))}
        points, first_vertices = list[Points](), list[int]()
        for i, group in groupby(row, self._paths.body_of.__getitem__):
            first_vertices.append(len(points))
            some, of = [*group], self._moved[i]
            points += map(self._exactly, some) if of is None else self._translating(i, some, of)
        starts = np.cumsum([0, *map(len, points)])
        return Table(
            np.array([*chain(*points)]),
            starts,
            np.array([(row[u], row[v]) for u, v in ends]),
            first_vertices,
        )

    @cached_property
    def _points(self) -> Floats:
        """(x, y, t) of all control points."""
        points = self._table.points
        sizes = np.abs(points[:, :2])
        largest = float(sizes.max(initial=0.0))
        self._size = max(self._size, float(np.nanmax(sizes)) if math.isnan(largest) else largest)
        return points

    @cached_property
    def ends(self) -> Floats:
        """(x, y) of all vertices at the start and at the end of the interval."""
        starts = self._table.starts
        ends: Floats = self._points[:, :2][np.array([starts[:-1], starts[1:] - 1])]
        return ends

    @property
    def ends_of(self) -> Items:
        """The two vertices of each item."""
        return self._table.ends_of

    @cached_property
    def is_straight(self) -> bool:
        """Return True if all paths are linear, with two control points each."""
        if self._moves is not None:
            return True
        is_finite = not np.isnan(self._points[:, :2]).any()
        return is_finite and len(self._points) == 2 * (len(self._table.starts) - 1)

    def _exactly(self, v: int) -> Points:
        """Return the control points of a vertex, correctly rounded."""
        (a, b), n, d = self._origin, self.start.numerator, self.start.denominator
        return [
            ((x - a * w) / w, (y - b * w) / w, (d * t - n * w) / (d * w))
            if w > 0
            else (math.nan, math.nan, 0.0)
            for x, y, t, w in self.time.hull(self._paths, v)  # type: ignore[arg-type]
        ]

    @cached_property
    def _span(self) -> tuple[QQ, QQ]:
        return rational(self.time.start), rational(self.time.end)

    def _near(self, v: int, moved: Moved | None) -> tuple[int, int]:
        """Return an integer point near a vertex at the start."""
        if moved is not None:
            k = v - self._paths.first[self.bodies[0]]
            by_x, by_y = moved.first
            x = moved.shape.xs[k] + by_x
            y = moved.shape.ys[k] + by_y
            if max(abs(x), abs(y)) <= EXACT:
                return math.floor(x), math.floor(y)
        p, q, _, w = self.time.hull(self._paths, v)[0]  # type: ignore[arg-type]
        return int(p // w), int(q // w)

    def _translating(self, body: int, vertices: Sequence[int], moved: Moved) -> Iterable[Points]:
        """Return the control points of the vertices of a body, by its shape in doubles."""
        from_x, from_y = self._origin
        if max(abs(from_x), abs(from_y)) > EXACT:
            return map(self._exactly, vertices)
        xs, ys, is_exact = moved.shape
        start_x, start_y = moved.first
        end_x, end_y = moved.last
        first = self._paths.first[body]
        rest = [(xs[v - first] - from_x, ys[v - first] - from_y) for v in vertices]
        sizes = [abs(c) for c in (*moved.first, *moved.last, *chain.from_iterable(rest))]
        if not is_exact:  # the doubles are off by parts of what they are before the origin is left
            sizes += [abs(c) for c in (min(xs), max(xs), min(ys), max(ys))]
        self._size = max(self._size, *sizes)
        return [
            [(x + start_x, y + start_y, 0.0), (x + end_x, y + end_y, self.length)] for x, y in rest
        ]

    def rows(self, items: Items) -> Items:
        """Return the rows of some of the items."""
        return np.searchsorted(self.items, items)

    def extents(self, items: Items, rows: Items | slice, directions: Floats) -> Extents:
        """Return the least and largest values at start and end, (2, items, directions).

        The radii are added on both sides, and the distance above.
        """
        along = self.ends @ directions.T
        u, v = along[:, self.ends_of[rows, 0]], along[:, self.ends_of[rows, 1]]
        return self._wider(np.minimum(u, v), np.maximum(u, v), self._paths.wide, items, directions)

    @cached_property
    def _usual(self) -> Extents:
        return self.extents(self.items, slice(None), DIRECTIONS)

    def usual(self, rows: Items) -> Extents:
        """Return the extents in the usual directions."""
        low, high = self._usual
        return low[:, rows], high[:, rows]

    def body_extents(self) -> Extents:
        """Return the same of bodies in the usual directions: (2, bodies, directions)."""
        if self._moves is None:
            along, firsts = self.ends @ DIRECTIONS.T, self._table.first_vertices
            low, high = (f.reduceat(along, firsts, 1) for f in (np.minimum, np.maximum))
        else:
            along, shapes = self._moves @ DIRECTIONS.T, self._paths.shapes
            low, high = shapes.low[self.bodies] + along, shapes.high[self.bodies] + along
        return self._wider(low, high, self._paths.wide_bodies, self.bodies, DIRECTIONS)

    def places(self, bodies: Collection[int]) -> Floats | None:
        """Return the vertices of bodies at start and end; None if round or not translated."""
        if self._moves is None or self._paths.is_round:
            return None
        some: list[Floats] = []
        for i in bodies:
            first = self._paths.first[i]
            shape = self._paths.shapes.vertices[first : first + self._paths.bodies[i].size]
            some.append(shape + self._moves[:, [self.row_of[i]]])
        return np.concatenate(some, axis=1)

    def _wider(
        self, low: Floats, high: Floats, wide: Floats, of: Items | list[int], directions: Floats
    ) -> Extents:
        if not self._paths.is_round:
            return low, high
        norm = np.hypot(*directions.T)
        wide = wide[of][:, None] * norm
        return low - wide, high + (wide + self._paths.extra * norm)

    def cut(
        self, worth: float, direction: tuple[int, int], places: tuple[float, float], gap: float
    ) -> Cut:
        """Return a moving line between two extents: the distance is on its upper side."""
        above = self._paths.extra * math.hypot(*direction)
        return Cut(worth, direction, (places[0] - above, places[1] - above), gap)

    def plane(self, cut: Cut) -> Plane:
        """Return a moving line with short numbers."""
        (x, y), (c, d), unit = cut.direction, cut.places, cut.gap / 16
        v = QQ(0)
        if c != d and self.length:
            v = short(of_double((d - c) / self.length), unit / self.length)
        at = of_double(c) + (x * self._origin[0] + y * self._origin[1])
        return Plane(x, y, short(at - v * self._span[0], unit), v)

    def sides(self, items: Items, rows: Items, plane: Plane) -> tuple[Any, Any]:
        """Return which items the checker finds below a moving line, and which above."""
        f, norm, error = self._values(plane)
        wide, extra, starts = self._paths.wide[items], self._paths.extra, self._table.starts[:-1]
        low = np.minimum.reduceat(f, starts)[self.ends_of[rows]].min(axis=1)
        high = np.maximum.reduceat(f, starts)[self.ends_of[rows]].max(axis=1)
        high, low = high + norm * wide, low - norm * (wide + extra)
        below, above = high < -error, low > error
        for k in np.flatnonzero(~(below | above | ((high > error) & (low < -error)))).tolist():
            body, *ends = self._paths.items[int(items[k])]
            moving = fraction(plane.c), fraction(plane.v)
            planes = planes_of(
                plane.x, plane.y, *moving, self._paths.radii[body], self._paths.distance
            )
            hulls = [self.time.hull(self._paths, u) for u in ends]  # type: ignore[arg-type]
            sides = {side_of(hull, *planes) for hull in hulls}
            below[k], above[k] = sides == {-1}, sides == {1}
        return below, above

    def separates(self, plane: Plane, below: Collection[int], present: Collection[int]) -> bool:
        """Return True if it is certain that some bodies are below, and the others present above."""
        f, norm, error = self._values(plane)
        firsts = self._table.starts[self._table.first_vertices]
        rows = [self.row_of[i] for i in present]
        ends = [g.reduceat(f, firsts)[rows].tolist() for g in (np.minimum, np.maximum)]
        for i, a, b in zip(present, *ends, strict=True):
            wide = norm * self._paths.wide_bodies[i]
            side = b + wide < -error if i in below else a - wide - norm * self._paths.extra > error
            if not side:
                return False
        return True

    def is_between(self, plane: Plane, below: Place, above: Place) -> bool:
        """Return True if it is certain that a line is between extents at the start and the end.

        So it is at all times, if all paths are straight. The extents are those of `body_extents`.
        """
        v, c, norm, error = self._in_doubles(plane)
        c += norm * self._paths.extra
        d = c + v * self.length
        low, high = min(c - below[0], d - below[1]), min(above[0] - c, above[1] - d)
        return low > error and high > error

    def _values(self, plane: Plane) -> tuple[Floats, float, float]:
        """Return n·p - c - v t at all control points, |n|, and a bound of the error of a test."""
        points = self._points
        v, c, norm, error = self._in_doubles(plane)
        return points @ np.array([plane.x, plane.y, -v], dtype=float) - c, norm, error

    def _in_doubles(self, plane: Plane) -> tuple[float, float, float, float]:
        """Return v, c at the start near the origin, |n|, and a bound of the error of a test."""
        x, y, extra = float(plane.x), float(plane.y), self._paths.extra
        at = plane.c + plane.v * self._span[0]
        v, c = float(plane.v), float(at - (plane.x * self._origin[0] + plane.y * self._origin[1]))
        norm = math.hypot(x, y)
        size = (abs(x) + abs(y)) * self._size + abs(v) * self.length + abs(c)
        error = ERROR * (size + norm * (self._paths.widest + extra))
        error += TINY * (abs(x) + abs(y) + abs(v) + self.length + 1)
        return v, c, norm, error
