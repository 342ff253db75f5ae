"""Reproducers: an adapter, its part for two bodies, with its worst question."""

from __future__ import annotations

import json
import pprint
import textwrap
from pathlib import Path
from typing import Final

from benchmarks.engines.asking import Finding, Result
from benchmarks.engines.domain import as_asked
from exactpt.testing.comparing import shown_time

__all__ = ["description", "reproducer", "reproducer_name"]

_PYTHON: Final = """

QUESTION = {question}

if __name__ == "__main__":
    try:
        found = answer(QUESTION, {way!r})
    except Exception as error:
        found = f"{{type(error).__name__}}: {{error}}"
    print("answer:", found)
    print("truth: ", {truth!r})
"""

_JAVASCRIPT: Final = """
const QUESTION = {question};

let found;
try {{
  found = answer(await load(), QUESTION, {way});
}} catch (error) {{
  found = String(error);
}}
console.log("answer:", found);
console.log("truth: ", {truth});
process.exit(0);
"""


def reproducer_name(result: Result, worst: Finding, adapter: Path) -> str:
    """The name of the file of a result's worst finding."""
    words = [adapter.stem.removeprefix("with_"), *result.way.split(), worst.verdict]
    return "_".join(words) + adapter.suffix


def reproducer(result: Result, worst: Finding, adapter: Path) -> str:
    """The text of a program that asks an engine its worst question, and prints the truth."""
    promises = "".join(f" «{words}» ({where})." for words, where in result.promises)
    engine = f"{result.name} ({result.about['package']} {result.version})"
    head = [
        f"{engine}, {worst.verdict}: {description(worst)}.",
        f"It promises:{promises}",
        f"Written by `python -m benchmarks engines`; {result.about['install']}.",
    ]
    mark, tail = ("# ", _PYTHON) if adapter.suffix == ".py" else ("// ", _JAVASCRIPT)
    lines = [line for text in head for line in textwrap.wrap(text, 96 - len(mark))]
    asked = as_asked(worst.question)
    truth = "no contact" if worst.truth.time is None else shown_time(worst.truth.time)
    if mark == "# ":
        end = tail.format(
            question=pprint.pformat(asked, width=80, sort_dicts=False), way=result.way, truth=truth
        )
    else:
        end = tail.format(
            question=json.dumps(asked), way=json.dumps(result.way), truth=json.dumps(truth)
        )
    source = adapter.read_text(encoding="utf-8").partition("# Whole scenes\n")[0]
    return "\n".join(mark + line for line in lines) + "\n\n" + source.rstrip() + "\n" + end


def description(worst: Finding) -> str:
    """An answer and the truth in words."""
    said = "no contact" if worst.answer is None else str(worst.answer)
    time = worst.truth.time
    return f"{said}; the truth is {'no contact' if time is None else f't = {shown_time(time)}'}"
