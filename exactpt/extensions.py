"""Imports on first use, by name: functions of higher packages, and modules that have moved.

Values of lower packages call functions of higher ones at extension points. Examples are the
picture of a scene in a notebook, and a body from a geometry of another library. The lower package
knows only the name; `exactpt` registers the function. Modules that have moved since 0.2 are found
under the names that they had, which pickles of that version contain.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Final

_places: dict[str, str] = {}


def register(name: str, place: str) -> None:
    """Register an extension.

    Args:
        name: the name of the extension.
        place: the function, as ``"module:function"``.
    """
    _places[name] = place


def extension(name: str) -> Callable[..., Any]:
    """Return the function registered under a name."""
    module, _, function = _places[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found


MOVED: Final = {
    "exactpt.collision.approach": "exactpt.pairs.approach",
    "exactpt.collision.contact": "exactpt.pairs.contact",
    "exactpt.collision.incidences": "exactpt.pairs.incidences",
    "exactpt.proximity": "exactpt.pairs",
    "exactpt.proximity.clearance": "exactpt.pairs.clearance",
    "exactpt.proximity.distance": "exactpt.pairs.distance",
    "exactpt.proximity.features": "exactpt.pairs.features",
    "exactpt.proximity.intervals": "exactpt.pairs.intervals",
    "exactpt.simulation.plans": "exactpt.simulation.motion_changes",
}
"""The name of each moved module in 0.2, and its name today."""


class Moved:
    """Finder and loader of modules under the names that they had: each is the module of today."""

    @staticmethod
    def find_spec(name: str, _path: object = None, _target: object = None) -> ModuleSpec | None:
        """Return the spec of a module that has moved, or None."""
        return ModuleSpec(name, Moved) if name in MOVED else None  # type: ignore[arg-type]

    @staticmethod
    def create_module(spec: ModuleSpec) -> ModuleType:
        """Return the module of today, and keep its own spec, which the import system replaces."""
        module = import_module(MOVED[spec.name])
        spec.loader_state = module.__spec__
        return module

    @staticmethod
    def exec_module(module: ModuleType) -> None:
        """Give the module its own spec again."""
        spec = module.__spec__
        module.__spec__ = spec and spec.loader_state


# The first finder: the path of a moved package would find a second copy of its modules.
sys.meta_path.insert(0, Moved)
