"""Broad phase for linear motion: candidate pairs from swept boxes in numpy, slab by slab of time.

It is conservative: a pair that is not reported does not touch; a reported pair may or may not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Final, final

import numpy as np

from exactpt.filters.rounding import SLACK, TINY
from exactpt.geometry.boxes import Boxes, grown, overlapping_pairs, widen_unknown
from exactpt.geometry.moving_boxes import moving_pairs
from exactpt.kernel.doubles import Floats, Indices, middles
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.body import Body
from exactpt.motion.outline import Outline, Straight
from exactpt.motion.slabs import Near, Slab, slabs
from exactpt.search.oriented import CHUNK, K, OrientedBoxes, times_between

if TYPE_CHECKING:
    from exactpt.search.pieces import MotionPiece


PIECES: Final = 4
"""Maximum number of pieces of motion of a body, on average, in the first slab."""

FEW_SLABS: Final = 8
"""After so many slabs, and twice, four times as many, a tree is tried for the rest of the span."""


@final
class PieceBoxes:
    """Boxes of motion pieces: of the shape at rest, with the motion c + v t during [start, end].

    They contain all points within the radius of a body.

    Args:
        body: the number of the body of each piece.
        numbers: shape (n, 13): the box of the shape at rest, c, v, at least the radius, bounds on
            the errors of c and of v, and the start and the end of the piece, rounded outward.
        outline: the vertices of a piece, of which oriented boxes are made on demand.

    Attributes:
        body: as given.
        drift: the median of the velocities.
    """

    @np.errstate(all="ignore")
    def __init__(self, body: Indices, numbers: Floats, outline: Callable[[int], Outline]) -> None:
        self.body = body
        self._numbers = numbers
        boxes, self._c, self._v = numbers[:, :4], numbers[:, 4:6], numbers[:, 6:8]
        self._reach, self._c_error, self._v_error, self._start, self._end = numbers[:, 8:].T.copy()
        boxes = grown(boxes, self._reach[:, None]) if self._reach.any() else boxes
        self._low, self._high = boxes[:, ::2], boxes[:, 1::2]
        self.drift: Floats = middles(self._v) if len(body) else np.zeros(2)
        self._outline = outline
        self._oriented: OrientedBoxes | None = None

    @classmethod
    def of(cls, pieces: Sequence[MotionPiece], margin: float = 0.0) -> PieceBoxes:
        """Return the boxes of some pieces, grown by a margin on each side."""
        numbers = [
            (*_numbers(piece.straight, margin), *_around(piece.start, piece.end))
            for piece in pieces
        ]
        body = np.array([piece.body for piece in pieces], dtype=np.int64)
        return cls(body, np.array(numbers).reshape(-1, 13), lambda k: pieces[k].straight.shape)

    def __len__(self) -> int:
        return len(self.body)

    def joined(self, other: PieceBoxes) -> PieceBoxes:
        """Return the boxes of these pieces, and then of others."""
        n, first, second = len(self), self._outline, other._outline
        return PieceBoxes(
            np.concatenate((self.body, other.body)),
            np.concatenate((self._numbers, other._numbers)),
            lambda k: first(k) if k < n else second(k - n),
        )

    @np.errstate(all="ignore")
    def during(self, low: float, high: float) -> tuple[Indices, Boxes]:
        """Return the pieces that last during a part of [low, high], and boxes of them in that part.

        Boxes are relative to the drift. A displacement c + (v - drift) t is off by at most
        c_error + v_error |t|, the rounding of its terms, and U |v - drift| |t|.
        """
        active = np.nonzero((self._start <= high) & (self._end >= low))[0]
        first = np.maximum(self._start[active], low)[:, None]
        last = np.minimum(self._end[active], high)[:, None]
        c, v = self._c[active], self._v[active] - self.drift
        reach = np.maximum(np.abs(first), np.abs(last))
        least, most = self._low[active], self._high[active]
        off = self._c_error[active][:, None] + self._v_error[active][:, None] * reach
        sizes = np.abs(c) + np.abs(v) * reach + np.abs(least) + np.abs(most)
        margin = (off + K * sizes) * SLACK + TINY
        begin, end = c + v * first, c + v * last
        boxes = np.empty((len(active), 4))
        boxes[:, ::2] = least + np.minimum(begin, end) - margin
        boxes[:, 1::2] = most + np.maximum(begin, end) + margin
        widen_unknown(boxes)
        return active, boxes

    def meeting_on_the_way(self, low: float, high: float, many: int) -> Near | None:
        """Return the pairs of pieces whose moving boxes intersect during [low, high].

        None if there are too many, or if a piece lasts only during a part of [low, high].
        """
        lasting = (self._start <= low) & (self._end >= high)
        if not lasting.sum() == ((self._start <= high) & (self._end >= low)).sum() > 0:
            return None
        (active, begin), (_, end) = self.during(low, low), self.during(high, high)
        found = moving_pairs(begin, end, many)
        return None if found is None else (active[found[0]], active[found[1]])

    @np.errstate(all="ignore")
    def windows(self, i: Indices, j: Indices, low: float, high: float) -> tuple[Floats, Floats]:
        """Return bounds of the times in [low, high] at which the boxes of two pieces intersect.

        The bounds of `exactpt.search.straight_filter.window`; the first is larger than the second
        if they do not intersect.
        """
        n = len(i)
        first, last = np.full(n, low), np.full(n, high)
        for k in range(0, n, CHUNK):
            some = slice(k, k + CHUNK)
            self._narrow(i[some], j[some], first[some], last[some])
        return first, last

    def _narrow(self, i: Indices, j: Indices, low: Floats, high: Floats) -> None:
        """Narrow times to those at which the boxes of two pieces intersect, in place."""
        # fmax and fmin take the other number instead of a NaN, which excludes no time.
        for start, end in ((self._start[i], self._end[i]), (self._start[j], self._end[j])):
            np.fmax(low, start, out=low)
            np.fmin(high, end, out=high)
        reach = np.maximum(np.abs(low), np.abs(high))
        off = self._c_error[i] + self._c_error[j] + (self._v_error[i] + self._v_error[j]) * reach
        bounds = zip(self._c.T, self._v.T, self._low.T, self._high.T, strict=True)
        for c, v, least, most in bounds:
            z, w = c[i] - c[j], v[i] - v[j]
            begin, end = least[j] - most[i], most[j] - least[i]
            size = np.abs(z)
            margin = 2.0 * ((off + K * (size + np.abs(w) * reach)) * SLACK + TINY)
            margin += K * (size + np.abs(begin) + np.abs(end))
            enter, leave = times_between(begin - margin - z, end + margin - z, w)
            np.fmax(low, enter, out=low)
            np.fmin(high, leave, out=high)

    def narrow(self, i: Indices, j: Indices, low: Floats, high: Floats) -> None:
        """Narrow bounds of the times at which two pieces touch by oriented boxes, in place."""
        if self._oriented is None:
            motions = (*self._c.T, *self._v.T, self._c_error, self._v_error, self._reach)
            outlines = [self._outline(k) for k in range(len(self))]
            self._oriented = OrientedBoxes(outlines, np.array(motions))
        self._oriented.narrow(i, j, low, high)

    @np.errstate(all="ignore")
    def stride(self, now: float) -> float:
        """Return the time in which pieces move by their mean distance, on average: an estimate.

        Infinite if none moves relative to the drift; perhaps NaN.
        """
        there = 0.5 * (self._low + self._high) + self._c + self._v * now
        gap = np.hypot(*np.ptp(there, axis=0)) / np.sqrt(len(there))
        return float(gap / np.hypot(*(self._v - self.drift).T).mean())


def _numbers(s: Straight, margin: float) -> tuple[float, ...]:
    """Return the box of a shape, its motion, its reach, and bounds on the errors of c and v."""
    shape, reach = s.shape, margin + radius_above(s.body)
    box = shape.low_x, shape.high_x, shape.low_y, shape.high_y
    reach = math.nextafter(reach, math.inf) if reach else 0.0
    return (*box, s.cx, s.cy, s.vx, s.vy, reach, s.c_error + shape.error, s.v_error)


def radius_above(body: Body) -> float:
    """Return a double that is at least the radius of a body; 0 only if that is 0."""
    return enclosing_floats(body.exact_radius)[1] if body.exact_radius else 0.0


def pairs_at(boxes: PieceBoxes, time: QQ) -> list[tuple[int, int]]:
    """Return the pairs i < j of bodies, each with one piece, whose boxes intersect at a time."""
    low, high = enclosing_floats(time)
    first, second = _meeting(boxes, low, high)
    if len(first) > 8 * len(boxes) + 64:
        lows, highs = np.full(len(first), low), np.full(len(first), high)
        boxes.narrow(first, second, lows, highs)
        near = lows <= highs
        first, second = first[near], second[near]
    pairs = np.sort(np.stack((boxes.body[first], boxes.body[second]), axis=1), axis=1)
    return [(i, j) for i, j in pairs.tolist() if i < j]


def candidate_pairs(boxes: PieceBoxes, start: QQ, end: QQ) -> Iterator[tuple[float, int, int]]:
    """Yield the candidate pairs of pieces of different bodies, by number, once each.

    Each comes with a time at or before which it does, in increasing order of these times.
    """
    span, bodies = end - start, len(set(boxes.body.tolist()))
    first = min(span, PIECES * span * bodies / len(boxes))
    stride = 4.0 * boxes.stride(enclosing_floats(start)[0])
    if 0.0 < stride < np.inf:
        first = min(first, QQ(stride))
    many, seen = 8 * bodies + 64, set[tuple[int, int]]()
    for now, later, found in _slabs(boxes, (start, end), many, first):
        i, j = np.stack(found)[:, boxes.body[found[0]] != boxes.body[found[1]]]
        enter, leave = boxes.windows(i, j, *_around(now, later))
        meets = enter <= leave
        if meets.sum() > many:
            boxes.narrow(i, j, enter, leave)
            meets = enter <= leave
        pairs = zip(*(column[meets].tolist() for column in (enter, i, j)), strict=True)
        for time, k, l in sorted(pairs):
            if (k, l) not in seen:
                seen.add((k, l))
                yield time, k, l


def _slabs(boxes: PieceBoxes, span: tuple[QQ, QQ], many: int, first: QQ) -> Iterator[Slab]:
    """Yield slabs of time; the last is the rest of the span, if possible."""

    def between(now: QQ, later: QQ) -> Slab:
        return Slab(now, later, _meeting(boxes, *_around(now, later)))

    start, end = span
    for count, slab in enumerate(slabs(start, end, between, many, first, end - start), 1):
        yield slab
        if count >= FEW_SLABS and count & (count - 1) == 0 and slab.end < end:
            rest = boxes.meeting_on_the_way(*_around(slab.end, end), many)
            if rest is not None:
                yield Slab(slab.end, end, rest)
                return


def _around(now: QQ, later: QQ) -> tuple[float, float]:
    return enclosing_floats(now)[0], enclosing_floats(later)[1]


def _meeting(boxes: PieceBoxes, low: float, high: float) -> Near:
    """Return the pairs of pieces whose boxes intersect during [low, high]."""
    active, places = boxes.during(low, high)
    i, j = zip(*overlapping_pairs(places), strict=True)
    return active[np.concatenate(i)], active[np.concatenate(j)]
