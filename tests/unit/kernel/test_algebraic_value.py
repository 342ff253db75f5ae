"""Values of quotients at algebraic numbers, beside their minimal polynomials by sympy."""

from __future__ import annotations

from random import Random

import pytest
import sympy

from exactpt import AlgebraicNumber
from exactpt.kernel.algebraic_value import quotient_at
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import ZZ

SQUARE_ROOT = AlgebraicNumber.exact_root((ZZ(-2), ZZ(0), ZZ(1)), 1, 2)


def poly(*coefficients: int) -> IntPoly:
    return tuple(map(ZZ, coefficients))


@pytest.mark.parametrize(
    ("n", "d", "expected"),
    [
        # (1 + t) / (3 - t) = (5 + 4 t) / 7 with t = sqrt(2): 7 y = 5 + 4 t, (7 y - 5)^2 = 32
        (poly(1, 1), poly(3, -1), (-7, -70, 49)),
        # t^2 = 2, though the degree of n is that of the polynomial of t
        (poly(0, 0, 1), poly(1), (-2, 1)),
        # t^4 + t = 4 + t: remainders that drop by more than one degree
        (poly(0, 1, 0, 0, 1), poly(1), (14, -8, 1)),
        # 3 / t^5 = 3 / (4 t): y^2 = 9 / 32
        (poly(3), poly(0, 0, 0, 0, 0, 1), (-9, 0, 32)),
    ],
)
def test_values_at_a_square_root_are_roots_of_their_polynomials(n, d, expected):
    value = quotient_at(n, d, SQUARE_ROOT)

    assert value.sign_of(poly(*expected)) == 0
    assert float(value) == pytest.approx(float_of(n, 2**0.5) / float_of(d, 2**0.5))


def float_of(f: IntPoly, t: float) -> float:
    return sum(float(c) * t**k for k, c in enumerate(f))


@pytest.mark.parametrize("seed", range(12))
def test_values_at_roots_of_any_degree(seed):
    """A value is a root of the resultant by sympy, which takes another way to it."""
    random = Random(seed)
    degree = random.randint(2, 6)
    # 1 at 0 and negative at 1: a root between them.
    inner = [random.randint(-9, 9) for _ in range(degree - 1)]
    p = poly(1, *inner, -2 - sum(inner) - random.randint(0, 5))
    assert has_one_root(p)
    t = AlgebraicNumber.exact_root(p, 0, 1)
    n = poly(*(random.randint(-9, 9) for _ in range(random.randint(1, 8))), 1)
    d = poly(*(random.randint(1, 9) for _ in range(random.randint(1, 8))))

    value = quotient_at(n, d, t)

    x, y = sympy.symbols("x y")
    resultant = sympy.resultant(expression(p, x), expression(n, x) - y * expression(d, x), x)
    coefficients = sympy.Poly(resultant, y).all_coeffs()[::-1]
    assert value.sign_of(poly(*map(int, coefficients))) == 0
    place = float(t)
    assert float(value) == pytest.approx(float_of(n, place) / float_of(d, place))


def has_one_root(p: IntPoly) -> bool:
    x = sympy.symbols("x")
    return sympy.Poly(expression(p, x), x).count_roots(0, 1) == 1


def expression(f: IntPoly, x: sympy.Symbol) -> sympy.Expr:
    return sum(int(c) * x**k for k, c in enumerate(f))
