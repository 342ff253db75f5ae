"""Kept cases: the scenes of tests/cases, which a person constructed or in which a fault was found.

A file holds one case. Its name without ``.json`` is the name of the case, and ``case/NAME`` is its
source. Its keys are

* ``note``: what is special about the scene, or what was wrong, in a line or two,
* ``scene``: the scene, as `exactpt.Scene.from_json` reads it,
* ``law`` and ``case``, if a law was broken: its name, and the ``SOURCE:SEED:NUMBER`` at which it
  was, from which its random choices follow,
* ``skip``, if a law does not suit the scene and cannot say so itself: reasons, by law.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, TypeAlias

from exactpt import InputError, Scene

__all__ = [
    "FOLDER",
    "PREFIX",
    "Kept",
    "file_of_finding",
    "kept",
    "kept_of_source",
    "names",
    "text_of",
]

FOLDER: Final = Path(__file__).parents[2] / "tests" / "cases"

PREFIX: Final = "case/"
"""What the source of a kept case begins with."""

REQUIRED: Final = {"note", "scene"}
OPTIONAL: Final = {"law", "case", "skip"}

Json: TypeAlias = Mapping[str, object]


@dataclass(frozen=True, slots=True)
class Kept:
    """A kept case.

    Attributes:
        note: what is special about the scene, or what was wrong.
        scene: the scene.
        law: the law that was broken; "" if none was.
        place: the source, the seed and the number of the case that broke it.
        skip: laws that are not checked, each with the reason.
    """

    note: str
    scene: Scene
    law: str = ""
    place: str = ""
    skip: Mapping[str, str] = field(default_factory=dict)


def names() -> list[str]:
    """Return the names of all kept cases."""
    return sorted(path.stem for path in FOLDER.glob("*.json"))


def kept(name: str) -> Kept:
    """Return the kept case of a name.

    Raises:
        InputError: if its file is not of the form above; the message names it.
    """
    path = FOLDER / f"{name}.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    missing, unknown = REQUIRED - set(data), set(data) - REQUIRED - OPTIONAL
    if missing or unknown:
        wrong = f"no {' and no '.join(sorted(missing))}" if missing else "unknown keys"
        raise InputError(f"{path.name}: {wrong}, got the keys {sorted(data)}; see docs/laws.md")
    if not data["note"].strip():
        raise InputError(f"{path.name}: the note is empty; write what is special about the scene")
    if ("law" in data) != ("case" in data):
        raise InputError(f"{path.name}: law and case belong together, got only one of them")
    try:
        scene = Scene.from_json(data["scene"])
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    law, place, skip = data.get("law", ""), data.get("case", ""), data.get("skip", {})
    return Kept(data["note"], scene, law, place, skip)


def kept_of_source(source: str) -> Kept | None:
    """Return the kept case of a source, without its changes; None if it is another source."""
    head, *_ = source.split("+")
    return kept(head.removeprefix(PREFIX)) if head.startswith(PREFIX) else None


def text_of(case: Json) -> str:
    """Return the text of a file: a line for each body."""
    lines = []
    for key, value in case.items():
        if key == "scene":
            lines.append(f' "scene": {_text_of_scene(value)}')
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _text_of_scene(scene: object) -> str:
    assert isinstance(scene, dict)  # noqa: S101 - as `Scene.to_json` returns it
    parts = []
    for key, value in scene.items():
        text = json.dumps(value)
        if key == "bodies":
            text = "[\n  " + ",\n  ".join(map(json.dumps, value)) + "\n ]"
        parts.append(f"{json.dumps(key)}: {text}")
    return "{" + ", ".join(parts) + "}"


def file_of_finding(witness: str, scene: Json, note: str) -> dict[Path, bytes]:
    """Return the file of a scene to which a witness objects, given as JSON data."""
    digest = hashlib.sha256(json.dumps(scene, sort_keys=True).encode()).hexdigest()[:10]
    path = FOLDER / f"{witness}-{digest}.json"
    return {path: text_of({"note": note, "scene": scene}).encode()}
