"""Polygons: orientation, boxes in doubles, the filter for simple ones."""

import math
from fractions import Fraction
from itertools import combinations, product
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, fractions, wide_fractions

from exactpt.filters.rounding import U
from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.edge_pairs import near_edges
from exactpt.geometry.polygon import (
    contains,
    first_self_touch,
    is_counter_clockwise,
    segments_meet,
    signed_area2,
)
from exactpt.geometry.predicates import between, orient2d, orientation
from exactpt.geometry.ragged import _surely_apart
from exactpt.geometry.simple import is_surely_simple
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


# The float filter for simple polygons accepts only simple ones, and nearly all of them


def exactly(xs, ys):
    return [(rational(x), rational(y)) for x, y in zip(xs, ys, strict=True)]


def is_simple(points, *, closed):
    if first_self_touch(points, closed=closed) is not None:
        return False
    return len(points) < 3 or not closed or signed_area2(points) != 0


def nudged(rng, x):
    for _ in range(rng.randint(0, 2)):
        x = math.nextafter(x, rng.choice([-math.inf, math.inf]))
    return x


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("size", [2, 3, 4, 5, 7, 24])
@pytest.mark.parametrize("far", [0.0, 1.0, 2.0**52])
def test_what_is_accepted_is_simple(closed, size, far):
    """Points on small grids, a few of them an ulp off: most polygons are degenerate."""
    rng = Random(f"{closed} {size} {far}")
    accepted = 0
    for _ in range(300 if size < 24 else 40):
        width = rng.choice([2, 3, 9, 1000])
        xs, ys = ([nudged(rng, far + rng.randrange(width)) for _ in range(size)] for _ in range(2))
        if is_surely_simple(xs, ys, closed=closed):
            accepted += 1
            assert is_simple(exactly(xs, ys), closed=closed)
    assert accepted or size == 24


def test_accepted_with_an_error_it_is_simple_wherever_the_points_are_within_it():
    rng = Random("errors")
    accepted = 0
    for _ in range(600):
        size, width = rng.randint(2, 6), rng.choice([2, 3, 30])
        xs, ys = ([float(rng.randrange(width)) for _ in range(size)] for _ in range(2))
        error = width * rng.choice([U, 0.01, 0.1])
        if is_surely_simple(xs, ys, closed=True, error=error):
            accepted += 1
            off = QQ(*error.as_integer_ratio())
            moved = [
                (x + rng.choice([-1, 1]) * off, y + rng.choice([-1, 1]) * off)
                for x, y in exactly(xs, ys)
            ]
            assert is_simple(moved, closed=True)
    assert accepted > 100


def test_three_points_on_a_line_whose_differences_are_rounded_are_no_triangle():
    """Without its bound the filter takes the rounding of the differences for an area."""
    rng = Random("line")
    for _ in range(500):
        vx, vy = (rng.randrange(1 << 50, 1 << 51) for _ in range(2))
        x, y = (rng.randrange(-(1 << 50), 1 << 50) for _ in range(2))
        steps = rng.sample([-3, -2, -1, 0, 1, 2, 3], 3)
        xs, ys = [float(x + i * vx) for i in steps], [float(y + i * vy) for i in steps]
        points = exactly(xs, ys)
        if signed_area2(points) == 0:
            assert not is_surely_simple(xs, ys, closed=True)
            assert not is_surely_simple(xs, ys, closed=False)


def test_regular_polygons_and_stars_are_accepted_and_what_winds_twice_is_not():
    for n in (3, 4, 5, 12, 40):
        angles = [2 * math.pi * (i + 0.3) / n for i in range(n)]
        xs, ys = [math.cos(a) for a in angles], [math.sin(a) for a in angles]
        assert is_surely_simple(xs, ys, closed=True)
        assert is_surely_simple(xs[::-1], ys[::-1], closed=True)
        spiky = [0.4 if i % 2 else 1.0 for i in range(n)]
        if n % 2 == 0:
            star = [x * r for x, r in zip(xs, spiky, strict=True)]
            assert is_surely_simple(
                star, [y * r for y, r in zip(ys, spiky, strict=True)], closed=True
            )
        if n == 5:  # a pentagram turns left at each vertex, by 4 pi in all
            twice = [0, 2, 4, 1, 3]
            assert not is_surely_simple([xs[i] for i in twice], [ys[i] for i in twice], closed=True)


@pytest.mark.parametrize("size", [1e308, 5e-324, 1e-200])
def test_out_of_range_nothing_is_accepted(size):
    xs, ys = [-size, size, 0.0], [-size, -size, size]
    assert not is_surely_simple(xs, ys, closed=True)


@pytest.mark.parametrize("error", [0.0, 2.0**-50])
def test_edges_that_are_surely_apart_do_not_meet(error):
    """On a grid where many touch, and nearly: each coordinate out of place by the error."""
    random = Random(f"apart {error}")
    rows = np.array(
        [
            [random.randint(0, 4) + random.choice((0.0, 2.0**-48)) for _ in range(8)]
            for _ in range(400)
        ]
    )
    first = np.concatenate((rows[:, 0:2], rows[:, 4:6]))
    d = np.concatenate((rows[:, 2:4], rows[:, 6:8])) - first
    numbers = np.arange(len(rows))
    apart = _surely_apart(first, d, numbers, len(rows) + numbers, 2.0 * error)
    for row, surely in zip(rows.tolist(), apart.tolist(), strict=True):
        moved = [QQ(v) + random.choice((-1, 0, 1)) * QQ(error) for v in row]
        a, b, c, d = zip(moved[::2], moved[1::2], strict=True)
        assert not (surely and segments_meet(a, b, c, d))
    assert 50 < apart.sum() < 350


def spiky(n):
    """A star, the spikes of which are a tenth of its radius long."""
    angles = 2 * np.pi * np.arange(n) / n
    radii = np.where(np.arange(n) % 2, 10.0, 9.0)
    return np.stack((radii * np.cos(angles), radii * np.sin(angles)), axis=1)


def test_few_edges_of_a_polygon_with_thin_spikes_are_compared():
    """A regression: all edges with intersecting boxes were, 73 for each edge, and listed."""
    points = spiky(10_000)
    pairs = near_edges(points, np.roll(points, -1, axis=0), 0.0, closed=True)
    assert sum(len(i) for i, _ in pairs) < 16 * len(points)


@pytest.mark.parametrize("error", [0.0, 0.25])
@pytest.mark.parametrize("closed", [True, False])
def test_all_edges_of_a_polygon_that_intersect_are_near(closed, error):
    random = Random(f"near {closed} {error}")
    points = [(random.randint(0, 40), random.randint(0, 40)) for _ in range(90)]
    rows = np.array(points, dtype=np.float64)
    first, last = rows[: None if closed else -1], np.roll(rows, -1, axis=0)
    near = near_edges(first, last[: len(first)], error, closed=closed)
    pairs = {ij for i, j in near for ij in zip(i.tolist(), j.tolist(), strict=True)}
    off = QQ(error)
    moved = [
        (x + random.choice((-1, 1)) * off, y + random.choice((-1, 1)) * off) for x, y in points
    ]
    n = len(first)
    for i, j in combinations(range(n), 2):
        if j == i + 1 or (closed and j - i == n - 1):
            assert (i, j) not in pairs
        elif segments_meet(*(moved[k % 90] for k in (i, i + 1, j, j + 1))):
            assert (i, j) in pairs


@pytest.mark.parametrize("closed", [True, False])
def test_what_is_accepted_of_many_edges_is_simple(closed):
    """Combs of which the vertices are moved by at most a unit, often onto other edges."""
    random = Random(f"many {closed}")
    accepted = simple = 0
    for _ in range(50):
        xs = [float(i) for i in range(80)] + [40.0]
        ys = [float(i % 2 * random.randint(3, 9)) for i in range(80)] + [30.0]
        for i in random.sample(range(80), 3):
            xs[i] += random.randint(-1, 1)
            ys[i] += random.randint(-1, 1)
        surely, is_so = (
            is_surely_simple(xs, ys, closed=closed),
            is_simple(exactly(xs, ys), closed=closed),
        )
        assert is_so or not surely
        accepted += surely
        simple += is_so
    assert 0.9 * simple <= accepted <= simple < 50
