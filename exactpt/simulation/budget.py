"""The bounds on a run: a number of events, seconds, memory, and one thread at a time."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from threading import RLock
from time import monotonic
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import InputError
from exactpt.kernel.budget import GRACE, check_bounds, within

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

__all__ = ["Budget", "Guard", "OneThread"]

_UNLIMITED: Final = nullcontext()


@final
class Guard:
    """A context that is in another one, and tells of the error by which it is left.

    Args:
        around: the other context; it lets errors pass.
        failed: what is called with an error.
    """

    __slots__ = ("_around", "_failed")

    def __init__(
        self, around: AbstractContextManager[None], failed: Callable[[BaseException], None]
    ) -> None:
        self._around = around
        self._failed = failed

    def __enter__(self) -> None:
        self._around.__enter__()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._around.__exit__(kind, error, trace)
        if error is not None:
            self._failed(error)


@final
class OneThread:
    """A context for one thread at a time, in which that thread may enter it again.

    Another thread is refused, not kept waiting: the order of their events would depend on chance.

    Raises:
        InputError: on entering, if another thread is inside.
    """

    __slots__ = ("_lock",)

    def __init__(self) -> None:
        self._lock = RLock()

    def __enter__(self) -> None:
        if not self._lock.acquire(blocking=False):
            raise InputError(
                "the simulation is in use by another thread: wait for it, or use a copy()"
            )

    def __exit__(self, *_error: object) -> None:
        self._lock.release()


@final
class Budget:
    """What a run may still use.

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
        self._deadline = None if seconds is None else monotonic() + seconds
        self._memory = memory

    @property
    def is_bounded(self) -> bool:
        """Whether the number of events or the time has a limit."""
        return self._events is not None or self._deadline is not None

    @property
    def limits_events(self) -> bool:
        """Whether the number of events has a limit."""
        return self._events is not None

    def spend(self, events: int) -> bool:
        """Use up some events; whether there were as many."""
        if self._events is None:
            return True
        self._events -= events
        return self._events >= 0

    def is_late(self) -> bool:
        """Whether the seconds are used up."""
        return self._deadline is not None and monotonic() > self._deadline

    def held(self) -> AbstractContextManager[None]:
        """A context whose long loops stop when the time or the memory is used up.

        A little more time is allowed than between two events, where a run can be interrupted and
        go on.
        """
        if self._deadline is None and self._memory is None:
            return _UNLIMITED
        deadline = None if self._deadline is None else self._deadline + GRACE
        return within(deadline, self._memory)

    def rest(self) -> tuple[int | None, float | None, int | None]:
        """The events, seconds and memory that are left, None for no limit."""
        events = None if self._events is None else max(0, self._events)
        seconds = None if self._deadline is None else max(0.0, self._deadline - monotonic())
        return events, seconds, self._memory
