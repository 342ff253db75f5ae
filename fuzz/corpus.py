"""The corpus: shrunk scenes that once failed, each with a note on the fault.

``<witness>-<hash>.json`` is a scene, to be run like any other; ``<witness>-<hash>.txt``
beside it says what was found, where, and (written by hand) what caused it.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Final

from exactpt.files import write_atomically
from fuzz.cases import Case, Failure

__all__ = ["FOLDER", "files", "save"]

FOLDER: Final = Path(__file__).parent / "corpus"


def files(folder: Path = FOLDER) -> list[Path]:
    """The scene files of a corpus."""
    return sorted(folder.glob("*.json"))


def save(failure: Failure, case: Case, folder: Path = FOLDER) -> Path:
    """Write a failure and its note; returns the path of the scene."""
    data = json.loads(failure.scene)
    text = json.dumps(data, indent=1) + "\n"
    digest = hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()[:10]
    path = folder / f"{failure.witness}-{digest}.json"
    folder.mkdir(exist_ok=True)
    write_atomically(path, text)
    found = f"fuzz {failure.witness}, {case.family} {case.seed}: {failure.why}\n"
    write_atomically(path.with_suffix(".txt"), found)
    return path
