"""The command ``python -m fuzz proof-mutants``."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from exactpt.cgal import find_program
from exactpt.errors import InputError
from fuzz.proofs.run import KINDS, Mutant, Progress, run

__all__ = ["proof_mutants"]

FAILED, INTERRUPTED = 1, 130


@click.command("proof-mutants", context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--cases", type=click.IntRange(min=1), default=110_000, show_default=True)
@click.option(
    "--past",
    type=click.IntRange(min=0),
    default=5000,
    show_default=True,
    help="Number of mutants of each kind that only geometry can reject.",
)
@click.option("--seconds", type=click.FloatRange(min=0), help="Time limit.")
@click.option(
    "--state",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Continue from this file if it exists, and update it.",
)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("mutants-found"),
    show_default=True,
    help="Folder for mutants that are accepted and not true.",
)
def proof_mutants(
    cases: int, past: int, seconds: float | None, state: Path | None, keep: Path
) -> None:
    r"""Have cgal_check verify proofs that are wrong: each must be rejected, or true.

    \b
    Examples:
      python -m fuzz proof-mutants --seconds 60
      python -m fuzz proof-mutants --state mutants.json
    """
    try:
        find_program()
        is_begun = state is not None and state.exists()
        progress = Progress.load(state) if state is not None and is_begun else Progress()
    except InputError as error:
        raise click.UsageError(str(error)) from None

    def save() -> None:
        if state is not None:
            progress.save(state)

    def report(mutant: Mutant, name: str) -> None:
        keep.mkdir(exist_ok=True)
        (keep / f"{name}.scene.json").write_bytes(mutant.scene)
        (keep / f"{name}.proof").write_bytes(mutant.proof)
        click.echo(f"accepted, and not true: {keep / name}")

    most = -(-cases // len(KINDS))
    try:
        run(progress, report, save, most=most, past=past, seconds=seconds)
    except KeyboardInterrupt:
        click.echo("\n".join(progress.table()))
        sys.exit(INTERRUPTED)
    click.echo("\n".join(progress.table()))
    sys.exit(FAILED if progress.found else 0)
