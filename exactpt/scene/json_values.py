"""JSON with exact numbers, and its validation.

Numbers never pass through a float: `parse_rational` gets JSON numbers as the text in the
file.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from math import inf
from typing import Any, Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, parse_rational, shorten
from exactpt.motion.body import is_text

VERSION: Final = 1
"""The version of the file format (docs/format.md)."""
MAX_DIGITS: Final = 10_000
"""Maximum number of digits of a numerator or denominator, to bound the cost of arithmetic."""
MAX_BITS: Final = 33_220
"""Bit length of the largest integer with `MAX_DIGITS` digits."""

DEEPEST: Final = 32
"""Number of lists and objects around each other, from the scene itself on."""
LONGEST: Final = 640
"""Number of digits from which on an integer stays a text: Python's limit is not below it."""

_LONG: Final = 10 ** (LONGEST - 1)
"""The least integer that stays a text when it is read."""


class Number(str):
    """The text of a JSON number."""

    __slots__ = ()


Json: TypeAlias = "bool | str | list[Json] | dict[str, Json] | None"
"""A parsed JSON value; numbers are `Number`, so they stay text."""


def parse_json(text: str) -> Json:
    """Return the value of a JSON text, numbers as they are written.

    Raises:
        InputError: if it is not JSON, repeats a key, or is nested too deeply.
    """
    try:
        data: Json = json.loads(
            text,
            parse_int=Number,
            parse_float=Number,
            parse_constant=Number,  # NaN and infinities: refused later, with their place
            object_pairs_hook=unique_keys,
        )
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(f"not JSON: {error.msg} at {where}") from None
    except RecursionError:
        raise InputError("not JSON: nested too deeply") from None
    return data


def unique_keys(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    """Return the object of these keys and values, for `json.loads`.

    Raises:
        InputError: if a key is there twice.
    """
    result: dict[str, Json] = {}
    for key, value in pairs:
        if key in result:
            raise InputError(f"the key {shorten(key)} is there twice")
        result[key] = value
    return result


def exact_number(data: Json, where: str) -> QQ:
    """Return the rational that a number or a string denotes.

    Raises:
        InputError: if it is not a rational, or has more than `MAX_DIGITS`.
    """
    if not isinstance(data, str):
        raise InputError(f"{where}: not a number: {shown(data)}")
    try:
        value = QQ(0) if len(data) > 3 * MAX_DIGITS else parse_rational(data)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None
    if len(data) > 3 * MAX_DIGITS or is_too_long(value):
        raise InputError(f"{where}: more than {MAX_DIGITS} digits: {shorten(str(data))}")
    return value


def is_too_long(value: QQ) -> bool:
    """Return True if a number has more than `MAX_DIGITS`."""
    return max(value.numerator.bit_length(), value.denominator.bit_length()) > MAX_BITS


def a_list(data: Json, where: str, length: int | None = None) -> list[Json]:
    """Return the entries of a list, of this length if one is given.

    Raises:
        InputError: if it is not such a list.
    """
    if not isinstance(data, list):
        raise InputError(f"{where}: not a list: {shown(data)}")
    if length is not None and len(data) != length:
        raise InputError(f"{where}: {length} entries are needed, not {len(data)}: {shown(data)}")
    return data


def an_object(
    data: Json,
    where: str,
    required: Iterable[str] = (),
    optional: Iterable[str] = (),
) -> dict[str, Json]:
    """Return an object with all of the required keys, and no others but the optional ones.

    Raises:
        InputError: if it is not such an object.
    """
    if not isinstance(data, dict):
        raise InputError(f"{where}: not an object: {shown(data)}")
    for key in required:
        if key not in data:
            raise InputError(f'{where}: the key "{key}" is missing')
    unknown = set(data) - set(required) - set(optional)
    if unknown:
        raise InputError(
            f"{where}: unknown key {shorten(min(unknown))}: {shown(data[min(unknown)])}"
        )
    return data


def properties_in(data: Json, where: str) -> dict[str, object]:
    """Return the properties of a body, which have no meaning here.

    Raises:
        InputError: if it is not an object, is nested too deeply, or has a text or a number that
            JSON does not have.
    """
    if not isinstance(data, dict):
        raise InputError(f"{where}: not an object: {shown(data)}")
    _check_json(data, where, DEEPEST - 3)
    return {key: plain(value) for key, value in data.items()}


def _check_json(data: Json, where: str, levels: int) -> None:
    """Check a value that has no meaning here; ``levels`` is how deep it may be."""
    inside = [*data, *data.values()] if isinstance(data, dict) else data
    if isinstance(inside, list):
        if not levels:
            raise InputError(f"{where}: nested more than {DEEPEST} deep")
        for value in inside:
            _check_json(value, where, levels - 1)
    elif isinstance(inside, Number) and not inside[-1].isdigit():
        raise InputError(f"{where}: not a number of JSON: {shown(inside)}")
    elif isinstance(inside, str) and inside and not is_text(inside):
        raise InputError(f"{where}: not a text: {shown(inside)}")


def plain(data: Json) -> object:
    """Return a value with numbers of Python; one that is beyond the doubles stays a text."""
    if isinstance(data, Number):
        digits = data.removeprefix("-")
        number = int(data) if digits.isdigit() and len(digits) < LONGEST else float(data)
        return str(data) if number in (inf, -inf) else number
    if isinstance(data, dict):
        return {key: plain(value) for key, value in data.items()}
    return [plain(value) for value in data] if isinstance(data, list) else data


def with_long_texts(value: Any) -> Any:  # noqa: ANN401 - JSON
    """Return a value of JSON with its long integers as texts: a reader gets these, too."""
    if isinstance(value, dict):
        return {key: with_long_texts(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [with_long_texts(part) for part in value]
    is_long = isinstance(value, int) and abs(value) >= _LONG
    return str(QQ(value)) if is_long else value


def shown(data: Json) -> str:
    """Return a value as text for a message, short and on one line."""
    if isinstance(data, (Number, bool)) or data is None:
        return shorten(str(data) if isinstance(data, Number) else json.dumps(data))[1:-1]
    return shorten(json.loads(json.dumps(data)) if isinstance(data, (list, dict)) else data)
