"""Pairs of features of two pieces in any motion: from when on they may touch.

Two pieces touch first where a vertex is on an edge. If they have radii of the sum R, they do where
a vertex is at the distance R of an edge, beside it, or of a vertex. A span of time is looked at in
windows, in the order of time:

    [low                             high]
    [  rough  ]..........................     halved: the remainders of the models are
    [ rough][ ]..........................     large beside the boxes of the pieces
    [  ][  ][apart]......................     excluded: the boxes do not meet
      ^ a candidate

In a window of which the models are good, boxes exclude most pairs of features, and `Zero.find`
decides the others. What is left is a candidate (low, high, until):

* before ``low`` the two certainly do not touch, as far as this window goes; ``low`` is below the
  first time at which they may touch, never equal;
* until ``high`` they may touch, or certainly do;
* between ``high`` and ``until``, the end of the window, they may touch too.

A certain contact excludes all that is later: `Candidates.limit` is the least ``high`` of one. It
has to be after ``after``, up to which the caller answers for the two. It has to be inside the
spans of both pieces too: their ends are rounded outward in the table, and behind its end the
formula of a piece goes on, but the piece does not.
"""

from collections.abc import Callable
from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.boxes import sorted_by
from exactpt.filters.candidates import (
    NO_EDGE,
    Candidates,
    Features,
    two_vertices,
    vertex_on_edge,
)
from exactpt.filters.rounding import INFINITY, SLACK, TINY, U4
from exactpt.filters.rows import STRAIGHT, Table
from exactpt.filters.windows import ROW, X0, X1, X2, Y0, Y1, Y2, Window, are_apart, edge_box
from exactpt.filters.zeros import MAYBE, NONE, SURE, Zero

ROUGH: Final = 2.0**-10
"""Remainder of good models at most, relative to the extent of two pieces.

Rough candidates are wide, and exact arithmetic is slow on them: with 2^-6 a search among 400
turning bodies takes 8 times as long, with 2^-4 a hundred times.
"""
SHORTEST: Final = 2.0**-14
"""Length at which windows are halved no more, relative to the span."""
MOST_SHARPENINGS: Final[i64] = 12
EDGES_A_LOOK: Final[i64] = 64
"""Number of edges of a window between two looks at the clock."""
WINDOWS_A_LOOK: Final[i64] = 8
"""Number of windows between two looks at the clock."""


class Filter:
    """The candidates of pairs of pieces in any motion. It keeps its windows, which are large.

    Args:
        table: the pieces.
        exact_only: whether all that boxes do not exclude is left to exact arithmetic.
        look: is called from time to time: a caller may look at the clock, and end all by an error.

    Attributes:
        table: as given.
        exact_only: as given.
        p, q: the windows of the two pieces at hand.
        zero: the pair of features at hand.
        middle, half: the window of time.
        distance: the sum of the radii; 0 for a piece and itself, as what deforms has no radius.
        first, last: a certain contact is between these times.
    """

    def __init__(
        self, table: Table, *, exact_only: bool = False, look: Callable[[], None] | None = None
    ) -> None:
        self.table = table
        self._look = look
        self._steps: i64 = 0
        self.exact_only = exact_only
        self.p = Window()
        self.q = Window()
        self.zero = Zero()
        self.middle = 0.0
        self.half = 0.0
        self.distance = 0.0
        self.first = 0.0
        self.last = 0.0

    def collect(
        self, a: i64, b: i64, low: float, high: float, after: float, found: Candidates
    ) -> None:
        """Add the candidates of two pieces, or of one with itself, in [low, high].

        Args:
            a: a piece.
            b: another piece; or the same one, whose vertices may touch its own edges.
            low: the begin of a part of the spans of both.
            high: the end of it.
            after: a certain contact counts after this time.
            found: takes the candidates; what is after its limit is left out.
        """
        self._choose(a, b, after)
        shortest = (high - low) * SHORTEST
        begins, ends = vec[float]([low]), vec[float]([high])  # a stack of windows
        wholes = vec[float]([INFINITY])  # the remainders of the windows that they are halves of
        n: i64 = 1
        while n > 0:
            n -= 1
            begin, end = begins[n], min(ends[n], found.limit)
            if begin > end:
                continue
            self._step()
            self._fill(a, b, begin, end)
            q = self.p if a == b else self.q
            if a != b and are_apart(self.p, q, self.distance):
                continue
            if end - begin > shortest and self._is_rough(self.p, q, wholes[n]):
                is_coarse = self.p.is_coarse or q.is_coarse
                whole = INFINITY if is_coarse else self.p.remainder + q.remainder
                while len(begins) < n + 2:
                    begins, ends = append(begins, 0.0), append(ends, 0.0)
                    wholes = append(wholes, 0.0)
                wholes[n], wholes[n + 1] = whole, whole
                begins[n], ends[n] = self.middle, end
                begins[n + 1], ends[n + 1] = begin, self.middle
                n += 2
            else:
                self._collect_window(q, found)

    def _step(self) -> None:
        """Look at the clock after some windows."""
        self._steps += 1
        if self._look is not None and self._steps % WINDOWS_A_LOOK == 0:
            self._look()

    def _choose(self, a: i64, b: i64, after: float) -> None:
        """Begin with two pieces."""
        table = self.table
        self.distance = 0.0 if a == b else table.radius[a] + table.radius[b]
        begin = max(table.start[a], table.start[b])
        self.first = max(after, begin)
        self.last = min(table.end[a], table.end[b])

    def _fill(self, a: i64, b: i64, begin: float, end: float) -> None:
        """Set the windows of two pieces; the second one is left alone if they are the same."""
        middle = 0.5 * (begin + end)
        half = max(end - middle, middle - begin) * (1.0 + U4) + TINY
        self.middle, self.half = middle, half
        self.p.fill(self.table, a, middle, half)
        if a != b:
            self.q.fill(self.table, b, middle, half)

    def _is_rough(self, p: Window, q: Window, whole: float) -> bool:
        """Return True if shorter windows may say more of where the vertices are.

        Their remainders are compared with the extent of both pieces, since a point has none. A NaN
        or an infinity is never rough: it stays in each part. So does rounding, which may be all
        there is if the window is far from 0: what halving has not made smaller is not rough.

        Args:
            p: the window of a piece.
            q: that of the other one.
            whole: the remainder of the window that this one is a half of.
        """
        if p.is_coarse or q.is_coarse:
            return True
        if not p.rho + q.rho < INFINITY:
            return False
        width = max(p.right, q.right) - min(p.left, q.left)
        height = max(p.top, q.top) - min(p.bottom, q.bottom)
        remainder = p.remainder + q.remainder
        is_smaller = remainder < 0.5 * whole
        return is_smaller and remainder > ROUGH * (width + height + self.distance)

    def _collect_window(self, q: Window, found: Candidates) -> None:
        """Add the candidates of a window of time."""
        p = self.p
        self._add_edges(p, q, found)
        if p.piece == q.piece:
            self._add_shrinking(p, found)
            return
        self._add_edges(q, p, found)
        if self.distance != 0.0:  # a NaN is a distance too
            self._add_vertices(p, q, found)

    def _add_edges(self, p: Window, q: Window, found: Candidates) -> None:
        """Add vertices of p and edges of q, but for the ends of an edge. A disc has no edge."""
        table, distance, is_own = self.table, self.distance, p.piece == q.piece
        begins, ends, rows = table.begins, table.ends, p.rows
        n, first, edges = table.size[p.piece], table.edge[q.piece], table.edges[q.piece]
        d = (distance + 2.0 * (p.rho + q.rho)) * SLACK + TINY  # see `edge_box`
        e: i64 = -1
        while e + 1 < edges:
            e += 1
            if e % EDGES_A_LOOK == EDGES_A_LOOK - 1 and self._look is not None:
                self._look()
            i, j = begins[first + e], ends[first + e]
            if i == j and distance != 0.0:
                continue
            left, right, bottom, top = edge_box(q.rows, i, j, d)
            if left > p.right or right < p.left or bottom > p.top or top < p.bottom:
                continue
            v: i64 = -1
            while v + 1 < n:
                v += 1
                row = ROW * v
                x, x_way = rows[row + X0], abs(rows[row + X1]) + abs(rows[row + X2])
                if x - x_way > right or x + x_way < left:
                    continue
                y, y_way = rows[row + Y0], abs(rows[row + Y1]) + abs(rows[row + Y2])
                if y - y_way > top or y + y_way < bottom:
                    continue
                if is_own and v in (i, j):
                    continue
                found.compared += 1
                self._add_edge(p, v, q, e, found)

    def _add_edge(self, p: Window, v: i64, q: Window, e: i64, found: Candidates) -> None:
        """Add a vertex of p and an edge of q, if they may touch.

        With a radius, f = R |u| on one side of the edge and f = -R |u| on the other one.
        """
        table, zero, distance = self.table, self.zero, self.distance
        if self.exact_only:
            self._keep_whole_window(vertex_on_edge(p.piece, v, q.piece, e), found)
            return
        at = table.edge[q.piece] + e
        i, j = table.begins[at], table.ends[at]
        zero.z.set(p.rows, v, q.rows, i, p.rho + q.rho)
        zero.u.set(q.rows, j, q.rows, i, 2.0 * q.rho)
        zero.orientation()
        if distance == 0.0:
            state = zero.find()
            if state != NONE:
                self._keep(state, vertex_on_edge(p.piece, v, q.piece, e), found)
            return
        found.compared += 1  # each side of the edge counts by itself
        f0, error = zero.f0, zero.error
        for side in (distance, -distance):
            zero.f0, zero.error = f0, error
            zero.subtract_length(side, is_rigid=q.has_rigid_edges)
            state = zero.find()
            if state != NONE:
                self._keep(state, vertex_on_edge(p.piece, v, q.piece, e), found)

    def _add_vertices(self, p: Window, q: Window, found: Candidates) -> None:
        """Add pairs of vertices that may come to the distance."""
        n, m = self.table.size[p.piece], self.table.size[q.piece]
        v: i64 = 0
        while v < n:
            w: i64 = 0
            while w < m:
                self._add_vertex(p, v, q, w, found)
                w += 1
            v += 1

    def _add_vertex(self, p: Window, v: i64, q: Window, w: i64, found: Candidates) -> None:
        """Add a vertex of p and a vertex of q, if they may come to the distance."""
        zero, distance = self.zero, self.distance
        zero.z.set(p.rows, v, q.rows, w, p.rho + q.rho)
        if zero.z.is_far(distance):
            return
        found.compared += 1
        if self.exact_only:
            self._keep_whole_window(two_vertices(p.piece, v, q.piece, w), found)
            return
        zero.squared_distance(distance)
        state = zero.find()
        if state != NONE:
            self._keep(state, two_vertices(p.piece, v, q.piece, w), found)

    def _add_shrinking(self, p: Window, found: Candidates) -> None:
        """Add the ends of each edge that may shrink to a point: a piece touches itself there."""
        table, zero = self.table, self.zero
        first = table.edge[p.piece]
        e: i64 = 0
        while e < table.edges[p.piece]:
            i, j = table.begins[first + e], table.ends[first + e]
            zero.z.set(p.rows, i, p.rows, j, 2.0 * p.rho)
            if i != j and not zero.z.is_far(0.0):
                found.compared += 1
                self._keep_whole_window(two_vertices(p.piece, i, p.piece, j), found)
            e += 1

    def _keep_whole_window(self, features: Features, found: Candidates) -> None:
        """Add features that may touch at any time of the window."""
        self.zero.low, self.zero.high = -1.0, 1.0
        self._keep(MAYBE, features, found)

    def _keep(self, state: i64, features: Features, found: Candidates) -> None:
        """Add what `Zero.find` found, in time.

        Rounding: middle + half s -+ 4 U (|middle| + half) is off by less than 4 U (|middle| +
        half).
        """
        middle, half, zero = self.middle, self.half, self.zero
        off = U4 * (abs(middle) + half)
        low, high = middle + half * zero.low - off, middle + half * zero.high + off
        if low > found.limit:
            return
        is_sure = state == SURE and low > self.first and high < self.last
        if is_sure:
            found.limit = min(found.limit, high)
        until = middle + half + off
        found.add(features, low, high, until, is_sure=is_sure)

    def sharpen(self, found: Candidates, after: float) -> Candidates:
        """Return the candidates that matter, each looked at once more in short windows around it.

        The remainder of a model is of the third order: a window of a thousandth makes it 10^9
        times smaller. The earliest come first, so that a certain contact excludes others. Models
        of straight motion have no remainder to lose; edges that shrink to a point are not looked
        at.

        Args:
            found: candidates of any pairs of pieces.
            after: a certain contact counts after this time.
        """
        sharper = Candidates(found.limit)
        sharper.compared, sharper.pairs = found.compared, found.pairs
        kind = self.table.kind
        order = sorted_by(found.low)
        k: i64 = 0
        while k < len(order):
            c = order[k]
            low, high, until = found.low[c], found.high[c], found.until[c]
            if low > sharper.limit:
                break
            a, b = found.one[c], found.other[c]
            is_straight = kind[a] == STRAIGHT and kind[b] == STRAIGHT
            is_shrinking = a == b and found.edge[c] == NO_EDGE
            if not (is_straight or is_shrinking or self.exact_only):
                excerpt = self._excerpt(found.features(c))
                low, high = excerpt.sharpened(low, high, until, after, sharper)
            if not low > until:
                sharper.add(found.features(c), low, high, until)
            k += 1
        return sharper

    def _excerpt(self, features: Features) -> "Filter":
        """Return a filter of the two features alone: windows of large pieces take long to fill.

        Its piece 0 has the vertex, as its vertex 0. The other feature is edge 0 of piece 1, or its
        vertex 0; of a piece and itself it is edge 0 of piece 0.
        """
        table, excerpt = self.table, Table()
        ends = vec[i64]([features.other_vertex])
        if features.edge != NO_EDGE:
            at = table.edge[features.other] + features.edge
            ends = vec[i64]([table.begins[at], table.ends[at]])
        if features.one == features.other:
            excerpt.add_edges([(1, 2)])
            vertices = vec[i64]([features.vertex, ends[0], ends[1]])
            excerpt.add_excerpt(table, features.one, vertices, 1)
        else:
            excerpt.add_excerpt(table, features.one, vec[i64]([features.vertex]), 0)
            edges: i64 = 0 if features.edge == NO_EDGE else 1
            if edges == 1:
                excerpt.add_edges([(0, 0 if ends[0] == ends[1] else 1)])
            excerpt.add_excerpt(table, features.other, ends, edges)
        return Filter(excerpt, look=self._look)

    def sharpened(
        self, low: float, high: float, until: float, after: float, limited: Candidates
    ) -> tuple[float, float]:
        """Return better bounds of the time from which on the features of an excerpt may touch.

        If nothing is in [low, high], the rest of the window follows.

        Args:
            low: a bound.
            high: the other bound.
            until: the end of the window.
            after: a certain contact counts after this time.
            limited: its limit is lowered if the two certainly touch.

        Returns:
            low and high; both are infinite if the two do not touch up to ``until``.
        """
        b: i64 = len(self.table.body) - 1
        self._choose(0, b, after)
        is_of_vertices = self.table.edges[b] == 0
        turns: i64 = 0
        while turns < MOST_SHARPENINGS and low <= limited.limit:
            turns += 1
            self._step()
            self._fill(0, b, low, high)
            one = Candidates(limited.limit)
            q = self.p if b == 0 else self.q
            if is_of_vertices:
                self._add_vertex(self.p, 0, q, 0, one)
            else:
                self._add_edge(self.p, 0, q, 0, one)
            limited.limit = one.limit
            n = len(one.low)
            if n == 0:  # nothing up to high, or up to the limit
                if high >= until:
                    return INFINITY, INFINITY
                low, high = high, until
                continue
            if n > 1:  # on both sides of the edge
                return low, high
            width = high - low
            low, high = max(low, one.low[0]), min(high, one.high[0])
            if not high - low < 0.25 * width:
                return low, high
        return low, high
