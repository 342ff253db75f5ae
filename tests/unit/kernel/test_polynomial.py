"""Rational polynomials: ring laws, values, and the door to SymPy and back."""

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, fractions, wide_fractions

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import ONE, ZERO, Polynomial, polynomial
from fuzz.references.real_roots import exact

t = sympy.Symbol("t")
polys = st.lists(st.one_of(fractions, wide_fractions), max_size=5).map(Polynomial)


def at(f, x):
    return sum(exact(c) * x**i for i, c in enumerate(f.coefficients))


@given(f=polys, g=polys, h=polys)
def test_ring_laws(f, g, h):
    assert f + g == g + f
    assert f * g == g * f
    assert (f + g) + h == f + (g + h)
    assert (f * g) * h == f * (g * h)
    assert f * (g + h) == f * g + f * h
    assert f - f == ZERO
    assert f + ZERO == f == f * ONE
    assert f * ZERO == ZERO
    assert -f == ZERO - f


@given(f=polys, g=polys, x=fractions)
def test_evaluation_is_a_ring_homomorphism(f, g, x):
    q = as_rational(x)

    assert exact((f + g)(q)) == at(f, x) + at(g, x)
    assert exact((f * g)(q)) == at(f, x) * at(g, x)
    assert exact((-f)(q)) == -at(f, x)


@given(f=polys, g=polys)
def test_degrees(f, g):
    assert f.degree == len(list(f)) - 1
    assert not f.coefficients or f.coefficients[-1] != 0
    if f.degree >= 0 and g.degree >= 0:
        assert (f * g).degree == f.degree + g.degree


@given(f=polys, g=polys)
def test_the_product_rule(f, g):
    assert (f * g).derivative() == f.derivative() * g + f * g.derivative()
    assert (f + g).derivative() == f.derivative() + g.derivative()


@given(f=polys)
def test_equal_polynomials_have_equal_hashes(f):
    again = Polynomial([*f.coefficients, 0])

    assert again == f
    assert hash(again) == hash(f)
    assert f != list(f)


@given(f=polys)
def test_to_sympy_and_back(f):
    assert Polynomial.from_sympy(f.to_sympy(t), t) == f


@given(f=polys, g=polys)
def test_sympy_agrees_on_products(f, g):
    expected = sympy.expand(f.to_sympy(t) * g.to_sympy(t))

    assert sympy.expand((f * g).to_sympy(t) - expected) == 0


@pytest.mark.parametrize(
    "expression, expected",
    [
        (sympy.Integer(0), []),
        (sympy.Integer(3), [3]),
        (t, [0, 1]),
        ((t - 1) ** 3, [-1, 3, -3, 1]),
        (t * (t + sympy.Rational(1, 3)) / 2, [0, "1/6", "1/2"]),
        ((t**2 - 1) / (t - 1) * (t - 1) * 1, None),
    ],
)
def test_from_sympy(expression, expected):
    if expected is None:
        expression, expected = sympy.cancel(expression), [-1, 0, 1]

    assert Polynomial.from_sympy(expression, t) == Polynomial(expected)


@pytest.mark.parametrize(
    "expression",
    [
        1 / t,
        sympy.sqrt(2) * t,
        sympy.pi * t,
        sympy.I * t,
        sympy.sin(t),
        sympy.sqrt(t),
        t * sympy.Symbol("s"),
        2**t,
        abs(t),
        sympy.oo,
        sympy.nan,
        sympy.zoo,
        t > 1,
    ],
    ids=str,
)
def test_what_is_no_rational_polynomial_is_refused(expression):
    with pytest.raises(InputError):
        Polynomial.from_sympy(expression, t)


def test_a_polynomial_cannot_be_changed():
    f = Polynomial([1, 2])

    with pytest.raises(AttributeError):
        f.coefficients = ()
    with pytest.raises(AttributeError):
        f.degree = 3


@pytest.mark.parametrize(
    "value, expected",
    [
        (3, [3]),
        ("1/2", ["1/2"]),
        (0.5, ["1/2"]),
        (QQ(1, 2), ["1/2"]),
        (Fraction(1, 2), ["1/2"]),
        (np.int64(3), [3]),
        (np.float64(0.25), ["1/4"]),
        ([1, 2, 0], [1, 2]),
        ((1, "2/3"), [1, "2/3"]),
        (np.array([1, 2]), [1, 2]),
        (np.array([0.5]), ["1/2"]),
        ((), []),
        (ONE, [1]),
    ],
    ids=repr,
)
def test_what_a_caller_may_write_for_a_polynomial(value, expected):
    assert polynomial(value) == Polynomial(expected)


@pytest.mark.parametrize(
    "value",
    [
        None,
        pytest.param(object(), id="object"),
        math.nan,
        math.inf,
        True,
        [True],
        [None],
        ["x"],
        "x",
        [[1]],
    ],
    ids=repr,
)
def test_what_is_no_polynomial_is_refused(value):
    with pytest.raises(InputError):
        polynomial(value)


def test_the_repr_can_be_read_back():
    f = Polynomial([0, "1/2", -1])

    assert repr(f) == "Polynomial(['0', '1/2', '-1'])"
    assert eval(repr(f)) == f


@given(f=polys, c=fractions)
def test_a_number_stands_for_a_constant(f, c):
    constant = Polynomial([c])

    assert f + c == c + f == f + constant
    assert f - c == f - constant
    assert c - f == constant - f
    assert f * c == c * f == f * constant
    assert c == 0 or f / c == f * (1 / c)


@given(f=polys, exponent=st.integers(0, 5))
def test_a_power_is_a_product(f, exponent):
    product = ONE
    for _ in range(exponent):
        product = product * f

    assert f**exponent == product


@given(f=polys, g=polys, x=fractions)
def test_a_composition_is_evaluated_from_inside(f, g, x):
    assert f(g)(x) == f(g(x))


@pytest.mark.parametrize(
    "use",
    [lambda: ONE**-1, lambda: ONE + "one", lambda: ONE * [1], ZERO.roots],
    ids=["a negative power", "a word", "a list", "the roots of zero"],
)
def test_what_has_no_value_is_refused(use):
    with pytest.raises(InputError):
        use()


def test_a_polynomial_is_not_divided_by_zero():
    with pytest.raises(ZeroDivisionError):
        ONE / 0


@given(
    roots=st.lists(fractions, min_size=1, max_size=4),
    factor=fractions.filter(bool),
    bounds=st.tuples(fractions, fractions),
)
def test_the_roots_are_those_of_the_factors(roots, factor, bounds):
    f = ONE * factor
    for root in roots:
        f = f * (Polynomial([0, 1]) - root)
    after, until = sorted(bounds)

    assert f.roots() == sorted(set(roots))
    assert f.roots(after, until) == sorted({r for r in roots if after < r <= until})


@given(f=polys.filter(lambda f: f.degree > 0), x=fractions)
def test_signs_at_and_after_a_time(f, x):
    value = f(x)

    assert f.sign(x) == (value > 0) - (value < 0)
    later = f.roots(after=x)
    middle = (x + later[0].low) / 2 if later and later[0].low > x else None
    if middle is not None:
        assert f.sign_after(x) == f.sign(middle)
    assert ZERO.sign_after(x) == 0


def test_signs_at_an_irrational_time():
    t = Polynomial([0, 1])
    (root,) = (t * t - 2).roots(after=0)

    assert (t * t - 2).sign(root) == 0
    assert (t * t - 2).sign_after(root) == 1
    assert (2 - t * t).sign_after(root) == -1
    assert (t - "3/2").sign(root) == -1
