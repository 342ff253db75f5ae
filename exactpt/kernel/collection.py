"""The cyclic garbage collector, at rest while something large is built."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

_AT_REST: Final[set[object]] = set()
"""A token for each context that has switched the collector off and will switch it on again."""


@contextmanager
def collector_at_rest() -> Iterator[None]:
    """Within the context, cyclic garbage is not collected, in any thread.

    The collector visits all objects again and again while their number grows, though none
    of the new objects is garbage: a third of the time of a tiling's start.

    A child that is forked meanwhile has its collector on: the thread that would switch it on again
    may not exist there.
    """
    token = object()
    if gc.isenabled():
        _AT_REST.add(token)
    gc.disable()
    try:
        yield
    finally:
        if token in _AT_REST:
            gc.enable()
            _AT_REST.discard(token)


def _switch_on() -> None:
    """Switch the collector on in a forked child, if a context of the parent would do so."""
    if _AT_REST:
        _AT_REST.clear()
        gc.enable()


if hasattr(os, "register_at_fork"):  # not on Windows
    os.register_at_fork(after_in_child=_switch_on)
