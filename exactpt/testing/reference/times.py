"""The times at which something about two moving bodies can change, and what holds between them.

A predicate that is made of signs of polynomials is constant between two neighbouring roots of all
of them. So it is decided at each root, and at one rational time between any two.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cmp_to_key
from itertools import pairwise
from typing import NamedTuple, Protocol, TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.track import Track


class Instant(Protocol):
    """A time at which signs of polynomials are known: an `AlgebraicNumber`, or another judge."""

    def sign_of(self, f: IntPoly, /) -> int:
        """Return -1, 0 or 1."""


Tracks: TypeAlias = tuple[Track, ...]
"""The trajectories of all vertices of a body during one piece of its motion."""

Interval: TypeAlias = tuple[AlgebraicNumber, AlgebraicNumber]
"""A closed interval of time."""

Predicate: TypeAlias = Callable[[Instant, Tracks, Tracks], bool]
"""Whether something holds for two bodies with these trajectories at a time."""

Polynomials: TypeAlias = Callable[[Tracks, Tracks], Iterable[IntPoly]]
"""The polynomials without whose roots a predicate does not change."""


class Piece(NamedTuple):
    """A part of the time span in which neither of two bodies changes its motion.

    Attributes:
        begin, end: its first and its last time.
        first, second: the trajectories of the two bodies.
    """

    begin: QQ
    end: QQ
    first: Tracks
    second: Tracks


class State(NamedTuple):
    """What holds at a time, or at all times between two neighbours.

    Attributes:
        time: the time; None between its neighbours in the list.
        holds: whether the predicate is true.
    """

    time: AlgebraicNumber | None
    holds: bool


def pieces(a: Body, b: Body, start: QQ, end: QQ) -> Iterator[Piece]:
    """Yield the parts of the time span from one change of a motion to the next, in order."""
    changes = {t for body in (a, b) for t in body.exact_breakpoints_between(start, end)}
    for begin, until in pairwise([start, *sorted(changes), end]):
        yield Piece(begin, until, *tracks_after(a, b, begin))


def tracks_after(a: Body, b: Body, t: QQ) -> tuple[Tracks, Tracks]:
    """Return the trajectories just after a time."""
    return a.exact_piece_after(t).tracks, b.exact_piece_after(t).tracks


def tracks_before(body: Body, time: AlgebraicNumber, start: QQ) -> Tracks:
    """Return the trajectories just before a time; at the start of the scene just after it."""
    since = body.exact_last_breakpoint(time, start, before=True)
    return body.exact_piece_after(since).tracks


def roots_in(f: IntPoly, begin: QQ, until: QQ) -> list[AlgebraicNumber]:
    """Return the distinct roots in (begin, until], in order; none of zero."""
    return [root.time for root in roots_after(f, AlgebraicNumber(begin), until)] if f else []


def critical_times(polynomials: Iterable[IntPoly], begin: QQ, until: QQ) -> list[AlgebraicNumber]:
    """Return the distinct roots in (begin, until] of any of the polynomials, and the end."""
    found = [AlgebraicNumber(until)]
    for f in polynomials:
        found += roots_in(f, begin, until)
    found.sort(key=cmp_to_key(AlgebraicNumber.compare))
    return [t for k, t in enumerate(found) if k == 0 or found[k - 1].compare(t) < 0]


def states(
    a: Body, b: Body, start: QQ, end: QQ, predicate: Predicate, polynomials: Polynomials
) -> Iterator[State]:
    """Yield what holds at the start, and between and at all later critical times, in order."""
    last = AlgebraicNumber(start)
    yield State(last, predicate(last, *tracks_after(a, b, start)))
    for piece in pieces(a, b, start, end):
        p, q = piece.first, piece.second
        for time in critical_times(polynomials(p, q), piece.begin, piece.end):
            middle = AlgebraicNumber(rational_between(last, time))
            yield State(None, predicate(middle, p, q))
            yield State(time, predicate(time, p, q))
            last = time


def intervals_of(found: Iterable[State]) -> list[Interval]:
    """Return the maximal closed intervals in which something holds that is closed in time."""
    intervals: list[Interval] = []
    since: AlgebraicNumber | None = None
    last: AlgebraicNumber | None = None
    for state in [*found, State(None, holds=False)]:
        if state.time is not None and state.holds:
            since = since or state.time
            last = state.time
        elif state.time is None and not state.holds and since is not None and last is not None:
            intervals.append((since, last))
            since = None
    return intervals
