"""Bounds of polynomials on intervals, by Bernstein coefficients: beside values and by hand."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Polynomial
from exactpt.kernel.numbers import QQ
from exactpt.motion.turned_angle import bound_on, bounds_on_parts

rationals = st.fractions(-9, 9, max_denominator=20)
polynomials = st.lists(rationals, max_size=8).map(Polynomial)


@pytest.mark.parametrize(
    ("coefficients", "a", "b", "expected"),
    [
        # 1 - 2 t on [0, 1]: from 1 to -1
        ([1, -2], 0, 1, 1),
        # t^2 on [1, 3] is (1 + 2 s)^2: coefficients 1, 3, 9
        ([0, 0, 1], 1, 3, 9),
        # t - t^2 on [0, 1]: coefficients 0, 1/2, 0, twice its maximum
        ([0, 1, -1], 0, 1, QQ(1, 2)),
        ([], 0, 1, 0),
    ],
)
def test_bounds_by_hand(coefficients, a, b, expected):
    assert bound_on(Polynomial(coefficients), QQ(a), QQ(b)) == expected


def test_bounds_on_halves_by_hand():
    """t - t^2 on [0, 1/2]: t = s / 2 makes s / 2 - s^2 / 4, with coefficients 0, 1/4, 1/4."""
    assert bounds_on_parts(Polynomial([0, 1, -1]), 1) == [QQ(1, 4), QQ(1, 4)]


@given(f=polynomials, halvings=st.integers(0, 3))
def test_bounds_on_parts_are_those_on_each(f, halvings):
    count = 2**halvings

    expected = [bound_on(f, QQ(k, count), QQ(k + 1, count)) for k in range(count)]

    assert bounds_on_parts(f, halvings) == expected


@given(f=polynomials, a=rationals, width=st.fractions(0, 9, max_denominator=20))
def test_no_value_is_beyond_a_bound(f, a, width):
    bound = bound_on(f, QQ(a), QQ(a + width))

    assert all(abs(f.exact_at(QQ(a + width * k / 8))) <= bound for k in range(9))
