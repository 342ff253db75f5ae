"""The scripts in .ci: run, on-python, lowest."""

import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import checkout
import pytest

ci_mark = pytest.mark.skipif(sys.platform == "win32", reason="a script for sh")

ROOT = Path(__file__).parents[3]
STEPS = ["test", "test-compiled", "test-lowest", "test-rotating", "small-scope"]


@pytest.fixture
def ci(tmp_path):
    """Run it with a `make` that prints its target, and runs what a shell would."""

    def run(does=":"):
        make = tmp_path / "make"
        make.write_text(f'#!/bin/sh\necho "made $1 $HYPOTHESIS_PROFILE"\n{does}\n')
        make.chmod(0o755)
        env = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
        return subprocess.run(
            [ROOT / ".ci" / "run"], env=env, capture_output=True, text=True, check=False
        )

    return run


@ci_mark
def test_every_step_is_made_and_its_minutes_told(ci):
    done = ci()

    made, minutes = done.stdout.split("\nminutes:\n")
    assert done.returncode == 0
    assert made == "".join(f"made {s} {'ci' if s == 'test' else 'dev'}\n" for s in STEPS)
    reported = re.findall(r"^ *\d+:\d\d  (.*)$", minutes, re.MULTILINE)
    assert reported == [*(f"make {s}" for s in STEPS), "in all"]


@ci_mark
@pytest.mark.parametrize("step", STEPS)
def test_a_step_that_fails_fails_it_and_the_others_are_made(ci, step):
    done = ci(f'[ "$1" != {step} ]')

    assert done.returncode == 1
    assert done.stdout.count("made ") == len(STEPS)
    assert done.stdout.splitlines()[-1] == f"FAILED STEP {step}"


@ci_mark
def test_cgal_tests_that_were_skipped_fail_it(ci):
    done = ci('echo "SKIPPED [3] tests/system/cgal/test_cgal_client.py: no program"')

    assert done.returncode == 1
    assert done.stderr == "CGAL tests were skipped\n"


# .ci/on-python refuses what it cannot do in a line, and shows why a chroot could not be made

on_python_mark = pytest.mark.skipif(sys.platform != "linux", reason="a script for Debian")

USAGE = "usage: .ci/on-python RELEASE [TARGET...] [PYTHON=python3.N] [JOBS=N]\n"
NEEDS = ".ci/on-python needs root and debootstrap (apt-get install debootstrap)\n"


def run(folder, *arguments, user="0", debootstrap="for n in 1 2 3 4; do echo $n $*; done; exit 1"):
    """Run it as a user, with a command in place of debootstrap."""
    for name, does in {"id": f"echo {user}", "debootstrap": debootstrap}.items():
        (folder / name).write_text(f"#!/bin/sh\n{does}\n")
        (folder / name).chmod(0o755)
    env = {
        **os.environ,
        "PATH": f"{folder}:{os.environ['PATH']}",
        "CHROOTS": str(folder / "chroots"),
    }
    done = subprocess.run(
        [checkout.ROOT / ".ci" / "on-python", *arguments],
        env=env, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stderr


@on_python_mark
@pytest.mark.parametrize("arguments", [[], ["--help"], ["../trixie"], [".."]])
def test_a_release_is_needed(tmp_path, arguments):
    assert run(tmp_path, *arguments) == (2, USAGE)
    assert not (tmp_path / "chroots").exists()


@on_python_mark
def test_root_is_needed(tmp_path):
    assert run(tmp_path, "trixie", user="1000") == (2, NEEDS)


@on_python_mark
def test_the_last_lines_of_a_failed_debootstrap_are_shown(tmp_path):
    code, errors = run(tmp_path, "trixie")

    lines = errors.splitlines()
    assert code == 1
    assert [line[0] for line in lines] == ["2", "3", "4"]
    assert all(line.endswith(f" trixie {tmp_path}/chroots/trixie") for line in lines)
    assert not (tmp_path / "chroots" / "trixie" / "made").exists()


# The constraints of `make test-lowest` are the lower bounds of pyproject.toml

PYPROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
lowest = runpy.run_path(str(ROOT / ".ci" / "lowest.py"))["lowest"]


def project(*requirements, extra=(), group=()):
    lists = f"dependencies = {list(requirements)}\n[project.optional-dependencies]\n"
    groups = f"[dependency-groups]\nall = [{{include-group = 'own'}}]\nown = {list(group)}\n"
    start = '[build-system]\nrequires = ["backend>=3"]\n[project]\nname = "exactpt"\n'
    return f"{start}{lists}extra = {list(extra)}\n{groups}"


def test_every_lower_bound_is_a_constraint():
    named = set(re.findall(r'"([\w-]+)[>=]=([\d.]+)"', PYPROJECT))

    constraints = lowest(PYPROJECT)

    assert {f"{name}=={version}" for name, version in named} == set(constraints)
    assert {line.split("==")[0] for line in constraints} >= {"gmpy2", "numpy", "click", "pytest"}


def test_extras_and_groups_count_and_the_package_itself_does_not():
    given = project("A_b>=1.2", extra=["exactpt[more]", "c==4"], group=["d>=5", "exactpt[extra]"])

    assert lowest(given) == ["a-b==1.2", "backend==3", "c==4", "d==5"]


@pytest.mark.parametrize(
    "given, says",
    [
        (project("a>=1", extra=["a>=2"]), "a: the lower bounds 1 and 2"),
        (project("a>=1", group=["a>=2"]), "a: the lower bounds 1 and 2"),
        (project("a"), "a: not one lower bound"),
        (project("a<2"), "a<2: not one lower bound"),
    ],
)
def test_what_one_install_cannot_test_is_refused(given, says):
    with pytest.raises(ValueError, match=says):
        lowest(given)
