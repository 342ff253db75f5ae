"""Lengths, transforms, points and path data of drawings, in pixels of doubles."""

from __future__ import annotations

import math
import re
from itertools import pairwise
from typing import Final, NamedTuple

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, parse_rational, shorten

MILLIMETRES: Final[dict[str, QQ]] = {
    "mm": QQ(1),
    "cm": QQ(10),
    "Q": QQ(1, 4),
    "in": QQ(127, 5),
    "pt": QQ(127, 360),
    "pc": QQ(127, 30),
    "px": QQ(127, 480),
}
"""Millimetres in each physical unit of CSS: an inch has 25.4 mm, 96 px, 72 pt and 6 pc."""
PIXEL: Final = MILLIMETRES["px"]

_NUMBER: Final = r"[+-]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?"
_LENGTH: Final = re.compile(rf"({_NUMBER})\s*+(%|[A-Za-z]*+)", re.ASCII)
_ANGLES: Final = {"": 1.0, "deg": 1.0, "grad": 0.9, "turn": 360.0, "rad": 180 / math.pi}
_FUNCTION: Final = re.compile(r"[\s,]*+([A-Za-z]++)\s*+\(([^()]*+)\)[\s,]*+")
_ARGUMENT: Final = re.compile(rf"[\s,]*+({_NUMBER})(%|[A-Za-z]*+)[\s,]*+", re.ASCII)
_POINTS: Final = re.compile(rf"[\s,]*+({_NUMBER})[\s,]*+", re.ASCII)
_PATH: Final = re.compile(rf"(?:[\s,]++|[MmZzLlHhVvCcSsQqTtAa]|{_NUMBER})*+", re.ASCII)
_TOKEN: Final = re.compile(rf"[A-Za-z]|{_NUMBER}", re.ASCII)
_ALIGN: Final = re.compile(r"(?:defer )?(none|x(Min|Mid|Max)Y(Min|Mid|Max))(?: (meet|slice))?")
_LONGEST: Final = 24
"""Number of characters of the longest `repr` of a double."""


class Length(NamedTuple):
    """A number with a unit, "" if it has none."""

    number: str
    unit: str

    @property
    def millimetres(self) -> QQ:
        """The exact length; without a unit it is in pixels."""
        return parse_rational(self.number) * MILLIMETRES[self.unit or "px"]


def length_of(text: str, where: str) -> Length:
    """Return the length in a text, with the spelling of units in `MILLIMETRES`.

    Raises:
        InputError: if it is not one, or in a unit that depends on a font or a window.
    """
    match = _LENGTH.fullmatch(text.strip())
    if match is None:
        raise InputError(f"{where}: not a length: {shorten(text)}")
    number, unit = match.groups()
    spelled = {known.lower(): known for known in MILLIMETRES}.get(unit.lower(), unit)
    if spelled not in MILLIMETRES and spelled not in ("", "%"):
        raise InputError(f"{where}: the unit {shorten(unit)} has no size here; use px or mm")
    return Length(number, spelled)


def pixels(text: str, whole: float | None, where: str) -> float:
    """Return a length in pixels.

    Args:
        text: the length.
        whole: the length of 100%, if that is known.
        where: its place, for messages.

    Raises:
        InputError: if it is not one, or not finite.
    """
    length = length_of(text, where)
    value = float(length.number)
    if length.unit == "%":
        if whole is None:
            raise InputError(f"{where}: {shorten(text)} of an unknown size; give a viewBox")
        value *= whole / 100
    elif length.unit:
        value *= float(MILLIMETRES[length.unit] / PIXEL)
    if not math.isfinite(value):
        raise InputError(f"{where}: not a finite number: {shorten(text)}")
    return value


class Matrix(NamedTuple):
    """An affine map: x' = a x + c y + e, y' = b x + d y + f."""

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def then(self, inner: Matrix) -> Matrix:
        """Return the map of an element within: ``inner`` first, then this one."""
        a, b, c, d, e, f = self
        return Matrix(
            a * inner.a + c * inner.b,
            b * inner.a + d * inner.b,
            a * inner.c + c * inner.d,
            b * inner.c + d * inner.d,
            a * inner.e + c * inner.f + e,
            b * inner.e + d * inner.f + f,
        )

    @property
    def stretch(self) -> float:
        """The largest factor by which it lengthens a segment: its largest singular value."""
        plus = math.hypot(self.a + self.d, self.b - self.c)
        minus = math.hypot(self.a - self.d, self.b + self.c)
        return (plus + minus) / 2

    def inverse(self) -> Matrix | None:
        """Return the inverse map; None if there is none."""
        a, b, c, d, e, f = self
        area = a * d - b * c
        if not (area and math.isfinite(area)):
            return None
        return Matrix(
            d / area, -b / area, -c / area, a / area, (c * f - d * e) / area, (b * e - a * f) / area
        )


def moved(x: float, y: float) -> Matrix:
    """Return a translation."""
    return Matrix(e=x, f=y)


def matrix_of(transform: str, where: str) -> Matrix:
    """Return the map of a ``transform``.

    >>> matrix_of("translate(3, 4) rotate(90)", "g")
    Matrix(a=0.0, b=1.0, c=-1.0, d=0.0, e=3.0, f=4.0)

    Raises:
        InputError: if it is not a list of functions of the plane.
    """
    whole, at = Matrix(), 0
    while transform.strip() != "none" and at < len(transform.rstrip()):
        function = _FUNCTION.match(transform, at)
        if function is None:
            raise InputError(f"{where}: transform: {shorten(transform)} is not understood")
        one = _function(function[1], function[2])
        if one is None or not all(map(math.isfinite, one)):
            raise InputError(f"{where}: transform: {shorten(function[0])} is not understood")
        whole, at = whole.then(one), function.end()
    return whole


def _function(name: str, text: str) -> Matrix | None:
    """Return the map of a function; None if it is none of the plane."""
    found: list[tuple[float, str]] = []
    at = 0
    while at < len(text.rstrip()):
        argument = _ARGUMENT.match(text, at)
        if argument is None:
            return None
        found.append((float(argument[1]), argument[2]))
        at = argument.end()
    numbers, units = [number for number, _ in found], [unit for _, unit in found]
    turns = name in ("rotate", "skewX", "skewY", "skew")
    if any(unit not in (_ANGLES if turns else ("", "px")) for unit in units):
        return None
    match name, len(numbers):
        case "matrix", 6:
            return Matrix(*numbers)
        case (("translate" | "translateX"), 1):
            return moved(numbers[0], 0.0)
        case "translateY", 1:
            return moved(0.0, numbers[0])
        case "translate", 2:
            return moved(*numbers)
        case "scale", 1:
            return Matrix(a=numbers[0], d=numbers[0])
        case "scale", 2:
            return Matrix(a=numbers[0], d=numbers[1])
        case "scaleX", 1:
            return Matrix(a=numbers[0])
        case "scaleY", 1:
            return Matrix(d=numbers[0])
        case "rotate", 1:
            return _turned(numbers[0] * _ANGLES[units[0]])
        case "rotate", 3 if units[1:] == ["", ""]:
            x, y = numbers[1:]
            return moved(x, y).then(_turned(numbers[0] * _ANGLES[units[0]])).then(moved(-x, -y))
        case "skewX", 1:
            return Matrix(c=math.tan(math.radians(numbers[0] * _ANGLES[units[0]])))
        case "skewY", 1:
            return Matrix(b=math.tan(math.radians(numbers[0] * _ANGLES[units[0]])))
    return None


def _turned(degrees: float) -> Matrix:
    """Return a turn; by a multiple of a right angle it is exact."""
    quarters, rest = divmod(degrees, 90.0)
    if rest == 0:
        cos, sin = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][int(quarters % 4)]
    else:
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return Matrix(cos, sin, -sin, cos)


class Alignment(NamedTuple):
    """How a viewBox fills its viewport, ``preserveAspectRatio``.

    Attributes:
        x: the part of free width before the box; None if the box is stretched.
        y: likewise of height.
        slice: whether the box covers the viewport, instead of being inside of it.
    """

    x: float | None = 0.5
    y: float | None = 0.5
    slice: bool = False


def alignment_of(text: str | None, where: str) -> Alignment:
    """Return the meaning of ``preserveAspectRatio``; by default a centred box inside.

    Raises:
        InputError: if it is not understood.
    """
    if text is None:
        return Alignment()
    match = _ALIGN.fullmatch(" ".join(text.split()))
    if match is None:
        raise InputError(f"{where}: preserveAspectRatio: {shorten(text)} is not understood")
    if match[1] == "none":
        return Alignment(None, None)
    part = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    return Alignment(part[match[2]], part[match[3]], match[4] == "slice")


class Box(NamedTuple):
    """A ``viewBox``, as it is written."""

    x: str
    y: str
    width: str
    height: str

    @property
    def size(self) -> tuple[float, float]:
        """Its width and height."""
        return float(self.width), float(self.height)


def box_of(text: str | None, where: str) -> Box | None:
    """Return a ``viewBox``; None if there is none.

    Raises:
        InputError: if it is not four numbers, or has no size.
    """
    if text is None:
        return None
    numbers = text.replace(",", " ").split()
    if len(numbers) != 4 or not all(_POINTS.fullmatch(number) for number in numbers):
        raise InputError(f"{where}: viewBox: not four numbers: {shorten(text)}")
    box = Box(*numbers)
    if not all(math.isfinite(side) and side > 0 for side in box.size):
        raise InputError(f"{where}: viewBox: it has no size: {shorten(text)}")
    return box


def checked_path(data: str, where: str) -> str:
    """Return path data that consist of commands and numbers alone.

    Raises:
        InputError: if there is something else, which the parser would skip.
    """
    match = _PATH.match(data)
    end = 0 if match is None else match.end()
    if end < len(data):
        raise InputError(f"{where}: path data: {shorten(data[end:])} is not understood")
    return data


class Rectangle(NamedTuple):
    """An upright rectangle in pixels: its least x and y, its width and its height."""

    x: float
    y: float
    width: float
    height: float


def rectangle_of(data: str) -> Rectangle | None:
    """Return the upright rectangle that path data draw.

    >>> rectangle_of("M1 2h30v4L1 6z")
    Rectangle(x=1.0, y=2.0, width=30.0, height=4.0)
    >>> rectangle_of("M1 2h30v4z") is None
    True

    Returns:
        The rectangle; None if the path is something else, or has curves.
    """
    if data.upper().count("M") != 1:
        return None
    tokens = _TOKEN.findall(data)
    corners: list[tuple[float, float]] = []
    command, at = "", 0
    while at < len(tokens):
        if tokens[at].isalpha():
            command, at = tokens[at], at + 1
            continue
        count = 1 if command in "HhVv" else 2
        numbers = [float(token) for token in tokens[at : at + count] if not token.isalpha()]
        if command not in "MmLlHhVv" or not command or len(numbers) != count:
            return None
        last = corners[-1] if corners else (0.0, 0.0)
        from_last = last if command.islower() else (0.0, 0.0)
        match command.upper():
            case "H":
                corners.append((from_last[0] + numbers[0], last[1]))
            case "V":
                corners.append((last[0], from_last[1] + numbers[0]))
            case _:
                corners.append((from_last[0] + numbers[0], from_last[1] + numbers[1]))
        at += count
    if len(corners) == 5 and corners[0] == corners[-1]:
        corners.pop()
    xs, ys = ({corner[axis] for corner in corners} for axis in (0, 1))
    turns_each_time = all((p[0] == q[0]) != (p[1] == q[1]) for p, q in pairwise(corners))
    if not (len(corners) == len(set(corners)) == 4 and len(xs) == len(ys) == 2 and turns_each_time):
        return None
    return Rectangle(min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys))


def checked_points(text: str, where: str) -> str:
    """Return the points of a polygon with numbers in at most 24 characters each.

    The parser takes quadratic time for longer numbers; the doubles are the same.

    Raises:
        InputError: if they are not pairs of numbers.
    """
    numbers: list[str] = []
    at = 0
    while at < len(text.rstrip()):
        number = _POINTS.match(text, at)
        if number is None:
            raise InputError(f"{where}: points: {shorten(text[at:])} is not understood")
        numbers.append(_short(number[1]))
        at = number.end()
    if len(numbers) % 2:
        raise InputError(f"{where}: points: an odd number of coordinates")
    pairs = zip(numbers[::2], numbers[1::2], strict=True)
    return " ".join(f"{x},{y}" for x, y in pairs)


def _short(number: str) -> str:
    if len(number) <= _LONGEST:
        return number
    return repr(float(number)).replace("inf", "1e999")
