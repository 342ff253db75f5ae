"""Sums and products of doubles that notice every rounding, against rationals."""

import math
import random
from fractions import Fraction

import pytest

from exactpt.filters.error_free import (
    LARGEST_FACTOR,
    NOT_EXACT,
    SMALLEST_PRODUCT,
    Exactly,
    exact_cross_sign,
    is_exact_product,
    is_exact_sum,
)

LARGEST = math.nextafter(math.inf, 0.0)
LEAST = math.nextafter(0.0, 1.0)


def hard_double(rng: random.Random) -> float:
    """Return a double with few or all bits, of any size, subnormal ones included."""
    bits = rng.choice([1, 2, 20, 26, 27, 28, 53])
    mantissa = rng.getrandbits(bits) | 1
    exponent = rng.choice([rng.randint(-8, 8), rng.randint(-1074, 970), -1074, 970])
    return rng.choice([-1.0, 1.0]) * math.ldexp(mantissa, exponent)


def test_is_exact_sum_of_any_doubles_is_equality_with_the_rational_sum() -> None:
    rng = random.Random(1)
    exact = 0
    for _ in range(20_000):
        a, b = hard_double(rng), hard_double(rng)
        if rng.random() < 0.5:
            b = math.ldexp(b, rng.randint(-54, 54)) if abs(b) < 1e280 else b
        total = a + b
        is_exact = math.isfinite(total) and Fraction(a) + Fraction(b) == Fraction(total)
        assert is_exact_sum(a, b, total) == is_exact, (a, b)
        exact += is_exact
    assert 1_000 < exact < 19_000


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (LARGEST, LARGEST),
        (LARGEST, -LARGEST),
        (LARGEST, math.ulp(LARGEST) / 2),
        (-LARGEST, math.ulp(LARGEST) / 4),
        (LARGEST, LEAST),
        (LEAST, LEAST),
        (LEAST, -LEAST),
        (2.0**-1022, -LEAST),
        (0.0, -0.0),
    ],
)
def test_is_exact_sum_at_the_ends_of_the_range_is_right(a: float, b: float) -> None:
    total = a + b
    is_exact = math.isfinite(total) and Fraction(a) + Fraction(b) == Fraction(total)
    assert is_exact_sum(a, b, total) == is_exact


def test_is_exact_product_in_its_range_is_equality_with_the_rational_product() -> None:
    rng = random.Random(2)
    exact = inside = 0
    for _ in range(20_000):
        a, b = hard_double(rng), hard_double(rng)
        if rng.random() < 0.5:  # about the smallest product
            b = math.ldexp(1.0 + rng.random(), -960 - math.frexp(a)[1] + rng.randint(-1, 2))
        product = a * b
        is_inside = (
            abs(product) >= SMALLEST_PRODUCT
            and max(abs(a), abs(b)) <= LARGEST_FACTOR
            and math.isfinite(product)
        )
        is_exact = is_inside and Fraction(a) * Fraction(b) == Fraction(product)
        assert is_exact_product(a, b, product) == (is_exact or b == 0.0), (a, b)
        inside += is_inside
        exact += is_exact
    assert inside > 5_000
    assert exact > 1_000


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (LEAST, 0.5),  # 2^-1075 is rounded to 0
        (LEAST, LEAST),
        (2.0**-540, 2.0**-540 * (1.0 + 2.0**-52)),  # the last bit would be 2^-1132
        (2.0**-537, 3.0 * 2.0**-538),  # exact, but out of the range
        (2.0**961, 2.0**-1000),  # likewise
        (2.0**900, 2.0**900),  # infinite
        (math.inf, 1.0),
        (math.nan, 1.0),
        (math.inf, 0.0),
    ],
)
def test_is_exact_product_out_of_its_range_is_false(a: float, b: float) -> None:
    assert not is_exact_product(a, b, a * b)


@pytest.mark.parametrize(("a", "b"), [(0.0, LARGEST), (-0.0, LEAST), (LEAST, 0.0), (0.0, 0.0)])
def test_is_exact_product_with_zero_is_true(a: float, b: float) -> None:
    assert is_exact_product(a, b, a * b)


def test_exact_cross_sign_of_coordinates_of_all_sizes_is_right_or_not_exact() -> None:
    rng = random.Random(3)
    known = 0
    for _ in range(5_000):
        size = rng.choice([1.0, 2.0**-300, 2.0**100, 2.0**-1070, 2.0**600])
        points = [(rng.randint(-9, 9) * size, rng.randint(-9, 9) * size) for _ in range(4)]
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = ((Fraction(x), Fraction(y)) for x, y in points)
        cross = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
        sign = exact_cross_sign(points[0], points[1], points[2], points[3])
        assert sign in {NOT_EXACT, (cross > 0) - (cross < 0)}
        if size in {1.0, 2.0**-300, 2.0**100}:
            assert sign != NOT_EXACT
            known += 1
    assert known > 1_000


def test_exactly_on_small_integers_holds_and_is_right() -> None:
    exactly = Exactly()
    assert exactly.cross(3.0, 5.0, 7.0, 11.0) == -2.0
    assert exactly.dot(3.0, 5.0, 7.0, 11.0) == 76.0
    assert exactly.minus(0.5, 0.25) == 0.25
    assert exactly.holds


def test_exactly_after_one_rounding_does_not_hold_again() -> None:
    exactly = Exactly()
    exactly.plus(1.0, 2.0**-60)
    exactly.plus(1.0, 1.0)
    assert not exactly.holds
    exactly = Exactly()
    exactly.times(1.0 / 3.0, 1.0 / 3.0)
    assert not exactly.holds
