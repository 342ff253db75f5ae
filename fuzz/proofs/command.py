"""Commands of ``python -m fuzz`` about proofs, certificates, and the readers of their scenes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click

from fuzz.options import HELP, Options, conduct, options, require_cgal
from fuzz.proofs.apart import Apart
from fuzz.proofs.both import Both
from fuzz.proofs.readers import Readers
from fuzz.proofs.run import KINDS, Mutants

__all__ = ["certificates", "proof_both", "proof_mutants", "scene_readers"]


@click.command("proof-mutants", context_settings=HELP)
@click.option(
    "--past",
    type=click.IntRange(min=0),
    default=5000,
    show_default=True,
    help="Number of mutants of each kind that only geometry can reject.",
)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("mutants-found"),
    show_default=True,
    help="Folder for mutants that are accepted and not true.",
)
@options(110_000)
def proof_mutants(chosen: Options, past: int, keep: Path) -> None:
    r"""Have cgal_check verify proofs that are wrong: each must be rejected, or true.

    \b
    Examples:
      python -m fuzz proof-mutants --seconds 60
      python -m fuzz proof-mutants --state mutants.json
    """
    require_cgal("another command")
    most = -(-(chosen.count or 0) // len(KINDS))
    conduct(Mutants(most, past, keep), replace(chosen, count=None))


@click.command("proof-both", context_settings=HELP)
@click.option(
    "--keep", type=click.Path(file_okay=False, path_type=Path), default=Path("both-found")
)
@options(1000, seed=1)
def proof_both(chosen: Options, keep: Path) -> None:
    """Have both checkers verify damaged proofs: exit code and statement must be the same."""
    require_cgal("another command")
    check = Both(chosen.count or 0, chosen.seed, keep)
    conduct(check, replace(chosen, count=None), again=f"--seed {chosen.seed}")


@click.command("certificates", context_settings=HELP)
@click.option(
    "--keep", type=click.Path(file_okay=False, path_type=Path), default=Path("apart-found")
)
@options(1000, seed=1)
def certificates(chosen: Options, keep: Path) -> None:
    """Have certificates verified, of all families in turn, and ten wrong ones of each.

    Both checkers must have the same answer, accept the right ones, and of the wrong ones those
    alone that are true by a search over all pairs.
    """
    require_cgal("another command")
    conduct(Apart(chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")


@click.command("scene-readers", context_settings=HELP)
@click.option(
    "--keep", type=click.Path(file_okay=False, path_type=Path), default=Path("readers-found")
)
@options(1000, seed=1)
def scene_readers(chosen: Options, keep: Path) -> None:
    """Have damaged scenes read by the package and both checkers: all accept one, or none does."""
    require_cgal("another command")
    conduct(Readers(chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")
