"""Output of a benchmark: printed text, tables as CSV, plots as SVG."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias, final

from benchmarks.peers import ENGINES, is_installed
from benchmarks.plots import Series, draw_lines, draw_shares
from exactpt.files import write_atomically

__all__ = ["Cell", "Output", "Row", "exceeds"]

Cell: TypeAlias = "str | int | float | None"
Row: TypeAlias = Mapping[str, Cell]
"""A row of a table: cells by name of the column."""


@final
class Output:
    """A folder for results, which are also printed.

    Args:
        folder: the folder; created if it does not exist.
        say: called with each line of results.
        progress: called with a line about the current step.

    Attributes:
        written: the files, in order.
    """

    def __init__(
        self, folder: Path, say: Callable[[str], None], progress: Callable[[str], None]
    ) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._skipped: set[str] = set()
        self.say = say
        self.progress = progress
        self.written: list[Path] = []

    def begin(self, name: str, shows: str) -> None:
        """Print the heading of a benchmark."""
        self.say(f"\n{name}: {shows}")

    def has(self, package: str) -> bool:
        """Return True if an optional package is installed; if not, print this once."""
        if is_installed(package):
            return True
        if package not in self._skipped:
            self._skipped.add(package)
            extra = "engines" if package in ENGINES else "bench"
            self.say(f"skipped: {package} is not installed (pip install 'exactpt[{extra}]')")
        return False

    def table(self, name: str, rows: Sequence[Row], tell: Sequence[Row] = ()) -> None:
        """Write and print a table; all rows have the columns of the first.

        Args:
            name: name of the file, without suffix.
            rows: the rows, at least one.
            tell: the rows to print, if these differ.
        """
        columns = list(rows[0])
        text = io.StringIO()
        writer = csv.DictWriter(text, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
        self.write(f"{name}.csv", text.getvalue())
        self.say("")
        printed = tell or rows
        for line in _aligned(list(printed[0]), printed):
            self.say(line)

    def lines(
        self, name: str, title: str, axes: tuple[str, str], series: Mapping[str, Series]
    ) -> None:
        """Draw points joined by lines, one line for each name, with logarithmic axes."""
        drawn = {name: points for name, points in series.items() if points}
        if drawn and self.has("matplotlib"):
            self.write(f"{name}.svg", draw_lines(title, axes, drawn))

    def shares(
        self, name: str, title: str, rows: Sequence[str], columns: Sequence[str],
        values: Sequence[Sequence[float | None]],
    ) -> None:  # fmt: skip
        """Draw a table of shares from 0 to 1 in colours; None for cells without a value."""
        if self.has("matplotlib"):
            self.write(f"{name}.svg", draw_shares(title, rows, columns, values))

    def write(self, name: str, content: str) -> None:
        """Write a file of the folder; it is complete or not there."""
        path = self._folder / name
        write_atomically(path, content)
        self.written.append(path)


def exceeds(rows: Sequence[Row], limit: float) -> list[str]:
    """Return the families of a table of exponents whose exponent is above a limit."""
    found = ((str(row["family"]), row["exponent"]) for row in rows)
    return [name for name, p in found if isinstance(p, float) and p > limit]


def _aligned(columns: Sequence[str], rows: Sequence[Row]) -> list[str]:
    """A table as text: words flush left, numbers flush right."""
    numeric = [all(not isinstance(row[c], str) for row in rows) for c in columns]
    cells = [list(columns), *([_shown(row[c]) for c in columns] for row in rows)]
    widths = [max(len(line[i]) for line in cells) for i in range(len(columns))]
    return [
        "  ".join(
            cell.rjust(width) if right else cell.ljust(width)
            for cell, width, right in zip(line, widths, numeric, strict=True)
        ).rstrip()
        for line in cells
    ]


def _shown(cell: Cell) -> str:
    if cell is None:
        return "-"
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)
