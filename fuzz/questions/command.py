"""The command ``python -m fuzz questions``, and its work on each case."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import click

from exactpt.workers.work import HANGS
from fuzz.campaign import FOUND, Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.limits import TooSlow, limit, signed
from fuzz.options import HELP, Options, conduct, options, require_cgal
from fuzz.questions.checks import QUESTIONS, checked

__all__ = ["KEPT", "Questions", "ask", "questions"]

KEPT: Final = Path("questions-found")
"""Folder for questions with a difference."""

PATIENCE: Final = 60.0
"""Seconds after which a question counts as hanging."""


def ask(
    question: str, seed: int, number: int, tell: Tell, ends: float | None, keep: Path
) -> Result:
    """Compare the answers of a case with their definitions; an exception is a finding.

    Raises:
        TimeIsUp: at the end of the campaign.
    """
    again = f"--question {question} --seed {seed} --start {number} --cases 1"
    wrong = Finding(question, HANGS, f"{question}, case {number}")
    tell(Step(PATIENCE, wrong))
    counts = Counts()
    try:
        with limit(PATIENCE, ends):
            found = checked(question, seed, number)
        counts.update({(question, found.kind, "cases"): 1, (question, "", "signs"): found.signs})
        if found.fault is None:
            return Result(counts)
        path = keep / f"{question}-{seed}-{number}.json"
        content = json.dumps(found.to_json()).encode()
        signature, why, files = "difference", found.fault, {path: content}
    except TooSlow:
        signature, why, files = HANGS, f"{HANGS}: no answer within {PATIENCE:.0f} s", {}
    except Exception as error:  # any exception is a finding
        (signature, why), files = signed(error), {}
    why = f"{wrong.why}: {why}\n  again: python -m fuzz questions {again}"
    return Result(counts, [Finding(question, signature, why, files)])


@dataclass(frozen=True)
class Questions(Check):
    """The check of questions, which are taken in turn.

    Attributes:
        asked: their names.
        seed: seed of all cases.
        keep: folder for cases with a difference.
    """

    asked: Sequence[str]
    seed: int
    keep: Path
    name = "questions"

    @property
    def about(self) -> object:
        """The questions and the seed."""
        return [list(self.asked), self.seed]

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Check a case."""
        turn, k = divmod(item.numbers.start, len(self.asked))
        return ask(self.asked[k], self.seed, turn, tell, ends, self.keep)

    def table(self, counts: Counts) -> list[str]:
        """One line for each kind of cases, and one for each question."""
        lines = []
        for question in self.asked:
            kinds = {key[1]: n for key, n in counts.items() if key[::2] == (question, "cases")}
            lines += [f"{n:8}  {kind}" for kind, n in sorted(kinds.items(), key=lambda at: -at[1])]
            signs = counts[question, "", "signs"]
            by_cgal = f", {signs} decisions of CGAL" if signs else ""
            differences = counts[question, FOUND]
            lines.append(
                f"{question}, seed {self.seed}: {sum(kinds.values())} cases{by_cgal}, "
                f"{differences} differences"
            )
        return lines


@click.command("questions", context_settings=HELP)
@click.option(
    "--question",
    "asked",
    multiple=True,
    type=click.Choice(list(QUESTIONS)),
    help="One of them (repeatable); by default all.",
)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=KEPT,
    show_default=True,
    help="Folder for scenes with a difference.",
)
@options(1000)
def questions(chosen: Options, asked: tuple[str, ...], keep: Path) -> None:
    """Compare answers with their definitions, by questions that draw their own cases.

    Several questions are taken in turn. Most others are laws: python -m fuzz run.

    \b
    Examples:
      python -m fuzz questions --question space --cases 20000
      python -m fuzz questions --question spin --seed 7 --start 500
    """
    names = asked or tuple(QUESTIONS)
    if "cgal" in names:
        require_cgal("--question")
    conduct(Questions(names, chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")
