"""Motion pieces: bodies while they move linearly, and when the boxes of two of them intersect.

A body has a piece for each piece of its motion, if all are linear and it is not large.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import Final, NamedTuple, TypeAlias, final

from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.outline import Straight, far_origin, straight_pieces
from exactpt.pairs.filters import window
from exactpt.pairs.two_pieces import ContactDistance
from exactpt.scene.scene import Scene

__all__ = [
    "MOST_VERTICES",
    "Distance",
    "FewPieces",
    "MotionPiece",
    "contact_distance",
    "linear_pieces",
    "pieces_during",
    "window_of",
]

MOST_VERTICES: Final = 64
"""Maximum number of vertices of a body for which comparing two bodies vertex by vertex pays."""


class MotionPiece(NamedTuple):
    """A body in one piece of its motion.

    Attributes:
        body: its number.
        straight: its motion.
        start, end: the piece, within the span of the search.
    """

    body: int
    straight: Straight
    start: QQ
    end: QQ


Distance: TypeAlias = "Callable[[MotionPiece, MotionPiece], ContactDistance | None]"
"""The distance at which two pieces touch; None if it is 0."""


def contact_distance(a: MotionPiece, b: MotionPiece) -> ContactDistance | None:
    """Return the distance at which the cores of two bodies touch; None if it is 0."""
    r, s = a.straight.body._radius, b.straight.body._radius
    return ContactDistance.of((r + s) ** 2, r + s) if r or s else None


def window_of(a: MotionPiece, b: MotionPiece, low: float, high: float) -> tuple[float, float]:
    """Return the `window` of the boxes of two pieces within their contact distance."""
    distance = contact_distance(a, b)
    nearest = 0.0 if distance is None else distance.nearest
    return window(a.straight, b.straight, low, high, nearest)


@final
class FewPieces:
    """The pieces of a scene of which all pairs are compared, without numpy.

    Args:
        rows: the pieces.
        start: the start of the scene.
    """

    def __init__(self, rows: Sequence[MotionPiece], start: QQ) -> None:
        self._rows = rows
        self._start = start

    def near_at_start(self) -> list[tuple[int, int]]:
        """The pairs i < j of bodies whose boxes meet at the start."""
        low, high = enclosing_floats(self._start)
        near: list[tuple[int, int]] = []
        for a, b in combinations([row for row in self._rows if row.start == self._start], 2):
            enter, leave = window_of(a, b, low, high)
            if not enter > leave:
                near.append((a.body, b.body))
        return near

    def near(self) -> Iterator[tuple[float, int, int]]:
        """All pairs of pieces of two bodies, each with a time before which they do not touch."""
        for i, j in combinations(range(len(self._rows)), 2):
            if self.body(i) != self.body(j):
                yield -math.inf, i, j

    def body(self, k: int) -> int:
        """The body of a piece."""
        return self._rows[k].body

    def __getitem__(self, k: int) -> MotionPiece:
        return self._rows[k]


def linear_pieces(scene: Scene) -> list[MotionPiece] | None:
    """The pieces of all bodies; None unless all of them move straight and are not large."""
    rows: list[MotionPiece] = []
    origin = far_origin(scene.bodies)
    for i, body in enumerate(scene.bodies):
        ask()
        if body.size > MOST_VERTICES:
            return None
        pieces = straight_pieces(body, origin=origin)
        if pieces is None:
            return None
        rows += pieces_during(i, pieces, scene._start, scene._end)
    return rows


def pieces_during(
    body: int, pieces: Sequence[tuple[Straight, QQ | None]], start: QQ, end: QQ
) -> Iterator[MotionPiece]:
    """The pieces of a body, of given pieces of motion, between two times."""
    since = start
    for straight, until in pieces:
        if until is None or until >= end:
            yield MotionPiece(body, straight, since, end)
            return
        if until > since:
            yield MotionPiece(body, straight, since, until)
            since = until
