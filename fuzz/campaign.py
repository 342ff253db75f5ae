"""Campaigns of many cases: in this process, on several cores, or on a Dask cluster."""

from __future__ import annotations

import itertools
import time as clock
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Final, TypeVar

from exactpt.workers.cluster import results_on
from exactpt.workers.processes import results_of
from exactpt.workers.work import Work
from fuzz.cases import Case, Outcome, left_by, run_case

__all__ = ["Campaign", "Summary", "cases", "run"]

T = TypeVar("T")

STARTING: Final = 60.0
"""Seconds in which a worker starts and makes its scene."""


@dataclass(frozen=True, slots=True)
class Campaign:
    """The parameters of a campaign.

    Attributes:
        families: names of families and questions (`QUESTION`), taken in turn.
        witnesses: names of the witnesses that check every case.
        seed: the seed of the first scene of each family.
        start: number of the first case, to continue another campaign.
        count: number of cases; None for no limit.
        seconds: time limit in seconds; None for no limit.
        shrink_seconds: time limit for shrinking each failure.
    """

    families: Sequence[str]
    witnesses: Sequence[str]
    seed: int = 0
    start: int = 0
    count: int | None = None
    seconds: float | None = None
    shrink_seconds: float = 60.0


@dataclass(slots=True)
class Summary:
    """The result of a campaign.

    Attributes:
        outcomes: outcomes by number of the case.
        seconds: duration.
        finished: whether it was not interrupted.
    """

    outcomes: dict[int, Outcome] = field(default_factory=dict)
    seconds: float = 0.0
    finished: bool = True

    @property
    def failed(self) -> bool:
        """Whether a witness has found a failure."""
        return any(outcome.failures for outcome in self.outcomes.values())

    def next_start(self, start: int) -> int:
        """The number of the first case that has not been run."""
        return next(i for i in itertools.count(start) if i not in self.outcomes)

    def table(self) -> list[str]:
        """One line for each family: cases, cases per second, failures, seconds by witness."""
        rows = sorted({outcome.case.family for outcome in self.outcomes.values()})
        witnesses = list(dict.fromkeys(w for o in self.outcomes.values() for w in o.seconds))
        head = ("family", "cases", "a second", "failures", *witnesses)
        lines = [
            "{:22}{:>8}{:>10}{:>10}".format(*head[:4]) + "".join(map("{:>11}".format, head[4:]))
        ]
        for name in [*rows, "all"]:
            chosen = [o for o in self.outcomes.values() if name in (o.case.family, "all")]
            times = Counter[str]()
            for outcome in chosen:
                times.update(outcome.seconds)
            total = sum(times.values())
            rate = len(chosen) / total if total else 0.0
            failures = sum(len(o.failures) for o in chosen)
            line = f"{name:22}{len(chosen):>8}{rate:>10.1f}{failures:>10}"
            lines.append(line + "".join(f"{times[w]:>9.1f} s" for w in witnesses))
        return lines


def cases(campaign: Campaign) -> Iterator[Case]:
    """The cases of a campaign in order."""
    families = campaign.families
    stop = None if campaign.count is None else campaign.start + campaign.count
    for i in itertools.count(campaign.start):
        if i == stop:
            return
        yield Case(i, families[i % len(families)], campaign.seed + i // len(families))


def run(
    campaign: Campaign,
    report: Callable[[Outcome], None],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
) -> Summary:
    """Run a campaign; every case counts once.

    With a time limit, witnesses are interrupted at its end; cases that they have not finished do
    not count, unless a failure was found.

    Args:
        campaign: its parameters.
        report: called with every outcome as it arrives.
        jobs: number of processes.
        scheduler: the address of a Dask scheduler, whose workers must be able to import this
            checkout.
    """
    summary = Summary()
    began = clock.monotonic()
    job = partial(
        run_case,
        witnesses=campaign.witnesses,
        shrink_seconds=campaign.shrink_seconds,
        ends=None if campaign.seconds is None else clock.time() + campaign.seconds,
    )
    work = Work(job, left_by, starting=STARTING)
    todo = _until(cases(campaign), campaign.seconds)
    if scheduler is not None:
        outcomes = results_on(scheduler, work, todo, campaign.seconds)
    elif jobs == 1:
        outcomes = map(job, todo)
    else:
        outcomes = results_of(work, todo, jobs, campaign.seconds)
    try:
        for outcome in outcomes:
            if not outcome.complete and not outcome.failures:
                continue
            if outcome.case.number not in summary.outcomes:
                summary.outcomes[outcome.case.number] = outcome
                report(outcome)
    except KeyboardInterrupt:
        summary.finished = False
    finally:
        summary.seconds = clock.monotonic() - began
    return summary


def _until(items: Iterable[T], seconds: float | None) -> Iterator[T]:
    """The items, until the time limit is reached."""
    deadline = None if seconds is None else clock.monotonic() + seconds
    for item in items:
        if deadline is not None and clock.monotonic() > deadline:
            return
        yield item
