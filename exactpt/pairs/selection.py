"""Groups of bodies that ignore each other."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.scene.scene import Scene

__all__ = ["groups_of"]


def groups_of(scene: Scene, ignoring: Iterable[Collection[str]]) -> list[int]:
    """The group number of each body; a body in no group has a number of its own.

    Raises:
        InputError: if there is no body of a name, or it is in two groups, or a group is a text.
    """
    if isinstance(ignoring, str):
        raise InputError(f"ignoring: groups of names, not the text {shorten(ignoring)}")
    if not (groups := list(ignoring)):
        return list(range(len(scene.bodies)))
    number = {body.name: i for i, body in enumerate(scene.bodies)}
    group = list(range(len(number)))
    for k, names in enumerate(groups, start=len(group)):
        if isinstance(names, str):
            raise InputError(f"ignoring: a group of names, not the text {shorten(names)}")
        for name in names:
            if name not in number:
                raise InputError(f"there is no body {name!r} to ignore others")
            if group[number[name]] >= len(number):
                raise InputError(f"body {name!r} is in two groups that ignore each other")
            group[number[name]] = k
    return group
