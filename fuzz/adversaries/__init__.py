"""Adversaries of the float filters: rows near their bounds, decided by rationals.

Each module is run by ``python -m fuzz.adversaries.NAME --rows N --seed S`` and prints how many rows
it checked, how many were within a tenth of the bound, the largest error relative to the bound, and
the wrong answers.
"""
