"""Polynomials packed into integers, against arithmetic coefficient by coefficient."""

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st

from exactpt.certificates.perturbation import copy_orientation, cross
from exactpt.kernel.integer_polynomial import (
    add,
    coefficient_bits,
    multiply,
    negate,
    pack,
    subtract,
    trimmed,
    unpack,
    width_for,
)
from exactpt.kernel.numbers import ZZ
from exactpt.motion.body import Body
from exactpt.motion.track import Track, orientation_polynomial
from exactpt.motion.vertex import MovingBody, Vertex

numbers = st.one_of(
    st.integers(-3, 3),
    st.builds(lambda k, d, s: s * (2**k + d), st.integers(1, 200), st.sampled_from([-1, 0, 1]),
              st.sampled_from([-1, 1])),
)  # fmt: skip
polynomials = st.lists(numbers.map(ZZ), max_size=5).map(trimmed)
tracks = st.builds(Track, polynomials, polynomials, polynomials.filter(bool), st.none())


def difference(p, pw, q, qw):
    return subtract(multiply(q, pw), multiply(p, qw))


def cross_of(u, v):
    return subtract(multiply(u[0], v[1]), multiply(u[1], v[0]))


def towards(p, q):
    return difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)


@given(f=polynomials, slack=st.integers(0, 2))
def test_what_is_packed_is_unpacked(f, slack):
    width = coefficient_bits(f) + 1 + slack
    assert unpack(pack(f, width), width, len(f) + slack + 1) == f


@pytest.mark.long
@given(a=tracks, b=tracks, c=tracks, d=tracks)
def test_determinants_of_tracks(a, b, c, d):
    expected = add(
        add(multiply(a.x, difference(c.y, c.w, b.y, b.w)),
            multiply(b.x, difference(a.y, a.w, c.y, c.w))),
        multiply(c.x, difference(b.y, b.w, a.y, a.w)),
    )  # fmt: skip
    assert orientation_polynomial(a, b, c) == expected
    assert cross(a, b, c, d) == cross_of(towards(a, b), towards(c, d))


def body_with(track):
    """A body whose vertex 0 has this trajectory."""
    moving = MovingBody([Body("point", [(0, 0)])], 0)
    moving.piece._made[0] = track
    return moving


@pytest.mark.long
@given(a=tracks, c=tracks, offsets=st.tuples(*[polynomials] * 4))
def test_the_orientation_of_copies(a, c, offsets):
    moving = body_with(a)
    copies = [Vertex(i, 0, moving) for i in (0, 1)]
    other = Vertex(2, 0, body_with(c))
    copies[0].offset, copies[1].offset = offsets[:2], offsets[2:]
    turned = subtract(offsets[2], offsets[0]), subtract(offsets[3], offsets[1])
    expected = cross_of(turned, towards(a, c))
    assert copy_orientation(copies[0], copies[1], other) == expected
    assert copy_orientation(copies[1], copies[0], other) == negate(expected)


@every("bits", [1, 5, 64, 1000])
@every("length", [1, 2, 7])
def test_the_largest_coefficients_of_either_sign_fit(bits, length):
    """All products of a determinant reinforce each other in the middle coefficients."""
    top = (ZZ(2) ** bits - 1,) * length
    bottom = negate(top)
    tracks = [Track(x, y, w, None) for x, y, w in ((top, bottom, top), (top, top, bottom))]
    a, b = tracks
    c = Track(bottom, top, top, None)
    for p, q, r in ((a, b, c), (b, a, c), (c, c, a), (a, c, b)):
        total = ()
        for i, j, k in ((p, q, r), (q, r, p), (r, p, q)):
            minor = subtract(multiply(j.y, k.w), multiply(k.y, j.w))
            total = add(total, multiply(i.x, minor))
        assert orientation_polynomial(p, q, r) == total
        for s in (a, b, c):
            assert cross(p, q, r, s) == cross_of(towards(p, q), towards(r, s))


@pytest.mark.parametrize("factors", [3, 4])
def test_the_width_holds_eight_products_that_add_up(factors):
    for bits in (1, 3, 8, 30):
        for length in (1, 2, 3, 9):
            top = (ZZ(2) ** bits - 1,) * length
            product = top
            for _ in range(factors - 1):
                product = multiply(product, top)
            width = width_for(factors * bits, len(product), factors)
            assert 8 * max(product) < 2 ** (width - 1)


@pytest.mark.parametrize("factors", [3, 4])
@pytest.mark.parametrize("length", [1, 7, 15])
def test_the_width_is_proven_for_every_number_of_bits(factors, length):
    """So also where rounding it up to a power of two gives nothing away."""
    for bits in range(140):
        width = width_for(bits, length, factors)
        assert 8 * length ** (factors - 1) * (2**bits - 1) < 2 ** (width - 1)
