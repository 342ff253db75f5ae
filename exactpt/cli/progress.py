"""A bar that follows the time of a scene: on a terminal, while the command runs."""

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
"""The bar is full after so many."""


@contextmanager
def progress(
    scene: Scene, label: str, *, quiet: bool = False
) -> Iterator[Callable[[AlgebraicNumber], None] | None]:
    """Give what is to be told the times that a run reaches; None where nobody looks on.

    Args:
        scene: what runs; the bar is full at its end.
        label: what is done.
        quiet: show no bar.
    """
    if quiet or not sys.stderr.isatty():
        yield None
        return
    start, span = float(scene._start), float(scene._end - scene._start)
    with click.progressbar(length=_STEPS, label=label, file=sys.stderr) as bar:
        yield lambda time: bar.update(int(_STEPS * (float(time) - start) / span) - bar.pos)
