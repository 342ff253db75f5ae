"""Enclosures of doubles that are translated are those of their trajectories, double by double."""

import math
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from exactpt import Body, Pieces, Rigid, Translation
from exactpt.kernel.numbers import QQ, rational
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.frame import Frame, frame_for

ordinary = st.floats(-1e6, 1e6) | st.integers(-1000, 1000).map(float)
doubles = ordinary | st.floats(allow_nan=False, allow_infinity=False)
paths = st.lists(doubles | st.fractions(-9, 9, max_denominator=9), max_size=4)
exponents = st.integers(-1000, 1000) | st.sampled_from([0, 0, 7, -7])


@st.composite
def frames(draw):
    center = draw(st.sampled_from([(0, 0), (3, -7)]) | st.tuples(ordinary, ordinary))
    origin = draw(st.sampled_from([0, 0, Fraction(1, 3), 5]) | ordinary)
    scale = draw(exponents), draw(exponents)
    x, y = map(rational, center)
    return Frame((x, y), scale, rational(origin), draw(st.integers(-20, 20)))


def contents(images):
    return [(i.xs, i.ys, i.ws, i.degree, i.motion) for i in images]


@given(
    points=st.lists(st.tuples(doubles, doubles), min_size=3, max_size=6, unique=True),
    x=paths,
    y=paths,
    frame=frames(),
)
@example(
    [(0.1, 0.2), (5e-324, -0.0), (1e308, 3.0)],
    [0.3],
    [1e308],
    Frame((QQ(0), QQ(0)), (0, 0), QQ(0), 0),
)
@example(
    [(0.1, 0.2), (1.0, 0.7), (2.0, 3.0)],
    [0.3, 0.1],
    [7.0],
    Frame((QQ(0), QQ(0)), (900, -900), QQ(0), 0),
)
@example(
    [(0.1, 0.2), (1.0, 0.7), (2.0, 3.0)],
    [2.0**-60, 0.1],
    [],
    Frame((QQ(1), QQ(0)), (1, 1), QQ(1), 3),
)
def test_enclosures_without_trajectories(points, x, y, frame):
    piece = Body("b", points, Translation(x, y), closed=False)._piece_after(QQ(0))
    short, long = Enclosures(frame), Enclosures(frame)

    ours, expected = short.of_piece(piece), long.images(piece.tracks)

    assert repr(contents(ours)) == repr(contents(expected))  # NaN is NaN, and 0.0 is not -0.0
    if not all(math.isnan(image.x0) for image in ours):  # bounds of nothing may be larger
        assert short.errors == long.errors


def test_trajectories_are_made_when_asked_for():
    points = [(0.5, 0.25), (3, 0), ("7", "1/2")]
    piece = Body("b", points, Translation([1, 0.1]))._piece_after(QQ(0))

    images = Enclosures(frame_for(piece.corners(QQ(0)), QQ(0), QQ(1))).of_piece(piece)

    assert [image.xs for image in images] == [[1.5, 0.1], [4.0, 0.1], [8.0, 0.1]]
    assert not piece._made
    assert [track.at(1)[0] for track in piece.tracks] == [
        Fraction(x) + Fraction(0.1) for x in (1.5, 4, 8)
    ]


@pytest.mark.parametrize(
    ("vertices", "motion"),
    [
        ([(0, 0), (1, 0), ("1/3", 1)], Translation()),  # no double
        ([(0, 0), (1, 0), (0.1, 1)], Rigid([0, 1])),  # no translation
        ([(0, 0), (1, 0), {"x": [1, 1], "y": 2}], Translation()),  # deforms
        ([(0, 0), (1, 0), (0.1, 1)], Translation("1/3")),  # what is added is no double
    ],
)
def test_others_have_those_of_their_trajectories(vertices, motion):
    piece = Body("b", vertices, motion)._piece_after(QQ(0))
    frame = Frame((QQ(0), QQ(0)), (0, 0), QQ(0), 0)

    ours, expected = Enclosures(frame).of_piece(piece), Enclosures(frame).images(piece.tracks)

    assert contents(ours) == contents(expected)


@given(points=st.lists(st.tuples(ordinary, ordinary), min_size=1, max_size=5), shift=ordinary)
def test_corners_have_the_bounding_box(points, shift):
    body = Body("b", points, Translation([shift, 2], [0, "1/3"]), closed=False)
    t = QQ(1, 7)

    boxes = [
        [(min(axis), max(axis)) for axis in zip(*places, strict=True)]
        for places in (body._piece_after(t).corners(t), body._at(t))
    ]

    assert boxes[0] == boxes[1]


def test_each_piece_has_its_own_translation():
    motion = Pieces([(1, Translation([0, 1])), (None, Translation([1]))])
    body = Body("b", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], motion)

    assert [body._piece_after(QQ(t)).corners(QQ(t))[0] for t in (0, 2)] == [(0, 0), (1, 0)]
