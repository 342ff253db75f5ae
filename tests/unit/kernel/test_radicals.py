"""Sums of square roots: signs, and nearest doubles."""

import math
from fractions import Fraction
from random import Random

import mpmath

from exactpt.kernel.numbers import QQ
from exactpt.kernel.radicals import nearest_root_sum, root_sum_sign


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
