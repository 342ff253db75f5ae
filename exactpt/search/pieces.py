"""Motion pieces: bodies while they move linearly, and when the boxes of two of them intersect.

A body has a piece for each piece of its motion, if all are linear.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias, final

from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float
from exactpt.motion.outline import Straight, far_origin, straight_pieces
from exactpt.scene.scene import Scene
from exactpt.search.straight_filter import window

if TYPE_CHECKING:
    from exactpt.search.boxes import PieceBoxes

FEW: Final = 10
"""Maximum number of pieces of which all pairs are compared without numpy."""
LARGE: Final = 1 << 13
"""Product of the sizes of two bodies above which they are not compared vertex by vertex."""


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


class ContactDistance(NamedTuple):
    """The distance of two cores at which they count as touching; it is positive.

    Attributes:
        squared: its square, exactly.
        nearest: a positive double, off by at most 2 U of it and 2^-1074.
    """

    squared: QQ
    nearest: float

    @classmethod
    def of(cls, squared: QQ, root: QQ) -> ContactDistance:
        """Return the distance with a square, given its root, off by at most 2^-60 of it."""
        return cls(squared, nearest_float(root) or math.ulp(0.0))


Distance: TypeAlias = "Callable[[MotionPiece, MotionPiece], ContactDistance | None]"
"""The distance at which two pieces touch; None if it is 0."""


def contact_distance(a: MotionPiece, b: MotionPiece) -> ContactDistance | None:
    """Return the distance at which the cores of two bodies touch; None if it is 0."""
    r, s = a.straight.body.exact_radius, b.straight.body.exact_radius
    return ContactDistance.of((r + s) ** 2, r + s) if r or s else None


@final
class ScenePieces:
    """Motion pieces of bodies, of which pairs are compared.

    Args:
        pieces: the pieces, by number.
        start, end: a time span.
        pairs: the pairs to compare, by number, each with a time before which they do not touch, in
            the order of these times; or the boxes of the pieces, of which pairs are found.
    """

    def __init__(
        self,
        pieces: Sequence[MotionPiece] | Mapping[int, MotionPiece],
        start: QQ,
        end: QQ,
        pairs: Sequence[tuple[float, int, int]] | PieceBoxes,
    ) -> None:
        self._pieces = pieces
        self._start, self._end = start, end
        self._pairs = pairs

    @classmethod
    def of(
        cls, pieces: Sequence[MotionPiece], start: QQ, end: QQ, margin: float = 0.0
    ) -> ScenePieces:
        """Return the given pieces; if they are more than a few, with boxes grown by a margin."""
        if len(pieces) <= FEW:
            every = combinations(range(len(pieces)), 2)
            pairs = [(-math.inf, i, j) for i, j in every if pieces[i].body != pieces[j].body]
            return cls(pieces, start, end, pairs)
        from exactpt.search.boxes import PieceBoxes

        return cls(pieces, start, end, PieceBoxes.of(pieces, margin))

    def near_at_start(self, distance: Distance = contact_distance) -> list[tuple[int, int]]:
        """Return the pairs i < j of bodies whose boxes intersect at the start.

        Of few pieces those whose boxes are within the distance at which the pieces touch; the boxes
        of more pieces are grown by it already.
        """
        if not isinstance(self._pairs, Sequence):
            from exactpt.search.boxes import pairs_at

            return sorted(set(pairs_at(self._pairs, self._start)))
        low, high = enclosing_floats(self._start)
        two = ((self._pieces[i], self._pieces[j]) for time, i, j in self._pairs if time <= high)
        begin = [(a, b) for a, b in two if a.start == b.start == self._start]
        near = []
        for a, b in begin:
            d = distance(a, b)
            reach = 0.0 if d is None else d.nearest
            enter, leave = window(a.straight, b.straight, low, high, reach)
            if not enter > leave:
                near.append((a.body, b.body))
        return near

    def near(
        self, counts: Callable[[int, int], bool] = operator.ne
    ) -> Iterator[tuple[float, MotionPiece, MotionPiece]]:
        """Yield the pairs of pieces of two bodies that come near each other, once each.

        Each comes with a time at or before which it does, in increasing order of these times.

        Args:
            counts: whether contacts of two bodies, by number, count.
        """
        pieces, pairs = self._pieces, self._pairs
        if isinstance(pairs, Sequence):
            for enter, i, j in pairs:
                a, b = pieces[i], pieces[j]
                if counts(a.body, b.body):
                    yield enter, a, b
            return
        from exactpt.search.boxes import candidate_pairs

        body = pairs.body.tolist()
        for enter, i, j in candidate_pairs(pairs, self._start, self._end):
            if counts(body[i], body[j]):
                yield enter, pieces[i], pieces[j]


def are_large(one: int, other: int) -> bool:
    """Return True if two bodies of these numbers of vertices are not compared vertex by vertex."""
    return one * other > LARGE


def linear_pieces(scene: Scene) -> list[MotionPiece] | None:
    """Return the pieces of all bodies; None unless all of them move straight."""
    found: list[MotionPiece] = []
    origin = far_origin(scene.bodies)
    for i, body in enumerate(scene.bodies):
        check_budget()
        pieces = straight_pieces(body, origin=origin)
        if pieces is None:
            return None
        found += pieces_during(i, pieces, scene.exact_start, scene.exact_end)
    return found


def pieces_during(
    body: int, pieces: Sequence[tuple[Straight, QQ | None]], start: QQ, end: QQ
) -> Iterator[MotionPiece]:
    """Yield the pieces of a body, of given pieces of motion, between two times."""
    since = start
    for straight, until in pieces:
        if until is None or until >= end:
            yield MotionPiece(body, straight, since, end)
            return
        if until > since:
            yield MotionPiece(body, straight, since, until)
            since = until
