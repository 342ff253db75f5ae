"""The corpus: shrunk scenes that once failed, each with a note on the fault.

``<witness>-<hash>.json`` is a scene, to be run like any other; ``<witness>-<hash>.txt``
beside it says what was found, where, and (written by hand) what caused it.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Final

__all__ = ["FOLDER", "files", "files_of"]

FOLDER: Final = Path(__file__).parent / "corpus"


def files(folder: Path = FOLDER) -> list[Path]:
    """The scene files of a corpus."""
    return sorted(folder.glob("*.json"))


def files_of(witness: str, scene: object, note: str) -> dict[Path, bytes]:
    """Return the files of a new scene, given as JSON data, and of its note."""
    digest = hashlib.sha256(json.dumps(scene, sort_keys=True).encode()).hexdigest()[:10]
    path = FOLDER / f"{witness}-{digest}.json"
    text = json.dumps(scene, indent=1) + "\n"
    return {path: text.encode(), path.with_suffix(".txt"): note.encode()}
