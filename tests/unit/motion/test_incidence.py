"""Orientations, coincidences and incidences of tracks, against `Fraction` at an instant."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st
from strategies import algebraics, as_int_poly, as_rational, fractions, trim

from exactpt import Affine, AlgebraicNumber, Body, Rigid, Translation
from exactpt.kernel.integer_polynomial import sign_at
from exactpt.motion.track import Track, coincide, lies_on, orientation_polynomial
from fuzz.references.real_roots import exact

coefficients = st.lists(fractions, max_size=2)
motions = st.one_of(
    st.builds(Translation, coefficients, coefficients),
    st.builds(lambda h, x: Rigid(h, pivot=(1, 0), x=x), coefficients, coefficients),
    st.builds(lambda p, x: Affine([[p, 0], [1, p]], x=x), coefficients, coefficients),
)


@st.composite
def tracks(draw):
    """The track of one vertex: small coordinates, any motion."""
    point = draw(st.tuples(st.integers(-2, 2), st.integers(-2, 2)))
    body = Body("a", [point], draw(motions))
    return body.exact_piece_after(as_rational(Fraction(0))).tracks[0]


def at(track, t):
    x, y = track.at(as_rational(t))
    return exact(x), exact(y)


def turn(p, q, r):
    s = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return (s > 0) - (s < 0)


@given(a=tracks(), b=tracks(), c=tracks(), t=fractions)
def test_the_orientation_at_an_instant_has_the_sign_of_the_turn(a, b, c, t):
    f = orientation_polynomial(a, b, c)

    assert sign_at(f, as_rational(t)) == turn(at(a, t), at(b, t), at(c, t))


@given(a=tracks(), b=tracks(), c=tracks())
def test_orientation_is_alternating(a, b, c):
    assert orientation_polynomial(a, b, c) == orientation_polynomial(b, c, a)
    assert orientation_polynomial(a, b, c) == tuple(-q for q in orientation_polynomial(b, a, c))
    assert orientation_polynomial(a, a, c) == ()


@given(a=tracks(), b=tracks(), v=tracks(), t=fractions)
def test_coincide_and_lies_on_at_rational_times(a, b, v, t):
    now = AlgebraicNumber(as_rational(t))
    p, q, r = at(a, t), at(b, t), at(v, t)
    inner = (p[0] - r[0]) * (q[0] - r[0]) + (p[1] - r[1]) * (q[1] - r[1])

    assert coincide(a, v, now) == (p == r)
    assert lies_on(v, a, b, now) == (turn(p, q, r) == 0 and inner <= 0)


@given(case=algebraics(), k=st.integers(-1, 4), w=st.integers(1, 3))
def test_lies_on_at_algebraic_times(case, k, w):
    """v = a + (k / 3) (b - a) at the time alone: its distance is the number's polynomial."""
    t, root = case
    a = Track((), (), as_int_poly([w]), None)
    b = Track(as_int_poly([0, 3 * w]), as_int_poly([6 * w]), as_int_poly([w]), None)
    x, y = [0, k], [root.factor[0] + 2 * k, *root.factor[1:]]
    v = Track(as_int_poly(trim(x)), as_int_poly(y), as_int_poly([1]), None)

    assert lies_on(v, a, b, t) == (0 <= k <= 3)
    assert coincide(v, a, t) == (k == 0)
    assert coincide(v, b, t) == (k == 3)
