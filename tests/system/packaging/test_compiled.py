"""An edited module of a compiled checkout is not hidden; `exactpt.compiled` compares."""

import os
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[3] / "exactpt"
LINE = "exactpt/indices.py was {} after `make compiled`: run make compiled or make plain"


@pytest.fixture
def copy(tmp_path):
    """A checkout of a few modules, in git, with the list that setup.py writes."""
    package = tmp_path / "exactpt"
    package.mkdir()
    for name in ("__init__", "__main__", "compiled", "extensions", "indices"):
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
