"""What upper rooms add to the values of lower ones, by name; imported when it is used.

A scene shows itself in a notebook, and a body comes from another library's geometry. The
room of the value knows the name of the extension alone; `exactpt` registers where it is.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

__all__ = ["extension", "register"]

_places: dict[str, str] = {}


def register(name: str, place: str) -> None:
    """Say where an extension is.

    Args:
        name: of the extension.
        place: ``"module:function"``.
    """
    _places[name] = place


def extension(name: str) -> Callable[..., Any]:
    """The function that has been registered under a name."""
    module, _, function = _places[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
