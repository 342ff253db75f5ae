"""Exact arithmetic: numbers, polynomials, their real roots, and the float filters.

Public names: `Polynomial`, `AlgebraicNumber`.
"""

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.polynomial import Polynomial

__all__ = ["AlgebraicNumber", "Polynomial"]
