"""The file of a saved simulation: readable JSON, one entry per line."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from exactpt.errors import AuditError, InputError
from exactpt.scene.format import loads
from exactpt.scene.scene import Scene

__all__ = ["VERSION", "json_text", "reading", "scene_from_json"]

VERSION: Final = 4
"""Version of the file format; files of other versions are refused."""
WIDTH: Final = 100
"""Maximum number of characters of a value on one line."""


def json_text(data: Mapping[str, object]) -> str:
    """JSON text in which every value that fits on one line is on one line."""
    return _text(data, "") + "\n"


def _text(value: object, indent: str) -> str:
    line = json.dumps(value)
    if len(line) <= WIDTH or not isinstance(value, (dict, list)) or not value:
        return line
    inner = indent + " "
    if isinstance(value, dict):
        rows = [f"{json.dumps(key)}: {_text(v, inner)}" for key, v in value.items()]
        opening, closing = "{", "}"
    else:
        opening, closing = "[", "]"
        if all(isinstance(v, (int, float)) for v in value):
            return line
        rows = [_text(v, inner) for v in value]
    return f"{opening}\n{inner}" + f",\n{inner}".join(rows) + f"\n{indent}{closing}"


def scene_from_json(data: Mapping[str, Any]) -> Scene:
    """The scene in the data of a file."""
    return loads(json.dumps(data))


@contextmanager
def reading(path: Path) -> Iterator[dict[str, Any]]:
    """The data of a file; an error in using it inside the context is an input error.

    Raises:
        InputError: if the file cannot be read, is of another version, or damaged.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ValueError) as error:
        raise InputError(f"{path}: cannot be read: {error}") from None
    version = data.get("exactpt-simulation") if isinstance(data, dict) else None
    if version != VERSION:
        raise InputError(f"{path}: this version reads simulations {VERSION}, not {version!r}")
    try:
        yield data
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, AuditError) as error:
        raise InputError(f"{path}: not a saved simulation: {error!r}") from None
