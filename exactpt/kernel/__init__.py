"""Exact arithmetic: numbers, polynomials, their real roots, and the float filters."""
