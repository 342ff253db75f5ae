"""Groups of bodies that ignore each other, as texts: names of bodies, and patterns.

A text that is the name of a body means that body, also if it ends in ``*``. Otherwise a text that
ends in ``*`` means every body whose name starts with the text before the star. A body may be in
several groups. Ignoring is not transitive: bodies ignore each other if one group has both.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import Body
from exactpt.motion.tileable import are_tileable

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene

Groups: TypeAlias = tuple[tuple[str, ...], ...]
"""Groups of texts, as they were given."""

STAR: Final = "*"
"""The end of a pattern."""
NO_TILING: Final = (
    "a tiling (a simulation, a proof, the free space) watches all bodies; first_contact, "
    "contacts, certify and exactpt collide obey the groups and keep none"
)
"""The reason why a question that keeps a tiling refuses groups."""


def groups_given(ignoring: Iterable[Iterable[str]]) -> Groups:
    """Return the groups of a caller, whose texts are not looked up yet.

    Raises:
        InputError: if they are not groups of texts.
    """
    if isinstance(ignoring, str) or not isinstance(ignoring, Iterable):
        raise InputError(f"ignoring: groups of names are needed, got {shorten(ignoring)}")
    return tuple(_group_given(group, f"ignoring[{k}]") for k, group in enumerate(ignoring))


def _group_given(group: Iterable[str], where: str) -> tuple[str, ...]:
    if isinstance(group, str) or not isinstance(group, Iterable):
        raise InputError(f"{where}: a group of names is needed, got {shorten(group)}")
    texts = tuple(group)
    for text in texts:
        if not isinstance(text, str):
            raise InputError(f"{where}: a name or a pattern is a text, got {shorten(text)}")
    return texts


def names_of(bodies: Sequence[Body]) -> list[str]:
    """Return the names of bodies; those in arrays are not made for it."""
    if not isinstance(bodies, (tuple, list)):
        from exactpt.scene.body_arrays import BodyArrays

        if isinstance(bodies, BodyArrays):
            return [bodies.name(k) for k in range(len(bodies))]
    return [body.name for body in bodies]


def members_of(groups: Groups, names: Sequence[str]) -> list[list[int]]:
    """Return the bodies of each group, by their numbers, each once and sorted.

    Args:
        groups: the groups.
        names: the names of all bodies, each at the body's number.

    Raises:
        InputError: if a text means no body, or a group has fewer than two bodies.
    """
    if not groups:
        return []
    number = {name: i for i, name in enumerate(names)}
    found: list[list[int]] = []
    for k, group in enumerate(groups):
        members: set[int] = set()
        for text in group:
            meant = _meant_by(text, number)
            if not meant:
                raise InputError(f"ignoring[{k}]: {_nobody(text)}")
            members.update(meant)
        if len(members) < 2:
            raise InputError(
                f"ignoring[{k}]: a group needs at least two bodies, got {shorten(list(group))}"
            )
        found.append(sorted(members))
    return found


def kept_groups(groups: Groups, before: Iterable[str], after: Iterable[str]) -> Groups:
    """Return the groups of a scene for other bodies, of which some may be gone or new.

    Without an error, names and patterns that have lost their bodies are dropped, and groups of
    which fewer than two bodies are left. The name of a body that is gone does not become a pattern.

    Args:
        groups: the groups of the bodies before.
        before: the names of the bodies for which the groups were made.
        after: the names of the other bodies.
    """
    known, number = set(before), {name: i for i, name in enumerate(after)}
    kept = []
    for group in groups:
        meant_by = {
            text: _meant_by(text, number) for text in group if text in number or text not in known
        }
        texts = tuple(text for text in group if meant_by.get(text))
        members = {i for meant in meant_by.values() for i in meant}
        if len(members) > 1:
            kept.append(texts)
    return tuple(kept)


def _meant_by(text: str, number: dict[str, int]) -> Collection[int]:
    """Return the numbers of the bodies that a text means."""
    if text in number:
        return [number[text]]
    if not text.endswith(STAR):
        return []
    begin = text.removesuffix(STAR)
    return [i for name, i in number.items() if name.startswith(begin)]


def _nobody(text: str) -> str:
    if text.endswith(STAR):
        return f"no body has a name of the pattern {shorten(text)}"
    return f"there is no body {shorten(text)}"


def is_tileable(scene: Scene) -> bool:
    """Return True if a tiling can hold the bodies of a scene, and every pair of them counts."""
    return not scene.ignoring and are_tileable(scene.bodies)


def refuse_groups(scene: Scene, why: str) -> None:
    """Refuse a scene in which bodies ignore each other, for a question that cannot obey that.

    Args:
        scene: the scene.
        why: which question it is, and what to use instead, as the end of the message.

    Raises:
        InputError: if the scene has groups.
    """
    if scene.ignoring:
        group = shorten(list(scene.ignoring[0]))
        raise InputError(
            f'bodies of this scene ignore each other ("ignoring"), such as those of {group}: {why}'
        )


def refuse_ignored_pair(scene: Scene, a: str, b: str) -> None:
    """Refuse a question about two bodies that ignore each other in the scene.

    Args:
        scene: the scene, which has bodies of both names.
        a: the name of one of them.
        b: the name of the other one.

    Raises:
        InputError: if a group of the scene has both.
    """
    if not scene.ignoring:
        return
    names = names_of(scene.bodies)
    both = {names.index(a), names.index(b)}
    if any(both <= set(members) for members in members_of(scene.ignoring, names)):
        raise InputError(
            f"bodies {shorten(a)} and {shorten(b)} ignore each other in this scene; take one of "
            "them out of the group that has both"
        )
