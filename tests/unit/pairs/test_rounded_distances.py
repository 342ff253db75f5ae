"""Distances and intervals of rounded bodies: by hand, and against the definition."""

import pickle
from fractions import Fraction
from random import Random

import pytest
from mpmath import mp, mpf

from exactpt import (
    Body,
    InputError,
    Scene,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_within,
)
from exactpt.kernel.numbers import QQ
from exactpt.kernel.square_root import nearest_root_less
from fuzz.questions.checks import checked

DISC = Body("disc", [(0, 0)], Translation([0, 1]), radius=1)
PILL = Body("pill", [(9, -2), (9, 2)], radius="1/2")
SCENE = Scene([DISC, PILL], (0, 20))


def test_a_disc_and_a_pill():
    gap = distance(SCENE, "disc", "pill", at=2)

    assert (float(gap), gap.squared, gap.core_squared, gap.radius) == (
        5.5,
        Fraction(121, 4),
        49,
        1.5,
    )
    assert gap.features == (((0, None), (None, 0)),)
    assert float(distance(SCENE, "disc", "pill", at=9)) == 0
    assert first_within(SCENE, "disc", "pill", 2, norm="euclidean") == Fraction(11, 2)
    assert first_within(SCENE, "disc", "pill", 2, norm="x") == Fraction(11, 2)
    (meeting,) = contact_intervals(SCENE, "disc", "pill")
    assert (meeting.start, meeting.end) == (Fraction(15, 2), Fraction(21, 2))
    assert contacts(SCENE) == [meeting]


def test_an_irrational_distance():
    there = distance(Scene([Body("a", [(0, 0)], radius=1), Body("b", [(3, 1)])]), "a", "b", at=0)

    assert float(there) == pytest.approx(10**0.5 - 1, abs=1e-15)
    with pytest.raises(InputError, match="irrational here"):
        _ = there.squared


def test_the_clearance_of_discs_that_pass():
    scene = Scene([DISC, Body("post", [(9, 4)], radius="3/2")], (0, 20))
    gap = clearance(scene, "disc", "post")

    assert gap.minimum == (9, Fraction(9, 4))
    assert gap.minimum.distance == Fraction(3, 2)
    assert gap(6) == 2.5
    assert gap.squared(6) == Fraction(25, 4)
    assert pickle.loads(pickle.dumps(gap)) == gap


def test_where_discs_overlap_the_clearance_is_zero():
    gap = clearance(SCENE, "disc", "pill")

    assert [piece.features is None for piece in gap.pieces] == [False, True, False]
    assert gap(9) == gap.squared(9) == 0
    assert gap.minimum == (Fraction(15, 2), 0)


def test_what_rounded_bodies_are_not_asked():
    with pytest.raises(InputError, match='norm "max" is for bodies without radius'):
        first_within(SCENE, "disc", "pill", 1, norm="max")
    with pytest.raises(InputError, match="distance_squared=2: of rounded bodies"):
        first_within(SCENE, "disc", "pill", norm="euclidean", distance_squared=2)
    assert first_within(SCENE, "disc", "pill", norm="euclidean", distance_squared=4) == 5.5


def test_a_touch_in_passing_is_one_moment():
    scene = Scene([DISC, Body("post", [(9, 2)], radius=1)], (0, 20))

    assert [(i.start, i.end) for i in contact_intervals(scene, "disc", "post")] == [(9, 9)]


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [100, pytest.param(1_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_tiny_pairs_against_the_definition(count):
    kinds = set()
    for number in range(count):
        case = checked("rounded", count, number)
        assert case.fault is None
        kinds.add(case.kind)

    assert len(kinds) > 3


@pytest.mark.parametrize("exponent", [0, 8, 40, 200, 900])
def test_a_root_less_a_rational_is_rounded_correctly(exponent):
    """Also where nearly everything cancels."""
    mp.prec = 8000
    random = Random(exponent)
    for _ in range(50):
        value = Fraction(random.randint(1, 10**9), random.randint(1, 10**9))
        near = Fraction(
            int(mp.floor(mp.sqrt(mpf(value.numerator) / value.denominator) * 2**exponent)),
            2**exponent,
        )
        exact = mp.sqrt(mpf(value.numerator) / value.denominator)
        exact -= mpf(near.numerator) / near.denominator
        assert nearest_root_less(QQ(value), QQ(near)) == float(exact)


def test_the_former_name_of_the_square_with_the_radius_warns():
    scene = Scene([Body("a", [(0, 0)], radius=1), Body("b", [(1, 0)], radius=1)], time=(0, 1))
    gap = clearance(scene, "a", "b")

    assert distance(scene, "a", "b", at=0).core_squared == 1
    assert gap.squared_with_radius(0) == 4  # they overlap: at distance 0
    with pytest.warns(DeprecationWarning, match="squared_with_radius"):
        assert gap.core_squared(0) == 4
