"""``python -m benchmarks``: runs benchmarks, writes their tables and plots."""

from __future__ import annotations

from pathlib import Path

import click

from benchmarks.catalogue import BENCHMARKS, run
from benchmarks.machine import machine
from benchmarks.output import Output, exceeds
from exactpt.cli import main
from exactpt.cli.options import output
from exactpt.cli.terminal import is_terminal, print_error, print_output
from exactpt.errors import InputError

__all__ = ["bench"]

_NAMES = "\n".join(f"      {name:14} {shows}" for name, shows in BENCHMARKS.items())


@click.command(
    help=f"""Run benchmarks, all of them if none is named; tables (CSV) and plots (SVG).

    \b
{_NAMES}

    Other programs are compared if they are installed: pip install 'exactpt[bench]'; for engines,
    pip install 'exactpt[engines]', and npm packages in a folder node_modules at or above the
    current one, or in the one that EXACTPT_NODE_MODULES names.

    \b
    Examples:
      python -m benchmarks --quick
      python -m benchmarks wrong-answers kernel -o results
      python -m benchmarks engines -o docs/engines
    """
)
@click.argument("names", nargs=-1, type=click.Choice(list(BENCHMARKS)), metavar="[NAME]...")
@output("The folder for tables and plots.", default=Path("bench"))
@click.option("--quick", is_flag=True, help="Small sizes: about a minute in all.")
@click.option(
    "--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the scenes."
)
@click.option(
    "--fail-above",
    type=float,
    metavar="EXPONENT",
    help="Of exponents: exit code 1 if that of a family is larger.",
)
def bench(
    names: tuple[str, ...],
    output: Path,
    quick: bool,  # noqa: FBT001
    seed: int,
    fail_above: float | None,
) -> int:
    """Run benchmarks."""

    def progress(line: str) -> None:
        if is_terminal():
            print_error(line)

    try:
        results = Output(output, _say_lines, progress)
    except OSError as error:
        raise InputError(f"{output}: {error.strerror}") from None
    about = [*machine(), f"seed {seed}, {'quick' if quick else 'full'} sizes"]
    print_output(*about)
    results.write("machine.txt", "\n".join(about) + "\n")
    above: list[str] = []
    for name in names or BENCHMARKS:
        rows = run(name, results, quick=quick, seed=seed)
        if name == "exponents" and fail_above is not None:
            above = exceeds(rows or [], fail_above)
    print_output("", f"{len(results.written)} files are in {output}")
    if above:
        print_error(f"exponents above {fail_above:g}: {', '.join(above)}")
    return 1 if above else 0


def _say_lines(text: str) -> None:
    print_output(*text.split("\n"))


if __name__ == "__main__":
    main(command=bench, name="python -m benchmarks")
