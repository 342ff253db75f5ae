"""Swept boxes contain every vertex at every time of the interval, and are not far too large."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, doubles, fractions

from exactpt import Affine, Body, Rigid, Translation
from exactpt.kernel.numbers import QQ
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.normalization import normalization_for
from exactpt.motion.swept import SweptBoxes

coefficients = st.lists(st.one_of(fractions, doubles.map(lambda x: x % 8)), max_size=4)
points = st.tuples(fractions, fractions)
bodies = st.one_of(
    st.builds(lambda p, x, y: Body("a", [p], Translation(x, y)), points,
              coefficients, coefficients),
    st.builds(lambda p, h, x: Body("a", [p], Rigid(h, pivot=(1, 0), x=x)), points,
              coefficients, coefficients),
    st.builds(lambda p, m, x: Body("a", [p], Affine([[m, 0], [1, m]], x=x)), points,
              coefficients, coefficients),
)  # fmt: skip


@pytest.mark.long
@given(
    st.lists(bodies, min_size=1, max_size=4),
    st.fractions(0, 4, max_denominator=16),
    st.fractions(0, 4, max_denominator=16),
)
def test_boxes_contain_the_vertices(bodies, begin, length):
    tracks = [body.exact_piece_after(QQ(0)).tracks[0] for body in bodies]
    normalization = normalization_for([body.at(QQ(0))[0] for body in bodies], QQ(0), QQ(8))
    enclosures = Enclosures(normalization)
    float_tracks = enclosures.float_tracks(tracks)
    first, last = as_rational(begin), as_rational(begin + length)
    low, high = normalization.time(first)[0], normalization.time(last)[1]

    swept = SweptBoxes(float_tracks, enclosures.errors)
    boxes = swept.during(low, high).tolist()

    for track, (x_low, x_high, y_low, y_high) in zip(tracks, boxes, strict=True):
        for k in range(9):
            t = first + (last - first) * QQ(k, 8)
            x, y = track.at(t)
            dx, dy = drift_at(swept, normalization, t)
            assert (
                x_low
                <= (x - normalization.center[0]) / QQ(2) ** normalization.scale[0] - dx
                <= x_high
            )
            assert (
                y_low
                <= (y - normalization.center[1]) / QQ(2) ** normalization.scale[1] - dy
                <= y_high
            )


def drift_at(swept, normalization, t):
    """How far the boxes have drifted at a time, exactly."""
    t = (t - normalization.origin) / QQ(2) ** normalization.time_scale
    return [
        sum(QQ(*c.as_integer_ratio()) * t**i for i, c in enumerate(row.tolist()))
        for row in swept.drift
    ]


def test_what_all_have_in_common_moves_no_box():
    """A convoy: each box is as if its body were at rest."""
    tracks = [
        Body("a", [(3 * i, i)], Translation([0, 5, "1/3"], [0, -7]))
        .exact_piece_after(QQ(0))
        .tracks[0]
        for i in range(5)
    ]
    normalization = normalization_for([(QQ(0), QQ(0)), (QQ(12), QQ(4))], QQ(0), QQ(1000))
    enclosures = Enclosures(normalization)

    swept = SweptBoxes(enclosures.float_tracks(tracks), enclosures.errors)

    for i, box in enumerate(swept.during(0.0, 1000.0).tolist()):
        assert [round(v, 6) for v in box] == [3 * i, 3 * i, i, i]
    here, there = swept.places([0.0, 1000.0])
    assert there == pytest.approx(here, abs=1e-6)


@pytest.mark.long("5-5", "5-7", "5-9", "5-11", "5-13")
@pytest.mark.parametrize("numerator", [5, 7, 9, 11, 13])
@pytest.mark.parametrize("bits", [5, 12, 40, 79])
def test_boxes_contain_what_underflows(bits, numerator):
    """t^n between 2^-1074 and 2^-1060, in an interval as narrow as doubles allow."""
    t = QQ(numerator, 8 << bits)
    for degree in range(1060 // bits - 1, 1074 // bits + 2):
        power = Body("a", [(0, 0)], Translation([0] * degree + [1]))
        normalization = normalization_for([(QQ(0), QQ(0))], QQ(0), QQ(1))
        enclosures = Enclosures(normalization)
        float_track = enclosures.float_tracks([power.exact_piece_after(QQ(0)).tracks[0]])[0]
        low, high = normalization.time(t)[0], normalization.time(t * (1 + QQ(1, 1 << 50)))[1]

        rest = enclosures.float_tracks([Body("b", [(0, 0)]).exact_piece_after(QQ(0)).tracks[0]])[0]
        swept = SweptBoxes([float_track, rest, rest], enclosures.errors)
        x_low, x_high, *_ = swept.during(low, high)[0].tolist()

        assert x_low <= t**degree <= x_high


def test_boxes_are_tight():
    """Of a line: its ends; of a turn: what the bounds of numerator and denominator allow."""
    line = Body("a", [(0, 0)], Translation([0, 1], [0, -2])).exact_piece_after(QQ(0)).tracks[0]
    turn = Body("a", [(1, 0)], Rigid([0, Fraction(1, 4)])).exact_piece_after(QQ(0)).tracks[0]
    normalization = normalization_for([(QQ(0), QQ(0)), (QQ(2), QQ(2))], QQ(0), QQ(1))
    enclosures = Enclosures(normalization)
    assert normalization.point((QQ(1, 2), QQ(1, 2))) == (0.5, 0.5)

    rest = Body("b", [(1, 1)]).exact_piece_after(QQ(0)).tracks[0]
    float_tracks = enclosures.float_tracks([line, turn, rest, rest])
    boxes = SweptBoxes(float_tracks, enclosures.errors).during(0.0, 1.0)

    assert [round(v, 9) for v in boxes[0].tolist()] == [0, 1, -2, 0]
    x_low, x_high, y_low, y_high = boxes[1].tolist()
    assert 0.8 < x_low < x_high < 1.1
    assert -0.1 < y_low < y_high < 0.6


def test_what_cannot_be_bounded_has_the_whole_plane():
    """Coefficients out of the range of doubles, and denominators that are not surely positive."""
    huge = Body("a", [(0, 0)], Translation([0, QQ(2) ** 300])).exact_piece_after(QQ(0)).tracks[0]
    spin = Body("b", [(1, 0)], Rigid([0, 1])).exact_piece_after(QQ(0)).tracks[0]
    rest = Body("c", [(1, 1)]).exact_piece_after(QQ(0)).tracks[0]
    normalization = normalization_for([(QQ(0), QQ(0)), (QQ(1), QQ(1))], QQ(0), QQ(100))
    enclosures = Enclosures(normalization)
    float_tracks = enclosures.float_tracks([huge, spin, rest])

    boxes = SweptBoxes(float_tracks, enclosures.errors).during(-50.0, 50.0).tolist()

    inf = float("inf")
    assert boxes[0] == boxes[1] == [-inf, inf, -inf, inf]
    assert boxes[2][1] < inf
