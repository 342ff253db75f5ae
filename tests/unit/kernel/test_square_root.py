"""Square roots of rationals as the nearest doubles, and of algebraic numbers and quotients."""

import math
from fractions import Fraction
from random import Random

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import quotient_at, square_root
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.square_root import nearest_root_less, nearest_square_root


@given(st.fractions(min_value=0))
def test_square_root_is_rounded_correctly(value):
    mp.prec = 4000
    expected = float(mp.sqrt(mpf(value.numerator) / mpf(value.denominator)))

    assert nearest_square_root(QQ(value)) == expected


@every("exponent", [-2148, -2146, -2100, -1074, -1, 0, 1, 2046, 2047, 2048, 2050])
def test_square_root_of_a_power_of_two_is_exact_or_near(exponent):
    value = Fraction(2) ** exponent
    root = nearest_square_root(QQ(value))

    if exponent >= 2048:
        assert root == math.inf
    elif exponent % 2 == 0 and exponent >= -2148:
        assert Fraction(root) ** 2 == value
    else:
        assert abs(Fraction(root) ** 2 - value) <= value * Fraction(2) ** -50 or root < 1e-300


@pytest.mark.parametrize("x", [1.0, 1.5, 3.0, 1e-300, 5e-324])
def test_square_root_near_a_midpoint_of_two_doubles_is_the_nearer_one(x):
    above = math.nextafter(x, math.inf)
    middle = (Fraction(x) + Fraction(above)) / 2

    assert nearest_square_root(QQ(middle**2 - middle**2 / 2**200)) == x
    assert nearest_square_root(QQ(middle**2 + middle**2 / 2**200)) == above
    assert nearest_square_root(QQ(middle**2)) in {x, above}


@pytest.mark.parametrize("exponent", [0, 8, 40, 200, 900])
def test_root_less_a_rational_is_rounded_correctly_where_nearly_everything_cancels(exponent):
    mp.prec = 8000
    random = Random(exponent)
    for _ in range(50):
        value = Fraction(random.randint(1, 10**9), random.randint(1, 10**9))
        exact = mp.sqrt(mpf(value.numerator) / value.denominator)
        near = Fraction(int(mp.floor(exact * 2**exponent)), 2**exponent)
        exact -= mpf(near.numerator) / near.denominator
        assert nearest_root_less(QQ(value), QQ(near)) == float(exact)


def test_values_of_quotients_and_roots_at_an_irrational_time_are_algebraic():
    root = AlgebraicNumber.root((-2, 0, 1), 1, 2)

    assert quotient_at((ZZ(0), ZZ(0), ZZ(1)), (ZZ(3),), root) == QQ(2, 3)
    shifted = quotient_at((ZZ(1), ZZ(1)), (ZZ(0), ZZ(1)), root)
    assert shifted.minimal_polynomial() == (1, -4, 2)  # 1 + 1 / sqrt(2)
    assert square_root(AlgebraicNumber(QQ(9, 4))) == QQ(3, 2)
    assert square_root(root).minimal_polynomial() == (-2, 0, 0, 0, 1)
    assert square_root(AlgebraicNumber(0)) == 0


@pytest.mark.parametrize("narrow", [0, 60, 1000])
def test_bounds_of_values_have_no_more_digits_than_they_need(narrow):
    """However many the bounds of the time have: a value of a value of a value stays cheap."""
    number = AlgebraicNumber.root((-1, -1, 0, 0, 0, 1), 1, 2)  # t^5 = t + 1
    number.refine_to(QQ(1, 2**narrow))
    for _ in range(3):
        number = square_root(quotient_at((ZZ(1), ZZ(0), ZZ(3)), (ZZ(2), ZZ(1)), number))
        width = number.high - number.low

        needed = (width.denominator // width.numerator).bit_length()
        assert number.low.denominator.bit_length() <= needed + 8
