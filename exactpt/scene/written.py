"""Scenes written as JSON, exactly: what `exactpt.scene.format` reads back."""

from __future__ import annotations

import json
from collections.abc import Sequence
from json.encoder import encode_basestring_ascii
from pathlib import Path
from typing import TYPE_CHECKING

from exactpt.errors import InputError
from exactpt.files import write_atomically
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.local_time import Spline
from exactpt.motion.motions import (
    REST,
    Affine,
    Motion,
    Pieces,
    Position,
    Rigid,
    Translation,
)
from exactpt.motion.pose_path import PosePath
from exactpt.motion.spin import Spin
from exactpt.scene.json_values import (
    MAX_DIGITS,
    VERSION,
    is_too_long,
    parse_json,
    properties_in,
    with_long_texts,
)

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene


def _text(value: QQ) -> str:
    text = str(value)
    if len(text) > MAX_DIGITS and is_too_long(value):
        raise InputError(
            f"more than {MAX_DIGITS} digits have no place in a scene file: {show(value)}"
        )
    return text


def _coefficients(f: Polynomial) -> list[str]:
    return [_text(c) for c in f.exact_coefficients] or ["0"]


def to_json(scene: Scene) -> dict[str, object]:
    """Return the scene as JSON data, rationals as ``"p/q"``; `loads` gives the same scene back.

    Of a `Spin` it has the pieces that cover the time span.

    Raises:
        InputError: if it has a number or a custom motion that files cannot hold.
    """
    data: dict[str, object] = {
        "exactpt": VERSION,
        "time": [_text(scene.exact_start), _text(scene.exact_end)],
    }
    data |= _units_to_json(scene)
    span = scene.exact_start, scene.exact_end
    data["bodies"] = [_named_body_to_json(body, span) for body in scene.bodies]
    data |= _groups_to_json(scene)
    return data


def _units_to_json(scene: Scene) -> dict[str, object]:
    data: dict[str, object] = {}
    if scene.units is not None:
        data["units"] = scene.units.given()
    if scene.epoch is not None:
        data["epoch"] = scene.epoch
    return data


def _groups_to_json(scene: Scene) -> dict[str, object]:
    """Return the groups of bodies that ignore each other, under their key; nothing without any."""
    return {"ignoring": [list(group) for group in scene.ignoring]} if scene.ignoring else {}


def _named_body_to_json(body: Body, span: tuple[QQ, QQ]) -> dict[str, object]:
    try:
        return _body_to_json(body, span)
    except InputError as error:
        raise InputError(f"body {shorten(body.name)}: {error}") from None


def _body_to_json(body: Body, span: tuple[QQ, QQ]) -> dict[str, object]:
    data: dict[str, object] = {"name": body.name}
    if not body.closed:
        data["closed"] = False
    if body.exact_radius:
        data["radius"] = _text(body.exact_radius)
    data |= body.exact_errors.given(_text)
    if body.exact_shape.keyframes:
        data["keyframes"] = [
            {"t": _text(f.t), "vertices": [[_text(x), _text(y)] for x, y in f.vertices]}
            for f in body.exact_shape.keyframes
        ]
    elif len(body.parts) > 1:
        data["parts"] = [_part_to_json(body, rings) for rings in body.parts]
    else:
        data |= _part_to_json(body, body.parts[0])
    if body.motion != REST:
        data["motion"] = _motion_to_json(body.motion, span)
    if body.properties:
        data["properties"] = json_properties(body)
    return data


def json_properties(body: Body) -> dict[str, object]:
    """Return the properties of a body.

    Raises:
        InputError: if JSON has no such data.
    """
    try:
        text = json.dumps(with_long_texts(body.properties), allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(f"properties: {error}") from None
    return properties_in(parse_json(text), "properties")


def _part_to_json(body: Body, rings: Sequence[range]) -> dict[str, object]:
    outline, *holes = (_ring_to_json(body, ring) for ring in rings)
    return {"vertices": outline, "holes": holes} if holes else {"vertices": outline}


def _ring_to_json(body: Body, ring: range) -> list[object]:
    doubles = body.exact_shape.doubles
    if doubles is None:
        return [_vertex_to_json(body.vertices[i]) for i in ring]
    xs, ys = doubles
    return [[_of_double(xs[i]), _of_double(ys[i])] for i in ring]


def _of_double(x: float) -> str:
    """Return what `_text` does of its value."""
    n, d = x.as_integer_ratio()
    return f"{n}/{d}" if d > 1 else str(n)


def _vertex_to_json(vertex: Position) -> object:
    x, y = [_coefficients(f) for f in vertex]
    return [*x, *y] if len(x) == len(y) == 1 else {"x": x, "y": y}


def _motion_to_json(motion: Motion, span: tuple[QQ, QQ]) -> dict[str, object]:
    if isinstance(motion, Spin):
        return {**_motion_to_json(motion.pieces_during(*span), span), "spin": _spin_to_json(motion)}
    if isinstance(motion, Pieces):
        ends = [{"until": _text(t)} for t in motion.exact_until]
        pieces: dict[str, object] = {
            "pieces": [
                {**end, "motion": _motion_to_json(m, span)}
                for end, m in zip([*ends, {}], motion.motions, strict=True)
            ]
        }
        if isinstance(motion, PosePath):
            pieces["path"] = _path_to_json(motion)
        if isinstance(motion, Spline):
            pieces["spline"] = {"error": _text(motion.exact_error)}
        return pieces
    if isinstance(motion, Rigid):
        rigid = {
            "pivot": [_text(c) for c in motion.exact_pivot],
            "half_turn": _coefficients(motion.half_turn),
            "x": _coefficients(motion.x),
            "y": _coefficients(motion.y),
        }
        if motion.exact_orientation[0] != 1:
            rigid["orientation"] = [_text(c) for c in motion.exact_orientation]
        return {"rigid": rigid}
    if isinstance(motion, Affine):
        matrix = [[_coefficients(p) for p in row] for row in motion.matrix]
        x, y = _coefficients(motion.x), _coefficients(motion.y)
        return {"affine": {"matrix": matrix, "x": x, "y": y}}
    if isinstance(motion, Translation):
        return {"x": _coefficients(motion.x), "y": _coefficients(motion.y)}
    raise InputError(f"a motion of this kind has no place in a scene file: {shorten(motion)}")


def _spin_to_json(spin: Spin) -> dict[str, object]:
    return {
        "omega": _text(spin.exact_omega),
        "error": _text(spin.exact_error),
        **({"pivot": [_text(c) for c in spin.exact_pivot]} if any(spin.exact_pivot) else {}),
    }


def _path_to_json(path: PosePath) -> dict[str, object]:
    assumed = path.exact_assumed_angle_error
    return {
        "error": _text(path.exact_error),
        "place_error": _text(path.exact_place_error),
        **({"assumed_angle_error": _text(assumed)} if assumed else {}),
        **({"pivot": [_text(c) for c in path.exact_pivot]} if any(path.exact_pivot) else {}),
        "times": [_text(t) for t in path.exact_times],
        "poses": [
            {"x": _coefficients(x), "y": _coefficients(y), "angle": _coefficients(angle)}
            for x, y, angle in path.exact_poses
        ],
    }


def scene_bytes(scene: Scene) -> bytes:
    """Return the bytes of the scene's file: those to which a proof of it refers."""
    return (_indented(to_json(scene), "\n") + "\n").encode()


def save(scene: Scene, path: Path) -> None:
    """Write a scene file atomically."""
    write_atomically(path, scene_bytes(scene))


def _indented(data: object, line: str) -> str:
    """Return what ``json.dumps(data, indent=1)`` does: its own encoder takes much longer.

    Args:
        data: the data, with texts as keys.
        line: the end of a line, and the indentation of the next one.
    """
    if isinstance(data, str):
        return encode_basestring_ascii(data)
    more, text = f"{line} ", encode_basestring_ascii
    if data and isinstance(data, list):
        values = [text(one) if type(one) is str else _indented(one, more) for one in data]
        return f"[{more}{f',{more}'.join(values)}{line}]"
    if data and isinstance(data, dict):
        pairs = [f"{text(key)}: {_indented(value, more)}" for key, value in data.items()]
        return f"{{{more}{f',{more}'.join(pairs)}{line}}}"
    return str(data) if type(data) is int else json.dumps(data)
