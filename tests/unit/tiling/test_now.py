"""Predicates of moving vertices at one time, against `Fraction` at that time and near it."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from moving import (
    END,
    START,
    affine,
    linear,
    parabolic,
    place,
    sign,
    times,
    turn,
    turning,
    vertices,
)

from exactpt import AlgebraicNumber, Body, Translation
from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier, least_first
from exactpt.certificates.coincidence import (
    boxes_now,
    coincide,
    coordinate_order,
    lies_on,
    nearer,
    nearer_copy,
    strictly_between,
)
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.perturbation import orientation_polynomial
from exactpt.certificates.queue import EventTime
from exactpt.kernel.numbers import QQ
from exactpt.kernel.rounding import INFINITY
from exactpt.motion.vertices import Vertices

any_motion = st.one_of(linear, parabolic, turning, affine)
TINY = QQ(1, 10**40)
"""Before a sign changes; coefficients and times are small."""


def certifier_at(moving, t, *, exact_only=False):
    certifier = Certifier(moving, START, END, exact_only=exact_only)
    low, high = moving.normalization.time(t)
    certifier.move_to(EventTime(low, high, -1, -1, -1, AlgebraicNumber(t)), [])
    return certifier


@pytest.mark.long
@given(vertices(any_motion), times, st.booleans())
def test_the_order_of_coordinates_now(moving, t, exact_only):
    certifier = certifier_at(moving, t, exact_only=exact_only)
    for a, b in product(moving.all, repeat=2):
        p, q = place(a, t), place(b, t)

        assert coordinate_order(certifier, a, b, 0) == sign(q[0] - p[0])
        assert coordinate_order(certifier, a, b, 1) == sign(q[1] - p[1])
        assert coincide(certifier, a, b) == (p == q)


@pytest.mark.long
@given(vertices(any_motion), times)
def test_the_filter_of_coordinates_is_right_at_irrational_times_too(moving, t):
    """Its sign holds all through the enclosure of now."""
    certifier = certifier_at(moving, t)
    low, high = moving.normalization.time(t)
    certifier.move_to(EventTime(low, high + 2.0**-20, -1, -1, -1, AlgebraicNumber(t)), [])
    ends = [moving.normalization.exact_time(x) for x in (low, high + 2.0**-20)]
    for a, b in product(moving.all, repeat=2):
        for axis in (0, 1):
            s = coordinate_order(certifier, a, b, axis)
            around = {sign(place(b, e)[axis] - place(a, e)[axis]) for e in ends}
            if len(around) == 1 and 0 not in around:
                assert s in around


def on_one_line(moving, t):
    """Triples of vertices on one line then, most of them of one body or two."""
    return [abc for abc in permutations(list(moving.all)[:7], 3) if turn(abc, t) == 0]


@pytest.mark.long
@given(vertices(st.one_of(linear, turning)), times)
def test_between_and_nearer_on_a_line(moving, t):
    certifier = certifier_at(moving, t)
    instant = PredicatesAt(moving, t)
    for a, p, b in on_one_line(moving, t):
        u, v, w = place(a, t), place(p, t), place(b, t)
        # (u - v) . (w - v): negative if v is between them
        dot = sum((x - y) * (z - y) for x, y, z in zip(u, v, w, strict=True))
        if a.track is not p.track and p.track is not b.track:
            assert strictly_between(certifier, a, p, b) == (dot < 0)
        else:
            far, copy = (b, a) if a.track is p.track else (a, b)
            (px, py), (ax, ay) = instant.offset(p.id), instant.offset(copy.id)
            (x, y), (far_x, far_y) = place(p, t), place(far, t)
            towards = (px - ax) * (far_x - x) + (py - ay) * (far_y - y) > 0
            assert strictly_between(certifier, a, p, b) == towards
        assert lies_on(certifier, p, a, b) == (dot <= 0)
        if dot >= 0:  # in one direction from p, or there
            far = sum((x - y) ** 2 for x, y in zip(u, v, strict=True))
            further = sum((x - y) ** 2 for x, y in zip(w, v, strict=True))
            assert nearer(certifier, p, a, b) == sign(further - far)


@pytest.mark.long
@given(vertices(st.one_of(linear, turning)), times)
def test_the_nearer_copy_is_the_one_whose_offset_points_there(moving, t):
    certifier = certifier_at(moving, t)
    instant = PredicatesAt(moving, t)
    for p, a, b in permutations(list(moving.all)[:7], 3):
        if a.track is not b.track:
            assert nearer_copy(certifier, p, a, b) == 0
            continue
        (ax, ay), (bx, by) = instant.offset(a.id), instant.offset(b.id)
        u, v = place(a, t), place(p, t)
        expected = sign((ax - bx) * QQ(v[0] - u[0]) + (ay - by) * QQ(v[1] - u[1]))
        assert nearer_copy(certifier, p, a, b) == expected


@pytest.mark.long
@given(vertices(any_motion), times)
def test_boxes_contain_what_is_there_now(moving, t):
    boxes = boxes_now(certifier_at(moving, t), moving.all)
    for vertex, (x_low, x_high, y_low, y_high) in zip(moving.all, boxes.tolist(), strict=True):
        x, y = vertex.track.at(t)
        normalization = moving.normalization
        for value, low, high, k in ((x, x_low, x_high, 0), (y, y_low, y_high, 1)):
            in_frame = (value - normalization.center[k]) / QQ(2) ** normalization.scale[k]
            assert low <= in_frame <= high


@pytest.mark.long
@given(vertices(st.one_of(linear, parabolic, affine)), times, st.booleans())
def test_signs_just_before_and_just_after_now(moving, t, before):
    certifier = certifier_at(moving, t)
    moment = OneSided(certifier, before=before)
    near = t - TINY if before else t + TINY
    for a, b, c in permutations(list(moving.all)[:6], 3):
        if len({id(v.track) for v in (a, b, c)}) == 3:
            assert moment.orientation(a.id, b.id, c.id) == turn((a, b, c), near)
        p, q = place(a, near), place(b, near)
        if p != q:
            assert moment.left_of(a.id, b.id) == ((p[0], -p[1]) < (q[0], -q[1]))
        (p, q), (r, s) = ((place(u, near), place(v, near)) for u, v in ((a, b), (b, c)))
        cross = (q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0])
        assert moment.cross_sign(a.id, b.id, b.id, c.id) == sign(cross)


@pytest.mark.long
@given(vertices(any_motion), times, st.booleans())
def test_signs_at_an_instant(moving, t, after):
    """At the time itself, or just after it; with the filter, without it, and exactly."""
    instants = [PredicatesAt(moving, t, after=after, exact_only=exact) for exact in (False, True)]
    for a, b, c in permutations(list(moving.all)[:6], 3):
        f = orientation_polynomial(a, b, c)
        exactly = instants[0].first_sign((f,))
        assert [i.orientation(a.id, b.id, c.id) for i in instants] == [exactly] * 2
        if len({id(v.track) for v in (a, b, c)}) == 3 and not after:
            assert exactly == turn((a, b, c), t)


@pytest.mark.long
@given(vertices(linear, least=4), times)
def test_many_certificates_at_once(moving, t):
    """The sign holds up to the returned time, at which the orientation vanishes."""
    certifier = certifier_at(moving, t)
    triples = [tuple(v.id for v in abc) for abc in permutations(moving.all, 3)]
    triples = triples[:: max(1, len(triples) // 60)]
    rows = np.array([least_first(*triple) for triple in triples])
    signs, lows, highs = certifier.orientations(rows)
    assert certifier.made == np.count_nonzero(signs)
    for (a, b, c), s, low, high in zip(rows.tolist(), signs, lows, highs, strict=True):
        abc = [list(moving.all)[i] for i in (a, b, c)]
        if len({id(v.track) for v in abc}) < 3 or s == 0:
            continue
        time = None if low == INFINITY else EventTime(low, high, a, b, c)
        until = END if time is None else min(END, moving.normalization.exact_time(time.low))
        if until > t:
            assert {turn(abc, t + (until - t) * QQ(k, 7)) for k in range(1, 7)} == {s}
        if time is not None:
            number = time.exact or certifier.resolve(time)
            assert number.compare_rational(t) > 0
            if number.is_rational:
                assert turn(abc, number.low) == 0
            else:
                assert turn(abc, number.low) * turn(abc, number.high) <= 0


@pytest.mark.parametrize("before", [False, True])
@pytest.mark.parametrize("exact_only", [False, True])
def test_left_and_right_are_told_apart_now(before, exact_only):
    places = [(0, 5), (0, 0), (1, 7)]  # of equal x, the upper one is on the left
    bodies = [Body(str(i), [p], Translation([], [0, i])) for i, p in enumerate(places)]
    moving = Vertices.of(bodies, START, END, plain=True)
    moment = OneSided(certifier_at(moving, START, exact_only=exact_only), before=before)

    for a, b in permutations(range(3), 2):
        assert moment.left_of(a, b) == (a < b)
