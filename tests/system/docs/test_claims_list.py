"""docs/claims.md: each claim has its anchor on its page, and each test and command exists."""

import re
import shlex
from pathlib import Path

import click
from folding import every

from benchmarks.__main__ import bench
from benchmarks.catalogue import BENCHMARKS
from exactpt.cli import all_commands
from fuzz import __main__ as fuzzer

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")


PINNED = (ROOT / "tests" / "data" / "claims.txt").read_text(encoding="utf-8").split()
ROW = r"^\| \[.*\]\(([^)#]+)#(c-[a-z0-9-]+)\) \| (.*) \|$"
CLAIMS = re.findall(ROW, PAGE, re.MULTILINE)
"""For each claim: its page, its anchor, and what shows it."""
SHOWN = sorted({word for *_, shown in CLAIMS for word in re.findall("`([^`]+)`", shown)})
TESTS = [word for word in SHOWN if word.startswith("tests/")]
DISPATCHING = {"-m"}
COMMANDS = [word for word in SHOWN if not word.startswith("tests/")]


def anchors_of(page):
    return re.findall(r'<a id="(c-[^"]*)"></a>', page.read_text(encoding="utf-8"))


def test_the_claims_of_the_list_are_the_anchors_of_the_pages():
    listed = sorted(((ROOT / "docs" / page).resolve(), anchor) for page, anchor, _ in CLAIMS)
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    found = sorted((page.resolve(), anchor) for page in pages for anchor in anchors_of(page))

    assert listed == found
    assert len({anchor for _, anchor, _ in CLAIMS}) == len(CLAIMS)
    assert len(CLAIMS) == len(re.findall(r"^\| \[", PAGE, re.MULTILINE))


def test_no_claim_was_dropped():
    assert sorted(set(PINNED) - {anchor for _, anchor, _ in CLAIMS}) == []
    assert len(PINNED) > 50


def test_every_claim_is_shown_by_something():
    assert all("`" in shown or "](" in shown for *_, shown in CLAIMS)


@every("test", TESTS)
def test_a_test_is_there(test):
    file, name = test.split("::")

    assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8")


def command_of(words):
    """The click command that some words call."""
    if words[0] == "exactpt":
        return all_commands()[words[1]]
    if words[1:3] == ["-m", "benchmarks"]:
        return bench
    return fuzzer.COMMANDS.get(words[3], fuzzer.fuzz)


@every("command", COMMANDS)
def test_a_command_is_there(command, pytestconfig):
    words = shlex.split(command)
    if words[0] in {"pytest", "python"} and words[1:3] not in (
        ["-m", "benchmarks"],
        ["-m", "fuzz"],
    ):
        files = [word for word in words if "/" in word]
        assert all((ROOT / file).exists() for file in files)
        for option in {"--exact-only"} & set(words):
            assert pytestconfig.getoption(option) is not None
        assert files or "--exact-only" in words
        if files and files[0].startswith("examples/"):
            source = (ROOT / files[0]).read_text(encoding="utf-8")
            assert all(f'"{word}"' in source for word in words if word.startswith("--"))
        return
    options = {
        name
        for parameter in command_of(words).params
        if isinstance(parameter, click.Option)
        for name in parameter.opts
    }

    assert {word for word in words if word.startswith("-")} - DISPATCHING <= options
    if words[1:3] == ["-m", "benchmarks"]:
        assert words[3] in BENCHMARKS
