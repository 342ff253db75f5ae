"""The scripts in .ci: on-python, lowest."""

import os
import re
import runpy
import subprocess
import sys

import checkout
import pytest

# .ci/on-python refuses what it cannot do in a line, and shows why a chroot could not be made

needs_debian = pytest.mark.skipif(sys.platform != "linux", reason="a script for Debian")

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


@needs_debian
@pytest.mark.parametrize("arguments", [[], ["--help"], ["../trixie"], [".."]])
def test_a_release_is_needed(tmp_path, arguments):
    assert run(tmp_path, *arguments) == (2, USAGE)
    assert not (tmp_path / "chroots").exists()


@needs_debian
def test_root_is_needed(tmp_path):
    assert run(tmp_path, "trixie", user="1000") == (2, NEEDS)


@needs_debian
def test_the_last_lines_of_a_failed_debootstrap_are_shown(tmp_path):
    code, errors = run(tmp_path, "trixie")

    lines = errors.splitlines()
    assert code == 1
    assert [line[0] for line in lines] == ["2", "3", "4"]
    assert all(line.endswith(f" trixie {tmp_path}/chroots/trixie") for line in lines)
    assert not (tmp_path / "chroots" / "trixie" / "made").exists()


# The constraints of `make test-lowest` are the lower bounds of pyproject.toml

PYPROJECT = (checkout.ROOT / "pyproject.toml").read_text(encoding="utf-8")
lowest = runpy.run_path(str(checkout.ROOT / ".ci" / "lowest.py"))["lowest"]


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
