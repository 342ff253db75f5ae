"""Measurement of time and memory, and of their growth."""

from __future__ import annotations

import gc
import math
import tracemalloc
from collections.abc import Callable, Mapping, Sequence
from time import process_time
from typing import TypeVar

from exactpt import AlgebraicNumber, Approach, AuditError, Contact
from exactpt.kernel.budget import resident_memory
from exactpt.testing.reference import FirstContact

__all__ = [
    "beside",
    "exponent",
    "fastest",
    "in_turn",
    "memory_of",
    "microseconds",
    "near",
    "per_event",
    "resident",
    "time_of",
    "timed",
]

T = TypeVar("T")
Q = TypeVar("Q")


def timed(ask: Callable[[], T]) -> tuple[T, float]:
    """Return the result of a function, and its processor time in seconds.

    Existing objects are excluded from garbage collection, so that they cost nothing.
    """
    gc.freeze()
    try:
        start = process_time()
        answer = ask()
        return answer, process_time() - start
    finally:
        gc.unfreeze()


def in_turn(
    asks: Mapping[str, Callable[[], Callable[[], T]]], runs: int
) -> dict[str, tuple[T, float]]:
    """Run some queries in turn, some times; return their results and least times in seconds.

    In turn, so that whatever else the machine does is shared by all of them.

    Args:
        asks: by name, a function that prepares a query, which is not timed.
        runs: number of runs; one for a query that takes ten times as long as the fastest.
    """
    found = {name: timed(prepare()) for name, prepare in asks.items()}
    limit = 10.0 * min(seconds for _, seconds in found.values())
    for _ in range(runs - 1):
        for name, (answer, least) in found.items():
            if least <= limit:
                found[name] = answer, min(least, timed(asks[name]())[1])
    return found


def fastest(ask: Callable[[], T], runs: int) -> tuple[T, float]:
    """Return the result of a query, and its least processor time in some runs, in seconds."""
    found = in_turn({"": lambda: ask}, runs)
    return found[""]


def beside(
    question: str,
    ways: Mapping[str, Callable[[], Callable[[], T]]],
    runs: int,
    value: Callable[[T], object] = lambda answer: answer,
) -> tuple[T, dict[str, float]]:
    """Return the result of a query, and the least seconds of each way to it, see `in_turn`.

    Args:
        question: its name.
        ways: by name, a function that prepares a way, which is not timed. The result is that of
            the first.
        runs: number of runs.
        value: the part of a result that is compared.

    Raises:
        AuditError: if two ways have different results.
    """
    found = in_turn(ways, runs)
    answers = [answer for answer, _ in found.values()]
    if any(value(answer) != value(answers[0]) for answer in answers):
        said = dict(zip(found, map(value, answers), strict=True))
        raise AuditError(f"two ways disagree about {question}: {said}")
    return answers[0], {name: seconds for name, (_, seconds) in found.items()}


def time_of(contact: Contact | FirstContact | Approach | None) -> AlgebraicNumber | None:
    """Return the exact time of a result; None without one."""
    return None if contact is None else contact.time


def near(contact: Contact | Approach | None) -> float | None:
    """Return the time of a result for a table."""
    return None if contact is None else float(contact.time)


def microseconds(ask: Callable[[Q], T], questions: Sequence[Q]) -> tuple[float, list[T]]:
    """Return the median over three passes of the microseconds per query, and the results."""
    passes = [timed(lambda: [ask(q) for q in questions]) for _ in range(3)]
    middle = sorted(seconds for _, seconds in passes)[1]
    return 1e6 * middle / max(1, len(questions)), passes[-1][0]


def per_event(seconds: float, events: int) -> float:
    """Return the microseconds per event; 0 without events."""
    return 1e6 * seconds / events if events else 0.0


def memory_of(make: Callable[[], object]) -> float:
    """Return the kilobytes of a new object, with those that its creation caches elsewhere."""
    tracemalloc.start()
    try:
        kept = make()
        return tracemalloc.get_traced_memory()[0] / 1024 if kept is not None else 0.0
    finally:
        tracemalloc.stop()


def resident() -> int:
    """Return the memory of this process without garbage, or its maximum if unknown; in bytes."""
    gc.collect()
    return resident_memory()


def exponent(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Return the exponent p of the log-log least-squares fit of c n^p; NaN for too few points."""
    points = [(math.log(n), math.log(v)) for n, v in zip(sizes, values, strict=True) if v > 0]
    if len({x for x, _ in points}) < 2:
        return math.nan
    mx = sum(x for x, _ in points) / len(points)
    my = sum(y for _, y in points) / len(points)
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
