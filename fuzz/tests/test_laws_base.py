"""Faults of laws are compared with another commit: which of them are new."""

import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

import exactpt
from exactpt import InputError
from fuzz import commits
from fuzz.laws import base, command, runner, table
from fuzz.laws.base import Base
from fuzz.laws.law import Law
from fuzz.laws.runner import case_of, look
from fuzz.witnesses import Difference

OLD_RUNNER = """
from collections import namedtuple
from exactpt import InputError

Fault = namedtuple("Fault", "signature")
Looked = namedtuple("Looked", "outcome fault")

class Case:
    @staticmethod
    def parse(text):
        return text

def look(case, scene):
    print("a line of the law")
    {body}
"""
HOLDS = 'return Looked("none", None)'
SAME = 'return Looked("fault", Fault("triangle"))'
OTHER = 'return Looked("fault", Fault("another"))'
SOMETIMES = (
    'return Looked("fault", Fault("triangle")) if scene.vertex_count > 3 else Looked("n", None)'
)
DIES = 'raise SystemExit("no more")'


def has_a_triangle(scene, random):
    """No body of a scene is a triangle."""
    if any(body.size == 3 for body in scene.bodies):
        raise Difference("triangle", f"{len(scene.bodies)} bodies")
    return "none"


@pytest.fixture
def law(monkeypatch):
    monkeypatch.setitem(table.LAWS, "test/triangles", Law(has_a_triangle, ("family/convex",)))
    return "test/triangles"


@pytest.fixture
def fault(law):
    """A fault in a scene of more than one body."""
    found = (look(case_of(law, 0, number)).fault for number in range(50))
    return next(one for one in found if one and one.scene.vertex_count > 3)


@pytest.fixture
def old(monkeypatch):
    """Makes a commit whose runner of laws has another body."""

    def prepare(body):
        def unpack(commit, place):
            (place / "exactpt").symlink_to(Path(exactpt.__file__).parent)
            (place / "fuzz" / "laws").mkdir(parents=True)
            (place / "fuzz" / "laws" / "runner.py").write_text(OLD_RUNNER.format(body=body))

        monkeypatch.setattr(base, "unpack", unpack)

    return prepare


def test_fault_that_the_base_has_is_there_before(old, fault):
    old(SAME)
    with Base("old") as compared:
        verdict = compared.verdict(fault)

    assert str(verdict) == "there before: in old the law is broken: triangle"


@pytest.mark.parametrize(
    ("body", "why"),
    [
        (HOLDS, "new: in old the law holds (none)"),
        (OTHER, "new: in old the law is broken: another"),
        (DIES, "new: not compared with old: no more"),
        ('raise InputError("x")', "new: not compared with old: exactpt.errors.InputError: x"),
    ],
)
def test_fault_that_the_base_has_not_is_new(old, fault, body, why):
    old(body)
    with Base("old") as compared:
        verdicts = [str(compared.verdict(fault)) for _ in range(2)]

    assert verdicts == [why, why]


def test_fault_that_the_base_has_in_the_larger_scene_only_is_new(old, fault):
    old(SOMETIMES)
    smaller = runner.shrunk(fault, 1.0)
    with Base("old") as compared:
        assert not compared.verdict(fault).is_new
        assert compared.verdict(fault, smaller).is_new


@pytest.mark.parametrize(("body", "code"), [(SAME, 0), (HOLDS, 1)])
def test_only_a_new_fault_fails_again_and_run(old, law, fault, body, code):
    old(body)
    words = ["--on", "old", "--shrink", "0"]

    again = CliRunner().invoke(command.again, [law, fault.case.place, *words])
    ran = CliRunner().invoke(command.run, [law, "--seed", "0", "--seconds", "0.3", *words])

    assert (again.exit_code, ran.exit_code) == (code, code)
    for done in (again, ran):
        assert done.output.count("test/triangles: triangle") == 1
        assert ("\n  new: in old " in done.output) == (code == 1)
        assert ("\n  there before: in old " in done.output) == (code == 0)


def test_again_of_a_case_that_holds_says_what_the_base_says(old):
    old(SAME)
    words = ["first contact/methods", "tiny/fractions:0:0", "--on", "old"]

    done = CliRunner().invoke(command.again, words)

    assert done.exit_code == 0
    assert done.output.startswith("holds: ")
    assert done.output.endswith("\n  in old the law is broken: triangle\n")


def test_commit_that_is_not_there_is_a_usage_error():
    done = CliRunner().invoke(command.run, ["tiling/static", "--on", "no-such-commit"])

    assert done.exit_code == 2
    assert f"--on: no commit no-such-commit in {commits.ROOT}" in done.output


def test_files_of_a_commit_are_those_it_has(tmp_path, monkeypatch):
    """Neither what has changed since, nor what git does not know."""
    repository, place = tmp_path / "repository", tmp_path / "place"
    repository.mkdir()
    place.mkdir()
    identity = ["-c", "user.name=n", "-c", "user.email=e", "-c", "commit.gpgsign=false"]
    git = ["git", *identity, "-C", repository]
    (repository / "file").write_text("before")
    for words in (["init", "--quiet"], ["add", "."], ["commit", "--quiet", "-m", "first"]):
        subprocess.run([*git, *words], check=True)
    (repository / "file").write_text("after")
    (repository / "new").write_text("after")
    monkeypatch.setattr(commits, "ROOT", repository)

    commits.unpack("HEAD", place)

    assert [(path.name, path.read_text()) for path in place.iterdir()] == [("file", "before")]
    with pytest.raises(InputError, match=r"no commit --output=x in .*; fetch it"):
        commits.unpack("--output=x", place)


def test_favoured_laws_have_more_cases(monkeypatch):
    for name in ("test/one", "test/two"):
        monkeypatch.setitem(table.LAWS, name, Law(has_a_triangle, ("family/convex",)))

    looked = list(runner.run_for(["test/one", "test/two"], 0, 0.5, runner.favour(["test/two"])))

    seconds = {"test/one": 0.0, "test/two": 0.0}
    for one in looked:
        seconds[one.case.law] += one.seconds
    assert seconds["test/two"] > 3 * seconds["test/one"] > 0
