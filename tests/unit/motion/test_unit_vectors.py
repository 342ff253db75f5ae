"""Tangents that are rounded correctly, and unit vectors near angles, against mpmath."""

import math
from random import Random

import mpmath
import pytest

from exactpt import InputError
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.motion import unit_vectors
from exactpt.motion.unit_vectors import tangent_bounds, tangent_near, vector_near


def real(q):
    return mpmath.mpf(int(q.numerator)) / int(q.denominator)


def angles(count):
    rng = Random(1)
    for _ in range(count):
        yield QQ(3, 4) * QQ(rng.randint(-(10**6), 10**6), 10**6) / 10 ** rng.choice([0, 0, 3, 40])


@pytest.mark.parametrize("bits", [0, 1, 8, 20, 40, 53, 100, 500])
def test_tangent_is_the_nearest_multiple(bits):
    with mpmath.workprec(1500):
        for angle in angles(40):
            nearest = int(mpmath.nint(mpmath.tan(real(angle)) * mpmath.mpf(2) ** bits))
            assert tangent_near(angle, bits) * QQ(2) ** bits == nearest


def test_tangent_does_not_depend_on_the_approximation(monkeypatch):
    """Of machines whose doubles differ, even by much, all have the same result."""
    some = list(angles(40))
    results = [tangent_near(angle, bits) for angle in some for bits in (8, 40, 90)]
    for by in (1e-15, -1e-9, 1e-3):
        monkeypatch.setattr(
            unit_vectors,
            "_tangent_in_doubles",
            lambda angle, by=by: QQ(math.tan(nearest_float(angle)) * (1 - abs(by)) + by / 99),
        )
        assert results == [tangent_near(angle, bits) for angle in some for bits in (8, 40, 90)]


def test_tangent_near_the_middle_of_two_multiples_takes_more_bits():
    """The angle whose tangent is a third of 2^-80 above the middle: bounds of 26 bits do not do."""
    with mpmath.workprec(400):
        middle = QQ(77, 256) + QQ(1, 512)
        for sign in (1, -1):
            tangent = middle + sign * QQ(1, 3 * 2**80)
            scaled = int(mpmath.nint(mpmath.atan(real(tangent)) * mpmath.mpf(2) ** 300))
            expected = QQ(78 if sign > 0 else 77, 256)
            assert tangent_near(QQ(scaled, 2**300), 8) == expected


def test_bounds_of_tangents_hold_for_any_approximation():
    rng = Random(2)
    with mpmath.workprec(300):
        for angle in angles(100):
            m = QQ(math.tan(nearest_float(angle)) + rng.uniform(-1, 1) / 10 ** rng.randint(2, 12))
            m = max(min(m, QQ(1)), QQ(-1))
            low, high = tangent_bounds(angle, m, rng.choice([10, 30, 60]))
            assert real(low) <= mpmath.tan(real(angle)) <= real(high)


@pytest.mark.parametrize("error", ["1", "1/1000", "1e-9", "1e-60"])
def test_vector_is_a_unit_vector_near_the_angle(error):
    error = QQ(error) if "e" not in error else QQ(1, 10 ** int(error[3:]))
    with mpmath.workprec(1000):
        for angle in (k * 10**n * QQ(1, 7) for k in range(-9, 10) for n in (0, 3, 30)):
            c, s = vector_near(angle, error)
            assert c * c + s * s == 1
            turned = mpmath.mpc(real(c), real(s)) * mpmath.expj(-real(angle))
            assert abs(mpmath.arg(turned)) <= real(error) / 8


def test_vector_of_angle_0_is_exact():
    assert vector_near(QQ(0), QQ(1, 10)) == (1, 0)


def test_vector_of_a_far_angle_is_refused():
    with pytest.raises(InputError, match="too small for angles"):
        vector_near(QQ(2) ** 600, QQ(1, 10))
