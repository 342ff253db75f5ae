"""Pairs of moving boxes by a tree, against exact arithmetic for all pairs."""

from fractions import Fraction
from itertools import combinations
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt.geometry.moving_boxes import moving_pairs

ALWAYS = 1 << 40
sides = st.tuples(st.integers(-9, 9), st.integers(0, 6)).map(lambda s: (s[0], s[0] + s[1]))
box = st.tuples(sides, sides).map(lambda b: (*b[0], *b[1]))


def pairs_of(begin, end, many=ALWAYS):
    found = moving_pairs(np.array(begin, dtype=float), np.array(end, dtype=float), many)
    return None if found is None else list(zip(*(k.tolist() for k in found), strict=True))


def meet(begin, end):
    """Return True if two boxes intersect at a time of [0, 1]: four linear inequalities."""
    enter, leave = Fraction(0), Fraction(1)
    (a, b), (c, d) = ([[Fraction(x) for x in row] for row in pair] for pair in (begin, end))
    for axis in (0, 2):
        low, high = axis, axis + 1
        for p, q in ((b[low] - a[high], d[low] - c[high]), (a[low] - b[high], c[low] - d[high])):
            if p > 0 and q > 0:
                return False
            if p > 0:
                enter = max(enter, p / (p - q))
            elif q > 0:
                leave = min(leave, p / (p - q))
    return enter <= leave


def all_pairs(begin, end):
    return [
        (i, j)
        for i, j in combinations(range(len(begin)), 2)
        if meet((begin[i], begin[j]), (end[i], end[j]))
    ]


@given(st.lists(st.tuples(box, box), min_size=1, max_size=24))
def test_exactly_the_pairs_that_meet_once_each(boxes):
    begin, end = zip(*boxes, strict=True)

    assert sorted(pairs_of(begin, end)) == all_pairs(begin, end)


def test_boxes_that_meet_at_one_moment_or_miss_each_other_by_one_rounding():
    """The first box rests; the gap in x closes when the one in y opens, up to roundings."""
    rng, kinds = Random(5), set()
    for _ in range(300):
        close, far = rng.uniform(0, 1), rng.uniform(0, 1) * 2.0 ** rng.randint(-30, 30)
        factor = rng.choice([1.0, 2.0**-9, rng.uniform(0.5, 2)])
        begin = [(-3.0, 0.0, -3.0, 0.0), (close, 2**40, -far * factor, 2**40)]
        end = [(-3.0, 0.0, -3.0, 0.0), (-far, 2**40, close * factor, 2**40)]
        if rng.random() < 0.5:
            end[1] = (-far, 2**40, np.nextafter(close * factor, rng.choice([-9, 9])), 2**40)
        expected = meet(begin, end)
        kinds.add(expected)
        assert pairs_of(begin, end) == [(0, 1)] or not expected

    assert kinds == {True, False}


@pytest.mark.parametrize("scale", [2.0**-1074, 2.0**1023])
def test_the_least_and_the_largest_doubles(scale):
    rng = Random(3)
    for _ in range(100):
        begin, end = (
            [[scale * rng.choice([-1, 0, 1]) for _ in range(4)] for _ in range(5)] for _ in "be"
        )
        for b in begin + end:
            b[:] = *sorted(b[:2]), *sorted(b[2:])
        assert set(all_pairs(begin, end)) <= set(pairs_of(begin, end))


def test_sides_without_end_exclude_nothing():
    plane, point = (-np.inf, np.inf) * 2, (5.0, 5.0, 5.0, 5.0)
    finite = (0.0, 1.0, 0.0, 1.0)

    assert pairs_of([plane, point], [finite, point]) == [(0, 1)]
    assert pairs_of([finite, point], [plane, point]) == [(0, 1)]
    assert pairs_of([finite, point], [finite, point]) == []


def burst(n):
    """Boxes that fly apart from a grid, each at a velocity in proportion to its place."""
    rng = Random(1)
    begin = [(3 * (k % 32), 3 * (k // 32)) for k in range(n)]
    begin = [(x, x + 1 + rng.random(), y, y + 1 + rng.random()) for x, y in begin]
    return np.array(begin), 1e6 * np.array(begin)


def test_a_burst_needs_few_comparisons():
    begin, end = burst(1024)

    assert pairs_of(begin, end, 4 * 1024) == []


def test_none_when_there_are_too_many():
    begin, end = burst(64)

    assert pairs_of(begin, end[::-1], 64) is None
