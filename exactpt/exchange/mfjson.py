"""OGC Moving Features JSON (19-045r3): bodies whose vertices move straight from date to date.

Read are moving points, line strings and polygons, and the moving points and rigid geometries that
MobilityDB writes; written are the former. Times are seconds since 1970-01-01T00:00:00Z, exactly;
coordinates are read as exact decimals, and written as the nearest doubles. A third one is dropped.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Final, NamedTuple

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.exchange import geojson
from exactpt.exchange.bodies import Holes, body_of, free_name
from exactpt.exchange.instants import instant_of, seconds_of
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


class _Path(NamedTuple):
    """What moves: a shape at each of some times.

    Attributes:
        where: its place in the file, for messages.
        name: the wanted name of the body.
        times: increasing, in seconds.
        shapes: as many.
        properties: those of its feature.
    """

    where: str
    name: str
    times: Sequence[QQ]
    shapes: Sequence[Shape]
    properties: dict[str, object] | None


def is_moving(data: Json) -> bool:
    """Return True if a JSON value is a moving geometry or feature, or a collection of them."""
    if not isinstance(data, dict):
        return False
    if data.get("type") == "FeatureCollection" and isinstance(data.get("features"), list):
        return any(map(is_moving, a_list(data["features"], "")))
    kind = data.get("type")
    return "temporalGeometry" in data or (isinstance(kind, str) and kind.startswith("Moving"))


def scene_of_features(
    text: str,
    *,
    time: Sequence[Rational] | None = None,
    holes: Holes = "keep",
    skipped: Callable[[str], None] | None = None,
) -> Scene:
    """Return the scene of moving features, which all move for the whole time span.

    Args:
        text: the JSON.
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
    for where, feature in _features(parse_json(text)):
        try:
            path = _path(feature, where)
            span = path.times[0], path.times[-1]
            body = _body(path, free_name(path.name, names, last), holes)
            _check(path.where, body, span)
        except InputError as error:
            if skipped is None:
                raise
            skipped(str(error))
            continue
        names[body.name] = body
        found.append((path.where, body, span))
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


def _features(data: Json) -> Iterator[tuple[str, Json]]:
    if isinstance(data, dict) and data.get("type") == "FeatureCollection":
        for i, feature in enumerate(a_list(data.get("features"), '"features"')):
            yield f"feature {i}", feature
    else:
        yield "feature", data


def _path(feature: Json, where: str) -> _Path:
    if not isinstance(feature, dict):
        raise InputError(f"{where}: not a feature: {shown(feature)}")
    name = where
    geometry: Json = feature
    if feature.get("type") == "Feature":
        name = geojson.name_of(feature) or where
        where = where if name == where else f"{where} ({shorten(name)[1:-1]})"
        geometry = feature.get("temporalGeometry")
    if not isinstance(geometry, dict):
        raise InputError(f"{where}: it has no temporalGeometry: remove it")
    kind = geometry.get("type")
    if kind not in (*_KINDS, _RIGID):
        known = ", ".join([*_KINDS, _RIGID])
        raise InputError(f"{where}: not one of {known}: {shown(kind)}")
    geometry = _sequence(geometry, where)
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
    shapes = _shapes(geometry, str(kind), where, name)
    if len(shapes) != len(times):
        raise InputError(f"{where}: {len(times)} datetimes for {len(shapes)} positions")
    properties = geojson.properties_of(feature)
    shapes = [shape._replace(properties=properties) for shape in shapes]
    return _Path(where, name, times, shapes, properties)


def _sequence(geometry: dict[str, Json], where: str) -> dict[str, Json]:
    """Return the geometry with the one sequence that it has in place of the list of them."""
    if "sequences" not in geometry:
        return geometry
    sequences = a_list(geometry["sequences"], f'{where}: "sequences"')
    if len(sequences) != 1 or not isinstance(sequences[0], dict):
        raise InputError(f"{where}: {len(sequences)} sequences: a body is there without a gap")
    return {**geometry, **sequences[0]}


def _check_linear(geometry: dict[str, Json], where: str) -> None:
    """Refuse an interpolation that is not linear; without one it is."""
    given = geometry.get("interpolation", geometry.get("interpolations", "Linear"))
    words = given if isinstance(given, list) else [given]
    if any(word != "Linear" for word in words):
        raise InputError(f"{where}: a body moves by linear interpolation, not {shown(given)}")


def _values(geometry: dict[str, Json], key: str, where: str) -> list[Json]:
    return a_list(geometry.get(key), f'{where}: "{key}"')


def _shapes(geometry: dict[str, Json], kind: str, where: str, name: str) -> list[Shape]:
    if kind == _RIGID:
        return _posed(geometry, where, name)
    return [
        geojson.part(_KINDS[kind], data, f"{where}, position {i}", name)
        for i, data in enumerate(_values(geometry, "coordinates", where))
    ]


def _posed(geometry: dict[str, Json], where: str, name: str) -> list[Shape]:
    """Return a geometry at its poses, {"position": {"lat": y, "lon": x}, "rotation": radians} each.

    The cosine of an angle that is a decimal number, but for 0, is not rational.
    """
    shapes = list(geojson.geometry_shapes(geometry.get("geometry"), where, name))
    if len(shapes) != 1:
        raise InputError(f"{where}: a body is one point, line or polygon, not {len(shapes)}")
    posed = []
    for i, pose in enumerate(_values(geometry, "values", where)):
        at = f"{where}, value {i}"
        place = pose.get("position") if isinstance(pose, dict) else None
        if not isinstance(pose, dict) or not isinstance(place, dict):
            raise InputError(f"{at}: not a pose: {shown(pose)}")
        if exact_number(pose.get("rotation", pose.get("yaw")), f"{at}: rotation"):
            raise InputError(f"{at}: it turns, by an angle whose cosine is not rational")
        by = (
            exact_number(place.get("lon"), f"{at}: lon"),
            exact_number(place.get("lat"), f"{at}: lat"),
        )
        rings = [[(x + by[0], y + by[1]) for x, y in ring] for ring in shapes[0].rings]
        posed.append(shapes[0]._replace(where=at, points=rings[0], holes=rings[1:]))
    return posed


def _body(path: _Path, name: str, holes: Holes) -> Body:
    """Return the body; it translates in pieces if its shapes are translates of each other."""
    rests = [body_of(shape, name, holes=holes) for shape in path.shapes]
    first, frames = rests[0], [rest._at(path.times[0]) for rest in rests]
    for i, frame in enumerate(frames):
        if len(frame) != len(frames[0]):
            vertices = counted(len(frame), "vertex", "vertices")
            raise InputError(f"{path.where}, position {i}: {vertices}, after {len(frames[0])}")
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
    features = [
        {
            "type": "Feature",
            "properties": geojson.named(body.name, body.properties),
            "temporalGeometry": _moving(scene, i, f"body {shorten(body.name)}"),
        }
        for i, body in enumerate(scene.bodies)
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def _moving(scene: Scene, i: int, where: str) -> dict[str, object]:
    body = scene.bodies[i]
    inner = [t for t in body._breakpoints if scene._start < t < scene._end]
    times = [scene._start, *inner, scene._end]
    if body._radius:
        raise InputError(f"{where}: moving features have no radius: write a scene (.json)")
    if len(body.parts) > 1:
        raise InputError(f"{where}: moving features have one part each: write a scene (.json)")
    for t in times[:-1]:
        tracks = body._piece_after(t).tracks
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
