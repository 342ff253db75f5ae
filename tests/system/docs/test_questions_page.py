"""docs/questions.md: every public name has its place, each test, file and command is there."""

import inspect
import re
import shlex
from pathlib import Path

import pytest

import exactpt
from benchmarks.catalogue import BENCHMARKS
from exactpt import arrays
from fuzz.__main__ import COMMANDS
from fuzz.__main__ import fuzz as campaign
from fuzz.transformations.command import equalities

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "questions.md").read_text(encoding="utf-8")
QUESTIONS, REST = PAGE.split("\n## Outside the domain\n")
NONE = REST.split("\n## ")[0]
ROWS = [line.strip("| ").split(" | ") for line in QUESTIONS.splitlines() if line.startswith("| `")]
QUOTED = sorted(
    {word for row in ROWS for cell in row[1:] for word in re.findall("`([^`]+)`", cell)}
)


def public_names():
    """Return the public functions, and the public methods and properties of the classes."""
    for name in exactpt.__all__:
        thing = getattr(exactpt, name)
        if not isinstance(thing, type):
            yield name
            continue
        for member, value in vars(thing).items():
            if member.startswith("_"):
                continue
            if inspect.isfunction(value) or isinstance(
                value, (property, classmethod, staticmethod)
            ):
                yield f"{name}.{member}"
    for name in arrays.__all__:
        if inspect.isfunction(getattr(arrays, name)):
            yield f"arrays.{name}"


def names_in(text):
    return {name.removesuffix("()") for name in re.findall(r"`([\w.]+(?:\(\))?)`", text)}


def test_every_public_name_is_a_question_or_is_none():
    asked = set().union(*(names_in(row[0]) for row in ROWS))
    asked -= {"after_start", "between", "since", "ignoring"}
    none = names_in(NONE)
    public = set(public_names())

    assert asked & none == set()
    assert asked | none == public


def test_every_question_has_a_reference_and_a_test():
    assert len(ROWS) > 20
    for question, reference, *_, in_ci, slow in ROWS:
        assert reference, question
        assert "::test_" in in_ci, question
        assert "`" in slow or slow.startswith("none: ") or "a family" in slow or "test" in slow


@pytest.mark.parametrize("test", [word for word in QUOTED if word.startswith("tests/")])
def test_a_named_test_is_there(test):
    file, name = test.split("::")

    assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8")


def test_named_files_are_there():
    named = re.findall(r"`((?:fuzz|exactpt|tests)/[\w/]+\.py)`", PAGE)

    assert len(named) > 8
    assert [name for name in named if not (ROOT / name).exists()] == []


@pytest.mark.parametrize(
    "text", [word for word in QUOTED if word.startswith(("python ", "exactpt "))]
)
def test_a_named_command_is_there(text):
    words = shlex.split(text)
    if words[:3] == ["python", "-m", "benchmarks"]:
        assert words[3] in BENCHMARKS
        return
    assert words[:3] == ["python", "-m", "fuzz"]
    command = COMMANDS.get(words[3], campaign)
    choices = [c for p in command.params for c in getattr(p.type, "choices", ())]
    options = {name for p in command.params for name in p.opts}
    for word in words[3:]:
        known = word in COMMANDS or word in options or word in choices or word.isdigit()
        assert known, word


def test_the_table_of_what_stays_equal_is_that_of_the_code():
    assert "\n".join(equalities()) in PAGE
