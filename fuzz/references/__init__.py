"""Definitions that need python-flint, SymPy or mpmath; see `exactpt.testing.reference`, too."""
