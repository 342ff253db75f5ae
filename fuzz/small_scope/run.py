"""Runs through the scope: in processes, up to a number or a time, resumable from a small file."""

from __future__ import annotations

import datetime
import itertools
import json
import time as clock
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Final

from exactpt.errors import InputError
from exactpt.files import write_atomically
from exactpt.scene.written import to_json
from fuzz.cases import Failure, failure_of, shrunk
from fuzz.small_scope.look import AUDITED, looks, looks_at_proofs
from fuzz.small_scope.scope import planned, sizes
from fuzz.small_scope.tally import Fault, Tally

__all__ = ["Progress", "count", "failure_in", "run", "start_of"]

CHUNK: Final = 50
"""Number of scenes between two checks of the time limit."""

A_DAY: Final = 4000
"""Distance of the starts of two consecutive days."""


@dataclass(slots=True)
class Progress:
    """The progress of a run through the scope.

    Attributes:
        start: number of its first scene.
        next: number of the first scene that has not been checked.
        tally: tally of the checked scenes.
        proofs: whether proofs are checked, instead of answers compared.
        finished: whether it was not interrupted.
    """

    start: int = 0
    next: int = 0
    tally: Tally = field(default_factory=Tally)
    proofs: bool = False
    finished: bool = True

    def save(self, path: Path) -> None:
        """Write it to a file, from which a run can continue."""
        data = {"round": sizes(), "start": self.start, "next": self.next, "proofs": self.proofs}
        data |= self.tally.to_json()
        write_atomically(path, json.dumps(data) + "\n")

    @classmethod
    def load(cls, path: Path) -> Progress:
        """Read it from a file.

        Raises:
            InputError: if the file is not a progress, or one of another scope.
        """
        try:
            data = json.loads(path.read_text())
            if data["round"] != sizes():
                raise InputError(f"{path}: of another scope, {data['round']}")
            proofs = data.get("proofs", False)
            return cls(data["start"], data["next"], Tally.from_json(data), proofs)
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise InputError(f"{path}: not the state of a run: {error}") from None


def start_of(day: datetime.date) -> int:
    """The first scene of a day; scenes that a day leaves out come in later rounds."""
    return day.toordinal() * A_DAY


def count(numbers: range, *, proofs: bool = False) -> Tally:
    """The tally of the scenes with these numbers."""
    began = clock.process_time()
    tally = Tally()
    compare = looks_at_proofs if proofs else looks
    for seen in compare([planned(number) for number in numbers]):
        tally.note(seen)
    tally.seconds = clock.process_time() - began
    return tally


def run(
    progress: Progress,
    report: Callable[[list[tuple[Fault, int]]], None],
    *,
    most: int | None = None,
    seconds: float | None = None,
    jobs: int = 1,
) -> None:
    """Continue a run through the scope.

    Args:
        progress: its progress; updated after every few scenes.
        report: called then, with the new faults and the first scene of each.
        most: maximum number of scenes to check; None for no limit.
        seconds: time limit in seconds; None for no limit.
        jobs: number of processes.
    """
    deadline = None if seconds is None else clock.monotonic() + seconds
    todo = _chunks(progress.next, most, deadline)
    tally_of = partial(count, proofs=progress.proofs)
    counted = ((c, tally_of(c)) for c in todo) if jobs == 1 else _on_cores(tally_of, todo, jobs)
    try:
        for numbers, tally in counted:
            new = progress.tally.add(tally)
            progress.next = numbers.stop
            report(new)
    except KeyboardInterrupt:
        progress.finished = False


def _chunks(start: int, most: int | None, deadline: float | None) -> Iterator[range]:
    for first in itertools.count(start, CHUNK):
        end = first + CHUNK if most is None else min(first + CHUNK, start + most)
        if end <= first or (deadline is not None and clock.monotonic() > deadline):
            return
        yield range(first, end)


def _on_cores(
    tally_of: Callable[[range], Tally], todo: Iterator[range], jobs: int
) -> Iterator[tuple[range, Tally]]:
    """The tallies in order; a few chunks are queued ahead of the running ones."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        pending: deque[tuple[range, Future[Tally]]] = deque()
        try:
            while True:
                for numbers in itertools.islice(todo, 2 * jobs - len(pending)):
                    pending.append((numbers, pool.submit(tally_of, numbers)))
                if not pending:
                    return
                numbers, future = pending.popleft()
                yield numbers, future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def failure_in(number: int, fault: Fault, seconds: float) -> Failure:
    """The failure of a scene in the form of a campaign, shrunk for at most ``seconds``.

    A fault that no witness of campaigns finds is not shrunk.
    """
    scene, turn = planned(number).scene, number // AUDITED
    witness = {"static": "static", "proof": "proof"}.get(fault.method.split()[0], "reference")
    failure = failure_of(witness, scene, turn)
    if failure is None:
        said = f"{fault.method}: {fault.what}"
        return Failure("small-scope", said, said, json.dumps(to_json(scene)))
    return shrunk(failure, turn, seconds, patience=5.0) if seconds else failure
