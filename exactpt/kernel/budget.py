"""Budgets of time and memory: long loops check the budget of their thread.

A budget holds in the thread that has set it, needs no signals, and is checked wherever a
loop may take long: over vertices, certificates, coefficients of long polynomials, bisections.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time as clock
from collections.abc import Callable, Iterator
from fractions import Fraction
from numbers import Real
from pathlib import Path
from typing import Final, final

from exactpt.errors import BudgetExceeded, InputError
from exactpt.filters.rounding import check_rounding
from exactpt.kernel.numbers import shorten

LONG: Final = 64
"""Number of coefficients from which on loops over coefficients of a polynomial check the budget."""

GRACE: Final = 0.25
"""Seconds after its deadline in which a search may still stop by itself, between two steps."""

BETWEEN: Final = 0.05
"""Seconds between two looks at the memory of the process."""


@final
class _Limits(threading.local):
    """The limits of a thread; infinite if it has none."""

    deadline: float = float("inf")
    memory: float = float("inf")
    look: float = float("inf")
    """The earliest time at which anything may be exceeded."""


_LIMITS: Final = _Limits()


def check_budget() -> None:
    """Raise `BudgetExceeded` if this thread has exceeded its time or memory limit.

    Raises:
        RoundingError: if floats do not round by default: see `check_rounding`.
    """
    check_rounding()
    now = clock.monotonic()
    if now < _LIMITS.look:
        return
    if now >= _LIMITS.deadline:
        raise BudgetExceeded("time limit exceeded", None)
    _LIMITS.look = min(_LIMITS.deadline, now + BETWEEN)
    if resident_memory() > _LIMITS.memory:
        raise BudgetExceeded("memory limit exceeded", None)


@contextlib.contextmanager
def within(deadline: float | None, memory: int | None = None) -> Iterator[None]:
    """Within the context, long loops of this thread end with `BudgetExceeded`.

    A budget around this one holds too.

    Args:
        deadline: the time of ``time.monotonic`` at which time limit exceeded; None for none.
        memory: maximum memory of the process, in bytes; None for no limit.
    """
    old = _LIMITS.deadline, _LIMITS.memory, _LIMITS.look
    if deadline is not None:
        _LIMITS.deadline = min(_LIMITS.deadline, deadline)
    if memory is not None:
        _LIMITS.memory = min(_LIMITS.memory, memory)
    _LIMITS.look = min(_LIMITS.look, _LIMITS.deadline)
    if _LIMITS.memory < float("inf"):
        _LIMITS.look = 0.0
    try:
        yield
    finally:
        _LIMITS.deadline, _LIMITS.memory, _LIMITS.look = old


_UNLIMITED: Final = contextlib.nullcontext()


@contextlib.contextmanager
def searching(
    deadline: float | None, contact_free_until: Callable[[], Fraction | None]
) -> Iterator[None]:
    """As `within`, `GRACE` after a deadline, for a search that reports its progress.

    Args:
        deadline: as for `within`.
        contact_free_until: returns a time up to which the search has found no contact, or None:
            ``reached`` of an error that has none.
    """
    with _UNLIMITED if deadline is None else within(deadline + GRACE):
        try:
            yield
        except BudgetExceeded as spent:
            if spent.reached is None:
                spent.reached = contact_free_until()
            raise


def deadline_in(seconds: float | None) -> float | None:
    """Return the time of ``time.monotonic`` after some seconds from now; None for None."""
    return None if seconds is None else clock.monotonic() + seconds


def bounded(
    max_seconds: float | None, max_memory: int | None
) -> contextlib.AbstractContextManager[None]:
    """Return a context in which the time, from now on, and the memory are bounded.

    Raises:
        InputError: if a bound is not a number >= 0.
    """
    if max_seconds is None and max_memory is None:
        return _UNLIMITED
    check_bounds(max_seconds=max_seconds, max_memory=max_memory)
    return within(deadline_in(max_seconds), max_memory)


@final
class Budget:
    """The remaining bounds of a run.

    Args:
        events: maximum number of events; None for no limit.
        seconds: maximum number of seconds of wall-clock time, from now on; None for no limit.
        memory: maximum memory of the process, in bytes; None for no limit.

    Raises:
        InputError: if a bound is not a number >= 0.
    """

    def __init__(
        self, events: int | None, seconds: float | None, memory: int | None = None
    ) -> None:
        check_bounds(max_events=events, max_seconds=seconds, max_memory=memory)
        self._events = events
        self._deadline = deadline_in(seconds)
        self._memory = memory

    @property
    def is_bounded(self) -> bool:
        """True if the number of events or the time has a limit."""
        return self._events is not None or self._deadline is not None

    @property
    def limits_events(self) -> bool:
        """True if the number of events has a limit."""
        return self._events is not None

    def spend(self, events: int) -> bool:
        """Use up some events; whether there were as many."""
        if self._events is None:
            return True
        self._events -= events
        return self._events >= 0

    def is_late(self) -> bool:
        """Return True if the seconds are used up."""
        return self._deadline is not None and clock.monotonic() > self._deadline

    def held(self) -> contextlib.AbstractContextManager[None]:
        """Return a context whose long loops stop when the time or memory limit exceeded.

        A little more time is allowed than between two events, where a run can be interrupted and
        go on.
        """
        if self._deadline is None and self._memory is None:
            return _UNLIMITED
        deadline = None if self._deadline is None else self._deadline + GRACE
        return within(deadline, self._memory)

    def rest(self) -> tuple[int | None, float | None, int | None]:
        """Return the events, seconds and memory that are left, None for no limit."""
        events = None if self._events is None else max(0, self._events)
        seconds = None if self._deadline is None else max(0.0, self._deadline - clock.monotonic())
        return events, seconds, self._memory


def check_bounds(**bounds: object) -> None:
    """Check that bounds are numbers from 0 on, or None for no limit.

    Raises:
        InputError: if one is not; it has its name.
    """
    for name, bound in bounds.items():
        try:
            fits = bound is None or (isinstance(bound, Real) and float(bound) >= 0)
        except OverflowError:
            fits = False
        if not fits:
            raise InputError(f"{name}: not a number from 0 on, or no double: {shorten(bound)}")


def resident_memory() -> int:
    """Return the memory of this process in bytes: the current, or if unknown, the peak."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError):
        pass
    else:
        return pages * os.sysconf("SC_PAGE_SIZE")
    try:
        from resource import RUSAGE_SELF, getrusage
    except ImportError:  # Windows: no limit holds
        return 0
    return getrusage(RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
