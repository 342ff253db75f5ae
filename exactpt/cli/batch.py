"""batch: one question about many scenes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from exactpt.brief import counted
from exactpt.cli.options import (
    AFTER_START,
    BETWEEN,
    IGNORE,
    QUIET,
    RATIONAL,
    TILING,
    bounded,
    max_bytes,
    max_memory,
    names_in,
    output,
    two_names,
    typed,
)
from exactpt.cli.progress import estimating
from exactpt.cli.terminal import print_error
from exactpt.errors import InputError
from exactpt.files import MAX_BYTES
from exactpt.kernel.numbers import QQ, show
from exactpt.workers.work import MAX_JOBS


@click.command()
@click.argument("scenes", type=click.Path(path_type=Path), metavar="SCENES")
@output("The file of results, which must not exist.", required=True)
@click.option("--jobs", type=click.IntRange(1, MAX_JOBS), default=1, help="Number of processes.")
@click.option("--scheduler", help="The address of a Dask scheduler, instead of --jobs.")
@click.option("--all", "every", is_flag=True, help="Find all intervals in which bodies meet.")
@click.option(
    "--within",
    "distance",
    type=RATIONAL,
    help="Find the first time at which two bodies are within this Euclidean distance.",
)
@click.option("--until", type=RATIONAL, help="Search up to this time.")
@click.option("--since", type=RATIONAL, help="Search from this time on.")
@TILING
@click.option(
    "--method",
    default="auto",
    show_default=True,
    type=click.Choice(["kinetic", "pairs", "auto"]),
    help="A tiling, or a search over pairs.",
)
@IGNORE
@AFTER_START
@BETWEEN
@click.option("--exact-only", is_flag=True, help="Switch the float filters off.")
@QUIET
@bounded
def batch(
    scenes: Path,
    output: Path,
    jobs: int,
    scheduler: str | None,
    every: bool,
    distance: QQ | None,
    until: QQ | None,
    since: QQ | None,
    tiling: str,
    method: str,
    ignore: tuple[str, ...],
    after_start: bool,
    between: tuple[str, ...],
    exact_only: bool,
    quiet: bool,
    max_seconds: float | None,
) -> int:
    """Compute one query for each scene of a file, by default its first contact.

    SCENES has a scene on each line, as JSON; or it is Parquet (.parquet) with a column "scene" of
    such texts (needs: pip install 'exactpt[parquet]'). The results are lines of JSON in the same
    order, or a Parquet file, which has the other columns of the input too; docs/format.md
    explains them. A scene that fails has the key "error", and the exit code is 2 at the end.
    --max-seconds, --max-memory and --max-bytes bound each scene.

    --scheduler tcp://10.0.0.1:8786 uses the workers of a Dask cluster, which need exactpt.

    If it is interrupted or killed, the same command goes on where it stopped. The bytes of the
    results do not depend on that, nor on the number of workers.

    \b
    Examples:
      exactpt batch scenes.jsonl -o found.jsonl --jobs 2
      exactpt batch scenes.jsonl -o meetings.jsonl --all --until 5
      exactpt batch scenes.parquet -o near.parquet --within 1/2
    """
    from exactpt.batch import Options, run

    of_first = typed("tiling", "method", "ignore", "after_start", "between", "exact_only")
    _check_question(every=every, distance=distance, first_contact_only=of_first)
    most = max_bytes()
    options = Options(
        every=every,
        distance=distance,
        until=until,
        since=since,
        method=method,
        tiling=tiling,
        ignoring=tuple(tuple(names_in(text, "--ignore")) for text in ignore),
        after_start=after_start,
        between=tuple(two_names(text, "--between") for text in between) or None,
        exact_only=exact_only,
        max_seconds=max_seconds,
        max_memory=max_memory(),
        max_bytes=MAX_BYTES if most is None else most,
    )
    progress = [0, 1]
    try:
        with estimating("searching", quiet=quiet) as tell:

            def report(done: int, whole: int) -> None:
                progress[:] = done, whole
                tell(done, whole)

            done = run(scenes, output, options, jobs=jobs, scheduler=scheduler, report=report)
    except KeyboardInterrupt:
        from exactpt.cli import INTERRUPTED

        print_error(_interrupted(output, *progress))
        return INTERRUPTED
    if not quiet:
        print_error(f"{counted(done.scenes, 'scene')} processed, {done.failures} failed")
    if done.failures:
        share = f"{done.failures} of {counted(done.scenes, 'scene')}"
        raise InputError(f"{scenes}: {share} without a result; {done.first}")
    return 0


def _check_question(*, every: bool, distance: QQ | None, first_contact_only: Sequence[str]) -> None:
    """Refuse options that cannot be combined, and a negative distance, by the options' names."""
    if every and distance is not None:
        raise InputError("--all: --within asks another question; give one of the two")
    if distance is not None and distance < 0:
        raise InputError(f"--within: a distance is not negative: {show(distance)}")
    if first_contact_only and (every or distance is not None):
        option = "--all" if every else "--within"
        raise InputError(
            f"{option}: {first_contact_only[0]} is supported only for the first contact"
        )


def _interrupted(output: Path, done: int, whole: int) -> str:
    """Return the kept part of an interrupted batch, and the command that resumes it."""
    journal = output.with_name(f"{output.name}.journal")
    if not journal.exists():
        return "exactpt: interrupted: there is no result yet"
    share = f"{100 * done // whole}% of the input" if done else "the part done before"
    return (
        f"exactpt: interrupted: {share} is done, in {output.name}.part and {journal.name}; "
        f"the same command goes on from there"
    )
