"""Predicates at an instant: with the float filter they answer as they do without it."""

from fractions import Fraction
from itertools import permutations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from moving import END, START, affine, linear, parabolic, place, sign, times, turning, vertices

from exactpt import Body, Translation
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices

any_motion = st.one_of(linear, parabolic, turning, affine)
far = st.sampled_from([0, 1, -(10**6), 2**53 + 1, 10**40])
steps = st.sampled_from([0, 1, 2, QQ(1, 3), QQ(1, 10**9), QQ(1, 10**16), QQ(1, 2**60)])


@st.composite
def close_points(draw):
    """Points so near to a grid, or so far away, that doubles may not tell them apart."""
    x, y, v = draw(far), draw(far), draw(far)
    bodies = [
        Body(str(i), [(x + draw(steps), y + draw(steps))], Translation([0, v + draw(steps)]))
        for i in range(5)
    ]
    return Vertices.of(bodies, START, END, plain=True)


scenes = st.one_of(close_points(), vertices(any_motion))


def both(moving, t, after):
    return [PredicatesAt(moving, t, after=after, exact_only=exact) for exact in (False, True)]


@pytest.mark.long
@given(scenes, times, st.booleans())
def test_signs_of_many_triples(moving, t, after):
    fast, exact = both(moving, t, after)
    triples = list(permutations([v.id for v in list(moving.all)[:7]], 3))

    expected = [exact.orientation(*triple) for triple in triples]

    assert fast.signs(triples) == exact.signs(triples) == expected
    assert [fast.orientation(*triple) for triple in triples] == expected
    assert fast.signs([]) == []


@pytest.mark.long
@given(scenes, times, st.booleans())
def test_the_order_from_left_to_right(moving, t, after):
    fast, exact = both(moving, t, after)
    ids = [v.id for v in moving.all]

    for a, b in permutations(ids, 2):
        assert fast.left_of(a, b) == exact.left_of(a, b)
    assert fast.sorted_by_x(ids) == exact.sorted_by_x(ids)


@pytest.mark.long
@given(scenes, times, st.booleans())
def test_turns_of_directions(moving, t, after):
    fast, exact = both(moving, t, after)
    ids = [v.id for v in list(moving.all)[:4]]

    for a, b, c, d in product(ids, repeat=4):
        assert fast.cross_sign(a, b, c, d) == exact.cross_sign(a, b, c, d)
        assert fast.cross_sign_now(a, b, c, d) == exact.cross_sign_now(a, b, c, d)


@pytest.mark.long
@given(scenes, times)
def test_descents_are_never_in_the_wrong_order(moving, t):
    fast, exact = both(moving, t, after=False)
    slopes = []
    for a, b in permutations(moving.all, 2):
        (ax, ay), (bx, by) = place(a, t), place(b, t)
        if ax < bx or (ax == bx and ay != by):
            descent = fast.descent(a.id, b.id)
            assert descent == exact.descent(a.id, b.id)
            steep = (0, (ay - by) / (bx - ax)) if ax < bx else (sign(ay - by), Fraction(0))
            slopes.append((steep, descent))

    for (steep, p), (less_steep, q) in product(slopes, repeat=2):
        assert p <= q or steep > less_steep


def test_clear_predicates_are_decided_by_floats():
    bodies = [
        Body("a", [(0, 0), (4, 0), (0, 3)], Translation([0, 1], [0, -2])),
        Body("b", [(9, 1), (12, 2), (10, 5)], Translation([0, "1/3"])),
    ]
    moving = Vertices.of(bodies, START, END)
    instant = PredicatesAt(moving, QQ(1, 3))

    instant.signs(list(permutations(range(6), 3)))
    instant.sorted_by_x(range(6))
    for a, b in permutations(range(6), 2):
        instant.left_of(a, b)
        instant.cross_sign(0, 5, a, b)
        if instant.left_of(a, b):
            instant.descent(a, b)

    # Vertices 0 and 2 have one x for ever; 0 turns 5 to itself twice, and once backwards.
    assert moving.counters.exact <= 8
