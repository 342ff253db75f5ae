"""Exact times of x-orders, without trajectories where positions are doubles."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from exactpt import Body, Rigid, Translation
from exactpt.certificates.moment import exact_time
from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.normalization import Normalization, normalization_for

ordinary = st.floats(-1e6, 1e6) | st.integers(-100, 100) | st.fractions(-9, 9, max_denominator=9)
FRAME = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
paths = st.lists(ordinary, max_size=2)


def pieces(a, b):
    bodies = (
        Body(name, [(x, 0)], Translation(path))
        for name, (x, path) in zip("ab", (a, b), strict=True)
    )
    return [(body._piece_after(QQ(0)), 0) for body in bodies]


@pytest.mark.long
@given(x=ordinary, y=ordinary, u=paths, v=paths, start=st.integers(-5, 5))
def test_two_vertices_cross_when_their_trajectories_do(x, y, u, v, start):
    (p, _), (q, _) = both = pieces((x, u), (y, v))
    a, b = p.track(0), q.track(0)
    rates = [QQ(t.x[1], t.w[0]) if len(t.x) > 1 else QQ(0) for t in (a, b)]
    assume(rates[0] != rates[1])
    normalization = normalization_for([a._at(QQ(0)), b._at(QQ(0))], QQ(start), QQ(start + 7))

    number = exact_time(EventTime(0.0, 0.0, 0, 1, -1), tuple(both), normalization)

    assert a.at(number.low)[0] == b.at(number.low)[0]
    assert number.is_rational


@pytest.mark.parametrize(
    ("x", "motion"),
    [("1/3", Translation([0, 1])), (1, Translation([0, 1, 1])), (1, Rigid([0, 1]))],
)
def test_others_have_no_straight_x(x, motion):
    piece = Body("a", [(x, 0), (2, 3)], motion, closed=False)._piece_after(QQ(0))

    assert piece.straight_x(0) is None


def test_straight_vertices_need_no_trajectories():
    (p, _), (q, _) = both = pieces((0.5, [0, 1]), (3, [0, "-1/3"]))

    number = exact_time(EventTime(0.0, 9.0, 0, 1, -1), tuple(both), FRAME)

    assert number.low == number.high == QQ(15, 8)
    assert not p._made
    assert not q._made


@pytest.mark.parametrize("enclosure", [(0.5, 1.0), (-5.0, -4.0), (-2.0, 2.0)])
def test_enclosures_without_a_single_root_are_refused(enclosure):
    """The roots are -+sqrt(3/2); refinement of a forged time, as by ``float(now)``, had no end."""
    x = Body("x", [(0, 0)], Translation([], [-3, 0, 2]))
    others = Body("o", [(1, 0), (2, 0)], closed=False)
    piece, other = x._piece_after(QQ(0)), others._piece_after(QQ(0))
    vertices = ((piece, 0), (other, 0), (other, 1))

    with pytest.raises(AuditError, match="no failure between"):
        exact_time(EventTime(*enclosure, 0, 1, 2), vertices, FRAME)

    number = exact_time(EventTime(1.0, 2.0, 0, 1, 2), vertices, FRAME)
    assert number.polynomial == (-3, 0, 2)
