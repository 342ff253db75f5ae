"""A progress bar on a terminal, which follows the time of a scene or an amount; lines elsewhere."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import ceil
from typing import TYPE_CHECKING, Final

import click

from exactpt.cli.terminal import is_terminal, print_error
from exactpt.kernel.numbers import floor

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.scene.scene import Scene

_STEPS: Final = 1000
"""Number of steps of the full bar."""

SECONDS: Final = 30.0
"""Least time between two lines about progress, where there is no terminal."""


@contextmanager
def progress(
    scene: Scene, label: str, *, quiet: bool = False
) -> Iterator[Callable[[AlgebraicNumber], None] | None]:
    """Give the function to call with the times that a run reaches; None without a terminal.

    Args:
        scene: the scene that runs; the bar is full at its end.
        label: the text beside the bar.
        quiet: whether to show no bar.
    """
    if quiet or not is_terminal():
        yield None
        return
    start, step = scene.exact_start, (scene.exact_end - scene.exact_start) / _STEPS
    with click.progressbar(length=_STEPS, label=label, file=sys.stderr) as bar:

        def reached(time: AlgebraicNumber) -> None:
            time.refine_to(step)  # exactly: a span may be too long or too short for doubles
            bar.update(max(0, int(floor((time.exact_low - start) / step)) - bar.pos))

        yield reached


@contextmanager
def estimating(label: str, *, quiet: bool = False) -> Iterator[Callable[[int, int], None]]:
    """Return a function that reports how much of a long task is done, of how much.

    It shows the share done and an estimate of the time left, from the average rate since
    its first call: a bar on a terminal, elsewhere a line every `SECONDS`.
    """
    if quiet:
        yield lambda _done, _whole: None
        return
    first: list[tuple[float, int]] = []  # the time of the first call, and the finished part

    def rest(done: int, whole: int) -> str:
        now = clock.monotonic()
        if not first:
            first.append((now, done))
        start, before = first[0]
        if done in (before, whole):
            return ""
        return f"about {_in_words((now - start) * (whole - done) / (done - before))} left"

    if is_terminal():
        with click.progressbar(
            length=1, label=label, file=sys.stderr, show_eta=False,
            item_show_func=lambda left: str(left or ""),
        ) as bar:  # fmt: skip

            def move(done: int, whole: int) -> None:
                bar.length = whole
                bar.update(done - bar.pos, rest(done, whole))

            yield move
        return
    printed = clock.monotonic()

    def line(done: int, whole: int) -> None:
        nonlocal printed
        left = rest(done, whole)
        if clock.monotonic() - printed >= SECONDS and left:
            printed = clock.monotonic()
            print_error(f"{label}: {100 * done // whole}%, {left}")

    yield line


def _in_words(seconds: float) -> str:
    """Return a duration, rounded up to seconds, minutes or tenths of hours."""
    if seconds < 100:
        return f"{ceil(seconds)} s"
    return f"{ceil(seconds / 60)} min" if seconds < 6000 else f"{ceil(seconds / 360) / 10} h"
