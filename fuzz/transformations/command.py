"""The command ``python -m fuzz transformations``."""

from __future__ import annotations

import sys
import time as clock
from collections import Counter
from pathlib import Path
from typing import Final

import click

from fuzz.transformations.answers import QUESTIONS
from fuzz.transformations.images import TRANSFORMATIONS
from fuzz.transformations.run import SCENES, Fault, check, load, save, table

__all__ = ["transformations"]

SPINNING: Final = ("enclosed contact", "positions")
"""The questions about gears, mills and orbits: the others are about the pieces of a `Spin`."""

EVERY: Final = 20
"""Number of scenes between two writings of the counts."""


@click.command("transformations", context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--scenes", type=click.IntRange(min=1), default=100, show_default=True)
@click.option("--seconds", type=click.FloatRange(min=0), help="Time limit.")
@click.option("--seed", type=int, default=0, show_default=True)
@click.option("--step", type=click.IntRange(min=1), default=1, help="Take every STEP-th scene.")
@click.option("--first", type=click.IntRange(min=0), default=0, help="Number of the first scene.")
@click.option(
    "--counts",
    type=click.Path(dir_okay=False, path_type=Path),
    help="File of the counts; a run that was stopped continues from it.",
)
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
def transformations(
    scenes: int, seconds: float | None, seed: int, step: int, first: int, counts: Path | None,
    enough: int | None, keep: Path, draw: str, *, is_table: bool,
) -> None:  # fmt: skip
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
    done, tally = load(counts) if counts else (0, Counter())
    deadline = None if seconds is None else clock.monotonic() + seconds
    faults = 0

    def wanted(question: str, transformation: str) -> bool:
        few = enough is None or tally[question, transformation] < enough
        return few and (draw != "spinning" or question in SPINNING)

    for k in range(done, scenes):
        if deadline is not None and clock.monotonic() > deadline:
            break
        for question, transformation, fault in check(
            first + k * step, seed, wanted, draw=SCENES[draw]
        ):
            tally[question, transformation] += 1
            if fault is not None:
                faults += 1
                _report(fault, keep)
        if counts and (k + 1) % EVERY == 0:
            save(counts, k + 1, tally)
        done = k + 1
    if counts:
        save(counts, done, tally)
    click.echo("\n".join(table(tally)))
    click.echo(f"{done} scenes, {faults} disagreements")
    sys.exit(1 if faults else 0)


def _report(fault: Fault, keep: Path) -> None:
    keep.mkdir(parents=True, exist_ok=True)
    name = f"{fault.number}-{fault.question}-{fault.transformation}".replace(" ", "-")
    fault.old.save(keep / f"{name}-old.json")
    fault.new.save(keep / f"{name}-new.json")
    click.echo(f"{fault.question}, {fault.transformation}, scene {fault.number}: {fault.why}")


def equalities() -> list[str]:
    """Return the table of what stays equal, in Markdown."""
    lines = ["| question | calls | what stays equal |", "| --- | --- | --- |"]
    for name, question in QUESTIONS.items():
        calls = ", ".join(f"`{call}`" for call in question.calls)
        lines.append(f"| {name} | {calls} | {question.equal} |")
    return [*lines, "", "Transformations: " + ", ".join(TRANSFORMATIONS) + "."]
