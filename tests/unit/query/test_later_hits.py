"""Rays of doubles: the point of a hit and its parameter are computed when one is first read."""

import copy
import pickle
from dataclasses import asdict, replace
from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Scene, Simulation
from exactpt.query import nodes
from exactpt.query.answers import Hit
from exactpt.testing.scenes import generate


@pytest.fixture(name="rays")
def _rays():
    random = Random("later")
    space = Simulation(generate("convex", 5)).space()
    ways = [
        ((random.uniform(-5, 9), random.uniform(-5, 9)), (1.0, random.random())) for _ in range(40)
    ]
    return space, [way for way in ways if space.ray_cast(*way)]


def test_a_hit_takes_no_rational_number_before_its_point_is_read(rays, monkeypatch):
    """Four coordinates became rational numbers, and three of the hit fractions."""
    space, _ = rays
    made, rational = [], nodes.rational
    ends = [(float(node.x), float(node.y)) for node in space.snapshot.nodes]
    monkeypatch.setattr(nodes, "rational", lambda value: made.append(value) or rational(value))
    outside = [((x - 1000.0, y + 0.25), (1.0, -0.0002)) for x, y in ends]
    found = [(space.ray_cast(*way), way) for way in outside]
    hits = [(hit, way) for hit, way in found if hit is not None]
    assert len(hits) > 5
    assert not made

    for hit, (origin, direction) in hits:
        at = hit.at
        assert hit.point == tuple(
            Fraction(x) + at * Fraction(d) for x, d in zip(origin, direction, strict=True)
        )
        assert all(type(x) is Fraction for x in (at, *hit.point))
    assert len(made) == 4 * len(hits)


@pytest.mark.parametrize(
    "of",
    [
        repr,
        hash,
        asdict,
        copy.copy,
        copy.deepcopy,
        lambda hit: [pickle.dumps(hit, protocol) for protocol in range(2, 6)],
        lambda hit: pickle.loads(pickle.dumps(hit)),
        lambda hit: replace(hit, crossed=7),
        lambda hit: [*sorted(vars(Hit)["__slots__"]), hasattr(hit, "__dict__")],
        lambda hit: hit,
    ],
)
def test_a_hit_is_one_whose_values_were_given(rays, of):
    space, ways = rays
    for way in ways[:8]:
        hit = space.ray_cast(*way)
        given = Hit(hit.body, hit.vertex, hit.edge, hit.point, hit.at, hit.crossed)
        assert of(space.ray_cast(*way)) == of(given)


def test_a_hit_has_no_other_attributes(rays):
    space, ways = rays
    hit = space.ray_cast(*ways[0])
    with pytest.raises(AttributeError, match="'Hit' object has no attribute 'distance'"):
        _ = hit.distance
    with pytest.raises(AttributeError, match="cannot assign to field 'at'"):
        hit.at = 1


@pytest.mark.parametrize("offset", [0, 10**15, Fraction(10**20, 3), 10**400])
def test_doubles_are_taken_exactly_wherever_the_nodes_are(offset):
    """The origin of the coordinates of nodes is a double, and any of a point may be none."""
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    bodies = [Body(f"{i}", [(offset + x + 8 * i, y) for x, y in square]) for i in range(3)]
    space = Simulation(Scene(bodies, (0, 1))).space()
    points = [(offset + Fraction(x, 2), Fraction(y, 3)) for x in range(-3, 44) for y in (-1, 6, 12)]
    if offset < 10**16:
        points += [(float(x), float(y)) for x, y in points]
    for x, y in points:
        at, place = Fraction(x) - offset, space.locate((x, y))
        inside = at % 8 <= 4 and 0 <= at <= 20 and 0 <= y <= 4
        assert (place.body == f"{at // 8}") == inside
        hit = space.ray_cast((x, y), (1.0, 0.0))
        if not inside and 0 < y < 4:
            assert (hit is None) == (at > 20)
            assert hit is None or hit.point[0] - offset == max(0, -(-at // 8) * 8)
