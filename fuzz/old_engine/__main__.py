"""The command ``python -m fuzz.old_engine``: builds the old engine."""

from __future__ import annotations

import click

from exactpt.errors import InputError
from fuzz.old_engine.build import COMMIT, build


@click.command("old-engine")
def main() -> None:
    """Build the engine of version 0.2 into .old-engine, for the witness "old"."""
    try:
        wheel = build()
    except InputError as error:
        raise click.ClickException(str(error)) from None
    click.echo(f"{wheel.name} of {COMMIT[:8]}: python -m fuzz --witness old")


if __name__ == "__main__":
    main()
