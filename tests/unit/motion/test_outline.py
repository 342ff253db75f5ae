"""Shapes of moving bodies: in doubles, nested, convex for ever."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions

from exactpt import Body, InputError, Polynomial, Translation
from exactpt.kernel.numbers import QQ
from exactpt.motion.convexity import stays_convex
from exactpt.motion.inside import covers, nested_pairs
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
    assert motion.x.exact_doubles == (0.0, 0.1)
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


# Which bodies contain others, by the boxes of their rings; and how few pairs are compared


def square(x, y, side):
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


@pytest.mark.parametrize("offset", [0, 10**30])
def test_pairs_are_those_in_which_a_body_covers_a_vertex(offset):
    """Plates with a hole and an isle in it, and small bodies in a part, a hole or an isle."""
    random = Random(offset)
    plates, small = [], []
    for x in range(offset, offset + 160, 40):
        outer = {"vertices": square(x, 0, 30), "holes": [square(x + 5, 5, 20)]}
        plates.append(Body(f"p{x}", parts=[outer, square(x + 11, 11, 6)]))
    for i in range(60):
        x, y = random.randrange(3200) + QQ(1, 5), random.randrange(-5, 35) + QQ(1, 3)
        small.append(Body(f"s{i}", square(offset + x / 20, y, QQ(1, 40))))
    bodies = {i: (body, body.exact_at(QQ(0))) for i, body in enumerate([*plates, *small])}
    apart = [(i, j) for j in bodies for i in range(4) if i < j and random.random() < 0.9]
    expected = {
        (i, j) for i, j in apart
        if any(covers(*bodies[i], bodies[j][1][ring.start]) for ring in bodies[j][0].rings)
    }  # fmt: skip
    assert nested_pairs(bodies, apart) == expected
    assert len(expected) > 10


# `stays_convex`, against the turns of the polygon at many rational times

START, END = QQ(0), QQ(2)
paths = st.lists(fractions.map(lambda q: q / 8), max_size=3)
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


@st.composite
def squares(draw):
    """A square whose vertices move a little, each in its own way."""
    vertices = [{"x": [x, *draw(paths)], "y": [y, *draw(paths)]} for x, y in SQUARE]
    return Body("a", vertices)


def turns(body, t):
    p = body.at(t)
    n = len(p)
    return [
        (p[i - 1][0] - p[i - 2][0]) * (p[i][1] - p[i - 1][1])
        - (p[i - 1][1] - p[i - 2][1]) * (p[i][0] - p[i - 1][0])
        for i in range(n)
    ]


@pytest.mark.long
@given(squares())
def test_what_stays_convex_turns_left_at_all_times(body):
    answer = stays_convex(body, range(4), START, END)
    left = [min(turns(body, END * QQ(k, 64))) > 0 for k in range(65)]

    if answer:
        assert all(left)
    elif all(left):  # it is lost in between, for a moment shorter than the steps
        step = QQ(1, 32)
        assert any(min(turns(body, step * k)) < 1 for k in range(65))


def moving_corner(x, y):
    return Body("a", [*SQUARE[:2], {"x": x, "y": y}, SQUARE[3]])


def test_a_corner_pushed_in_and_out():
    in_time = moving_corner([2, -2, 1], [2, -2, 1])  # at (1, 1) for t = 1: flat then

    assert not stays_convex(in_time, range(4), START, END)
    assert stays_convex(in_time, range(4), START, QQ(99, 100))
    assert stays_convex(moving_corner([2, -1, "1/2"], [2, -1, "1/2"]), range(4), START, END)


def test_the_end_counts():
    closing = moving_corner([2, -1], [2, -1])  # flat at t = 1

    assert not stays_convex(closing, range(4), START, QQ(1))
    assert stays_convex(closing, range(4), START, QQ(1) - QQ(1, 10**9))


def test_a_vertex_that_is_flat_for_ever_is_not_strictly_convex():
    assert not stays_convex(Body("a", [(0, 0), (1, 0), (2, 0), (0, 2)]), range(4), START, END)


def test_flat_at_the_start_and_convex_after_it_stays_convex():
    opening = Body("a", [(0, 0), {"x": [1], "y": [0, -1]}, (2, 0), (0, 2)])
    closing = Body("a", [(0, 0), {"x": [1], "y": [0, 1]}, (2, 0), (0, 2)])

    assert stays_convex(opening, range(4), START, END)
    assert not stays_convex(closing, range(4), START, QQ(1, 4))


def test_later_pieces_count():
    frames = [(0, SQUARE), (1, SQUARE), (2, [*SQUARE[:2], ("1/2", "1/2"), SQUARE[3]])]
    body = Body("a", keyframes=frames)

    assert stays_convex(body, range(4), START, QQ(1))
    assert not stays_convex(body, range(4), START, QQ(2))
