"""Scenes read from JSON, validated as in docs/format.md; `exactpt.scene.written` writes them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any, Final, TypeAlias

from exactpt.errors import InputError
from exactpt.files import read_text
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body, is_text
from exactpt.motion.motions import (
    REST,
    Affine,
    Motion,
    Pieces,
    Position,
    Rigid,
    SimpleMotion,
    Translation,
)
from exactpt.scene.json_values import (
    VERSION,
    Json,
    Number,
    a_list,
    an_object,
    exact_number,
    parse_json,
    properties_in,
    shown,
    with_long_texts,
)
from exactpt.scene.scene import Scene
from exactpt.scene.units import Units, read_units

_RECORDS: Final = ("spin", "path", "spline")
"""The records that may stand beside the pieces of a motion, one at most."""
Span: TypeAlias = tuple[QQ, QQ]
"""The start and the end of a scene."""
_ERRORS: Final = ("place_error", "angle_error", "shape_error", "pivot")
"""The keys of a body that state errors of it."""
_CONVERT: Final = "exactpt convert makes a scene of such a file"


def load(path: Path, max_bytes: int | None = None) -> Scene:
    """Read a scene file of at most ``max_bytes``, by default `exactpt.files.MAX_BYTES`.

    Raises:
        InputError: one line that names the file, the body, the key and the value.
    """
    text = read_text(path, max_bytes)
    try:
        return loads(text)
    except InputError as error:
        is_other = path.suffix.lower() in (".geojson", ".mfjson", ".svg", ".wkt")
        advice = f"; {_CONVERT}" if is_other and _CONVERT not in str(error) else ""
        raise InputError(f"{path}: {error}{advice}") from None


def loads(text: str) -> Scene:
    """Return the scene in a JSON text.

    Raises:
        InputError: one line that names the body, the key and the value.
    """
    try:
        return _scene(parse_json(text))
    except RecursionError:
        raise InputError("not a scene: nested too deeply") from None


def from_json(data: Mapping[str, object]) -> Scene:
    """Return the scene in JSON data.

    Raises:
        InputError: one line that names the body, the key and the value.
    """
    try:
        text = json.dumps(data)
    except (TypeError, ValueError, RecursionError):
        # Python writes no integer beyond its limit on digits: as a text it is the same number.
        try:
            text = json.dumps(with_long_texts(data))
        except (TypeError, ValueError, RecursionError) as error:
            raise InputError(f"not JSON data: {error}") from None
    return loads(text)


def _check_kind(data: Json) -> None:
    """Refuse GeoJSON, moving features and TopoJSON, whose objects have a type."""
    kind = data.get("type") if isinstance(data, dict) and "exactpt" not in data else None
    if kind == "Topology":
        raise InputError("not a scene: TopoJSON is not supported")
    if isinstance(kind, str) and not isinstance(kind, Number):
        raise InputError(f'scene: the key "exactpt" is missing; {_CONVERT}')


def _scene(data: Json) -> Scene:
    _check_kind(data)
    required = ["exactpt", "time", "bodies"]
    top = an_object(data, "scene", required=required, optional={"ignoring", "units", "epoch"})
    if top["exactpt"] != Number(VERSION) or not isinstance(top["exactpt"], Number):
        raise InputError(
            f'"exactpt": this version reads format {VERSION}, not {shown(top["exactpt"])}'
        )
    span = a_list(top["time"], '"time"', length=2)
    time = exact_number(span[0], '"time"[0]'), exact_number(span[1], '"time"[1]')
    bodies = [_body(b, i, time) for i, b in enumerate(a_list(top["bodies"], '"bodies"'))]
    return Scene(bodies, time, ignoring=_groups(top), units=_units(top), epoch=_epoch(top))


def _groups(top: dict[str, Json]) -> list[list[str]]:
    """Return the groups of a scene; `Scene` looks up their names and patterns."""
    groups = []
    for k, row in enumerate(a_list(top.get("ignoring", []), '"ignoring"')):
        where = f'"ignoring"[{k}]'
        texts = []
        for text in a_list(row, where):
            if not isinstance(text, str) or isinstance(text, Number):
                raise InputError(f"{where}: a name or a pattern is a text, got {shown(text)}")
            texts.append(str(text))
        groups.append(texts)
    return groups


def _units(top: dict[str, Json]) -> Units | None:
    if "units" not in top:
        return None
    units = an_object(top["units"], '"units"', optional={"length", "time"})
    for kind, unit in units.items():
        _check_plain_text(unit, f'"units": "{kind}"')
    return read_units({kind: str(unit) for kind, unit in units.items()})


def _epoch(top: dict[str, Json]) -> str | None:
    if "epoch" not in top:
        return None
    epoch = top["epoch"]
    _check_plain_text(epoch, '"epoch"')
    return str(epoch)


def _check_plain_text(data: Json, where: str) -> None:
    """Refuse what is not a text: a number, too, of which the text is kept."""
    if not isinstance(data, str) or isinstance(data, Number):
        raise InputError(f"{where}: not a text, got {shown(data)}")


def _body(data: Json, index: int, span: Span) -> Body:
    where = f"body {index}"
    if isinstance(data, dict) and isinstance(data.get("name"), str):
        where = f"body {shorten(str(data['name']))}"
    allowed = {
        "vertices",
        "motion",
        "closed",
        "keyframes",
        "radius",
        "holes",
        "parts",
        "properties",
        *_ERRORS,
    }
    body = an_object(data, where, required=["name"], optional=allowed)
    name = body["name"]
    if not isinstance(name, str) or isinstance(name, Number) or not is_text(name):
        advice = f'; write "{name}"' if isinstance(name, Number) and len(name) < 50 else ""
        raise InputError(f'{where}: "name": expected a text, got {shown(name)}{advice}')
    if sum(key in body for key in ("vertices", "keyframes", "parts")) != 1:
        raise InputError(f'{where}: needs either "vertices" or "keyframes" or "parts"')
    if "holes" in body and "vertices" not in body:
        raise InputError(f'{where}: "holes" belong to "vertices"')
    closed = body.get("closed", True)
    if not isinstance(closed, bool):
        raise InputError(f'{where}: "closed": not true or false: {shown(closed)}')
    motion = _motion(body["motion"], f'{where}: "motion"', span) if "motion" in body else REST
    radius = _radius(body["radius"], f'{where}: "radius"') if "radius" in body else QQ(0)
    more = properties_in(body.get("properties", {}), f'{where}: "properties"')
    errors = _stated_errors(body, where)
    if "keyframes" in body:
        frames = _keyframes(body["keyframes"], f'{where}: "keyframes"')
        return Body(
            name,
            motion=motion,
            closed=closed,
            keyframes=frames,
            radius=radius,
            properties=more,
            **errors,
        )
    if "parts" in body:
        rows = a_list(body["parts"], f'{where}: "parts"')
        if not rows:
            raise InputError(f'{where}: "parts": at least one part is needed')
        parts = [_part(row, f"{where}: part {i}") for i, row in enumerate(rows)]
        return Body(
            name,
            motion=motion,
            parts=parts,
            closed=closed,
            radius=radius,
            properties=more,
            **errors,
        )
    vertices = _ring(body["vertices"], f'{where}: "vertices"', where, closed=closed)
    holes = _holes(body, where)
    return Body(
        name,
        vertices,
        motion,
        closed=closed,
        holes=holes,
        radius=radius,
        properties=more,
        **errors,
    )


def _stated_errors(body: dict[str, Json], where: str) -> dict[str, Any]:
    """Return the stated errors of a body, as arguments of `Body`."""
    errors: dict[str, Any] = {}
    for key in ("place_error", "angle_error"):
        if key in body:
            errors[key] = exact_number(body[key], f'{where}: "{key}"')
    for key in ("shape_error", "pivot"):
        if key in body:
            errors[key] = _pair(body, key, where, ("0", "0"))
    return errors


def _part(data: Json, where: str) -> dict[str, object]:
    part = an_object(data, where, required=["vertices"], optional={"holes"})
    vertices = _ring(part["vertices"], f'{where}: "vertices"', where)
    return {"vertices": vertices, "holes": _holes(part, where)}


def _holes(data: dict[str, Json], where: str) -> list[list[Position]]:
    rows = a_list(data.get("holes", []), f'{where}: "holes"')
    return [_ring(row, f"{where}: hole {i}", f"{where}: hole {i}") for i, row in enumerate(rows)]


def _ring(data: Json, where: str, of: str, *, closed: bool = True) -> list[Position]:
    """Return the vertices of a ring, named ``where``; each is a vertex ``of`` something."""
    rows = a_list(data, where)
    if not rows:
        raise InputError(f"{where}: at least one vertex is needed")
    vertices = [_vertex(row, f"{of}: vertex {i}") for i, row in enumerate(rows)]
    if closed and len(rows) > 3 and vertices[0] == vertices[-1]:  # also if it is written otherwise
        raise InputError(f"{where}: the last repeats the first: {shown(rows[-1])}")
    return vertices


def _radius(data: Json, where: str) -> QQ:
    radius = exact_number(data, where)
    if radius < 0:
        raise InputError(f"{where}: it is negative: {show(radius)}")
    return radius


def _vertex(data: Json, where: str) -> Position:
    check_budget()
    if isinstance(data, dict):
        an_object(data, where, optional={"x", "y"})
        return _coordinate(data, "x", where), _coordinate(data, "y", where)
    x, y = a_list(data, where, length=2)
    at = exact_number(x, f"{where}: x"), exact_number(y, f"{where}: y")
    return Polynomial([at[0]]), Polynomial([at[1]])


def _keyframes(data: Json, where: str) -> list[tuple[QQ, list[tuple[QQ, QQ]]]]:
    rows = a_list(data, where)
    if not rows:
        raise InputError(f"{where}: at least one is needed")
    frames = []
    for i, row in enumerate(rows):
        at = f"{where}[{i}]"
        frame = an_object(row, at, required=["t", "vertices"])
        points = []
        for j, point in enumerate(a_list(frame["vertices"], f'{at}: "vertices"')):
            x, y = a_list(point, f"{at}: vertex {j}", length=2)
            points.append(
                (exact_number(x, f"{at}: vertex {j}: x"), exact_number(y, f"{at}: vertex {j}: y"))
            )
        if not points:
            raise InputError(f'{at}: "vertices": at least one is needed')
        frames.append((exact_number(frame["t"], f'{at}: "t"'), points))
    return frames


def _motion(data: Json, where: str, span: Span) -> Motion:
    """Return a motion of a body in a scene with this time span."""
    if isinstance(data, dict) and "pieces" in data:
        an_object(data, where, required=["pieces"], optional={*_RECORDS})
        if len(given := [key for key in _RECORDS if key in data]) > 1:
            raise InputError(f'{where}: "{given[0]}" and "{given[1]}" exclude each other')
        pieces: list[tuple[QQ | None, SimpleMotion]] = []
        rows = a_list(data["pieces"], f'{where}: "pieces"')
        for i, row in enumerate(rows):
            at = f'{where}: "pieces"[{i}]'
            piece = an_object(row, at, required=["motion"], optional={"until"})
            until = exact_number(piece["until"], f'{at}: "until"') if "until" in piece else None
            if (until is None) != (i == len(rows) - 1):
                raise InputError(f'{at}: "until" belongs to every piece but the last')
            pieces.append((until, _simple_motion(piece["motion"], f'{at}: "motion"')))
        spin = _rate_and_error(data["spin"], f'{where}: "spin"') if "spin" in data else None
        path = _path(data["path"], f'{where}: "path"') if "path" in data else None
        off = _spline_error(data["spline"], f'{where}: "spline"') if "spline" in data else None
        try:
            if path:
                from exactpt.motion.pose_path import PosePath

                return PosePath.of_pieces(pieces, *path)
            if spin:
                from exactpt.motion.spin import spin_of_pieces

                turning = spin_of_pieces(pieces, *spin, span)
                _check_pivot(turning.pivot, data["spin"])
                return turning
            if off is not None:
                from exactpt.motion.local_time import Spline

                return Spline(pieces, off)
            return Pieces(pieces)
        except InputError as error:
            raise InputError(f"{where}: {error}") from None
    return _simple_motion(data, where)


def _rate_and_error(data: Json, where: str) -> tuple[QQ, QQ]:
    spin = an_object(data, where, required=["omega", "error"], optional={"pivot"})
    omega, error = (exact_number(spin[key], f'{where}: "{key}"') for key in ("omega", "error"))
    return omega, error


def _check_pivot(pivot: tuple[Fraction, Fraction], spin: Json) -> None:
    """Check that the record of a spin names no other pivot than its pieces have."""
    if not isinstance(spin, dict) or "pivot" not in spin:
        return
    named = _pair(spin, "pivot", '"spin"', ("0", "0"))
    if (named[0], named[1]) != pivot:
        raise InputError(
            f'"spin": "pivot": it must be that of the pieces, {show(*map(QQ, pivot))}, got '
            f"{show(*named)}"
        )


def _spline_error(data: Json, where: str) -> QQ:
    """Return the error of a spline, by which the given curve may be off the pieces."""
    spline = an_object(data, where, required=["error"])
    return exact_number(spline["error"], f'{where}: "error"')


def _path(data: Json, where: str) -> tuple[list[QQ], list[list[Polynomial]], QQ, QQ, QQ, list[QQ]]:
    """Return the times, the poses, the three errors and the pivot of a path."""
    required = ["error", "place_error", "times", "poses"]
    path = an_object(data, where, required=required, optional={"assumed_angle_error", "pivot"})
    times = [exact_number(t, f'{where}: "times"') for t in a_list(path["times"], where)]
    poses = []
    for i, row in enumerate(a_list(path["poses"], where)):
        at = f'{where}: "poses"[{i}]'
        pose = an_object(row, at, required=["x", "y", "angle"])
        poses.append([_coordinate(pose, key, at) for key in ("x", "y", "angle")])
    error, off = (exact_number(path[k], f'{where}: "{k}"') for k in ("error", "place_error"))
    assumed = exact_number(
        path.get("assumed_angle_error", Number("0")), f'{where}: "assumed_angle_error"'
    )
    pivot = _pair(path, "pivot", where, ("0", "0"))
    return times, poses, error, off, assumed, pivot


def _simple_motion(data: Json, where: str) -> SimpleMotion:
    if isinstance(data, dict) and "rigid" in data:
        an_object(data, where, required=["rigid"])
        at = f'{where}: "rigid"'
        optional = {"pivot", "x", "y", "orientation"}
        rigid = an_object(data["rigid"], at, required=["half_turn"], optional=optional)
        pivot = _pair(rigid, "pivot", at, ("0", "0"))
        orientation = _pair(rigid, "orientation", at, ("1", "0"))
        x, y = _coordinate(rigid, "x", at), _coordinate(rigid, "y", at)
        half_turn = _coordinate(rigid, "half_turn", at)
        try:
            return Rigid(half_turn, pivot=pivot, x=x, y=y, orientation=orientation)
        except InputError as error:
            raise InputError(f"{at}: {error}") from None
    if isinstance(data, dict) and "affine" in data:
        an_object(data, where, required=["affine"])
        at = f'{where}: "affine"'
        affine = an_object(data["affine"], at, required=["matrix"], optional={"x", "y"})
        rows = a_list(affine["matrix"], f'{at}: "matrix"', length=2)
        matrix = [
            [_polynomial(p, f'{at}: "matrix"') for p in a_list(row, f'{at}: "matrix"', length=2)]
            for row in rows
        ]
        return Affine(matrix, x=_coordinate(affine, "x", at), y=_coordinate(affine, "y", at))
    translation = an_object(data, where, optional={"x", "y"})
    return Translation(_coordinate(translation, "x", where), _coordinate(translation, "y", where))


def _pair(data: dict[str, Json], key: str, where: str, default: tuple[str, str]) -> list[QQ]:
    both = a_list(data.get(key, [*map(Number, default)]), f'{where}: "{key}"', length=2)
    return [exact_number(c, f'{where}: "{key}"') for c in both]


def _coordinate(data: dict[str, Json], key: str, where: str) -> Polynomial:
    return _polynomial(data[key], f'{where}: "{key}"') if key in data else Polynomial()


def _polynomial(data: Json, where: str) -> Polynomial:
    return Polynomial([exact_number(c, where) for c in a_list(data, where)])
