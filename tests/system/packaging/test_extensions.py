"""Extensions: all are built or none; edited modules are not hidden."""

import os
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import checkout
import pytest

extensions_mark = pytest.mark.skipif(sys.platform == "win32", reason="a compiler that is a script")

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


@extensions_mark
def test_all_are_built(build):
    done, made, _ = build(*BUILD, fails="no such word")

    assert (done.returncode, made) == (0, ALL)


@extensions_mark
@pytest.mark.parametrize("fails", ["exactpt.compiled__mypyc.c", "exactpt.indices.c", "-shared", ""])
def test_none_is_left_where_the_compiler_fails_at_one(build, fails):
    """Modules without the shared library cannot be imported."""
    done, made, _ = build(*BUILD, fails=fails)

    assert (done.returncode, made) == (0, set())
    assert "plain Python, without its compiled modules" in done.stderr


@extensions_mark
def test_a_checkout_where_the_compiler_fails_is_plain(build):
    in_place = ["build_ext", "--inplace"]
    done, made, source = build(*in_place, fails="no such word")
    assert (done.returncode, made) == (0, ALL)
    assert (source / "exactpt" / "compiled.txt").exists()

    (source / "exactpt.indices.c").write_text("edited")
    done, made, _ = build(*in_place, "--force", fails="exactpt.indices.c")

    assert (done.returncode, made) == (0, set())
    assert not (source / "exactpt" / "compiled.txt").exists()


# An edited module of a compiled checkout is not hidden; `exactpt.compiled` compares

PACKAGE = Path(__file__).parents[3] / "exactpt"
LINE = "exactpt/indices.py was {} after `make compiled`: run make compiled or make plain"


@pytest.fixture
def copy(tmp_path):
    """A checkout of a few modules, in git, with the list that setup.py writes."""
    package = tmp_path / "exactpt"
    package.mkdir()
    for name in ("__init__", "__main__", "compiled", "extensions", "indices", "interpreters"):
        shutil.copy2(PACKAGE / f"{name}.py", package)
    git(tmp_path, "init", "--quiet")
    commit(tmp_path)
    runpy.run_path(str(package / "compiled.py"))["write"](["exactpt/indices.py"])
    return tmp_path


def git(folder, *arguments):
    own = ["-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *own, *arguments], cwd=folder, check=True, capture_output=True)


def commit(folder):
    git(folder, "add", "exactpt/indices.py")
    git(folder, "commit", "--quiet", "-m", "x")


def edit(folder):
    with (folder / "exactpt" / "indices.py").open("a") as file:
        file.write("# edited\n")


def run(folder, *arguments):
    """Run Python with the package of the folder; exit code and last line of the errors."""
    code = f"import sys; sys.path.insert(0, {str(folder)!r}); "
    command = [sys.executable, *arguments[:-1], code + arguments[-1]]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, (done.stderr.splitlines() or [""])[-1]


def test_sources_as_they_were_compiled_can_be_imported(copy):
    assert run(copy, "-c", "import exactpt") == (0, "")


def test_an_edited_module_is_refused(copy):
    edit(copy)

    assert run(copy, "-c", "import exactpt") == (1, f"ImportError: {LINE.format('edited')}")


def test_an_edit_that_keeps_the_size_is_refused(copy):
    source = copy / "exactpt" / "indices.py"
    source.write_text(source.read_text().swapcase())

    assert run(copy, "-c", "import exactpt")[0] == 1


def test_a_removed_module_is_refused(copy):
    (copy / "exactpt" / "indices.py").unlink()

    assert run(copy, "-c", "import exactpt") == (1, f"ImportError: {LINE.format('removed')}")


@pytest.mark.parametrize("start", [["exactpt"], ["-m", "exactpt"]])
def test_the_command_says_it_in_one_line(copy, start):
    edit(copy)
    if start == ["exactpt"]:  # as pip writes it
        (copy / "exactpt-script").mkdir()
        script = copy / "exactpt-script" / "exactpt"
        script.write_text("from exactpt.__main__ import main\nmain()\n")
        start = [str(script)]

    done = subprocess.run(
        [sys.executable, *start, "--version"],
        cwd=copy,
        env={"PYTHONPATH": str(copy)},
        capture_output=True,
        text=True,
        check=False,
    )

    said = f"exactpt: {LINE.format('edited')}\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", said)


def test_a_touched_module_is_not_refused(copy):
    os.utime(copy / "exactpt" / "indices.py", (1, 1))

    assert run(copy, "-c", "import exactpt") == (0, "")


def test_another_branch_is_refused_until_one_switches_back(copy):
    git(copy, "switch", "--quiet", "-c", "other")
    edit(copy)
    commit(copy)

    assert run(copy, "-c", "import exactpt")[0] == 1
    git(copy, "switch", "--quiet", "-")
    assert run(copy, "-c", "import exactpt") == (0, "")


def test_without_the_list_newer_sources_are_no_matter(copy):
    """As in an installed wheel."""
    (copy / "exactpt" / "compiled.txt").unlink()
    edit(copy)

    assert run(copy, "-c", "import exactpt; assert 'exactpt.compiled' not in sys.modules")[0] == 0
