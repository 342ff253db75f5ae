"""Data that a reader leaves out of a file, or a writer of a scene: counted by kind, named once."""

from __future__ import annotations

from collections.abc import Iterable
from typing import final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten


@final
class Losses:
    """The kinds of data that were left out, in the order in which they were found.

    >>> losses = Losses()
    >>> losses.add("crs")
    >>> losses.count("z", "point", 39)
    >>> losses.count("z", "point")
    >>> losses.unlocated("feature 7")
    >>> losses.texts()
    ('crs', 'z of 40 points', 'feature 7 has no geometry (null)')
    """

    def __init__(self) -> None:
        self._counts: dict[tuple[str, str], int] = {}
        self._unlocated: list[str] = []

    def add(self, what: str) -> None:
        """Add data that a file has once, or that need no number."""
        self._counts[shorten(what)[1:-1], ""] = 1

    def count(self, what: str, of: str, number: int = 1) -> None:
        """Add data of a number of things, such as the z of a "point"."""
        key = shorten(what)[1:-1], of
        self._counts[key] = self._counts.get(key, 0) + number

    def unlocated(self, where: str) -> None:
        """Add a feature without a geometry, which becomes no body."""
        self._unlocated.append(where)

    def texts(self) -> tuple[str, ...]:
        """Return a text for each kind."""
        found = [
            f"{what} of {counted(number, of)}" if of else what
            for (what, of), number in self._counts.items()
        ]
        if self._unlocated:
            first, *others = self._unlocated
            named = f"{first} and {len(others)} more have" if others else f"{first} has"
            found.append(f"{named} no geometry (null)")
        return tuple(found)


def lost_line(texts: Iterable[str]) -> str:
    """Return the line that names the data that were left out."""
    return f"lost: {', '.join(texts)}"


def check_strict(texts: Iterable[str]) -> None:
    """Refuse to leave anything out.

    Raises:
        InputError: if there is a text.
    """
    found = tuple(texts)
    if found:
        raise InputError(
            f"{lost_line(found)}; leave out --strict (in Python strict=) to go on without"
        )
