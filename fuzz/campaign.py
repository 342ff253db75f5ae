"""Campaigns: cases with consecutive numbers are checked, in worker processes or in this one.

The work is that of a `Check`. Its results are counted in the order of the numbers, so a campaign
that was stopped goes on with the first case that does not count, from its state or by ``--start``.
"""

from __future__ import annotations

import json
import math
import signal
import tempfile
import time as clock
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any, Final, NamedTuple, Protocol, TypeAlias

from exactpt.errors import InputError
from exactpt.files import write_atomically
from exactpt.workers import work
from exactpt.workers.cluster import results_on
from exactpt.workers.processes import results_of
from fuzz.limits import TimeIsUp

__all__ = [
    "FIRST",
    "FOUND",
    "INTERRUPTS",
    "LARGEST",
    "Check",
    "Counts",
    "Finding",
    "Item",
    "Progress",
    "Result",
    "Step",
    "Tell",
    "campaign",
]

FOUND: Final = "found"
"""The column of the numbers of findings."""

FIRST: Final = "first"
"""A column of which the first number is kept; the numbers of all others are added up."""

LARGEST: Final = frozenset({"slowest s", "MB more"})
"""Columns of which the largest number is kept."""

STARTING: Final = 60.0
"""Seconds in which a worker starts and makes its case."""

SAVING: Final = 1.0
"""Least number of seconds between two writings of a state."""

IMPATIENT: Final = 3.0
"""Seconds in which a second Ctrl-C is taken for the first one."""


class Counts(dict[tuple[str, ...], float]):
    """Numbers by row and column: a key is the words of a row, and the name of a column."""

    def __missing__(self, key: tuple[str, ...]) -> float:
        return 0

    def add(self, more: Counts) -> None:
        """Add the counts of later cases."""
        for key, number in more.items():
            if key[-1] in LARGEST:
                self[key] = max(self[key], number)
            elif key[-1] != FIRST:
                self[key] += number
            else:
                self.setdefault(key, number)


class Finding(NamedTuple):
    """A finding of a check.

    Attributes:
        row: row of the table in which it is counted.
        signature: type of the fault, the same for the same fault in another case.
        why: description.
        files: contents of the files to be written, by path.
    """

    row: str
    signature: str
    why: str
    files: Mapping[Path, bytes] = {}


class Step(NamedTuple):
    """The next step of a check.

    Attributes:
        seconds: time that is allowed for it; a worker that takes much longer is killed.
        finding: the report in that case.
        is_found: whether it has been found already, and is being shrunk.
    """

    seconds: float
    finding: Finding
    is_found: bool = False


Tell: TypeAlias = Callable[[Step], None]


class Item(NamedTuple):
    """The work of one call of `Check.run`: some cases.

    Attributes:
        numbers: their numbers.
        wanted: what `Check.wanted` has returned before them.
    """

    numbers: range
    wanted: frozenset[Any] | None = None


class Result(NamedTuple):
    """The counts of an item, and its findings."""

    counts: Counts
    findings: Sequence[Finding] = ()


class Check(Protocol):
    """The work of a campaign on its cases; it is pickled for worker processes.

    Attributes:
        name: its name, in the state of a campaign.
        about: the data that have to be equal in a campaign that goes on from a state, as JSON data.
        chunk: number of cases of an item.
    """

    name: str
    chunk: int = 1

    @property
    def about(self) -> object:
        """See `Check`."""
        return None

    def wanted(self, counts: Counts) -> frozenset[Any] | None:  # noqa: ARG002
        """Return the part still wanted, nothing if the campaign is over; None: everything."""
        return None

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Check the cases of an item.

        Args:
            item: the cases.
            tell: called before each step that may take long.
            ends: the time (of ``time.time``) at which the campaign is over; None if it has no end.

        Raises:
            TimeIsUp: at this time.
        """

    def table(self, counts: Counts) -> list[str]:
        """Return the lines of the table of a campaign."""


@dataclass(slots=True)
class Progress:
    """The progress of a campaign.

    Attributes:
        start: number of its first case.
        next: number of the first case that does not count.
        counts: counts of all cases before it.
        reported: number of findings since it was begun or loaded.
        finished: whether it was not interrupted.
    """

    start: int = 0
    next: int = 0
    counts: Counts = field(default_factory=Counts)
    reported: int = 0
    finished: bool = True

    @property
    def found(self) -> int:
        """Number of findings."""
        counted = sum(int(n) for key, n in self.counts.items() if key[-1] == FOUND)
        return max(self.reported, counted)

    def save(self, path: Path, check: Check) -> None:
        """Write it to a file, from which a campaign can go on."""
        counts = [[*key, n] for key, n in self.counts.items()]
        data = {"campaign": check.name, "about": check.about, "start": self.start,
                "next": self.next, "counts": counts}  # fmt: skip
        write_atomically(path, json.dumps(data) + "\n")

    @classmethod
    def load(cls, path: Path, check: Check) -> Progress:
        """Read it from a file.

        Raises:
            InputError: if the file is not the state of a campaign, or that of another one.
        """
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
            about = json.loads(json.dumps(check.about))
            if (data["campaign"], data["about"]) != (check.name, about):
                other = f"{data['campaign']} {json.dumps(data['about'])}"
                raise InputError(f"{path}: of another campaign: {other:.200}")
            counts = Counts({tuple(key): n for *key, n in data["counts"]})
            return cls(data["start"], data["next"], counts)
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise InputError(f"{path}: not the state of a campaign: {error}") from None


class _Interrupts:
    """A handler of signals: the first one interrupts, and all within seconds are the same one."""

    def __init__(self) -> None:
        self.came = False
        self.wait = False
        self._last = -math.inf

    def __call__(self, signum: int, frame: FrameType | None) -> None:
        now = clock.monotonic()
        if now - self._last > IMPATIENT:
            self._last, self.came = now, True
            if not self.wait:
                signal.default_int_handler(signum, frame)


INTERRUPTS: Final = _Interrupts()
"""The handler of Ctrl-C and of a termination signal."""


@dataclass(frozen=True)
class _Job:
    """The work on an item.

    Attributes:
        check: the check.
        ends: see `Check.run`.
        folder: its temporary files are here, where they are removed if it is killed.
    """

    check: Check
    ends: float | None
    folder: str

    def __call__(self, item: Item, tell: Callable[[Any], None]) -> tuple[Item, Result | None]:
        """Return the item and its result, if time was left for it."""
        tempfile.tempdir = self.folder
        return self.run(item, tell)

    def run(self, item: Item, tell: Tell) -> tuple[Item, Result | None]:
        try:
            return item, self.check.run(item, tell, self.ends)
        except TimeIsUp:
            return item, None


def _lost(item: Item, step: work.Step | None, why: str) -> tuple[Item, Result] | None:
    """Return the result of an item whose worker was stopped; None if it is not finished only."""
    if not isinstance(step, Step):
        if why == work.UNFINISHED:
            return None
        first = item.numbers.start
        step = Step(0.0, Finding("", why, f"case {first}: {why} before the first step"))
    elif step.is_found:
        return item, Result(Counts(), (step.finding,))
    elif why == work.UNFINISHED:
        return None
    found = step.finding
    said = f"{found.why}: {why}, where no limit interrupts it"
    return item, Result(Counts(), (found._replace(signature=why, why=said),))


def campaign(
    check: Check,
    progress: Progress,
    report: Callable[[Finding], None],
    *,
    count: int | None = None,
    seconds: float | None = None,
    jobs: int = 0,
    scheduler: str | None = None,
    state: Path | None = None,
) -> None:
    """Go on with a campaign until a limit is reached, or an interrupt.

    Args:
        check: the work on each case.
        progress: its progress, updated.
        report: called with each finding when it arrives.
        count: number of cases from ``progress.start`` on; None for no limit.
        seconds: time limit in seconds; None for no limit.
        jobs: number of worker processes; 0: the cases are checked in this process, which a
            function of C that hangs does not leave.
        scheduler: the address of a Dask scheduler, whose workers must be able to import this
            checkout; ``jobs`` has no meaning then.
        state: file to which the progress is saved about once in a second, and at the end.
    """
    held: dict[int, tuple[Item, Result]] = {}
    saved = clock.monotonic()
    try:
        with tempfile.TemporaryDirectory() as folder:
            for item, result in _results(check, progress, folder, count, seconds, jobs, scheduler):
                if INTERRUPTS.came:  # the case has caught the exception, and does not count
                    break
                INTERRUPTS.wait = True
                for finding in result.findings if result else ():
                    progress.reported += 1
                    report(finding)
                if result is not None:
                    held[item.numbers.start] = item, result
                _count(progress, held)
                if state is not None and clock.monotonic() - saved > SAVING:
                    progress.save(state, check)
                    saved = clock.monotonic()
                INTERRUPTS.wait = False
                if INTERRUPTS.came:
                    break
    except KeyboardInterrupt:
        progress.finished = False
    finally:
        INTERRUPTS.wait = False
    if INTERRUPTS.came:
        progress.finished = False
    if state is not None:
        progress.save(state, check)


def _count(progress: Progress, held: dict[int, tuple[Item, Result]]) -> None:
    """Count all results that come next."""
    while progress.next in held:
        item, result = held.pop(progress.next)
        progress.counts.add(result.counts)
        for finding in result.findings:
            progress.counts[finding.row, FOUND] += 1
        progress.next = item.numbers.stop


def _results(
    check: Check, progress: Progress, folder: str, count: int | None, seconds: float | None,
    jobs: int, scheduler: str | None,
) -> Iterator[tuple[Item, Result | None]]:  # fmt: skip
    """Yield items with their results as they arrive."""
    job = _Job(check, None if seconds is None else clock.time() + seconds, folder)
    todo = _items(check, progress, count, seconds)
    if scheduler is None and jobs == 0:
        return (job.run(item, lambda _: None) for item in todo)
    todo_by = work.Work(job, _lost, starting=STARTING)
    if scheduler is not None:
        return results_on(scheduler, todo_by, todo, seconds)
    return results_of(todo_by, todo, jobs, seconds)


def _items(
    check: Check, progress: Progress, count: int | None, seconds: float | None
) -> Iterator[Item]:
    """Yield the items that come next, until a limit is reached."""
    deadline = None if seconds is None else clock.monotonic() + seconds
    first, end = progress.next, math.inf if count is None else progress.start + count
    while first < end and (deadline is None or clock.monotonic() < deadline):
        wanted = check.wanted(progress.counts)
        if wanted is not None and not wanted:
            return
        last = int(min(first + check.chunk, end))
        yield Item(range(first, last), wanted)
        first = last
