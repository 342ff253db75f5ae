"""Items on a Dask cluster, which repeats those of a lost worker elsewhere."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

from exactpt.errors import InputError
from exactpt.workers.work import ENDS, Item, Result, Step, Work

if TYPE_CHECKING:
    from distributed import Client, Future

AHEAD = 4
"""Number of items at a time for each thread of the cluster."""


def results_on(
    scheduler: str, work: Work[Item, Result], todo: Iterator[Item], seconds: float | None = None
) -> Iterator[Result]:
    """Yield the results of items as they arrive; at most for a time in seconds.

    Args:
        scheduler: the address of a Dask scheduler, whose workers can import its modules.
        work: the work on each item.
        todo: the items, taken a few ahead.
        seconds: the time of all; None for no limit.

    Raises:
        InputError: if ``distributed`` is missing, or no scheduler replies.
    """
    try:
        from distributed import as_completed
    except ImportError:
        raise InputError("a cluster needs: pip install 'exactpt[distributed]'") from None
    left = None if seconds is None else 1.03 * seconds
    with _client(scheduler) as client:
        items: dict[str, Item] = {}
        running = as_completed(timeout=left)

        def submit_next() -> None:
            item = next(todo, None)
            if item is not None:
                future = client.submit(work.job, item, _silent, pure=False)
                items[future.key] = item
                running.add(future)

        for _ in range(AHEAD * max(1, sum(client.nthreads().values()))):
            submit_next()
        with contextlib.suppress(TimeoutError):
            for future in running:
                yield from _result(work, future, items.pop(future.key))
                submit_next()


def _client(scheduler: str) -> Client:
    from distributed import Client

    try:
        return Client(scheduler)
    except (OSError, ValueError) as error:
        raise InputError(f"no scheduler at {scheduler}: {error}") from None


def _silent(step: Step) -> None:
    """Report nothing."""


def _result(work: Work[Item, Result], future: Future, item: Item) -> Iterator[Result]:
    """Yield the result of an item; one that has ended several workers is given up."""
    try:
        yield future.result()
    except Exception as error:  # of the cluster: a job raises nothing
        result = work.lost(item, None, f"{ENDS} ({type(error).__name__})")
        if result is not None:
            yield result
