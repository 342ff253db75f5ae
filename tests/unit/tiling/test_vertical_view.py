"""What a vertex sees straight up and down; bitangents that stay parallel."""

from itertools import combinations, product
from random import Random

import pytest
from flipped import flipped_at_random, scattered

from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ, sign
from exactpt.motion.body import Body
from exactpt.motion.motions import Rigid, Translation
from exactpt.motion.vertices import Vertices
from exactpt.tiling.greedy.convex_ring import chains_of
from exactpt.tiling.greedy.slope import Slope, slope_terms
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
        p, q = instant.position(u.id), instant.position(instant.vertices.ahead(u.id))
        if (p[0] < x < q[0]) or (q[0] < x < p[0]):
            distance = (height_over(p, q, x) - y) * (1 if up else -1)
            if distance > 0 and (best is None or distance < best[0]):
                best = distance, frozenset((u.id, instant.vertices.ahead(u.id)))
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


KAPPA = QQ(1, 10**6)


def rise(instant, a, b, sides, *, upright):
    """How much steeper the bitangent of two discs is, in units of their size.

    Their radius is 1 - kappa |v|^2; it is above the disc of a body that is below it.
    """
    (ax, ay), (bx, by) = instant.position(a), instant.position(b)
    at_a = -sides[0] * (1 - KAPPA * (ax * ax + ay * ay))
    at_b = -sides[1] * (1 - KAPPA * (bx * bx + by * by))
    return (at_b - at_a) / (ay - by if upright else bx - ax)


@pytest.mark.long("turning")
@pytest.mark.parametrize(
    "direction, motion",
    [
        ((1, 0), Translation([0, 1], [2])),
        ((QQ(3, 2), QQ(-1, 2)), Translation([0, 2], [0, 1])),
        ((0, -1), Translation(["1/3"], [0, 5])),
        ((1, 2), Rigid([0, 1])),
    ],
    ids=["level", "slanting", "upright", "turning"],
)
def test_the_order_of_parallel_bitangents(direction, motion):
    """From left to right they are a b and c d, along one line or beside each other."""
    u, v = direction
    places = [(k * u + x, k * v + y) for k in (-2, 0, 1, 3) for x, y in ((0, 0), (5, 4))]
    bodies = [Body(str(i), [place], motion) for i, place in enumerate(places)]
    vertices = Vertices.of(bodies, QQ(0), QQ(1), plain=True)
    instant = PredicatesAt(vertices, QQ(0), after=False)
    upright = u == 0
    signs = ((1, 1), (1, -1), (-1, 1), (-1, -1))
    ends = [(a, b) for a, b in combinations(range(8), 2) if (b - a) % 2 == 0]
    bitangents = list(product(ends, signs))

    for ((a, b), sides), ((c, d), others) in product(bitangents, repeat=2):
        s = Slope(vertices.all[a], vertices.all[b], sides, upright=upright)
        t = Slope(vertices.all[c], vertices.all[d], others, upright=upright)
        difference = rise(instant, c, d, others, upright=upright)
        difference -= rise(instant, a, b, sides, upright=upright)
        assert instant.first_sign(slope_terms(s, t)) == sign(difference)
