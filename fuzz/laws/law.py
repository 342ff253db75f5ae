"""A law, and what a check of one case reports."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import TypeAlias

from exactpt import Scene
from fuzz.witnesses import Difference, LeftOutError

__all__ = ["Check", "Law", "check_equal", "refuse_unless"]

Check: TypeAlias = Callable[[Scene, Random], str]
"""Checks a law in one scene, with random choices; returns the outcome in a few words.

It raises `Difference` if the law is broken, and `LeftOutError` if the law says nothing about the
scene. Any other exception is a fault of the package. Outcomes are counted: a law that always has
the same one compares little.
"""


@dataclass(frozen=True, slots=True)
class Law:
    """A row: what holds, in which scenes, and its share of the time.

    Attributes:
        check: checks one case.
        sources: patterns of names of sources (`fuzz.laws.scenes.names_of`), taken in turn.
        share: its share of the time, relative to the other laws.
        most: maximum number of vertices of a scene; None for no limit.
        needs_cgal: whether the program cgal_check must be built.
    """

    check: Check
    sources: tuple[str, ...]
    share: float = 1.0
    most: int | None = None
    needs_cgal: bool = False

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
