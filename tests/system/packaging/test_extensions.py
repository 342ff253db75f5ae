"""setup.py builds all extensions or, if the C compiler fails at one, none."""

import os
import subprocess
import sys

import checkout
import pytest

# in place of mypyc: the shared library and two modules that need it
MYPYC = """
from setuptools import Extension
def mypycify(paths, **options):
    names = ["exactpt.compiled__mypyc", "exactpt.files", "exactpt.indices"]
    return [Extension(name, [name + ".c"]) for name in names]
"""
CC = """#!/bin/sh
for word; do
    case $previous in -o) made=$word ;; esac
    case $word in *"$FAILS"*) exit 1 ;; esac
    previous=$word
done
echo made >"$made"
"""

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="a compiler that is a script")


@pytest.fixture
def build(tmp_path):
    """Return the build by a compiler that fails at one word, what it made, and the folder."""
    source = tmp_path / "source"
    (source / "exactpt").mkdir(parents=True)
    (tmp_path / "mypyc").mkdir()
    (tmp_path / "mypyc" / "__init__.py").touch()
    (tmp_path / "mypyc" / "build.py").write_text(MYPYC)
    (tmp_path / "cc").write_text(CC)
    (tmp_path / "cc").chmod(0o755)
    for name in ("setup.py", "exactpt/__init__.py", "exactpt/compiled.py", "exactpt/indices.py"):
        (source / name).write_bytes((checkout.ROOT / name).read_bytes())
    for name in ("compiled__mypyc", "files", "indices"):
        (source / f"exactpt.{name}.c").touch()

    def run(*command, fails):
        env = {
            **os.environ,
            "CC": str(tmp_path / "cc"),
            "FAILS": fails,
            "PYTHONPATH": str(tmp_path),
        }
        env.pop("EXACTPT_PLAIN", None)
        done = subprocess.run(
            [sys.executable, "setup.py", *command],
            cwd=source, env=env, capture_output=True, text=True, check=False,
        )  # fmt: skip
        made = [p for p in source.rglob("*.so") if "temp" not in str(p)]
        return done, {p.name.partition(".")[0] for p in made}, source

    return run


BUILD = ["build", "--build-lib", "lib"]
ALL = {"compiled__mypyc", "files", "indices"}


def test_all_are_built(build):
    done, made, _ = build(*BUILD, fails="no such word")

    assert (done.returncode, made) == (0, ALL)


@pytest.mark.parametrize("fails", ["exactpt.compiled__mypyc.c", "exactpt.indices.c", "-shared", ""])
def test_none_is_left_where_the_compiler_fails_at_one(build, fails):
    """Modules without the shared library cannot be imported."""
    done, made, _ = build(*BUILD, fails=fails)

    assert (done.returncode, made) == (0, set())
    assert "plain Python, without its compiled modules" in done.stderr


def test_a_checkout_where_the_compiler_fails_is_plain(build):
    in_place = ["build_ext", "--inplace"]
    done, made, source = build(*in_place, fails="no such word")
    assert (done.returncode, made) == (0, ALL)
    assert (source / "exactpt" / "compiled.txt").exists()

    (source / "exactpt.indices.c").write_text("edited")
    done, made, _ = build(*in_place, "--force", fails="exactpt.indices.c")

    assert (done.returncode, made) == (0, set())
    assert not (source / "exactpt" / "compiled.txt").exists()
