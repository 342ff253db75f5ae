"""The float filter for simple polygons accepts only simple ones, and nearly all of them."""

import math
from random import Random

import numpy as np
import pytest

from exactpt.geometry.edge_pairs import _surely_apart
from exactpt.geometry.polygon import first_self_touch, segments_meet, signed_area2
from exactpt.geometry.simple import is_surely_simple
from exactpt.kernel.numbers import QQ, rational
from exactpt.kernel.rounding import U


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
    apart = _surely_apart(rows.T[:4], rows.T[4:], error)
    for row, surely in zip(rows.tolist(), apart.tolist(), strict=True):
        moved = [QQ(v) + random.choice((-1, 0, 1)) * QQ(error) for v in row]
        a, b, c, d = zip(moved[::2], moved[1::2], strict=True)
        assert not (surely and segments_meet(a, b, c, d))
    assert 50 < apart.sum() < 350
