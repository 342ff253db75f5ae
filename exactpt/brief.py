"""Values in one short line: the ``repr`` of public values, and values in messages."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from fractions import Fraction
from reprlib import Repr
from typing import Any, Final, final

LONGEST: Final = 200
"""Maximum number of characters of a ``repr``, and of a value in a message."""

_LONG_BITS: Final = 2000
"""Python writes all integers with fewer bits (640 digits), whatever its limit on digits is."""

_FIRST: Final = 50
"""Maximum number of digits that are kept of the beginning of a long integer."""

_LAST: Final = 8
"""Number of characters that are kept of the end of a value that is cut."""

_PLURALS: Final = {
    "body": "bodies",
    "family": "families",
    "geometry": "geometries",
    "vertex": "vertices",
}
"""The plurals of nouns that do not only get an s."""


def cut(text: str, limit: int = LONGEST) -> str:
    """Return a text with "..." instead of its middle, if it is longer than the limit.

    >>> cut("abcdefghijklmnopqrstuvwxyz", 20)
    'abcdefghi...stuvwxyz'
    """
    return text if len(text) <= limit else f"{text[: limit - _LAST - 3]}...{text[-_LAST:]}"


def cut_words(text: str) -> str:
    """Return a text in which each word is cut, so that a long name leaves the others readable."""
    return " ".join(map(cut, text.split(" ")))


@final
class _Brief(Repr):
    """A ``repr`` with few items of each collection and few characters of each other value."""

    def __init__(self, items: int, characters: int) -> None:
        super().__init__()
        self.maxlevel = 5
        self.maxtuple = self.maxlist = self.maxdict = items
        self.maxset = self.maxfrozenset = self.maxdeque = self.maxarray = items
        self.maxstring = self.maxlong = self.maxother = characters

    def repr_int(self, x: int, _level: int) -> str:
        """Return the first and the last digits of a long integer."""
        if x.bit_length() <= _LONG_BITS:
            return cut(repr(x), max(self.maxlong, _LAST + 4))
        # Python writes no integer beyond a limit, which a caller may have lowered.
        size, sign = abs(x), "-" * (x < 0)
        count = size.bit_length() * 30103 // 100_000  # at most the number of digits
        first = str(size // 10 ** (count - _FIRST))[: max(1, self.maxlong - _LAST - 3)]
        return f"{sign}{first[:_FIRST]}...{size % 10**_LAST:08}"

    def repr_Fraction(self, x: Fraction, level: int) -> str:  # noqa: N802 - the name of the type
        """Return the numerator and the denominator, each of them cut."""
        above, below = (self.repr_int(n, level) for n in (x.numerator, x.denominator))
        return f"Fraction({above}, {below})"

    def repr_bytes(self, x: bytes, _level: int) -> str:
        """Return the size instead of long contents."""
        return repr(x) if len(x) <= self.maxstring else f"<{len(x)} bytes>"

    def repr_ndarray(self, x: Any, _level: int) -> str:  # noqa: ANN401 - numpy is not imported
        """Return the shape, as the ``repr`` of an array has several lines."""
        return f"<array of shape {x.shape}>"

    def repr_instance(self, x: Any, _level: int) -> str:  # noqa: ANN401 - anything
        """Return the ``repr`` of another value in one line, cut."""
        try:
            text = repr(x)
        except Exception:  # the class of a caller may fail in any way
            text = object.__repr__(x)
        return cut(" ".join(text.splitlines()), max(self.maxother, _LAST + 4))


_LEVELS: Final = [_Brief(20, LONGEST), _Brief(6, 60), _Brief(3, 30), _Brief(2, 16), _Brief(1, 12)]
"""From much to little: the first one that fits is taken."""


def in_brief(value: object, limit: int = LONGEST) -> str:
    """Return the ``repr`` of a value in one line of at most ``limit`` characters.

    >>> in_brief([1, "a"])
    "[1, 'a']"
    >>> in_brief(list(range(1000)), 40)
    '[0, 1, 2, 3, 4, 5, ...]'
    >>> in_brief(10**9000 + 7, 40)
    '1000000000000000000...00000007'
    """
    return _fitting((level.repr(value) for level in _LEVELS), limit)


def record_in_brief(record: object, limit: int = LONGEST) -> str:
    """Return the ``repr`` of a dataclass or named tuple in at most ``limit`` characters.

    >>> from exactpt import AlgebraicNumber, ContactInterval
    >>> ContactInterval("a" * 1000, "b", AlgebraicNumber(1), AlgebraicNumber("3/2"))
    ContactInterval(a='aaaaaaa...aaaaaaaa', ...)
    """
    names = getattr(record, "_fields", None)
    if names is None:
        names = [field.name for field in dataclasses.fields(record) if field.repr]  # type: ignore[arg-type]
    fields = [(name, getattr(record, name)) for name in names]
    kind = type(record).__name__
    return _fitting(
        (
            f"{kind}({', '.join(f'{name}={level.repr(value)}' for name, value in fields)})"
            for level in _LEVELS
        ),
        limit,
    )


def call_in_brief(kind: str, *values: object, **named: object) -> str:
    """Return the call that makes a value, cut to at most `LONGEST` characters.

    >>> call_in_brief("Polynomial", ["1", "2/3"])
    "Polynomial(['1', '2/3'])"
    """

    def written(level: _Brief) -> Iterable[str]:
        yield from map(level.repr, values)
        yield from (f"{name}={level.repr(value)}" for name, value in named.items())

    return _fitting((f"{kind}({', '.join(written(level))})" for level in _LEVELS), LONGEST)


def counted(count: int, noun: str) -> str:
    """Return a number with its noun.

    >>> counted(1, "event"), counted(2, "event"), counted(0, "other body")
    ('1 event', '2 events', '0 other bodies')
    """
    *adjectives, last = noun.split(" ")
    many = " ".join([*adjectives, _PLURALS.get(last, f"{last}s")])
    return f"{count} {noun if count == 1 else many}"


def _fitting(texts: Iterable[str], limit: int) -> str:
    """Return the first text that fits; if none does, the last one, cut."""
    text = ""
    for text in texts:
        if len(text) <= limit:
            return text
    return cut(text, limit)
