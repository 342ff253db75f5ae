"""The float filter of pairs of features leaves out none that is ever nearest."""

from itertools import pairwise
from math import cos, pi, sin
from random import Random

import pytest

from exactpt import Body, Rigid, Scene, Translation, clearance
from exactpt.kernel.numbers import QQ
from exactpt.pairs import intervals
from exactpt.pairs.features import feature_pairs
from exactpt.pairs.near_features import NearFeatures
from exactpt.pairs.piece_pairs import piece_pairs
from fuzz.questions.tiny import pair_scene


def ring(n, x=0, y=0):
    return [(x + cos(2 * pi * k / n), y + sin(2 * pi * k / n)) for k in range(n)]


SCENES = {
    "squares side by side": ([(0, 0), (1, 0), (1, 1), (0, 1)], Translation([0, "1/8"])),
    "turning": (ring(5), Rigid([0, "1/2"])),
    "turning about a far pivot": (ring(4), Rigid([0, "1/3"], pivot=(50, 1), x=[0, 1])),
    "accelerated": (ring(6), Translation([0, 0, "1/9"], [0, -1, "1/3"])),
    "a point": ([(2, -1)], Translation([0, 0], [0, 1])),
    "a tiny edge": ([(0, 0), ("1e-60", 0)], Translation([0, "1/8"], [0, "1/8"])),
}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("offset", [0, 10**30])
def test_the_nearest_pairs_are_kept(name, offset):
    """At the ends and in the middle of each of many intervals, by exact squares of distances."""
    points, motion = SCENES[name]
    a = Body("a", [(QQ(x) + offset, y) for x, y in points], motion)
    b = Body("b", [(QQ(x) + offset, y) for x, y in ring(4, 5, 1)])
    random = Random(name)
    (piece_pair,) = piece_pairs(a, b, QQ(0), QQ(3))
    near = NearFeatures(a, b, piece_pair)
    pairs = list(feature_pairs(a, b, piece_pair.first, piece_pair.second))
    for _ in range(4):
        low = QQ(random.randrange(0, 200), 100)
        high = low + QQ(1, random.choice((1, 8, 1000)))
        kept = set(near.nearest(near.all, low, high).tolist())
        for t in (low, (low + high) / 2, high):
            gaps = {k: gap for k, pair in enumerate(pairs) if (gap := _gap(pair, t)) is not None}
            least = min(gaps.values())
            assert {k for k, gap in gaps.items() if gap == least} <= kept
        if high - low < QQ(1, 10):
            assert len(kept) < len(pairs)


@pytest.mark.parametrize("offset", [0, 10**6])
def test_the_nearest_pairs_of_translating_polygons_are_kept(offset, monkeypatch):
    """The filter of second order, at work on few pairs: one body passes beside the other."""
    monkeypatch.setattr("exactpt.pairs.near_features.ENOUGH", 1)
    random, left_out = Random(offset), 0
    for k in range(24):
        sides = random.randint(1, 12), random.randint(1, 12)
        bend = QQ(random.randint(-9, 9), 9)
        a = Body("a", ring(sides[0], offset), Translation([0, bend], [random.uniform(-2, 0), 2]))
        b = Body("b", ring(sides[1], offset + random.uniform(3, 5), random.uniform(-1, 1)))
        (piece_pair,) = piece_pairs(a, b, QQ(0), QQ(1))
        near = NearFeatures(a, b, piece_pair)
        pairs = list(feature_pairs(a, b, piece_pair.first, piece_pair.second))
        low, high = [(QQ(0), QQ(1)), (QQ(1, 3), QQ(1))][k % 2]
        kept = set(near.nearest(near.all, low, high).tolist())
        left_out += len(pairs) - len(kept)
        for t in (low, (2 * low + high) / 3, (low + high) / 2, (low + 5 * high) / 6, high):
            gaps = {k: g for k, pair in enumerate(pairs) if (g := _gap(pair, t)) is not None}
            least = min(gaps.values())
            assert {k for k, gap in gaps.items() if gap == least} <= kept
    assert left_out > 1000


def _gap(pair, t):
    """The squared distance, computed from positions; None where the foot is beyond an end."""
    (x, y), (ax, ay) = pair.v.exact_at(t), pair.ends[0].exact_at(t)
    wx, wy = x - ax, y - ay
    if not pair.is_of_edge:
        return wx * wx + wy * wy
    bx, by = pair.ends[1].exact_at(t)
    ux, uy = bx - ax, by - ay
    at = (ux * wx + uy * wy) / (ux * ux + uy * uy)
    return (wx - at * ux) ** 2 + (wy - at * uy) ** 2 if 0 <= at <= 1 else None


@pytest.mark.long
def test_pieces_are_those_of_all_pairs(monkeypatch):
    """In small windows and in one window with all pairs."""
    scenes = [pair_scene(Random(seed)) for seed in range(25)]
    found = [_pieces(scene) for scene in scenes]
    monkeypatch.setattr(NearFeatures, "nearest", lambda _self, numbers, _low, _high: numbers)
    assert found == [_pieces(scene) for scene in scenes]


def _pieces(scene):
    a, b = (body.name for body in scene.bodies)
    return clearance(scene, a, b).pieces


@pytest.mark.long
def test_pieces_of_turning_polygons():
    a, b = Body("a", ring(18), Rigid([0, "1/2"])), Body("b", ring(18, 5, 1))
    gap = clearance(Scene([a, b], time=(0, 10)), "a", "b")

    assert len(gap.pieces) > 20
    for first, second in pairwise(gap.pieces):
        assert first.end == second.start
        assert first.features != second.features


@pytest.mark.long
@pytest.mark.parametrize("radius", [0, "1/3"])
def test_incidences_of_near_features_are_those_of_all(radius, monkeypatch):
    found = 0
    for seed in range(25):
        scene = pair_scene(Random(seed))
        a, b = scene.bodies[0].with_radius(radius), scene.bodies[1]
        times = []
        for few in (10**9, -1):
            monkeypatch.setattr(intervals, "FEW", few)
            times.append(intervals.incidence_times(a, b, scene.exact_start, scene.exact_end))
        assert times[0] == times[1]
        found += len(times[0])
    assert found > 30
