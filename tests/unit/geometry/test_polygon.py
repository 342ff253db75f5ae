"""Orientation of polygons, and their boxes in doubles."""

import math
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, fractions, wide_fractions

from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import contains, is_counter_clockwise, signed_area2
from exactpt.geometry.predicates import between, orient2d, orientation
from exactpt.kernel.numbers import QQ, rational

SIMPLE = (
    [(0, 0), (2, 0), (0, 1)],
    [(0, 0), (1, 0), (1, 1), (0, 1)],
    [(0, 0), (1, 0), (1, 3), (0, 3), (0, 2), (0, 1)],  # flat vertices on the left
    [(0, 0), (3, 0), (3, 2), (0, 2), (2, 1)],  # two leftmost vertices, a reflex one between
    [(0, 1), (1, 0), (5, 5), (4, 1), (6, 6), (1, 5), (3, 4)],
)
wide = st.one_of(
    fractions,
    st.integers(-(10**30), 10**30).map(Fraction),
    st.sampled_from([Fraction(10**400), Fraction(-(10**400)), Fraction(1, 10**400)]),
)


@pytest.mark.parametrize("shape", SIMPLE)
def test_the_leftmost_vertex_tells_the_orientation(shape):
    points = [(as_rational(Fraction(x)), as_rational(Fraction(y))) for x, y in shape]
    for i in range(len(points)):
        turned = points[i:] + points[:i]
        mirrored = [(-x, y) for x, y in turned]
        for ring in (turned, turned[::-1], mirrored, mirrored[::-1]):
            assert is_counter_clockwise(ring) == (signed_area2(ring) > 0)


@given(st.lists(st.lists(st.tuples(wide, wide), min_size=1, max_size=3), max_size=4))
def test_boxes_contain_their_points(groups):
    exact = [[(as_rational(x), as_rational(y)) for x, y in points] for points in groups]

    boxes = boxes_of_points(exact)

    def hold(axis, origin):
        return all(
            low <= point[axis] - origin <= high
            for points, (low, high) in zip(exact, boxes[:, 2 * axis :][:, :2], strict=True)
            for point in points
        )

    assert boxes.shape == (len(groups), 4)
    for axis in (0, 1):
        assert hold(axis, 0) or hold(axis, exact[0][0][axis])


@pytest.mark.parametrize("size", [QQ(2) ** 1010, QQ(2) ** 1030, QQ(1, 2**1010)])
def test_boxes_of_points_of_any_size(size):
    """Beyond the largest double they may be as large as the plane."""
    boxes = boxes_of_points([[(k * size, -k * size)] for k in range(5)])

    assert np.isfinite(boxes).all() == (size < QQ(2) ** 1020)
    for k, (x_low, x_high, y_low, y_high) in enumerate(boxes.tolist()):
        assert x_low == -math.inf or QQ(x_low) <= k * size
        assert x_high == math.inf or k * size <= QQ(x_high)
        assert y_low == -math.inf or QQ(y_low) <= -k * size
        assert y_high == math.inf or -k * size <= QQ(y_high)


def test_boxes_of_points_far_away_are_as_apart_as_near_the_origin():
    """A grid of squares, also where doubles are 2^147 apart."""
    corners = [(QQ(3 * i), QQ(3 * j)) for i in range(5) for j in range(5)]
    for shift in (QQ(0), QQ(2) ** 60, -(QQ(2) ** 200), QQ(10) ** 400):
        boxes = boxes_of_points([[(x + shift, y), (x + shift + 2, y + 2)] for x, y in corners])

        assert not sum(len(first) for first, _ in overlapping_pairs(boxes))


def test_a_polygon_contains_what_a_ray_across_all_edges_finds_in_it():
    """On a grid, where points are on edges, at vertices, and level with them."""
    star = [(0, 0), (4, 1), (8, 0), (6, 4), (8, 8), (4, 6), (0, 8), (2, 4), (2, 2)]
    ring = [(rational(x), rational(y)) for x, y in star]
    edges = list(zip(ring, [*ring[1:], ring[0]], strict=True))
    found = 0
    for p in product(map(rational, range(-1, 10)), repeat=2):
        inside = any(orientation(a, b, p) == 0 and between(a, b, p) for a, b in edges)
        crossed = [
            1 for a, b in edges if (a[1] > p[1]) != (b[1] > p[1])
            and (orientation(a, b, p) > 0) == (b[1] > a[1])
        ]  # fmt: skip
        assert contains(ring, p) == contains(ring[::-1], p) == (inside or len(crossed) % 2 == 1)
        found += contains(ring, p)
    assert 20 < found < 100


numbers = st.one_of(fractions, wide_fractions).map(as_rational)
points = st.tuples(numbers, numbers)


def test_the_unit_triangle_turns_left():
    corners = [(QQ(0), QQ(0)), (QQ(1), QQ(0)), (QQ(0), QQ(1))]

    assert orient2d(*corners) == 1
    assert (
        orientation(*corners),
        orientation(*corners[::-1]),
        orientation(corners[0], *corners[:2]),
    ) == (1, -1, 0)


@given(points, points, points)
def test_the_orientation_is_twice_the_area_by_the_shoelace_formula(a, b, c):
    shoelace = sum(p[0] * q[1] - q[0] * p[1] for p, q in ((a, b), (b, c), (c, a)))

    assert orient2d(a, b, c) == shoelace
    assert orientation(a, b, c) == (shoelace > 0) - (shoelace < 0)


@given(points, points, st.one_of(fractions, wide_fractions).map(as_rational))
def test_on_the_line_through_two_points_only_the_segment_is_between(a, b, k):
    c = tuple(u + k * (v - u) for u, v in zip(a, b, strict=True))

    assert orientation(a, b, c) == 0
    assert between(a, b, c) == (0 <= k <= 1 or a == b)


@given(points, points)
def test_between_equal_points_is_only_that_point(a, b):
    assert between(a, a, b) == (a == b)
    assert between(a, b, a)
    assert between(a, b, b)
