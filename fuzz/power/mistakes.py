"""Mistakes that are hunted: those of `fuzz.planted`, and mutants, in one form."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Final, NamedTuple

from fuzz.planted import PLANTED
from fuzz.power.edits import Lines
from fuzz.power.mutants import Mutant

__all__ = ["Mistake", "of_mutant", "planted"]


class Mistake(NamedTuple):
    """A mistake.

    Attributes:
        name: what it is.
        lines: the lines that are changed.
        make: makes it in this process, for good.
        is_masked: True if no answer can show it, for the reason that `fuzz.planted` states.
    """

    name: str
    lines: Lines
    make: Callable[[], object]
    is_masked: bool = False


_ENTERED: Final[list[AbstractContextManager[object]]] = []
"""Contexts in which mistakes are made: one that nobody refers to is closed, and unmade, at once."""


def planted() -> list[Mistake]:
    """Return the mistakes of `fuzz.planted`."""
    return [_planted(name) for name in PLANTED]


def _planted(name: str) -> Mistake:
    mistake = PLANTED[name]

    def make() -> None:
        context = mistake.made()
        _ENTERED.append(context)
        context.__enter__()

    return Mistake(name, mistake.change.lines, make, bool(mistake.masked))


def of_mutant(mutant: Mutant) -> Mistake:
    """Return a mutant as a mistake."""
    return Mistake(mutant.name, mutant.lines, mutant.make)
