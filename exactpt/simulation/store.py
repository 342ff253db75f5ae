"""The file of a saved simulation: readable JSON, one entry per line, with a checksum."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from exactpt.errors import AuditError, BudgetExceeded, InputError, RoundingError
from exactpt.files import read_text
from exactpt.kernel.numbers import shorten
from exactpt.kernel.stored import Stored
from exactpt.scene.format import loads
from exactpt.scene.json_values import unique_keys
from exactpt.scene.scene import Scene

VERSION: Final = 6
"""Version of the file format; files of other versions are refused."""
WIDTH: Final = 100
"""Maximum number of characters of a value on one line."""


def sealed(data: Mapping[str, object]) -> dict[str, object]:
    """Return the data with version and checksum: the SHA-256 of the data as JSON without spaces."""
    return {"exactpt-simulation": VERSION, "sha256": _checksum(data), **data}


def _checksum(data: Mapping[str, object]) -> str:
    return hashlib.sha256(json.dumps(data, separators=(",", ":")).encode()).hexdigest()


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


def scene_from_json(data: Stored) -> Scene:
    """Return the scene in the data of a file."""
    return loads(json.dumps(data.data))


@contextmanager
def reading(path: Path, max_bytes: int | None = None) -> Iterator[Stored]:
    """Yield the data of a file; errors of its use inside the context are input errors.

    Raises:
        InputError: if the file cannot be read, is larger than ``max_bytes``, of another version,
            or not as it was written.
    """
    text = read_text(path, max_bytes)
    try:
        data = json.loads(text, object_pairs_hook=unique_keys)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else error
        raise InputError(f"{path}: cannot be read: {reason}") from None
    version = data.pop("exactpt-simulation", None) if isinstance(data, dict) else None
    if version != VERSION:
        found = shorten(version)
        raise InputError(f"{path}: this version reads simulations {VERSION}, not {found}")
    if data.pop("sha256", None) != _checksum(data):
        raise InputError(f"{path}: checksum mismatch: the file was modified or is corrupt")
    try:
        yield Stored(data, "state")
    except (BudgetExceeded, MemoryError, RoundingError):
        raise
    except InputError as error:
        raise InputError(f"{path}: not a saved simulation: {error}") from None
    except AuditError as error:  # values that are valid one by one
        raise InputError(f"{path}: not a saved simulation: {shorten(str(error))[1:-1]}") from None
    except Exception as error:  # of the rules of a tiling from outside the package
        reason = f"{type(error).__name__}: {shorten(str(error))[1:-1]}"
        raise InputError(f"{path}: not a saved simulation: {reason}") from None
