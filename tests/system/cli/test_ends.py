"""How the command ends when something else ends first: pipes, disks, bugs, budgets."""

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from commands import code_of

from exactpt.files import write_atomically
from exactpt.scene.written import save
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="pipes and links of a Unix")


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.json"
    save(generate("grazing", 0), path)
    return path


def run(*arguments, **streams):
    command = [sys.executable, "-c", "from exactpt.cli import main; main()", *map(str, arguments)]
    return subprocess.run(command, check=False, text=True, **streams)


@pytest.mark.parametrize("command", [("generate", "convex"), ("collide", "--json")])
def test_a_reader_that_has_seen_enough_is_no_failure(scene, command):
    ours, theirs = os.pipe()
    os.close(ours)

    done = run(*command, *([scene] if command[0] == "collide" else []), stdout=theirs, stderr=-1)

    os.close(theirs)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_is_told_in_one_line(scene, monkeypatch, unbuffered):
    """What is buffered is written before the command ends: Python's own end has no exit code."""
    monkeypatch.setenv("PYTHONUNBUFFERED", unbuffered)
    with open("/dev/full", "w") as full:
        done = run("collide", scene, "--json", stdout=full, stderr=subprocess.PIPE)

    assert done.returncode == 2
    assert done.stderr == "exactpt: No space left on device\n"


def test_what_nobody_thought_of_is_a_bug_and_its_scene_is_kept(scene, monkeypatch, capsys):
    def breaks(*_):
        raise ZeroDivisionError("nobody thought of this")

    monkeypatch.setattr("exactpt.tiling.driver.initial_touches", breaks)
    odd = scene.with_name("a scene without an ending")
    odd.write_bytes(scene.read_bytes())

    assert code_of("collide", odd, "--method", "kinetic") == 3

    said = capsys.readouterr().err
    assert "Traceback" in said
    assert "report it" in said
    kept = Path(said.split("saved in ")[1].splitlines()[0])
    assert kept.read_bytes() == scene.read_bytes()
    kept.unlink()


def test_the_scene_is_kept_not_what_is_written(scene, monkeypatch, capsys):
    old = scene.with_name("old.json")
    old.write_text("{}")
    monkeypatch.setattr("exactpt.tiling.driver.initial_touches", lambda *_: 1 // 0)

    assert code_of("tile", "-o", old, scene) == 3

    kept = Path(capsys.readouterr().err.split("saved in ")[1].splitlines()[0])
    assert kept.read_bytes() == scene.read_bytes()
    kept.unlink()


@pytest.mark.parametrize("seconds, code", [("nan", 2), ("inf", 0), ("1e300", 0), ("-1", 2)])
def test_every_number_of_seconds_is_a_bound_or_refused(scene, seconds, code):
    assert code_of("collide", scene, "--max-seconds", seconds) == code


@pytest.mark.parametrize("command", ["collide", "simulate", "check"])
def test_no_more_events_than_are_allowed_is_no_end(tmp_path, command, request, capsys):
    if command == "check":
        request.getfixturevalue("program")
    path = tmp_path / "scene.json"
    save(generate("convex", 0), path)
    assert code_of("collide", path, "--tiling", "greedy", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["contact"] is None
    events = answer["stats"]["events"]

    assert code_of(command, path, "--tiling", "greedy", "--max-events", events) == 0
    assert code_of(command, path, "--tiling", "greedy", "--max-events", events - 1) == 4


def test_a_scene_without_events_needs_no_budget(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text('{"exactpt": 1, "time": [0, 1], "bodies": []}')

    for command in ("collide", "simulate", "tile"):
        assert code_of(command, path, "--max-events", 0) == 0


def test_a_link_stays_and_so_do_permissions(tmp_path):
    target, link = tmp_path / "target.json", tmp_path / "link.json"
    target.write_text("old")
    target.chmod(0o600)
    link.symlink_to(target)

    write_atomically(link, "new")

    assert link.is_symlink()
    assert target.read_text() == "new"
    assert stat.S_IMODE(target.stat().st_mode) == 0o600
    assert sorted(path.name for path in tmp_path.iterdir()) == ["link.json", "target.json"]


def test_standard_output_by_its_name_is_written_to(scene, tmp_path):
    with (tmp_path / "f").open("w") as file:
        done = run("tile", scene, "-o", "/dev/stdout", stdout=file)

    assert done.returncode == 0
    assert json.loads((tmp_path / "f").read_text())["at"] == "0"


def test_a_check_of_bodies_in_touch_says_so(tmp_path, program, capsys):
    path = tmp_path / "scene.json"
    square = [[0, 0], [2, 0], [2, 2], [0, 2]]
    bodies = [{"name": name, "vertices": square} for name in "ab"]
    path.write_text(json.dumps({"exactpt": 1, "time": [0, 1], "bodies": bodies}))

    assert code_of("check", path) == 0

    said = capsys.readouterr().out
    assert said == (
        "CGAL agrees: the proof is accepted; 0 tilings (greedy), 1 event times "
        "(bodies touch at the start: there is nothing to tile); a search over pairs agrees\n"
    )


@pytest.mark.plain
def test_a_check_finds_a_contact_that_the_tiling_missed(tmp_path, program, capsys, monkeypatch):
    """ "CGAL agrees" was all that it said: every tiling was one, and a contact was missed."""
    path = tmp_path / "scene.json"
    graze = {"y": ["1", "-2", "1"]}
    bodies = [
        {"name": "a", "vertices": [[0, 0]], "motion": graze},
        {"name": "b", "vertices": [[0, 0]]},
    ]
    path.write_text(json.dumps({"exactpt": 1, "time": [0, 3], "bodies": bodies}))
    monkeypatch.setattr("exactpt.tiling.touching.touches", lambda *_: [])

    assert code_of("check", path, "--tiling", "lazy") == 1

    head, proof, line = capsys.readouterr().out.splitlines()
    assert head.startswith("CGAL DISAGREES: the proof is REJECTED; ")
    assert "a search over pairs DISAGREES" in head
    assert proof.strip().startswith("proof rejected: line ")
    assert line.strip() == (
        "first contact (missed): the tiling finds no contact, but the search over pairs "
        "finds t = 1.0, vertex-vertex: a:0 on b:0"
    )


def test_out_of_budget_a_check_tells_how_far_it_came(tmp_path, program, capsys):
    path = tmp_path / "scene.json"
    save(generate("convex", 0), path)

    assert code_of("check", path, "--json", "--max-events", 0) == 4

    answer = json.loads(capsys.readouterr().out)
    assert answer["ok"] is None
    assert answer["reached"] not in (None, "0")


def test_a_name_with_a_line_break_leaves_a_line_a_line(tmp_path, capsys):
    path = tmp_path / "scene.json"
    bodies = [
        {"name": "up\nand away", "vertices": [[0, 0]], "motion": {"y": [0, 1]}},
        {"name": "wall", "vertices": [[-1, 1], [1, 1]]},
    ]
    path.write_text(json.dumps({"exactpt": 1, "time": [0, 2], "bodies": bodies}))

    assert code_of("collide", path) == 0

    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 2
    assert r"vertex 0 of 'up\nand away' on edge 0 of wall" in lines[1]
