"""Algebraic numbers beside rationals, and sums of square roots."""

import math
from decimal import Decimal
from fractions import Fraction
from random import Random

import mpmath
import pytest

from exactpt import AlgebraicNumber, InputError, Polynomial
from exactpt.kernel.numbers import QQ
from exactpt.kernel.radicals import nearest_root_sum, root_sum_sign

ROOT = AlgebraicNumber.root((-2, 0, 1), 1, 2)
THIRD = AlgebraicNumber(Fraction(-1, 3))
LONG = AlgebraicNumber.root((-(10**200), 0, 0, 1), 0, 10**100)


@pytest.mark.parametrize("x", [ROOT, THIRD, AlgebraicNumber.root((-1, -1, 0, 1), 1, 2)])
@pytest.mark.parametrize("q", [Fraction(3, 7), -2, 0.5, "1/3", Decimal("-0.1")])
def test_sums_and_products_with_rationals_are_exact(x, q):
    exact = Fraction(q)

    assert (x + q) - q == x
    assert q - (q - x) == x
    assert (x * q) / q == x
    assert 0 - (-x) == x
    assert (q + x).compare_rational(0) == x.compare_rational(-exact)
    assert abs(float(q * x) - float(x) * float(exact)) < 1e-14


def test_polynomial_of_a_sum_is_primitive_and_the_root_its_own():
    assert (ROOT + 1).polynomial == (-1, -2, 1)
    assert ((ROOT + 1) * (1 / Fraction(2))).polynomial == (-1, -4, 4)
    assert ROOT * 0 == 0


def test_sum_of_two_irrationals_names_sympy():
    with pytest.raises(TypeError, match="to_sympy"):
        ROOT + ROOT
    assert (ROOT + THIRD).compare(ROOT - Fraction(1, 3)) == 0
    with pytest.raises(TypeError):
        ROOT * "x"
    with pytest.raises(ZeroDivisionError):
        ROOT / 0


@pytest.mark.parametrize(
    "x, digits, expected",
    [
        (ROOT, None, 1),
        (ROOT * 100, 1, Fraction(1414, 10)),
        (ROOT, 3, Fraction(1414, 1000)),
        (-ROOT, 0, -1),
        (AlgebraicNumber("5/2"), None, 2),
        (AlgebraicNumber("7/2"), None, 4),
        (AlgebraicNumber("-5/2"), None, -2),
        (AlgebraicNumber(25), -1, 20),
        (ROOT * 10, -1, 10),
        (AlgebraicNumber.root((-8, 0, 0, 1), 1, 5), None, 2),  # 2, not yet known to be rational
    ],
)
def test_round_is_to_the_nearest_and_of_two_to_the_even(x, digits, expected):
    assert round(x, digits) == expected
    assert isinstance(round(x, digits), int if digits is None else Fraction)


def test_int_is_the_integer_part():
    assert [int(ROOT), int(-ROOT), int(THIRD), int(AlgebraicNumber(-3))] == [1, -1, 0, -3]


def test_format_has_as_many_right_digits_as_named():
    assert f"{ROOT:.3f}" == "1.414"
    assert f"{ROOT:.30f}" == "1.414213562373095048801688724210"
    assert f"{ROOT:8.2f}|" == "    1.41|"
    assert f"{ROOT * 1000:.20g}" == "1414.2135623730950488"
    assert f"{THIRD}" == "-1/3"


def test_text_is_short():
    assert str(ROOT) == "1.4142135623730951... (root of (-2, 0, 1))"
    assert repr(THIRD) == "AlgebraicNumber('-1/3')"
    for text in (
        repr(LONG),
        str(LONG),
        repr(AlgebraicNumber(10**500)),
        str(AlgebraicNumber(10**500)),
    ):
        assert len(text) <= 200
    assert "(root of a polynomial of degree 3)" in str(LONG)


def test_coefficients_of_a_polynomial_by_index():
    f = Polynomial([1, "1/2"])

    assert [f[0], f[1], f[2], f[100]] == [1, Fraction(1, 2), 0, 0]
    with pytest.raises(IndexError):
        f[-1]


def test_irrational_times_are_refused_by_rationals():
    with pytest.raises(InputError):
        ROOT.as_integer_ratio()


# Sums of square roots: signs, and nearest doubles


def test_sums_that_vanish():
    assert root_sum_sign({}) == 0
    assert root_sum_sign({QQ(8): 1, QQ(2): -2}) == 0
    assert root_sum_sign({QQ(9): 1, QQ(4): -1, QQ(1): -1}) == 0
    assert root_sum_sign({QQ(1, 2): 2, QQ(2): -1}) == 0
    assert root_sum_sign({QQ(12, 5): 1, QQ(3, 5): -2, QQ(0): 7}) == 0


def test_sums_that_nearly_vanish():
    assert root_sum_sign({QQ(2): 1, QQ(3): 1, QQ(10): -1}) < 0
    close = QQ(5) + QQ(2) * QQ(math.isqrt(6 * 10**400), 10**200)  # below 5 + 2 sqrt(6)
    assert root_sum_sign({QQ(2): 1, QQ(3): 1, close: -1}) == 1
    assert root_sum_sign({QQ(2): 1, QQ(3): 1, close + QQ(1, 10**199): -1}) == -1
    assert root_sum_sign({QQ(10**600): 1, QQ(10**600 + 1): -1}) == -1


def test_signs_are_those_of_mpmath():
    rng = Random(1)
    for _ in range(200):
        terms = {QQ(rng.randint(1, 60), rng.randint(1, 6)): rng.randint(-3, 3) for _ in range(5)}
        with mpmath.workprec(500):
            total = sum(
                c * mpmath.sqrt(mpmath.mpf(int(r.numerator)) / int(r.denominator))
                for r, c in terms.items()
            )
            expected = 0 if abs(total) < mpmath.mpf(2) ** -480 else int(mpmath.sign(total))
        assert root_sum_sign(terms) == expected


def test_the_nearest_double():
    assert nearest_root_sum([]) == 0.0
    assert nearest_root_sum([QQ(2)]) == math.sqrt(2)
    assert nearest_root_sum([QQ(9), QQ(1, 4)]) == 3.5
    assert nearest_root_sum([QQ(1), QQ(10**60)]) == float(10**30 + 1)
    assert nearest_root_sum([QQ(2) * QQ(10) ** 800]) == math.inf
    with mpmath.workprec(300):
        exact = mpmath.sqrt(2) + mpmath.sqrt(3) + mpmath.sqrt(7)
        near = nearest_root_sum([QQ(2), QQ(3), QQ(7)])
        assert all(
            abs(exact - near) <= abs(exact - math.nextafter(near, end)) for end in (0.0, 9.0)
        )
    assert Fraction(nearest_root_sum([QQ(1, 10**40)])) == Fraction(1e-20)
