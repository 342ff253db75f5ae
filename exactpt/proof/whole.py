"""Moving lines between whole bodies: of few, lists find them in less time than arrays."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import accumulate
from typing import Final, TypeAlias, final

import numpy as np

from exactpt.proof.frame import Cut, Frame
from exactpt.proof.paths import DIRECTIONS, Plane

MOST: Final = 48
"""Number of bodies up to which whole ones are tried first."""
CLEAR: Final = 1e-6
"""Smallest gap between whole bodies, relative to the extent of all: doubles decide of it."""
AT_REST: Final = 0.25
"""Part of the gap of a moving line from which on a gap is enough for a line at rest."""

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
        self._frame, self._bodies = frame, frame.bodies
        self._group = [groups[i] for i in frame.bodies]
        self._are_grouped = len({*self._group}) < len(self._group)
        low, high = frame.body_extents()
        middles = (low + high).sum(axis=0, keepdims=True)
        self._order = [*range(len(DIRECTIONS))]  # the directions of the last lines first
        self._extents = np.concatenate([low, high, middles]).transpose(2, 0, 1).tolist()

    def cut(self, present: Collection[int]) -> tuple[Plane, set[int]] | None:
        """Return a line between some of these bodies, which are below it, and all others.

        None if there is none in the usual directions with enough room.
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
            return None
        self._order.insert(0, self._order.pop(self._order.index(at)))
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
        count = len(rows)
        before = [*accumulate([highs[k] for k in rows], max)]
        before_end = [*accumulate([high_ends[k] for k in rows], max)]
        rows.reverse()
        after = [*accumulate([lows[k] for k in rows], min)]
        after_end = [*accumulate([low_ends[k] for k in rows], min)]
        size = max(before[-1], before_end[-1]) - min(after[-1], after_end[-1])
        best, at, rests = 0.0, 0, False
        for i in range(1, count):
            a, b, c, d = before[i - 1], before_end[i - 1], after[-1 - i], after_end[-1 - i]
            gap = min(c - a, d - b)
            if gap > CLEAR * size:
                rest = min(c, d) - max(a, b) > AT_REST * gap
                worth = min(i, count - i) / count + 0.2 * rest + 0.3 * min(gap / size, 0.3)
                if self._are_grouped:
                    worth += 0.4 * self._is_leaf(rows[-i:]) + 0.4 * self._is_leaf(rows[:-i])
                if worth > best:
                    best, at, rests = worth, i, rest
        if not at:
            return None
        a, b, c, d = before[at - 1], before_end[at - 1], after[-1 - at], after_end[-1 - at]
        if rests:
            a = b = max(a, b)
            c = d = min(c, d)
        x, y = DIRECTIONS[j].tolist()
        return (
            best,
            self._frame.cut(best, (x, y), ((a + c) / 2, (b + d) / 2), min(c - a, d - b)),
            {self._bodies[k] for k in rows[-at:]},
            ((a, b), (c, d)),
        )

    def _is_leaf(self, rows: Sequence[int]) -> bool:
        """Return True for bodies of one group."""
        return len({self._group[k] for k in rows}) == 1
