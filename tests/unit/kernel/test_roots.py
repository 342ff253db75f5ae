"""The roots after a time: all of them, from left to right, and which are crossings."""

import math
from itertools import islice

import pytest
from folding import every
from hypothesis import example, given
from hypothesis import strategies as st
from strategies import (
    algebraics,
    as_int_poly,
    as_rational,
    fractions,
    int_polys,
    planted_polys,
    raw_polys,
    times,
)

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import common_roots, roots_after
from fuzz.references.real_roots import (
    compare,
    compare_with_rational,
    is_root,
    real_roots,
    sign_just_after,
)

nonzero = int_polys.filter(bool)


def expected_roots(f, start, until):
    """Those in (start, until]: (root, crossing)."""
    return [
        (r, r.multiplicity % 2 == 1)
        for r in real_roots(f)
        if compare(r, start) > 0 and compare_with_rational(r, until) <= 0
    ]


def assert_same(found, expected):
    assert [r.crossing for r in found] == [crossing for _, crossing in expected]
    for r, (root, _) in zip(found, expected, strict=True):
        assert is_root(r.time.polynomial, r.time.low, r.time.high, root)


@st.composite
def cases(draw):
    """f, a start (pair), a rational end; both ends are often roots of f."""
    f = draw(nonzero)
    start, twin = draw(algebraics())
    if draw(st.booleans()):
        f = times(f, *[twin.factor] * draw(st.integers(1, 3)))
    until = draw(fractions)
    rationals = [r.low for r in real_roots(f) if r.is_rational]
    if rationals and draw(st.booleans()):
        until = draw(st.sampled_from(rationals))
    return f, start, twin, until


@given(case=cases())
def test_roots_after(case):
    f, start, twin, until = case

    found = list(roots_after(as_int_poly(f), start, as_rational(until)))

    assert_same(found, expected_roots(f, twin, until))


@given(case=cases(), count=st.integers(0, 2))
def test_the_first_roots_are_the_same_when_the_rest_is_not_asked_for(case, count):
    f, start, twin, until = case

    found = list(islice(roots_after(as_int_poly(f), start, as_rational(until)), count))

    assert_same(found, expected_roots(f, twin, until)[:count])


@given(f=raw_polys(3).filter(bool), start=fractions, until=fractions)
@example(f=(-2, 0, 1), start=-2, until=2)
@example(f=(2, 0, -1), start=-2, until=2)
@example(f=(-1, 2, -1), start=0, until=1)
@example(f=(1, -2, 1), start=0, until=1)
@example(f=(1, -2, 1), start=1, until=3)
@example(f=(3, -4, 1), start=1, until=3)
@example(f=(-3, 4, -1), start=0, until=1)
def test_degrees_up_to_two(f, start, until):
    x, twin = (
        AlgebraicNumber(as_rational(start)),
        real_roots((-start.numerator, start.denominator))[0],
    )

    found = list(roots_after(as_int_poly(f), x, as_rational(until)))

    assert_same(found, expected_roots(f, twin, until))


@given(f=planted_polys(), case=algebraics())
def test_the_sign_alternates_at_crossings_only(f, case):
    """The signs right after the start and after each root follow the crossing flags."""
    start, twin = case
    p = as_int_poly(f)
    sign = sign_just_after(f, twin)
    assert start.sign_after(p) == sign

    for root in roots_after(p, start, QQ(1000)):
        sign = -sign if root.crossing else sign
        assert root.time.sign_after(p) == sign


@given(f=nonzero, case=algebraics())
def test_an_empty_span_has_no_roots(f, case):
    start, twin = case
    twin.refine_to(1)
    until = as_rational(twin.low)

    assert list(roots_after(as_int_poly(f), start, until)) == []


def test_a_start_on_a_root_of_every_multiplicity():
    for power in range(1, 5):
        f = as_int_poly(times(*[(-1, 1)] * power, (-2, 0, 1)))

        (root,) = roots_after(f, AlgebraicNumber(1), QQ(2))

        assert root.crossing
        assert float(root.time) == pytest.approx(2**0.5)


def test_a_start_just_beside_a_root():
    """2^-200 before it, on it, 2^-200 after it."""
    f = as_int_poly(times((-1, 3), (-1, 3), (-1, 3), (1, 0, 1)))
    third, bit = QQ(1, 3), QQ(1, 2**200)

    assert [r.time for r in roots_after(f, AlgebraicNumber(third - bit), QQ(1))] == [third]
    assert list(roots_after(f, AlgebraicNumber(third), QQ(1))) == []
    assert list(roots_after(f, AlgebraicNumber(third + bit), QQ(1))) == []


def test_an_end_just_beside_a_root():
    f = as_int_poly(times((-1, 3), (-1, 3), (1, 0, 1)))
    zero, third, bit = AlgebraicNumber(0), QQ(1, 3), QQ(1, 2**200)

    assert list(roots_after(f, zero, third - bit)) == []
    assert [(r.time, r.crossing) for r in roots_after(f, zero, third)] == [(third, False)]
    assert [r.time for r in roots_after(f, zero, third + bit)] == [third]


@pytest.mark.long
@given(f=raw_polys(4), g=raw_polys(4), h=planted_polys(2, 2), case=algebraics(), until=fractions)
def test_common_roots(f, g, h, case, until):
    start, twin = case
    f, g = times(f, h), times(g, h)
    expected = []
    if any(f) or any(g):
        one, other = real_roots(f or g), real_roots(g or f)
        expected = [
            r
            for r in one
            if any(r.same(s) for s in other)
            and compare(r, twin) > 0
            and compare_with_rational(r, until) <= 0
        ]

    found = list(common_roots(as_int_poly(f), as_int_poly(g), start, as_rational(until)))

    assert len(found) == len(expected)
    for r, root in zip(found, expected, strict=True):
        assert is_root(r.time.polynomial, r.time.low, r.time.high, root)


def test_roots_that_descartes_leaves_to_sturm_are_the_same():
    """Simple, double and triple ones next to each other, on a grid and beside it."""
    near = 2**40 + 1
    f = times((-1, 3), (-1, 3), (-near, 3 * 2**40), (-1, 2), (-1, 2), (-1, 2), (-5, 8))
    found = list(roots_after(as_int_poly(f), AlgebraicNumber(0), QQ(1)))

    assert [(r.time.simplified().low, r.crossing) for r in found] == [
        (QQ(1, 3), False),
        (QQ(near, 3 * 2**40), True),
        (QQ(1, 2), True),
        (QQ(5, 8), True),
    ]


@every("c2", [1, -1, 3, -(10**30)])
@every("shift", [0, 10**25, -(10**25)])
def test_surds_are_enclosed_by_neighbouring_doubles(c2, shift):
    """c2 ((t - shift)^2 - 2), also where the roots cannot be told from shift by doubles."""
    f = as_int_poly([c2 * (shift**2 - 2), -2 * c2 * shift, c2])
    low, high = (r.time for r in roots_after(f, AlgebraicNumber(shift - 2), QQ(shift + 2)))

    assert low < shift < high
    assert (low.polynomial, high.polynomial) == (as_int_poly([shift**2 - 2, -2 * shift, 1]),) * 2
    for root in (low, high):
        below, above = root.enclosure()
        assert QQ(below) <= root <= QQ(above)
        assert above == math.nextafter(below, math.inf)
