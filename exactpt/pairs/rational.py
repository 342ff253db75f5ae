"""When vertices meet edges in straight motion, decided exactly."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.outline import Straight

__all__ = ["Candidate", "Incidence", "Meeting", "Span", "earliest", "span_of"]


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


class Incidence(NamedTuple):
    """A vertex of one body on an edge or a vertex of the other.

    Attributes:
        of_first: whether the vertex is one of the first body.
        vertex: the vertex.
        edge: the edge it lies on, or -1.
        other_vertex: the vertex it coincides with, or -1.
    """

    of_first: bool
    vertex: int
    edge: int
    other_vertex: int


class Meeting(NamedTuple):
    """The first contact of two bodies: its time and all incidences then."""

    time: QQ
    incidences: list[Incidence]


class Candidate(NamedTuple):
    """A vertex that may lie on an edge at a time in [low, high]."""

    low: float
    high: float
    of_first: bool
    vertex: int
    edge: int


def earliest(
    a: Straight, b: Straight, span: Span, candidates: Sequence[Candidate]
) -> Meeting | None:
    """The first time at which a candidate touches, exactly, and all that touch then."""
    ax, ay, avx, avy = a.line()
    bx, by, bvx, bvy = b.line()
    path = ax - bx, ay - by, avx - bvx, avy - bvy
    back = -path[0], -path[1], -path[2], -path[3]
    best: Meeting | None = None
    best_high = math.inf
    for low, _, of_first, vertex, edge in candidates:
        if low > best_high:
            break
        ask()
        met = _meeting(a, b, path, vertex, edge) if of_first else _meeting(b, a, back, vertex, edge)
        if met is None:
            continue
        time, end = met
        if not span.start < time <= span.end:
            continue
        touch = Incidence(of_first, vertex, edge if end < 0 else -1, end)
        if best is None or time < best.time:
            best, best_high = Meeting(time, [touch]), enclosing_floats(time)[1]
        elif time == best.time:
            best.incidences.append(touch)
    return best


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
