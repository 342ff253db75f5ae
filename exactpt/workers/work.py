"""The work on items, and the treatment of items that end their workers."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

Item = TypeVar("Item", bound=Hashable)
Result = TypeVar("Result")

ENDS = "ends its process"
HANGS = "hangs"
UNFINISHED = "is not finished"

MAX_JOBS = 1024
"""Maximum number of processes: more are a mistake, and would fill the memory."""

MAX_TRIES = 2
"""How often an item may end its worker before it is given up."""


class Step(Protocol):
    """The next step of a job with its item.

    Attributes:
        seconds: the time that is allowed for it.
    """

    @property
    def seconds(self) -> float:
        """The time that is allowed for it."""


@dataclass(frozen=True)
class Work(Generic[Item, Result]):
    """The work on each item; jobs and items are pickled.

    Attributes:
        job: the result of an item; its second argument reports its next step.
        lost: the result of an item that is given up, whose last step is given, because it
            `ENDS` its workers, `HANGS` for longer than its step allows, or is `UNFINISHED` when
            the time of all is over; None for no result.
        starting: the seconds in which a worker starts and a job reports its first step.
    """

    job: Callable[[Item, Callable[[Step], None]], Result]
    lost: Callable[[Item, Step | None, str], Result | None]
    starting: float = float("inf")
