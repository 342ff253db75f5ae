"""What an adversary found, and its command."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

__all__ = ["Report", "run"]


@dataclass
class Report:
    """Counts of rows.

    Attributes:
        rows: how many rows were checked.
        close: how many of them had an error within a tenth of the bound.
        worst: the largest error relative to the bound.
        wrong: descriptions of wrong answers.
        counts: other counts, such as those of answers.
    """

    rows: int = 0
    close: int = 0
    worst: float = 0.0
    wrong: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)

    def measure(self, ratio: float) -> None:
        """Count a row whose error has this ratio to its bound."""
        self.rows += 1
        self.worst = max(self.worst, ratio)
        if ratio >= 0.9:
            self.close += 1

    def count(self, what: str) -> None:
        """Count something."""
        self.counts[what] = self.counts.get(what, 0) + 1

    def line(self, name: str) -> str:
        """Return a line of the table."""
        parts = [f"{name:24}", f"{self.rows:9}", f"{self.close:9}", f"{self.worst:9.4f}"]
        counts = ", ".join(f"{what} {n}" for what, n in sorted(self.counts.items()))
        return " ".join([*parts, f"{len(self.wrong):6}  {counts}"])


Part: TypeAlias = Callable[[int, int], Report]
"""Checks a number of rows with a seed."""
HEAD = f"{'part':24} {'rows':>9} {'close':>9} {'worst':>9} {'wrong':>6}"


def run(parts: dict[str, Part], description: str) -> None:
    """Run the parts of an adversary that the command names; end with 1 if an answer was wrong."""
    parser = ArgumentParser(description=description)
    parser.add_argument("--rows", type=int, default=10_000, help="number of rows of each part")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--parts", nargs="*", choices=list(parts), default=list(parts))
    options = parser.parse_args()
    _show(HEAD)
    failed = False
    for name in options.parts:
        begin = time.process_time()
        report = parts[name](options.rows, options.seed)
        seconds = time.process_time() - begin
        _show(f"{report.line(name)} ({seconds:.0f} s)")
        for text in report.wrong[:5]:
            _show(f"    {text}")
        failed = failed or bool(report.wrong)
    sys.exit(1 if failed else 0)


def _show(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
