"""The pairs of bodies that count: groups of bodies that ignore each other, and named pairs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import TypedDict, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene


class _Names(TypedDict):
    between: Sequence[Sequence[str]] | None
    ignoring: Sequence[Collection[str]]


@final
class Selection:
    """The pairs of bodies of a scene that count.

    Args:
        scene: the bodies.
        between: pairs of names; other pairs do not count. All if not given.
        ignoring: groups of body names; pairs within a group do not count.

    Attributes:
        named: the pairs i < j of body numbers that ``between`` names and that count, each once,
            sorted; None if it is not given.
        group: the group number of each body; a body in no group has a number of its own.

    Raises:
        InputError: if a name is unknown, or a pair is not one of two bodies.
    """

    __slots__ = ("_between", "_ignoring", "group", "named")

    def __init__(
        self,
        scene: Scene,
        between: Iterable[Sequence[str]] | None = None,
        ignoring: Iterable[Collection[str]] = (),
    ) -> None:
        self._ignoring = ignoring if isinstance(ignoring, str) else list(ignoring)
        self._between = None if between is None else list(between)
        self.group = groups_of(scene, self._ignoring)
        self.named: list[tuple[int, int]] | None = None
        if self._between is not None:
            self.named = self.of(_numbered(scene, self._between))

    @property
    def is_all(self) -> bool:
        """True if every pair of bodies counts."""
        return self.named is None and self.group == list(range(len(self.group)))

    def among(self, bodies: Sequence[Body]) -> _Names:
        """Return the arguments of a selection of the same pairs of some of the bodies."""
        names = {body.name for body in bodies}
        between = self._between and [pair for pair in self._between if names.issuperset(pair)]
        return {"between": between, "ignoring": [names.intersection(g) for g in self._ignoring]}

    def of(self, pairs: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
        """Return those of some pairs i < j that count, in their order."""
        group, named = self.group, None if self.named is None else set(self.named)
        return [
            (i, j) for i, j in pairs if group[i] != group[j] and (named is None or (i, j) in named)
        ]


def _numbered(scene: Scene, between: Iterable[Sequence[str]]) -> list[tuple[int, int]]:
    """Return pairs of names as pairs i < j of body numbers, each once, sorted."""
    number = {body.name: i for i, body in enumerate(scene.bodies)}
    pairs: set[tuple[int, int]] = set()
    for names in between:
        if isinstance(names, str) or len(names) != 2 or names[0] == names[1]:
            raise InputError(f"between: not the names of two bodies: {shorten(names)}")
        for name in names:
            if name not in number:
                raise InputError(f"between: there is no body {shorten(name)}")
        i, j = sorted(number[name] for name in names)
        pairs.add((i, j))
    return sorted(pairs)


def groups_of(scene: Scene, ignoring: Iterable[Collection[str]]) -> list[int]:
    """Return the group number of each body; a body in no group has a number of its own.

    Raises:
        InputError: if a name is unknown, or it is in two groups, or a group is a text.
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
                raise InputError(f"ignoring: there is no body {shorten(name)}")
            if group[number[name]] >= len(number):
                raise InputError(f"body {shorten(name)} is in two groups that ignore each other")
            group[number[name]] = k
    return group
