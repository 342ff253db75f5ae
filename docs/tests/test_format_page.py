"""docs/format.md: the output of its scene, and the kinds of events."""

import json
import re
import subprocess
import sys
from pathlib import Path

from exactpt import Simulation
from exactpt.testing.scenes import generate

FORMAT = (Path(__file__).parents[1] / "format.md").read_text(encoding="utf-8")


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
