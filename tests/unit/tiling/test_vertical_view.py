"""What a vertex sees straight up and down: the walk through the tiles against all edges."""

from random import Random

import pytest
from flipped import flipped_at_random, scattered

from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.tiling.greedy.convex_ring import chains_of
from exactpt.tiling.greedy.visibility import seen_from
from exactpt.tiling.lazy import LazyRules


def height_over(p, q, x):
    return p[1] + (q[1] - p[1]) * (x - p[0]) / (q[0] - p[0])


def nearest_edge(instant, v, *, up):
    """Of all edges of other bodies that the vertical of v crosses, the nearest: its ends."""
    x, y = instant.position(v)
    best = None
    for u in instant.vertices.all:
        if u.body == instant.vertices.all[v].body:
            continue
        p, q = instant.position(u.id), instant.position(u.ahead)
        if (p[0] < x < q[0]) or (q[0] < x < p[0]):
            distance = (height_over(p, q, x) - y) * (1 if up else -1)
            if distance > 0 and (best is None or distance < best[0]):
                best = distance, frozenset((u.id, u.ahead))
    return best and best[1]


@pytest.mark.parametrize("seed", range(30))
def test_a_vertical_that_meets_a_tile_twice_ends_at_the_nearest_edge(seed):
    """Such a walk never ended once: it chose an edge behind the one that it had crossed."""
    rng = Random(seed)
    vertices = Vertices.of(scattered(rng, 24), QQ(0), QQ(1))
    instant = PredicatesAt(vertices, QQ(0))
    mesh = LazyRules.build(instant)
    flipped_at_random(mesh, instant, rng, 100)
    xs = [instant.position(v.id)[0] for v in vertices.all]
    for moving in vertices.bodies:
        chain, _ = chains_of(instant, moving.ring)
        for v in chain.ends:
            if xs.count(xs[v]) > 1:
                continue  # the oracle knows nothing of ties
            for up in (False, True):
                h = seen_from(mesh, instant, v, up=up)
                seen = None if h is None else frozenset(mesh.ends(h))
                assert seen == nearest_edge(instant, v, up=up)
