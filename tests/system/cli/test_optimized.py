"""PYTHONOPTIMIZE, which removes assertions (1) and docstrings (2), changes no answer."""

import os
import subprocess
import sys

import pytest


def run(level, folder, *arguments):
    done = subprocess.run(
        [sys.executable, "-m", "exactpt", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONOPTIMIZE": level},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plain")
    return run("", folder, "demo"), (folder / "exactpt-demo.html").read_bytes()


@pytest.mark.parametrize("level", ["1", "2"])
def test_the_demo_is_the_same(level, plain, tmp_path):
    done = run(level, tmp_path, "demo")

    assert done[0] == 0
    assert (done, (tmp_path / "exactpt-demo.html").read_bytes()) == plain


@pytest.mark.parametrize("level", ["1", "2"])
def test_a_bad_scene_is_refused_in_one_line(level, tmp_path):
    (tmp_path / "bad.json").write_text('{"bodies": [{"outer": [[0, "x"]]}]}')

    status, out, said = run(level, tmp_path, "collide", "bad.json")

    assert (status, out, said.count("\n")) == (2, "", 1)


def test_help_without_docstrings_has_the_options(tmp_path):
    assert "--tiling" in run("2", tmp_path, "collide", "--help")[1]


def test_a_set_whose_readme_would_lack_its_descriptions_is_refused(tmp_path):
    """The README said "None" of each family."""
    status, out, said = run(
        "2", tmp_path, "questions", "--set", "set", "--questions", "0", "--scenes", "0"
    )

    assert (status, out) == (2, "")
    assert said == (
        "exactpt: PYTHONOPTIMIZE=2 removes the descriptions that the README of a set quotes\n"
    )
    assert not (tmp_path / "set").exists()
