"""Predicates at an instant: laws of the signed area, and who is between whom."""

from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, fractions, wide_fractions

from exactpt.geometry.predicates import between, orient2d, side
from exactpt.kernel.numbers import QQ

numbers = st.one_of(fractions, wide_fractions).map(as_rational)
points = st.tuples(numbers, numbers)


def test_the_unit_triangle_turns_left():
    corners = [(QQ(0), QQ(0)), (QQ(1), QQ(0)), (QQ(0), QQ(1))]

    assert orient2d(*corners) == 1
    assert (side(*corners), side(*corners[::-1]), side(corners[0], *corners[:2])) == (1, -1, 0)


@given(points, points, points)
def test_the_orientation_is_twice_the_area_by_the_shoelace_formula(a, b, c):
    shoelace = sum(p[0] * q[1] - q[0] * p[1] for p, q in ((a, b), (b, c), (c, a)))

    assert orient2d(a, b, c) == shoelace
    assert side(a, b, c) == (shoelace > 0) - (shoelace < 0)


@given(points, points, st.one_of(fractions, wide_fractions).map(as_rational))
def test_on_the_line_through_two_points_only_the_segment_is_between(a, b, k):
    c = tuple(u + k * (v - u) for u, v in zip(a, b, strict=True))

    assert side(a, b, c) == 0
    assert between(a, b, c) == (0 <= k <= 1 or a == b)


@given(points, points)
def test_between_equal_points_is_only_that_point(a, b):
    assert between(a, a, b) == (a == b)
    assert between(a, b, a)
    assert between(a, b, b)
