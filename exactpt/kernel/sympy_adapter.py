"""Conversion to and from SymPy, imported on first use.

It is the only module that imports SymPy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import sympy

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.kernel.sturm import cauchy_bound, count_roots, sturm_sequence

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.polynomial import Polynomial

Expression: TypeAlias = sympy.Expr
Variable: TypeAlias = sympy.Symbol


def _rational(value: QQ) -> sympy.Rational:
    return sympy.Rational(int(value.numerator), int(value.denominator))


def coefficients_from_sympy(expression: Expression, variable: Variable) -> list[QQ]:
    """Return the rational coefficients of a polynomial expression, constant term first.

    Raises:
        InputError: if the expression is not a polynomial in ``variable`` over the rationals.
    """
    try:
        poly = sympy.Poly(sympy.nsimplify(expression, rational=True), variable, domain="QQ")
    except (sympy.PolynomialError, sympy.CoercionFailed) as error:
        raise InputError(f"not a rational polynomial in {variable}: {expression}") from error
    return [QQ(int(c.p), int(c.q)) for c in reversed(poly.all_coeffs())]


def polynomial_to_sympy(f: Polynomial, variable: Variable) -> Expression:
    """Return the expression sum(c[i] * variable**i)."""
    terms = (_rational(c) * variable**i for i, c in enumerate(f.exact_coefficients))
    return sum(terms, start=sympy.Integer(0))


def algebraic_to_sympy(number: AlgebraicNumber) -> Expression:
    """Return a rational, or the real root of the same index among those of the polynomial."""
    if number.is_rational:
        return _rational(number.exact_low)
    f = number.exact_polynomial
    place = count_roots(
        sturm_sequence(f), min(-cauchy_bound(f), number.exact_low), number.exact_low
    )
    poly = sympy.Poly([int(c) for c in reversed(f)], sympy.Symbol("t"))
    return poly.real_roots()[place]


def integer_factors(coefficients: list[int]) -> list[list[int]]:
    """Return the primitive irreducible factors of an integer polynomial, constant terms first."""
    poly = sympy.Poly(coefficients[::-1], sympy.Symbol("t"), domain="ZZ")
    _, factors = poly.factor_list()
    return [[int(c) for c in reversed(factor.all_coeffs())] for factor, _ in factors]
