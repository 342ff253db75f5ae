"""A law, and what a check of one case reports."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Final, TypeAlias

from exactpt import Scene
from exactpt.cgal import find_program
from exactpt.errors import InputError
from fuzz import compiled_copy
from fuzz.old_engine.build import is_built
from fuzz.witnesses import Difference, LeftOutError

__all__ = ["Check", "Law", "check_equal", "refuse_unless"]

Check: TypeAlias = Callable[[Scene, Random], str]
"""Checks a law in one scene, with random choices; returns the outcome in a few words.

It raises `Difference` if the law is broken, and `LeftOutError` if the law says nothing about the
scene. Any other exception is a fault of the package. Outcomes are counted: a law that always has
the same one compares little.
"""


def _has_cgal() -> bool:
    try:
        find_program()
    except InputError:
        return False
    return True


PROGRAMS: Final[dict[str, Callable[[], bool]]] = {
    "cgal": _has_cgal,
    "old engine": is_built,
    "compiled copy": compiled_copy.is_built,
}
"""Other programs that laws run: whether each of them is built."""


@dataclass(frozen=True, slots=True)
class Law:
    """A row: what holds, in which scenes, and its share of the time.

    Attributes:
        check: checks one case.
        sources: patterns of names of sources (`fuzz.laws.scenes.names_of`), taken in turn.
        share: its share of the time, relative to the other laws.
        most: maximum number of vertices of a scene; None for no limit.
        cases: the number of its cases, if it has the same few in each run: those of seed 0.
        needs: the other program that it runs, of `PROGRAMS`; "" for none.
    """

    check: Check
    sources: tuple[str, ...]
    share: float = 1.0
    most: int | None = None
    cases: int | None = None
    needs: str = ""

    @property
    def is_runnable(self) -> bool:
        """False if it needs a program that is not built."""
        return not self.needs or PROGRAMS[self.needs]()

    @property
    def meaning(self) -> str:
        """The first sentence of the documentation of its check."""
        return (self.check.__doc__ or "").split("\n\n")[0].strip()


def check_equal(what: str, found: object, expected: object) -> None:
    """Raise a difference unless two values are equal.

    Raises:
        Difference: if they are not; ``what`` is its kind.
    """
    if found != expected:
        raise Difference(what, f"{found!r}, expected {expected!r}")


def refuse_unless(condition: object) -> None:
    """Leave a case out unless a condition holds.

    Raises:
        LeftOutError: if it does not.
    """
    if not condition:
        raise LeftOutError
