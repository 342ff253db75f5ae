"""Statements of README and the pages about results, detours and the share of exact decisions."""

import inspect
from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Rigid, Scene, Simulation, Translation, first_contact
from exactpt.cli.runs import collide
from exactpt.search.first import pair_search


def test_a_gap_of_a_hair_is_a_gap():
    """A square passes above another one, at a distance of 10^-300, and at none."""
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    for gap, touches in [("1e-300", False), (0, True)]:
        above = Body("above", square, Translation([-3, 1], [1 + Fraction(gap)]))
        contact = first_contact(Scene([Body("below", square), above], time=(0, 9)))

        assert (contact is not None) == touches


def crowd(motion_of):
    """Twenty quadrilaterals with random doubles."""
    random = Random(0)
    bodies = []
    for i in range(20):
        x, y = 20 * (i % 5) + random.random(), 20 * (i // 5) + random.random()
        square = [(0, 0), (3, 0), (3, 3), (0, 3)]
        corners = [(x + dx + random.random(), y + dy + random.random()) for dx, dy in square]
        speeds = [random.uniform(-1, 1) for _ in range(7)]
        bodies.append(Body(f"b{i}", corners, motion_of((x, y), speeds)))
    return Scene(bodies, time=(0, 20))


def translating(degree):
    return lambda _, speeds: Translation([0, *speeds[:degree]], [0, *speeds[3 : 3 + degree]])


def turning(pivot, speeds):
    return Rigid([0, speeds[0]], pivot=pivot, x=[0, speeds[1]], y=[0, speeds[2]])


def exact_share(scene, tiling):
    simulation = Simulation(scene, tiling=tiling)
    for _ in simulation.run():
        pass
    stats = simulation.stats
    return stats["exact"] / (stats["exact"] + stats["filtered"])


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("tiling, most", [("greedy", 0.001), ("lazy", 0.001), ("mixed", 0.003)])
def test_floats_decide_about_bodies_that_translate(request, degree, tiling, most):
    if request.config.getoption("--exact-only"):
        pytest.skip("there are no filters")

    assert 0 < exact_share(crowd(translating(degree)), tiling) < most


@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
def test_floats_decide_about_bodies_that_turn(request, tiling):
    if request.config.getoption("--exact-only"):
        pytest.skip("there are no filters")

    assert exact_share(crowd(turning), tiling) < 0.01


def convoy(count):
    """Triangles at one velocity, for a span in which they go far."""
    random = Random(1)
    bodies = []
    for i in range(count):
        x, y = 4 * (i % 32) + random.random(), 4 * (i // 32) + random.random()
        shape = [(x, y), (x + 2, y), (x + 1, y + 2)]
        bodies.append(Body(f"b{i}", shape, Translation([0, 0.7], [0, 0.3])))
    return Scene(bodies, time=(0, 1000))


def test_in_a_convoy_no_two_bodies_are_compared():
    """Bodies are 4 apart and up to 3 wide, and keep their distances: boxes do not meet."""
    search = pair_search(convoy(1000))

    assert search.run_to_contact() is None
    assert search.stats["pairs"] == 0


def test_auto_is_the_default_of_first_contact_and_collide():
    assert inspect.signature(first_contact).parameters["method"].default == "auto"
    (method,) = [p for p in collide.params if p.name == "method"]
    assert method.default == "auto"


def test_a_path_crosses_few_diagonals_and_may_be_a_detour():
    boxes = []
    for i in range(20):
        x, y = 3 * (i % 4), 6 * (i // 4)
        boxes.append(Body(f"b{i}", [(x, y), (x + 1, y), (x + 1, y + 4), (x, y + 4)]))
    simulation = Simulation(Scene(boxes, time=(0, 1)), tiling="greedy")
    start, goal = ("7/2", "23/2"), ("17/2", "23/2")

    assert simulation.is_free(start, goal)
    assert simulation.shortest_path(start, goal).length == 5
    assert simulation.path(start, goal).length > 5
