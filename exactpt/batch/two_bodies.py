"""Scenes of two bodies that translate, read without building them: their doubles, and their texts.

Whatever is not plainly such a scene is left to `exactpt.scene.format`, errors included.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from typing import Final, NamedTuple, NoReturn, TypeAlias

from exactpt.kernel.numbers import QQ, parse_rational
from exactpt.motion.body import is_text
from exactpt.scene.json_values import Number

__all__ = ["Moving", "TwoBodies", "exact", "read_two_bodies"]

Raw: TypeAlias = "int | str"
"""A number as it is written: a JSON integer, or the text of another number."""

LONGEST: Final = 10_000
"""Maximum number of characters: none of the numbers can have more digits than the format allows."""
TOP: Final = {"exactpt", "time", "bodies"}
BODY: Final = {"name", "vertices", "motion", "closed"}
AXES: Final = {"x", "y"}
SMALLEST: Final = 1e-270
LARGEST: Final = 1e270
"""Sizes between which the nearest double has a relative error of at most U."""

_TEXT: Final = re.compile(r"(-?[0-9]+)(?:/([0-9]+)|\.[0-9]+)?", re.ASCII)


class _Other(Exception):  # noqa: N818 - not an error of the input
    """The text is not plainly a scene of two bodies that translate."""


class Moving(NamedTuple):
    """A body that translates, its numbers as they are written.

    Attributes:
        name: its name.
        vertices: the rows (x, y).
        motion: the coefficients in x and in y, the constant first; at most three each.
        closed: False for an open chain.
    """

    name: str
    vertices: Sequence[Sequence[Raw]]
    motion: tuple[Sequence[Raw], Sequence[Raw]]
    closed: bool


class TwoBodies(NamedTuple):
    """A scene of two bodies.

    Attributes:
        bodies: the two.
        time: the start and the end, as they are written.
        span: the start, which is a double, and a double after the end.
        points: the vertices as nearest doubles, those of both bodies one after the other.
        coefficients: for each body six doubles: those of x, then those of y.
    """

    bodies: tuple[Moving, Moving]
    time: tuple[Raw, Raw]
    span: tuple[float, float]
    points: list[tuple[float, float]]
    coefficients: list[float]


def read_two_bodies(content: bytes) -> TwoBodies | None:
    """The scene in a line of JSON if it plainly is one of two bodies that translate, else None."""
    if len(content) > LONGEST:
        return None
    try:
        return _scene(_DECODER.decode(content.decode()))
    except (_Other, KeyError, TypeError, ValueError, ArithmeticError, RecursionError):
        return None


def exact(number: Raw) -> QQ:
    """The number that is written."""
    return QQ(number) if isinstance(number, int) else parse_rational(number)


def _scene(data: object) -> TwoBodies:
    if type(data) is not dict or data.keys() != TOP:
        raise _Other
    if type(data["exactpt"]) is not int or data["exactpt"] != 1:
        raise _Other
    time, bodies = data["time"], data["bodies"]
    if type(time) is not list or type(bodies) is not list or len(bodies) != 2:
        raise _Other
    points: list[tuple[float, float]] = []
    coefficients: list[float] = []
    a, b = (_body(body, points, coefficients) for body in bodies)
    start, end = time
    first, last = _double(start), _double(end)
    if a.name == b.name or first >= last or exact(start) != QQ(*first.as_integer_ratio()):
        raise _Other
    span = first, math.nextafter(last, math.inf)
    return TwoBodies((a, b), (start, end), span, points, coefficients)


def _body(
    data: dict[str, object], points: list[tuple[float, float]], coefficients: list[float]
) -> Moving:
    if type(data) is not dict or not data.keys() <= BODY:
        raise _Other
    name, rows, closed = data["name"], data["vertices"], data.get("closed", True)
    if type(name) is not str or not is_text(name) or type(closed) is not bool:
        raise _Other
    if type(rows) is not list or not rows or (len(rows) > 3 and rows[0] == rows[-1]):
        raise _Other
    for row in rows:
        if type(row) is not list:
            raise _Other
        x, y = row
        points.append((_double(x), _double(y)))
    motion = data.get("motion", {})
    if type(motion) is not dict or not motion.keys() <= AXES:
        raise _Other
    axes = motion.get("x", []), motion.get("y", [])
    for axis in axes:
        if type(axis) is not list or len(axis) > 3:
            raise _Other
        coefficients += map(_double, axis)
        coefficients += [0.0] * (3 - len(axis))
    return Moving(name, rows, axes, closed)


def _double(number: object) -> float:
    """The nearest double to a number that is 0 or neither tiny nor huge."""
    if type(number) is int:
        x = float(number)
        if abs(x) < LARGEST:
            return x
    elif type(number) is Number:
        x = float(number)
        if SMALLEST < abs(x) < LARGEST or not number.strip("-0."):
            return x
    elif type(number) is str:
        match = _TEXT.fullmatch(number)
        if match is not None:
            p, q = match.groups()
            x = float(number) if q is None else int(p) / int(q)
            if SMALLEST < abs(x) < LARGEST or not (number if q is None else p).strip("-0."):
                return x
    raise _Other


def _unique_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
    data = dict(pairs)
    if len(data) < len(pairs):
        raise _Other
    return data


def _no_number(_text: str) -> NoReturn:
    raise _Other


_DECODER: Final = json.JSONDecoder(
    parse_float=Number, parse_constant=_no_number, object_pairs_hook=_unique_keys
)
