"""Values of JSON data that were read from a file, each with its place there.

Whoever reads a file of the program's own (a saved run, the journal of a batch) takes every value
through one of the methods of `Stored`: it has the expected type and range, or an error names its
place. A file may be forged, so a number that becomes an index, a count or an exponent must never be
taken as it is.

Scenes, whose numbers are decimals of any length, are read by `exactpt.scene.json_values` instead.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator
from typing import Any, Final, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, ZZ, shorten

LARGEST_INTEGER: Final = (1 << 63) - 1
"""The largest integer of the compiled modules: ids, positions and counts are not above it."""

_INTEGER: Final = re.compile(r"-?\d+\Z", re.ASCII)
_RATIONAL: Final = re.compile(r"(-?\d+)(?:/(\d+))?\Z", re.ASCII)


@final
class Stored:
    """A value that was read, and its place.

    >>> state = Stored({"ring": [0, 1, 7]}, "run.json")
    >>> state["ring"].integers(0, 2)
    Traceback (most recent call last):
    ...
    exactpt.errors.InputError: run.json: "ring"[2]: expected an integer from 0 to 2, got 7

    The text of a place is made when an error needs it.

    Args:
        data: a value as `json.loads` returns it.
        within: the place of the whole, as text; or the list or object that the value is in.
        key: its key or its position there.
    """

    __slots__ = ("_data", "_key", "_within")

    def __init__(self, data: object, within: Stored | str, key: str | int | None = None) -> None:
        self._data: Any = data
        self._within = within
        self._key = key

    @property
    def where(self) -> str:
        """The place, for a message."""
        if isinstance(self._within, str):
            return self._within
        outer = self._within.where
        if isinstance(self._key, int):
            return f"{outer}[{self._key}]"
        return f'{outer}: "{shorten(str(self._key))[1:-1]}"'

    def refused(self, expected: str) -> InputError:
        """Return the error that another value was expected here."""
        return InputError(f"{self.where}: expected {expected}, got {self.shown}")

    @property
    def is_null(self) -> bool:
        """True if the value is null."""
        return self._data is None

    @property
    def shown(self) -> str:
        """The value as short text, for a message."""
        return shorten(self._data)

    @property
    def data(self) -> object:
        """The value itself, for a reader that validates it."""
        return self._data

    # Objects and lists

    def with_keys(self, *required: str, optional: Collection[str] = ()) -> Stored:
        """Return this object, which has all of the required keys and no unknown ones.

        Raises:
            InputError: if it is not such an object.
        """
        if not isinstance(self._data, dict):
            raise self.refused("an object")
        for key in required:
            if key not in self._data:
                raise InputError(f'{self.where}: the key "{key}" is missing')
        unknown = sorted(set(self._data) - set(required) - set(optional))
        if unknown:
            raise InputError(f"{self.where}: unknown key {shorten(unknown[0])}")
        return self

    def __getitem__(self, key: str) -> Stored:
        if not isinstance(self._data, dict):
            raise self.refused("an object")
        if key not in self._data:
            raise InputError(f'{self.where}: the key "{key}" is missing')
        return Stored(self._data[key], self, key)

    def __contains__(self, key: str) -> bool:
        return isinstance(self._data, dict) and key in self._data

    def members_by_key(self) -> dict[str, Any]:
        """Return this object, whose values its reader validates.

        Raises:
            InputError: if it is not an object.
        """
        if not isinstance(self._data, dict):
            raise self.refused("an object")
        return self._data

    def members(self) -> Iterator[tuple[str, Stored]]:
        """Yield the keys and values of this object.

        Raises:
            InputError: if it is not an object.
        """
        for key, value in self.members_by_key().items():
            yield key, Stored(value, self, key)

    def entries(self, length: int | None = None) -> list[Stored]:
        """Return the entries of this list, of this length if one is given.

        Raises:
            InputError: if it is not such a list.
        """
        self._check_list(length)
        return [Stored(value, self, i) for i, value in enumerate(self._data)]

    def _check_list(self, length: int | None) -> None:
        if not isinstance(self._data, list):
            raise self.refused("a list")
        if length is not None and len(self._data) != length:
            raise self.refused(f"a list of {length} entries")

    # Numbers

    def integer(self, least: int, most: int = LARGEST_INTEGER) -> int:
        """Return this integer.

        Raises:
            InputError: if it is not an integer in this range; a boolean is not one.
        """
        value = self._data
        if type(value) is not int or not least <= value <= most:
            raise self.refused(f"an integer {_range(least, most)}")
        return value

    def integers(
        self, least: int, most: int = LARGEST_INTEGER, length: int | None = None
    ) -> list[int]:
        """Return this list of integers.

        Raises:
            InputError: if it is not a list of this length, or an entry is not in this range.
        """
        self._check_list(length)
        values: list[int] = self._data
        if set(map(type, values)) <= {int} and (
            not values or (min(values) >= least and max(values) <= most)
        ):
            return values
        return [entry.integer(least, most) for entry in self.entries()]

    def pairs(self, least: int) -> list[tuple[int, int]]:
        """Return this list of pairs of integers.

        >>> Stored([[0, 1], [2, "3"]], "run.json").pairs(0)
        Traceback (most recent call last):
        ...
        exactpt.errors.InputError: run.json[1][1]: expected an integer from 0, got '3'

        Raises:
            InputError: if it is not a list of pairs, or an integer is less than ``least``.
        """
        self._check_list(None)
        values: list[Any] = self._data
        # Together: only an error needs the place of an entry.
        if all(type(pair) is list and len(pair) == 2 for pair in values):
            numbers = [number for pair in values for number in pair]
            if set(map(type, numbers)) <= {int} and min(numbers, default=least) >= least:
                return [(first, second) for first, second in values]
        found = [entry.integers(least, length=2) for entry in self.entries()]
        return [(first, second) for first, second in found]

    def double(self, *, least: float = -math.inf, most: float = math.inf) -> float:
        """Return this double, as a float.

        Raises:
            InputError: if it is not a number in this range; NaN and an integer that is not a double
                are none.
        """
        value = self._data
        if type(value) is int and -(1 << 53) <= value <= 1 << 53:
            value = float(value)
        if type(value) is not float or not least <= value <= most:
            raise self.refused(f"a double {_range(least, most)}")
        return value

    def rational(self) -> QQ:
        """Return the rational of this text, "p" or "p/q".

        A decimal exponent is not accepted: a few characters would stand for a number that fills
        the memory.

        Raises:
            InputError: if it is no such text.
        """
        match = _RATIONAL.match(self._data) if isinstance(self._data, str) else None
        denominator = ZZ(1) if match is None or match[2] is None else ZZ(match[2])
        if match is None or denominator == 0:
            raise self.refused('a rational as text, "p" or "p/q"')
        return QQ(ZZ(match[1]), denominator)

    def big_integer(self) -> ZZ:
        """Return the integer of this text.

        Raises:
            InputError: if it is no such text.
        """
        if not isinstance(self._data, str) or not _INTEGER.match(self._data):
            raise self.refused("an integer as text")
        return ZZ(self._data)

    # Texts and booleans

    def text(self, choices: Collection[str] | None = None) -> str:
        """Return this text, one of the choices if some are given.

        Raises:
            InputError: if it is not a text, or none of the choices.
        """
        if not isinstance(self._data, str):
            raise self.refused("a text")
        if choices is not None and self._data not in choices:
            raise self.refused(f"one of {', '.join(choices)}")
        return self._data

    def flag(self) -> bool:
        """Return this boolean.

        Raises:
            InputError: if it is not true or false.
        """
        if not isinstance(self._data, bool):
            raise self.refused("true or false")
        return self._data


def _range(least: float, most: float) -> str:
    """Return the range of a number in words."""
    above = "" if most in (math.inf, LARGEST_INTEGER) else f" to {most}"
    return f"from {least}{above}"
