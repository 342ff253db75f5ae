"""The pairs of bodies that count: groups of bodies that ignore each other, and named pairs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Final, TypedDict, final

from exactpt.cached_property import cached_property
from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import Body
from exactpt.scene.groups import groups_given, members_of, names_of
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    # It imports numpy, of which two straight bodies have no need.
    from exactpt.kernel.doubles import Flags, Indices

_NONE: Final[frozenset[int]] = frozenset()
"""The groups of a body in no group."""


class _Names(TypedDict):
    between: Sequence[Sequence[str]] | None
    ignoring: Sequence[Collection[str]]


@final
class Selection:
    """The pairs of bodies of a scene that count.

    Two bodies do not count as a pair if a group of the scene or of the call has both, nor if pairs
    are named and they are not among these. A body counts with itself, unless pairs are named.

    >>> scene = Scene([Body(name, [(0, 0)]) for name in "abc"], ignoring=[("a", "b")])
    >>> some = Selection(scene, ignoring=[("b", "c")])
    >>> some.counts(0, 1), some.counts(0, 2), some.counts(1, 1)
    (False, True, True)

    Args:
        scene: the bodies, and their groups.
        between: pairs of names; other pairs do not count. All if not given.
        ignoring: more groups of names and patterns, as of a `Scene`.

    Attributes:
        bodies: the bodies of the scene.
        members: the numbers of the bodies of each group, those of the scene first.
        groups: for each body that is in a group, the numbers of its groups.
        named: the pairs i < j of body numbers that ``between`` names, each once, sorted; None if
            it is not given.

    Raises:
        InputError: if a name is unknown, a group has fewer than two bodies, or a named pair is not
            one of two bodies, or one that is ignored.
    """

    def __init__(
        self,
        scene: Scene,
        between: Iterable[Sequence[str]] | None = None,
        ignoring: Iterable[Iterable[str]] = (),
    ) -> None:
        more = groups_given(ignoring)
        members: list[list[int]] = []
        if scene.ignoring or more:
            names = names_of(scene.bodies)
            members = [*members_of(scene.ignoring, names), *members_of(more, names)]
        self.bodies = scene.bodies
        self.members: Sequence[Sequence[int]] = members
        self.groups: Mapping[int, frozenset[int]] = _groups_of_bodies(members)
        self.named: list[tuple[int, int]] | None = None
        if between is not None:
            self.named = self._counted(_numbered(scene, between), len(scene.ignoring))

    @property
    def is_all(self) -> bool:
        """True if every pair of bodies counts."""
        return self.named is None and not self.groups

    def ignores(self, i: int, j: int) -> bool:
        """Return True if a group has two different bodies."""
        groups = self.groups
        if i == j or not groups:
            return False
        return not groups.get(i, _NONE).isdisjoint(groups.get(j, _NONE))

    def counts(self, i: int, j: int) -> bool:
        """Return True if two bodies, or a body with itself, count as a pair."""
        if self.named is not None:
            return (min(i, j), max(i, j)) in self._named_set
        return not self.ignores(i, j)

    def of(self, pairs: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
        """Return those of some pairs that count, in their order."""
        return [(i, j) for i, j in pairs if self.counts(i, j)]

    def ignored(self, first: Indices, second: Indices) -> Flags:
        """For each pair of an entry of one array and one of the other, see `ignores`."""
        import numpy as np

        result = np.zeros(len(first), dtype=np.bool_)
        if not self.groups:
            return result
        offsets, numbers, keys = self._arrays
        size = np.diff(offsets)
        is_less = size[first] <= size[second]
        one, other = np.where(is_less, (first, second), (second, first))
        most = int(size[one].max(initial=0))
        for k in range(most):  # the k-th group of the body in fewer groups: is the other in it?
            (pairs,) = np.nonzero(size[one] > k)
            group = numbers[offsets[one[pairs]] + k]
            wanted = other[pairs] * len(self.members) + group
            place = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
            result[pairs] |= keys[place] == wanted
        result &= first != second
        return result

    def among(self, bodies: Sequence[Body]) -> _Names:
        """Return the arguments of a selection of the same pairs of some of the bodies.

        Its groups are of names alone, without patterns, for a scene without groups.
        """
        present = set(names_of(bodies))
        names = names_of(self.bodies)
        between: list[tuple[str, str]] | None = None
        if self.named is not None:
            pairs = ((names[i], names[j]) for i, j in self.named)
            between = [pair for pair in pairs if present.issuperset(pair)]
            return {"between": between, "ignoring": []}
        groups = [present.intersection(names[i] for i in some) for some in self.members]
        return {"between": None, "ignoring": [group for group in groups if len(group) > 1]}

    def of_bodies(self, numbers: Sequence[int]) -> Selection:
        """Return the selection of the same pairs of some bodies, which are numbered anew.

        No pairs are named.

        Args:
            numbers: the numbers of the bodies, increasing.
        """
        assert self.named is None  # noqa: S101 - `exactpt.search.selected` takes named pairs
        bodies = [self.bodies[i] for i in numbers]
        new = {i: k for k, i in enumerate(numbers)}
        members = [[new[i] for i in some if i in new] for some in self.members]
        return Selection.of_groups(bodies, members)

    @classmethod
    def of_groups(cls, bodies: Sequence[Body], groups: Sequence[Sequence[int]]) -> Selection:
        """Return the selection with these groups of body numbers; one of one body does nothing."""
        selection = cls.__new__(cls)
        selection.bodies, selection.members = bodies, groups
        selection.groups, selection.named = _groups_of_bodies(groups), None
        return selection

    def disjoint_groups(self) -> list[list[int]] | None:
        """Return groups that ignore the same pairs, no body in two of them; None if there are none.

        A group within another group adds nothing, and neither does an equal one.
        """
        found: list[list[int]] = []
        group_of: dict[int, int] = {}  # of each body, the position of its group
        for some in sorted(self.members, key=len, reverse=True):
            owners = {group_of.get(i) for i in some}
            if owners == {None}:
                group_of.update(dict.fromkeys(some, len(found)))
                found.append(sorted(some))
            elif len(owners) > 1:  # it shares bodies with a group that has not all of its bodies
                return None
        return sorted(some for some in found if len(some) > 1)

    @cached_property
    def _named_set(self) -> frozenset[tuple[int, int]]:
        return frozenset(self.named or ())

    @cached_property
    def _arrays(self) -> tuple[Indices, Indices, Indices]:
        """Offsets of the bodies in the next array; sorted group numbers of each; sorted keys.

        A key is the number of a body, times the number of groups, plus the number of a group.
        """
        import numpy as np

        each = [sorted(self.groups.get(i, _NONE)) for i in range(len(self.bodies))]
        sizes = [len(groups) for groups in each]
        offsets = np.cumsum([0, *sizes], dtype=np.int64)
        numbers = np.array([group for groups in each for group in groups], dtype=np.int64)
        owners = np.repeat(np.arange(len(each), dtype=np.int64), sizes)
        return offsets, numbers, owners * len(self.members) + numbers

    def _counted(
        self, pairs: Sequence[tuple[int, int]], groups_of_scene: int
    ) -> list[tuple[int, int]]:
        """Return named pairs, of which none may be ignored.

        Raises:
            InputError: if one is.
        """
        for i, j in pairs:
            if not self.ignores(i, j):
                continue
            shared = min(self.groups[i] & self.groups[j])
            where = "in this scene" if shared < groups_of_scene else "by ignoring="
            a, b = (shorten(self.bodies[k].name) for k in (i, j))
            raise InputError(
                f"between: bodies {a} and {b} ignore each other {where}; leave this pair out"
            )
        return list(pairs)


def _groups_of_bodies(members: Sequence[Sequence[int]]) -> dict[int, frozenset[int]]:
    """Return the numbers of the groups of each body that is in one."""
    found: dict[int, set[int]] = {}
    for group, bodies in enumerate(members):
        for i in bodies:
            found.setdefault(i, set()).add(group)
    return {i: frozenset(groups) for i, groups in found.items()}


def pairs_given(between: Iterable[Sequence[str]]) -> tuple[tuple[str, str], ...]:
    """Return the pairs of names of a caller, which are not looked up yet.

    Raises:
        InputError: if one is not a pair of two names.
    """
    pairs = []
    for names in between:
        if isinstance(names, str) or len(names) != 2 or names[0] == names[1]:
            raise InputError(f"between: not the names of two bodies: {shorten(names)}")
        pairs.append((names[0], names[1]))
    return tuple(pairs)


def _numbered(scene: Scene, between: Iterable[Sequence[str]]) -> list[tuple[int, int]]:
    """Return pairs of names as pairs i < j of body numbers, each once, sorted."""
    number = {name: i for i, name in enumerate(names_of(scene.bodies))}
    pairs: set[tuple[int, int]] = set()
    for names in pairs_given(between):
        for name in names:
            if name not in number:
                raise InputError(f"between: there is no body {shorten(name)}")
        i, j = sorted(number[name] for name in names)
        pairs.add((i, j))
    return sorted(pairs)
