"""The command ``python -m fuzz small-scope``."""

from __future__ import annotations

import datetime
import json
import sys
from pathlib import Path

import click

from exactpt.errors import InputError
from exactpt.scene.written import to_json
from fuzz import corpus
from fuzz.cases import Case
from fuzz.small_scope.run import Progress, failure_in, run, start_of
from fuzz.small_scope.scope import planned, sizes
from fuzz.small_scope.tally import Fault

__all__ = ["small_scope"]

FAILED, INTERRUPTED = 1, 130


@click.command("small-scope", context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--count", type=click.IntRange(min=1), help="Number of scenes; by default a round.")
@click.option("--seconds", type=click.FloatRange(min=0), help="Time limit.")
@click.option("--start", type=click.IntRange(min=0), help="The number of the first scene.")
@click.option("--today", is_flag=True, help="Start with the scene of this day.")
@click.option(
    "--state",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Continue from this file if it exists, and update it.",
)
@click.option("--proofs", is_flag=True, help="Check the proof by a tiling, and nothing else.")
@click.option("--jobs", type=click.IntRange(min=1), default=1, help="Number of processes.")
@click.option("--shrink", default=20.0, show_default=True, help="Seconds for shrinking a fault.")
@click.option(
    "--show", type=click.IntRange(min=0), help="Print the scene with this number and stop."
)
def small_scope(
    count: int | None,
    seconds: float | None,
    start: int | None,
    today: bool,  # noqa: FBT001
    state: Path | None,
    proofs: bool,  # noqa: FBT001
    jobs: int,
    shrink: float,
    show: int | None,
) -> None:
    """Compare all methods on all small scenes, up to symmetry, and on a sample of larger ones.

    \b
    Examples:
      python -m fuzz small-scope --state scope.json --jobs 2
      python -m fuzz small-scope --today --seconds 60
      python -m fuzz small-scope --proofs --state proofs.json --count 100000
      python -m fuzz small-scope --show 1510 > scene.json
    """
    if show is not None:
        click.echo(json.dumps(to_json(planned(show).scene), indent=1))
        return
    try:
        progress = _progress(start, today=today, state=state, proofs=proofs)
    except InputError as error:
        raise click.UsageError(str(error)) from None
    click.echo(f"scenes of a round: {', '.join(f'{k} {v:,}' for k, v in sizes().items())}")
    click.echo(f"from scene {progress.next} on")
    report = _Reporter(progress, state, shrink)
    if count is None and seconds is None:
        count = max(0, progress.start + sum(sizes().values()) - progress.next)
    run(progress, report.new_faults, most=count, seconds=seconds, jobs=jobs)
    click.echo("\n".join(progress.tally.table()))
    if not progress.finished:
        click.echo(f"interrupted; to go on: --start {progress.next}", err=True)
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if progress.tally.disagreements else 0)


def _progress(start: int | None, *, today: bool, state: Path | None, proofs: bool) -> Progress:
    """Where to begin, or to continue."""
    if start is not None and today:
        raise InputError("either --start or --today")
    if state is not None and state.exists():
        if start is not None or today:
            raise InputError(f"--start and --today are for a new run, but there is {state}")
        progress = Progress.load(state)
        if progress.proofs != proofs:
            raise InputError(
                f"{state}: of a run {'with' if progress.proofs else 'without'} --proofs"
            )
        return progress
    first = start_of(datetime.datetime.now(datetime.UTC).date()) if today else start or 0
    return Progress(first, first, proofs=proofs)


class _Reporter:
    """Prints new faults and the progress of the run; saves the first scene of each fault."""

    def __init__(self, progress: Progress, state: Path | None, shrink: float) -> None:
        self._progress = progress
        self._state = state
        self._shrink = shrink
        self._met = {(f.method, f.what) for f in progress.tally.faults}

    def new_faults(self, faults: list[tuple[Fault, int]]) -> None:
        """Report faults that have not been reported before."""
        if self._state is not None:
            self._progress.save(self._state)
        for fault, number in faults:
            click.echo(f"scene {number}: {' - '.join(fault)}")
            if (fault.method, fault.what) not in self._met:
                self._met.add((fault.method, fault.what))
                self._save(fault, number)

    def _save(self, fault: Fault, number: int) -> None:
        failure = failure_in(number, fault, self._shrink)
        path = corpus.save(failure, Case(number, "small scope", number))
        click.echo(f"  {failure.why}\n  saved: {path}")
