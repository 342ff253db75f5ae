"""The search over pairs: what it does not look at, and what it must not leave out."""

from fractions import Fraction
from itertools import product
from random import Random

import pytest

from benchmarks.everyday import EVERYDAY
from exactpt import Body, Scene, Translation, first_contact
from exactpt.kernel.numbers import QQ, rational
from exactpt.motion import swept_edges
from exactpt.search import features_sweep as pairs
from exactpt.search.features_sweep import PairsSearch
from exactpt.search.first import pair_search, searches_pairs
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
    search = PairsSearch(jellies(Random("jellies"), 40, size))

    assert search.run_to_contact() is None
    assert search.certificates == 0


def test_a_slab_after_an_empty_one_is_not_so_long_that_most_of_its_candidates_come_later():
    bodies = [
        Body(
            f"b{i}",
            [(20 * x - 3, 20 * y - 2), (20 * x + 3, 20 * y - 3), (20 * x + 2, 20 * y + 3)],
            Translation([0, (37 * i) % 41 - 20], [0, (53 * i) % 43 - 21, -10]),
        )
        for i, (x, y) in enumerate((x, y) for x in range(14) for y in range(14))
    ]
    search = PairsSearch(Scene(bodies, (0, 40)))

    assert search.run_to_contact() is not None
    assert search.certificates == 139  # 557 with slabs that grow by 4, or are twice as full


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("speed", ["1/4", "1/2", "1"])
def test_an_edge_that_shrinks_to_a_point_is_a_contact(speed, closed):
    moving = {"x": [4, f"-{speed}"], "y": [0]}
    scene = Scene([Body("a", [(0, 0), moving, (4, 9), (0, 9)], closed=closed)], (0, 30))
    search = PairsSearch(scene)

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


def test_the_winner_s_time_is_not_looked_at_among_all_vertices(monkeypatch):
    """Two of forty bodies meet: what touches is looked for among the vertices near them."""
    asked = []

    def recorded(certifier, vertices, candidates):
        asked.extend(candidates)
        return touches(certifier, vertices, candidates)

    touches = pairs.touches
    monkeypatch.setattr(pairs, "touches", recorded)
    rest = [Body(f"b{i}", [(9 * i, 0), (9 * i + 4, 0), (9 * i, 4)]) for i in range(40)]
    ball = Body("ball", [(1, 9), (2, 9), (1, 10)], Translation([0], [0, -1]))

    contact = PairsSearch(Scene([*rest, ball], (0, 40))).run_to_contact()

    assert contact is not None
    assert contact.time == 6
    assert 4 <= len(asked) <= 9


def crowd(speeds, span, count=40):
    """Boxes on a grid, each with a velocity of its own."""
    bodies = []
    for i in range(count):
        x, y = 6 * (i % 7), 6 * (i // 7)
        corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        vx, vy = speeds(i)
        bodies.append(Body(f"b{i}", corners, Translation([0, vx], [0, vy])))
    return Scene(bodies, (0, span))


@pytest.fixture
def compared(monkeypatch):
    """How many pairs of boxes have been found to meet."""
    counted = []

    def counting(found):
        def wrapped(*boxes):
            for first, second in found(*boxes):
                counted.append(len(first))
                yield first, second

        return wrapped

    for module, name in (
        (swept_edges, "crossing_pairs"),
        (swept_edges, "overlapping_pairs"),
    ):
        monkeypatch.setattr(module, name, counting(getattr(module, name)))
    return counted


@pytest.mark.parametrize("slower", [0, QQ(1, 4096)])
def test_convoy_is_compared_as_if_it_stood(slower):
    """Of one common velocity, or nearly: all boxes met all others, in every slab.

    Boxes are 6 apart and 1 wide. They stand beside each other, or body i falls back by i t / 4096:
    two in a row, with numbers that differ by 1 to 6, come nearer by at most 600 / 4096 < 1.
    """
    search = pair_search(crowd(lambda i: (3 - i * slower, 1), 1000 if not slower else 100))

    assert search.run_to_contact() is None
    assert search.stats["pairs"] == 0


@pytest.mark.parametrize("straight", [True, False])
def test_slabs_do_not_depend_on_the_time_span(compared, straight):
    rng = Random("span")
    speeds = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(40)]
    counts = []
    for span in (100, 1_000, 100_000):
        scene = crowd(speeds.__getitem__, span)
        compared.clear()
        search = pair_search(scene) if straight else PairsSearch(scene)
        assert search.run_to_contact() is not None
        counts.append(search.stats["certificates"] if straight else sum(compared))

    assert 0 < max(counts) <= 1.2 * min(counts)


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
    looks, slabs = [], []
    for name, counted in (("_near", looks), ("_search", slabs)):
        found = getattr(PairsSearch, name)

        def counting(self, *args, found=found, counted=counted):
            counted.append(1)
            return found(self, *args)

        monkeypatch.setattr(PairsSearch, name, counting)
    scene = EVERYDAY["spinning rocks"](Random("auto:spinning rocks:6:0"), 6)

    assert first_contact(scene, method="pairs") is not None
    assert len(slabs) > 20
    assert len(looks) < 1.2 * len(slabs)
