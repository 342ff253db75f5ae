"""Errors that were once reported as a broken invariant (exit code 3), or by a wrong exit code."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from commands import code_of
from terminals import Bar, Terminal

from exactpt import Body, Scene, Translation
from exactpt.cli import cli

needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")


def write_scene(folder, span):
    """A ball that reaches a wall in the middle of the span, and a spot that passes by."""
    end = f"1e{span}"
    half = f"5e{span - 1}"
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, f"9e{-span}"]))
    wall = Body("wall", [("11/2", -5), ("11/2", 5)])
    spot = Body("spot", [(3, 3)], Translation([], [0, f"-2e{-span}", f"1e{-2 * span}"]))
    Scene([ball, wall, spot], (0, end)).save(folder / "scene.json")
    return half


@pytest.mark.parametrize("command", ["simulate", "draw"])
@pytest.mark.parametrize("span", [400, -399, 3])
def test_the_bar_of_spans_beyond_doubles(tmp_path, monkeypatch, command, span):
    write_scene(tmp_path, span)
    monkeypatch.chdir(tmp_path)
    screen, shown = Terminal(), []
    monkeypatch.setattr("exactpt.cli.terminal.sys.stderr", screen)
    monkeypatch.setattr("exactpt.cli.progress.click.progressbar", lambda **_: Bar(shown))
    more = ["-o", "film.html"] if command == "draw" else []

    assert cli.main([command, "scene.json", *more], standalone_mode=False) == 0

    assert shown == sorted(shown)
    assert shown[-1] == 500


@pytest.mark.parametrize("command", ["collide", "simulate", "tile", "draw -o a.svg", "convert"])
def test_a_command_in_a_thread(tmp_path, monkeypatch, command):
    """Signals belong to the main thread; elsewhere the library's own checks hold the limit."""
    write_scene(tmp_path, 1)
    monkeypatch.chdir(tmp_path)
    verb, *options = command.split()
    target = ["out.geojson"] if verb == "convert" else []
    ended = []

    def work():
        code = code_of(verb, "scene.json", *target, *options, "--max-seconds", "100")
        ended.append(code)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()

    assert ended == [0]


def run(*arguments, **streams):
    command = [sys.executable, "-c", "from exactpt.cli import main; main()", *map(str, arguments)]
    return subprocess.run(command, check=False, text=True, **streams)


@needs_full
@pytest.mark.parametrize(
    "options, code", [(["--until", "0"], 2), (["--max-seconds", "0"], 4), (["--what"], 2)]
)
def test_a_full_disk_behind_standard_error_is_no_contact(tmp_path, options, code):
    """It was exit code 1, which says with --exit-code that there is a contact."""
    write_scene(tmp_path, 1)
    with open("/dev/full", "w") as full:
        done = run("collide", tmp_path / "scene.json", "--exit-code", *options,
                   stdout=subprocess.PIPE, stderr=full)  # fmt: skip

    assert done.returncode == code


@needs_full
def test_a_bug_behind_a_full_disk_is_a_bug(tmp_path):
    write_scene(tmp_path, 1)
    breaks = "import exactpt.search.sweep_search as s; s.near_at_start = lambda *_: 1 // 0; "
    command = f"{breaks}from exactpt.cli import main; main()"
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-c", command, "collide", tmp_path / "scene.json", "--exit-code"],
            stderr=full, env={**os.environ, "TMPDIR": str(tmp_path)}, check=False,
        )  # fmt: skip

    assert done.returncode == 3


@pytest.mark.parametrize("closed", ["1", "2"])
def test_without_a_stream(tmp_path, closed):
    write_scene(tmp_path, 1)
    command = f'exec "{sys.executable}" -c "from exactpt.cli import main; main()" "$@" {closed}>&-'

    def code(*arguments):
        line = ["sh", "-c", command, "sh", "collide", str(tmp_path / "scene.json"), *arguments]
        return subprocess.run(line, check=False, capture_output=True).returncode

    assert code("--exit-code") == 1
    assert code("--exit-code", "--until", "1") == 0
    assert code("--exit-code", "--until", "0") == 2
