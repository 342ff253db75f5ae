"""``python -m benchmarks.collision_set``: writes the Exact 2D collision set."""

from __future__ import annotations

import itertools
from pathlib import Path

import click

from benchmarks.collision_set.writing import PASSAGES, SCENES, planned, write_set
from exactpt.cli import main
from exactpt.cli.options import QUIET
from exactpt.cli.progress import estimating
from exactpt.cli.terminal import print_output

__all__ = ["collision_set"]


@click.command()
@click.argument("folder", type=click.Path(path_type=Path), default="exact-2d-collision-set-1")
@click.option(
    "--questions",
    type=click.IntRange(min=0),
    default=PASSAGES,
    show_default=True,
    help="Number of questions about a point and a segment.",
)
@click.option(
    "--scenes",
    type=click.IntRange(min=0),
    default=SCENES,
    show_default=True,
    help="Number of scenes.",
)
@click.option(
    "--jobs", type=click.IntRange(min=1), default=1, show_default=True, help="Number of processes."
)
@QUIET
def collision_set(
    folder: Path,
    questions: int,
    scenes: int,
    jobs: int,
    quiet: bool,  # noqa: FBT001
) -> int:
    """Write the Exact 2D collision set, version 1, to a new FOLDER.

    It has questions of all families with exact answers, also as queries of CCD benchmarks, scenes
    with proofs, checksums, a licence (CC0) and a README. docs/collision-set.md explains it.

    \b
    Examples:
      python -m benchmarks.collision_set --jobs 4
      python -m benchmarks.collision_set small --questions 1000 --scenes 100
    """
    parts = planned(questions, scenes)
    numbers = itertools.count(1)
    with estimating("Families", quiet=quiet) as show:
        summary = write_set(folder, parts, jobs=jobs, done=lambda: show(next(numbers), len(parts)))
    if not quiet:
        print_output(
            f"{summary.files} files: {folder}", f"SHA-256 of SHA256SUMS: {summary.manifest}"
        )
    return 0


if __name__ == "__main__":
    main(command=collision_set, name="python -m benchmarks.collision_set")
