""".ci/run makes all of its steps, tells what each took, and fails if one of them does."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
STEPS = ["test", "test-compiled", "test-lowest", "test-rotating", "small-scope"]

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="a script for sh")


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


def test_every_step_is_made_and_its_minutes_told(ci):
    done = ci()

    made, minutes = done.stdout.split("\nminutes:\n")
    assert done.returncode == 0
    assert made == "".join(f"made {s} {'ci' if s == 'test' else 'dev'}\n" for s in STEPS)
    reported = re.findall(r"^ *\d+:\d\d  (.*)$", minutes, re.MULTILINE)
    assert reported == [*(f"make {s}" for s in STEPS), "in all"]


@pytest.mark.parametrize("step", STEPS)
def test_a_step_that_fails_fails_it_and_the_others_are_made(ci, step):
    done = ci(f'[ "$1" != {step} ]')

    assert done.returncode == 1
    assert done.stdout.count("made ") == len(STEPS)
    assert done.stdout.splitlines()[-1] == f"FAILED STEP {step}"


def test_cgal_tests_that_were_skipped_fail_it(ci):
    done = ci('echo "SKIPPED [3] tests/system/cgal/test_cgal_client.py: no program"')

    assert done.returncode == 1
    assert done.stderr == "CGAL tests were skipped\n"
