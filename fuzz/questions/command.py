"""The command ``python -m fuzz questions``."""

from __future__ import annotations

import json
import sys
import time as clock
from collections import Counter
from pathlib import Path
from typing import Final

import click

from exactpt.cgal import find_program
from exactpt.errors import InputError
from fuzz.questions.checks import QUESTIONS, checked

__all__ = ["questions"]

FAILED, INTERRUPTED = 1, 130

EVERY: Final = 1000
"""Number of cases between two lines of progress."""


@click.command("questions", context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--question",
    "asked",
    multiple=True,
    type=click.Choice(list(QUESTIONS)),
    help="One of them (repeatable); by default all.",
)
@click.option("--cases", type=click.IntRange(min=1), default=1000, show_default=True)
@click.option("--seed", type=int, default=0, show_default=True)
@click.option("--start", type=click.IntRange(min=0), default=0, help="Number of the first case.")
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("questions-found"),
    show_default=True,
    help="Folder for scenes with a difference.",
)
def questions(asked: tuple[str, ...], cases: int, seed: int, start: int, keep: Path) -> None:
    """Compare answers about distance, intervals and new contacts with their definitions.

    \b
    Examples:
      python -m fuzz questions --question distance --cases 20000
      python -m fuzz questions --question after-start --seed 7 --start 5000
    """
    differences = 0
    for question in asked or QUESTIONS:
        if question == "cgal":
            _require_cgal()
        differences += _run(question, cases, seed, start, keep)
    sys.exit(FAILED if differences else 0)


def _run(question: str, cases: int, seed: int, start: int, keep: Path) -> int:
    """Check the cases of a question, print a table of them; the number of differences."""
    kinds: Counter[str] = Counter()
    differences = signs = done = 0
    begin = clock.monotonic()
    try:
        for number in range(start, start + cases):
            case = checked(question, seed, number)
            done, signs = done + 1, signs + case.signs
            kinds[case.kind] += 1
            if case.fault is not None:
                differences += 1
                keep.mkdir(parents=True, exist_ok=True)
                path = keep / f"{question}-{seed}-{number}.json"
                path.write_text(json.dumps(case.to_json()), encoding="utf-8")
                click.echo(f"{question}, case {number}: {case.fault}\n  {path}")
            if done % EVERY == 0:
                click.echo(f"{question}: {done} cases, {differences} differences", err=True)
    except KeyboardInterrupt:
        click.echo(f"interrupted; to go on: --seed {seed} --start {start + done}", err=True)
        sys.exit(INTERRUPTED)
    finally:
        for kind, count in sorted(kinds.items(), key=lambda item: -item[1]):
            click.echo(f"{count:8}  {kind}")
        by_cgal = f", {signs} decisions of CGAL" if signs else ""
        seconds = clock.monotonic() - begin
        click.echo(
            f"{question}, seed {seed}, from case {start} on: {done} cases in {seconds:.0f} s"
            f"{by_cgal}, {differences} differences"
        )
    return differences


def _require_cgal() -> None:
    try:
        find_program()
    except InputError as error:
        raise click.UsageError(f"{error}; or choose among the others with --question") from None
