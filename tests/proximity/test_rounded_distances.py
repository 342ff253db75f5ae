"""Distances and intervals of rounded bodies: by hand, and against the definition."""

import pickle
from fractions import Fraction
from itertools import combinations
from random import Random

import pytest
import reference
from mpmath import mp, mpf
from tiny import scene_of

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
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.kernel.square_root import nearest_root_less

DISC = Body("disc", [(0, 0)], Translation([0, 1]), radius=1)
PILL = Body("pill", [(9, -2), (9, 2)], radius="1/2")
SCENE = Scene([DISC, PILL], (0, 20))


def rounded(random):
    """Tiny scenes in which one or both bodies have a radius."""
    scene = scene_of(random)
    radii = random.choice([(0, 1), (1, 1), ("1/2", 2), (1, 0), (2, "3/2")])
    bodies = [
        Body(b.name, b.vertices, b.motion, closed=b.closed, radius=r)
        for b, r in zip(scene.bodies, radii, strict=True)
    ]
    return Scene(bodies, (scene.start, scene.end))


def reach_of(scene):
    return sum(QQ(body.radius) for body in scene.bodies)


def intervals_by_definition(a, b, start, end, squared):
    """As `reference.contact_intervals`: cores within a distance, at and between critical times."""
    begin = AlgebraicNumber(start)
    states = [(begin, reference.is_within(begin, a, b, *reference.tracks(a, b, start), squared))]
    for since, until, p, q in reference.pieces(a, b, start, end):
        corners = [(v, p[k], p[l]) for v in q for k, l in a.edges]
        corners += [(v, q[k], q[l]) for v in p for k, l in b.edges]
        critical = [reference.excess_of_line(v, c, d, squared) for v, c, d in corners]
        critical += [reference.dot(reference.gap(c, d), reference.gap(c, v)) for v, c, d in corners]
        critical += [reference.dot(reference.gap(d, c), reference.gap(d, v)) for v, c, d in corners]
        critical += [reference.excess_of_vertices(u, v, squared) for u in p for v in q]
        critical += [reference.orientation(*three) for three in combinations([*p, *q], 3)]
        for time in reference.critical_times(critical, since, until):
            between = AlgebraicNumber(rational_between(states[-1][0], time))
            states.append((None, reference.is_within(between, a, b, p, q, squared)))
            states.append((time, reference.is_within(time, a, b, p, q, squared)))
    found, since, last = [], None, None
    for time, within in states:
        if time is not None and within:
            since, last = since or time, time
        elif time is None and not within and since is not None:
            found.append((since, last))
            since = None
    return [*found, (since, last)] if since is not None else found


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


COUNTS = [60, pytest.param(3_000, marks=pytest.mark.slow)]


@pytest.mark.parametrize("count", COUNTS, ids=["few", "many"])
def test_intervals_against_the_definition(count):
    random = Random(f"rounded intervals {count}")
    touched = 0
    for _ in range(count):
        scene = rounded(random)
        a, b = scene.bodies
        found = [(i.start, i.end) for i in contact_intervals(scene, "a", "b")]
        squared = reach_of(scene) ** 2
        assert found == intervals_by_definition(a, b, scene._start, scene._end, squared)
        assert [(i.start, i.end) for i in contacts(scene)] == found
        touched += len(found)

    assert touched > count / 3


@pytest.mark.parametrize("count", COUNTS, ids=["few", "many"])
def test_first_within_against_the_definition(count):
    random = Random(f"rounded within {count}")
    for _ in range(count):
        scene = rounded(random)
        a, b = scene.bodies
        d = QQ(random.choice([0, 1, 2]), random.choice([1, 3]))
        time = first_within(scene, "a", "b", d, norm="euclidean")
        squared = (d + reach_of(scene)) ** 2
        assert time == reference.first_within(a, b, scene._start, scene._end, squared)


@pytest.mark.parametrize("count", COUNTS, ids=["few", "many"])
def test_the_clearance_is_the_distance_at_every_time(count):
    random = Random(f"rounded clearance {count}")
    for _ in range(count // 3):
        scene = rounded(random)
        gap = clearance(scene, "a", "b")
        least = float(gap.minimum)
        for _ in range(5):
            t = Fraction(random.randint(0, 400), 100)
            assert gap(t) == float(distance(scene, "a", "b", at=t)) >= least


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
