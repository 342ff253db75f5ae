"""CONTRIBUTING.md: the diffs of its three contributions apply, and its commands print what it says.

Each section is followed in a copy of the checkout, block by block: a ``diff`` is applied, and of a
``console`` each command runs, and prints something that has each line below it. (Of `make accept`
only the digests are written: pictures take minutes, and need programs.) Where a contribution has
been made, its test is skipped.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys

import pytest
from checkout import ROOT, copy_to

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
CONTRIBUTIONS = ["A public method", "A family of scenes", "A filter with its adversary"]
RENEW = """\
The diff of "{title}" in CONTRIBUTING.md no longer applies: its surroundings have changed.
Renew it: save the block as block.diff, run `git apply --reject block.diff` in a clean checkout,
carry out by hand what is in the .rej files, and replace the block by the output of
`git add --intent-to-add . && git diff -U1` without its `index` lines. Then undo the changes.

{errors}"""

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="applies diffs by git")


def blocks(title):
    """Return the fenced blocks of a section, in order: the language and the text of each."""
    section = PAGE.partition(f"\n## {title}\n")[2].partition("\n## ")[0]
    return re.findall(r"^```(\w+)\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)


def created(title):
    """Return the paths of the files that a contribution creates."""
    paths = r"^--- /dev/null\n\+\+\+ b/(.*)$"
    return [path for _, text in blocks(title) for path in re.findall(paths, text, re.MULTILINE)]


def steps(console):
    """Return the commands of a console, each with the lines that it prints."""
    command, *more = re.split(r"^\$ ", console, flags=re.MULTILINE)
    assert command == "", "a console begins with a command"
    found = [(first, lines) for first, *lines in map(str.splitlines, more)]
    assert all(lines for _, lines in found), "below each command is a line that it prints"
    return found


def repository(folder):
    """Make a repository of the files of this checkout.

    Returns:
        A function that runs a command there, and returns the exit code and all that it prints.
    """
    copy_to(folder, and_new=True)
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    environment = {**kept, "PYTHONPATH": str(folder), "GIT_CONFIG_GLOBAL": os.devnull}

    def run(*command, given=None):
        done = subprocess.run(
            command, cwd=folder, env=environment, input=given, text=True, encoding="utf-8",
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
        )  # fmt: skip
        return done.returncode, done.stdout

    run("git", "init", "--quiet")
    run("git", "add", "--all")
    return run


def write_digests(run):
    code, errors = run(sys.executable, "tests/system/testing/test_digests.py")
    assert code == 0, errors


def printed(run, command):
    """Return what a command of the page prints, and whether it ends with an error."""
    if command == "make accept":
        write_digests(run)
        code, text = run("git", "diff", "--stat", "--", "tests/data")
    else:
        python, *arguments = shlex.split(command)
        assert python == ".venv/bin/python", command
        code, text = run(sys.executable, *arguments)
    return text, code != 0


@needs_git
@pytest.mark.parametrize("title", CONTRIBUTIONS)
def test_contribution_followed_step_by_step_prints_what_the_page_says(title, tmp_path):
    made = [path for path in created(title) if (ROOT / path).exists()]
    if made:
        pytest.skip(f"the contribution has been made: {', '.join(made)}")
    run = repository(tmp_path / "checkout")
    if title == "A family of scenes":  # of another new family, nobody may have written the digests
        write_digests(run)
        run("git", "add", "--all")
    for language, text in blocks(title):
        if language == "diff":
            code, errors = run("git", "apply", "-", given=text)
            assert code == 0, RENEW.format(title=title, errors=errors)
        for command, lines in steps(text) if language == "console" else ():
            shown, has_failed = printed(run, command)
            assert [line for line in lines if line not in shown] == [], f"{command}\n{shown}"
            assert has_failed == bool(re.search("failed|error", lines[-1])), f"{command}\n{shown}"


@needs_git
@pytest.mark.slow
@pytest.mark.parametrize("tool", ["ruff format --check", "ruff check", "mypy"])
def test_contributions_that_are_applied_pass_lint(tool, tmp_path):
    name, *arguments = tool.split()
    pytest.importorskip(name)
    if any((ROOT / path).exists() for title in CONTRIBUTIONS for path in created(title)):
        pytest.skip("a contribution has been made")
    run = repository(tmp_path / "checkout")
    diffs = [text for title in CONTRIBUTIONS for kind, text in blocks(title) if kind == "diff"]
    assert [run("git", "apply", "-", given=diff) for diff in diffs] == [(0, "")] * len(diffs)

    code, shown = run(sys.executable, "-m", name, *arguments)

    assert code == 0, shown


@pytest.mark.parametrize("title", CONTRIBUTIONS)
def test_contribution_has_a_test_before_the_code(title):
    """The first diff is a test, which fails; the last run of tests passes."""
    changed = [
        re.findall(r"^\+\+\+ b/(.*)$", t, re.MULTILINE) for k, t in blocks(title) if k == "diff"
    ]
    runs = [step for k, text in blocks(title) if k == "console" for step in steps(text)]

    assert [path.split("/")[0] for path in changed[0]] == ["tests"]
    assert {path.split("/")[0] for paths in changed[1:] for path in paths} == {"exactpt"}
    assert re.search("failed|error", runs[0][1][-1])
    tested = [lines[-1] for command, lines in runs if " pytest " in command]
    assert tested[-1].endswith("passed")
