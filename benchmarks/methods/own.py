"""The methods of exactpt: by a tiling, by pairs, and the exact reference search."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from typing import Final, TypeAlias

from benchmarks.machine import is_compiled
from benchmarks.methods.method import Answer, Method
from exactpt import Contact, Scene, first_contact
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing import reference
from exactpt.testing.reference import FirstContact

__all__ = ["EXACT_SEARCH", "OWN", "fresh", "in_build"]


def fresh(scene: Scene) -> Scene:
    """A copy of the scene as if just loaded, without cached values."""
    return loads(json.dumps(to_json(scene)))


Search: TypeAlias = "Callable[[Scene], Contact | FirstContact | None]"
"""From a scene to its first contact."""


def _prepare(ask: Search, scene: Scene) -> Callable[[], Answer]:
    given = fresh(scene)

    def time_of_contact() -> Answer:
        contact = ask(given)
        return None if contact is None else contact.time

    return time_of_contact


def in_build(setting: str) -> str:
    """A setting of exactpt; in a compiled build its name has this, beside that of plain Python."""
    return f"{setting}, compiled" if is_compiled() else setting


OWN: Final = tuple(
    Method("exactpt", in_build(method), partial(_prepare, partial(first_contact, method=method)))
    for method in ("kinetic", "pairs")
)
"""The methods that users call."""

EXACT_SEARCH: Final = Method("all pairs, exact", "", partial(_prepare, reference.first_contact))
"""The exact reference search over all pairs."""
