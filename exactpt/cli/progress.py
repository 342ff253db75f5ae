"""A progress bar on a terminal, which follows the time of a scene."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

import click

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.scene.scene import Scene

__all__ = ["QUIET", "progress"]

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
    if quiet or not sys.stderr.isatty():
        yield None
        return
    start, span = float(scene._start), float(scene._end - scene._start)
    with click.progressbar(length=_STEPS, label=label, file=sys.stderr) as bar:
        yield lambda time: bar.update(int(_STEPS * (float(time) - start) / span) - bar.pos)
