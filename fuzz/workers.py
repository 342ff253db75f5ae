"""Worker processes that may be killed or hang: no case is lost, and the campaign goes on.

Each worker has one case at a time and tells what it does next, with the time allowed for it. A
worker that ends is replaced and its case is repeated once; one that is silent for too long is
killed, which is a finding about its case.
"""

from __future__ import annotations

import contextlib
import signal
import time as clock
from collections import Counter, deque
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Final, TypeAlias

from fuzz.cases import Case, Outcome, Step, stopped

__all__ = ["Job", "outcomes_of"]

Job: TypeAlias = Callable[[Case, Callable[[Step], None]], Outcome]

STARTING: Final = 60.0
"""Seconds in which a worker starts and makes its scene."""

GRACE: Final = 5.0
"""Seconds of silence beyond three times the announced ones after which a worker is killed."""

LAST: Final = 0.03
"""Share of the campaign's time in which workers may still report, when it is over."""

MOST_TRIES: Final = 2
"""How often a case may end its worker before that counts as a failure of the case."""


class _Worker:
    """A process, and the case it works on."""

    def __init__(self, job: Job) -> None:
        context = get_context("spawn")
        self.connection, theirs = context.Pipe()
        self._process = context.Process(target=_work, args=(theirs, job), daemon=True)
        self._process.start()
        theirs.close()
        self.case: Case | None = None
        self.step: Step | None = None
        self.heard = clock.monotonic()

    def begin(self, case: Case) -> None:
        self.case, self.step, self.heard = case, None, clock.monotonic()
        with contextlib.suppress(OSError):  # it has ended: this is noticed when it is heard
            self.connection.send(case)

    def hear(self) -> Outcome | None:
        """The outcome, if that is what it says; raises EOFError if it has ended."""
        try:
            message = self.connection.recv()
        except OSError:
            raise EOFError from None
        self.heard = clock.monotonic()
        if isinstance(message, Outcome):
            self.case = None
            return message
        self.step = message
        return None

    def overdue(self) -> float:
        """How many seconds it has been silent for too long; negative if it has not."""
        allowed = STARTING if self.step is None else 3 * self.step.seconds + GRACE
        return clock.monotonic() - self.heard - allowed

    def kill(self) -> None:
        self._process.kill()
        self._process.join()
        self.connection.close()


def _work(connection: Connection, job: Job) -> None:
    """Run cases until the other end is closed; only the parent hears Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(EOFError, OSError):
        while True:
            connection.send(job(connection.recv(), connection.send))


def outcomes_of(
    job: Job, todo: Iterator[Case], jobs: int, seconds: float | None = None
) -> Iterator[Outcome]:
    """The outcomes of cases as they arrive; at most for a time in seconds."""
    ends = None if seconds is None else clock.monotonic() + seconds
    workers = [_Worker(job) for _ in range(jobs)]
    again: deque[Case] = deque()
    tries = Counter[int]()
    try:
        while True:
            for worker in workers:
                if worker.case is None:
                    case = again.popleft() if again else next(todo, None)
                    if case is not None:
                        worker.begin(case)
            busy = [worker for worker in workers if worker.case is not None]
            if not busy:
                return
            pause = _pause(busy, ends, seconds)
            if pause is None:
                yield from (o for worker in busy if (o := _left(worker)) is not None)
                return
            heard = wait([worker.connection for worker in busy], pause)
            for worker in busy:
                outcome: Outcome | None = None
                if worker.connection in heard:
                    try:
                        outcome = worker.hear()
                    except EOFError:
                        case = worker.case
                        if case is not None:
                            tries[case.number] += 1
                            if tries[case.number] < MOST_TRIES:
                                again.append(case)
                            else:
                                outcome = stopped(case, worker.step, "ends its process")
                        _replace(workers, worker, job)
                elif worker.overdue() > 0:
                    outcome = _left(worker)
                    _replace(workers, worker, job)
                if outcome is not None:
                    yield outcome
    finally:
        for worker in workers:
            worker.kill()


def _pause(busy: list[_Worker], ends: float | None, seconds: float | None) -> float | None:
    """How long to wait for the next message; None if the time is over."""
    pause = max(0.0, min(-worker.overdue() for worker in busy))
    if ends is None or seconds is None:
        return pause
    left = ends + min(GRACE, LAST * seconds) - clock.monotonic()
    return None if left <= 0 else min(pause, left)


def _left(worker: _Worker) -> Outcome | None:
    """What a worker that is stopped leaves: a failure that it was shrinking, or its hanging."""
    assert worker.case is not None  # noqa: S101
    if worker.overdue() <= 0 and (worker.step is None or worker.step.failure is None):
        return None
    return stopped(worker.case, worker.step, "hangs")


def _replace(workers: list[_Worker], worker: _Worker, job: Job) -> None:
    worker.kill()
    workers[workers.index(worker)] = _Worker(job)
