"""Limits of time: what takes too long is interrupted, in any thread, and is a finding."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import sys
import threading
import time as clock
import traceback
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Final, NoReturn

from exactpt.scene.scene import Scene

if sys.platform == "linux":
    import resource
else:
    resource = None

__all__ = ["TimeIsUp", "TooSlow", "limit", "memory_bounded", "patience_of", "signed"]

WAITING: Final = 6.0
"""Elapsed time, in units of the limit of processor time, after which work that waits is stuck."""

SHORTLY: Final = 0.01
"""Seconds until a thread that is just entering or leaving a limit is looked at again."""

AGAIN: Final = 0.5
"""Seconds between repeated interrupts: Python drops an exception raised in a finalizer."""


class TooSlow(BaseException):
    """A limit of time is reached."""


class TimeIsUp(BaseException):
    """The time of the whole campaign is over."""


class _Dropped(BaseException):
    """The exception of a watch is not wanted any more."""


def patience_of(scene: Scene) -> float:
    """Seconds of processor time within which any witness answers on a scene.

    No witness has taken a tenth of this in any scene of the families.
    """
    return 5.0 + scene.vertex_count / 10


def signed(error: Exception) -> tuple[str, str]:
    """Return the signature of an exception, the same for the same fault, and a description."""
    where = traceback.extract_tb(error.__traceback__)[-1]
    signature = f"{type(error).__name__} in {where.name}"
    return signature, f"{signature}: {error}"


@contextlib.contextmanager
def limit(seconds: float, ends: float | None = None) -> Iterator[None]:
    """Interrupt what takes longer.

    In the main thread processor time counts, and `WAITING` times as much elapsed time for work
    that waits for something. Other threads receive no signals; there elapsed time counts, and
    the exception is raised between two instructions of Python.

    Args:
        seconds: the limit.
        ends: the time (of ``time.time``) at which the campaign is over; None if it has no end.

    Raises:
        TooSlow: after the limit.
        TimeIsUp: at the end, if that is earlier.
    """
    left = WAITING * seconds if ends is None else min(WAITING * seconds, ends - clock.time())
    if left <= 0:
        raise TimeIsUp
    if threading.current_thread() is threading.main_thread():
        with _signals(seconds, left, ends):
            yield
    else:
        with _watched(min(seconds, left), ends):
            yield


ROOM: Final = 1 << 30
"""Bytes of addresses beyond a bound on memory: allocators take more than they use."""


@contextlib.contextmanager
def memory_bounded(most: int) -> Iterator[None]:
    """Let the process have no more than some bytes of memory, and `ROOM`, beyond what it has.

    Python raises `MemoryError` for what is beyond. GMP ends the process, which is a finding of a
    campaign with processes.
    """
    if resource is None:
        yield
        return
    old, hard = resource.getrlimit(resource.RLIMIT_AS)
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    wanted = pages * os.sysconf("SC_PAGE_SIZE") + most + ROOM
    soft = wanted if old == resource.RLIM_INFINITY else min(wanted, old)
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (old, hard))


def _over(ends: float | None) -> type[BaseException]:
    return TooSlow if ends is None or clock.time() < ends else TimeIsUp


@contextlib.contextmanager
def _signals(seconds: float, left: float, ends: float | None) -> Iterator[None]:
    interrupted = False

    def interrupt(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        nonlocal interrupted
        interrupted = True
        raise _over(ends)

    old = [signal.signal(number, interrupt) for number in (signal.SIGPROF, signal.SIGALRM)]
    signal.setitimer(signal.ITIMER_PROF, seconds, AGAIN)
    signal.setitimer(signal.ITIMER_REAL, left, AGAIN)
    try:
        yield
    except SystemError:  # C code may make one of the interrupt
        if interrupted:
            raise _over(ends) from None
        raise
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in zip((signal.SIGPROF, signal.SIGALRM), old, strict=True):
            signal.signal(number, handler)


@contextlib.contextmanager
def _watched(seconds: float, ends: float | None) -> Iterator[None]:
    """The same for a thread, by a second thread that watches the time.

    It watches no longer than the function that asked for the limit runs. So it ends even if an
    exception that it raises arrives while it is withdrawn, and another thread, which may have the
    identifier of this one later, is left alone.
    """
    over = threading.Lock()
    over.acquire()
    thread, asker = ctypes.c_ulong(threading.get_ident()), _asker()
    raised = threading.Event()

    def watch() -> None:
        wait = seconds
        while not over.acquire(timeout=wait):
            if not _runs(asker, thread.value):
                return
            if _is_outside(asker, thread.value):
                wait = SHORTLY
                continue
            raised.set()
            _raise_in(thread, _over(ends))
            wait = AGAIN

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        _withdraw(over, watcher, thread, raised)


def _raise_in(thread: ctypes.c_ulong, kind: type[BaseException]) -> None:
    """Raise an exception in a thread, soon; it replaces one that has not arrived."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(kind))


def _asker() -> FrameType | None:
    """The frame of the function that has entered `limit`."""
    frame: FrameType | None = sys._getframe()
    while frame is not None and frame.f_code.co_filename in (__file__, contextlib.__file__):
        frame = frame.f_back
    return frame


def _frames(thread: int) -> Iterator[FrameType]:
    """The frames that a thread is in, from the innermost outwards."""
    frame = sys._current_frames().get(thread)
    while frame is not None:
        yield frame
        frame = frame.f_back


def _runs(function: FrameType | None, thread: int) -> bool:
    """Return True if a frame is one of those that a thread is in."""
    return any(frame is function for frame in _frames(thread))


def _is_outside(asker: FrameType | None, thread: int) -> bool:
    """Return True if a thread enters or leaves a limit: an exception could leave locks behind."""
    for frame in _frames(thread):
        if frame is asker:
            return False
        if frame.f_code.co_filename == __file__:
            return True
    return False


def _withdraw(
    over: threading.Lock, watcher: threading.Thread, thread: ctypes.c_ulong, raised: threading.Event
) -> None:
    """End a watch: no exception is raised after this; one that is under way is dropped.

    It may arrive anywhere in here, so nothing is held here that others wait for. A watch that
    went on would raise it in whichever thread got the identifier next.

    To drop it, another one replaces it and arrives. It is not taken back by NULL: CPython 3.11
    would keep its flag for pending exceptions, which only an arrival resets, and a traced call
    would wait for that without end.
    """
    while True:
        try:
            if over.locked():
                over.release()
            watcher.join()
            while raised.is_set():
                _raise_in(thread, _Dropped)
                clock.sleep(0)
        except (TooSlow, TimeIsUp):
            continue
        except _Dropped:
            pass
        return
