"""An exact offset of a whole scene changes neither answers nor the work of the float filters."""

from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Pieces, Planner, Scene, Translation, first_contact, first_within
from exactpt.search.first import pair_search


def crowd(offset, seed, radius):
    """Triangles on a grid, with velocities in sixteenths, all at an offset."""
    random = Random(f"far {seed}")
    bodies = []
    for i in range(16):
        x, y = offset + 4 * (i % 4), -offset + 4 * (i // 4)
        v, w = (Fraction(random.randint(-20, 20), 16) for _ in range(2))
        motion = Translation([0, v], [0, w])
        if i % 5 == 0:
            motion = Pieces([(3, motion), (None, Translation([6 * v, -v], [3 * w]))])
        shape = [(x, y), (x + Fraction(4, 3), y), (x, y + 1)]
        bodies.append(Body(f"b{i}", shape, motion, radius=radius if i % 3 == 0 else 0))
    return Scene(bodies, time=(0, 10))


def answer(scene):
    contact = first_contact(scene)
    near = first_within(scene, distance=Fraction(1, 8))
    features = [(p.body, p.vertex, p.other, p.edge, p.other_vertex) for p in contact.pairs]
    return contact.time, features, near


@pytest.mark.parametrize("radius", [0, "1/7"])
@pytest.mark.parametrize("seed", range(3))
def test_answers_do_not_depend_on_an_offset(seed, radius):
    expected = answer(crowd(0, seed, radius))
    for offset in (10**6, 10**15 + Fraction(1, 3), 10**30):
        assert answer(crowd(offset, seed, radius)) == expected


@pytest.mark.parametrize("offset", [10**15, 10**18, 10**40])
def test_filters_decide_as_much_at_an_offset(offset):
    counts = []
    for scene in (crowd(Fraction(1, 3), 1, 0), crowd(offset + Fraction(1, 3), 1, 0)):
        search = pair_search(scene)
        search.run_to_contact()
        counts.append((search.stats["exact"], search.stats["filtered"]))
    assert counts[0][0] == counts[1][0]
    assert counts[0][1] - 2 <= counts[1][1] <= counts[0][1] + 2


@pytest.mark.parametrize("offset", [0, 10**18])
def test_bug_a_plan_and_its_obstacles_had_different_origins(offset):
    x = offset + Fraction(1, 3)
    wall = Body("wall", [(x + 9, -5), (x + 9, 5)])
    post = Body("post", [(x, 9)], Translation([0, Fraction(1, 7)]))
    robot = [(x, 0), (x + 1, 0), (x, 1)]
    plans = [Translation([0, 2]), Translation([0, -2]), Translation([-1, Fraction(2, 3)])]
    for obstacles in ([wall], [wall, post]):
        found = Planner(obstacles, time=(0, 20)).first_contacts(robot, plans)
        for plan, contact in zip(plans, found, strict=True):
            scene = Scene([*obstacles, Body("robot", robot, plan)], time=(0, 20))
            expected = first_contact(scene, between=[(o.name, "robot") for o in obstacles])
            assert (contact and contact.time) == (expected and expected.time)
