"""The units of a scene's numbers, and the date of its time 0: for people, nothing is converted."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from typing import Final, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import is_text

LONGEST: Final = 32
"""Maximum number of characters of a unit."""

OF_DATES: Final = ("ns", "us", "ms", "s", "min", "h", "day")
"""The units of time in which a date can be counted."""

_BREAKS: Final = ("Cc", "Zl", "Zp")
"""The categories of control characters, and of separators of lines and of paragraphs."""

_HOUR_AND_MINUTE: Final = r"(?:[01]\d|2[0-3]):[0-5]\d"
_DATE_AND_TIME: Final = re.compile(
    rf"(?P<day>\d{{4}}-\d\d-\d\d)[Tt ]{_HOUR_AND_MINUTE}:[0-5]\d(?:\.\d{{1,30}})?"
    rf"(?:[Zz]|[+-]{_HOUR_AND_MINUTE})",
    re.ASCII,
)
"""A date with a time and a zone, by RFC 3339; whether there is such a day is another question."""


@final
@dataclass(frozen=True, slots=True)
class Units:
    """What the numbers of a scene count, as texts for people.

    >>> Units(length="mm", time="s").length
    'mm'

    Attributes:
        length: the unit of coordinates, radii and distances; None if it is not said.
        time: the unit of times; None if it is not said. Any text, but with an epoch one of "ns",
            "us", "ms", "s", "min", "h" and "day".

    Raises:
        InputError: if both are missing; or if one is not a text, is empty, has more than 32
            characters, or has a line break or a control character.
    """

    length: str | None = None
    time: str | None = None

    def __post_init__(self) -> None:
        if self.length is None and self.time is None:
            raise InputError(
                "units: a length or a time is needed, got neither; leave the units out"
            )
        for kind, unit in self.given().items():
            _check_unit(kind, unit)

    def given(self) -> dict[str, str]:
        """Return the units that are said, by what they are of."""
        both = {"length": self.length, "time": self.time}
        return {kind: unit for kind, unit in both.items() if unit is not None}

    def __repr__(self) -> str:
        return record_in_brief(self)


def read_units(units: Units | Mapping[str, str] | None) -> Units | None:
    """Return the units that a caller gives.

    Raises:
        InputError: if they are no units; see `Units`.
    """
    if units is None or isinstance(units, Units):
        return units
    if not isinstance(units, Mapping):
        raise InputError(
            f'units: not a mapping of "length" and "time" to texts, got {shorten(units)}'
        )
    unknown = [key for key in units if key not in ("length", "time")]
    if unknown:
        raise InputError(f'units: expected "length" and "time" alone, got {shorten(unknown[0])}')
    for kind, unit in units.items():
        _check_unit(kind, unit)
    return Units(units.get("length"), units.get("time"))


def read_epoch(epoch: object, units: Units | None) -> str | None:
    """Return the date of time 0 that a caller gives, for which the unit of time must be known.

    Raises:
        InputError: if it is not a date with a time and a zone by RFC 3339, or the unit of time is
            missing or another one than `OF_DATES`.
    """
    if epoch is None:
        return None
    if not isinstance(epoch, str) or not _is_date(epoch):
        raise InputError(
            f"epoch: not a date with a time and a zone by RFC 3339, got {shorten(epoch)}; write it "
            f"as 2026-01-01T00:00:00Z, without leap seconds"
        )
    unit = None if units is None else units.time
    if unit not in OF_DATES:
        got = "none" if unit is None else shorten(unit)
        raise InputError(
            f"epoch: it needs a unit of time, one of {', '.join(OF_DATES)}, got {got}; state it in "
            f"the units, or leave the epoch out"
        )
    return epoch


def _check_unit(kind: str, unit: object) -> None:
    advice = f"a unit is a text of 1 to {LONGEST} characters without line breaks"
    if not is_text(unit) or not isinstance(unit, str) or len(unit) > LONGEST:
        raise InputError(f"units: {kind}: {advice}, got {shorten(unit)}")
    if any(unicodedata.category(character) in _BREAKS for character in unit):
        raise InputError(f"units: {kind}: {advice} and control characters, got {shorten(unit)}")


def _is_date(text: str) -> bool:
    """Return True for a date with a time and a zone, of a day in the calendar."""
    match = _DATE_AND_TIME.fullmatch(text)
    if match is None:
        return False
    try:
        date.fromisoformat(match["day"])
    except ValueError:
        return False
    return True
