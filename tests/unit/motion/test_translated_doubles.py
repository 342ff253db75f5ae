"""Enclosures of vertices that are translated, without their trajectories."""

import math
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from exactpt import Body, Pieces, Rigid, Translation
from exactpt.kernel.numbers import QQ, rational
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.float_track import CANCELLING
from exactpt.motion.normalization import Normalization, normalization_for

ordinary = st.floats(-1e6, 1e6) | st.integers(-1000, 1000).map(float)
doubles = ordinary | st.floats(allow_nan=False, allow_infinity=False)
paths = st.lists(doubles | st.fractions(-9, 9, max_denominator=9), max_size=4)
ratios = st.fractions(-1000, 1000, max_denominator=1000) | st.fractions()
exponents = st.integers(-1000, 1000) | st.sampled_from([0, 0, 7, -7])


def frame_of(center, scale):
    return Normalization((QQ(center[0]), QQ(center[1])), scale, QQ(0), 0)


@st.composite
def frames(draw):
    center = draw(st.sampled_from([(0, 0), (3, -7)]) | st.tuples(ordinary, ordinary))
    origin = draw(st.sampled_from([0, 0, Fraction(1, 3), 5]) | ordinary)
    scale = draw(exponents), draw(exponents)
    x, y = map(rational, center)
    return Normalization((x, y), scale, rational(origin), draw(st.integers(-20, 20)))


def contents(float_tracks):
    """The digits of all enclosures; as text, in which undefined numbers are equal."""
    return [repr((i.xs, i.ys, i.ws, i.degree, i.motion)) for i in float_tracks]


IDENTITY = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)


@given(
    points=st.lists(st.tuples(doubles, doubles), min_size=3, max_size=6, unique=True),
    x=paths,
    y=paths,
    normalization=frames(),
)
@example([(0.1, 0.2), (5e-324, -0.0), (1e308, 3.0)], [0.3], [1e308], IDENTITY)
@example([(0.1, 0.2), (1.0, 0.7), (2.0, 3.0)], [0.3, 0.1], [7.0], frame_of((0, 0), (900, -900)))
@example([(0.1, 0.2), (1.0, 0.7), (2.0, 3.0)], [2.0**-60, 0.1], [], frame_of((1, 0), (1, 1)))
@example([(0.1, 0.2), (1.0, 0.7), (2.0, 3.0)], [Fraction(1, 3)], [Fraction(1, 10**400)], IDENTITY)
@example([(-0.33, 0.0), (0.0, 0.0), (0.0051, 0.0)], [Fraction(1, 3)], [], IDENTITY)
def test_enclosures_without_trajectories(points, x, y, normalization):
    """The same enclosures where all is exact, others within a bound that is hardly larger."""
    piece = Body("b", points, Translation(x, y), closed=False).exact_piece_after(QQ(0))
    short, long = Enclosures(normalization), Enclosures(normalization)

    ours, expected = short.of_piece(piece), long.float_tracks(piece.tracks)

    with_shift = any(c.denominator & (c.denominator - 1) for c in map(Fraction, [*x, *y]))
    if (
        not with_shift
        and normalization.origin == 0 == normalization.center[0] == normalization.center[1]
    ):
        assert repr(contents(ours)) == repr(contents(expected))  # NaN is NaN, 0.0 is not -0.0
        if not all(
            math.isnan(float_track.x0) for float_track in ours
        ):  # bounds of nothing may be larger
            assert short.errors == long.errors
    assert [i.motion for i in ours] == [i.motion for i in expected]
    assert_enclosed(ours, piece, normalization, short.errors)
    sizes = [abs(v) for i in expected for v in (i.x0, i.y0) if not math.isnan(v)]
    most = 2.0 * (1.0 + CANCELLING) * 2.0**-53 * max(sizes, default=0.0)  # see `constant_error`
    assert short.errors[0] <= max(long.errors[0], 1.001 * most)


def assert_enclosed(float_tracks, piece, normalization, errors):
    for float_track, track in zip(float_tracks, piece.tracks, strict=True):
        fx, fy, w = (list(map(QQ, f)) for f in normalization.moved(track))
        for near, f in ((float_track.xs, fx), (float_track.ys, fy)):
            exact = [c / w[0] for c in f] + [QQ(0)] * (len(near) - len(f))
            for c, bound, value in zip(near, errors, exact, strict=False):
                assert math.isnan(c) or abs(QQ(*c.as_integer_ratio()) - value) <= bound


@pytest.mark.long
@given(
    points=st.lists(st.tuples(ratios, ratios), min_size=1, max_size=5, unique=True),
    x=st.lists(ratios, max_size=3),
    y=st.lists(ratios, max_size=3),
    normalization=frames(),
)
@example([(Fraction(1, 3), Fraction(1, 10**400))], [Fraction(-1, 3)], [], IDENTITY)
@example([(Fraction(1, 3), 0), (Fraction(10**9) / 7, 1)], [-Fraction(10**9) / 7], [], IDENTITY)
def test_enclosures_of_ratios(points, x, y, normalization):
    body = Body("b", [tuple(map(str, p)) for p in points], Translation(x, y), closed=False)
    piece = body.exact_piece_after(QQ(0))
    enclosures = Enclosures(normalization)

    assert_enclosed(enclosures.of_piece(piece), piece, normalization, enclosures.errors)


def test_trajectories_are_made_when_asked_for():
    points = [(0.5, 0.25), (3, 0), ("7", "1/2")]
    piece = Body("b", points, Translation([1, 0.1])).exact_piece_after(QQ(0))

    float_tracks = Enclosures(normalization_for(piece.corners(QQ(0)), QQ(0), QQ(1))).of_piece(piece)

    assert [float_track.xs for float_track in float_tracks] == [[1.5, 0.1], [4.0, 0.1], [8.0, 0.1]]
    assert not piece._made
    assert [track.at(1)[0] for track in piece.tracks] == [
        Fraction(x) + Fraction(0.1) for x in (1.5, 4, 8)
    ]


@pytest.mark.parametrize(
    ("vertices", "motion"),
    [
        ([(0, 0), (1, 0), (Fraction(1, 3 * 10**400), 1)], Translation()),  # out of range
        ([(0, 0), (1, 0), (0.1, 1)], Rigid([0, 1])),  # no translation
        ([(0, 0), (1, 0), {"x": [1, 1], "y": 2}], Translation()),  # deforms
        ([(0, 0), ("1/10", 1)], Translation("-1/10", -1)),  # all digits are lost
    ],
)
def test_others_have_those_of_their_trajectories(vertices, motion):
    piece = Body("b", vertices, motion).exact_piece_after(QQ(0))
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)

    ours, expected = (
        Enclosures(normalization).of_piece(piece),
        Enclosures(normalization).float_tracks(piece.tracks),
    )

    assert contents(ours) == contents(expected)


@given(points=st.lists(st.tuples(ordinary, ordinary), min_size=1, max_size=5), shift=ordinary)
def test_corners_have_the_bounding_box(points, shift):
    body = Body("b", points, Translation([shift, 2], [0, "1/3"]), closed=False)
    t = QQ(1, 7)

    boxes = [
        [(min(axis), max(axis)) for axis in zip(*places, strict=True)]
        for places in (body.exact_piece_after(t).corners(t), body.exact_at(t))
    ]

    assert boxes[0] == boxes[1]


def test_each_piece_has_its_own_translation():
    motion = Pieces([(1, Translation([0, 1])), (None, Translation([1]))])
    body = Body("b", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], motion)

    assert [body.exact_piece_after(QQ(t)).corners(QQ(t))[0] for t in (0, 2)] == [(0, 0), (1, 0)]
