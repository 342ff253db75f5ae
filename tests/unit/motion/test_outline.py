"""Shapes in doubles: exact, or the nearest ones with a bound on their errors."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, Polynomial
from exactpt.motion.outline import rest_outline

numbers = st.fractions() | st.integers() | st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=4))
def test_the_error_bounds_the_distance_of_every_coordinate(vertices):
    outline = rest_outline(Body("a", vertices, closed=False))

    near = zip(outline.xs, outline.ys, strict=True)
    for (x, y), (near_x, near_y) in zip(vertices, near, strict=True):
        assert abs(Fraction(x) - Fraction(near_x)) <= outline.error
        assert abs(Fraction(y) - Fraction(near_y)) <= outline.error


@pytest.mark.parametrize("x", ["1/3", f"1/{10**200}", str(Fraction(10**200, 3))])
def test_what_no_double_holds_has_an_error(x):
    assert rest_outline(Body("a", [(x, 0)])).error > 0


def test_integers_and_doubles_have_none():
    assert rest_outline(Body("a", [("3", "-7"), (0.1, 2)])).error == 0


def test_none_out_of_range_or_deforming():
    assert rest_outline(Body("a", [("1e400", 0)])) is None
    assert rest_outline(Body("a", [(Polynomial([0, 1]), Polynomial([0]))])) is None


def test_the_doubles_of_a_shape_are_made_once():
    body = Body("a", [("1/3", "0"), ("2", "0"), ("0", "1")])

    assert rest_outline(body).xs is rest_outline(body).xs
