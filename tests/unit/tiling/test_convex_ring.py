"""Searches on convex rings, beside searches of every vertex."""

from fractions import Fraction
from itertools import pairwise
from math import cos, pi, sin
from random import Random

import pytest
from folding import every

from benchmarks.statics import swept
from exactpt import Body, Rigid, Translation
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.tiling.greedy.bitangent import tangent_pair
from exactpt.tiling.greedy.convex_ring import chains_of, is_above, near_tangent


def round_polygon(n, x, y, r, turn=0.0, squeeze=1.0):
    angles = [2 * pi * (k + turn) / n for k in range(n)]
    return [(x + r * cos(a), y + squeeze * r * sin(a)) for a in angles]


def box_with_stops(stops, x, y, size):
    """A square whose sides have vertices inside: ties of x, and vertices that are flat."""
    along = [Fraction(size * k, stops) for k in range(stops)]
    return [
        *((x + s, y) for s in along),
        *((x + size, y + s) for s in along),
        *((x + size - s, y + size) for s in along),
        *((x, y + size - s) for s in along),
    ]


def bodies(rng):
    shapes = [
        round_polygon(rng.choice((3, 13, 40, 97)), 0, 0, 4, rng.random(), rng.choice((1, 0.1))),
        box_with_stops(rng.choice((1, 4, 9)), 12, rng.randint(-6, 6), 5),
        round_polygon(64, 3, 14, 5, rng.choice((0.0, 0.5))),  # symmetric: ties of x and of slopes
    ]
    moved = rng.choice((Translation(), Rigid([0, 1], pivot=(5, 5)), Translation([0, 1], [0, 2])))
    return [Body(str(i), shape[:: rng.choice((1, -1))], moved) for i, shape in enumerate(shapes)]


@pytest.mark.parametrize("after", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_extremes_and_sides_are_those_of_all_vertices(seed, after):
    rng = Random(seed)
    vertices = Vertices.of(bodies(rng), QQ(0), QQ(1))
    instant = PredicatesAt(vertices, QQ(0), after=after)
    for moving in vertices.bodies:
        ring = moving.ring
        lower, upper = chains_of(instant, ring)
        ordered = instant.sorted_by_x(ring)

        assert lower.ends == upper.ends == (ordered[0], ordered[-1])
        sides = [[chain.vertex(k) for k in range(chain.count)] for chain in (lower, upper)]
        assert sorted([*sides[0], *sides[1][1:-1]]) == sorted(ring)
        assert all(instant.left_of(a, b) for side in sides for a, b in pairwise(side))
        for v in sides[1][1:-1]:
            assert is_above(instant, lower, v)


@every("seed", range(12))
def test_the_tangent_is_found_from_the_chains_as_by_a_walk(seed):
    rng = Random(seed)
    vertices = Vertices.of(bodies(rng), QQ(0), QQ(1))
    instant = PredicatesAt(vertices, QQ(0))
    chains = [chains_of(instant, moving.ring) for moving in vertices.bodies]
    near = 0
    for i in range(3):
        for j in range(3):
            for sides in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
                if i == j:
                    continue
                walked = tangent_pair(
                    instant, chains[i][0].vertex(0), chains[j][0].vertex(0), *sides
                )
                a, b = (chains[k][0 if s > 0 else 1] for k, s in zip((i, j), sides, strict=True))
                if not instant.left_of(*walked):
                    continue
                found = near_tangent(instant, a, b, *sides)
                assert tangent_pair(instant, *found, *sides) == walked
                near += found == walked
    assert near >= 10


def test_decisions_grow_with_the_square_of_the_logarithm():
    few, many = (
        swept([Body(str(i), round_polygon(n, 11 * i, 3 * i % 7, 4)) for i in range(9)])
        for n in (64, 2048)
    )

    assert few.diagonals == many.diagonals == 24
    assert many.decisions < 4 * few.decisions  # of a walk: 32 times
