"""Factors of integer polynomials, by python-flint or SymPy, imported on first use."""

from __future__ import annotations

from exactpt.kernel.integer_polynomial import IntPoly, negate
from exactpt.kernel.numbers import ZZ


def irreducible_factors(f: IntPoly) -> list[IntPoly]:
    """Return the primitive irreducible factors of a polynomial, with positive leading coefficients.

    Raises:
        ImportError: if neither python-flint nor SymPy is installed.
    """
    coefficients = [int(c) for c in f]
    try:
        factors = _factors_by_flint(coefficients)
    except ImportError:
        from exactpt.kernel.sympy_adapter import integer_factors

        factors = integer_factors(coefficients)
    found = [tuple(map(ZZ, factor)) for factor in factors]
    return [g if g[-1] > 0 else negate(g) for g in found]


def _factors_by_flint(coefficients: list[int]) -> list[list[int]]:
    from flint import fmpz_poly

    _, factors = fmpz_poly(coefficients).factor()
    return [[int(c) for c in factor.coeffs()] for factor, _ in factors]
