"""Campaigns of hostile files, and their table."""

from __future__ import annotations

import signal
import time as clock
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from types import FrameType
from typing import Final, NamedTuple

from exactpt.files import write_atomically
from exactpt.kernel import budget
from fuzz.hostile.files import Hostile, hostile
from fuzz.hostile.readers import Ended, read

__all__ = ["OUTCOMES", "Outcome", "Tally", "run", "table"]

OUTCOMES: Final = ("read", "refused", "spent", "broken", "FAULT")

MOST_MEMORY: Final = 300_000_000
"""Maximum growth of the process, in bytes, by the reading of one file."""


@dataclass(slots=True)
class Tally:
    """The outcomes of one format.

    Attributes:
        outcomes: number of each.
        values: number of files with one changed value.
        seconds: processor time, in all and for the slowest.
        grown: the largest growth of memory by one file, in bytes.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    values: int = 0
    seconds: float = 0.0
    slowest: float = 0.0
    grown: int = 0

    def add(self, file: Hostile, ended: Ended, grown: int) -> None:
        """Count a file."""
        self.outcomes[ended.outcome] += 1
        self.values += file.wound == "value"
        self.seconds += ended.seconds
        self.slowest = max(self.slowest, ended.seconds)
        self.grown = max(self.grown, grown)


class Outcome(NamedTuple):
    """What a campaign has counted.

    Attributes:
        tallies: of each format.
        rest: number of the file at which an interrupted campaign goes on; None if it has ended.
    """

    tallies: dict[str, Tally]
    rest: int | None


class _Interrupts:
    """Whether a signal has interrupted the process, even if a command has caught the exception."""

    def __init__(self) -> None:
        self.came = False

    @contextmanager
    def noticed(self) -> Iterator[None]:
        """Notice SIGINT and SIGTERM, and leave what happens then as it was."""
        old = {
            number: handler
            for number in (signal.SIGINT, signal.SIGTERM)
            if callable(handler := signal.getsignal(number))
        }

        def handle(number: int, frame: FrameType | None) -> None:
            self.came = True
            old[signal.Signals(number)](number, frame)

        for number in old:
            signal.signal(number, handle)
        try:
            yield
        finally:
            for number, handler in old.items():
                signal.signal(number, handler)


def run(
    formats: Sequence[str],
    count: int,
    *,
    seed: int = 0,
    start: int = 0,
    seconds: float | None = None,
    report: Callable[[str], None],
    keep: Path,
) -> Outcome:
    """Read hostile files, the formats in turn; files with a fault are kept in a folder.

    Interrupted, it returns what it has counted; the file that was being read is not.
    """
    tallies = {kind: Tally() for kind in formats}
    deadline = None if seconds is None else clock.monotonic() + seconds
    interrupts, number = _Interrupts(), start
    with suppress(KeyboardInterrupt), TemporaryDirectory() as folder, interrupts.noticed():
        for number in range(start, start + count):
            if deadline is not None and clock.monotonic() > deadline:
                break
            kind = formats[number % len(formats)]
            file = hostile(kind, number, seed)
            before = budget.resident_memory()
            ended = read(kind, file, Random(f"reader {seed} {number}"), Path(folder))
            if interrupts.came:
                break
            grown = budget.resident_memory() - before
            if not ended.fault and grown > MOST_MEMORY:
                ended = ended._replace(outcome="FAULT", fault=f"{grown >> 20} MB more memory")
            tallies[kind].add(file, ended, grown)
            if ended.fault:
                keep.mkdir(exist_ok=True)
                path = keep / f"{kind}-{seed}-{number}"
                write_atomically(path, file.content)
                report(f"{path}: {ended.reader}: {ended.fault[:400]}")
    return Outcome(tallies, number if interrupts.came else None)


def table(tallies: dict[str, Tally]) -> list[str]:
    """One line for each format: files, of these with one changed value, outcomes, cost."""
    head = ("format", "files", "value", *OUTCOMES, "ms", "slowest s", "MB more")
    lines = [f"{head[0]:10}" + "".join(f"{word:>10}" for word in head[1:])]
    for kind, tally in tallies.items():
        files = sum(tally.outcomes.values())
        numbers = [files, tally.values, *(tally.outcomes[word] for word in OUTCOMES)]
        mean = 1000 * tally.seconds / files if files else 0.0
        cost = f"{mean:>10.1f}{tally.slowest:>10.2f}{tally.grown / 2**20:>10.0f}"
        lines.append(f"{kind:10}" + "".join(f"{n:>10}" for n in numbers) + cost)
    return lines
