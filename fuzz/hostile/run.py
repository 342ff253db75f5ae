"""Hostile files: the check of a campaign, and its table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final

import click

from exactpt.kernel import budget
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.hostile import readers
from fuzz.hostile.files import FORMATS, hostile
from fuzz.limits import memory_bounded
from fuzz.options import HELP, Options, conduct, options

__all__ = ["OUTCOMES", "Files", "hostile_files"]

OUTCOMES: Final = ("read", "refused", "spent", "broken", "FAULT")

MAX_MEMORY: Final = 300_000_000
"""Maximum growth of the process, in bytes, by the reading of one file."""


@dataclass(frozen=True)
class Files(Check):
    """The check of hostile files.

    Attributes:
        formats: their formats, taken in turn.
        seed: seed of all files.
        keep: folder for files with a fault.
    """

    formats: Sequence[str]
    seed: int
    keep: Path
    name = "hostile"

    @property
    def about(self) -> object:
        """The formats and the seed."""
        return [list(self.formats), self.seed]

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:  # noqa: ARG002 - it is short
        """Have a file read."""
        number = item.numbers.start
        kind = self.formats[number % len(self.formats)]
        file = hostile(kind, number, self.seed)
        path = self.keep / f"{kind}-{self.seed}-{number}"
        finding = Finding(kind, "hangs", str(path), {path: file.content})
        tell(Step(readers.PATIENCE, finding))
        before = budget.resident_memory()
        with TemporaryDirectory() as folder, memory_bounded(MAX_MEMORY):
            ended = readers.read(kind, file, Random(f"reader {self.seed} {number}"), Path(folder))
        grown = budget.resident_memory() - before
        if not ended.fault and grown > MAX_MEMORY:
            ended = ended._replace(outcome="FAULT", fault=f"{grown >> 20} MB more memory")
        seconds, ms = ended.seconds, 1000 * ended.seconds
        counts = Counts({(kind, "files"): 1, (kind, ended.outcome): 1, (kind, "ms"): ms})
        counts.update({(kind, "value"): int(file.wound == "value"), (kind, "slowest s"): seconds})
        counts[kind, "MB more"] = max(0, grown) / 2**20
        if not ended.fault:
            return Result(counts)
        why = f"{path}: {ended.reader}: {ended.fault[:400]}"
        return Result(counts, [finding._replace(signature="FAULT", why=why)])

    def table(self, counts: Counts) -> list[str]:
        """One line for each format: files, of these with one changed value, outcomes, cost."""
        head = ("format", "files", "value", *OUTCOMES, "ms", "slowest s", "MB more")
        lines = [f"{head[0]:10}" + "".join(f"{word:>10}" for word in head[1:])]
        for kind in self.formats:
            numbers = "".join(f"{counts[kind, word]:>10}" for word in head[1:-3])
            mean = counts[kind, "ms"] / max(1, counts[kind, "files"])
            cost = (
                f"{mean:>10.1f}{counts[kind, 'slowest s']:>10.2f}{counts[kind, 'MB more']:>10.0f}"
            )
            lines.append(f"{kind:10}{numbers}{cost}")
        return lines


@click.command("hostile", context_settings=HELP)
@click.option("--format", "formats", multiple=True, type=click.Choice(FORMATS))
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("hostile-found"),
    show_default=True,
    help="Folder for files with a fault.",
)
@options(10_000)
def hostile_files(chosen: Options, formats: tuple[str, ...], keep: Path) -> None:
    """Have every command and reader read damaged files; half have one changed value."""
    conduct(Files(formats or FORMATS, chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")
