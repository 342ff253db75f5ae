"""Moving lines between whole bodies: of few, lists find them in less time than arrays."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import accumulate
from math import ceil, cos, log2, pi, sin
from typing import Final, TypeAlias, final

import numpy as np

from exactpt.kernel.doubles import Floats
from exactpt.proof.frame import Cut, Frame
from exactpt.proof.paths import DIRECTIONS, Plane

MOST: Final = 48
"""Number of bodies up to which whole ones are tried first."""
CLEAR: Final = 1e-6
"""Smallest gap between whole bodies, relative to the extent of all: doubles decide of it."""
AT_REST: Final = 0.25
"""Part of the gap of a moving line from which on a gap is enough for a line at rest."""

VECTORS: Final = 10_000
"""Number of vectors between vertices of two groups up to which all are looked at."""
UNCERTAIN: Final = 1e-12
"""Of a smaller angle between such vectors the sign is not taken: a proposal needs no proof."""

USUAL: Final = DIRECTIONS.tolist()

Ends: TypeAlias = tuple[tuple[float, float], tuple[float, float]]
Found: TypeAlias = tuple[float, Cut, set[int], Ends]
"""The worth of a line, the line, the bodies below it, and the extents on both of its sides."""


@final
class WholeBodies:
    """The bodies of a frame, in their order along each of the usual directions.

    Args:
        frame: the items. Of a body with some of its items in a node, all in the frame count.
        groups: a number for each body; bodies with equal ones do not count as a pair.
    """

    def __init__(self, frame: Frame, groups: Sequence[int]) -> None:
        self._frame, self._bodies, self._groups = frame, frame.bodies, groups
        self._group = [groups[i] for i in frame.bodies]
        self._are_grouped = len({*self._group}) < len(self._group)
        low, high = frame.body_extents()
        middles = (low + high).sum(axis=0, keepdims=True)
        self._order = [*range(len(DIRECTIONS))]  # the directions of the last lines first
        self._extents = np.concatenate([low, high, middles]).transpose(2, 0, 1).tolist()

    def cut(self, present: Collection[int]) -> tuple[Plane, set[int]] | None:
        """Return a line between some of these bodies, which are below it, and all others.

        None if there is none in the usual directions with enough room, nor between two groups.
        """
        best: Found | None = None
        at = 0
        rows = [self._frame.row_of[i] for i in present]
        for j in self._order:
            found = self._best(j, rows)
            if found is not None and (best is None or found[0] > best[0]):
                best, at = found, j
                if best[0] >= 0.5:
                    break
        if best is None:
            best = self._between_two(present)
        else:
            self._order.insert(0, self._order.pop(self._order.index(at)))
        if best is None:
            return None
        _, cut, below, ends = best
        plane, is_straight = self._frame.plane(cut), self._frame.is_straight
        certain = (
            self._frame.is_between(plane, *ends)
            if is_straight
            else self._frame.separates(plane, below, present)
        )
        return (plane, below) if certain else None

    def _best(self, j: int, rows: Sequence[int]) -> Found | None:
        """Return the line of most worth in a direction, with the bodies below it."""
        lows, low_ends, highs, high_ends, middles = self._extents[j]
        rows = sorted(rows, key=middles.__getitem__)
        count, i, k = len(rows), rows[0], rows[-1]
        if count == 2 and (highs[i] >= lows[k] or high_ends[i] >= low_ends[k]):
            return None  # half of all nodes have two bodies
        before = [*accumulate([highs[k] for k in rows], max)]
        before_end = [*accumulate([high_ends[k] for k in rows], max)]
        rows.reverse()
        after = [*accumulate([lows[k] for k in rows], min)]
        after_end = [*accumulate([low_ends[k] for k in rows], min)]
        size = max(before[-1], before_end[-1]) - min(after[-1], after_end[-1])
        best, at, rests = 0.0, 0, False
        after.reverse()
        after_end.reverse()
        places = zip(before, before_end, after[1:], after_end[1:], strict=False)
        for i, (a, b, c, d) in enumerate(places, 1):
            if c - a > CLEAR * size and d - b > CLEAR * size:
                gap = min(c - a, d - b)
                rest = min(c, d) - max(a, b) > AT_REST * gap
                worth = min(i, count - i) / count + 0.2 * rest + 0.3 * min(gap / size, 0.3)
                if self._are_grouped:
                    worth += 0.4 * self._is_leaf(rows[-i:]) + 0.4 * self._is_leaf(rows[:-i])
                if worth > best:
                    best, at, rests = worth, i, rest
        if not at:
            return None
        a, b, c, d = before[at - 1], before_end[at - 1], after[at], after_end[at]
        if rests:
            a = b = max(a, b)
            c = d = min(c, d)
        x, y = USUAL[j]
        return (
            best,
            self._frame.cut(best, (x, y), ((a + c) / 2, (b + d) / 2), min(c - a, d - b)),
            {self._bodies[k] for k in rows[-at:]},
            ((a, b), (c, d)),
        )

    def _between_two(self, present: Collection[int]) -> Found | None:
        """Return a line between two groups of bodies that translate, in a direction of theirs."""
        frame, group = self._frame, self._groups[next(iter(present))]
        mine = {i for i in present if self._groups[i] == group}
        others = [i for i in present if i not in mine]
        a, b = frame.places(mine), frame.places(others)
        if a is None or b is None or len({self._groups[i] for i in others}) > 1:
            return None
        if a.size * b.size > 16 * VECTORS:
            return None
        found = direction_between(a, b, is_round=False)
        if found is None or not len(found):
            return None
        c, d = (a @ found[0]).max(axis=1).tolist()
        e, f = (b @ found[0]).min(axis=1).tolist()
        x, y = map(int, found[0].tolist())
        cut = frame.cut(1.0, (x, y), ((c + e) / 2, (d + f) / 2), min(e - c, f - d))
        return (1.0, cut, mine, ((c, d), (e, f))) if cut.gap > 0 else None

    def _is_leaf(self, rows: Sequence[int]) -> bool:
        """Return True for bodies of one group."""
        return len({self._group[k] for k in rows}) == 1


def direction_between(one: Floats, other: Floats, *, is_round: bool) -> Floats | None:
    """Return a direction in which a group of vertices is before a second group at start and end.

    It is in the middle of the vectors from one group to the other, with short numbers. No row if
    it does not exist: these are in no half-plane. None if doubles are too near to find that out.
    """
    apart = other[:, :, None] / 2 - one[:, None] / 2  # the differences are doubles
    angles = np.arctan2(apart[..., 1], apart[..., 0]).ravel()
    first = float(angles[0])
    turns = (angles - first + pi) % (2 * pi) - pi
    least, most = float(turns.min()), float(turns.max())
    room = pi - (most - least)
    if room < -UNCERTAIN:
        return np.empty((0, 2))
    if not room > UNCERTAIN or is_round:
        return None
    middle, bits = first + (least + most) / 2, min(max(ceil(log2(3 / room)), 1), 50)
    x, y = cos(middle), sin(middle)
    longest, unit = max(abs(x), abs(y)), 2.0**bits
    return np.array([[float(round(f / longest * unit)) for f in (x, y)]])
