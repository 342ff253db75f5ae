"""What the README and docs/format.md say of answers, events and floats is so."""

import json
import re
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest

from exactpt import Body, Rigid, Scene, Simulation, Translation
from exactpt.scene.generate import generate

FORMAT = (Path(__file__).parents[2] / "docs" / "format.md").read_text(encoding="utf-8")


def test_the_answer_on_the_format_page_is_that_of_its_scene(tmp_path):
    scene, stated = re.findall(r"```json\n(.*?)```", FORMAT, re.DOTALL)[:2]
    (tmp_path / "scene.json").write_text(scene)
    command = [sys.executable, "-m", "exactpt", "collide", tmp_path / "scene.json", "--json"]

    answer = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)

    stated = json.loads(stated)
    shown = {key: answer["stats"][key] for key in stated["stats"]}
    assert stated == {**answer, "stats": shown}


def test_the_kinds_of_events_on_the_format_page_are_those_that_happen():
    (listed,) = re.findall(r'"kind": "([\w|-]+\|[\w|-]+)"', FORMAT)
    happened = {
        event.kind
        for family in ("convex", "mixed_shapes", "pieces", "row", "ballistic_points")
        for event in Simulation(generate(family, 0)).run()
    }

    assert happened == set(listed.split("|"))


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
def test_exact_arithmetic_decides_about_bodies_that_turn(tiling):
    assert exact_share(crowd(turning), tiling) > 0.9
