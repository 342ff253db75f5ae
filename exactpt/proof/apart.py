"""The nodes of a certificate that bodies stay apart (docs/proofs.md, Certificates).

Floats choose moving lines, and on which side of them an item is, if by more than an error bound;
else the checker's own exact test decides. So the nodes are those that the checker goes through.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Collection, Iterator, Sequence
from fractions import Fraction
from itertools import chain
from math import frexp
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import numpy as np

from exactpt.check_apart import Interval, Poly, planes_of, side_of
from exactpt.errors import BudgetExceeded
from exactpt.kernel.budget import ask

if TYPE_CHECKING:
    from exactpt.motion.body import Body

Items: TypeAlias = "np.ndarray[Any, np.dtype[np.intp]]"
Floats: TypeAlias = "np.ndarray[Any, np.dtype[np.float64]]"

DIRECTIONS: Final = np.array([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)])
CLEAR: Final = 1e-11
"""Smallest gap that a line is put into, relative to the extent of all items."""
CROSSING: Final = 1.7
"""Parts of all items that both children of a node with a line through some of them may have."""
FEW, CLOSE = 8, 1e-15
"""Of so few items, gaps down to the second number are tried: the exact test decides."""
ERROR: Final = 1e-12
"""Bound of the error of a float test, relative to the largest term.

A test is a sum of four products of correctly rounded quotients: its error is below 8 * 2^-53 of the
sum of the sizes of the terms, which is at most four times the largest one.
"""
MANY: Final = 24
"""Number of items up to which edges and nearest vertices propose directions, too."""
FINEST: Final = 2**40
"""Times are not halved further than to this part of the span."""


class Plane(NamedTuple):
    """A moving line x p_x + y p_y = c + v t."""

    x: int
    y: int
    c: Fraction
    v: Fraction

    def line(self) -> str:
        """Return the node that begins with it."""
        return f"c {self.x} {self.y} {self.c}" + (f" {self.v}" if self.v else "")


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
    """

    def __init__(self, bodies: Sequence[Body]) -> None:
        self._bodies = bodies
        self.breaks = [Breaks(body.breakpoints) for body in bodies]
        self.items: list[tuple[int, int, int]] = []
        self.body_of: list[int] = []
        self.first: list[int] = []
        for i, body in enumerate(bodies):
            first = len(self.body_of)
            self.first.append(first)
            self.body_of += [i] * body.size
            self.items += [(i, first + u, first + v) for u, v in body.edges or [(0, 0)]]
        self._made: dict[tuple[int, int], Any] = {}

    def of(self, v: int) -> Breaks:
        """Return the body of a vertex."""
        return self.breaks[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Any:  # noqa: ANN401 - a track of check_apart
        """Return the path of a vertex just after a time."""
        i = self.body_of[v]
        breaks = self.breaks[i].breaks
        key = v, bisect_right(breaks, after) if breaks else 0
        if key not in self._made:
            piece = self._bodies[i]._piece_after(after)
            track = piece.track(v - self.first[i])
            self._made[key] = tuple(Poly(map(int, f)) for f in (track.x, track.y, track.w))
        return self._made[key]


@final
class Frame:
    """Items in an interval of time, in doubles relative to an integer point near them.

    Attributes:
        time: the interval.
        origin: the integer point.
        points: (x, y, t) of all control points, t relative to the start.
        ends: (x, y) of all vertices at the start and at the end of the interval.
        ends_of: the two vertices of each item.
    """

    def __init__(self, paths: Paths, items: Items, start: Fraction, end: Fraction) -> None:
        self.time, self.start, self.length = Interval(start, end), start, float(end - start)
        self._items = items
        ends = [paths.items[i][1:] for i in items.tolist()]
        row = {v: k for k, v in enumerate(dict.fromkeys(chain.from_iterable(ends)))}
        self.ends_of = np.array([(row[u], row[v]) for u, v in ends])
        hulls = [self.time.hull(paths, v) for v in row]  # type: ignore[arg-type]
        x, y, _, w = hulls[0][0]
        a, b = self.origin = int(x // w), int(y // w)
        n, d = start.numerator, start.denominator
        flat = [
            ((x - a * w) / w, (y - b * w) / w, (d * t - n * w) / (d * w))
            if w > 0
            else (np.nan, np.nan, 0.0)
            for x, y, t, w in chain.from_iterable(hulls)
        ]
        self.points = np.array(flat)
        counts = [len(h) for h in hulls]
        self._starts = np.cumsum([0, *counts[:-1]])
        last = self._starts + np.array(counts) - 1
        self.ends = np.stack([self.points[self._starts, :2], self.points[last, :2]])
        self.size = float(np.nanmax(np.abs(self.points[:, :2]), initial=0.0))
        self._extents = self.extents(slice(None), DIRECTIONS)

    def rows(self, items: Items) -> Items:
        """Return the rows of some of the items."""
        return np.searchsorted(self._items, items)

    def extents(self, rows: Items | slice, directions: Floats) -> tuple[Floats, Floats]:
        """Return the least and largest values at start and end, (2, items, directions)."""
        along = self.ends @ directions.T
        u, v = along[:, self.ends_of[rows, 0]], along[:, self.ends_of[rows, 1]]
        return np.minimum(u, v), np.maximum(u, v)

    def usual(self, rows: Items) -> tuple[Floats, Floats]:
        """See `extents`, in the usual directions."""
        low, high = self._extents
        return low[:, rows], high[:, rows]

    def values(self, rows: Items, plane: Plane) -> tuple[Floats, Floats, float]:
        """Return the least and largest values of n.p - c - v t of items, and an error bound."""
        c = plane.c + plane.v * self.start - plane.x * self.origin[0] - plane.y * self.origin[1]
        x, y, v, d = float(plane.x), float(plane.y), float(plane.v), float(c)
        f = self.points @ np.array([x, y, -v]) - d
        low, high = np.minimum.reduceat(f, self._starts), np.maximum.reduceat(f, self._starts)
        u, w = self.ends_of[rows, 0], self.ends_of[rows, 1]
        terms = (abs(x) + abs(y)) * self.size + abs(v) * self.length + abs(d)
        return np.minimum(low[u], low[w]), np.maximum(high[u], high[w]), ERROR * terms


class Cut(NamedTuple):
    """A moving line: its direction, and its places at the start and the end of an interval."""

    worth: float
    direction: tuple[int, int]
    places: tuple[float, float]
    gap: float


@final
class Separation:
    """The search for the nodes of a certificate.

    Args:
        paths: the vertices.
        bodies: the bodies.
        groups: a number for each body; bodies with equal ones do not count as a pair.
        counts: whether two of some bodies are a pair that counts.
        distance: a number below the distances to be certified.
        counted: the pairs of bodies that count, if they are named.
    """

    def __init__(
        self,
        paths: Paths,
        bodies: Sequence[Body],
        groups: Sequence[int],
        counts: Callable[[set[int]], bool],
        distance: Fraction,
        counted: Collection[tuple[int, int]] | None = None,
    ) -> None:
        self._paths, self._counts, self._distance = paths, counts, distance
        self._counted = counted
        self._radii = [body.radius for body in bodies]
        self._body = np.array([i for i, _, _ in paths.items], dtype=np.intp)
        self._group = np.array(groups, dtype=np.intp)[self._body]
        self._wide = np.array([float(r) for r in self._radii])[self._body]
        self._extra = float(distance)
        self._span = Fraction(1)
        self.nodes = 0

    def lines(self, start: Fraction, end: Fraction) -> Iterator[str]:
        """Yield the lines of the nodes, for all items from start to end.

        Raises:
            BudgetExceeded: if bodies are too near to each other, or there are too many nodes.
        """
        items = np.arange(len(self._body), dtype=np.intp)
        self._span, most = end - start, 1000 + 50 * len(items)
        todo: list[tuple[Items, Frame | tuple[Fraction, Fraction], int]] = [
            (items, (start, end), 0)
        ]
        while todo:
            items, time, depth = todo.pop()
            present = set(self._body[items].tolist())
            if not len(items) or not self._counts(present):
                continue
            ask()
            if self._counted:  # the others do not matter in this node, nor in any below it
                here = [pair for pair in self._counted if {*pair} <= present]
                items = items[np.isin(self._body[items], np.ravel(here))]
            frame = time if isinstance(time, Frame) else Frame(self._paths, items, *time)
            self.nodes += 1
            if self.nodes > most:
                raise BudgetExceeded(f"a certificate of more than {most} nodes is needed", None)
            rows = frame.rows(items)
            found = self._cut(frame, items, rows)
            if found is not None:
                plane, below, above = found
                yield plane.line()
                todo += [(items[~below], frame, depth + 1), (items[~above], frame, depth + 1)]
                continue
            body, several = self._largest(items)
            start, end = frame.time.start, frame.time.end
            is_short = start == end or (end - start) * 64 < self._span
            if len(several) > 1 and (depth % 2 or is_short):
                middle = int(several[len(several) // 2])
                yield f"s {body} {middle}"
                mine = self._body[items] == body
                parts = [items[~(mine & (items < middle))], items[~(mine & (items >= middle))]]
                todo += [(part, frame, depth + 1) for part in parts]
                continue
            if (end - start) * FINEST < self._span or start == end:
                raise BudgetExceeded("bodies are too near to each other for a certificate", None)
            yield from self._halve(items, start, end, depth, todo)

    def _halve(
        self, items: Items, start: Fraction, end: Fraction, depth: int, todo: list[Any]
    ) -> Iterator[str]:
        """Split the time: at a breakpoint of a body, if there is one."""
        middle = (start + end) / 2
        bodies = {*self._body[items].tolist()}
        breaks = {q for i in bodies for q in self._paths.breaks[i].breaks if start < q < end}
        q = min(breaks, key=lambda q: (abs(q - middle), q)) if breaks else middle
        yield "t" if q == middle else f"t {q}"
        todo += [(items, (q, end), depth + 1), (items, (start, q), depth + 1)]

    def _largest(self, items: Items) -> tuple[int, Items]:
        """Return the body with most items here, and these."""
        bodies = self._body[items]
        body = int(np.bincount(bodies).argmax())
        return body, items[bodies == body]

    def _cut(self, frame: Frame, items: Items, rows: Items) -> tuple[Plane, Any, Any] | None:
        """Return a good moving line, with the items below and above it; None if there is none."""
        usual = DIRECTIONS, frame.usual(rows)
        for cut in sorted(self._clean(items, *usual), reverse=True)[:3]:
            if (found := self._made(frame, items, rows, cut, 1.0)) is not None:
                return found
        more = self._directions(frame, items, rows)
        further = more, frame.extents(rows, more)
        cuts = self._clean(items, *further) if len(more) else []
        most = 1.0
        for _ in range(2):
            for cut in sorted(cuts, reverse=True)[:3]:
                if (found := self._made(frame, items, rows, cut, most)) is not None:
                    return found
            cuts, most = [], CROSSING
            for some in (usual, further):
                cuts += self._crossing(items, *some) if len(items) > 4 and len(some[0]) else []
        return None

    def _clean(self, items: Items, directions: Floats, extents: tuple[Floats, Floats]) -> list[Cut]:
        """Return lines between all items, in their order along a direction: the best of each."""
        low, high, norm = *extents, np.hypot(*directions.T)
        wide = self._wide[items][:, None] * norm
        low, high = low - wide, high + wide + self._extra * norm
        count = len(items)
        order = np.argsort((low + high).sum(axis=0), axis=0, kind="stable")
        columns = np.arange(len(directions))
        before = np.maximum.accumulate(high[:, order, columns], axis=1)[:, :-1]
        after = low[:, order, columns][:, ::-1]
        after = np.minimum.accumulate(after, axis=1)[:, ::-1][:, 1:]
        gap = (after - before).min(axis=0)
        extent = high.max(axis=(0, 1)) - low.min(axis=(0, 1)) + 1e-300
        clear = gap / extent
        group = self._group[items][order]
        alone = np.logical_and.accumulate(group == group[0], axis=0)[:-1].astype(float)
        alone += np.logical_and.accumulate(group[::-1] == group[-1], axis=0)[::-1][1:]
        k = np.arange(1, count)[:, None]
        worth = np.minimum(k, count - k) / count + 0.4 * alone + 0.3 * np.minimum(clear, 0.3)
        worth -= 0.1 * (np.abs(directions).max(axis=1) > 1e6)  # longer numbers
        worth[~(clear > (CLEAR if count > FEW else CLOSE))] = -1.0
        best, found = worth.argmax(axis=0), []
        for j, k in enumerate(best.tolist()):
            if worth[k, j] > 0:
                middle = ((before[:, k, j] + after[:, k, j]) / 2 - self._extra * norm[j]).tolist()
                x, y = directions[j].tolist()
                value = (float(worth[k, j]), (int(x), int(y)), (middle[0], middle[1]))
                found.append(Cut(*value, float(gap[k, j])))
        return found

    def _crossing(
        self, items: Items, directions: Floats, extents: tuple[Floats, Floats]
    ) -> list[Cut]:
        """Return lines through the middle of all items, some of which are on both sides."""
        low, high, norm = *extents, np.hypot(*directions.T)
        wide = self._wide[items][:, None] * norm
        low, high = low - wide, high + wide + self._extra * norm
        size = high.max(axis=(0, 1)) - low.min(axis=(0, 1)) + 1e-300
        count, ordered = len(items), np.sort((low + high) / 2, axis=1)
        between = (ordered[:, 1:] + ordered[:, :-1]) / 2
        places = [between[:, (count - 1) * part // 100] for part in (20, 35, 50, 65, 80)]
        at = np.stack([*places, np.broadcast_to(places[2].mean(axis=0), places[2].shape)])
        below = (high < (at - 1e-6 * size)[:, :, None]).all(axis=1).sum(axis=1)
        above = (low > (at + 1e-6 * size)[:, :, None]).all(axis=1).sum(axis=1)
        least = np.minimum(below, above)
        found: list[Cut] = []
        for k, j in zip(
            *np.unravel_index(np.argsort(-least, axis=None)[:3], least.shape), strict=True
        ):
            if least[k, j]:
                x, y = directions[j].tolist()
                c, d = (at[k, :, j] - self._extra * norm[j]).tolist()
                worth = float(least[k, j]) / count
                found.append(Cut(worth, (int(x), int(y)), (c, d), 1e-3 * float(size[j])))
        return found

    def _made(
        self, frame: Frame, items: Items, rows: Items, cut: Cut, most: float
    ) -> tuple[Plane, Any, Any] | None:
        """Return a cut with short numbers, if it is a good one."""
        (x, y), (c, d), start = cut.direction, cut.places, frame.start
        unit = cut.gap / 16
        v = (
            short(Fraction(d - c) / Fraction(frame.length), unit / frame.length)
            if c != d and frame.length
            else Fraction(0)
        )
        shift = x * frame.origin[0] + y * frame.origin[1] - v * start
        plane = Plane(x, y, short(Fraction(c) + shift, unit), v)
        below, above = self._sides(frame, items, rows, plane)
        one, other = len(items) - int(above.sum()), len(items) - int(below.sum())
        if max(one, other) == len(items) or one + other > most * len(items):
            return None
        return plane, below, above

    def _sides(self, frame: Frame, items: Items, rows: Items, plane: Plane) -> tuple[Any, Any]:
        """Which items the checker finds below and above a moving line."""
        low, high, error = frame.values(rows, plane)
        norm = float(np.hypot(plane.x, plane.y))
        wide = self._wide[items] * norm
        error += 1e-12 * (float(wide.max(initial=0.0)) + self._extra * norm)
        high, low = high + wide, low - wide - self._extra * norm
        below, above = high < -error, low > error
        open_ones = ~(below | above | ((high > error) & (low < -error)))
        for k in np.flatnonzero(open_ones).tolist():
            body, *ends = self._paths.items[int(items[k])]
            planes = planes_of(*plane, self._radii[body], self._distance)
            hulls = [frame.time.hull(self._paths, u) for u in ends]  # type: ignore[arg-type]
            sides = {side_of(hull, *planes) for hull in hulls}
            below[k], above[k] = sides == {-1}, sides == {1}
        return below, above

    def _directions(self, frame: Frame, items: Items, rows: Items) -> Floats:
        """Return normals of some edges, and directions between nearest vertices of two groups."""
        some = rows if len(rows) <= MANY else rows[:: len(rows) // MANY]
        u, v = frame.ends[:, frame.ends_of[some, 0]], frame.ends[:, frame.ends_of[some, 1]]
        along = np.concatenate([(v - u)[0], (v - u)[1]])
        found = [np.stack([-along[:, 1], along[:, 0]], axis=1)]
        group = self._group[items]
        mine = group == group[0]
        if len(items) <= MANY or len(np.unique(group)) == 2:
            for at in frame.ends:
                a, b = (np.unique(frame.ends_of[rows[part]].ravel()) for part in (mine, ~mine))
                apart = at[a][:, None] - at[b][None]
                i, j = np.unravel_index(int((apart**2).sum(axis=2).argmin()), apart.shape[:2])
                found.append(apart[i, j][None])
        raw = np.concatenate(found)
        size = np.abs(raw).max(axis=1, keepdims=True)
        raw = raw[(size[:, 0] > 0) & np.isfinite(size[:, 0])]
        raw /= np.abs(raw).max(axis=1, keepdims=True) if len(raw) else 1.0
        grids = (1e3, 2.0**50) if len(items) <= FEW else (1e3,)
        return np.concatenate([np.unique(np.rint(raw * grid), axis=0) for grid in grids])


def short(x: Fraction, unit: float) -> Fraction:
    """Return a number near x with few digits: a multiple of a power of two not above the unit."""
    if not unit > 0:
        return x
    power = Fraction(2) ** (frexp(unit)[1] - 1)
    return round(x / power) * power
