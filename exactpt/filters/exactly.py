"""The first of some candidates of straight motion, exactly and still in doubles.

A filter leaves several candidates where contacts are at one time: at a vertex, which is on two
edges, or where an edge lands flat on another one. Rationals decide each of them in many
microseconds. But coordinates and speeds often are small integers, or multiples of a power of two.
Then the doubles of all intermediate values are exact, and `Exactly` notices if one is not.

With z, u, w as in `exactpt.filters.straight`, all exact, a vertex first comes to lie on an edge in
one of three ways. Times are fractions n / d, with d > 0.

*It crosses the line of the edge*: u x w is not 0. The time is n / d = -(u x z) / (u x w). The foot
of the vertex is at (z + w n / d) . u / (u . u) of the edge, 0 at its begin, 1 at its end. So with
    along = d z . u + n w . u,    length = d u . u
the vertex is on the edge if 0 <= along <= length, and at an end of it if one of the two is equal.

*It moves along the line of the edge*: u x w = 0, u x z = 0, and w is not 0. It comes from outside
of the edge, and enters at the end that it comes to first::

    --*-->   o--------o              w . u > 0: at the begin, when z . u + (w . u) t = 0
             o--------o   <--*--     w . u < 0: at the end, when z . u + (w . u) t = u . u

*The edge is one point*: u = 0. The vertex is there when z + w t = 0, so if z x w = 0, at the time
-z . w / w . w.

These are all incidences that can begin at the first contact T of two pieces, which are disjoint
before. A vertex inside an edge at T does not move along its line, or it would have been on the edge
just before. Let two vertices coincide at T. If w is not parallel to one of the edges at one of
them, the vertices cross the line of that edge at T. Otherwise take an edge at one of them: the
other vertex moves along its line, and does not come along the edge, so it enters the edge at T, at
that end.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.candidates import Candidates
from exactpt.filters.error_free import Exactly
from exactpt.filters.rounding import INFINITY, TINY, U4
from exactpt.filters.rows import FRAME, PATH_X, PATH_Y, STRAIGHT, Table
from exactpt.filters.straight import SPEED

BESIDE: Final[i64] = -2
"""Place of a vertex that does not come to lie on the edge, or always lies on it."""
INSIDE: Final[i64] = -1
"""Place of a vertex between the ends of the edge."""
ABSENT: Final[i64] = 0
PRESENT: Final[i64] = 1
UNKNOWN: Final[i64] = 2
"""Whether two pieces exist at a time, the outcome of `Entry.presence`."""


class ExactIncidence(NamedTuple):
    """A vertex that first lies on an edge at some time.

    Attributes:
        piece, vertex: the vertex, and its piece.
        other, edge: the edge, and its piece.
        end: the end of the edge, a vertex of ``other``, where the vertex is; -1 if it is between
            the ends.
    """

    piece: int
    vertex: int
    other: int
    edge: int
    end: int


class Entry:
    """When and where a vertex first lies on an edge.

    Attributes:
        exactly: whether all that was computed here so far is exact, for all edges.
        numerator, denominator: the time is the quotient; the denominator is positive.
        place: an end of the edge, `INSIDE` or `BESIDE`; without a time if it is beside the edge.
    """

    def __init__(self) -> None:
        self.exactly = Exactly()
        self.numerator = 0.0
        self.denominator = 1.0
        self.place = BESIDE

    def find(self, table: Table, one: i64, vertex: i64, other: i64, edge: i64) -> None:
        """Find the entry of a vertex of one piece to an edge of the other one."""
        exactly, xs, ys = self.exactly, table.xs, table.ys
        cx, wx = self.relative_path(table, one, other, PATH_X)
        cy, wy = self.relative_path(table, one, other, PATH_Y)
        number = table.edge[other] + edge
        begin, end = table.begins[number], table.ends[number]
        place = table.place[other]
        v, p, q = table.place[one] + vertex, place + begin, place + end
        ux, uy = exactly.minus(xs[q], xs[p]), exactly.minus(ys[q], ys[p])
        zx = exactly.plus(exactly.minus(xs[v], xs[p]), cx)
        zy = exactly.plus(exactly.minus(ys[v], ys[p]), cy)
        self.place = BESIDE
        if ux == 0.0 and uy == 0.0:
            self.to_point(zx, zy, wx, wy, begin)
            return
        at_start, slope = exactly.cross(ux, uy, zx, zy), exactly.cross(ux, uy, wx, wy)
        z_along, w_along = exactly.dot(zx, zy, ux, uy), exactly.dot(wx, wy, ux, uy)
        u_squared = exactly.dot(ux, uy, ux, uy)
        if slope != 0.0:
            self.set_time(-at_start, slope)
            self.place = self.across(z_along, w_along, u_squared, begin, end)
        elif at_start == 0.0 and w_along > 0.0:
            self.set_time(-z_along, w_along)
            self.place = begin
        elif at_start == 0.0 and w_along < 0.0:
            self.set_time(exactly.minus(u_squared, z_along), w_along)
            self.place = end

    def relative_path(self, table: Table, one: i64, other: i64, axis: i64) -> tuple[float, float]:
        """Return c and w of one piece relative to another one, along one axis."""
        exactly, frames = self.exactly, table.frames
        i, j = FRAME * one + axis, FRAME * other + axis
        c = exactly.minus(frames[i], frames[j])
        return c, exactly.minus(frames[i + SPEED], frames[j + SPEED])

    def set_time(self, numerator: float, denominator: float) -> None:
        """Set the time to a quotient."""
        is_negative = denominator < 0.0
        self.numerator = -numerator if is_negative else numerator
        self.denominator = -denominator if is_negative else denominator

    def across(self, z_along: float, w_along: float, u_squared: float, begin: i64, end: i64) -> i64:
        """Return the place of a vertex at the time when it crosses the line of an edge."""
        exactly, n, d = self.exactly, self.numerator, self.denominator
        along = exactly.plus(exactly.times(d, z_along), exactly.times(n, w_along))
        length = exactly.times(d, u_squared)
        if along < 0.0 or along > length:
            return BESIDE
        if along == 0.0:
            return begin
        return end if along == length else INSIDE

    def to_point(self, zx: float, zy: float, wx: float, wy: float, point: i64) -> None:
        """Find the entry of a vertex to an edge that is one point."""
        exactly = self.exactly
        speed_squared = exactly.dot(wx, wy, wx, wy)
        if exactly.cross(zx, zy, wx, wy) == 0.0 and speed_squared > 0.0:
            self.set_time(-exactly.dot(zx, zy, wx, wy), speed_squared)
            self.place = point

    def order(self, numerator: float, denominator: float) -> float:
        """Return a number with the sign of the time less a fraction with a positive denominator.

        Two quotients of doubles that differ by more than their rounding need no exact products.
        """
        t, other = self.numerator / self.denominator, numerator / denominator
        if abs(t - other) > U4 * (abs(t) + abs(other)) + TINY:
            return t - other
        exactly = self.exactly
        return exactly.minus(
            exactly.times(self.numerator, denominator), exactly.times(numerator, self.denominator)
        )

    def presence(self, begin: float, end: float) -> i64:
        """Return whether two pieces exist at the time, between two bounds that are rounded outward.

        The quotient is off by U of itself, and an exact bound by at most 2 U of its double.
        """
        t = self.numerator / self.denominator
        of_begin = U4 * (abs(t) + abs(begin)) + TINY
        of_end = U4 * (abs(t) + abs(end)) + TINY
        if t < begin - of_begin or t > end + of_end:
            return ABSENT
        if t > begin + of_begin and t < end - of_end:
            return PRESENT
        return UNKNOWN


class First:
    """The first time at which one of some candidates touches, with all that begin at that time.

    Attributes:
        holds: whether everything that was needed was computed without rounding. If not, nothing
            else here counts.
        numerator, denominator: the time is the quotient; the denominator is positive.
        latest: a double that is at least the time; infinite if there is none.
        number: the candidates that touch at that time. If there are none, there is no time.
        end: for each of these, the end of the edge where the vertex is, or -1.
    """

    def __init__(self) -> None:
        self.holds = True
        self.numerator = 0.0
        self.denominator = 1.0
        self.latest = INFINITY
        self.number = vec[i64]()
        self.end = vec[i64]()

    def rows(self, found: Candidates) -> list[ExactIncidence]:
        """Return the incidences at that time."""
        rows: list[ExactIncidence] = []
        k: i64 = 0
        while k < len(self.number):
            c = self.number[k]
            vertex, edge = int(found.vertex[c]), int(found.edge[c])
            one, other, end = int(found.one[c]), int(found.other[c]), int(self.end[k])
            rows.append(ExactIncidence(one, vertex, other, edge, end))
            k += 1
        return rows

    def add(self, entry: Entry, candidate: i64) -> None:
        """Add a candidate, which touches at the time of an entry."""
        order = -1.0
        if len(self.number) > 0:
            order = entry.order(self.numerator, self.denominator)
        if order < 0.0:
            self.numerator, self.denominator = entry.numerator, entry.denominator
            self.latest = self.numerator / self.denominator
            self.latest += U4 * abs(self.latest) + TINY
            self.number, self.end = vec[i64](), vec[i64]()
        if order <= 0.0:
            self.number = append(self.number, candidate)
            self.end = append(self.end, entry.place)


def first_exactly(table: Table, found: Candidates, after: float) -> First:
    """Return the first contact among the candidates up to the limit, if nothing is rounded.

    It is the first time after a double, as long as the pieces of a candidate exist. Where a time is
    so near to the start or the end of a piece that their doubles do not decide whether the piece
    exists, the result does not hold.
    """
    first, entry = First(), Entry()
    c: i64 = -1
    while c + 1 < len(found.low):
        c += 1
        if found.low[c] > min(found.limit, first.latest):
            continue
        one, other = found.one[c], found.other[c]
        if found.edge[c] < 0 or not (is_exact(table, one) and is_exact(table, other)):
            first.holds = False
            return first
        entry.find(table, one, found.vertex[c], other, found.edge[c])
        if entry.exactly.holds and entry.place != BESIDE and entry.order(after, 1.0) > 0.0:
            begin = max(table.start[one], table.start[other])
            end = min(table.end[one], table.end[other])
            presence = entry.presence(begin, end)
            if presence == UNKNOWN:
                first.holds = False
                return first
            if presence == PRESENT:
                first.add(entry, c)
        if not entry.exactly.holds:
            first.holds = False
            return first
    return first


def is_exact(table: Table, k: i64) -> bool:
    """Return True if a piece is in straight motion, without radius, and its doubles are exact."""
    if table.kind[k] != STRAIGHT or table.radius[k] != 0.0:
        return False
    return (
        table.place_error[k] == 0.0 and table.path_error[k] == 0.0 and table.speed_error[k] == 0.0
    )
