"""`stays_convex`, against the turns of the polygon at many rational times."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions

from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.convexity import stays_convex

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
