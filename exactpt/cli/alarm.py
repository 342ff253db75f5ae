"""Signals: a time limit interrupts a run anywhere."""

from __future__ import annotations

import signal
import threading
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final, NoReturn

from exactpt.errors import BudgetExceeded
from exactpt.kernel.budget import within

GRACE: Final = 0.25
"""Seconds beyond the limit in which the library may stop by itself, between two events."""

LONGEST: Final = 1e8
"""Maximum delay of the timer in seconds, about three years."""

SOON: Final = 1e-6
"""Seconds until a caller's timer rings that has been due meanwhile; 0 would switch it off."""

AGAIN: Final = 1.0
"""Seconds between repeated signals: an exception raised in a finalizer is dropped by Python."""


@contextmanager
def time_limit(seconds: float | None, memory: int | None = None) -> Iterator[None]:
    """Raise `BudgetExceeded` inside the context when the time limit and a grace period are over.

    Or when the process has more ``memory`` than that, in bytes.

    The library checks the time between events and then reports how far it has come. Reading a
    scene, building a tiling, or isolating roots of polynomials with long coefficients may
    however take any time. A signal interrupts all of these at no cost (compiled code at its next
    call of code that is not compiled; exact arithmetic is not compiled). An interrupted
    computation cannot be resumed; so this belongs in a process that ends, not in the library.

    Only the main thread receives signals, and Windows has no such signal: elsewhere the long
    loops of the library check the time.
    """
    main = threading.current_thread() is threading.main_thread()
    deadline = None if seconds is None else clock.monotonic() + seconds + GRACE
    with within(deadline, memory):
        if seconds is None or not main or not hasattr(signal, "setitimer"):
            yield
        else:
            with _alarm(seconds):
                yield


@contextmanager
def _alarm(seconds: float) -> Iterator[None]:
    """Raise `BudgetExceeded` by a signal; so it is if C code makes another error of it."""
    rung = False

    def ring(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        nonlocal rung
        rung = True
        raise BudgetExceeded("time limit exceeded", None)

    old = signal.signal(signal.SIGALRM, ring)
    delay = min(seconds, LONGEST) + GRACE
    begin = clock.monotonic()
    left, interval = signal.setitimer(signal.ITIMER_REAL, delay, AGAIN)
    try:
        yield
    except SystemError:
        if rung:
            raise BudgetExceeded("time limit exceeded", None) from None
        raise
    finally:
        # First no timer: it would ring by the other handler.
        signal.setitimer(signal.ITIMER_REAL, 0)
        if old is not None:  # None: a handler that was not set by Python cannot be put back
            signal.signal(signal.SIGALRM, old)
        if left:  # the caller's timer has gone on meanwhile
            rest = left - (clock.monotonic() - begin)
            signal.setitimer(signal.ITIMER_REAL, max(rest, SOON), interval)
