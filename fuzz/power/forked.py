"""Work in a process of its own, with limits of processor time, elapsed time and memory."""

from __future__ import annotations

import contextlib
import os
import resource
import select
import signal
import sys
import time as clock
import traceback
from collections.abc import Callable
from typing import Final, NamedTuple, TypeAlias

__all__ = ["Ended", "Say", "in_a_process"]

Say: TypeAlias = Callable[[str], None]
"""Sends a line of text to the process that waits."""

WAITING: Final = 6.0
"""Elapsed time, in units of the limit of processor time, after which work that waits is stuck."""

MEMORY: Final = 8 * 2**30
"""Bytes of addresses: a mistake that asks for more gets an error."""

LOOK: Final = 0.2
"""Seconds between two looks whether the process has ended: its own children may keep the pipe."""


class Ended(NamedTuple):
    """What is left of a process.

    Attributes:
        lines: the lines that it has sent.
        status: its exit status, as `os.wait4` has it; 0 if the work was done.
        seconds: its processor time.
    """

    lines: list[str]
    status: int
    seconds: float


def in_a_process(work: Callable[[Say], None], seconds: float) -> Ended:
    """Do work in a forked process, which is ended, with its children, after its limits.

    What it prints is lost; an exception is sent as the last line, with another exit status than 0.

    Args:
        work: the work; it is given a function that sends a line.
        seconds: the limit of its processor time.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    receiving, sending = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.close(receiving)
            _limit(seconds)
            work(lambda line: _send(sending, line))
            status = 0
        except BaseException as error:
            _send(sending, traceback.format_exception_only(error)[-1].strip())
        finally:
            os._exit(status)
    os.close(sending)
    try:
        text = _received(receiving, child, clock.monotonic() + WAITING * seconds)
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(child, signal.SIGKILL)
        os.close(receiving)
        _, status, used = os.wait4(child, 0)
    return Ended(text.splitlines(), status, used.ru_utime + used.ru_stime)


def _limit(seconds: float) -> None:
    """Make this process the leader of a group, mute and bounded."""
    os.setsid()
    null = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(null, descriptor)
    most = int(clock.process_time() + seconds) + 1
    resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def _send(sending: int, line: str) -> None:
    os.write(sending, f"{line.replace(chr(10), ' ')}\n".encode(errors="replace"))


def _received(receiving: int, child: int, ends: float) -> str:
    """Return what a child sends until it ends, or until a time."""
    pieces = []
    while clock.monotonic() < ends:
        has_ended = os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
        ready, _, _ = select.select([receiving], [], [], 0 if has_ended else LOOK)
        if ready:
            piece = os.read(receiving, 2**16)
            if piece:
                pieces.append(piece)
                continue
        if has_ended:
            break
        if ready:
            clock.sleep(LOOK)  # the end of the pipe: the child is about to end
    return b"".join(pieces).decode(errors="replace")
