"""Scenes as JSON: read with every refusal of the contract, written exactly.

Numbers never pass through a float: JSON numbers reach `parse_rational` as the text
that is in the file.
"""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, parse_rational, shorten
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
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
from exactpt.scene.scene import Scene

__all__ = ["load", "loads", "save", "to_json", "write_atomically"]

VERSION: Final = 1
MOST_DIGITS: Final = 10_000
"""Numerators and denominators have no more: exact arithmetic would not end with many more."""
MOST_BITS: Final = 33_220
"""The length of the largest number with so many digits."""


class _Number(str):
    """The text of a JSON number."""

    __slots__ = ()


Json: TypeAlias = "bool | str | list[Json] | dict[str, Json] | None"
"""A parsed JSON value; numbers are `_Number`, so they stay text."""


def load(path: Path) -> Scene:
    """Read a scene file.

    Raises:
        InputError: one line that names the file, the body, the key and the value.
    """
    shown = path if str(path).isprintable() else repr(str(path))
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8"
        raise InputError(f"{shown}: cannot be read: {reason}") from None
    try:
        return loads(text)
    except InputError as error:
        raise InputError(f"{shown}: {error}") from None


def loads(text: str) -> Scene:
    """The scene that a JSON text describes.

    Raises:
        InputError: one line that names the body, the key and the value.
    """
    try:
        data: Json = json.loads(
            text,
            parse_int=_Number,
            parse_float=_Number,
            parse_constant=_Number,  # NaN and the infinities: refused where they stand
            object_pairs_hook=_unique_keys,
        )
        return _scene(data)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(f"not JSON: {error.msg} at {where}") from None
    except RecursionError:
        raise InputError("not a scene: nested too deeply") from None


def _unique_keys(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    result: dict[str, Json] = {}
    for key, value in pairs:
        if key in result:
            raise InputError(f"the key {shorten(key)} is there twice")
        result[key] = value
    return result


def _scene(data: Json) -> Scene:
    top = _object(data, "scene", required=["exactpt", "time", "bodies"])
    if top["exactpt"] != _Number(VERSION) or not isinstance(top["exactpt"], _Number):
        raise InputError(
            f'"exactpt": this version reads format {VERSION}, not {_show(top["exactpt"])}'
        )
    span = _list(top["time"], '"time"', length=2)
    time = [_number(span[0], '"time"[0]'), _number(span[1], '"time"[1]')]
    bodies = [_body(b, i) for i, b in enumerate(_list(top["bodies"], '"bodies"'))]
    return Scene(bodies, time)


def _body(data: Json, index: int) -> Body:
    where = f"body {index}"
    if isinstance(data, dict) and isinstance(data.get("name"), str):
        where = f"body {shorten(str(data['name']))}"
    allowed = {"vertices", "motion", "closed", "keyframes"}
    body = _object(data, where, required=["name"], optional=allowed)
    name = body["name"]
    if not isinstance(name, str) or isinstance(name, _Number) or not _is_text(name):
        raise InputError(f'{where}: "name": not a text: {_show(name)}')
    if ("vertices" in body) == ("keyframes" in body):
        raise InputError(f'{where}: needs either "vertices" or "keyframes"')
    closed = body.get("closed", True)
    if not isinstance(closed, bool):
        raise InputError(f'{where}: "closed": not true or false: {_show(closed)}')
    motion = _motion(body["motion"], f'{where}: "motion"') if "motion" in body else REST
    if "keyframes" in body:
        frames = _keyframes(body["keyframes"], f'{where}: "keyframes"')
        return Body(name, motion=motion, closed=closed, keyframes=frames)
    rows = _list(body["vertices"], f'{where}: "vertices"')
    if not rows:
        raise InputError(f'{where}: "vertices": at least one is needed')
    vertices = [_vertex(row, f"{where}: vertex {i}") for i, row in enumerate(rows)]
    return Body(name, vertices, motion, closed=closed)


def _is_text(name: str) -> bool:
    """Whether a name is not empty, and can be printed: no half of a surrogate pair."""
    try:
        return bool(name.encode())
    except UnicodeEncodeError:
        return False


def _vertex(data: Json, where: str) -> Position:
    if isinstance(data, dict):
        _object(data, where, optional={"x", "y"})
        return _coordinate(data, "x", where), _coordinate(data, "y", where)
    x, y = _list(data, where, length=2)
    return Polynomial([_number(x, f"{where}: x")]), Polynomial([_number(y, f"{where}: y")])


def _keyframes(data: Json, where: str) -> list[tuple[QQ, list[tuple[QQ, QQ]]]]:
    rows = _list(data, where)
    if not rows:
        raise InputError(f"{where}: at least one is needed")
    frames = []
    for i, row in enumerate(rows):
        at = f"{where}[{i}]"
        frame = _object(row, at, required=["t", "vertices"])
        points = []
        for j, point in enumerate(_list(frame["vertices"], f'{at}: "vertices"')):
            x, y = _list(point, f"{at}: vertex {j}", length=2)
            points.append((_number(x, f"{at}: vertex {j}: x"), _number(y, f"{at}: vertex {j}: y")))
        if not points:
            raise InputError(f'{at}: "vertices": at least one is needed')
        frames.append((_number(frame["t"], f'{at}: "t"'), points))
    return frames


def _motion(data: Json, where: str) -> Motion:
    if isinstance(data, dict) and "pieces" in data:
        _object(data, where, required=["pieces"])
        pieces: list[tuple[QQ | None, SimpleMotion]] = []
        rows = _list(data["pieces"], f'{where}: "pieces"')
        for i, row in enumerate(rows):
            at = f'{where}: "pieces"[{i}]'
            piece = _object(row, at, required=["motion"], optional={"until"})
            until = _number(piece["until"], f'{at}: "until"') if "until" in piece else None
            if (until is None) != (i == len(rows) - 1):
                raise InputError(f'{at}: "until" belongs to every piece but the last')
            pieces.append((until, _simple_motion(piece["motion"], f'{at}: "motion"')))
        try:
            return Pieces(pieces)
        except InputError as error:
            raise InputError(f"{where}: {error}") from None
    return _simple_motion(data, where)


def _simple_motion(data: Json, where: str) -> SimpleMotion:
    if isinstance(data, dict) and "rigid" in data:
        _object(data, where, required=["rigid"])
        at = f'{where}: "rigid"'
        rigid = _object(data["rigid"], at, required=["half_turn"], optional={"pivot", "x", "y"})
        pivot = _list(rigid.get("pivot", [_Number("0"), _Number("0")]), f'{at}: "pivot"', length=2)
        return Rigid(
            _coordinate(rigid, "half_turn", at),
            pivot=[_number(c, f'{at}: "pivot"') for c in pivot],
            x=_coordinate(rigid, "x", at),
            y=_coordinate(rigid, "y", at),
        )
    if isinstance(data, dict) and "affine" in data:
        _object(data, where, required=["affine"])
        at = f'{where}: "affine"'
        affine = _object(data["affine"], at, required=["matrix"], optional={"x", "y"})
        rows = _list(affine["matrix"], f'{at}: "matrix"', length=2)
        matrix = [
            [_polynomial(p, f'{at}: "matrix"') for p in _list(row, f'{at}: "matrix"', length=2)]
            for row in rows
        ]
        return Affine(matrix, x=_coordinate(affine, "x", at), y=_coordinate(affine, "y", at))
    translation = _object(data, where, optional={"x", "y"})
    return Translation(_coordinate(translation, "x", where), _coordinate(translation, "y", where))


def _coordinate(data: dict[str, Json], key: str, where: str) -> Polynomial:
    return _polynomial(data[key], f'{where}: "{key}"') if key in data else Polynomial()


def _polynomial(data: Json, where: str) -> Polynomial:
    return Polynomial([_number(c, where) for c in _list(data, where)])


def _number(data: Json, where: str) -> QQ:
    if not isinstance(data, str):
        raise InputError(f"{where}: not a number: {_show(data)}")
    try:
        value = QQ(0) if len(data) > 3 * MOST_DIGITS else parse_rational(data)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None
    bits = max(value.numerator.bit_length(), value.denominator.bit_length())
    if len(data) > 3 * MOST_DIGITS or bits > MOST_BITS:
        raise InputError(f"{where}: more than {MOST_DIGITS} digits: {shorten(str(data))}")
    return value


def _list(data: Json, where: str, length: int | None = None) -> list[Json]:
    if not isinstance(data, list):
        raise InputError(f"{where}: not a list: {_show(data)}")
    if length is not None and len(data) != length:
        raise InputError(f"{where}: {length} entries are needed, not {len(data)}: {_show(data)}")
    return data


def _object(
    data: Json,
    where: str,
    required: Iterable[str] = (),
    optional: Iterable[str] = (),
) -> dict[str, Json]:
    if not isinstance(data, dict):
        raise InputError(f"{where}: not an object: {_show(data)}")
    for key in required:
        if key not in data:
            raise InputError(f'{where}: the key "{key}" is missing')
    unknown = set(data) - set(required) - set(optional)
    if unknown:
        raise InputError(
            f"{where}: unknown key {shorten(min(unknown))}: {_show(data[min(unknown)])}"
        )
    return data


def _show(data: Json) -> str:
    if isinstance(data, _Number):
        return shorten(str(data))[1:-1]
    return shorten(json.loads(json.dumps(data)) if isinstance(data, (list, dict)) else data)


def _text(value: QQ) -> str:
    return str(value)


def _coefficients(f: Polynomial) -> list[str]:
    return [_text(c) for c in f.coefficients] or ["0"]


def to_json(scene: Scene) -> dict[str, object]:
    """The scene as JSON data, rationals as ``"p/q"``; `loads` gives the same scene back."""
    return {
        "exactpt": VERSION,
        "time": [_text(scene.start), _text(scene.end)],
        "bodies": [_body_to_json(body) for body in scene.bodies],
    }


def _body_to_json(body: Body) -> dict[str, object]:
    data: dict[str, object] = {"name": body.name}
    if not body.closed:
        data["closed"] = False
    if body.keyframes:
        data["keyframes"] = [
            {"t": _text(f.t), "vertices": [[_text(x), _text(y)] for x, y in f.vertices]}
            for f in body.keyframes
        ]
    else:
        data["vertices"] = [
            [_text(x(0)), _text(y(0))]
            if x.degree <= 0 and y.degree <= 0
            else {"x": _coefficients(x), "y": _coefficients(y)}
            for x, y in body.vertices
        ]
    if body.motion is not REST:
        data["motion"] = _motion_to_json(body.motion)
    return data


def _motion_to_json(motion: Motion) -> dict[str, object]:
    if isinstance(motion, Pieces):
        ends = [{"until": _text(t)} for t in motion.until]
        return {
            "pieces": [
                {**end, "motion": _motion_to_json(m)}
                for end, m in zip([*ends, {}], motion.motions, strict=True)
            ]
        }
    if isinstance(motion, Rigid):
        return {
            "rigid": {
                "pivot": [_text(c) for c in motion.pivot],
                "half_turn": _coefficients(motion.half_turn),
                "x": _coefficients(motion.x),
                "y": _coefficients(motion.y),
            }
        }
    if isinstance(motion, Affine):
        matrix = [[_coefficients(p) for p in row] for row in motion.matrix]
        x, y = _coefficients(motion.x), _coefficients(motion.y)
        return {"affine": {"matrix": matrix, "x": x, "y": y}}
    if isinstance(motion, Translation):
        return {"x": _coefficients(motion.x), "y": _coefficients(motion.y)}
    raise InputError(f"a motion of this kind has no place in a scene file: {motion!r}")


def save(scene: Scene, path: Path) -> None:
    """Write a scene file; it is complete or not there."""
    write_atomically(path, json.dumps(to_json(scene), indent=1) + "\n")


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a file by way of a temporary neighbour, so that no half of it is ever seen.

    A pipe or a device is written to as it is, never replaced.

    Raises:
        InputError: if the file cannot be written.
    """
    try:
        data = content.encode() if isinstance(content, str) else content
        if path.exists() and not path.is_file():
            path.write_bytes(data)
        else:
            _replace(path, data)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None


def _replace(path: Path, data: bytes) -> None:
    descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(name, 0o666 & ~umask)
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise
