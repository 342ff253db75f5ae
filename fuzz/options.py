"""The common part of all commands of campaigns: options, output and exit codes."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import Any, Final, NoReturn

import click

from exactpt.cgal import find_program
from exactpt.errors import InputError
from exactpt.files import write_atomically
from fuzz.campaign import INTERRUPTS, Check, Finding, Progress, campaign

__all__ = ["FAILED", "HELP", "INTERRUPTED", "Options", "conduct", "options", "require_cgal"]

FAILED: Final = 1
INTERRUPTED: Final = 130
HELP: Final = {"help_option_names": ["-h", "--help"]}


@dataclass(frozen=True, slots=True)
class Options:
    """The options of a campaign, as `campaign` has them.

    Attributes:
        start: number of the first case; None if it is not given.
        seed: seed of all cases.
    """

    count: int | None
    seconds: float | None
    start: int | None
    seed: int
    jobs: int
    scheduler: str | None
    state: Path | None


def options(cases: int | None, *, seed: int = 0) -> Callable[[Callable[..., None]], Any]:
    """Return a decorator that adds the options of campaigns, with the default number of cases."""

    def decorate(function: Callable[..., None]) -> Any:  # noqa: ANN401 - with click's attributes
        @click.option(
            "--cases",
            "--count",
            "--scenes",
            "count",
            type=click.IntRange(min=1),
            default=cases,
            show_default=cases is not None,
            help="Number of cases.",
        )
        @click.option("--seconds", type=click.FloatRange(min=0), help="Time limit.")
        @click.option("--minutes", type=click.FloatRange(min=0), help="Time limit.")
        @click.option("--seed", type=int, default=seed, show_default=True)
        @click.option("--start", type=click.IntRange(min=0), help="Number of the first case.")
        @click.option(
            "--jobs",
            type=click.IntRange(min=0),
            default=1,
            show_default=True,
            help="Number of worker processes, 0 for none.",
        )
        @click.option("--scheduler", help="Address of a Dask scheduler, in place of --jobs.")
        @click.option(
            "--state",
            "--counts",
            "state",
            type=click.Path(dir_okay=False, path_type=Path),
            help="Go on from this file if it exists, and update it.",
        )
        @wraps(function)
        def command(
            *, count: int | None, seconds: float | None, minutes: float | None, seed: int,
            start: int | None, jobs: int, scheduler: str | None, state: Path | None, **rest: object,
        ) -> None:  # fmt: skip
            seconds = seconds if minutes is None else 60 * minutes
            chosen = Options(count, seconds, start, seed, jobs, scheduler, state)
            function(chosen, **rest)

        return command

    return decorate


def conduct(
    check: Check, chosen: Options, *, first: int = 0, whole: int | None = None, again: str = ""
) -> NoReturn:
    """Run a campaign, or go on with it; print findings and a table, and exit.

    Exit codes: 0; `FAILED` after a finding; `INTERRUPTED`.

    Args:
        check: the work on each case.
        chosen: the options of the command line.
        first: number of the first case, if neither an option nor a state has it.
        whole: number of cases if no limit is given.
        again: options with which an interrupted campaign goes on, besides its first case.
    """
    try:
        progress = _progress(check, chosen, first)
    except InputError as error:
        raise click.UsageError(str(error)) from None
    count = whole if chosen.count is None and chosen.seconds is None else chosen.count
    began, before = clock.monotonic(), progress.next
    click.echo(f"from case {before} on")
    campaign(check, progress, _report, count=count, seconds=chosen.seconds, jobs=chosen.jobs,
             scheduler=chosen.scheduler, state=chosen.state)  # fmt: skip
    INTERRUPTS.wait = True  # whoever is impatient gets the table too
    seconds, cases = clock.monotonic() - began, progress.next - before
    click.echo("\n".join(check.table(progress.counts)))
    rate = cases / seconds if seconds else 0.0
    click.echo(
        f"{cases} cases in {seconds:.0f} s, {rate:.1f} a second: {progress.found} differences"
    )
    if not progress.finished:
        rest = f"--start {progress.next}" if chosen.state is None else f"--state {chosen.state}"
        click.echo(f"interrupted; to go on: {again} {rest}".replace("  ", " "), err=True)
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if progress.found else 0)


def _progress(check: Check, chosen: Options, first: int) -> Progress:
    """Where to begin, or to go on."""
    if chosen.state is not None and chosen.state.exists():
        if chosen.start is not None or first:
            raise InputError(f"the first case is for a new campaign, but there is {chosen.state}")
        return Progress.load(chosen.state, check)
    start = first if chosen.start is None else chosen.start
    return Progress(start, start)


def _report(finding: Finding) -> None:
    """Print a finding, and write its files."""
    click.echo(finding.why)
    for path, content in finding.files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, content)
        click.echo(f"  saved: {path}")


def require_cgal(otherwise: str) -> None:
    """Refuse a command that needs ``cgal_check`` if there is none; without it: use an option.

    Raises:
        UsageError: if there is none.
    """
    try:
        find_program()
    except InputError as error:
        raise click.UsageError(f"{error}; or choose among the others with {otherwise}") from None
