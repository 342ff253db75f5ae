"""Worker processes that may be killed or hang: no item is lost, and the others go on.

Each worker has one item at a time and reports its next step, with the time allowed for it. A
worker that ends is replaced and its item is repeated once; one that is silent for too long is
killed, which is a finding about its item.
"""

from __future__ import annotations

import contextlib
import math
import signal
import threading
import time as clock
from collections import Counter, deque
from collections.abc import Iterator
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Final, Generic

from exactpt.workers.work import ENDS, HANGS, MAX_TRIES, UNFINISHED, Item, Result, Step, Work

GRACE: Final = 5.0
"""Seconds of silence beyond three times the announced ones after which a worker is killed."""

LAST: Final = 0.03
"""Share of the time of all in which workers may still report, when it is over."""


class _Worker(Generic[Item, Result]):
    """A process, and the item it works on."""

    def __init__(self, work: Work[Item, Result]) -> None:
        self._work = work
        context = get_context("spawn")
        self.connection, theirs = context.Pipe()
        self._process = context.Process(target=_do, args=(theirs, work.job), daemon=True)
        with _deaf():
            self._process.start()
        theirs.close()
        self.item: Item | None = None
        self.step: Step | None = None
        self.heard = clock.monotonic()

    def begin(self, item: Item) -> None:
        self.item, self.step, self.heard = item, None, clock.monotonic()
        with contextlib.suppress(OSError):  # it has ended: this is noticed when it is heard
            self.connection.send(item)

    def hear(self) -> list[Result]:
        """Return the result, if the message is a result; raises EOFError if it has ended."""
        try:
            is_result, message = self.connection.recv()
        except OSError:
            raise EOFError from None
        self.heard = clock.monotonic()
        if is_result:
            self.item = None
            return [message]
        self.step = message
        return []

    def overdue(self) -> float:
        """How many seconds it has been silent for too long; negative if it has not."""
        allowed = self._work.starting if self.step is None else 3 * self.step.seconds + GRACE
        return clock.monotonic() - self.heard - allowed

    def kill(self) -> None:
        self._process.kill()
        self._process.join()
        self.connection.close()


@contextlib.contextmanager
def _deaf() -> Iterator[None]:
    """Put off Ctrl-C until the end of the context; processes started in it never receive it.

    They inherit the mask. Starting the tracker of resources unblocks SIGINT and SIGTERM: that is
    done before, and the caller's mask is put back at the end.
    Here another thread, one of numpy for example, may take the signal, and Python would interrupt
    this one: a process that has been started by half prints a traceback.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    from multiprocessing.resource_tracker import ensure_running  # not on Windows

    before = signal.pthread_sigmask(signal.SIG_BLOCK, [])
    ensure_running()
    heard: list[int] = []
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    handler = signal.getsignal(signal.SIGINT)
    replaced = handler is not None and threading.current_thread() is threading.main_thread()
    try:
        if replaced:
            signal.signal(signal.SIGINT, lambda number, _frame: heard.append(number))
        yield
    finally:
        if replaced:
            signal.signal(signal.SIGINT, handler)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    if heard:
        signal.raise_signal(signal.SIGINT)


def _do(connection: Connection, job: object) -> None:
    """Do items until the other end is closed; only the parent hears Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert callable(job)  # noqa: S101

    def report(step: Step) -> None:
        connection.send((False, step))

    with contextlib.suppress(EOFError, OSError):
        while True:
            connection.send((True, job(connection.recv(), report)))


def results_of(
    work: Work[Item, Result], todo: Iterator[Item], jobs: int, seconds: float | None = None
) -> Iterator[Result]:
    """Yield the results of items as they arrive; at most for a time in seconds.

    Args:
        work: the work on each item.
        todo: the items, taken one at a time.
        jobs: the number of processes.
        seconds: the time of all; None for no limit.
    """
    ends = None if seconds is None else clock.monotonic() + seconds
    workers: list[_Worker[Item, Result]] = []
    again: deque[Item] = deque()
    tries = Counter[Item]()
    try:
        while True:
            for k in range(jobs):
                if k == len(workers) or workers[k].item is None:
                    item = again.popleft() if again else next(todo, None)
                    if item is None:
                        break
                    if k == len(workers):  # no more processes than items
                        workers.append(_Worker(work))
                    workers[k].begin(item)
            busy = [worker for worker in workers if worker.item is not None]
            if not busy:
                return
            pause = _pause(busy, ends, seconds)
            if pause is None:
                for worker in busy:
                    yield from _given_up(
                        work, worker, HANGS if worker.overdue() > 0 else UNFINISHED
                    )
                return
            heard = wait([w.connection for w in busy], pause if math.isfinite(pause) else None)
            for worker in busy:
                if worker.connection in heard:
                    try:
                        yield from worker.hear()
                    except EOFError:
                        yield from _ended(work, worker, tries, again)
                        _replace(workers, worker, work)
                elif worker.overdue() > 0:
                    yield from _given_up(work, worker, HANGS)
                    _replace(workers, worker, work)
    finally:
        for worker in workers:
            worker.kill()


def _pause(
    busy: list[_Worker[Item, Result]], ends: float | None, seconds: float | None
) -> float | None:
    """How long to wait for the next message; None if the time is over."""
    pause = max(0.0, min(-worker.overdue() for worker in busy))
    if ends is None or seconds is None:
        return pause
    left = ends + min(GRACE, LAST * seconds) - clock.monotonic()
    return None if left <= 0 else min(pause, left)


def _ended(
    work: Work[Item, Result],
    worker: _Worker[Item, Result],
    tries: Counter[Item],
    again: deque[Item],
) -> Iterator[Result]:
    """Return the next state of the item of a worker that has ended."""
    item = worker.item
    if item is None:
        return
    tries[item] += 1
    if tries[item] < MAX_TRIES:
        again.append(item)
    else:
        yield from _given_up(work, worker, ENDS)


def _given_up(
    work: Work[Item, Result], worker: _Worker[Item, Result], why: str
) -> Iterator[Result]:
    if worker.item is not None:
        result = work.lost(worker.item, worker.step, why)
        if result is not None:
            yield result


def _replace(
    workers: list[_Worker[Item, Result]],
    worker: _Worker[Item, Result],
    work: Work[Item, Result],
) -> None:
    worker.kill()
    workers[workers.index(worker)] = _Worker(work)
