"""Decimal expansions are correctly rounded, at rational and irrational times."""

from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import ZZ
from exactpt.kernel.quotients import decimal_quotient


def poly(*coefficients):
    return tuple(map(ZZ, coefficients))


def nearest(value, digits):
    context = Context(digits, ROUND_HALF_EVEN)
    return context.divide(Decimal(value.numerator), Decimal(value.denominator))


ROOT_OF_TWO = AlgebraicNumber.root([-2, 0, 1], 1, 2)


@given(t=fractions, digits=st.integers(1, 50))
def test_at_a_rational_time_it_is_the_quotient_rounded(t, digits):
    found = decimal_quotient(poly(1, 3, 2), poly(2, 0, 1), AlgebraicNumber(t), digits)

    assert found == nearest((1 + 3 * t + 2 * t * t) / (2 + t * t), digits)


@given(digits=st.integers(1, 300))
def test_the_square_root_of_two(digits):
    expected = Context(digits, ROUND_HALF_EVEN).sqrt(Decimal(2))

    assert decimal_quotient(poly(0, 1), poly(1), ROOT_OF_TWO, digits) == expected


@pytest.mark.parametrize("halfway", [Fraction(5, 2), Fraction(7, 2), Fraction(-25, 2)])
def test_a_value_halfway_between_two_decimals_becomes_the_even_one(halfway):
    """The quotient (p + t^3 - 2 t) / q is p / q, though neither t nor its bounds are rational."""
    p, q = halfway.numerator, halfway.denominator
    digits = len(str(abs(p) // q))

    found = decimal_quotient(poly(p, -2, 0, 1), poly(q), ROOT_OF_TWO, digits)

    assert found == nearest(halfway, digits)
    assert found % 2 == 0


def test_zero_is_found():
    assert decimal_quotient(poly(-2, 0, 1), poly(3, 1), ROOT_OF_TWO, 20) == 0


def test_no_digits_are_refused():
    with pytest.raises(InputError, match="digits: at least 1"):
        decimal_quotient(poly(1), poly(1), ROOT_OF_TWO, 0)
