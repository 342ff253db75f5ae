"""Bitangents that stay parallel: in the order of those of small discs, not infinitesimal ones."""

from itertools import combinations, product

import pytest

from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ, sign
from exactpt.motion.body import Body
from exactpt.motion.motions import Rigid, Translation
from exactpt.motion.vertices import Vertices
from exactpt.tiling.greedy.slope import Slope, slope_terms

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
