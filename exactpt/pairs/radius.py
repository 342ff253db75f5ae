"""The first contact of a scene with rounded bodies: by pairs, and never by a tiling.

Bodies without radius meet each other, and themselves, as in a scene of their own. Two bodies of
which one is rounded touch where the distance of their cores is the sum of the radii; a rounded
body does not touch itself. The earlier of the two first contacts counts, or both together.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import NamedTuple, TypeAlias

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.incidence import Touch
from exactpt.pairs.contact import Contact, contact_of, touches_of
from exactpt.pairs.radius_search import RoundedSearch
from exactpt.scene.scene import Scene

__all__ = ["first_contact_of_rounded"]

Groups: TypeAlias = "list[Collection[str]]"
Plain: TypeAlias = "Callable[[Scene, Groups], Contact | None]"
"""The first contact of bodies without radius, with groups that ignore each other."""


def first_contact_of_rounded(
    scene: Scene, groups: Groups, plain: Plain, *, exact_only: bool = False
) -> Contact | None:
    """The first contact in the closed time span of a scene; None if there is none."""
    search = RoundedSearch(scene, groups, exact_only=exact_only)
    met = dict(search.at_start())
    try:
        first = _first_of_plain(scene, groups, plain)
        if met or first.overlaps:
            touching = [ij for ij, overlaps in met.items() if not overlaps]
            start = AlgebraicNumber(scene._start)
            touches = list(search.touches(touching, start))
            if first.overlaps:
                touches += first.touches
            return contact_of(scene, start, touches, sorted([*first.overlaps, *met]))
        found = search.after_start(first.time)
    except BudgetExceeded as spent:
        spent.reached = scene.start if not met and spent.reached is not None else None
        raise
    if found is None or (first.time is not None and found.time.compare(first.time) > 0):
        return None if first.time is None else contact_of(scene, first.time, first.touches)
    touches = list(search.touches(found.pairs, found.time))
    if first.time is not None and found.time.compare(first.time) == 0:
        touches += first.touches
    return contact_of(scene, found.time, touches)


class _First(NamedTuple):
    """The first contact of the bodies without radius, by their indices in the whole scene."""

    time: AlgebraicNumber | None
    touches: list[Touch]
    overlaps: list[tuple[int, int]]


def _first_of_plain(scene: Scene, groups: Groups, plain: Plain) -> _First:
    bodies = [body for body in scene.bodies if not body._radius]
    names = {body.name for body in bodies}
    part = scene.going_on(bodies, scene._start)
    contact = plain(part, [[name for name in group if name in names] for group in groups])
    if contact is None:
        return _First(None, [], [])
    index = {body.name: i for i, body in enumerate(scene.bodies)}
    touches = touches_of(contact, index)
    return _First(contact.time, touches, [(index[a], index[b]) for a, b in contact.overlaps])
