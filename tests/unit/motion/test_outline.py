"""Shapes in doubles, exact or with a bound; those of numpy arrays are those of lists."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, InputError, Polynomial, Translation
from exactpt.motion.outline import rest_outline
from exactpt.motion.shape import Shape

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


POINTS = [(0.1, 0.2), (1.5, -0.25), (0.5, 3.0)]


@pytest.mark.parametrize("dtype", ["f8", "f4", "f2", ">f8", "i8", "u1", "longdouble", "O"])
def test_an_array_is_the_list_of_its_numbers(dtype):
    array = np.abs(np.array(POINTS)).astype(dtype)
    listed = [
        tuple(x.item() if dtype == "O" and hasattr(x, "item") else x for x in p) for p in array
    ]

    assert Body("b", array).vertices == Body("b", [tuple(p) for p in listed]).vertices
    assert Body("b", list(array)).vertices == Body("b", array).vertices


def test_doubles_of_arrays_are_kept():
    for points in (
        np.array(POINTS),
        [tuple(p) for p in np.array(POINTS)],
        np.array([[1, 2], [3, 5]]),
    ):
        shape = Shape(points)
        assert shape.doubles is not None
        assert all(type(x) is float for xs in shape.doubles for x in xs)
    motion = Translation(np.array([0.0, 0.1]), [np.float64(0.5), np.float32(2)])
    assert motion.x._doubles == (0.0, 0.1)
    assert motion.y(1) == 2.5


@pytest.mark.parametrize(
    "array",
    [
        np.array([[True, False], [False, True], [True, True]]),
        np.array([[0.0, np.nan], [1.0, 0.0], [0.0, 1.0]]),
        np.array([[0.0, np.inf], [1.0, 0.0], [0.0, 1.0]]),
        np.array([[0, 1], [1, 0], [0, 0]], dtype="datetime64[s]"),
        np.array([1.0, 2.0, 3.0]),
        np.array(1.0),
        np.ma.array([[0.0, 1.0], [1.0, 0.0]], mask=[[False, True], [False, False]]),
    ],
)
def test_other_arrays_are_refused(array):
    with pytest.raises(InputError):
        Body("b", array)


def test_an_array_without_dimension_is_no_polynomial():
    with pytest.raises(InputError, match="a polynomial has a list of coefficients"):
        Translation(np.array(1.0))
