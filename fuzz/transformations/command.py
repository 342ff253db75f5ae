"""The command ``python -m fuzz transformations``."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

import click

from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.changes.images import TRANSFORMATIONS
from fuzz.limits import limit
from fuzz.options import HELP, Options, conduct, options
from fuzz.transformations.answers import QUESTIONS
from fuzz.transformations.run import SCENES, Fault, check

__all__ = ["Transformations", "equalities", "transformations"]

SPINNING: Final = ("enclosed contact", "positions")
"""The questions about gears, mills and orbits: the others are about the pieces of a `Spin`."""

PATIENCE: Final = 300.0
"""Seconds in which all questions about a scene and its images are answered."""


@dataclass(frozen=True)
class Transformations(Check):
    """The check of answers about a scene and its images.

    Attributes:
        seed: seed of all scenes.
        draw: what scenes are drawn from, one of `SCENES`.
        enough: number of cases of a question and a transformation; None: no limit.
        keep: folder for scenes with a disagreement.
    """

    seed: int
    draw: str
    enough: int | None
    keep: Path
    name = "transformations"

    @property
    def about(self) -> object:
        """The seed, and what scenes are drawn from."""
        return [self.seed, self.draw]

    def wanted(self, counts: Counts) -> frozenset[tuple[str, str]]:
        """Return the questions and transformations without enough cases."""
        return frozenset(
            key
            for question in (SPINNING if self.draw == "spinning" else QUESTIONS)
            for key in ((question, name) for name in TRANSFORMATIONS)
            if self.enough is None or counts[key] < self.enough
        )

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Compare the answers about a scene."""
        number, counts, findings = item.numbers.start, Counts(), []
        tell(Step(PATIENCE, Finding("", "hangs", f"scene {number}")))

        def wanted(question: str, transformation: str) -> bool:
            return item.wanted is None or (question, transformation) in item.wanted

        within = partial(limit, PATIENCE, ends)
        for *key, fault in check(number, self.seed, wanted, within, SCENES[self.draw]):
            counts[tuple(key)] += 1
            if fault is not None:
                findings.append(self._finding(fault))
        return Result(counts, findings)

    def _finding(self, fault: Fault) -> Finding:
        name = f"{fault.number}-{fault.question}-{fault.transformation}".replace(" ", "-")

        def file(kind: str, scene: Scene) -> tuple[Path, bytes]:
            return self.keep / f"{name}-{kind}.json", json.dumps(to_json(scene)).encode()

        files = dict([file("old", fault.old), file("new", fault.new)])
        why = f"{fault.question}, {fault.transformation}, scene {fault.number}: {fault.why}"
        return Finding(fault.question, "disagreement", why, files)

    def table(self, counts: Counts) -> list[str]:
        """One line for each question: the cases of each transformation."""
        lines = [f"{'question':28}" + "".join(f"{name:>12}" for name in TRANSFORMATIONS)]
        for question in QUESTIONS:
            numbers = "".join(f"{counts[question, name]:>12,}" for name in TRANSFORMATIONS)
            lines.append(f"{question:28}{numbers}")
        total = sum(n for (_, name), n in counts.items() if name in TRANSFORMATIONS)
        return [*lines, f"{total:,} answers"]


@click.command("transformations", context_settings=HELP)
@click.option(
    "--enough",
    type=click.IntRange(min=1),
    help="Leave out questions and transformations with this number of cases.",
)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("transformations-found"),
    show_default=True,
    help="Folder for scenes with a disagreement.",
)
@click.option(
    "--draw",
    type=click.Choice(list(SCENES)),
    default="mixed",
    show_default=True,
    help="Tiny scenes of all kinds; two bodies that move alike; two that move straight; gears, "
    "mills and orbits; thin bodies that stand on a wall.",
)
@click.option("--table", "is_table", is_flag=True, help="Print what stays equal, and stop.")
@options(100)
def transformations(
    chosen: Options, enough: int | None, keep: Path, draw: str, *, is_table: bool
) -> None:
    """Compare answers about scenes and about their images under transformations.

    \b
    Examples:
      python -m fuzz transformations --scenes 1000
      python -m fuzz transformations --scenes 9000 --counts counts.json --enough 2000
      python -m fuzz transformations --scenes 30000 --counts counts.json --enough 2000 --draw alike
    """
    if is_table:
        click.echo("\n".join(equalities()))
        return
    again = f"--seed {chosen.seed} --draw {draw}"
    conduct(Transformations(chosen.seed, draw, enough, keep), chosen, again=again)


def equalities() -> list[str]:
    """Return the table of what stays equal, in Markdown."""
    lines = ["| question | calls | what stays equal |", "| --- | --- | --- |"]
    for name, question in QUESTIONS.items():
        calls = ", ".join(f"`{call}`" for call in question.calls)
        lines.append(f"| {name} | {calls} | {question.equal} |")
    return [*lines, "", "Transformations: " + ", ".join(TRANSFORMATIONS) + "."]
