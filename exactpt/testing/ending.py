"""A clock for tests of limits: the time is over at a chosen look at it."""

from __future__ import annotations

import threading
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final, final

__all__ = ["StandingClock", "ending_at"]

BEFORE: Final = 0.0
"""Reading of the clock, in seconds, before it strikes."""

LEAP: Final = 1e6
"""Seconds from one look to the next, from the strike on: every limit of a test is over, also one
that begins at the strike itself."""


@final
class StandingClock:
    """A clock that stands still, and strikes once.

    Args:
        strike: the number of the look, from 1 on, that finds the time over; None for no look.

    Attributes:
        looks: how often the clock has been read.
    """

    def __init__(self, strike: int | None) -> None:
        self._strike = strike
        self.looks = 0

    @property
    def looks_after(self) -> int:
        """How often the clock was read after the look that found the time over."""
        return 0 if self._strike is None else max(0, self.looks - self._strike)

    def monotonic(self) -> float:
        """Return the time of this clock."""
        self.looks += 1
        has_struck = self._strike is not None and self.looks >= self._strike
        return BEFORE + LEAP * (1 + self.looks_after) if has_struck else BEFORE


@contextmanager
def ending_at(look: int | None) -> Iterator[StandingClock]:
    """Let the time of this thread end at a look at the clock: for tests of limits of time.

    Searches and runs with ``max_seconds`` look at the clock between their steps. Within this
    context the clock stands still for the thread that entered it, until the look of this number,
    which finds every limit over that has begun before. So a search can be ended at each of its
    steps in turn, and at the same one on every machine. Other threads have the time of
    ``time.monotonic``, as before.

    Args:
        look: the number of the look, from 1 on, that finds the time over; None to count looks.

    Yields:
        The clock, which counts how often it is read.

    Example:
        What a search has reached when its time is over is true:

        >>> from exactpt import BudgetExceeded, first_contact
        >>> from exactpt.testing import ending_at
        >>> from exactpt.testing.scenes import generate
        >>> scene = generate("row", 3)
        >>> with ending_at(None) as clock:
        ...     contact = first_contact(scene, max_seconds=1)
        >>> for look in range(1, clock.looks + 1):
        ...     with ending_at(look):
        ...         try:
        ...             assert first_contact(scene, max_seconds=1) == contact
        ...         except BudgetExceeded as spent:
        ...             assert contact is None or (spent.reached or 0) <= contact.time
    """
    standing, thread = StandingClock(look), threading.get_ident()
    real = clock.monotonic

    def monotonic() -> float:
        return standing.monotonic() if threading.get_ident() == thread else real()

    clock.monotonic = monotonic
    try:
        yield standing
    finally:
        clock.monotonic = real
