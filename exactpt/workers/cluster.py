"""Items on a Dask cluster, which repeats those of a lost worker elsewhere."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.workers.work import ENDS, Item, Result, Step, Work

if TYPE_CHECKING:
    from distributed import Client, Future

AHEAD: Final = 4
"""Number of items at a time for each thread of the cluster."""
PATIENCE: Final = 5.0
"""Seconds in which a scheduler must have answered."""


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
    """Return a client of a scheduler.

    Raises:
        InputError: if none answers at this address within `PATIENCE`.
    """
    from distributed import Client

    # In a thread of its own: the caller's may have an event loop, as in a notebook.
    with ThreadPoolExecutor(1) as pool:
        fault = pool.submit(lambda: asyncio.run(_fault_of(scheduler))).result()
    if fault is None:
        try:
            return Client(scheduler, timeout=PATIENCE)
        except Exception as error:  # of the network, or of the answer of another program
            fault = _in_words(error)
    raise InputError(f"no scheduler at {scheduler}: {fault}; check the address")


async def _fault_of(scheduler: str) -> str | None:
    """Return the reason why no scheduler is at an address; None if one answers.

    A client waits much longer for a program that accepts the connection and does not answer.
    """
    from distributed.comm import connect
    from distributed.security import Security

    try:
        settings = Security().get_connection_args("client")
        comm = await asyncio.wait_for(connect(scheduler, PATIENCE, **settings), PATIENCE)
        await comm.close()
    except Exception as error:  # of the network, or of the answer of another program
        return _in_words(error)
    return None


def _in_words(error: Exception) -> str:
    """Return the reason of an error in one short line."""
    if isinstance(error, TimeoutError) or "Timed out" in str(error):
        return f"no answer within {PATIENCE:g} s"
    return " ".join(str(error).split())[:200] or type(error).__name__


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
