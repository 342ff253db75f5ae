"""Pairs of boxes whose sides move linearly, by a tree in numpy: a filter, never a decision.

Boxes that fly apart keep their order, and those beside each other move nearly alike. A tree of
boxes that move with their contents separates them for all times at once, while boxes of all that
they pass overlap unless the time span is short.
"""

from __future__ import annotations

import numpy as np

from exactpt.filters.rounding import U
from exactpt.geometry.boxes import Boxes
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Floats, Indices


@np.errstate(all="ignore")
def moving_pairs(begin: Boxes, end: Boxes, many: int) -> tuple[Indices, Indices] | None:
    """Return all pairs i < j of boxes that may intersect on the way, as two arrays of indices.

    The sides of a node of the tree move linearly too. At the start and at the end they are
    outside of those below it, so they are between.

    Args:
        begin: at least one box, at the start. Its sides move linearly.
        end: the same boxes at the end.
        many: maximum number of pairs on a level of the tree; None is returned if there are more.
    """
    order = _order(begin, end)
    low = np.concatenate((begin[order, ::2], end[order, ::2]), axis=1)
    high = np.concatenate((begin[order, 1::2], end[order, 1::2]), axis=1)
    levels = [(low, high)]
    while len(low) > 1:
        firsts = np.arange(0, len(low), 2)
        low, high = np.minimum.reduceat(low, firsts), np.maximum.reduceat(high, firsts)
        levels.append((low, high))
    i = j = np.zeros(1, dtype=np.int64)
    for low, high in levels[-2::-1]:
        check_budget()
        left, right = 2 * i, 2 * j
        i = np.concatenate((left, left, left + 1, left + 1))
        j = np.concatenate((right, right + 1, right, right + 1))
        is_pair = (i <= j) & (j < len(low))  # a node is a pair with itself
        i, j = i[is_pair], j[is_pair]
        near = _may_meet(low[j] - high[i], low[i] - high[j])
        i, j = i[near], j[near]
        if len(i) > many + len(low):
            return None
    first, second = order[i[i < j]], order[j[i < j]]
    return np.minimum(first, second), np.maximum(first, second)


def _order(begin: Boxes, end: Boxes) -> Indices:
    """Return an order of the boxes in which those near each other at both times are neighbours.

    Each group of 2^k is halved where its places differ most, as shares of the whole extent.
    """
    places = np.concatenate([b[:, ::2] + b[:, 1::2] for b in (begin, end)], axis=1)
    places = np.nan_to_num(places / np.ptp(places, axis=0))  # no order of boxes is wrong
    numbers = order = np.arange(len(begin))
    for k in range((len(begin) - 1).bit_length(), 0, -1):
        group, firsts = numbers >> k, numbers[:: 1 << k]
        ordered = places[order]
        extent = np.maximum.reduceat(ordered, firsts) - np.minimum.reduceat(ordered, firsts)
        widest = extent.argmax(axis=1)[group]
        order = order[np.lexsort((ordered[numbers, widest], group))]
    return order


def _may_meet(one: Floats, other: Floats) -> Flags:
    """Return False for pairs of boxes that are apart at all times.

    A distance between sides goes linearly from p to q: rows are (p, q) in x and y, as x, y at the
    start and at the end. Where it is positive, the boxes are apart: before p / (p - q) if p > 0,
    after 1 - q / (q - p) if q > 0, as shares of the time span, else at no time.

    Doubles p and q are off by U of themselves, and so are the difference of these two of
    different signs, and the quotient: that of at most 1 by 5U, 1 - q / (q - p) by 6U. An overflow
    leads to 0 or 1, which separates nothing, and so does a NaN.
    """
    enter, leave = np.zeros(len(one)), np.ones(len(one))
    for p, q in (gap[:, [k, k + 2]].T for gap in (one, other) for k in (0, 1)):
        before = np.where(p > 0.0, np.where(q > 0.0, 2.0, p / (p - q)), 0.0)
        after = np.where((q > 0.0) & (p <= 0.0), 1.0 - q / (q - p), 1.0)
        np.fmax(enter, before, out=enter)
        np.fmin(leave, after, out=leave)
    return enter <= leave + 16.0 * U
