"""Rays from outside of the hull: the edge at which they enter is searched by angles."""

from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, FreeSpace, Scene
from exactpt.geometry.polygon import segments_meet
from exactpt.query import hull, locate, ray
from exactpt.tiling.start import start_tiling


def space_of(bodies):
    return FreeSpace(start_tiling(Scene(bodies), "auto", 0), 0)


def parabola(n):
    """Points in convex position, with integers."""
    return space_of([Body(f"p{i}", [(i, i * i)]) for i in range(n)])


SQUARES = [
    Body(
        f"{i}{j}", [(3 * i, 3 * j), (3 * i + 1, 3 * j), (3 * i + 1, 3 * j + 1), (3 * i, 3 * j + 1)]
    )
    for i in range(3)
    for j in range(3)
]
SCENES = {
    "squares": SQUARES,
    "segment": [Body("a", [(0, 0), (4, 2)])],
    "on_a_line": [Body("a", [(0, 0), (1, 1)]), Body("b", [(2, 2), (4, 4)]), Body("c", [(7, 7)])],
    "triangle": [Body("a", [(0, 0), (4, 0), (0, 3)])],
    "two_points": [Body("a", [(0, 0)]), Body("b", [(3, 1)])],
}


class Corners(list):
    """Corners that count how often one is read."""

    read = 0

    def __getitem__(self, k):
        Corners.read += 1
        return super().__getitem__(k)


def test_few_edges_of_the_hull_are_examined():
    """All were, twice."""
    read = []
    for n in (50, 300):
        space, random = parabola(n), Random("few edges")
        found = space._plane.hull
        found._corners = Corners(found._corners)
        Corners.read = 0
        for _ in range(40):
            origin = random.randint(-n, 2 * n), random.choice([-5, 2 * n * n])
            space.ray_cast(
                origin, (random.randint(0, n) - origin[0], 2 * random.randint(0, n) ** 2)
            )
        read.append(Corners.read)
    assert 40 * 3 <= read[0] < read[1] <= read[0] + 40 * 12


def test_rays_from_outside_need_no_walk_to_their_origin(monkeypatch):
    walks = []
    find = locate.find
    monkeypatch.setattr(locate, "find", lambda *a: walks.append(1) or find(*a))
    space = space_of(SQUARES)
    hits = [space.ray_cast((-50, Fraction(y, 7)), (1, "1/100")) for y in range(-30, 60)]
    assert 20 < sum(hit is not None for hit in hits) < 70
    assert not walks


@pytest.mark.parametrize("name", SCENES)
def test_the_search_decides_as_exact_arithmetic(monkeypatch, name):
    """Through corners, along edges, one unit in the last place beside them, and past the hull."""
    space, random = space_of(SCENES[name]), Random(f"hull {name}")
    nodes = [(node.x, node.y) for node in space.snapshot.nodes]
    rays, entered = [], []
    search = hull.Hull.entered
    monkeypatch.setattr(hull.Hull, "entered", lambda *a: entered.append(search(*a)) or entered[-1])
    for _ in range(60):
        (a, b), (c, d) = random.choice(nodes), random.choice(nodes)
        near = Fraction(random.choice([0, 0, 2.0**-50, -(2.0**-50)]))
        share = Fraction(random.randint(-9, 16), 7)
        origin = a + share * (c - a) + near, b + share * (d - b)
        x, y = random.choice(nodes)
        goal = random.choice([(x, y), (x + random.randint(-9, 9), y + random.randint(-9, 9))])
        if origin != goal:
            rays.append((origin, goal))

    def answers():
        for p, q in rays:
            yield space.ray_cast(p, (q[0] - p[0], q[1] - p[1]))
            yield space.is_free(p, q)

    found = list(answers())
    decided = sum(edge is not None for edge in entered)
    assert decided > 5
    monkeypatch.setattr(hull.Hull, "entered", lambda *_: None)
    monkeypatch.setattr(ray, "_LARGEST", 0.0)
    assert list(answers()) == found


@pytest.mark.parametrize("in_doubles", [True, False])
def test_bug_a_segment_that_crosses_a_scene_on_one_line_was_free(monkeypatch, in_doubles):
    """Of the two half-edges of the edge it crossed, the one on whose left it came was the end."""
    if not in_doubles:
        monkeypatch.setattr(ray, "_LARGEST", 0.0)
    random, free = Random("crosses a line"), []
    for name in ("segment", "on_a_line"):
        space, bodies = space_of(SCENES[name]), SCENES[name]
        for _ in range(60):
            x, slope = random.randint(0, 4), Fraction(2 if name == "on_a_line" else 1, 2)
            p = x + Fraction(random.choice([-1, 1]), 2**51), x * slope
            q = random.randint(-6, 9), random.randint(-6, 9)
            places = [body.at(0) for body in bodies]
            meets = any(segments_meet(p, q, ends[0], ends[-1]) for ends in places)
            free.append(not meets)
            assert space.is_free(p, q) != meets
    assert 10 < sum(free) < len(free) - 10
