"""When vertices meet edges in straight motion, decided exactly."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, TypeVar

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Straight

__all__ = [
    "Candidate",
    "Meeting",
    "Span",
    "algebraic",
    "compare",
    "double_above",
    "earliest",
    "first_incidence",
    "span_of",
    "touch_of",
]


class Span(NamedTuple):
    """A closed span of time, and doubles that enclose its start and its end.

    Attributes:
        start, end: the span.
        low, after: doubles with low <= start <= after.
        high: a double with end <= high.
    """

    start: QQ
    end: QQ
    low: float
    after: float
    high: float


def span_of(start: QQ, end: QQ) -> Span:
    """The span between two times."""
    return Span(start, end, *enclosing_floats(start), enclosing_floats(end)[1])


class Meeting(NamedTuple):
    """The first contact of some bodies: its time and all incidences at that time.

    Of two bodies by themselves, the first has the number 0, the second 1.
    """

    time: QQ | AlgebraicNumber
    touches: list[Touch]

    @property
    def number(self) -> AlgebraicNumber:
        """The time."""
        return algebraic(self.time)


class Candidate(NamedTuple):
    """An incidence that may begin in [low, high].

    Attributes:
        low, high: bounds of the time; perhaps infinite.
        of_first: whether the vertex is one of the first body.
        vertex: the vertex.
        edge: the edge of the other body, or -1.
        end: the vertex of the other body instead of an edge, or -1.
    """

    low: float
    high: float
    of_first: bool
    vertex: int
    edge: int
    end: int = -1


def touch_of(candidate: Candidate, edge: int, end: int) -> Touch:
    """The incidence of the vertex of a candidate with an edge or a vertex."""
    one, other = (0, 1) if candidate.of_first else (1, 0)
    return Touch(one, candidate.vertex, other, edge, end)


Time = TypeVar("Time", QQ, AlgebraicNumber)


def earliest(
    candidates: Iterable[Candidate],
    first: Callable[[Candidate, Time | None], tuple[Time, Touch | None] | None],
) -> Meeting | None:
    """Return the earliest time at which a candidate begins, with all incidences at that time.

    Args:
        candidates: in the order of ``low``; those after a double above the best time are not
            decided.
        first: returns the exact time of a candidate, and the incidence if it is to be reported.
            It may return None for any time later than the best one so far, its argument.
    """
    best: Time | None = None
    found: list[Touch] = []
    high = math.inf
    for candidate in candidates:
        if candidate.low > high:
            break
        ask()
        begins = first(candidate, best)
        if begins is None:
            continue
        time, incidence = begins
        if best is None or time < best:
            best, found, high = time, [], double_above(time)
        if time == best and incidence is not None:
            found.append(incidence)
    return None if best is None else Meeting(best, found)


def algebraic(time: QQ | AlgebraicNumber) -> AlgebraicNumber:
    """Return a time as an algebraic number."""
    return time if isinstance(time, AlgebraicNumber) else AlgebraicNumber(time)


def compare(s: QQ | AlgebraicNumber, t: QQ | AlgebraicNumber) -> int:
    """Return -1, 0 or 1: the sign of s - t."""
    if isinstance(s, AlgebraicNumber) or isinstance(t, AlgebraicNumber):
        return algebraic(s).compare(algebraic(t))
    return (s > t) - (s < t)


def double_above(time: QQ | AlgebraicNumber) -> float:
    """Return a double that is at least a time."""
    if isinstance(time, AlgebraicNumber):
        return time.enclosure()[1]
    return enclosing_floats(time)[1]


def first_incidence(
    a: Straight, b: Straight, span: Span, candidates: Sequence[Candidate]
) -> Meeting | None:
    """Return the first contact of two bodies in (start, end], exactly, from its candidates."""
    ax, ay, avx, avy = a.line()
    bx, by, bvx, bvy = b.line()
    path = ax - bx, ay - by, avx - bvx, avy - bvy
    back = -path[0], -path[1], -path[2], -path[3]

    def first(candidate: Candidate, _: QQ | None) -> tuple[QQ, Touch] | None:
        of_first, vertex, edge = candidate[2:5]
        met = _meeting(a, b, path, vertex, edge) if of_first else _meeting(b, a, back, vertex, edge)
        if met is None or not span.start < met[0] <= span.end:
            return None
        time, end = met
        return time, touch_of(candidate, edge if end < 0 else -1, end)

    return earliest(candidates, first)


def _meeting(
    a: Straight, b: Straight, path: tuple[QQ, QQ, QQ, QQ], vertex: int, edge: int
) -> tuple[QQ, int] | None:
    """When a vertex of a, moving relative to b, first lies on an edge of b: exactly.

    Returns:
        The time, and the end of the edge that it meets, or -1; None if it never lies on the
        edge, or always.
    """
    cx, cy, wx, wy = path
    i, j = b.edges[edge]
    (px, py), (qx, qy) = a.point(vertex), b.point(i)
    zx, zy = px + cx - qx, py + cy - qy
    if i == j:
        return _passing(zx, zy, wx, wy, i)
    rx, ry = b.point(j)
    ux, uy = rx - qx, ry - qy
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    length = ux * ux + uy * uy
    if c1:
        time = -c0 / c1
        along = (zx + wx * time) * ux + (zy + wy * time) * uy
        if along < 0 or along > length:
            return None
        return time, i if along == 0 else j if along == length else -1
    speed = wx * ux + wy * uy
    if c0 or not speed:
        return None
    # It moves along the line of the edge, and enters at the end that it comes to first.
    target = QQ(0) if speed > 0 else length
    return (target - zx * ux - zy * uy) / speed, i if speed > 0 else j


def _passing(zx: QQ, zy: QQ, wx: QQ, wy: QQ, point: int) -> tuple[QQ, int] | None:
    """When z + w t = 0, with the point that is met."""
    if zx * wy != zy * wx or not (wx or wy):
        return None
    return (-zx / wx if wx else -zy / wy), point
