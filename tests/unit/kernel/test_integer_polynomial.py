"""Integer polynomials against FLINT: ring laws, remainders with their sign, gcds."""

from fractions import Fraction

import flint
from hypothesis import assume, example, given
from hypothesis import strategies as st
from strategies import (
    as_int_poly,
    as_primitive,
    as_rational,
    fractions,
    int_polys,
    planted_polys,
    small,
    times,
    wide_fractions,
)

from exactpt.kernel import integer_polynomial
from exactpt.kernel.integer_polynomial import (
    SLACK,
    add,
    derivative,
    evaluate,
    greatest_common_divisor,
    multiply,
    negate,
    positive_remainder,
    primitive,
    quotient,
    range_on,
    scale,
    sign_at,
    sign_near,
    sign_on,
    square_free,
    subtract,
    trimmed,
)
from exactpt.kernel.numbers import QQ, ZZ
from fuzz.references.real_roots import exact, real_roots, value

nonzero = int_polys.filter(bool)
huge = st.lists(st.integers(-(2**200), 2**200), max_size=6).map(lambda f: trimmed(as_int_poly(f)))
polys = st.one_of(int_polys.map(as_int_poly), huge)


def oracle(f):
    return flint.fmpz_poly([int(c) for c in f])


def back(f):
    return as_int_poly(f.coeffs())


def over_q(f):
    return flint.fmpq_poly([int(c) for c in f])


@given(f=polys, g=polys)
def test_sums_and_products_are_flints(f, g):
    assert add(f, g) == back(oracle(f) + oracle(g))
    assert subtract(f, g) == back(oracle(f) - oracle(g))
    assert multiply(f, g) == back(oracle(f) * oracle(g))
    assert negate(f) == back(-oracle(f))


@given(f=polys, g=polys, h=polys)
def test_ring_laws(f, g, h):
    assert add(f, g) == add(g, f)
    assert multiply(f, g) == multiply(g, f)
    assert add(add(f, g), h) == add(f, add(g, h))
    assert multiply(multiply(f, g), h) == multiply(f, multiply(g, h))
    assert multiply(f, add(g, h)) == add(multiply(f, g), multiply(f, h))
    assert subtract(f, f) == ()


@given(f=polys, g=polys)
def test_the_derivative_of_a_product(f, g):
    expected = add(multiply(derivative(f), g), multiply(f, derivative(g)))

    assert derivative(multiply(f, g)) == expected
    assert derivative(f) == back(oracle(f).derivative())


@given(f=polys, k=st.one_of(small, st.integers(-(2**100), 2**100)))
def test_scale(f, k):
    assert scale(f, k) == back(oracle(f) * k)


@given(f=polys, t=wide_fractions)
@example(f=(), t=Fraction(1))
@example(f=as_int_poly([-1, 3]), t=Fraction(1, 3))
def test_values_and_signs(f, t):
    expected = value(f, t)

    assert exact(evaluate(f, as_rational(t))) == expected
    assert sign_at(f, as_rational(t)) == (expected > 0) - (expected < 0)


@given(f=polys, ends=st.tuples(wide_fractions, wide_fractions).map(sorted))
@example(f=(), ends=[Fraction(-1), Fraction(1)])
@example(f=as_int_poly([1, -2, 1]), ends=[Fraction(0), Fraction(2)])
def test_a_range_is_that_of_horners_rule_on_intervals(f, ends):
    """The best bounds of each product and sum, whatever the signs of the ends."""
    low, high = ends
    a = b = Fraction(0)
    for c in reversed(f):
        products = [x * t for x in (a, b) for t in (low, high)]
        a, b = min(products) + int(c), max(products) + int(c)

    assert tuple(map(exact, range_on(f, as_rational(low), as_rational(high)))) == (a, b)


@given(f=polys, k=st.integers(1, 10**20))
def test_primitive_divides_by_the_content_and_keeps_the_sign(f, k):
    g = primitive(scale(f, k))

    assert g == primitive(f)
    assert oracle(g).content() == (1 if f else 0)
    assert [(c > 0) - (c < 0) for c in g] == [(c > 0) - (c < 0) for c in f]


@given(f=polys, g=polys.filter(bool))
def test_the_remainder_is_a_positive_multiple_of_the_rational_one(f, g):
    expected = divmod(over_q(f), over_q(g))[1]

    remainder = positive_remainder(f, g)

    assert remainder == as_primitive(
        [as_rational(Fraction(int(c.p), int(c.q))) for c in expected.coeffs()]
    )


@given(f=polys.filter(bool), g=polys.filter(bool), k=st.sampled_from([1, -1, 6, -(10**9)]))
def test_the_quotient_of_a_product_is_its_factor_up_to_a_positive_number(f, g, k):
    product = scale(multiply(f, g), k)

    assert quotient(product, f) == primitive(scale(g, k))


@given(f=polys, g=polys, h=int_polys.map(as_int_poly))
def test_gcds_are_flints(f, g, h):
    f, g = multiply(f, h), multiply(g, h)
    common = oracle(f).gcd(oracle(g))

    expected = back(common // common.content()) if common else ()

    assert greatest_common_divisor(f, g) == expected


@given(f=nonzero)
def test_the_square_free_part_has_the_roots_once_and_the_leading_sign(f):
    g = square_free(as_int_poly(f))

    assert g == primitive(g)
    assert (g[-1] > 0) == (f[-1] > 0)
    factors = {tuple(p.coeffs()) for p, _ in oracle(f).factor()[1]}
    assert {tuple(p.coeffs()): m for p, m in oracle(g).factor()[1]} == dict.fromkeys(factors, 1)


@given(f=planted_polys(max_factors=2, max_power=3))
def test_the_square_free_part_keeps_the_real_roots(f):
    g = square_free(as_int_poly(f))

    expected = [(r.factor, r.index) for r in real_roots(f)]
    assert [(r.factor, r.index) for r in real_roots(g)] == expected


def test_bug_square_free_of_a_negative_square():
    """-(t - 1)^2 gave -1 - t, whose root is -1: the linear coefficient was negated twice."""
    assert square_free(as_int_poly([-1, 2, -1])) == as_int_poly([1, -1])


@given(q=fractions, k=st.sampled_from([1, -1, 4, -9]))
def test_the_square_free_part_of_a_square(q, k):
    line = (-q.numerator, q.denominator)
    assume(q.denominator > 0)

    f = square_free(as_int_poly(times((k,), line, line)))

    assert f == (primitive(as_int_poly(line)) if k > 0 else negate(primitive(as_int_poly(line))))


def test_the_zero_polynomial_and_constants():
    zero, five = (), as_int_poly([5])

    assert add(zero, five) == five
    assert multiply(zero, five) == zero
    assert derivative(five) == zero
    assert primitive(zero) == zero
    assert greatest_common_divisor(zero, zero) == zero
    assert greatest_common_divisor(zero, negate(five)) == as_int_poly([1])
    assert positive_remainder(five, five) == zero
    assert positive_remainder(zero, five) == zero
    assert square_free(negate(five)) == as_int_poly([-1])


def shares_a_large_divisor_with_its_derivative():
    """Square-free, of 40 bits, and its value at N = 2^(40 + SLACK) has a gcd above N with f'(N).

    f = 2^39 (1 + t) + c2 t^2 + c3 t^3 + t^4, with c2 and c3 such that a prime of 37 bits
    divides both values.
    """
    q, n = 2**37 - 25, 2 ** (40 + SLACK)
    value, slope = 2**39 * (1 + n) + n**4, 2**39 + 4 * n**3
    c3 = (2 * value - n * slope) * pow(n**3, -1, q) % q
    c2 = -(value + c3 * n**3) * pow(n**2, -1, q) % q
    return tuple(map(ZZ, (2**39, 2**39, c2, c3, 1)))


def test_square_free_where_the_values_at_a_point_do_not_show_it(monkeypatch):
    divided = []
    monkeypatch.setattr(
        integer_polynomial,
        "positive_remainder",
        lambda f, g: divided.append(f) or positive_remainder(f, g),
    )
    f = shares_a_large_divisor_with_its_derivative()

    assert square_free(f) == f
    assert divided[0] == f
    divided.clear()
    assert square_free((ZZ(5), ZZ(0), ZZ(0), ZZ(7))) == (5, 0, 0, 7)
    assert not divided


@given(f=nonzero.map(as_int_poly), low=st.fractions(-9, 9), width=st.fractions(0, 1))
def test_signs_near_a_point_are_those_at_points(f, low, width):
    high = low + width

    found = sign_near(f, QQ(low), QQ(high))

    if found:
        points = [QQ(low + width * k / 4) for k in range(5)]
        assert {sign_at(f, t) for t in points} == {found}


def test_signs_near_a_point_where_terms_cancel():
    """(t - 1000)^8 + 1 is positive; its terms at 1000 are of 10^24, and cancel."""
    eighth = as_int_poly([1])
    for _ in range(8):
        eighth = multiply(eighth, as_int_poly([-1000, 1]))
    f = add(eighth, as_int_poly([1]))
    low, high = QQ(999) + QQ(9, 10), QQ(1000) + QQ(1, 10)

    assert sign_near(f, low, high) == 1
    assert sign_on(f, low, high) == 0


@given(f=nonzero, g=nonzero, h=nonzero)
def test_common_divisors_of_products(f, g, h):
    f, g, h = map(as_int_poly, (f, g, h))

    common = greatest_common_divisor(multiply(f, h), multiply(g, h))

    alone = greatest_common_divisor(f, g)
    assert len(common) - 1 == len(alone) - 1 + len(h) - 1
    assert positive_remainder(multiply(f, h), common) == ()
    assert positive_remainder(multiply(g, h), common) == ()


@given(f=int_polys.filter(lambda f: len(f) > 1), scale=st.integers(0, 80))
def test_values_at_a_point_take_nothing_for_square_free(f, scale):
    stretched = tuple(ZZ(c) << scale * i for i, c in enumerate(f))
    square = multiply(stretched, stretched)

    assert len(square_free(square)) == len(square_free(stretched))
