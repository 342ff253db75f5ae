"""Euclidean distances, and when they are reached: by hand, and against the definition."""

import math
from fractions import Fraction
from random import Random

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from exactpt import Body, InputError, Rigid, Scene, Translation, distance, first_within
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.kernel.square_root import nearest_square_root
from exactpt.testing import reference
from fuzz.questions.tiny import pair_scene

WALL = Body("wall", [(10, -9), (10, 9)])
BOX = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])


def within(a, b, d=None, time=(0, 20), **options):
    scene = Scene([a, b], time)
    return first_within(scene, a.name, b.name, d, **options)


def test_a_point_that_comes_to_a_corner():
    """The circle around the corner, not the square."""
    point = Body("point", [(-20, -20)], Translation([0, 1], [0, 1]))

    time = within(point, BOX, 1)

    assert time.polynomial == (799, -80, 2)  # (t - 20)^2 * 2 = 1
    assert within(point, BOX, distance_squared=2) == 19


def test_a_point_that_comes_to_an_edge():
    point = Body("point", [(-20, 5)], Translation([0, 1]))

    assert within(point, BOX, "1/3") == QQ(59, 3)


def test_a_graze_of_the_offset_curve_counts():
    """A parabola that comes to distance 1 of the edge once, and to no other point of it."""
    point = Body("point", [(5, -2)], Translation([-10, 5], [0, 0]))
    grazing = Body("grazing", [(-3, 10)], Translation([0, 1], [9, -6, 1]))

    assert within(point, BOX, 2) == 1
    assert within(grazing, BOX, 1) == 3
    assert within(grazing, BOX, "999/1000") is None


def test_inside_is_distance_zero():
    inner = Body("inner", [(1, 1), (2, 1), (1, 2)])

    assert within(inner, BOX, 0) == 0
    assert float(distance(Scene([inner, BOX]), "inner", "box", at=0)) == 0


def test_bodies_that_keep_their_distance():
    """All polynomials of the nearest features vanish identically, or none does."""
    first = Body("first", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    second = Body("second", [(4, 0), (5, 0), (4, 1)], Translation([0, 1]))

    assert within(first, second, 3) == 0
    assert within(first, second, "299/100") is None


def test_the_features_at_a_time():
    point = Body("point", [(-20, 5)], Translation([0, 1]))
    there = distance(Scene([point, BOX], time=(0, 30)), "point", "box", at="37/2")

    assert there.squared == Fraction(9, 4)
    assert float(there) == 1.5
    assert there.features == (((0, None), (None, 3)),)


def test_distances_at_wrong_times():
    scene = Scene([WALL, BOX], time=(0, 1))
    root = AlgebraicNumber.root((-2, 0, 9), 0, 1)
    with pytest.raises(InputError, match=r"irrational time: use \.low, \.high or float"):
        distance(scene, "wall", "box", at=root)
    with pytest.raises(InputError, match="outside of"):
        distance(scene, "wall", "box", at=2)
    assert distance(scene, "wall", "box", at=AlgebraicNumber(QQ(1))).squared == 25


def test_turning_bodies():
    """The corner of a mill comes within 1 of a point on the circle around its pivot, at most."""
    mill = Body("mill", [(0, -5), (1, -5), (1, 5), (0, 5)], Rigid([0, -1], pivot=(0, 0)))
    point = Body("point", [(6, 0)])

    time = within(mill, point, 1, time=(0, 1))

    assert abs(_gap(mill, point, float(time)) - 1) < 1e-9


def _gap(a, b, t):
    return float(distance(Scene([a, b], (0, 20)), a.name, b.name, at=t))


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [100, pytest.param(4_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_tiny_scenes_against_the_definition(count):
    random = Random(f"within {count}")
    found = 0
    for _ in range(count):
        scene = pair_scene(random)
        a, b = scene.bodies
        squared = QQ(random.choice([0, 1, 2, 4, 5]), random.choice([1, 1, 2, 9]))
        time = first_within(scene, "a", "b", distance_squared=squared)
        assert time == reference.first_within(a, b, scene.time, squared)
        found += time is not None and time > 0

    assert found > count / 10


@given(st.fractions(min_value=0))
def test_the_square_root_is_rounded_correctly(value):
    mp.prec = 4000
    expected = float(mp.sqrt(mpf(value.numerator) / mpf(value.denominator)))

    assert nearest_square_root(QQ(value)) == expected


@every("exponent", [-2148, -2146, -2100, -1074, -1, 0, 1, 2046, 2047, 2048, 2050])
def test_square_roots_of_powers_of_two(exponent):
    value = Fraction(2) ** exponent
    root = nearest_square_root(QQ(value))

    if exponent >= 2048:
        assert root == math.inf
    elif exponent % 2 == 0 and exponent >= -2148:
        assert Fraction(root) ** 2 == value
    else:
        assert abs(Fraction(root) ** 2 - value) <= value * Fraction(2) ** -50 or root < 1e-300


@pytest.mark.parametrize("x", [1.0, 1.5, 3.0, 1e-300, 5e-324, 1.7976931348623157e308])
def test_midpoints_of_doubles(x):
    """The root of a square a little below, at, or above a midpoint of two doubles."""
    above = math.nextafter(x, math.inf)
    if math.isinf(above):
        return
    middle = (Fraction(x) + Fraction(above)) / 2

    assert nearest_square_root(QQ(middle**2 - middle**2 / 2**200)) == x
    assert nearest_square_root(QQ(middle**2 + middle**2 / 2**200)) == above
    assert nearest_square_root(QQ(middle**2)) in {x, above}


def test_bodies_far_from_each_other_have_no_exact_place_at_the_start(monkeypatch):
    """Boxes in doubles decide which pairs are compared there: 200 exact bodies cost more."""
    bodies = [
        Body(f"b{i}", [(9 * i, 0), (9 * i + 2, 0.5), (9 * i + 1, 2)], Translation([0, -i % 3 / 8]))
        for i in range(200)
    ]
    placed, at = [], Body.exact_at
    monkeypatch.setattr(Body, "exact_at", lambda body, time: placed.append(body) or at(body, time))

    found = first_within(Scene(bodies, (0, 10)), distance=6)

    assert found is not None
    assert not placed


@pytest.mark.parametrize("count", [2, 40])
@pytest.mark.parametrize("radius", [0, Fraction(1, 2)])
def test_within_a_distance_at_the_start_among_few_and_many(count, radius):
    """Boxes are grown by half of the distance and the radius, or are within both."""
    bodies = [
        Body(f"b{i}", [(5 * i, 0)], Translation([0, -i]), radius=radius) for i in range(count)
    ]
    scene = Scene(bodies, (3, 9))

    for d, time in ((2, 3), (1, 4), (Fraction(1, 2) + radius, Fraction(9, 2) - radius)):
        found = first_within(scene, distance=d - 2 * radius)
        assert found.time == time
        assert len(found.pairs) == count - 1
