"""GeoJSON (RFC 7946): exact decimals are read, nearest doubles are written.

The format is parsed here: a library would return coordinates as floats. A third coordinate
(the height) is dropped.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Final, TypeAlias

from exactpt.errors import InputError
from exactpt.exchange.shapes import DEEPEST, Kind, Shape, rounded, rounded_rings, together
from exactpt.geometry.polygon import signed_area2
from exactpt.kernel.numbers import shorten
from exactpt.scene.json_values import (
    Json,
    Number,
    a_list,
    exact_number,
    parse_json,
    plain,
    shown,
    with_long_texts,
)

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point

Place: TypeAlias = tuple[float, float]

_PARTS: Final[dict[str, Kind]] = {"Point": "point", "LineString": "line", "Polygon": "polygon"}
TYPES: Final = {
    "Feature",
    "FeatureCollection",
    "GeometryCollection",
    *_PARTS,
    *(f"Multi{kind}" for kind in _PARTS),
}
"""Possible values of the key "type" of a GeoJSON object."""
_TYPE_OF: Final = {kind: name for name, kind in _PARTS.items()}


def is_type(word: Json) -> bool:
    """Return True if it is the type of a GeoJSON object."""
    return isinstance(word, str) and word in TYPES


def shapes_of(text: str) -> Iterator[Shape]:
    """Yield the shapes of a GeoJSON text, named after their features.

    The parts of a MultiPolygon are one shape, those of other geometries are one each.

    The name of a feature is its property ``name`` or ``id`` (in upper or lower case), else its
    own ``id``, else its number.

    >>> from exactpt.exchange.bodies import scene_of
    >>> text = '{"type": "Polygon", "coordinates": [[[0, 0], [0.1, 0], [0, 2], [0, 0]]]}'
    >>> scene_of(shapes_of(text)).bodies[0].at(0)[1]
    (Fraction(1, 10), Fraction(0, 1))

    Raises:
        InputError: one line that names the feature and its fault.
    """
    try:
        data = parse_json(text)
        if not isinstance(data, dict) or not is_type(data.get("type")):
            raise InputError(f"not GeoJSON: {shown(data)}")
        if data["type"] == "FeatureCollection":
            for i, feature in enumerate(a_list(data.get("features"), '"features"')):
                yield from _of_feature(feature, f"feature {i}")
        elif data["type"] == "Feature":
            yield from _of_feature(data, "feature")
        else:
            yield from geometry_shapes(data, "geometry", "body")
    except RecursionError:
        raise InputError("not GeoJSON: nested too deeply") from None


def _of_feature(data: Json, where: str) -> Iterator[Shape]:
    if not isinstance(data, dict) or data.get("type") != "Feature":
        raise InputError(f"{where}: not a feature: {shown(data)}")
    name = name_of(data) or where
    if name != where:
        where = f"{where} ({shorten(name)[1:-1]})"
    if data.get("geometry") is None:
        yield Shape(where, name, "point", ())
        return
    properties = properties_of(data)
    for shape in geometry_shapes(data["geometry"], where, name):
        parts = [part._replace(properties=properties) for part in shape.more]
        yield shape._replace(properties=properties, more=parts)


def properties_of(feature: dict[str, Json]) -> dict[str, object] | None:
    """Return the properties of a feature with numbers of Python; None if it has none."""
    properties = feature.get("properties")
    found = plain(properties) if isinstance(properties, dict) else None
    return found if isinstance(found, dict) else None


def named(name: str, properties: Mapping[str, object] | None) -> dict[str, object]:
    """Return the properties to write for a body: they name it as `shapes_of` names it.

    Raises:
        InputError: if JSON has no such data.
    """
    found: dict[str, object] = {}
    try:
        found |= with_long_texts(dict(properties or {}))
        json.dumps(found, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(f"body {shorten(name)}: properties: {error}") from None
    if name_of({"properties": found}) == name:  # type: ignore[dict-item]
        return found
    return {"name": name, **{key: v for key, v in found.items() if key != "name"}}


def name_of(feature: dict[str, Json]) -> str:
    """Return the name of a feature, see `shapes_of`; empty if it has none."""
    properties = feature.get("properties")
    keys = properties if isinstance(properties, dict) else {}
    lowered = {key.lower(): value for key, value in reversed(keys.items())}
    for value in (lowered.get("name"), lowered.get("id"), feature.get("id")):
        if isinstance(value, str) and value.strip():
            return value.encode(errors="replace").decode()
    return ""


def geometry_shapes(data: Json, where: str, name: str, depth: int = 0) -> Iterator[Shape]:
    """Yield the shapes of a geometry."""
    if depth > DEEPEST:
        raise InputError(f"{where[:60]}...: nested more than {DEEPEST} deep")
    if not isinstance(data, dict) or not is_type(data.get("type")):
        raise InputError(f"{where}: not a geometry: {shown(data)}")
    kind = str(data["type"])
    if kind == "GeometryCollection":
        geometries = a_list(data.get("geometries"), f'{where}: "geometries"')
        if not geometries:
            yield Shape(where, name, "point", ())
        for i, inner in enumerate(geometries):
            yield from geometry_shapes(inner, f"{where}, geometry {i}", name, depth + 1)
        return
    at = f'{where}: "coordinates"'
    coordinates = data.get("coordinates")
    single = kind.removeprefix("Multi")
    if single not in _PARTS:
        raise InputError(f"{where}: a {kind} is inside of a geometry")
    if single == kind:
        yield part(_PARTS[kind], coordinates, where, name)
        return
    parts = [
        part(_PARTS[single], one, f"{where}, part {i}", name)
        for i, one in enumerate(a_list(coordinates, at))
    ]
    yield from together(parts) if parts else [Shape(where, name, _PARTS[single], ())]


def part(kind: Kind, data: Json, where: str, name: str) -> Shape:
    """Return the shape of the coordinates of a point, a line string or a polygon."""
    if kind == "point":
        return Shape(where, name, kind, [_point(data, where)] if data != [] else ())
    if kind == "line":
        return Shape(where, name, kind, _points(data, where))
    rings = [_points(ring, f"{where}, ring {i}") for i, ring in enumerate(a_list(data, f"{where}"))]
    return Shape(where, name, kind, rings[0] if rings else (), rings[1:])


def _points(data: Json, where: str) -> list[Point]:
    return [_point(p, f"{where}, position {i}") for i, p in enumerate(a_list(data, where))]


def _point(data: Json, where: str) -> Point:
    numbers = a_list(data, where)
    if len(numbers) < 2 or not all(isinstance(n, Number) for n in numbers):
        raise InputError(f"{where}: not a position: {shown(data)}")
    return exact_number(numbers[0], where), exact_number(numbers[1], where)


def geojson_of(shapes: Iterable[Shape]) -> str:
    """Shapes as a feature collection; coordinates are the nearest doubles.

    Polygons run counter-clockwise, and their holes clockwise, as GeoJSON requires.
    """
    features = [
        {
            "type": "Feature",
            "properties": named(shape.name, shape.properties),
            "geometry": geometry_of(shape),
        }
        for shape in shapes
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def geometry_of(shape: Shape) -> dict[str, object]:
    """Return the geometry of a shape, coordinates as the nearest doubles."""
    kind = "MultiPolygon" if shape.more else _TYPE_OF[shape.kind]
    return {"type": kind, "coordinates": coordinates_of(shape)}


def coordinates_of(shape: Shape) -> object:
    """Return the coordinates of a shape, as the nearest doubles."""
    if shape.kind == "point":
        return rounded(shape)[0]
    if shape.kind == "line":
        return rounded(shape)
    polygons = [
        [
            _turned(ring, points, left=points is part.points)
            for ring, points in zip(rings, (part.points, *part.holes), strict=True)
        ]
        for rings, part in zip(rounded_rings(shape), shape.parts, strict=True)
    ]
    return polygons if shape.more else polygons[0]


def _turned(ring: list[Place], points: Sequence[Point], *, left: bool) -> list[Place]:
    """Return a closed ring, with the orientation of its exact points."""
    area = signed_area2(points)
    ring = ring if (area >= 0 if left else area <= 0) else ring[::-1]
    return [*ring, ring[0]]
