"""The distance over time, of rounded bodies too: by hand, samples and the definition."""

import pickle
from fractions import Fraction
from itertools import pairwise
from random import Random

import pytest
from mpmath import mp, mpf

from exactpt import (
    Body,
    InputError,
    Rigid,
    Scene,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_within,
)
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.algebraic_value import quotient_at, square_root
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.square_root import nearest_root_less
from exactpt.pairs import clearance as module
from fuzz.questions.checks import checked
from fuzz.questions.tiny import pair_scene

BOX = Body("box", [(0, 0), (2, 0), (2, 2), (0, 2)])


def gap_of(body, time=(0, 20)):
    return clearance(Scene([body, BOX], time), body.name, "box")


def test_a_point_that_passes_a_box():
    gap = gap_of(Body("point", [(-9, 3)], Translation([0, 1])))

    assert [(float(p.start), float(p.end), p.features) for p in gap.pieces] == [
        (0, 9, ((0, None), (3, None))),
        (9, 11, ((0, None), (None, 2))),
        (11, 20, ((0, None), (2, None))),
    ]
    assert gap.minimum == (9, 1)


def test_a_least_distance_at_an_irrational_time():
    """Along a parabola past the corner (2, 2): the least distance is where a cubic vanishes."""
    gap = gap_of(Body("point", [(6, -1)], Translation([0, -1], [0, "1/2", "1/7"])), time=(0, 9))

    assert not gap.minimum.time.is_rational
    t, least = float(gap.minimum.time), float(gap.minimum)
    assert gap(t) == pytest.approx(least, abs=1e-12)
    assert all(gap(Fraction(k, 16)) >= least for k in range(144))


def test_values_that_are_surely_larger_are_not_computed(monkeypatch):
    """Of a turning box, only the least of the distances at the ends of pieces is exact."""
    computed = []
    monkeypatch.setattr(module, "quotient_at", lambda *a: computed.append(a) or quotient_at(*a))
    turning = Rigid([0, Fraction(1, 2)], pivot=(9, 1), x=[0, Fraction(-1, 7)])

    gap = gap_of(Body("other", [(8, 0), (10, 0), (10, 3)], turning), time=(0, 9))
    least = gap.minimum

    assert len(gap.pieces) > 4
    assert len(computed) == 1
    assert all(gap.squared(Fraction(k, 16)) >= least.squared for k in range(144))


def test_distances_of_turning_bodies_are_in_lowest_terms():
    """At one denominator the difference of two squared distances is of degree 4, not 8."""
    turning = Rigid([0, Fraction(1, 2)], pivot=(9, 1))

    gap = gap_of(Body("other", [(8, 0), (10, 0), (10, 3)], turning), time=(0, 9))

    assert max(len(piece.start.exact_polynomial) for piece in gap.pieces) == 5


def test_where_bodies_meet_the_distance_is_zero():
    gap = gap_of(Body("point", [(-9, 1)], Translation([0, 1])))

    assert [p.features for p in gap.pieces].count(None) == 1
    assert gap.squared(10) == 0
    assert gap.minimum == (9, 0)
    assert gap(12) == 1.0


def test_edges_that_stay_parallel():
    gap = gap_of(Body("other", [(5, 0), (7, 0), (7, 2), (5, 2)], Translation([0, 1])))

    assert len(gap.pieces) == 1
    assert gap.minimum == (0, 9)


def test_outside_of_the_span():
    with pytest.raises(InputError, match="outside of the time span"):
        gap_of(Body("point", [(5, 5)])).squared(21)


def check(scene):
    """Pieces follow each other without a jump, and are right in their middles and at ends."""
    a, b = (body.name for body in scene.bodies)
    gap = clearance(scene, a, b)
    start, end = AlgebraicNumber(scene.exact_start), AlgebraicNumber(scene.exact_end)
    assert gap.pieces[0].start == start
    assert gap.pieces[-1].end == end
    for before, after in pairwise(gap.pieces):
        assert before.end == after.start
        assert value(before, before.end) == value(after, after.start)
    samples = [
        scene.exact_start + (scene.exact_end - scene.exact_start) * k / 12 for k in range(13)
    ]
    for piece in gap.pieces:
        if piece.start < piece.end:
            middle = rational_between(piece.start, piece.end)
            samples += [middle, rational_between(piece.start, AlgebraicNumber(middle))]
    least = gap.minimum.squared
    for t in samples:
        squared = distance(scene, a, b, at=t).squared
        assert gap.squared(t) == squared
        assert least <= squared
    assert (least == 0) == bool(contact_intervals(scene, a, b))
    return len(gap.pieces)


def value(piece, t):
    return quotient_at(tuple(map(ZZ, piece.numerator)), tuple(map(ZZ, piece.denominator)), t)


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [60, pytest.param(2_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_tiny_scenes_against_samples(count):
    random = Random(f"clearance {count}")

    assert sum(check(pair_scene(random)) for _ in range(count)) > 2 * count


def test_values_of_quotients():
    root = AlgebraicNumber.root((-2, 0, 1), 1, 2)

    assert quotient_at((ZZ(0), ZZ(0), ZZ(1)), (ZZ(3),), root) == QQ(2, 3)
    shifted = quotient_at((ZZ(1), ZZ(1)), (ZZ(0), ZZ(1)), root)
    assert shifted.minimal_polynomial() == (1, -4, 2)  # 1 + 1 / sqrt(2)
    assert square_root(AlgebraicNumber(QQ(9, 4))) == QQ(3, 2)
    assert square_root(root).minimal_polynomial() == (-2, 0, 0, 0, 1)
    assert square_root(AlgebraicNumber(0)) == 0


@pytest.mark.parametrize("narrow", [0, 60, 1000])
def test_bounds_of_values_have_no_more_digits_than_they_need(narrow):
    """However many the bounds of the time have: a value of a value of a value stays cheap."""
    number = AlgebraicNumber.root((-1, -1, 0, 0, 0, 1), 1, 2)  # t^5 = t + 1
    number.refine_to(QQ(1, 2**narrow))
    for _ in range(3):
        number = square_root(quotient_at((ZZ(1), ZZ(0), ZZ(3)), (ZZ(2), ZZ(1)), number))
        width = number.high - number.low

        needed = (width.denominator // width.numerator).bit_length()
        assert number.low.denominator.bit_length() <= needed + 8


# Distances and intervals of rounded bodies: by hand, and against the definition

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
    assert first_within(SCENE, "disc", "pill", 2) == Fraction(11, 2)
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
    with pytest.raises(InputError, match="distance_squared=2: of rounded bodies"):
        first_within(SCENE, "disc", "pill", distance_squared=2)
    assert first_within(SCENE, "disc", "pill", distance_squared=4) == 5.5


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


def test_the_square_with_the_radius_of_discs_that_overlap():
    scene = Scene([Body("a", [(0, 0)], radius=1), Body("b", [(1, 0)], radius=1)], time=(0, 1))
    gap = clearance(scene, "a", "b")

    assert distance(scene, "a", "b", at=0).core_squared == 1
    assert gap.squared_with_radius(0) == 4  # they overlap: at distance 0
