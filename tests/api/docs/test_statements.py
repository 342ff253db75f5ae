"""Statements of README and the pages about results, events, floats and files."""

import inspect
import json
import pickle
import re
import subprocess
import sys
import tomllib
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random

import pytest

from exactpt import AuditError, Body, Rigid, Scene, Simulation, Translation, cli, first_contact
from exactpt.cli.runs import collide
from exactpt.motion import swept_edges
from exactpt.pairs import features_sweep as pairs
from exactpt.pairs import search as linear_search
from exactpt.testing.scenes import generate

ROOT = Path(__file__).parents[3]
FORMAT = (ROOT / "docs" / "format.md").read_text(encoding="utf-8")


@pytest.mark.long
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


@pytest.mark.long
def test_in_a_convoy_pairs_compares_no_edges(monkeypatch):
    met = []
    find = swept_edges.crossing_pairs

    def counting(*boxes):
        for first, second in find(*boxes):
            met.append(len(first))
            yield first, second

    monkeypatch.setattr(swept_edges, "crossing_pairs", counting)

    assert pairs.PairsSearch(convoy(1000)).run_to_contact() is None
    assert met
    assert not sum(met)


def test_in_a_convoy_no_two_bodies_are_compared(monkeypatch):
    compared = []
    monkeypatch.setattr(linear_search, "candidates_of", lambda *_: compared.append(1))
    assert first_contact(convoy(1000)) is None
    assert not compared


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


def test_the_command_line_saves_the_scene_of_a_broken_invariant(tmp_path, monkeypatch, capsys):
    scene = ROOT / "exactpt" / "data" / "demo.json"

    def broken(*_):
        raise AuditError("broken on purpose")

    monkeypatch.setattr("exactpt.collision.driver.initial_touches", broken)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(SystemExit) as ended:
        cli.main(["collide", str(scene), "--method", "kinetic"])

    (saved,) = tmp_path.iterdir()
    assert ended.value.code == 3
    assert str(saved) in capsys.readouterr().err
    assert saved.read_bytes() == scene.read_bytes()


@pytest.mark.parametrize("how", ["simulation", "kinetic", "pairs", "running"])
def test_an_error_raised_in_python_has_its_scene(tmp_path, monkeypatch, how):
    scene = Scene.load(ROOT / "exactpt" / "data" / "demo.json")

    def broken(*_, **__):
        raise AuditError("broken on purpose")

    monkeypatch.setattr("exactpt.pairs.features_sweep.PairsSearch.run_to_contact", broken)
    calls = {
        "simulation": partial(Simulation, scene),
        "kinetic": partial(first_contact, scene, method="kinetic"),
        "pairs": partial(first_contact, scene, method="pairs"),
        "running": Simulation(scene).step,
    }
    place = "advance" if how == "running" else "begin"
    monkeypatch.setattr(f"exactpt.tiling.engine.Engine.{place}", broken)
    with pytest.raises(AuditError) as caught:
        calls[how]()
    (pickle.loads(pickle.dumps(caught.value)).scene or scene).save(tmp_path / "bug.json")

    assert caught.value.__notes__ == ['To report it, save the scene: error.scene.save("bug.json")']
    assert Scene.load(tmp_path / "bug.json") == scene == caught.value.scene


def test_the_library_saves_nothing(tmp_path, monkeypatch):
    """It raises; the scene is the caller's."""
    scene = Scene.load(ROOT / "exactpt" / "data" / "demo.json")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("exactpt.collision.driver.initial_touches", lambda *_: 1 // 0)

    with pytest.raises(ZeroDivisionError):
        Simulation(scene)

    assert list(tmp_path.iterdir()) == []


def test_the_fuzzer_is_in_the_repository_and_not_in_the_wheel():
    packages = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]

    assert packages["packages"]["find"]["include"] == ["exactpt*"]
    assert (ROOT / "fuzz" / "__main__.py").is_file()
    assert not (ROOT / "exactpt" / "fuzz").exists()
