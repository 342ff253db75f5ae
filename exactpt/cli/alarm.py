"""Signals: a budget that is used up, or a request to end, interrupts a run wherever it is."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final, NoReturn

from exactpt.errors import BudgetExceeded

__all__ = ["endings", "time_limit"]

GRACE: Final = 0.25
"""Seconds that are left to the library, which looks at the clock between events."""

LONGEST: Final = 1e8
"""Seconds, three years: a timer takes no more."""

AGAIN: Final = 1.0
"""Seconds to the next ring: Python drops what is raised in a finalizer."""


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Raise `BudgetExceeded` inside when the time, and a moment of grace, is over.

    The library looks at the clock between events, and tells how far it has come. But to
    read a scene, to build a tiling and to isolate the roots of polynomials with long
    coefficients may take any time; a signal reaches them all, at no cost and with no loop
    that could be forgotten (one that is compiled when it next calls what is not, and exact
    arithmetic is not). What is interrupted is in no state to go on: a process that
    ends is the place for this, not the library.

    Only for the main thread. Windows has no such signal: there the library's looks at the
    clock are all.
    """
    if seconds is None or not hasattr(signal, "setitimer"):
        yield
        return

    def ring(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        raise BudgetExceeded("the time is used up", None)

    old = signal.signal(signal.SIGALRM, ring)
    delay = min(seconds, LONGEST) + GRACE
    left, interval = signal.setitimer(signal.ITIMER_REAL, delay, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, left, interval)
        signal.signal(signal.SIGALRM, old)


@contextmanager
def endings() -> Iterator[None]:
    """Have a request to end (SIGTERM, SIGHUP) raise `SystemExit`, so that temporary files go.

    Only in the main thread, and only of signals that nobody else has taken or switched off.
    """
    names = [name for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    taken = [
        number
        for number in map(signal.Signals.__getitem__, names)
        if threading.current_thread() is threading.main_thread()
        and signal.getsignal(number) is signal.SIG_DFL
    ]

    def end(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        raise SystemExit(128 + signum)

    for number in taken:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)
