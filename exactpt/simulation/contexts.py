"""Contexts of a run: what is called with its errors, and one thread at a time."""

from __future__ import annotations

from contextlib import AbstractContextManager
from threading import RLock
from typing import TYPE_CHECKING, final

from exactpt.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

__all__ = ["Guard", "OneThread"]


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
