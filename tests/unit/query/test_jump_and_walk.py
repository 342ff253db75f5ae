"""Walks start at a near node and take sides by doubles; no location depends on either."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from exactpt import Body, FreeSpace, InputError, Scene, Simulation
from exactpt.indices import NO_HALF_EDGE, HalfEdge
from exactpt.pairs.start import initial_touches
from exactpt.query import locate, nodes, ray, walk
from exactpt.query.answers import PLACES
from exactpt.query.nodes import Nodes
from exactpt.query.ray import Ray
from exactpt.query.subdivision import On, Spot
from exactpt.testing.scenes import FAMILIES, generate
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


def thirds(scene, offset):
    """Return the free space of a scene scaled by 1/3, so that few numbers are doubles; vertices."""
    bodies = [
        Body(body.name, [(x / 3 + offset, y / 3 - offset) for x, y in body.at(scene.start)])
        for body in scene.bodies
    ]
    places = [place for body in bodies for place in body.at(0)]
    return space_of(Scene(bodies)), places


def located(space, points):
    return [
        (p.kind, p.body, p.vertex, p.edge, p.tile, p.diagonal)
        for p in (space.locate(point) for point in points)
    ]


@pytest.mark.parametrize("family", FAMILIES)
def test_locations_depend_neither_on_where_a_walk_starts_nor_on_doubles(monkeypatch, family):
    scene, random = generate(family, 1), Random(f"jump {family}")
    if initial_touches(scene)[1]:
        return
    space, points = space_of(scene), points_around(scene, random, 12)
    expected = located(space, points)
    rays = [space.ray_cast(p, (3, -1)) for p in points]

    monkeypatch.setattr(ray, "_LARGEST", 0.0)  # no double decides
    space._plane.starts.clear()
    assert located(space, points) == expected
    assert [space.ray_cast(p, (3, -1)) for p in points] == rays
    monkeypatch.setattr(Nodes, "near", lambda *_: 0)
    for middle in (points[0], (1e9, 1e9)):
        monkeypatch.setattr(Nodes, "middle", lambda *_, middle=middle: middle)
        space._plane.starts.clear()
        assert located(space, points) == expected


def test_doubles_decide_no_step_that_they_may_not(monkeypatch):
    """Points that are nearly on lines through nodes, near the origin and far from it."""
    random, decided, ends = Random("sides"), [], []
    through, exactly, beyond = walk._through_face, walk._exactly_through_face, Ray.beyond_at_edge

    def both(plane, of, face, since, entry=NO_HALF_EDGE):
        found = through(plane, of, face, since, entry)
        assert found == exactly(plane, of, face, since, entry)
        decided.append(1)
        return found

    def beyond_in_both_ways(self, h):
        found = beyond(self, h)
        if self.goal is not None:
            at = self.parameter(Spot(On.EDGE, h))
            ends.append(at > 1)
            assert found == (at > 1) - (at < 1)
        return found

    def across_one_by_one(plane, of, entry, *, through_bodies):
        last, passed = across(plane, of, entry, through_bodies=through_bodies)
        h = entry
        for _ in range(passed):
            step = exactly(plane, of, plane.face[h], Spot(On.EDGE, h), h)
            h = HalfEdge(step.end.handle ^ 1)
        assert last == exactly(plane, of, plane.face[h], Spot(On.EDGE, h), h)
        return last, passed

    across = walk._across_faces
    monkeypatch.setattr(walk, "_through_face", both)
    monkeypatch.setattr(walk, "_across_faces", across_one_by_one)
    monkeypatch.setattr(Ray, "beyond_at_edge", beyond_in_both_ways)
    for family, offset in (("convex", 0), ("stars", 2**30), ("combs", Fraction(10**20, 3))):
        space, vertices = thirds(generate(family, 2), offset)
        for _ in range(40):
            edge, b = random.choice(space.snapshot.edges), random.choice(vertices)
            a, other = (space.snapshot.nodes[node] for node in (edge.u, edge.v))
            share, beside = Fraction(random.randint(0, 9), 7), random.choice([0, 0, 2.0**-51])
            near = Fraction(beside * random.random())
            a, other = (a.x, a.y), (other.x, other.y)
            p = tuple(x + share * (y - x) + near for x, y in zip(a, other, strict=True))
            along = tuple(y - x for x, y in zip(p, b, strict=True))
            space.locate(p)
            if any(along):
                space.ray_cast(p, along)
            space.is_free(p, b)
    assert len(decided) > 200
    assert 0 < sum(ends) < len(ends)


def test_rays_take_no_rational_arithmetic_before_they_hit(monkeypatch):
    """Each face was decided by exact sides, and each end by an exact parameter."""
    random, exact = Random("few"), []
    space = Simulation(generate("convex", 5)).space()
    exactly, parameter = walk._exactly_through_face, Ray.parameter
    monkeypatch.setattr(walk, "_exactly_through_face", lambda *a: exact.append(1) or exactly(*a))
    monkeypatch.setattr(Ray, "parameter", lambda *a: exact.append(0) or parameter(*a))
    rays = [
        ((random.uniform(-5, 9), random.uniform(-5, 9)), (1, random.random())) for _ in range(50)
    ]

    hits = [space.ray_cast(origin, direction) for origin, direction in rays]

    assert sum(hit is not None and hit.crossed for hit in hits) > 0
    assert sum(exact) == 0
    assert len(exact) <= sum(hit is not None for hit in hits)


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


def test_a_location_takes_one_walk_and_no_rational_number_in_a_known_cell(monkeypatch):
    """It started at a node, around which half-edges were compared, with a rational direction."""
    space = Simulation(generate("convex", 5)).space()
    random, made, rational = Random("cells"), [], nodes.rational
    ends = [(float(node.x), float(node.y)) for node in space.snapshot.nodes]
    points = [(x + random.random(), y + random.random()) for x, y in ends]
    monkeypatch.setattr(nodes, "rational", lambda value: made.append(value) or rational(value))
    places = [space.locate(point) for point in points]
    assert made
    made.clear()
    walks, walk_from = [], locate._walk
    monkeypatch.setattr(locate, "_walk", lambda *a: walks.append(a[1]) or walk_from(*a))
    assert [space.locate(point) for point in points] == places
    from_middles = [type(x) is float for x, _ in walks]
    assert len(points) == len(walks) < 2 * sum(from_middles)
    assert len(made) <= 6 * (len(walks) - sum(from_middles))


def test_bug_corners_of_large_faces_are_kept_once():
    """They were for each half-edge at which a ray came in: the square of the teeth of a comb."""
    teeth = [(x, y) for i in range(60) for x, y in ((2 * i, 9), (2 * i + 1, 1))]
    bodies = [Body("comb", [(-1, 0), (121, 0), (121, 9), *reversed(teeth)]), Body("b", [(60, 20)])]
    space = FreeSpace(start_tiling(Scene(bodies), "auto", 0), 0)
    for i in range(120):
        hit = space.ray_cast((i + 0.25, 30.0), (0.125, -30.0))
        assert hit.body == "comb"
        assert space.locate((i + 0.25, 0.5)).body == "comb"
    kept = [len(known[0]) for known in space._plane.ahead if known]
    assert max(len(space._plane.map.face(cycle[0])) for cycle in space._plane.cycles.values()) > 99
    assert len(kept) > 100
    assert max(kept) <= 30


def test_walks_are_short():
    """Their length does not grow with the number of bodies."""
    scene = generate("convex", 5)
    space = space_of(scene)
    points = points_around(scene, Random("short"), 50)
    crossed = [space.locate(p).crossed for p in points]
    assert sum(crossed) <= 6 * len(points)
