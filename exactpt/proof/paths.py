"""Items of a certificate in an interval of time: exact control points, and doubles near them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from fractions import Fraction
from itertools import chain
from math import frexp
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import numpy as np

from exactpt.check_apart import Interval, planes_of, side_of, values

if TYPE_CHECKING:
    from exactpt.check_apart import Whole
    from exactpt.motion.body import Body

Items: TypeAlias = "np.ndarray[Any, np.dtype[np.intp]]"
Floats: TypeAlias = "np.ndarray[Any, np.dtype[np.float64]]"
Extents: TypeAlias = "tuple[Floats, Floats]"

DIRECTIONS: Final = np.array([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)])
ERROR: Final = 1e-12
"""Bound of the error of a float test, relative to the largest term.

A test is a sum of four products of correctly rounded quotients: its error is below 8 * 2^-53 of the
sum of the sizes of the terms, which is at most four times the largest one.
"""


class Plane(NamedTuple):
    """A moving line x p_x + y p_y = c + v t."""

    x: int
    y: int
    c: Fraction
    v: Fraction

    def line(self) -> str:
        """Return the node that begins with it."""
        return f"c {self.x} {self.y} {self.c}" + (f" {self.v}" if self.v else "")


class Cut(NamedTuple):
    """A moving line: its direction, its places at both ends of an interval, and the room it has."""

    worth: float
    direction: tuple[int, int]
    places: tuple[float, float]
    gap: float


class Breaks(NamedTuple):
    """The times at which the formulas of a body change."""

    breaks: Sequence[Fraction]


@final
class Paths:
    """The vertices of bodies, numbered through, with what `exactpt.check_apart.Interval` needs.

    Attributes:
        items: of each edge, or of the only vertex of a body: the body and two vertices.
        body_of: the body of each vertex.
        first: the number of the first vertex of each body.
        breaks: the breakpoints of each body.
        radii: the radius of each body.
        distance: a number below the distances to be certified.
        body: the body of each item.
        wide: the radius of the body of each item, in doubles.
        extra: the distance, in doubles.
    """

    def __init__(self, bodies: Sequence[Body], distance: Fraction) -> None:
        self._bodies, self.distance, self.extra = bodies, distance, float(distance)
        self.breaks = [Breaks(body.breakpoints) for body in bodies]
        self.radii = [body.radius for body in bodies]
        self.items: list[tuple[int, int, int]] = []
        self.body_of: list[int] = []
        self.first: list[int] = []
        for i, body in enumerate(bodies):
            first = len(self.body_of)
            self.first.append(first)
            self.body_of += [i] * body.size
            self.items += [(i, first + u, first + v) for u, v in body.edges or [(0, 0)]]
        self.body = np.array([i for i, _, _ in self.items], dtype=np.intp)
        self.wide = np.array([float(r) for r in self.radii])[self.body]
        self._made = dict[tuple[int, int], Any]()

    def of(self, v: int) -> Breaks:
        """Return the body of a vertex."""
        return self.breaks[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Any:  # noqa: ANN401 - polynomials of check_apart
        """Return the path of a vertex just after a time."""
        i = self.body_of[v]
        breaks = self.breaks[i].breaks
        key = v, bisect_right(breaks, after) if breaks else 0
        if key not in self._made:
            track = self._bodies[i]._piece_after(after).track(v - self.first[i])
            self._made[key] = tuple([*map(int, f)] for f in (track.x, track.y, track.w))
        return self._made[key]

    def place(self, v: int, t: Fraction) -> Whole:
        """Return where a vertex is at a time."""
        x, y, w = values(self.track(v, t), t)
        return x, y, w


@final
class Frame:
    """Items in an interval of time, in doubles relative to an integer point near them.

    Attributes:
        time: the interval.
        start, length: of the interval.
        ends: (x, y) of all vertices at the start and at the end of the interval.
        ends_of: the two vertices of each item.
    """

    @np.errstate(all="ignore")  # the checker's exact test decides about infinities and NaN
    def __init__(self, paths: Paths, items: Items, start: Fraction, end: Fraction) -> None:
        self.time, self.start, self.length = Interval(start, end), start, float(end - start)
        self._paths, self._items = paths, items
        ends = [paths.items[i][1:] for i in items.tolist()]
        row = {v: k for k, v in enumerate(dict.fromkeys(chain.from_iterable(ends)))}
        self.ends_of = np.array([(row[u], row[v]) for u, v in ends])
        hulls = [self.time.hull(paths, v) for v in row]  # type: ignore[arg-type]
        x, y, _, w = hulls[0][0]
        a, b = self._origin = int(x // w), int(y // w)
        n, d = start.numerator, start.denominator
        flat = [
            ((x - a * w) / w, (y - b * w) / w, (d * t - n * w) / (d * w))
            if w > 0
            else (np.nan, np.nan, 0.0)
            for x, y, t, w in chain.from_iterable(hulls)
        ]
        self._points = np.array(flat)  # (x, y, t) of all control points
        self._starts = np.cumsum([0, *map(len, hulls)])
        firsts, lasts = self._starts[:-1], self._starts[1:] - 1
        self.ends = np.stack([self._points[firsts, :2], self._points[lasts, :2]])
        self._size = float(np.nanmax(np.abs(self._points[:, :2]), initial=0.0))
        self._extents = self.extents(items, slice(None), DIRECTIONS)

    def rows(self, items: Items) -> Items:
        """Return the rows of some of the items."""
        return np.searchsorted(self._items, items)

    def extents(self, items: Items, rows: Items | slice, directions: Floats) -> Extents:
        """Return the least and largest values at start and end, (2, items, directions).

        The radii are added on both sides, and the distance above.
        """
        along, norm = self.ends @ directions.T, np.hypot(*directions.T)
        u, v = along[:, self.ends_of[rows, 0]], along[:, self.ends_of[rows, 1]]
        wide = self._paths.wide[items][:, None] * norm
        return np.minimum(u, v) - wide, np.maximum(u, v) + (wide + self._paths.extra * norm)

    def usual(self, rows: Items) -> Extents:
        """Return the extents in the usual directions."""
        low, high = self._extents
        return low[:, rows], high[:, rows]

    def plane(self, cut: Cut) -> Plane:
        """Return a moving line with short numbers."""
        (x, y), (c, d), unit = cut.direction, cut.places, cut.gap / 16
        v = Fraction(0)
        if c != d and self.length:
            v = short(Fraction((d - c) / self.length), unit / self.length)
        at = Fraction(c) + (x * self._origin[0] + y * self._origin[1])
        return Plane(x, y, short(at - v * self.start if v and self.start else at, unit), v)

    def sides(self, items: Items, rows: Items, plane: Plane) -> tuple[Any, Any]:
        """Return which items the checker finds below a moving line, and which above."""
        x, y, wide = float(plane.x), float(plane.y), self._paths.wide[items]
        at = plane.c + plane.v * self.start if plane.v and self.start else plane.c
        v, c = float(plane.v), float(at - (plane.x * self._origin[0] + plane.y * self._origin[1]))
        f = self._points @ np.array([x, y, -v]) - c
        low = np.minimum.reduceat(f, self._starts[:-1])[self.ends_of[rows]].min(axis=1)
        high = np.maximum.reduceat(f, self._starts[:-1])[self.ends_of[rows]].max(axis=1)
        norm, extra = float(np.hypot(x, y)), self._paths.extra
        error = (abs(x) + abs(y)) * self._size + abs(v) * self.length + abs(c)
        error = ERROR * (error + norm * (float(wide.max()) + extra))
        high, low = high + norm * wide, low - norm * (wide + extra)
        below, above = high < -error, low > error
        for k in np.flatnonzero(~(below | above | ((high > error) & (low < -error)))).tolist():
            body, *ends = self._paths.items[int(items[k])]
            planes = planes_of(*plane, self._paths.radii[body], self._paths.distance)
            hulls = [self.time.hull(self._paths, u) for u in ends]  # type: ignore[arg-type]
            sides = {side_of(hull, *planes) for hull in hulls}
            below[k], above[k] = sides == {-1}, sides == {1}
        return below, above


def short(x: Fraction, unit: float) -> Fraction:
    """Return a number near x with few digits: a multiple of a power of two not above the unit."""
    if not unit > 0:
        return x
    power, n, d = frexp(unit)[1] - 1, x.numerator, x.denominator
    n, d = (n << -power, d) if power < 0 else (n, d << power)
    k = (2 * n + d) // (2 * d)
    return Fraction(k, 1 << -power) if power < 0 else Fraction(k << power)
