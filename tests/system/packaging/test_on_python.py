""".ci/on-python refuses what it cannot do in a line, and shows why a chroot could not be made."""

import os
import subprocess
import sys

import checkout
import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="a script for Debian")

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


@pytest.mark.parametrize("arguments", [[], ["--help"], ["../trixie"], [".."]])
def test_a_release_is_needed(tmp_path, arguments):
    assert run(tmp_path, *arguments) == (2, USAGE)
    assert not (tmp_path / "chroots").exists()


def test_root_is_needed(tmp_path):
    assert run(tmp_path, "trixie", user="1000") == (2, NEEDS)


def test_the_last_lines_of_a_failed_debootstrap_are_shown(tmp_path):
    code, errors = run(tmp_path, "trixie")

    lines = errors.splitlines()
    assert code == 1
    assert [line[0] for line in lines] == ["2", "3", "4"]
    assert all(line.endswith(f" trixie {tmp_path}/chroots/trixie") for line in lines)
    assert not (tmp_path / "chroots" / "trixie" / "made").exists()
