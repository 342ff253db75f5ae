"""A probe beside a mistake: whether a case runs the changed line."""

from __future__ import annotations

import ast
import functools
from collections.abc import Callable, Iterator
from typing import Any, Final, NamedTuple

__all__ = ["NAME", "PROBE", "Probe", "insert_probe", "probed"]

NAME: Final = "__probe__"
"""The name of the probe among the globals of a changed function."""


class Probe:
    """Says whether a changed line has been run since somebody asked."""

    def __init__(self) -> None:
        self.is_reached = False

    def take(self) -> bool:
        """Return True if the line has been run since the last call."""
        was_reached, self.is_reached = self.is_reached, False
        return was_reached


PROBE: Final = Probe()
"""The probe of this process, in which one mistake is made."""


class _Place(NamedTuple):
    """A place in a list of statements, before one of them."""

    block: list[ast.stmt]
    number: int

    @property
    def statement(self) -> ast.stmt:
        """The statement."""
        return self.block[self.number]


def insert_probe(function: ast.FunctionDef, line: int) -> None:
    """Put a statement that sets the probe before the innermost statement of a line."""
    around = [
        place
        for place in _places(function)
        if place.statement.lineno <= line <= (place.statement.end_lineno or 0)
    ]
    innermost = max(around, key=lambda place: place.statement.lineno)
    (sets_it,) = ast.parse(f"{NAME}.is_reached = True").body
    for node in ast.walk(sets_it):
        ast.copy_location(node, innermost.statement)
    innermost.block.insert(innermost.number, sets_it)


def _places(function: ast.FunctionDef) -> Iterator[_Place]:
    """Yield the places of all statements of a function, those of loops and branches too."""
    for node in ast.walk(function):
        for field in ("body", "orelse", "finalbody"):
            block = getattr(node, field, None)
            if isinstance(block, list):
                yield from (_Place(block, number) for number in range(len(block)))


def probed(wrong: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that sets the probe, and does what another one does."""

    @functools.wraps(wrong)
    def function(*args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - those of any function
        PROBE.is_reached = True
        return wrong(*args, **kwargs)

    return function
