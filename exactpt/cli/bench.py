"""bench: the benchmarks have moved; in a checkout the command still runs them."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

import click

import exactpt
from exactpt.cli.terminal import print_error


@click.command(
    add_help_option=False,
    context_settings={"ignore_unknown_options": True, "allow_interspersed_args": False},
)
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED)
def bench(arguments: tuple[str, ...]) -> int:
    """Run `python -m benchmarks`, in a checkout alone (until version 0.4).

    \b
    Example:
      exactpt bench --quick
    """
    checkout = Path(exactpt.__file__).parents[1]
    if not (checkout / "benchmarks" / "catalogue.py").is_file():
        print_error("exactpt bench: moved to the repository (python -m benchmarks)")
        return 2
    if str(checkout) not in sys.path:
        sys.path.insert(0, str(checkout))
    command: click.Command = import_module("benchmarks.__main__").bench
    code: int = command.main(list(arguments), "exactpt bench", standalone_mode=False)
    return code
