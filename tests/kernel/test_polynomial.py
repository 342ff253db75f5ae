"""Rational polynomials: ring laws, values, and the door to SymPy and back."""

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from oracles import exact
from strategies import as_rational, fractions, wide_fractions

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import ONE, ZERO, Polynomial, polynomial

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
