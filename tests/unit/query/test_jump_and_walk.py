"""Walks start at a near node and take sides by doubles; no location depends on either."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from exactpt import FreeSpace, InputError, Scene, Simulation
from exactpt.pairs.start import initial_touches
from exactpt.query.answers import PLACES
from exactpt.query.nodes import Nodes
from exactpt.query.walk import Ray
from exactpt.scene.generate import FAMILIES, generate
from exactpt.tiling.start import start_tiling


def space_of(scene):
    return FreeSpace(start_tiling(scene, "auto", scene.start), scene.start)


def points_around(scene, random, count):
    """Vertices, points on edges, and points one unit in the last place beside them."""
    found = []
    bodies = [body for body in scene.bodies if body.size]
    for _ in range(count):
        body = random.choice(bodies)
        places = body.at(scene.start)
        a, b = (
            random.choice(places)
            if random.random() < 0.5
            else random.choice(random.choice(bodies).at(scene.start))
            for _ in range(2)
        )
        share = random.choice([0, 1, 0.5, 2, -1, random.random()])
        x, y = (float(p + Fraction(share) * (q - p)) for p, q in zip(a, b, strict=True))
        if random.random() < 0.5:
            x = float(np.nextafter(x, random.choice([-np.inf, np.inf])))
        found.append((x, y))
    return found


def located(space, points):
    return [
        (p.kind, p.body, p.vertex, p.edge, p.tile, p.diagonal)
        for p in (space.locate(point) for point in points)
    ]


@pytest.mark.parametrize("family", FAMILIES)
def test_locations_depend_neither_on_the_first_node_nor_on_doubles(monkeypatch, family):
    scene, random = generate(family, 1), Random(f"jump {family}")
    if initial_touches(scene)[1]:
        return
    space, points = space_of(scene), points_around(scene, random, 12)
    expected = located(space, points)
    rays = [space.ray_cast(p, (3, -1)) for p in points]

    monkeypatch.setattr(Ray, "_filtered_side", lambda *_: 0)
    assert located(space, points) == expected
    assert [space.ray_cast(p, (3, -1)) for p in points] == rays
    monkeypatch.setattr(Nodes, "near", lambda *_: 0)
    assert located(space, points) == expected


def test_filter_decides_no_side_that_it_may_not(monkeypatch):
    """Points that are nearly on lines through nodes, near the origin and far from it."""
    random, decided = Random("sides"), []
    exact, filtered = Ray._exact_side, Ray._filtered_side

    def both(self, node):
        found = filtered(self, node)
        decided.append(found != 0)
        assert found in (0, exact(self, node))
        return found

    monkeypatch.setattr(Ray, "_filtered_side", both)
    for offset in (0, 2**30, Fraction(10**20, 3)):
        scene = generate("convex", 2)
        moved = [body.with_motion(type(body.motion)([offset], [-offset])) for body in scene.bodies]
        space = space_of(Scene(moved, time=(0, 1)))
        for x, y in points_around(Scene(moved, time=(0, 1)), random, 40):
            space.locate((x, y))
            space.ray_cast((x, y), (random.random() - 0.5, 2.0**-60))
    assert 0.5 < sum(decided) / len(decided) < 1


@pytest.mark.parametrize("family", ["convex", "lakes", "stars", "grid_points", "frames"])
def test_many_locations_are_those_of_each_point(family):
    scene = generate(family, 3)
    if initial_touches(scene)[1]:
        return
    space, names = space_of(scene), [body.name for body in scene.bodies]
    points = points_around(scene, Random(f"many {family}"), 30)

    found = space.locate_many(np.array(points))

    assert repr(found) == "<Located: 30 points>"
    for point, kind, owner, feature in zip(points, *found, strict=True):
        place = space.locate(point)
        assert PLACES[kind] == place.kind
        if place.body is not None:
            assert names[owner] == place.body
        else:
            assert owner == (-1 if place.tile is None else place.tile)
        numbers = [n for n in (place.vertex, place.edge) if n is not None]
        assert feature == (numbers[0] if numbers else -1)


def test_many_locations_of_none_and_of_unusable_points():
    space = Simulation(generate("convex", 1)).space()
    assert [len(column) for column in space.locate_many(np.empty((0, 2)))] == [0, 0, 0]
    with pytest.raises(InputError, match=r"shape \(n, 2\), got \(3,\)"):
        space.locate_many([1.0, 2.0, 3.0])
    with pytest.raises(InputError, match="row 1 is not finite"):
        space.locate_many([[0.0, 0.0], [np.nan, 0.0]])


def test_walks_are_short():
    """Their length does not grow with the number of bodies."""
    scene = generate("convex", 5)
    space = space_of(scene)
    points = points_around(scene, Random("short"), 50)
    crossed = [space.locate(p).crossed for p in points]
    assert sum(crossed) <= 6 * len(points)
