"""GeoJSON (RFC 7946): exact decimals are read, nearest doubles are written.

The format is parsed here: a library would return coordinates as floats. The properties of a feature
and its other members, such as ``id``, stay with the body. Whatever else is left out, such as a
third coordinate, is counted in `Losses`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from itertools import chain
from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.exchange.bodies import free_name
from exactpt.exchange.instants import is_date
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import DEEPEST, Kind, Shape, rounded, rounded_rings, together
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

_PARTS: Final[dict[str, Kind]] = {"Point": "point", "LineString": "line", "Polygon": "polygon"}
_GEOMETRIES: Final = {"GeometryCollection", *_PARTS, *(f"Multi{kind}" for kind in _PARTS)}
TYPES: Final = {"Feature", "FeatureCollection", *_GEOMETRIES}
"""Possible values of the key "type" of a GeoJSON object."""
_TYPE_OF: Final = {kind: name for name, kind in _PARTS.items()}

_MEANINGFUL: Final = {
    "coordinates", "geometries", "geometry", "properties", "features", "temporalGeometry",
}  # fmt: skip
"""Members that RFC 7946 (7.1), and the standard of moving features, allow only in the objects that
they define with them."""
_REFERENCE: Final = ("crs", "bbox")
"""Members of any object that have no place in a scene."""
_OF_FEATURE: Final = {"type", "geometry", "properties", *_REFERENCE}

FEATURE_MEMBERS: Final = "feature_members"
"""Property of a body: a mapping from members of its feature to the properties that hold them."""

_DATES: Final = "datetimes"


def is_type(word: Json) -> bool:
    """Return True if it is the type of a GeoJSON object."""
    return isinstance(word, str) and word in TYPES


def shapes_of(text: str, losses: Losses | None = None) -> Iterator[Shape]:
    """Yield the shapes of a GeoJSON text, named after their features.

    The parts of a MultiPolygon are one shape, those of other geometries are one each. A feature
    whose geometry is null has no shape.

    The name of a feature is its property ``name`` or ``id`` (in upper or lower case), else its
    own ``id``, else its number.

    >>> from exactpt.exchange.bodies import scene_of
    >>> text = '{"type": "Polygon", "coordinates": [[[0, 0], [0.1, 0], [0, 2, 7], [0, 0]]]}'
    >>> losses = Losses()
    >>> scene_of(shapes_of(text, losses)).bodies[0].at(0)[1]
    (Fraction(1, 10), Fraction(0, 1))
    >>> losses.texts()
    ('z of 1 point',)

    Args:
        text: the JSON.
        losses: data that are left out are added to these.

    Raises:
        InputError: one line that names the feature and its fault.
    """
    left_out = losses or Losses()
    try:
        data = parse_json(text)
        if isinstance(data, dict) and data.get("type") == "Topology":
            raise InputError("TopoJSON is not supported: convert it to GeoJSON")
        if not isinstance(data, dict) or not is_type(data.get("type")):
            raise InputError(f"not GeoJSON: {shown(data)}")
        if data["type"] == "FeatureCollection":
            for where, feature in features_in(data, left_out):
                yield from _of_feature(feature, where, left_out)
        elif data["type"] == "Feature":
            yield from _of_feature(data, "feature", left_out)
        else:
            yield from geometry_shapes(data, "geometry", "body", left_out)
    except RecursionError:
        raise InputError("not GeoJSON: nested too deeply") from None


def features_in(collection: dict[str, Json], losses: Losses) -> Iterator[tuple[str, Json]]:
    """Yield the features of a collection, each with its place; its other members are lost.

    Raises:
        InputError: if it has no list of features, or a member of other objects.
    """
    _check_members(collection, "FeatureCollection", {"features"}, "")
    for key, value in collection.items():
        if key in _REFERENCE:
            drop_reference(key, value, losses)
        elif key not in ("type", "features"):
            losses.add(f"{key} of the collection")
    for i, feature in enumerate(a_list(collection.get("features"), '"features"')):
        yield f"feature {i}", feature


def drop_reference(key: str, value: Json, losses: Losses) -> None:
    """Leave out a member such as ``crs``; null has nothing to be lost."""
    if value is not None:
        losses.add(key)


def _check_members(data: dict[str, Json], kind: str, own: set[str], where: str) -> None:
    """Refuse a member that has a meaning in other objects, and would be ignored here."""
    misplaced = (_MEANINGFUL - own) & set(data)
    if misplaced:
        at = f"{where}: " if where else ""
        raise InputError(f"{at}a {kind} has no {shorten(min(misplaced))}: remove it")


def _of_feature(data: Json, where: str, losses: Losses) -> Iterator[Shape]:
    if not isinstance(data, dict) or data.get("type") != "Feature":
        raise InputError(f"{where}: not a feature: {shown(data)}")
    name = name_of(data) or where
    where = place_of(name, where)
    if "geometry" not in data:
        near = get_close_matches("geometry", data, n=1)
        advice = f"; is it {shorten(near[0])}?" if near else ""
        raise InputError(f'{where} has no geometry: the key "geometry" is missing{advice}')
    properties = data_of(data, where, _OF_FEATURE)
    for key in _REFERENCE:
        drop_reference(key, data.get(key), losses)
    if data["geometry"] is None:
        losses.unlocated(where)
        return
    _check_dates(_data_with_dates(data), data["geometry"], where)
    for shape in geometry_shapes(data["geometry"], where, name, losses):
        parts = [part._replace(properties=properties) for part in shape.more]
        yield shape._replace(properties=properties, more=parts)


def place_of(name: str, where: str) -> str:
    """Return the place of a feature in a file, with its name."""
    return where if name == where else f"{where} ({shorten(name)[1:-1]})"


def data_of(feature: dict[str, Json], where: str, known: set[str]) -> dict[str, object] | None:
    """Return the properties of a feature, with its other members that are data.

    `FEATURE_MEMBERS` has the names of the latter, so that they are written back to their place.

    Args:
        feature: the feature.
        where: its place, for messages.
        known: members that a reader understands or leaves out.

    Raises:
        InputError: if the properties are not an object, or a member belongs to other objects.
    """
    _check_members(feature, "Feature", known, where)
    given = feature.get("properties")
    if given is not None and not isinstance(given, dict):
        raise InputError(f'{where}: "properties": not an object: {shown(given)}')
    found = {key: plain(value) for key, value in (given or {}).items()}
    members: dict[str, object] = {}
    for key, value in feature.items():
        if key not in known and (key, value) != ("id", None):
            at = free_name(key, {*found, FEATURE_MEMBERS}, {})
            found[at] = plain(value)
            members[key] = at
    if members and FEATURE_MEMBERS in found:
        raise InputError(f"{where}: the property {FEATURE_MEMBERS!r} is reserved: rename it")
    if members:
        found[FEATURE_MEMBERS] = members
    return found or None


def _data_with_dates(feature: dict[str, Json]) -> list[dict[str, Json]]:
    """Return the objects of a feature whose members may be the dates of its positions."""
    properties = feature.get("properties")
    objects = [feature, *([properties] if isinstance(properties, dict) else [])]
    inner = [value for data in objects for value in data.values() if isinstance(value, dict)]
    return [*objects, *inner]


def _check_dates(holders: Sequence[dict[str, Json]], geometry: Json, where: str) -> None:
    """Refuse a geometry at rest that has a date for each of its positions: it moves."""
    key = _dates_of_positions(holders, geometry)
    if key is not None:
        raise InputError(
            f"{where}: {shorten(key)} has a date for each position, and would be at rest: a "
            f'trajectory is a LineString with the property "{_DATES}"'
        )


def _dates_of_positions(holders: Sequence[dict[str, Json]], geometry: Json) -> str | None:
    """Return the member that has a date for each position of a geometry; None if there is none.

    A line string with ``datetimes`` is read as a trajectory, see `exactpt.exchange.mfjson`. Other
    programs have the dates elsewhere: in other properties, in an object that is a property, beside
    the geometry, or within it.
    """
    if not isinstance(geometry, dict):
        return None
    if geometry.get("type") == "GeometryCollection":
        inner = geometry.get("geometries")
        found = (
            _dates_of_positions(holders, one) for one in (inner if isinstance(inner, list) else ())
        )
        return next((key for key in found if key is not None), None)
    if geometry.get("type") not in ("LineString", "MultiLineString", "MultiPoint"):
        return None
    for key, dates in chain.from_iterable(data.items() for data in holders):
        if _dates_each(dates, geometry.get("coordinates"), numbers=key.lower() == _DATES):
            return key
    return None


def _dates_each(dates: Json, coordinates: Json, *, numbers: bool) -> bool:
    """Return True if there is a date for each position, in lists that are nested alike.

    Args:
        dates: a property.
        coordinates: the coordinates of a geometry, or a position.
        numbers: whether numbers are dates.
    """
    if isinstance(coordinates, list) and coordinates and isinstance(coordinates[0], Number):
        if isinstance(dates, Number):
            return numbers
        return isinstance(dates, str) and is_date(dates)
    return (
        isinstance(dates, list)
        and isinstance(coordinates, list)
        and 0 < len(dates) == len(coordinates)
        and all(
            _dates_each(date, position, numbers=numbers)
            for date, position in zip(dates, coordinates, strict=True)
        )
    )


def name_of(feature: Mapping[str, object]) -> str:
    """Return the name of a feature, see `shapes_of`; empty if it has none."""
    properties = feature.get("properties")
    keys = properties if isinstance(properties, dict) else {}
    lowered = {key.lower(): value for key, value in reversed(keys.items())}
    for value in (lowered.get("name"), lowered.get("id"), feature.get("id")):
        name = plain(value) if isinstance(value, Number) else value
        if isinstance(name, (int, float)) and not isinstance(name, bool):
            name = str(name)
        if isinstance(name, str) and name.strip():
            return name.encode(errors="replace").decode()
    return ""


def features_of(
    bodies: Iterable[tuple[str, Mapping[str, object] | None]],
) -> Iterator[dict[str, object]]:
    """Yield the feature of each body, without a geometry: `shapes_of` gives the same names back.

    A property ``name`` is added, or gets the name of the body, only if that needs it.

    Args:
        bodies: the name and the properties of each body.

    Raises:
        InputError: if JSON has no such data.
    """
    for name, given in bodies:
        try:
            properties: dict[str, object] = with_long_texts(dict(given or {}))
            members = _members_in(properties)
            feature: dict[str, object] = {"type": "Feature", **members, "properties": properties}
            json.dumps(feature, allow_nan=False)
        except (TypeError, ValueError, RecursionError) as error:
            raise InputError(f"body {shorten(name)}: properties: {error}") from None
        if name_of(feature) != name:
            others = {key: value for key, value in properties.items() if key != "name"}
            feature["properties"] = {"name": name, **others}
        yield feature


def _members_in(properties: dict[str, object]) -> dict[str, object]:
    """Take the members of a feature out of its properties, see `FEATURE_MEMBERS`.

    A property of that name with another content is the caller's own, and stays one.
    """
    places = properties.get(FEATURE_MEMBERS)
    if not isinstance(places, Mapping) or not all(
        isinstance(key, str)
        and key in properties
        and isinstance(member, str)
        and member not in {*_OF_FEATURE, *_MEANINGFUL}
        for member, key in places.items()
    ):
        return {}
    del properties[FEATURE_MEMBERS]
    return {member: properties.pop(key) for member, key in places.items()}


def geometry_shapes(
    data: Json, where: str, name: str, losses: Losses, depth: int = 0
) -> Iterator[Shape]:
    """Yield the shapes of a geometry."""
    if depth > DEEPEST:
        raise InputError(f"{where[:60]}...: nested more than {DEEPEST} deep")
    if not isinstance(data, dict) or not is_type(data.get("type")):
        raise InputError(f"{where}: not a geometry: {shown(data)}")
    kind = str(data["type"])
    if kind not in _GEOMETRIES:
        raise InputError(f"{where}: a {kind} is inside of a geometry")
    content = "geometries" if kind == "GeometryCollection" else "coordinates"
    _check_members(data, kind, {content}, where)
    _check_dates([data], data, where)
    for key, value in data.items():
        if key in _REFERENCE:
            drop_reference(key, value, losses)
        elif key not in ("type", content):
            losses.count(key, "geometry")
    if kind == "GeometryCollection":
        geometries = a_list(data.get("geometries"), f'{where}: "geometries"')
        if not geometries:
            yield Shape(where, name, "point", ())
        for i, inner in enumerate(geometries):
            yield from geometry_shapes(inner, f"{where}, geometry {i}", name, losses, depth + 1)
        return
    at = f'{where}: "coordinates"'
    coordinates = data.get("coordinates")
    single = kind.removeprefix("Multi")
    if single == kind:
        yield part(_PARTS[kind], coordinates, where, name, losses)
        return
    parts = [
        part(_PARTS[single], one, f"{where}, part {i}", name, losses)
        for i, one in enumerate(a_list(coordinates, at))
    ]
    yield from together(parts) if parts else [Shape(where, name, _PARTS[single], ())]


def part(kind: Kind, data: Json, where: str, name: str, losses: Losses) -> Shape:
    """Return the shape of the coordinates of a point, a line string or a polygon."""
    if kind == "point":
        return Shape(where, name, kind, [_point(data, where, losses)] if data != [] else ())
    if kind == "line":
        return Shape(where, name, kind, points_of(data, where, losses))
    rings = [
        points_of(ring, f"{where}, ring {i}", losses)
        for i, ring in enumerate(a_list(data, f"{where}"))
    ]
    return Shape(where, name, kind, rings[0] if rings else (), rings[1:])


def points_of(data: Json, where: str, losses: Losses) -> list[Point]:
    """Return the points of a list of positions."""
    positions = a_list(data, where)
    return [_point(p, f"{where}, position {i}", losses) for i, p in enumerate(positions)]


def _point(data: Json, where: str, losses: Losses) -> Point:
    numbers = a_list(data, where)
    if len(numbers) < 2 or not all(isinstance(n, Number) for n in numbers):
        raise InputError(f"{where}: not a position: {shown(data)}")
    x, y, *others = [exact_number(n, where) for n in numbers]
    if others:
        losses.count("z", "point")
    if len(others) > 1:
        losses.count("further coordinates", "point")
    return x, y


def geojson_of(shapes: Sequence[Shape]) -> str:
    """Shapes as a feature collection; coordinates are the nearest doubles.

    Rings keep the order and the orientation of their vertices. RFC 7946 requires outlines that run
    counter-clockwise, but wants readers to accept other outlines.
    """
    features = [
        {**feature, "geometry": geometry_of(shape)}
        for feature, shape in zip(
            features_of((shape.name, shape.properties) for shape in shapes), shapes, strict=True
        )
    ]
    for feature, shape in zip(features, shapes, strict=True):
        if shape.kind == "line" and shape.properties:
            _check_rest(feature, shape.name)
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def _check_rest(feature: dict[str, object], name: str) -> None:
    """Refuse a line at rest that readers take for a track, because its properties are dates."""
    data = parse_json(json.dumps(feature))
    if not isinstance(data, dict):
        raise TypeError(feature)
    holders, geometry = _data_with_dates(data), data["geometry"]
    key = _DATES if _DATES in holders[1] else _dates_of_positions(holders, geometry)
    if key is not None:
        raise InputError(
            f"body {shorten(name)}: with the property {shorten(key)} this line would be read as a "
            "point that moves: rename the property"
        )


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
    polygons = [[[*ring, ring[0]] for ring in rings] for rings in rounded_rings(shape)]
    return polygons if shape.more else polygons[0]
