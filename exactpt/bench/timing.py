"""How long something takes, and how that grows."""

from __future__ import annotations

import gc
import math
import tracemalloc
from collections.abc import Callable, Sequence
from time import process_time
from typing import TypeVar

__all__ = ["exponent", "memory_of", "microseconds", "per_event", "timed"]

T = TypeVar("T")
Q = TypeVar("Q")


def timed(ask: Callable[[], T]) -> tuple[T, float]:
    """The answer, and the seconds of processor time that it took.

    What is in memory before is left out of garbage collection, so that it costs nothing.
    """
    gc.freeze()
    try:
        start = process_time()
        answer = ask()
        return answer, process_time() - start
    finally:
        gc.unfreeze()


def microseconds(ask: Callable[[Q], T], questions: Sequence[Q]) -> tuple[float, list[T]]:
    """The median over three passes of the processor time a question, and the answers."""
    passes = [timed(lambda: [ask(q) for q in questions]) for _ in range(3)]
    middle = sorted(seconds for _, seconds in passes)[1]
    return 1e6 * middle / max(1, len(questions)), passes[-1][0]


def per_event(seconds: float, events: int) -> float:
    """Microseconds an event; 0 without events."""
    return 1e6 * seconds / events if events else 0.0


def memory_of(make: Callable[[], object]) -> float:
    """The kilobytes that something keeps, and what it has left in what it is made of."""
    tracemalloc.start()
    try:
        kept = make()
        return tracemalloc.get_traced_memory()[0] / 1024 if kept is not None else 0.0
    finally:
        tracemalloc.stop()


def exponent(sizes: Sequence[float], values: Sequence[float]) -> float:
    """The p of the best c n^p, by least squares over the logarithms; nan for lack of points."""
    points = [(math.log(n), math.log(v)) for n, v in zip(sizes, values, strict=True) if v > 0]
    if len({x for x, _ in points}) < 2:
        return math.nan
    mx = sum(x for x, _ in points) / len(points)
    my = sum(y for _, y in points) / len(points)
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
