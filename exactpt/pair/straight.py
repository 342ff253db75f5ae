"""Times at which vertices touch edges in linear motion, in rational arithmetic."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Generic, NamedTuple, TypeAlias, TypeVar

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.outline import Straight
from exactpt.motion.track import Incidence

Vector: TypeAlias = "tuple[QQ, QQ]"


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
    """Return the span between two times."""
    return Span(start, end, *enclosing_floats(start), enclosing_floats(end)[1])


class LinearContact(NamedTuple):
    """The first contact of some bodies: its time and all incidences at that time.

    Of two bodies by themselves, the first has the number 0, the second 1.
    """

    time: QQ | AlgebraicNumber
    touches: list[Incidence]

    @property
    def number(self) -> AlgebraicNumber:
        """The time."""
        return algebraic(self.time)


class Begin(NamedTuple):
    """When an incidence begins.

    Attributes:
        time: the time.
        incidence: the incidence.
    """

    time: QQ | AlgebraicNumber
    incidence: Incidence


class Candidate(NamedTuple):
    """An incidence that may begin in [low, high].

    Attributes:
        low, high: bounds of the time; perhaps infinite.
        touch: the incidence, of the bodies 0 and 1.
    """

    low: float
    high: float
    touch: Incidence


T = TypeVar("T")


class Earliest(Generic[T]):
    """The earliest of some times so far, and all that begins at that time.

    Attributes:
        time: the earliest time; None before there is one.
        high: a double at least that time.
        found: the incidences that begin at that time.
    """

    def __init__(self) -> None:
        self.time: QQ | AlgebraicNumber | None = None
        self.high: float = math.inf
        self.found: list[T] = []

    def add(self, time: QQ | AlgebraicNumber, begins: Iterable[T]) -> None:
        """Add a time, and what begins at it."""
        order = -1 if self.time is None else compare(time, self.time)
        if order < 0:
            self.time, self.found, self.high = time, [], double_above(time)
        if order <= 0:
            self.found.extend(begins)

    def until(self, end: QQ) -> QQ:
        """Return a time, at most the given one, after which none can be the earliest."""
        if isinstance(self.time, AlgebraicNumber):
            return min(end, self.time.exact_high)
        return end if self.time is None else min(end, self.time)

    @property
    def number(self) -> AlgebraicNumber | None:
        """The earliest time."""
        return None if self.time is None else algebraic(self.time)


def earliest(
    candidates: Iterable[Candidate],
    first: Callable[[Incidence, QQ], tuple[QQ | AlgebraicNumber, Incidence] | None],
    end: QQ,
) -> LinearContact | None:
    """Return the earliest time at which a candidate begins, with all incidences at that time.

    Args:
        candidates: in the order of ``low``; those after a double above the best time are not
            decided.
        first: returns the exact time of a candidate, and its incidence. It may return None
            for any time later than its second argument.
        end: the last time.
    """
    best: Earliest[Incidence] = Earliest()
    for candidate in candidates:
        if candidate.low > best.high:
            break
        check_budget()
        begins = first(candidate.touch, best.until(end))
        if begins is not None:
            best.add(begins[0], begins[1:])
    return None if best.time is None else LinearContact(best.time, best.found)


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


class Meeting(NamedTuple):
    """When a point in straight motion comes to an edge, and where.

    Attributes:
        time: the time.
        end: 0 at the first end of the edge, 1 at the second one, None between them.
    """

    time: QQ
    end: int | None


def meeting_of_point_and_edge(z: Vector, w: Vector, u: Vector) -> Meeting | None:
    """Return when the point z + w t first lies on the edge from 0 to u, which is not 0.

    Returns:
        None if it never does, or always.
    """
    (zx, zy), (wx, wy), (ux, uy) = z, w, u
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    length = ux * ux + uy * uy
    if c1:
        time = -c0 / c1
        along = (zx + wx * time) * ux + (zy + wy * time) * uy
        if along < 0 or along > length:
            return None
        return Meeting(time, 0 if along == 0 else 1 if along == length else None)
    speed = wx * ux + wy * uy
    if c0 or not speed:
        return None
    # It moves along the line of the edge, and enters at the end that it comes to first.
    end = 0 if speed > 0 else 1
    return Meeting((end * length - zx * ux - zy * uy) / speed, end)


def meeting_of_points(z: Vector, w: Vector) -> Meeting | None:
    """Return when z + w t = 0; None if never or always."""
    (zx, zy), (wx, wy) = z, w
    if zx * wy != zy * wx or not (wx or wy):
        return None
    return Meeting(-zx / wx if wx else -zy / wy, 0)


def first_incidence(
    a: Straight, b: Straight, span: Span, candidates: Sequence[Candidate]
) -> LinearContact | None:
    """Return the first contact of two bodies in (start, end], exactly, from its candidates."""
    ax, ay, avx, avy = a.line()
    bx, by, bvx, bvy = b.line()
    path = ax - bx, ay - by, avx - bvx, avy - bvy
    back = -path[0], -path[1], -path[2], -path[3]

    def first(touch: Incidence, until: QQ) -> tuple[QQ, Incidence] | None:
        moving, still, (cx, cy, wx, wy) = (b, a, back) if touch.body else (a, b, path)
        i, j = still.edges[touch.edge]
        (px, py), (qx, qy) = moving.point(touch.vertex), still.point(i)
        z, w = (px + cx - qx, py + cy - qy), (wx, wy)
        if i == j:
            met = meeting_of_points(z, w)
        else:
            rx, ry = still.point(j)
            met = meeting_of_point_and_edge(z, w, (rx - qx, ry - qy))
        if met is None or not span.start < met.time <= until:
            return None
        if met.end is None:
            return met.time, touch
        return met.time, touch._replace(edge=-1, other_vertex=(i, j)[met.end])

    return earliest(candidates, first, span.end)
