"""Certificates: the sign of an orientation or x-order just after now, and when it may fail.

The only predicates of the tilings. Floats with proven bounds are tried first
(`exactpt.certificates.coefficients`); exact arithmetic decides the rest, and
the result is the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, final

import numpy as np
from mypy_extensions import i64

from exactpt.certificates import coefficients
from exactpt.certificates.linear_vectorized import linear_orientations
from exactpt.certificates.moment import Moment, Numbered, exact_time
from exactpt.certificates.perturbation import orientation_polynomial, x_order
from exactpt.certificates.positions import Positions
from exactpt.certificates.queue import EventTime, earlier
from exactpt.certificates.reasons import reason
from exactpt.certificates.rigidity import keeps_x_order, rigid
from exactpt.filters.rounding import INFINITY, UNSURE, Answer
from exactpt.indices import Triple, VertexId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.motion.track import difference
from exactpt.motion.track import orientation_polynomial as base_orientation
from exactpt.motion.vertices import HORIZON, MOTION, OTHER_MOTION, WIDTH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from exactpt.kernel.counters import Counters
    from exactpt.kernel.doubles import Indices
    from exactpt.kernel.vectorized import Answers
    from exactpt.motion.vertex import Vertex, VertexList
    from exactpt.motion.vertices import Vertices

FEW: Final = 16
"""Number of certificates from one look at the budget to the next."""

X_ORDER: Final = VertexId(-1)
"""The third vertex of an event time that is a root of an x-order."""


@final
class Certifier:
    """Certificates of moving vertices at the current time.

    Attributes:
        all: the moving vertices, by id.
        now: the current time; ``now_low`` and ``now_high`` enclose it.
        roots_now: the event times that are now, for the functions that vanish now.
        end: the last time of interest.
        exact_only: whether the float filters are switched off.
        made: the number of certificates computed.
        skipped: the number of certificates not computed, since they cannot fail.
        zeros: the number of computed certificates that vanish now, or for all times.
        counters: the counts of decisions of the run.
        errors: bounds on the coefficients of the float enclosures, see `Enclosures`.
        positions: the positions of the vertices now, in doubles.
    """

    def __init__(self, vertices: Vertices, start: QQ, end: QQ, *, exact_only: bool) -> None:
        self._vertices = vertices
        self.all: VertexList = vertices.all
        self.end: QQ = end
        self._end_high: float = vertices.normalization.time(end)[1]
        self.exact_only: bool = exact_only
        self.made: int = 0
        self.skipped: int = 0
        self.zeros: int = 0
        self.counters: Counters = vertices.counters
        self.errors: list[float] = vertices.enclosures.errors
        self.roots_now: list[EventTime] = []
        low, high = vertices.normalization.time(start)
        self.now: EventTime = EventTime(low, high, -1, -1, -1, AlgebraicNumber(start))
        self.now_low: float = low
        self.now_high: float = high
        self.positions: Positions = Positions(vertices)
        self.positions.move_to(low, high)

    def move_to(self, time: EventTime, roots: list[EventTime]) -> None:
        """Make this the current time; the functions of which ``roots`` are roots vanish at it."""
        self.now = time
        self.now_low = time.low
        self.now_high = time.high
        self.positions.move_to(time.low, time.high)
        self.roots_now = roots

    @property
    def exact_now(self) -> AlgebraicNumber:
        """The current time as a number."""
        return self.now.exact or self.resolve(self.now)

    def moment(self, time: EventTime) -> Moment:
        """Return the time of an event, to be kept when the vertices get other motions.

        Args:
            time: of the event; its vertices still have the motions that lead up to it.
        """
        if time.exact is not None:
            return Moment(time, (), self._vertices.normalization)
        ids = (time.a, time.b) if time.c == X_ORDER else (time.a, time.b, time.c)
        vertices = [self.all[VertexId(v)] for v in ids]
        stages = tuple([(v.moving.stage, v.index) for v in vertices])
        return Moment(time, stages, self._vertices.normalization)

    def resolve(self, time: EventTime) -> AlgebraicNumber:
        """Return the exact time of an event; its enclosure is narrowed as far as doubles allow."""
        number = exact_time(time, self._numbered(time), self._vertices.normalization)
        if time is self.now:
            self.now_low, self.now_high = time.low, time.high
            self.positions.move_to(time.low, time.high)
        return number

    def _numbered(self, time: EventTime) -> tuple[Numbered, ...]:
        """Return the vertices of an event, as in `exact_time`."""
        u, v = self.all[VertexId(time.a)], self.all[VertexId(time.b)]
        if time.c == X_ORDER:
            return (u.piece, u.index), (v.piece, v.index)
        w = self.all[VertexId(time.c)]
        return (u.piece, u.index), (v.piece, v.index), (w.piece, w.index)

    def rigid(self, a: VertexId, b: VertexId, c: VertexId) -> bool:
        """Return True if three vertices keep their orientation for all times (no zero is lost)."""
        places = self._vertices.places
        m, n, o = places[WIDTH * a + MOTION], places[WIDTH * b + MOTION], places[WIDTH * c + MOTION]
        if a != c and OTHER_MOTION not in (m, n, o):
            return m == n == o and m >= 0.0
        return rigid(self._vertices.bodies, self.all[a], self.all[b], self.all[c])

    def keeps_x_order(self, a: VertexId, b: VertexId) -> bool:
        """Return True if two vertices keep the difference of their x coordinates for all times."""
        places = self._vertices.places
        m, n = places[WIDTH * a + MOTION], places[WIDTH * b + MOTION]
        if OTHER_MOTION not in (m, n):
            return m == n and m >= 0.0
        return keeps_x_order(self._vertices.bodies, self.all[a], self.all[b])

    def orientation(self, a: VertexId, b: VertexId, c: VertexId) -> tuple[int, EventTime | None]:
        """Return the sign of the orientation just after now, and its first zero later.

        The sign is 0 if the orientation is identically zero; then the time is the first at
        which two of the vertices coincide. A zero without change of sign counts, even one of
        infinitesimal copies: it may be a contact (`exactpt.certificates.incidences`).
        """
        a, b, c = least_first(a, b, c)
        s, low, high = self.filtered_orientation(a, b, c)
        if s == 0:
            s, time, _ = self.exact_orientation(a, b, c)
            return s, time
        return s, None if low == INFINITY else EventTime(low, high, a, b, c)

    def exact_orientation(
        self, a: VertexId, b: VertexId, c: VertexId
    ) -> tuple[int, EventTime | None, bool]:
        """Return the `orientation` of vertices that the filter has left open.

        Returns:
            The sign, the time, and whether it vanishes now (an identical zero does too).
        """
        return self._exact_orientation(self.all[a], self.all[b], self.all[c])

    def filtered_orientation(self, a: VertexId, b: VertexId, c: VertexId) -> Answer:
        """Count a certificate, and return the filter's result, infinite if it cannot fail.

        The least of the three ids must be the first (`least_first`).

        Returns:
            The sign just after now, and the enclosure of its first zero after now; the sign 0 if
            the filter leaves it open.
        """
        self.made += 1
        places, i, j, k = self._vertices.places, WIDTH * a, WIDTH * b, WIDTH * c
        if self.exact_only or (
            places[i + MOTION] == OTHER_MOTION
            or places[j + MOTION] == OTHER_MOTION
            or places[k + MOTION] == OTHER_MOTION
        ):
            answer = self._any_orientation(a, b, c)
        else:
            horizon = self._end_high
            high = places[i + HORIZON]
            horizon = min(horizon, high)
            high = places[j + HORIZON]
            horizon = min(horizon, high)
            high = places[k + HORIZON]
            horizon = min(horizon, high)
            answer = coefficients.linear_orientation(
                places,
                i,
                j,
                k,
                self.errors,
                self.now_low,
                self.now_high,
                horizon,
                self.vanishes_now(a, b, c),
            )
        if answer[0] != 0:
            self.counters.filtered += 1
        return answer

    def _any_orientation(self, a: VertexId, b: VertexId, c: VertexId) -> Answer:
        """Return the filter's result for vertices of any motion, see `filtered_orientation`."""
        every = self.all
        va, vb, vc = every[a], every[b], every[c]
        if self.exact_only or va.is_copy_of(vb) or vb.is_copy_of(vc) or va.is_copy_of(vc):
            return UNSURE
        horizon = min(self._horizon(a, b), self._vertices.places[WIDTH * c + HORIZON])
        answer = self.filter_orientation(a, b, c, horizon, self.vanishes_now(a, b, c))
        return answer if answer[1] <= horizon else (answer[0], INFINITY, INFINITY)

    def filter_orientation(
        self,
        a: VertexId,
        b: VertexId,
        c: VertexId,
        horizon: float,
        vanishes: bool,  # noqa: FBT001 - positional for speed
    ) -> Answer:
        """Return the filter's result for three vertices, no copies of one another."""
        places, i, j, k = self._vertices.places, WIDTH * a, WIDTH * b, WIDTH * c
        low, high, errors = self.now_low, self.now_high, self.errors
        if (
            places[i + MOTION] == OTHER_MOTION
            or places[j + MOTION] == OTHER_MOTION
            or places[k + MOTION] == OTHER_MOTION
        ):
            u, v, w = self.all[a].float_track, self.all[b].float_track, self.all[c].float_track
            return coefficients.orientation(u, v, w, errors, low, high, horizon, vanishes)
        return coefficients.linear_orientation(
            places, i, j, k, errors, low, high, horizon, vanishes
        )

    def filter_x_difference(
        self,
        a: VertexId,
        b: VertexId,
        horizon: float,
        vanishes: bool,  # noqa: FBT001 - positional for speed
    ) -> Answer:
        """Return the filter's result for x(b) - x(a) of two vertices, no copies of one."""
        places, i, j = self._vertices.places, WIDTH * a, WIDTH * b
        low, high, errors = self.now_low, self.now_high, self.errors
        if places[i + MOTION] == OTHER_MOTION or places[j + MOTION] == OTHER_MOTION:
            u, v = self.all[a].float_track, self.all[b].float_track
            return coefficients.x_difference(u, v, errors, low, high, horizon, vanishes)
        return coefficients.linear_x_difference(places, i, j, errors, low, high, horizon, vanishes)

    def orientations(self, ids: Indices) -> Answers:
        """Return the results of `filtered_orientation` for rows of three ids, in numpy.

        Only those are counted that are not left open, with sign 0. Nothing may vanish now, and
        the filters must be on.
        """
        answers = linear_orientations(
            self._vertices, ids, self.now_low, self.now_high, self._end_high
        )
        decided = int(np.count_nonzero(answers.signs))
        self.made += decided
        self.counters.filtered += decided
        return answers

    def orientations_of_any(self, triples: Sequence[Triple]) -> list[tuple[int, EventTime | None]]:
        """Return the `orientation` of each triple."""
        answers: list[tuple[int, EventTime | None]] = []
        for a, b, c in triples:
            if len(answers) % FEW == 0:
                check_budget()
            answers.append(self.orientation(a, b, c))
        return answers

    def vanishes_now(self, a: VertexId, b: VertexId, c: VertexId) -> bool:
        """Return True if the function of these vertices is known to vanish now."""
        for time in self.roots_now:
            i, j, k = time.a, time.b, time.c
            if a in (i, j, k) and b in (i, j, k) and c in (i, j, k):
                return True
        return False

    def _horizon(self, a: VertexId, b: VertexId) -> float:
        """Return an upper bound of the time until which the motions of two vertices are known."""
        places = self._vertices.places
        return min(self._end_high, places[WIDTH * a + HORIZON], places[WIDTH * b + HORIZON])

    def _until(self, *vertices: Vertex) -> QQ:
        until = self.end
        for v in vertices:
            end = self._vertices.bodies[v.body].until
            if end is not None and end < until:
                until = end
        return until

    def _exact_orientation(
        self, a: Vertex, b: Vertex, c: Vertex
    ) -> tuple[int, EventTime | None, bool]:
        f = base_orientation(a.track, b.track, c.track)
        until, now = self._until(a, b, c), self.exact_now
        s = now.sign_of(f) if f else 0
        why = reason(a, b, c, is_zero=s == 0, exact_only=self.exact_only)
        self.counters.count_exact("certificate", why)
        self.zeros += s == 0
        if f:
            after = s or now.sign_after(f)
            return after, self._first_root(f, until, a.id, b.id, c.id), s == 0
        meeting = self.first_coincidence(a.id, b.id, c.id)
        f = orientation_polynomial(a, b, c)
        if not f:
            return 0, meeting, True
        root = self._first_root(f, until, a.id, b.id, c.id)
        return now.sign_after(f), earlier(meeting, root), True

    def _first_root(
        self, f: IntPoly, until: QQ, a: VertexId, b: VertexId, c: VertexId
    ) -> EventTime | None:
        root = next(roots_after(f, self.exact_now, until), None)
        if root is None:
            return None
        return self._event_time(root.time, (a, b, c), crossing=root.crossing)

    def first_coincidence(self, *ids: VertexId) -> EventTime | None:
        """Return the first time at which two of these vertices, collinear for all times, coincide.

        Two that share a motion keep their distance; it is not 0, or the scene would begin
        with a contact.
        """
        first: AlgebraicNumber | None = None
        vertices = list({(self.all[v].body, self.all[v].index): self.all[v] for v in ids}.values())
        until = self._until(*vertices)
        for i, u in enumerate(vertices):
            for v in vertices[:i]:
                if u.float_track.motion == v.float_track.motion and u.float_track.motion >= 0:
                    continue
                p, q = u.track, v.track
                dx, dy = difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)
                root = next(common_roots(dx, dy, self.exact_now, until), None)
                if root is not None and (first is None or root.time.compare(first) < 0):
                    first = root.time
        if first is None:
            return None
        return self._event_time(first, (ids[0], ids[1], ids[-1]), crossing=False)

    def _event_time(
        self, number: AlgebraicNumber, key: tuple[i64, i64, i64], *, crossing: bool
    ) -> EventTime:
        low, high = self._vertices.normalization.enclosure(number)
        return EventTime(low, high, *key, number, crossing)

    def x_order(
        self, a: VertexId, b: VertexId, *, touching: bool = False
    ) -> tuple[int, EventTime | None]:
        """1 if a is left of b just after now, else -1; and the time at which that ends.

        With ``touching``, a time at which the two have equal x without passing counts too.
        Otherwise it does not: the tiling is the same just before and just after it
        (`exactpt.certificates.perturbation`), and contacts are found by angles alone
        (`exactpt.certificates.incidences`).
        """
        s, low, high = self.filtered_x_order(a, b)
        if s == 0:
            return self.exact_x_order(a, b, touching=touching)
        return s, None if low == INFINITY else EventTime(low, high, a, b, X_ORDER)

    def exact_x_order(
        self, a: VertexId, b: VertexId, *, touching: bool = False
    ) -> tuple[int, EventTime | None]:
        """Return the `x_order` of vertices that the filter has left open."""
        return self._exact_x_order(self.all[a], self.all[b], touching=touching)

    def filtered_x_order(self, a: VertexId, b: VertexId) -> Answer:
        """Count a certificate, and return the filter's result, as `filtered_orientation`."""
        self.made += 1
        places = self._vertices.places
        is_other = OTHER_MOTION in (places[WIDTH * a + MOTION], places[WIDTH * b + MOTION])
        if self.exact_only or (is_other and self.all[a].is_copy_of(self.all[b])):
            return UNSURE
        horizon = self._horizon(a, b)
        s, low, high = self.filter_x_difference(a, b, horizon, self.vanishes_now(a, b, X_ORDER))
        if s != 0:
            self.counters.filtered += 1
        return (s, low, high) if low <= horizon else (s, INFINITY, INFINITY)

    def _exact_x_order(
        self, a: Vertex, b: Vertex, *, touching: bool
    ) -> tuple[int, EventTime | None]:
        f, now = x_order(a, b), self.exact_now
        s = now.sign_of(f) if f else 0
        why = reason(a, b, is_zero=s == 0, exact_only=self.exact_only)
        self.counters.count_exact("certificate", why)
        roots = roots_after(f, now, self._until(a, b))
        root = next((r for r in roots if touching or r.crossing), None)
        time = (
            None
            if root is None
            else self._event_time(root.time, (a.id, b.id, X_ORDER), crossing=root.crossing)
        )
        return s or now.sign_after(f), time


def least_first(a: VertexId, b: VertexId, c: VertexId) -> Triple:
    """Three vertices rotated, which keeps their orientation, so that the least is the first.

    So a filter gives the same enclosure for a zero of whatever certificates have the three.
    """
    if b < a and b < c:
        return b, c, a
    if c < a and c < b:
        return c, a, b
    return a, b, c
