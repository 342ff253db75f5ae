"""Shapes given by numpy arrays are those given by the same numbers in lists."""

import numpy as np
import pytest

from exactpt import Body, InputError, Translation
from exactpt.motion.shape import Shape

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
    for given in (
        np.array(POINTS),
        [tuple(p) for p in np.array(POINTS)],
        np.array([[1, 2], [3, 5]]),
    ):
        shape = Shape(given)
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
