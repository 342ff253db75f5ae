"""The catalogue of tilings: the one place where a structure is registered."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, unique
from typing import Final, NamedTuple, final

from exactpt.errors import InputError

__all__ = ["AUTO", "ENTRIES", "Bodies", "Entry", "choose", "find", "known", "names"]


@final
@unique
class Bodies(Enum):
    """For which bodies a tiling is."""

    ANY = "any"
    CONVEX = "convex"
    POINTS = "points"


class Entry(NamedTuple):
    """A line of the catalogue.

    Attributes:
        name: what it is asked for by.
        bodies: for which it is.
        place: of its rules, ``module:class``; imported when it is asked for.
        is_canonical: whether the tiling of a time does not depend on what happened before.
        has_fewest_events: whether it is for those who only want the first contact.
    """

    name: str
    bodies: Bodies
    place: str
    is_canonical: bool = True
    has_fewest_events: bool = False


AUTO: Final = "auto"
"""Asks for the first tiling of the catalogue that is for the bodies."""

ENTRIES: Final = [
    Entry(
        "incremental",
        Bodies.POINTS,
        "exactpt.tiling.incremental.incremental:IncrementalTiling",
        has_fewest_events=True,
    ),
    Entry("greedy", Bodies.CONVEX, "exactpt.tiling.greedy.greedy:VerticalRules"),
    Entry("mixed", Bodies.ANY, "exactpt.tiling.mixed.mixed:MixedRules"),
    Entry("greedy", Bodies.ANY, "exactpt.tiling.greedy.shadowed:ShadowRules"),
    Entry(
        "lazy",
        Bodies.ANY,
        "exactpt.tiling.lazy:LazyRules",
        is_canonical=False,
        has_fewest_events=True,
    ),
]
"""All tilings; of two with one name the first that is for the bodies is meant."""


def known() -> list[str]:
    """All that can be asked for."""
    return list(dict.fromkeys([AUTO, *(entry.name for entry in ENTRIES)]))


def names(*, points: bool) -> list[str]:
    """The names of the tilings of any bodies; of points alone too, if there are but such."""
    kinds = (Bodies.CONVEX, Bodies.ANY, *([Bodies.POINTS] if points else []))
    found = [entry for kind in kinds for entry in ENTRIES if entry.bodies is kind]
    return list(dict.fromkeys(entry.name for entry in found))


def choose(
    name: str, *, points: bool, convex: Callable[[], bool], fewest_events: bool = False
) -> Entry:
    """The tiling with a name that is for the bodies; by "auto" the first one that is.

    Args:
        name: one of `names`, or `AUTO`.
        points: whether the bodies are points alone.
        convex: whether they stay convex; asked only if it matters.
        fewest_events: whether by "auto" only tilings with the fewest events are meant.

    Raises:
        InputError: if there is none.
    """
    for entry in ENTRIES:
        if name == AUTO:
            is_meant = entry.has_fewest_events or not fewest_events
            fits = entry.bodies is not Bodies.POINTS or points
        else:
            is_meant, fits = entry.name == name, True  # `vertices_of_points` refuses the others
        if is_meant and fits and (entry.bodies is not Bodies.CONVEX or convex()):
            return entry
    raise InputError(f"no tiling {name!r}; there are: {', '.join(known())}")


def find(name: str, *, convex: bool) -> Entry:
    """The tiling of a saved run.

    Args:
        name: its name.
        convex: whether it is for convex bodies.
    """
    return choose(name, points=True, convex=lambda: convex)
