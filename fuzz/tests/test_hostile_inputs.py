"""Hostile files: what the harness makes, and that it notices what it is there for."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest
from folding import every

from exactpt.batch.chunks import digest_of
from exactpt.batch.journal import SEAL
from exactpt.scene.format import loads
from exactpt.simulation.store import _checksum
from fuzz.campaign import Progress, campaign
from fuzz.hostile import readers
from fuzz.hostile.files import FORMATS, batch_files, hostile, scene_text
from fuzz.hostile.run import OUTCOMES, Files
from fuzz.limits import memory_bounded

ROOT = Path(__file__).parents[2]


def run(formats, count, keep, seed=0):
    """The check, its counts, and its findings."""
    check, progress, reported = Files(formats, seed, keep), Progress(), []
    campaign(check, progress, reported.append, count=count)
    return check, progress.counts, reported


@pytest.mark.parametrize("kind", FORMATS)
def test_files_of_every_format_are_read_or_refused(tmp_path, kind):
    check, counts, faults = run([kind], 60, tmp_path)

    assert faults == []
    assert sum(counts[kind, word] for word in OUTCOMES) == counts[kind, "files"] == 60
    assert counts[kind, "refused"] > 10
    assert 10 < counts[kind, "value"] < 50
    assert check.table(counts)[1].split()[:2] == [kind, "60"]


def test_a_file_is_the_same_for_its_number():
    assert hostile("svg", 7, 1) == hostile("svg", 7, 1)
    assert len({hostile(kind, i, 0).content for kind in FORMATS for i in range(20)}) > 100


def test_half_of_the_files_have_one_changed_value():
    files = [hostile("scene", i, 0) for i in range(100)]
    values = [file for file in files if file.wound == "value"]

    assert 35 < len(values) < 65
    for file in values:
        valid = json.loads(scene_text(file.seed))
        assert not isinstance(json.loads(file.content), list)
        assert loads(json.dumps(valid))


def test_saved_runs_with_a_changed_value_have_a_right_checksum():
    files = [hostile("saved", i, 0) for i in range(40)]
    values = [file for file in files if file.wound == "value"]
    for file in values:
        data = json.loads(file.content)
        del data["exactpt-simulation"]
        assert data.pop("sha256") == _checksum(data)
    assert values


def test_journals_with_a_changed_value_have_right_digests():
    files = [hostile("journal", i, 0) for i in range(60)]
    changed = 0
    for file in (file for file in files if file.wound == "value"):
        valid = batch_files(file.seed)["answers.jsonl.journal"].splitlines()
        for line, before in zip(file.content.decode().splitlines(), valid, strict=True):
            data = json.loads(line)
            if line == before or not isinstance(data, dict) or SEAL not in data:
                continue
            seal = data.pop(SEAL)
            assert seal == digest_of(json.dumps(data).encode() + b"\n")
            changed += 1
    assert changed > 5


@pytest.mark.skipif(sys.platform != "linux", reason="addresses are bounded on Linux")
def test_memory_beyond_the_bound_is_refused():
    with memory_bounded(1 << 20), pytest.raises(MemoryError):
        bytearray(3 << 30)
    assert len(bytearray(1 << 20)) == 1 << 20


def faulty(*_):
    raise ZeroDivisionError


def hanging(*_, **__):
    for _ in iter(int, 1):
        pass


def loud(*_, **__):
    sys.stdout.write("\x1b[31m")
    raise SystemExit(0)


@pytest.mark.parametrize(
    "target, how, fault",
    [
        ("exactpt.scene.scene.Scene.load", faulty, "exit code 3"),
        ("fuzz.hostile.readers.main", faulty, "ZeroDivisionError"),
        ("fuzz.hostile.readers.main", hanging, "hangs"),
        ("fuzz.hostile.readers.main", loud, "not printable"),
    ],
)
def test_faults_are_noticed_and_kept(tmp_path, monkeypatch, target, how, fault):
    monkeypatch.setattr(readers, "PATIENCE", 0.3)
    monkeypatch.setattr(readers, "COMMANDS", ("tile {0}",))
    monkeypatch.setattr(target, how)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    _, counts, reported = run(["scene"], 3, tmp_path / "found")

    assert counts["scene", "FAULT"] == counts["scene", "found"] == 3
    assert all(fault in found.why for found in reported)
    for number, found in enumerate(reported):
        content = hostile("scene", number, 0).content
        assert found.files == {tmp_path / "found" / f"scene-0-{number}": content}


@every(
    "code, out, err, written, fault",
    [
        (0, "answer\n", "", ["out.json"], ""),
        (2, "", "exactpt: no\n", [], ""),
        (2, "", "exactpt: no\nand no\n", [], "not one line"),
        (2, "answer", "exactpt: no\n", [], "refused in"),
        (2, "", "exactpt: no\n", ["out.json"], "but written"),
        (0, "", "", [".exactpt-1234"], "but written"),
        (3, "", "exactpt: bug\n", [], "exit code 3"),
        (0, "", "x.py:1: RuntimeWarning: overflow\n", [], "a warning"),
    ],
)
def test_what_is_promised(code, out, err, written, fault):
    found = readers._fault(code, out, err, written)

    assert (fault in found) if fault else found == ""


@pytest.mark.slow
def test_ten_thousand_files(tmp_path):
    assert run(FORMATS, 10_000, tmp_path, seed=7)[2] == []


def test_the_working_folder_stays(tmp_path):
    here = Path.cwd()

    readers.read("scene", hostile("scene", 1, 0), Random(1), tmp_path)

    assert Path.cwd() == here


@pytest.mark.skipif(sys.platform == "win32", reason="signals of a Unix")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_bug_an_interrupt_was_counted_as_a_fault(tmp_path, number):
    """The third command of the campaign interrupts it: the file is not counted, and is the next."""
    program = f"""
import os, signal, sys
from fuzz import __main__ as fuzzer
from fuzz.campaign import Progress, campaign
from fuzz.hostile import readers

main, calls = readers.main, []

def interrupting(words):
    calls.append(words)
    if len(calls) == 3:
        os.kill(os.getpid(), {int(number)})
    return main(words)

def command(words):
    try:
        return interrupting(words)
    except KeyboardInterrupt:
        raise SystemExit(130) from None

readers.main = command
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGTERM, signal.SIG_DFL)
sys.argv = ["fuzz", "--hostile", "--cases", "1000", "--seed", "5", "--format", "scene",
            "--jobs", "0"]
fuzzer.main()
"""
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip

    assert done.returncode == 130
    assert done.stderr == "interrupted; to go on: --seed 5 --start 2\n"
    assert done.stdout.splitlines()[2].split()[:2] == ["scene", "2"]
    assert not list(tmp_path.iterdir())
