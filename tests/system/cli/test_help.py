"""Every --help teaches by examples, and every example runs."""

import re
import shlex
from importlib.resources import files

import click
import pytest
from commands import code_of
from folding import every

from exactpt import Scene, Simulation, first_contact
from exactpt.cli import all_commands, cli

QUESTION = (
    '{"id": "sliding:0:0", "time": [0, 9], "a": {"vertices": [[0, 0]]},'
    ' "b": {"vertices": [[2, 0]], "motion": {"x": [0, -1]}}}'
)
FILES = {
    "questions.jsonl": QUESTION,
    "answers.jsonl": '{"id": "sliding:0:0", "time": 2}',
    "scenes.jsonl": '{"exactpt": 1, "time": [0, 9], "bodies": []}',
    "countries.geojson": '{"type": "Point", "coordinates": [0.1, 2]}',
    "trips.mfjson": '{"type": "MovingPoint", "coordinates": [[0, 0], [1, 0]],'
    ' "datetimes": ["2000-01-01T00:00:00Z", "2000-01-01T00:00:09Z"]}',
    "points.json": '{"exactpt": 1, "time": [0, 9], "bodies": [{"name": "p", "vertices": [[0, 0]]},'
    ' {"name": "q", "vertices": [[2, 1]], "motion": {"x": [0, -1]}}]}',
    "parcels.wkt": "POLYGON ((0 0, 1 0, 0 1, 0 0))",
    "drawing.svg": '<svg xmlns="http://www.w3.org/2000/svg"><circle id="c" r="3"/></svg>',
}


def examples(command):
    """The lines after "Example" in a command's help, without what a shell makes of the answer."""
    text = command.help.split("Example", 1)[1]
    lines = re.findall(r"^ +(exactpt .*)$", text, re.MULTILINE)
    return [re.split(r" (?:&&|\|\|?|#)", line)[0] for line in lines]


MARKS = {"check": pytest.mark.cgal}
MINUTES = ["exactpt draw scene.json -o film.gif"]
COMMANDS = {"": cli, **all_commands()}
EXAMPLES = [
    pytest.param(line, marks=pytest.mark.slow if line in MINUTES else MARKS.get(name, []))
    for name, command in COMMANDS.items()
    for line in examples(command)
]


@every("name", COMMANDS)
def test_every_help_has_examples_and_explains_every_option(name):
    command = COMMANDS[name]

    assert examples(command)
    options = [p for p in command.params if isinstance(p, click.Option)]
    assert [option.name for option in options if not option.help] == []


@pytest.mark.parametrize("line", EXAMPLES)
def test_an_example_runs(line, tmp_path, monkeypatch, request):
    """On the scene of the demo, which is long enough for every time in them."""
    if " check " in line:
        request.getfixturevalue("program")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("click.launch", lambda _: 0)
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    if ".parquet" in line:
        arrow = pytest.importorskip("pyarrow")
        rows = arrow.table({"scene": [FILES["scenes.jsonl"]]})
        pytest.importorskip("pyarrow.parquet").write_table(rows, tmp_path / "scenes.parquet")
    scene = (files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8")
    (tmp_path / "scene.json").write_text(scene)
    if line == "exactpt check scene.json contact.proof":
        first_contact(Scene.load("scene.json"), proof=tmp_path / "contact.proof")
        (tmp_path / "scene.json").write_bytes((tmp_path / "contact.proof.scene.json").read_bytes())
    if line == "exactpt check folder":
        list(Simulation(Scene.load("scene.json"), proof=tmp_path / "folder").run())
    if line.startswith("exactpt check contact.apart"):
        first_contact(Scene.load("scene.json"), certificate=tmp_path / "contact.apart")

    code = code_of(*shlex.split(line)[1:])

    allowed = {0, 1} if " judge " in line else {4 if "--max-events" in line else 0}
    assert code in allowed
