"""OGC Moving Features JSON (19-045r3): bodies whose vertices move straight from date to date.

Read are both encodings of the standard: trajectories (a LineString whose property ``datetimes`` has
a date for each position), and moving points, line strings and polygons (``temporalGeometry``); also
the moving points and rigid geometries that MobilityDB writes. Moving geometries are written. Times
are seconds since 1970-01-01T00:00:00Z, exactly; coordinates are read as exact decimals, and written
as the nearest doubles. Data that would change the motion and are not understood are refused; other
data that are left out are counted in `Losses`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Final, NamedTuple

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.exchange import geojson
from exactpt.exchange.bodies import Holes, body_of, free_name
from exactpt.exchange.instants import instant_of, seconds_of
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import Kind, Shape, shapes_at
from exactpt.kernel.numbers import QQ, rational, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import REST, Motion, Pieces, Translation
from exactpt.scene.json_values import Json, a_list, exact_number, parse_json, shown
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import Rational

_KINDS: Final[dict[str, Kind]] = {
    "MovingPoint": "point",
    "MovingLineString": "line",
    "MovingPolygon": "polygon",
}
_TYPE_OF: Final = {kind: name for name, kind in _KINDS.items()}
_RIGID: Final = "MovingRigidGeometry"
_TYPES: Final = (*_KINDS, _RIGID)

_LIFE: Final = ("time", "lifeSpan")
"""Names of the member that says when a feature is there; the standard has both."""
_OF_FEATURE: Final = {
    "type", "geometry", "properties", "temporalGeometry", "crs", "trs", "bbox", *_LIFE,
}  # fmt: skip
_OF_SEQUENCE: Final = {
    "coordinates", "values", "datetimes", "lower_inc", "upper_inc", "interpolation",
    "interpolations",
}  # fmt: skip
"""Members that MobilityDB puts into the sequences of a geometry, if it has some."""
_OF_GEOMETRY: Final = {
    "type", "geometry", "sequences", "base", "orientations", "crs", "trs", "bbox", *_OF_SEQUENCE,
}  # fmt: skip
_CALENDAR: Final = re.compile(r"iso[-_]?8601|gregorian", re.IGNORECASE)
"""A part of the name or the address of a temporal reference system whose times are dates."""


class _Path(NamedTuple):
    """What moves: a shape at each of some times.

    Attributes:
        where: its place in the file, for messages.
        name: the wanted name of the body.
        times: increasing, in seconds.
        shapes: as many.
        properties: those of its feature.
        life: the first and the last time at which it is there, from the first of the times to
            the last one.
    """

    where: str
    name: str
    times: Sequence[QQ]
    shapes: Sequence[Shape]
    properties: dict[str, object] | None
    life: tuple[QQ, QQ]


def is_moving(data: Json) -> bool:
    """Return True if a JSON value is a moving geometry or feature, or a collection of them."""
    if not isinstance(data, dict):
        return False
    if data.get("type") == "FeatureCollection" and isinstance(data.get("features"), list):
        return any(map(is_moving, a_list(data["features"], "")))
    kind = data.get("type")
    return (
        "temporalGeometry" in data
        or _is_trajectory(data)
        or (isinstance(kind, str) and kind.startswith("Moving"))
    )


def _is_trajectory(feature: dict[str, Json]) -> bool:
    """Return True if a feature is a line string with dates, the encoding Trajectory."""
    geometry, properties = feature.get("geometry"), feature.get("properties")
    return (
        feature.get("type") == "Feature"
        and isinstance(geometry, dict)
        and geometry.get("type") == "LineString"
        and isinstance(properties, dict)
        and "datetimes" in properties
    )


def scene_of_features(
    text: str,
    losses: Losses,
    *,
    time: Sequence[Rational] | None = None,
    holes: Holes = "keep",
    skipped: Callable[[str], None] | None = None,
) -> Scene:
    """Return the scene of moving features, which all move for the whole time span.

    Args:
        text: the JSON.
        losses: data that are left out are added to these.
        time: the start and the end of the time span in seconds; by default that of the features.
        holes: "keep" the holes of polygons that keep their shape, "refuse" polygons with holes, or
            "fill" the holes.
        skipped: called with a message for each feature that cannot be a body and is left out;
            if None, such a feature is an error.

    Raises:
        InputError: one line that names the feature and its fault.
    """
    found: list[tuple[str, Body, tuple[QQ, QQ]]] = []
    names: dict[str, object] = {}
    last: dict[str, int] = {}
    for where, feature in _features(parse_json(text), losses):
        try:
            path = _path(feature, where, losses)
            if path is None:
                continue
            body = _body(path, free_name(path.name, names, last), holes)
            _check(path.where, body, path.life)
        except InputError as error:
            if skipped is None:
                raise
            skipped(str(error))
            continue
        names[body.name] = body
        found.append((path.where, body, path.life))
    if time is None and not found:
        raise InputError("no moving feature is left")
    start, end = found[0][2] if time is None else (rational(time[0]), rational(time[1]))
    for where, _, span in found:
        if not (span[0] <= start and end <= span[1]) or (time is None and span != (start, end)):
            raise InputError(
                f"{where}: it moves from t = {show(span[0])} to {show(span[1])}: all need one "
                "time span: name one in which all of them move (--time, in Python time)"
            )
    return Scene([body for _, body, _ in found], (start, end))


def _check(where: str, body: Body, span: tuple[QQ, QQ]) -> None:
    try:
        Scene([body], span)
    except InputError as error:
        raise InputError(f"{where}: {error}; mend it, or leave it out (--skip-invalid)") from None


def _features(data: Json, losses: Losses) -> Iterator[tuple[str, Json]]:
    if isinstance(data, dict) and data.get("type") == "FeatureCollection":
        members = dict(data)
        _check_calendar(members.pop("trs", None), "the collection")
        yield from geojson.features_in(members, losses)
    else:
        yield "feature", data


def _path(feature: Json, where: str, losses: Losses) -> _Path | None:
    """Return the path of a feature; None if it is valid and has no place."""
    if not isinstance(feature, dict):
        raise InputError(f"{where}: not a feature: {shown(feature)}")
    if feature.get("type") != "Feature":
        return _path_of(feature, where, where, None, losses)
    name = geojson.name_of(feature) or where
    where = geojson.place_of(name, where)
    properties = geojson.data_of(feature, where, _OF_FEATURE)
    _check_calendar(feature.get("trs"), where)
    for key in ("crs", "bbox"):
        geojson.drop_reference(key, feature.get(key), losses)
    if feature.get("temporalGeometry") is not None:
        geometry = feature["temporalGeometry"]
        if feature.get("geometry") is not None:
            losses.count("geometry", "moving feature")
    elif _is_trajectory(feature):
        geometry = _trajectory(feature, where, losses)
    elif feature.get("geometry") is None and feature.keys() & {"geometry", "temporalGeometry"}:
        losses.unlocated(where)
        return None
    else:
        raise InputError(
            f"{where}: it does not move: it has neither a temporalGeometry nor a LineString with "
            "datetimes; remove it"
        )
    path = _path_of(geometry, where, name, properties, losses)
    return path._replace(life=_life(feature, path, losses))


def _trajectory(feature: dict[str, Json], where: str, losses: Losses) -> Json:
    """Return the temporal geometry of a trajectory: the point that moves along its line string."""
    line, properties = feature["geometry"], feature["properties"]
    if not isinstance(line, dict) or not isinstance(properties, dict):  # see _is_trajectory
        raise InputError(f"{where}: not a trajectory")
    for key, value in line.items():
        if key in ("crs", "bbox"):
            geojson.drop_reference(key, value, losses)
        elif key not in ("type", "coordinates"):
            losses.count(key, "geometry")
    return {
        "type": "MovingPoint",
        "coordinates": line.get("coordinates"),
        "datetimes": properties["datetimes"],
    }


def _path_of(
    data: Json, where: str, name: str, properties: dict[str, object] | None, losses: Losses
) -> _Path:
    """Return the path of a temporal geometry, there from its first date to the last one."""
    if not isinstance(data, dict):
        raise InputError(f"{where}: not a temporalGeometry: {shown(data)}")
    kind = data.get("type")
    if kind not in _TYPES:
        raise InputError(f"{where}: not one of {', '.join(_TYPES)}: {shown(kind)}")
    _check_geometry(data, where, losses)
    geometry = _sequence(data, where, losses)
    _check_linear(geometry, where)
    times = [
        seconds_of(t, f"{where}, datetime {i}")
        for i, t in enumerate(_values(geometry, "datetimes", where))
    ]
    for before, after in pairwise(times):
        if before >= after:
            raise InputError(f"{where}: datetimes do not increase: after {show(before)}")
    if len(times) < 2:
        raise InputError(f"{where}: expected at least two timestamps, got one")
    shapes = _shapes(geometry, str(kind), where, name, losses)
    if len(shapes) != len(times):
        raise InputError(f"{where}: {len(times)} datetimes for {len(shapes)} positions")
    shapes = [shape._replace(properties=properties) for shape in shapes]
    return _Path(where, name, times, shapes, properties, (times[0], times[-1]))


def _check_geometry(geometry: dict[str, Json], where: str, losses: Losses) -> None:
    """Refuse members of a temporal geometry that change it; name those that are left out."""
    if geometry.get("base") is not None:
        raise InputError(f'{where}: "base": a model that moves is not supported: remove it')
    for i, orientation in enumerate(a_list(geometry.get("orientations") or [], where)):
        _check_upright(orientation, f'{where}: "orientations"[{i}]')
    _check_calendar(geometry.get("trs"), where)
    for key in ("crs", "bbox"):
        geojson.drop_reference(key, geometry.get(key), losses)
    own = _OF_GEOMETRY if geometry["type"] == _RIGID else _OF_GEOMETRY - {"geometry", "values"}
    for key in geometry.keys() - own:
        losses.count(key, "moving geometry")


def _check_upright(orientation: Json, where: str) -> None:
    """Refuse an orientation that turns or scales."""
    data = orientation if isinstance(orientation, dict) else {}
    angles = [exact_number(a, where) for a in a_list(data.get("angles", []), where)]
    scales = [exact_number(s, where) for s in a_list(data.get("scales", []), where)]
    if any(angles) or any(scale != 1 for scale in scales) or data.keys() - {"angles", "scales"}:
        raise InputError(f"{where}: it turns or scales, which is not supported: {shown(data)}")


def _check_calendar(trs: Json, where: str) -> None:
    """Refuse a temporal reference system without dates."""
    if trs is None:
        return
    properties = trs.get("properties") if isinstance(trs, dict) else None
    found = properties if isinstance(properties, dict) else {}
    name = found.get("name", found.get("href"))
    if not isinstance(name, str) or not _CALENDAR.search(name):
        raise InputError(f'{where}: "trs": times are dates (ISO 8601), not {shown(trs)}')


def _life(feature: dict[str, Json], path: _Path, losses: Losses) -> tuple[QQ, QQ]:
    """Return the first and the last time of a path at which its feature is there."""
    start, end = path.life
    for key in _LIFE:
        if feature.get(key) is None:
            continue
        at = f'{path.where}: "{key}"'
        first, last = (seconds_of(t, at) for t in a_list(feature[key], at, length=2))
        if first < start or last > end:
            losses.count(f"{key} beyond the positions", "moving feature")
        start, end = max(start, first), min(end, last)
    if start >= end:
        raise InputError(f"{path.where}: it is nowhere while it is there: see its time and dates")
    return start, end


def _sequence(geometry: dict[str, Json], where: str, losses: Losses) -> dict[str, Json]:
    """Return the geometry with the one sequence that it has in place of the list of them."""
    found = dict(geometry)
    if "sequences" in geometry:
        sequences = a_list(found.pop("sequences"), f'{where}: "sequences"')
        if len(sequences) != 1 or not isinstance(sequences[0], dict):
            raise InputError(f"{where}: {len(sequences)} sequences: a body is there without a gap")
        for key, value in sequences[0].items():
            if key not in _OF_SEQUENCE:
                losses.count(key, "sequence")
            elif found.setdefault(key, value) != value:
                raise InputError(f"{where}: two values of {shorten(key)}: remove one")
    for key in ("lower_inc", "upper_inc"):
        if found.get(key, True) is not True:
            losses.count(key, "moving geometry")
    return found


def _check_linear(geometry: dict[str, Json], where: str) -> None:
    """Refuse an interpolation that is not linear; without one it is."""
    for key in ("interpolation", "interpolations"):
        given = geometry.get(key)
        words = given if isinstance(given, list) else ["Linear" if given is None else given]
        if any(word != "Linear" for word in words):
            raise InputError(
                f'{where}: "{key}": a body moves by linear interpolation, not {shown(given)}'
            )


def _values(geometry: dict[str, Json], key: str, where: str) -> list[Json]:
    return a_list(geometry.get(key), f'{where}: "{key}"')


def _shapes(
    geometry: dict[str, Json], kind: str, where: str, name: str, losses: Losses
) -> list[Shape]:
    if kind == _RIGID:
        return _posed(geometry, where, name, losses)
    return [
        geojson.part(_KINDS[kind], data, f"{where}, position {i}", name, losses)
        for i, data in enumerate(_values(geometry, "coordinates", where))
    ]


def _posed(geometry: dict[str, Json], where: str, name: str, losses: Losses) -> list[Shape]:
    """Return a geometry at its poses, {"position": {"lat": y, "lon": x}, "rotation": radians} each.

    The cosine of an angle that is a decimal number, but for 0, is not rational.
    """
    shapes = list(geojson.geometry_shapes(geometry.get("geometry"), where, name, losses))
    if len(shapes) != 1:
        raise InputError(f"{where}: a body is one point, line or polygon, not {len(shapes)}")
    if shapes[0].more:
        raise InputError(f"{where}: a moving body has one part, not {len(shapes[0].parts)}")
    posed = []
    for i, pose in enumerate(_values(geometry, "values", where)):
        by = _place(pose, f"{where}, value {i}", losses)
        rings = [[(x + by[0], y + by[1]) for x, y in ring] for ring in shapes[0].rings]
        posed.append(
            shapes[0]._replace(where=f"{where}, value {i}", points=rings[0], holes=rings[1:])
        )
    return posed


def _place(pose: Json, at: str, losses: Losses) -> Point:
    """Return the translation of a pose, which does not turn."""
    place = pose.get("position") if isinstance(pose, dict) else None
    if not isinstance(pose, dict) or not isinstance(place, dict):
        raise InputError(f"{at}: not a pose: {shown(pose)}")
    angles = {key: pose[key] for key in ("rotation", "yaw", "pitch", "roll") if key in pose}
    unknown = pose.keys() - angles.keys() - {"position"}
    if unknown:
        raise InputError(f"{at}: unknown key {shorten(min(unknown))}: remove it")
    if not angles:
        raise InputError(f"{at}: rotation: not a number: null")
    for word, angle in angles.items():
        if exact_number(angle, f"{at}: {word}"):
            raise InputError(f"{at}: it turns, by an angle whose cosine is not rational")
    for key in place.keys() - {"lon", "lat"}:
        losses.count(key, "position")
    x = exact_number(place.get("lon"), f"{at}: lon")
    y = exact_number(place.get("lat"), f"{at}: lat")
    return x, y


def _body(path: _Path, name: str, holes: Holes) -> Body:
    """Return the body; it translates in pieces if its shapes are translates of each other."""
    rests = [body_of(shape, name, holes=holes) for shape in path.shapes]
    first, frames = rests[0], [rest.exact_at(path.times[0]) for rest in rests]
    for i, (frame, shape) in enumerate(zip(frames, path.shapes, strict=True)):
        if len(frame) != len(frames[0]):
            vertices = counted(len(frame), "vertex")
            raise InputError(f"{path.where}, position {i}: {vertices}, after {len(frames[0])}")
        if _pattern(shape) != _pattern(path.shapes[0]):
            raise InputError(
                f"{path.where}, position {i}: its rings, or its vertices that coincide, are not "
                "those at the first position"
            )
    by = [_translation(frames[0], frame) for frame in frames]
    moves = [move for move in by if move is not None]
    if len(moves) == len(by):
        return first.with_motion(_motion(path.times, moves))
    if first.has_rings:
        raise InputError(
            f"{path.where}: a polygon with holes that changes its shape: fill them (--holes fill)"
        )
    keyframes = list(zip(path.times, frames, strict=True))
    return Body(name, keyframes=keyframes, closed=first.closed, properties=path.properties)


def _pattern(shape: Shape) -> list[list[bool]]:
    """Return for each point of each ring True if it repeats the point before it on the ring.

    Repeated points count once, so that the vertices of two shapes correspond only if the patterns
    are equal.
    """
    return [[p == ring[i - 1] for i, p in enumerate(ring)] for ring in shape.rings]


def _translation(a: Sequence[Point], b: Sequence[Point]) -> Point | None:
    """Return the vector by which a is translated to b; None if there is none."""
    moves = {(q[0] - p[0], q[1] - p[1]) for p, q in zip(a, b, strict=True)}
    return moves.pop() if len(moves) == 1 else None


def _motion(times: Sequence[QQ], moves: Sequence[Point]) -> Motion:
    if not any(x or y for x, y in moves):
        return REST
    pieces: list[tuple[QQ | None, Translation]] = []
    for (t, f), (u, g) in pairwise(zip(times, moves, strict=True)):
        x, y = ([p - t * (q - p) / (u - t), (q - p) / (u - t)] for p, q in zip(f, g, strict=True))
        pieces.append((u, Translation(x, y)))
    pieces[-1] = (None, pieces[-1][1])
    return pieces[0][1] if len(pieces) == 1 else Pieces(pieces)


def mfjson_of(scene: Scene) -> str:
    """Return a scene of piecewise linear vertices as a collection of moving features.

    Raises:
        InputError: if a body does something else, has a radius, or moves at a time that is no
            decimal number of seconds.
    """
    named = ((body.name, body.properties) for body in scene.bodies)
    features = [
        {**feature, "temporalGeometry": _moving(scene, i, f"body {shorten(body.name)}")}
        for i, (feature, body) in enumerate(
            zip(geojson.features_of(named), scene.bodies, strict=True)
        )
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def _moving(scene: Scene, i: int, where: str) -> dict[str, object]:
    body = scene.bodies[i]
    inner = body.exact_breakpoints_between(scene.exact_start, scene.exact_end)
    times = [scene.exact_start, *inner, scene.exact_end]
    if body.exact_radius:
        raise InputError(f"{where}: moving features have no radius: write a scene (.json)")
    if len(body.parts) > 1:
        raise InputError(f"{where}: moving features have one part each: write a scene (.json)")
    for t in times[:-1]:
        tracks = body.exact_piece_after(t).tracks
        if any(max(len(p.x), len(p.y)) > 2 or len(p.w) > 1 for p in tracks):
            raise InputError(
                f"{where}: its vertices do not move straight from t = {show(t)} on, which moving "
                "features cannot represent: write a scene (.json)"
            )
    shapes = [shapes_at(scene, t)[i] for t in times]
    try:
        dates = [instant_of(t) for t in times]
    except InputError as error:
        raise InputError(f"{where}: {error}") from None
    return {
        "type": _TYPE_OF[shapes[0].kind],
        "datetimes": dates,
        "coordinates": [geojson.coordinates_of(shape) for shape in shapes],
        "interpolation": "Linear",
    }
