"""A progress bar on a terminal, which follows the time of a scene, or counts."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

import click

from exactpt.cli.terminal import is_terminal
from exactpt.kernel.numbers import floor

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.scene.scene import Scene

__all__ = ["QUIET", "counting", "progress"]

QUIET = click.option("-q", "--quiet", is_flag=True, help="Print nothing but errors.")

_STEPS: Final = 1000
"""Number of steps of the full bar."""


@contextmanager
def progress(
    scene: Scene, label: str, *, quiet: bool = False
) -> Iterator[Callable[[AlgebraicNumber], None] | None]:
    """Give the function to call with the times that a run reaches; None if there is no terminal.

    Args:
        scene: the scene that runs; the bar is full at its end.
        label: the text beside the bar.
        quiet: whether to show no bar.
    """
    if quiet or not is_terminal():
        yield None
        return
    start, step = scene._start, (scene._end - scene._start) / _STEPS
    with click.progressbar(length=_STEPS, label=label, file=sys.stderr) as bar:

        def reached(time: AlgebraicNumber) -> None:
            time.refine_to(step)  # exactly: a span may be too long or too short for doubles
            bar.update(max(0, int(floor((time._low - start) / step)) - bar.pos))

        yield reached


@contextmanager
def counting(total: int, label: str, *, quiet: bool = False) -> Iterator[Callable[[], None]]:
    """Give the function to call after each of ``total`` steps."""
    if quiet or not is_terminal():
        yield lambda: None
        return
    with click.progressbar(length=total, label=label, file=sys.stderr) as bar:
        yield lambda: bar.update(1)
