"""Certificates of positions in doubles: coefficients and exact times."""

from itertools import islice, permutations
from random import Random

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from exactpt import AuditError, Body, Rigid, Translation
from exactpt.certificates import coefficients
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.moment import exact_time
from exactpt.certificates.queue import EventTime
from exactpt.kernel.numbers import QQ
from exactpt.kernel.rounding import INFINITY
from exactpt.motion.normalization import Normalization, normalization_for
from exactpt.motion.vertices import HORIZON, MOTION, OTHER_MOTION, WIDTH, Vertices
from exactpt.testing.scenes import FAMILIES, generate


def place_of(vertices, v):
    return list(vertices.places[WIDTH * v : WIDTH * v + MOTION + 1])


def check_places(vertices):
    """Compare all places with the vertices; return the number of those in linear translation."""
    assert len(vertices.places) == WIDTH * len(vertices.all)
    count = 0
    for vertex in vertices.all:
        place, float_track = place_of(vertices, vertex.id), vertex.float_track
        is_plain = vertex.body >= 0 and vertex.offset is None and float_track.degree <= 1
        if not is_plain or float_track.ws:
            assert place[MOTION] == OTHER_MOTION
            continue
        count += 1
        coefficients = [float_track.x0, float_track.y0, float_track.x1, float_track.y1]
        until = vertex.moving.until
        horizon = INFINITY if until is None else vertices.normalization.time(until)[1]
        expected = [*coefficients, horizon, float(float_track.motion)]
        assert [str(value) for value in place] == [str(value) for value in expected]
    return count


def vertices_of(scene):
    return Vertices.of(scene.bodies, scene.exact_start, scene.exact_end)


def test_places_of_every_family_equal_the_images():
    counts = {family: check_places(vertices_of(generate(family, 0))) for family in FAMILIES}

    vertices = {family: len(vertices_of(generate(family, 0)).all) for family in FAMILIES}
    assert counts["convex"] == vertices["convex"]
    assert 0 < counts["turning"] < vertices["turning"]
    assert counts["ballistic"] == counts["chains"] == 0


@pytest.mark.parametrize("family", ["convex", "pieces", "mixed_shapes", "deforming", "chains"])
def test_places_follow_pieces_additions_and_removals(family):
    scene, other = generate(family, 1), generate("convex", 2)
    vertices = vertices_of(scene)
    middle = (scene.exact_start + scene.exact_end) / 2

    for i in range(len(vertices.bodies)):
        vertices.enter_piece(i, middle)
    check_places(vertices)
    before = len(vertices.all)
    vertices.remove(0)
    check_places(vertices)
    for body in other.bodies:
        vertices.add(body, other.exact_start)
        check_places(vertices)
    assert len(vertices.all) > before


@pytest.mark.parametrize("family", FAMILIES)
def test_answers_by_places_equal_those_by_images(family):
    """The two ways to the coefficients lead to one formula: equal bits."""
    scene = generate(family, 3)
    vertices = vertices_of(scene)
    certifier = Certifier(vertices, scene.exact_start, scene.exact_end, exact_only=False)
    ids = vertices.ids()
    Random(family).shuffle(ids)
    for a, b, c in islice(permutations(ids, 3), 300):
        if min(a, b, c) != a:
            continue
        va, vb, vc = (vertices.all[v] for v in (a, b, c))
        horizon = min(certifier._end_high, *(place_of(vertices, v)[HORIZON] for v in (a, b, c)))
        now = certifier.now_low, certifier.now_high
        if not (va.is_copy_of(vb) or vb.is_copy_of(vc) or va.is_copy_of(vc)):
            float_tracks = va.float_track, vb.float_track, vc.float_track
            s, low, high = coefficients.orientation(
                *float_tracks, certifier.errors, *now, horizon, at_root=False
            )
            known = (s, low, high) if low <= horizon else (s, INFINITY, INFINITY)
            assert certifier.filtered_orientation(a, b, c) == known
        if not va.is_copy_of(vb):
            horizon = min(certifier._end_high, *(place_of(vertices, v)[HORIZON] for v in (a, b)))
            s, low, high = coefficients.x_difference(
                va.float_track, vb.float_track, certifier.errors, *now, horizon, at_root=False
            )
            known = (s, low, high) if low <= horizon else (s, INFINITY, INFINITY)
            assert certifier.filtered_x_order(a, b) == known


# Exact times of x-orders, without trajectories where positions are doubles

ordinary = st.floats(-1e6, 1e6) | st.integers(-100, 100) | st.fractions(-9, 9, max_denominator=9)
FRAME = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
paths = st.lists(ordinary, max_size=2)


def pieces(a, b):
    bodies = (
        Body(name, [(x, 0)], Translation(path))
        for name, (x, path) in zip("ab", (a, b), strict=True)
    )
    return [(body.exact_piece_after(QQ(0)), 0) for body in bodies]


@pytest.mark.long
@given(x=ordinary, y=ordinary, u=paths, v=paths, start=st.integers(-5, 5))
def test_two_vertices_cross_when_their_trajectories_do(x, y, u, v, start):
    (p, _), (q, _) = both = pieces((x, u), (y, v))
    a, b = p.track(0), q.track(0)
    rates = [QQ(t.x[1], t.w[0]) if len(t.x) > 1 else QQ(0) for t in (a, b)]
    assume(rates[0] != rates[1])
    normalization = normalization_for(
        [a.exact_at(QQ(0)), b.exact_at(QQ(0))], QQ(start), QQ(start + 7)
    )

    number = exact_time(EventTime(0.0, 0.0, 0, 1, -1), tuple(both), normalization)

    assert a.at(number.low)[0] == b.at(number.low)[0]
    assert number.is_rational


@pytest.mark.parametrize(
    ("x", "motion"),
    [("1/3", Translation([0, 1])), (1, Translation([0, 1, 1])), (1, Rigid([0, 1]))],
)
def test_others_have_no_straight_x(x, motion):
    piece = Body("a", [(x, 0), (2, 3)], motion, closed=False).exact_piece_after(QQ(0))

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
    piece, other = x.exact_piece_after(QQ(0)), others.exact_piece_after(QQ(0))
    vertices = ((piece, 0), (other, 0), (other, 1))

    with pytest.raises(AuditError, match="no failure between"):
        exact_time(EventTime(*enclosure, 0, 1, 2), vertices, FRAME)

    number = exact_time(EventTime(1.0, 2.0, 0, 1, 2), vertices, FRAME)
    assert number.polynomial == (-3, 0, 2)
