"""The command ``python -m fuzz small-scope``."""

from __future__ import annotations

import datetime
import json

import click

from exactpt.scene.written import to_json
from fuzz.options import HELP, Options, conduct, options
from fuzz.small_scope.run import Scope, start_of
from fuzz.small_scope.scope import planned, sizes

__all__ = ["small_scope"]


@click.command("small-scope", context_settings=HELP)
@click.option("--today", is_flag=True, help="Start with the scene of this day.")
@click.option("--proofs", is_flag=True, help="Check the proof by a tiling, and nothing else.")
@click.option("--shrink", default=20.0, show_default=True, help="Seconds for shrinking a fault.")
@click.option(
    "--show", type=click.IntRange(min=0), help="Print the scene with this number and stop."
)
@options(None)
def small_scope(
    chosen: Options, *, today: bool, proofs: bool, shrink: float, show: int | None
) -> None:
    """Compare all methods on all small scenes, up to symmetry, and on a sample of larger ones.

    By default a round, of as many scenes as the scope has.

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
    if today and chosen.start is not None:
        raise click.UsageError("either --start or --today")
    click.echo(f"scenes of a round: {', '.join(f'{k} {v:,}' for k, v in sizes().items())}")
    first = start_of(datetime.datetime.now(datetime.UTC).date()) if today else 0
    conduct(Scope(proofs, shrink), chosen, first=first, whole=sum(sizes().values()))
