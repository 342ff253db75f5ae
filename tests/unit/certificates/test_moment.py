"""Exact times of events from their enclosures: a forged one is refused, a straight one is short.

Enclosures are read from saved runs; no run makes one without a root.
"""

import pytest

from exactpt import AuditError, Body, Translation
from exactpt.certificates.moment import exact_time
from exactpt.certificates.queue import EventTime
from exactpt.kernel.numbers import QQ
from exactpt.motion.normalization import Normalization

FRAME = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)


def test_straight_vertices_need_no_trajectories():
    """1/2 + t = 3 - t/3 at t = 15/8."""
    bodies = [
        Body("a", [(0.5, 0)], Translation([0, 1])),
        Body("b", [(3, 0)], Translation([0, "-1/3"])),
    ]
    p, q = (body.exact_piece_after(QQ(0)) for body in bodies)

    number = exact_time(EventTime(0.0, 9.0, 0, 1, -1), ((p, 0), (q, 0)), FRAME)

    assert number.low == number.high == QQ(15, 8)
    assert not p._made
    assert not q._made


@pytest.mark.parametrize("enclosure", [(0.5, 1.0), (-5.0, -4.0), (-2.0, 2.0)])
def test_bug_enclosures_without_a_single_root_are_refused(enclosure):
    """The roots are -+sqrt(3/2); refinement of a forged time, as by ``float(now)``, had no end."""
    x = Body("x", [(0, 0)], Translation([], [-3, 0, 2]))
    others = Body("o", [(1, 0), (2, 0)], closed=False)
    piece, other = x.exact_piece_after(QQ(0)), others.exact_piece_after(QQ(0))
    vertices = ((piece, 0), (other, 0), (other, 1))

    with pytest.raises(AuditError, match="no failure between"):
        exact_time(EventTime(*enclosure, 0, 1, 2), vertices, FRAME)

    number = exact_time(EventTime(1.0, 2.0, 0, 1, 2), vertices, FRAME)
    assert number.polynomial == (-3, 0, 2)
