"""Names of bodies in the text of an option."""

from __future__ import annotations

import csv

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten


def names_in(text: str, option: str) -> list[str]:
    """Return the names in a text, separated by commas and perhaps quoted, as in CSV."""
    try:
        (names,) = csv.reader([text], strict=True)
    except (csv.Error, ValueError):
        raise InputError(f"{option}: quotes that do not match: {shorten(text)}") from None
    return names


def two_names(text: str, option: str) -> tuple[str, str]:
    """Return the names of two bodies in a text."""
    names = names_in(text, option)
    if len(names) != 2:
        raise InputError(f"{option}: not the names of two bodies: {shorten(text)}")
    return names[0], names[1]
