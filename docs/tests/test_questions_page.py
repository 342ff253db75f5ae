"""docs/questions.md: each test, command and law that it names is there."""

import re
import shlex
from pathlib import Path

import pytest

from benchmarks.catalogue import BENCHMARKS
from fuzz.__main__ import COMMANDS
from fuzz.__main__ import fuzz as campaign
from fuzz.laws.table import LAWS
from fuzz.transformations.command import equalities

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "questions.md").read_text(encoding="utf-8")
QUESTIONS = PAGE.partition("\n## Outside the domain\n")[0]
ROWS = [line.strip("| ").split(" | ") for line in QUESTIONS.splitlines() if line.startswith("| `")]
QUOTED = sorted(
    {word for row in ROWS for cell in row[1:] for word in re.findall("`([^`]+)`", cell)}
)


@pytest.mark.parametrize("test", [word for word in QUOTED if "::" in word])
def test_a_named_test_is_there(test):
    file, name = test.split("::")

    assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8")


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
        assert known or any(law.startswith(word) for law in LAWS), word


def test_named_laws_are_there():
    named = [word for word in QUOTED if re.fullmatch("[a-z][a-z ]*/[a-z ]+", word)]

    assert len(named) > 8
    assert [law for law in named if law not in LAWS] == []


def test_the_table_of_what_stays_equal_is_that_of_the_code():
    assert "\n".join(equalities()) in PAGE
