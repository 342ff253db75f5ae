"""A file that a command writes is complete or not there, whatever ends the run."""

import os
import resource
import signal
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from commands import code_of

from exactpt.files import write_atomically, writing
from exactpt.scene.written import save
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals and limits of a Unix")
needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")

MAIN = "from exactpt.cli import main; main()"
# A child of a shell's background ignores SIGINT, one of nohup SIGHUP.
STUCK = """
import signal, time
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
signal.signal(signal.SIGTERM, signal.SIG_DFL)
from exactpt.simulation.simulation import Simulation
run = Simulation.run
def stuck(self):
    for i, event in enumerate(run(self)):
        yield event
        if i == 2:
            print("now", flush=True)
            time.sleep(1000)
Simulation.run = stuck
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    save(generate("convex", 3), tmp_path / "scene.json")
    return tmp_path


def command(*arguments, code=MAIN):
    return [sys.executable, "-c", code, *arguments]


def there(folder):
    return sorted(path.name for path in folder.iterdir())


def test_without_a_reader_the_log_is_complete(folder):
    assert code_of("simulate", "scene.json", "--events", "complete.jsonl") == 0
    ours, theirs = os.pipe()
    os.close(ours)

    done = subprocess.run(
        command("simulate", "scene.json", "--verbose", "--events", "log.jsonl"),
        stdout=theirs, stderr=subprocess.PIPE, check=False,
    )  # fmt: skip

    os.close(theirs)
    assert (done.returncode, done.stderr) == (0, b"")
    complete = (folder / "complete.jsonl").read_bytes()
    assert complete.count(b"\n") > 5
    assert (folder / "log.jsonl").read_bytes() == complete
    assert there(folder) == ["complete.jsonl", "log.jsonl", "scene.json"]


@needs_full
def test_what_cannot_be_said_leaves_no_half_of_a_log(folder):
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            command("simulate", "scene.json", "--verbose", "--events", "log.jsonl"),
            stdout=full, stderr=subprocess.PIPE, check=False,
        )  # fmt: skip

    assert (done.returncode, done.stderr) == (2, b"exactpt: No space left on device\n")
    assert there(folder) == ["scene.json"]


@pytest.mark.parametrize("option", ["--max-events=3", "--max-seconds=0"])
def test_out_of_budget_there_is_no_log_and_an_older_one_stays(folder, option):
    assert code_of("simulate", "scene.json", option, "--events", "log.jsonl") == 4
    assert there(folder) == ["scene.json"]

    (folder / "log.jsonl").write_text("older")
    assert code_of("simulate", "scene.json", option, "--events", "log.jsonl") == 4
    assert (folder / "log.jsonl").read_text() == "older"
    assert there(folder) == ["log.jsonl", "scene.json"]


def test_after_a_bug_there_is_no_log(folder, monkeypatch, capsys):
    def breaks(self):
        yield next(run(self))
        raise ZeroDivisionError

    run = Simulation.run
    monkeypatch.setattr(Simulation, "run", breaks)

    assert code_of("simulate", "scene.json", "--events", "log.jsonl") == 3

    assert there(folder) == ["scene.json"]
    Path(capsys.readouterr().err.split("saved in ")[1].splitlines()[0]).unlink()


@pytest.mark.parametrize(
    "number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_after_a_signal_there_is_no_log(folder, number, code):
    line = command("simulate", "scene.json", "--events", "log.jsonl", code=STUCK + MAIN)
    with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as running:
        try:
            assert running.stdout.readline() == b"now\n"
            assert len(there(folder)) == 2
            running.send_signal(number)

            assert running.wait(60) == code
        finally:
            running.kill()

    assert there(folder) == ["scene.json"]


@needs_full
@pytest.mark.parametrize(
    "line",
    ["simulate scene.json --events", "tile scene.json -o", "generate convex -o"],
)
def test_a_full_device_is_told_in_one_line(folder, line, capsys):
    assert code_of(*line.split(), "/dev/full") == 2

    said = capsys.readouterr()
    assert said.err == "exactpt: /dev/full: cannot be written: No space left on device\n"


@pytest.mark.parametrize(
    "line",
    [
        "simulate scene.json --events log.jsonl",
        "tile scene.json -o tiling.json",
        "generate convex -o convex.json",
        "draw scene.json -o film.html",
        "draw scene.json -o still.svg",
        "convert scene.json shapes.geojson",
        "demo -o demo.html",
    ],
)
def test_a_file_that_has_no_room_is_not_there(folder, line):
    def little_room():
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

    done = subprocess.run(
        command(*line.split()), preexec_fn=little_room, capture_output=True, text=True, check=False
    )

    assert done.returncode == 2
    assert done.stderr == f"exactpt: {line.split()[-1]}: cannot be written: File too large\n"
    assert there(folder) == ["scene.json"]


def test_threads_write_side_by_side(tmp_path, monkeypatch):
    """The umask is of the whole process: who changes it for a moment, changes it for all."""
    umask = os.umask(0o027)
    monkeypatch.setattr(os, "umask", None)
    texts = [f"{i}" * 100_000 for i in range(8)]
    try:
        with ThreadPoolExecutor(8) as pool:
            list(pool.map(lambda text: write_atomically(tmp_path / "file", text), texts))
    finally:
        monkeypatch.undo()
        os.umask(umask)

    assert (tmp_path / "file").read_text() in texts
    assert stat.S_IMODE((tmp_path / "file").stat().st_mode) == 0o640
    assert there(tmp_path) == ["file"]


def test_nobody_else_reads_what_replaces_a_private_file(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    path.chmod(0o600)

    with writing(path) as write:
        write("new")
        assert [stat.S_IMODE(p.stat().st_mode) for p in tmp_path.iterdir()] == [0o600] * 2

    assert path.read_text() == "new"
