"""Normals of polygons that may have crossed themselves: out of the body, by the even-odd rule."""

import math
from collections import Counter
from random import Random

import pytest

from exactpt import Affine, Body, InputError, Planner, Scene, Translation, first_contact
from exactpt.pairs import incidences
from exactpt.testing.scenes import generate

CROSSED = [(-1, 1), {"x": [2], "y": [1, 1]}, (-1, -1), {"x": [-1, 1], "y": [0]}]
"""It crosses itself at t = 1."""


def normals(obstacle, robot, end=3):
    """The normals of the first contact of two bodies, asked for in four ways."""
    scenes = [Scene([obstacle, robot], (0, end)), Scene([robot, obstacle], (0, end))]
    found = [first_contact(scene, between=[(obstacle.name, robot.name)]) for scene in scenes]
    found.append(Planner([obstacle], (0, end)).first_contact(robot, robot.motion))
    far = Body("far", [(90, 90), (91, 90), (90, 91)])
    found.append(Planner([obstacle, far], (0, end)).first_contact(robot, robot.motion))
    jsons = [c and {**c.to_json(), "pairs": by_names(c)} for c in found]
    assert jsons[1:] == jsons[:-1]
    return found[0]


def by_names(contact):
    """The pairs, of vertices without an order."""
    pairs = [pair.to_json() for pair in contact.pairs]
    return sorted(
        str((p["kind"], p["point"], p["normal"]) if p["normal"] is None else p) for p in pairs
    )


def test_bug_a_normal_pointed_into_a_polygon_that_had_crossed_itself():
    point = Body("p", [(0, -3)], Translation(0, [0, 1]))
    contact = normals(Body("o", CROSSED), point)

    assert float(contact.time) == 1 + math.sqrt(2)
    assert contact.pairs[0].normal == pytest.approx((math.sin(math.pi / 8), -math.cos(math.pi / 8)))


def test_where_both_sides_are_outside_it_is_that_from_which_the_vertex_came():
    """At t = 1 a box is folded to a segment, to which the point comes at that time."""
    for body in (
        Body("o", [(0, 0), (4, 0), {"x": [4], "y": [1, -1]}, {"x": [0], "y": [1, -1]}]),
        Body("o", [(0, 0), (4, 0), (4, 1), (0, 1)], Affine([[[1], [0]], [[0], [1, -1]]])),
    ):
        for y in (1, -1):
            contact = normals(body, Body("p", [(2, 2 * y)], Translation(0, [0, -2 * y])), end=2)
            assert contact.time == 1
            assert {pair.normal for pair in contact.pairs} == {(0, y)}


def inside(points, x, y):
    found = False
    for (a, b), (c, d) in zip(points, [*points[1:], points[0]], strict=True):
        if (b > y) != (d > y) and x < a + (y - b) * (c - a) / (d - b):
            found = not found
    return found


def places(body, time):
    return [(float(x(t := float(time))), float(y(t))) for x, y in body.vertices]


def deforming(random):
    """A polygon of which some vertices move."""
    while True:
        ring = []
        for k in range(random.randint(3, 6)):
            angle, far = 6.28 * k / 6 + random.random(), random.randint(1, 3)
            x, y = round(far * math.cos(angle), 1), round(far * math.sin(angle), 1)
            moves = random.random() < 0.5
            to = [random.randint(-3, 3) if moves else 0 for _ in range(2)]
            ring.append({"x": [str(x), to[0]], "y": [str(y), to[1]]})
        try:
            body = Body("o", ring)
            Scene([body], (0, 3))
        except InputError:
            continue
        return body


@pytest.mark.long
def test_out_of_a_polygon_by_sampling_its_sides():
    random, seen = Random("normals"), Counter()
    for _ in range(250):
        obstacle = deforming(random)
        angle = random.random() * 6.28
        x, y = round(6 * math.cos(angle), 2), round(6 * math.sin(angle), 2)
        u, v = (random.randint(-15, 15) / 10 - c / 2 for c in (x, y))
        shape = [(x, y), (x + 0.5, y), (x, y + 0.5)][: random.choice([1, 3])]
        contact = normals(obstacle, Body("r", shape, Translation([0, u], [0, v])))
        for pair in () if contact is None else contact.pairs:
            if pair.normal is None or pair.other != "o":
                continue
            points = places(obstacle, contact.time)
            a, b = points[pair.edge], points[(pair.edge + 1) % len(points)]
            length = math.dist(a, b)
            (px, py), (nx, ny), d = pair.point, pair.normal, 1e-5
            px, py = (p + d * (q - r) / length for p, q, r in zip((px, py), b, a, strict=True))
            sides = (
                inside(points, px + d * nx, py + d * ny),
                inside(points, px - d * nx, py - d * ny),
            )
            seen[sides] += 1
    assert seen[True, False] == 0  # the normal points out
    assert seen[False, True] > 60
    assert sum(seen.values()) - seen[False, True] <= 3  # both sides alike: double edges


def test_of_simple_polygons_it_is_that_of_the_ring(monkeypatch):
    """Deforming polygons up to the first of all contacts."""
    scenes = [
        generate(f, k) for f in ("deforming", "clamps", "keyframed", "flat") for k in range(6)
    ]
    asked = [first_contact(scene) for scene in scenes]
    found = [c.to_json() for c in asked if c is not None]
    assert sum(pair.normal is not None for c in asked if c for pair in c.pairs) > 8
    monkeypatch.setattr(incidences, "_may_have_crossed_itself", lambda *_: False)

    assert [c.to_json() for c in map(first_contact, scenes) if c is not None] == found
