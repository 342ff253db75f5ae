"""docs/questions.md: each test, file and command that it names is there."""

import re
import shlex
from pathlib import Path

import pytest

from benchmarks.catalogue import BENCHMARKS
from fuzz.__main__ import COMMANDS
from fuzz.__main__ import fuzz as campaign
from fuzz.laws.table import LAWS
from fuzz.transformations.command import equalities

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "questions.md").read_text(encoding="utf-8")
QUESTIONS = PAGE.partition("\n## Outside the domain\n")[0]
ROWS = [line.strip("| ").split(" | ") for line in QUESTIONS.splitlines() if line.startswith("| `")]
QUOTED = sorted(
    {word for row in ROWS for cell in row[1:] for word in re.findall("`([^`]+)`", cell)}
)


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
        known = known or (words[3] == "run" and any(law.startswith(word) for law in LAWS))
        assert known, word


def test_the_table_of_what_stays_equal_is_that_of_the_code():
    assert "\n".join(equalities()) in PAGE
