"""Scenes of two bodies, read without building them: their doubles, and their texts.

The bodies translate, or turn with a linear half turn.

Whatever is not plainly such a scene is left to `exactpt.scene.format`, errors included.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from itertools import chain
from typing import Final, NamedTuple, NoReturn, TypeAlias

from exactpt.kernel.numbers import QQ
from exactpt.motion.body import is_text
from exactpt.scene.json_values import Number

Raw: TypeAlias = "int | str"
"""A number as it is written: a JSON integer, or the text of another number."""

LONGEST: Final = 10_000
"""Maximum number of characters: none of the numbers can have more digits than the format allows."""
TOP: Final = {"exactpt", "time", "bodies"}
BODY: Final = {"name", "vertices", "motion", "closed"}
AXES: Final = {"x", "y"}
RIGID: Final = {"half_turn", "pivot", "orientation", *AXES}
UPRIGHT: Final[tuple[Raw, ...]] = (0, 0, 0, 0, 1, 0)
"""The numbers of `Moving.turn` of a body that does not turn."""
SMALLEST: Final = 1e-270
LARGEST: Final = 1e270
"""Sizes between which the nearest double has a relative error of at most U."""

_TEXT: Final = re.compile(r"(-?[0-9]+)(?:/([0-9]+)|\.[0-9]+)?", re.ASCII)


class _Other(Exception):  # noqa: N818 - not an error of the input
    """The text is not plainly a scene of two such bodies."""


class Moving(NamedTuple):
    """A body, its numbers as they are written.

    Attributes:
        name: its name.
        vertices: the rows (x, y).
        motion: the coefficients in x and in y, the constant first; at most three each.
        closed: False for an open chain.
        turn: two coefficients of the half turn, the pivot, and the orientation.
    """

    name: str
    vertices: Sequence[Sequence[Raw]]
    motion: tuple[Sequence[Raw], Sequence[Raw]]
    closed: bool
    turn: Sequence[Raw] = UPRIGHT


class TwoBodies(NamedTuple):
    """A scene of two bodies.

    Attributes:
        bodies: the two.
        time: the start and the end, as they are written.
        span: the start, which is a double, and a double after the end.
        coefficients: for each body six nearest doubles: those of x, then those of y.
        points: the vertices as nearest doubles x, y, x, ..., those of one body after the other's.
        turns: for each body six nearest doubles, those of its turn; none if both only translate.
    """

    bodies: tuple[Moving, Moving]
    time: tuple[Raw, Raw]
    span: tuple[float, float]
    coefficients: list[float]
    points: list[float]
    turns: list[float]


def read_two_bodies(content: bytes) -> TwoBodies | None:
    """Return the scene of a line of JSON if it plainly has two such bodies, else None."""
    if len(content) > LONGEST:
        return None
    try:
        return _scene(_DECODER.decode(content.decode()))
    except (_Other, KeyError, TypeError, ValueError, ArithmeticError, RecursionError):
        return None


def exact(number: Raw) -> QQ:
    """Return the number that is written, in the grammar of JSON or of `_TEXT`."""
    return QQ(number)


def _scene(data: object) -> TwoBodies:
    if type(data) is not dict or data.keys() != TOP:
        raise _Other
    if type(data["exactpt"]) is not int or data["exactpt"] != 1:
        raise _Other
    time, bodies = data["time"], data["bodies"]
    if type(time) is not list or type(bodies) is not list or len(bodies) != 2:
        raise _Other
    start, end = time
    a, b = map(_body, bodies)
    motions = [[*axis, 0, 0, 0][:3] for body in (a, b) for axis in body.motion]
    turns = [] if a.turn is b.turn is UPRIGHT else [*a.turn, *b.turn]
    numbers = [start, end, *turns, *chain(*motions), *chain(*a.vertices, *b.vertices)]
    first, last, *rest = _doubles(numbers)
    known, rest = rest[: len(turns)], rest[len(turns) :]
    if a.name == b.name or first >= last or exact(start) != QQ(*first.as_integer_ratio()):
        raise _Other
    span = first, math.nextafter(last, math.inf)
    return TwoBodies((a, b), (start, end), span, rest[:12], rest[12:], known)


def _body(data: object) -> Moving:
    if type(data) is not dict or not data.keys() <= BODY:
        raise _Other
    name, rows, closed = data["name"], data["vertices"], data.get("closed", True)
    if type(name) is not str or not is_text(name) or type(closed) is not bool:
        raise _Other
    if type(rows) is not list or set(map(type, rows)) != {list} or set(map(len, rows)) != {2}:
        raise _Other
    if len(rows) > 3 and rows[0] == rows[-1]:
        raise _Other
    motion, turn = data.get("motion", {}), UPRIGHT
    if type(motion) is dict and motion.keys() == {"rigid"}:
        motion = motion["rigid"]
        turn = _turn(motion)
    elif type(motion) is not dict or not motion.keys() <= AXES:
        raise _Other
    x, y = motion.get("x", []), motion.get("y", [])
    if not type(x) is type(y) is list or len(x) > 3 or len(y) > 3:
        raise _Other
    return Moving(name, rows, (x, y), closed, turn)


def _turn(rigid: object) -> tuple[Raw, ...]:
    if type(rigid) is not dict or not rigid.keys() <= RIGID:
        raise _Other
    half_turn, pivot = rigid["half_turn"], rigid.get("pivot", [0, 0])
    orientation = rigid.get("orientation", [1, 0])
    if not type(half_turn) is type(pivot) is type(orientation) is list or len(half_turn) > 2:
        raise _Other
    (px, py), (cosine, sine) = pivot, orientation
    if "orientation" in rigid and exact(cosine) ** 2 + exact(sine) ** 2 != 1:
        raise _Other
    first, second, *_ = *half_turn, 0, 0
    return first, second, px, py, cosine, sine


def _doubles(numbers: list[Raw]) -> list[float]:
    """Return the nearest doubles to numbers of which each is 0 or neither tiny nor huge."""
    kinds = set(map(type, numbers))
    if kinds <= {int, Number}:
        found = [*map(float, numbers)]
    elif kinds <= {int, Number, str}:
        found = [_quotient(n) if type(n) is str else float(n) for n in numbers]
    else:
        raise _Other
    sizes = [*filter(None, map(abs, found))]
    if sizes and not (min(sizes) > SMALLEST and max(sizes) < LARGEST):
        raise _Other
    if not all(_is_zero(n) for x, n in zip(found, numbers, strict=True) if not x):
        raise _Other
    return found


def _quotient(text: str) -> float:
    match = _TEXT.fullmatch(text)
    if match is None:
        raise _Other
    p, q = match.groups()
    return float(text) if q is None else int(p) / int(q)


def _is_zero(number: Raw) -> bool:
    """Return True for the integer 0, or a text whose numerator has no digit other than 0.

    With an exponent it counts as none: the format bounds exponents.
    """
    return number == 0 or not str(number).partition("/")[0].strip("-0.")


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
