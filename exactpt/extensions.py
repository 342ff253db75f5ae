"""Functions of higher packages, imported on first use, by name.

Values of lower packages call functions of higher ones at extension points. Examples are the
picture of a scene in a notebook, and a body from a geometry of another library. The lower package
knows only the name; `exactpt` registers the function.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

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
