"""The cyclic garbage collector, at rest while something large is built."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def collector_at_rest() -> Iterator[None]:
    """Within the context, cyclic garbage is not collected, in any thread.

    The collector visits all objects again and again while their number grows, though none
    of the new objects is garbage: a third of the time of a tiling's start.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
