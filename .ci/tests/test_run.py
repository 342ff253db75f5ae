"""The command of continuous integration: its steps, what it tests of a change, what fails it."""

import os
import re
import runpy
import subprocess
import sys

import pytest
from checkout import ROOT

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no resource module")

script = runpy.run_path(str(ROOT / ".ci" / "steps.py"))
PACKAGE = ["test", "turn", "test-compiled", "test-lowest", "test-docs"]


@pytest.fixture
def ci(tmp_path):
    """Run it with a `make` that prints its words, and runs what a shell would."""

    def run(*targets, does=":", by=()):
        make = tmp_path / "make"
        make.write_text(f'#!/bin/sh\necho "made $* $HYPOTHESIS_PROFILE"\n{does}\n')
        make.chmod(0o755)
        path = f"{tmp_path}:{os.environ['PATH']}"
        env = {**os.environ, "PATH": path, "BASE": "no-such-commit"}
        words = [*by, ROOT / ".ci" / "run", *targets]
        return subprocess.run(words, env=env, capture_output=True, text=True, check=False)

    return run


def test_run_without_a_known_base_makes_every_step_and_prints_its_minutes(ci):
    done = ci()

    made, minutes = done.stdout.split("\n clock")
    words = [
        "test",
        "turn BASE=no-such-commit",
        *PACKAGE[2:],
        "test-tools TOOLS=fuzz benchmarks .ci",
    ]
    assert (done.returncode, done.stderr) == (0, "")
    assert made == "".join(f"made {step} ci\n" for step in words)
    reported = re.findall(r"^ +\d+:\d\d +\d+:\d\d  (.*)$", minutes, re.MULTILINE)
    assert reported == [*(f"make {step}" for step in words), "in all"]


def test_run_of_named_targets_makes_these(ci):
    done = ci("quick", "test-tools TOOLS=fuzz")

    assert done.returncode == 0
    assert done.stdout.startswith("made quick ci\nmade test-tools TOOLS=fuzz ci\n\n clock")


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_run_may_be_started_by_a_shell(ci, shell):
    """A service of continuous integration may run the file without looking at its first line."""
    done = ci("quick", by=[shell])

    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("made quick ci\n")


@pytest.mark.parametrize("step", [*PACKAGE, "test-tools"])
def test_step_that_fails_fails_the_run_and_the_others_are_made(ci, step):
    done = ci(does=f'[ "$1" != {step} ]')

    assert done.returncode == 1
    assert done.stdout.count("made ") == len(PACKAGE) + 1
    (failure,) = done.stderr.splitlines()
    assert failure.startswith(f"FAILED STEP make {step}")


def test_cgal_tests_that_were_skipped_fail_the_run(ci):
    done = ci(
        does='[ "$1" != test ] || echo "SKIPPED [3] tests/system/cgal/test_cgal_client.py: no"'
    )

    line = "SKIPPED [3] tests/system/cgal/test_cgal_client.py: no"
    assert done.returncode == 1
    assert done.stderr == f"CGAL tests were skipped: {line}\n"


def test_processor_time_of_a_step_is_that_of_its_processes_by_two(ci):
    """A process of `make` takes 2.2 seconds of one processor: 1.1 of two."""
    busy = "import time\nwhile time.process_time() < 2.2: pass"
    done = ci(does=f"[ $1 != turn ] || '{sys.executable}' -c '{busy}'")

    assert done.returncode == 0
    assert re.search(r" 0:01  make turn BASE=no-such-commit$", done.stdout, re.MULTILINE)
    assert re.search(r" 0:00  make test$", done.stdout, re.MULTILINE)


def test_run_fails_above_the_limit_that_the_environment_names(monkeypatch, capsys):
    names = script["main"].__globals__
    monkeypatch.setitem(names, "steps", lambda _: [["test"]])
    took = script["Took"]("make test", 100, 2 * 61)
    monkeypatch.setitem(names, "made", lambda _: (took, []))

    monkeypatch.delenv("LIMIT", raising=False)
    assert script["main"]([]) == 0
    monkeypatch.setenv("LIMIT", "1.5")
    assert script["main"]([]) == 0
    monkeypatch.setenv("LIMIT", "1")
    assert script["main"]([]) == 1
    assert capsys.readouterr().err == "1:01 minutes; the limit is 1:00\n"


@pytest.mark.parametrize(
    ("changed", "tools"),
    [
        (None, ["fuzz", "benchmarks", ".ci"]),
        ([], []),
        (["exactpt/search/sweep.py", "tests/unit/search/test_pairs.py", "fuzzy.py"], []),
        (["fuzz/laws/table.py", "README.md"], ["fuzz"]),
        (
            ["benchmarks/tests/test_engines.py", ".github/workflows/night.yml"],
            ["benchmarks", ".ci"],
        ),
        (["tests/helpers/folding.py"], ["fuzz", "benchmarks", ".ci"]),
        (["conftest.py"], ["fuzz", "benchmarks", ".ci"]),
    ],
)
def test_tools_to_test_are_those_that_have_changed(changed, tools):
    assert script["tools_to_test"](changed) == tools


@pytest.fixture
def branch(tmp_path, monkeypatch):
    """A repository whose branch has changed one file, and has a new one that git does not know."""

    def git(*words):
        identity = ["-c", "user.name=n", "-c", "user.email=e", "-c", "commit.gpgsign=false"]
        return subprocess.run(
            ["git", *identity, *words], cwd=tmp_path, capture_output=True, text=True, check=True
        ).stdout.strip()

    git("init", "--quiet", "--initial-branch=main")
    (tmp_path / "old").write_text("1")
    (tmp_path / "same").write_text("1")
    git("add", ".")
    git("commit", "--quiet", "-m", "first")
    first = git("rev-parse", "HEAD")
    monkeypatch.setitem(script["git"].__globals__, "ROOT", tmp_path)
    monkeypatch.delenv("BASE", raising=False)
    assert script["base_of_branch"]() is None, "main itself has no base"

    git("checkout", "--quiet", "-b", "change")
    (tmp_path / "old").write_text("2")
    git("commit", "--quiet", "-a", "-m", "second")
    (tmp_path / "new").write_text("1")
    return first


def test_base_is_the_commit_at_which_the_branch_left_main(branch):
    assert script["base_of_branch"]() == branch
    assert script["changed_since"](branch) == ["old", "new"]


def test_base_that_git_does_not_know_cannot_tell_what_changed(branch):
    assert script["changed_since"]("0" * 40) is None


def test_folder_without_a_repository_has_no_base(tmp_path, monkeypatch):
    monkeypatch.setitem(script["git"].__globals__, "ROOT", tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))

    assert script["base_of_branch"]() is None
