"""Candidates decided exactly, in the order of time.

A candidate (`exactpt.filters.candidates`) is a vertex and an edge, or two vertices, that may touch
from some time on. Whether they do, and when, is decided here: in doubles if nothing is rounded
(`exactpt.filters.exactly`), else by rationals if both bodies move straight and have no radius,
else by the roots of polynomials (`exactpt.pair.features`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias, final

from exactpt.filters.candidates import Candidate, Candidates
from exactpt.filters.exactly import first_exactly
from exactpt.filters.rows import AFFINE, STRAIGHT
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, of_double
from exactpt.motion.track import Incidence, vertex_touch
from exactpt.pair.features import FeaturePair
from exactpt.pair.straight import (
    Begin,
    Earliest,
    meeting_of_point_and_edge,
    meeting_of_points,
)
from exactpt.search.reading import NOTHING, Rows
from exactpt.search.trace import Trace

Squares: TypeAlias = "Callable[[int, int], QQ]"
"""The squared distance of the cores at which two bodies touch, by their numbers."""


@final
class Decider:
    """The earliest contact among candidates.

    Args:
        rows: the rows of all bodies.
        squares: when two bodies touch; None if where their distance is the sum of their radii. It
            is the square of the sum of what the rows have as radii, or the filters would be wrong.
        trace: what writes about decisions; None for nothing.
        exact_only: whether nothing is decided in doubles, not even if none is rounded.

    Attributes:
        best: the earliest time so far, and the incidences that begin at it.
        exact: number of the candidates that rationals or polynomials have decided.
    """

    def __init__(
        self,
        rows: Rows,
        squares: Squares | None = None,
        trace: Trace | None = None,
        *,
        exact_only: bool = False,
    ) -> None:
        self._exact_only = exact_only
        self._rows = rows
        self._squares = squares
        self._trace = trace
        self.best: Earliest[Incidence] = Earliest()
        self._high = math.inf  # a double that is at least the best time, in units of the rows
        self._low = -math.inf  # no candidate that is still to be decided begins before it
        self.exact = 0

    def decide(self, found: Candidates, until: float) -> None:
        """Decide the candidates of a slab.

        Args:
            found: the candidates.
            until: the end of the slab.
        """
        candidates = found.rows()
        if self._trace is not None:
            self._trace.filtered(candidates, found.limit, until)
        may_tie = len(candidates) > 1  # the attempt in doubles is for ties
        if self._exact_only or not may_tie or not self._decide_in_doubles(found, until):
            self._decide_one_by_one(candidates, min(found.limit, until))
        self._low = until

    def free_until(self) -> float:
        """Return a double before which no candidate so far begins, as far as it is known now."""
        best = self.best.number
        if best is None:
            return self._low
        return min(self._low, self._rows.units.enclosure(best)[0])

    def _decide_in_doubles(self, found: Candidates, until: float) -> bool:
        """Decide candidates in doubles, all at once; return False if something was rounded."""
        rows = self._rows
        span = rows.span
        is_start_double = span.low == span.after
        if not is_start_double or not rows.units.is_identity:
            return False
        first = first_exactly(rows.table, found, span.after)
        if not first.holds:
            return False
        time = None
        incidences: list[Incidence] = []
        if first.number:
            time = of_double(first.numerator) / of_double(first.denominator)
            incidences = [self._incidence(*row) for row in first.rows(found)]
            if time <= span.end and time <= of_double(until):
                self._add(time, incidences)
        if self._trace is not None:
            self._trace.in_doubles(time, incidences)
        return True

    def _add(self, time: QQ | AlgebraicNumber, incidences: Sequence[Incidence]) -> None:
        """Add a time, and what begins at it."""
        units, best = self._rows.units, self.best
        best.add(time, incidences)
        self._high = best.high
        if not units.is_identity and best.number is not None:
            self._high = units.enclosure(best.number)[1]

    def _incidence(self, one: int, vertex: int, other: int, edge: int, end: int) -> Incidence:
        """Return the incidence of a vertex inside an edge, or at its end; -1 for no end."""
        body = self._rows.table.body
        if end < 0:
            return Incidence(body[one], vertex, body[other], edge, -1)
        return vertex_touch(body[one], vertex, body[other], end)

    def _decide_one_by_one(self, candidates: Sequence[Candidate], limit: float) -> None:
        """Decide candidates exactly, in the order of their bounds, up to a time."""
        end = self._rows.span.end
        if math.isfinite(limit):
            end = min(end, self._rows.units.exact_time(limit))
        for candidate in candidates:
            self._low = candidate.low
            if candidate.low > self._high:
                return
            check_budget()
            self.exact += 1
            begins = self._first(candidate, self.best.until(end))
            if self._trace is not None:
                self._trace.candidate(candidate, begins)
            for begin in begins:
                self._add(begin.time, [begin.incidence])

    def _first(self, candidate: Candidate, until: QQ) -> list[Begin]:
        """Return when two features first touch, up to a time; nothing if they do not."""
        rows, table = self._rows, self._rows.table
        one, other = candidate.one, candidate.other
        (one_start, one_end), (other_start, other_end) = rows.spans[one], rows.spans[other]
        since = max(rows.span.start, one_start, other_start)
        until = min(until, one_end, other_end)
        if not since < until:
            return []
        squared = self._squared(table.body[one], table.body[other])
        if not squared and table.kind[one] == table.kind[other] == STRAIGHT:
            begin = self._first_of_straight(candidate, since, until)
            return [] if begin is None else [begin]
        if math.isfinite(candidate.low):  # they do not touch before it
            before = math.nextafter(candidate.low, -math.inf)
            since = max(since, rows.units.exact_time(before))
        return self._first_of_any(candidate, squared, since, until)

    def _squared(self, i: int, j: int) -> QQ:
        """Return the squared distance of the cores at which two bodies touch."""
        if self._squares is not None:
            return self._squares(i, j)
        bodies = self._rows.bodies
        if not self._rows.has_radius:
            return NOTHING
        return (bodies[i].exact_radius + bodies[j].exact_radius) ** 2

    def _first_of_straight(self, candidate: Candidate, since: QQ, until: QQ) -> Begin | None:
        """Return when a vertex first lies on an edge, by rationals; both bodies move straight."""
        rows, table = self._rows, self._rows.table
        one, other, vertex = candidate.one, candidate.other, candidate.vertex
        begin, end = rows.ends_of(other, candidate.edge)
        p, q = rows.moving_point(one, vertex), rows.moving_point(other, begin)
        z = p.x - q.x, p.y - q.y
        w = p.vx - q.vx, p.vy - q.vy
        if begin == end:
            met = meeting_of_points(z, w)
        else:
            r = rows.moving_point(other, end)
            met = meeting_of_point_and_edge(z, w, (r.x - q.x, r.y - q.y))
        if met is None or not since < met.time <= until:
            return None
        i, j = table.body[one], table.body[other]
        if met.end is None:
            return Begin(met.time, Incidence(i, vertex, j, candidate.edge, -1))
        return Begin(met.time, vertex_touch(i, vertex, j, (begin, end)[met.end]))

    def _first_of_any(self, candidate: Candidate, squared: QQ, since: QQ, until: QQ) -> list[Begin]:
        """Return when two features first have a squared distance after a time, by polynomials.

        An edge that deforms may be a point for a moment. Then a vertex that comes to it touches
        both ends, but is on no edge: so it is compared with each end, too.
        """
        if not since < until:
            return []
        other = candidate.other
        ends: tuple[int, ...] = (candidate.other_vertex,)
        if candidate.edge >= 0:
            ends = self._rows.ends_of(other, candidate.edge)
        if len(set(ends)) == 1:  # a point is an edge from its vertex to itself
            ends = ends[:1]
        choices = [ends]
        if len(ends) == 2 and not squared and self._rows.table.kind[other] >= AFFINE:
            choices += [(end,) for end in ends]
        begins = (self._first_of(candidate, some, squared, since, until) for some in choices)
        return [begin for begin in begins if begin is not None]

    def _first_of(
        self, candidate: Candidate, ends: tuple[int, ...], squared: QQ, since: QQ, until: QQ
    ) -> Begin | None:
        """Return when a vertex first has a squared distance from an edge, or a vertex."""
        rows, table = self._rows, self._rows.table
        one, other, vertex = candidate.one, candidate.other, candidate.vertex
        i, j = table.body[one], table.body[other]
        if len(ends) == 1:
            touch = of_two_vertices(i, vertex, j, ends[0])
        else:
            touch = Incidence(i, vertex, j, candidate.edge, -1)
        a = rows.bodies[i].exact_piece_after(rows.spans[one][0])
        b = rows.bodies[j].exact_piece_after(rows.spans[other][0])
        pair = FeaturePair(touch, a.track(vertex), tuple(map(b.track, ends)))
        time = pair.first_time(squared, AlgebraicNumber(since), until)
        if time is None:
            return None
        touch = pair.touch_at(time, ends)
        if touch.edge < 0:
            touch = of_two_vertices(touch.body, touch.vertex, touch.other, touch.other_vertex)
        return Begin(time, touch)


def of_two_vertices(body: int, vertex: int, other: int, other_vertex: int) -> Incidence:
    """Return the incidence of two vertices: that of the lower body, or the lower one, first."""
    if body == other:
        lower, higher = sorted((vertex, other_vertex))
        return Incidence(body, lower, body, -1, higher)
    return vertex_touch(body, vertex, other, other_vertex)
