"""Well-known text: shapely parses the structure, the decimals are read from the text exactly.

Shapely returns coordinates as doubles, in the order of the text; each is replaced by the
decimal at its position. The number that PostGIS writes before a geometry, ``SRID=4326;``, stays
with the body as the property ``SRID``; z and m are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import accumulate
from typing import Final

from exactpt.errors import InputError
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import DEEPEST, Shape, rounded_rings
from exactpt.scene.json_values import exact_number

_NEXT: Final = re.compile(r"(?:(?<=\))|(?<=EMPTY))[\s;]+(?=[A-Z])", re.IGNORECASE)
"""The separator between two geometries; parts of one geometry are separated by a comma."""
_PARENTHESIS: Final = re.compile(r"[()]")
_NUMBER: Final = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)

_NOTHING: Final = "GEOMETRYCOLLECTION EMPTY"
"""The text of a scene without bodies: well-known text has no other way to write nothing."""
_SRID: Final = re.compile(r"\s*SRID\s*=\s*(\d{1,9})\s*;", re.IGNORECASE | re.ASCII)
"""The number of a coordinate reference system before a geometry."""


def shapes_of(text: str, losses: Losses | None = None) -> Iterator[Shape]:
    """Yield the shapes of a text with one or more geometries, one for each part.

    Args:
        text: the geometries.
        losses: data that are left out are added to these.

    Raises:
        InputError: one line that names the geometry and its fault.
    """
    from exactpt.exchange.shapely_adapter import read_wkt, shapes_of_geometry

    if text.strip().upper() == _NOTHING:
        return
    left_out = losses or Losses()
    for i, whole in enumerate(_NEXT.split(text.strip())):
        where = f"geometry {i}"
        if _depth(whole) > DEEPEST:
            raise InputError(f"{where}: nested more than {DEEPEST} deep")
        srid = _SRID.match(whole)
        part = whole[srid.end() :] if srid else whole
        geometry, size, dimensions, lost = read_wkt(part, where)
        numbers = _NUMBER.findall(part)
        if len(numbers) != size * dimensions:
            raise InputError(
                f"{where}: a coordinate is not a decimal number, or points have different "
                "numbers of them"
            )
        for what in lost:
            left_out.count(what, "point", size)
        exact = [exact_number(number, where) for number in numbers]
        points = list(zip(exact[::dimensions], exact[1::dimensions], strict=True))
        properties = {"SRID": int(srid[1])} if srid else None
        for shape in shapes_of_geometry(geometry, where, f"body {i}", points):
            more = [other._replace(properties=properties) for other in shape.more]
            yield shape._replace(properties=properties, more=more)


def _depth(text: str) -> int:
    """Return the nesting depth of parentheses, since shapely recurses and copies per level."""
    steps = (1 if mark[0] == "(" else -1 for mark in _PARENTHESIS.finditer(text))
    return max(accumulate(steps), default=0)


def wkt_of(shapes: Iterable[Shape]) -> str:
    """Shapes, one per line, without names; coordinates are the nearest doubles."""
    return "".join(f"{_text(shape)}\n" for shape in shapes) or f"{_NOTHING}\n"


def _text(shape: Shape) -> str:
    parts = [
        [", ".join(f"{x!r} {y!r}" for x, y in ring) for ring in rings]
        for rings in rounded_rings(shape)
    ]
    if shape.kind == "point":
        return f"POINT ({parts[0][0]})"
    if shape.kind == "line":
        return f"LINESTRING ({parts[0][0]})"
    closed = [f"({', '.join(map(_closed, rings))})" for rings in parts]
    return f"MULTIPOLYGON ({', '.join(closed)})" if shape.more else f"POLYGON {closed[0]}"


def _closed(ring: str) -> str:
    return f"({ring}, {ring.split(',', maxsplit=1)[0]})"
