"""Whatever the contract refuses, every command refuses: exit code 2, one line, nothing written."""

import json

import pytest
from commands import code_of

from exactpt.scene.scene import Scene

BOX = [["0", "0"], ["2", "0"], ["2", "1"], ["0", "1"]]
COMMANDS = (
    "collide",
    "collide --method pairs",
    "simulate --events out.jsonl",
    "tile -o out.json",
    "check",
    "draw -o out.svg",
    "draw -o out.html",
)


def scene(*bodies, time=("0", "10"), **more):
    return json.dumps({"exactpt": 1, "time": time, "bodies": list(bodies), **more})


def box(**more):
    return {"name": "box", "vertices": BOX} | more


JUMP = {"pieces": [{"until": "4", "motion": {"x": ["0", "1"]}}, {"motion": {"x": ["8"]}}]}
REFUSED = {
    "unknown key of the scene": (scene(box(), colour="red"), "unknown key 'colour': 'red'"),
    "unknown key of a body": (scene(box(mass=3)), "body 'box': unknown key 'mass': 3"),
    "unknown key of a motion": (
        scene(box(motion={"z": ["1"]})),
        "body 'box': \"motion\": unknown key 'z': ['1']",
    ),
    "bad number": (
        scene(box(vertices=[["0", "0"], ["one", "0"], ["0", "1"]])),
        "body 'box': vertex 1: x: not a number: 'one'",
    ),
    "zero denominator": (
        scene(box(motion={"x": ["1/0"]})),
        "body 'box': \"motion\": \"x\": denominator is zero: '1/0'",
    ),
    "NaN": (
        scene(box(motion={"x": [float("nan")]})),
        "body 'box': \"motion\": \"x\": not a number: 'NaN'",
    ),
    "no vertex": (
        scene(box(vertices=[])),
        "body 'box': \"vertices\": at least one vertex is needed",
    ),
    "repeated name": (scene(box(), box()), "body 'box': the name is taken by another body"),
    "empty span": (scene(box(), time=("3", "3")), "time: the span from 3 to 3 is empty"),
    "reversed span": (scene(box(), time=("3", "5/2")), "time: the span from 3 to 5/2 is empty"),
    "not simple": (
        scene(box(vertices=[["0", "0"], ["2", "2"], ["2", "0"], ["0", "2"]])),
        (
            "body 'box': not a simple polygon and so not valid at the start, t = 0: "
            "edge 0 from (0, 0) meets"
        ),
    ),
    "no area": (
        scene(box(vertices=[["0", "0"], ["1", "0"], ["1", "0"]])),
        "body 'box': not valid at the start, t = 0: vertex 1 and the next one are both at (1, 0)",
    ),
    "jump": (
        scene(box(motion=JUMP)),
        "body 'box': vertex 0 jumps at t = 4 from (4, 0) to (8, 0)",
    ),
    "no JSON": ("{", "line 1"),
    "no scene": ("[]", "not an object: []"),
    "another version": (
        scene(box()).replace('"exactpt": 1', '"exactpt": 2'),
        '"exactpt": ',
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_every_command_refuses_it_alike(tmp_path, monkeypatch, capsys, name):
    text, words = REFUSED[name]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(text)
    said = set()
    for command in COMMANDS:
        verb, *options = command.split()
        code = code_of(verb, "scene.json", *options)
        out, err = capsys.readouterr()
        assert (code, out) == (2, ""), command
        said.add(err)

    assert len(said) == 1
    line = said.pop()
    assert line.startswith("exactpt: scene.json: ")
    assert words in line
    assert line.count("\n") == 1
    assert line.endswith("\n")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.json"]


@pytest.mark.parametrize(
    "command, words",
    [
        ("collide scene.json --until 0", "--until: the end t = 0 is not after the start t = 0"),
        ("simulate scene.json --until -1", "--until: the end t = -1 is not after"),
        ("tile scene.json --at 11", "--at: t = 11 is outside the time span from 0 to 10"),
        ("draw scene.json -o x.svg --at 11", "--at: t = 11 is outside the time span from 0 to 10"),
        ("draw scene.json -o x.svg --at contact", "no contact to draw from t = 0 to t = 10"),
        ("draw scene.json -o x.html --at contact", "no contact to draw from t = 0 to t = 10"),
        ("draw scene.json -o x.html --at 11", "--at: nothing to show at t = 11: the animation"),
        ("draw scene.json -o x.jpg", ".jpg"),
        ("tile scene.json --at one", "--at"),
        ("tile scene.json --tiling round", "--tiling"),
        ("simulate scene.json --tiling incremental", "incremental"),
        ("collide scene.json --max-events -1", "--max-events"),
        ("batch scene.json -o x.jsonl --within -1", "--within: a distance is not negative: -1"),
        ("batch scene.json -o x.jsonl --within 1 --all", "--all: --within asks another question"),
        ("batch scene.json -o x.jsonl --all --after-start", "--all: --after-start is supported"),
        ("batch scene.json -o x.jsonl --within 1 --method pairs", "--within: --method is"),
        ("collide", "SCENE"),
        ("fold scene.json", "fold"),
    ],
)
def test_bad_calls(tmp_path, monkeypatch, capsys, command, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(scene(box()))

    code = code_of(*command.split())

    out, err = capsys.readouterr()
    assert (code, out) == (2, "")
    assert err.startswith("exactpt: ")
    assert words in err
    assert len(err.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["scene.json"]


@pytest.mark.parametrize("command", ["simulate", "tile", "collide --tiling lazy"])
def test_what_is_refused_after_the_file_was_read_names_it(tmp_path, monkeypatch, capsys, command):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(scene(box(radius="1")))
    verb, *options = command.split()

    code = code_of(verb, "scene.json", *options)

    out, err = capsys.readouterr()
    assert (code, out) == (2, "")
    assert err.startswith("exactpt: scene.json: body 'box' has a radius: ")
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize("command", ["collide", "simulate", "tile", "draw -o out.svg"])
def test_no_memory_is_one_line_and_no_bug(command, tmp_path, monkeypatch, capsys):
    """It was reported as a bug, with a traceback or an empty reason, by exit code 3."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.json").write_text(scene(box()))

    def no_memory(*_arguments, **_options):
        raise MemoryError

    monkeypatch.setattr(Scene, "load", no_memory)
    name, *options = command.split()
    code = code_of(name, "in.json", *options)
    out, err = capsys.readouterr()
    assert (code, out, err) == (4, "", "exactpt: memory limit exceeded\n")
    assert [path.name for path in tmp_path.iterdir()] == ["in.json"]


@pytest.mark.parametrize("word", ["x" * 100_000, "a " * 50_000])
@pytest.mark.parametrize("place", [["collide", "{}"], ["{}"], ["collide", "a", "--at", "{}"]])
def test_long_arguments_are_cut_in_messages(word, place, capsys):
    assert code_of(*[part.format(word) for part in place]) == 2
    assert len(capsys.readouterr().err) < 5200
