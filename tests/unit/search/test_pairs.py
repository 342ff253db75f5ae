"""The search over pairs: what it does not look at, and what it must not leave out."""

from fractions import Fraction
from itertools import product
from random import Random

import pytest

from benchmarks.everyday import EVERYDAY
from exactpt import Body, Scene, Translation
from exactpt.kernel.numbers import QQ, rational
from exactpt.search.first import pair_search, searches_pairs
from exactpt.search.sweep_search import AllPairs
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def jellies(rng, count, size):
    """Deforming polygons in a row, far apart, each on its way."""
    bodies = []
    for i in range(count):
        corners = [(30, 0), (21, 21), (0, 30), (-21, 21), (-30, 0), (-21, -21), (0, -30), (21, -21)]
        ring = [
            {"x": [100 * i + x, rng.randint(-1, 1)], "y": [y, rng.randint(-1, 1)]}
            for x, y in corners[:: 8 // size]
        ]
        bodies.append(Body(f"j{i}", ring, Translation([0], [0, rng.randint(-3, 3)])))
    return Scene(bodies, (0, 4))


@pytest.mark.parametrize("size", [4, 8])
def test_edges_of_a_deforming_body_that_cannot_vanish_cost_nothing(size):
    search = pair_search(jellies(Random("jellies"), 40, size))

    assert search.run_to_contact() is None
    assert search.stats["certificates"] == 0


def test_a_slab_after_an_empty_one_is_not_so_long_that_most_of_its_candidates_come_later():
    bodies = [
        Body(
            f"b{i}",
            [(20 * x - 3, 20 * y - 2), (20 * x + 3, 20 * y - 3), (20 * x + 2, 20 * y + 3)],
            Translation([0, (37 * i) % 41 - 20], [0, (53 * i) % 43 - 21, -10]),
        )
        for i, (x, y) in enumerate((x, y) for x in range(14) for y in range(14))
    ]
    search = pair_search(Scene(bodies, (0, 40)))

    assert search.run_to_contact() is not None
    assert search.stats["certificates"] < 400


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("speed", ["1/4", "1/2", "1"])
def test_an_edge_that_shrinks_to_a_point_is_a_contact(speed, closed):
    moving = {"x": [4, f"-{speed}"], "y": [0]}
    scene = Scene([Body("a", [(0, 0), moving, (4, 9), (0, 9)], closed=closed)], (0, 30))
    search = pair_search(scene)

    contact = search.run_to_contact()

    expected = reference.first_contact(scene)
    assert contact is not None
    assert disagreement(expected, contact) is None
    assert contact.time == 4 / rational(speed)


def test_auto_is_pairs_unless_a_tiling_is_named():
    assert searches_pairs("auto", "auto")
    assert not searches_pairs("auto", "mixed")
    assert searches_pairs("pairs", "mixed")
    assert not searches_pairs("kinetic", "auto")


def crowd(speeds, span, count=40, bend=()):
    """Boxes on a grid, each with a velocity of its own; in x all may have one acceleration."""
    bodies = []
    for i in range(count):
        x, y = 6 * (i % 7), 6 * (i // 7)
        corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        vx, vy = speeds(i)
        bodies.append(Body(f"b{i}", corners, Translation([0, vx, *bend], [0, vy])))
    return Scene(bodies, (0, span))


@pytest.mark.parametrize("slower", [0, QQ(1, 4096)])
def test_convoy_is_compared_as_if_it_stood(slower):
    """Of one common velocity, or nearly: all boxes met all others, in every slab.

    Boxes are 6 apart and 1 wide. They stand beside each other, or body i falls back by i t / 4096:
    two in a row, with numbers that differ by 1 to 6, come nearer by at most 600 / 4096 < 1.
    """
    search = pair_search(crowd(lambda i: (3 - i * slower, 1), 1000 if not slower else 100))

    assert search.run_to_contact() is None
    assert search.stats["pairs"] == 0


@pytest.mark.parametrize("bend", [(), (2.0**-20,)])
def test_slabs_do_not_depend_on_the_time_span(bend):
    rng = Random("span")
    speeds = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(40)]
    counts = []
    for span in (100, 1_000, 100_000):
        search = pair_search(crowd(speeds.__getitem__, span, bend=bend))
        assert search.run_to_contact() is not None
        counts.append((search.stats["slabs"], search.stats["certificates"]))

    assert counts[0][1] > 0
    assert counts == counts[:1] * 3


@pytest.mark.parametrize("is_mixed", [False, True])
def test_bodies_that_fly_apart_have_few_slabs_in_the_rest_of_the_span(is_mixed):
    """Each slab is twice as long as the one before, as few boxes meet in it.

    Velocities are a tenth of the places, so no two bodies meet. Their speeds |vx| + |vy| are 0.8 on
    average, and a square of 45 x 45 with 256 of them gives each 5.6 on a side, so a first slab is
    0.5 * 5.6 / 0.8 = 3.5 long, and 19 slabs of 3.5, 7, 14, ... reach the end at 10^6.
    """
    bodies = [
        Body(f"b{k}", SQUARE, Translation([3 * x, 0.1 * x], [3 * y, 0.1 * y]))
        for k, (x, y) in enumerate(product(range(-8, 8), repeat=2))
    ]
    if is_mixed:  # one passes between two rows
        bodies.append(Body("late", SQUARE, Translation([-99, Fraction(1, 9)], [Fraction(3, 2)])))

    search = pair_search(Scene(bodies, (0, 10**6)))

    assert search.run_to_contact() is None
    assert search.stats["slabs"] <= 20


def test_a_slab_that_was_too_long_is_not_tried_each_time(monkeypatch):
    """Spinning rocks: a slab twice as long has seven times as many candidates."""
    looks, during = [], AllPairs.during
    monkeypatch.setattr(AllPairs, "during", lambda *a: looks.append(1) or during(*a))
    scene = EVERYDAY["spinning rocks"](Random("auto:spinning rocks:6:0"), 6)
    search = pair_search(scene)

    assert search.run_to_contact() is not None
    assert len(looks) < 1.2 * search.stats["slabs"]
