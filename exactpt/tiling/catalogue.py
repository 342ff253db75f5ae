"""The catalogue of tilings, in which each of them is registered."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, unique
from typing import Final, NamedTuple, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten


@final
@unique
class Bodies(Enum):
    """The bodies that a tiling is for."""

    ANY = "any"
    CONVEX = "convex"
    POINTS = "points"


class Entry(NamedTuple):
    """A line of the catalogue.

    Attributes:
        name: the name by which users choose it.
        bodies: the bodies that it is for.
        place: its class, as ``module:class``; imported on first use.
        is_canonical: whether the tiling is determined by the positions alone, not by the past.
        has_fewest_events: whether it is preferred where only the first contact is wanted.
        has_relative_hulls: whether its mesh contains the shortest loop around every body.
        has_fan: whether it can maintain the fan triangulation (paper, section 3.4): its class
            then has an argument ``fan``.
    """

    name: str
    bodies: Bodies
    place: str
    is_canonical: bool = True
    has_fewest_events: bool = False
    has_relative_hulls: bool = False
    has_fan: bool = False

    @property
    def is_for_convex(self) -> bool:
        """True if it is for convex bodies alone; another tiling may have the same name."""
        return self.bodies is Bodies.CONVEX


AUTO: Final = "auto"
"""Stands for the first tiling of the catalogue that is for the given bodies."""

ENTRIES: Final = [
    Entry(
        "incremental",
        Bodies.POINTS,
        "exactpt.tiling.incremental.incremental:IncrementalTiling",
        has_fewest_events=True,
        has_fan=True,
    ),
    Entry("greedy", Bodies.CONVEX, "exactpt.tiling.greedy.greedy:VerticalRules"),
    Entry("mixed", Bodies.ANY, "exactpt.tiling.mixed.mixed:MixedRules", has_relative_hulls=True),
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
    """Return all names that a user may give."""
    return list(dict.fromkeys([AUTO, *(entry.name for entry in ENTRIES)]))


def names(*, points: bool) -> list[str]:
    """Return the names of the tilings of any bodies; of points alone too, if there are but such."""
    kinds = (Bodies.CONVEX, Bodies.ANY, *([Bodies.POINTS] if points else []))
    found = [entry for kind in kinds for entry in ENTRIES if entry.bodies is kind]
    return list(dict.fromkeys(entry.name for entry in found))


def choose(
    name: str, *, points: bool, convex: Callable[[], bool], fewest_events: bool = False
) -> Entry:
    """Return the tiling with a name that is for the bodies; by "auto" the first one that is.

    Args:
        name: one of `names`, or `AUTO`.
        points: whether the bodies are points alone.
        convex: whether they stay convex; called only if it matters.
        fewest_events: whether by "auto" only tilings with the fewest events are meant.

    Raises:
        InputError: if there is none.
    """
    for entry in ENTRIES:
        if name == AUTO:
            is_meant = entry.has_fewest_events or not fewest_events
            fits = entry.bodies is not Bodies.POINTS or points
        else:
            is_meant, fits = entry.name == name, True  # `plan_tiling` refuses the others
        if is_meant and fits and (entry.bodies is not Bodies.CONVEX or convex()):
            return entry
    raise InputError(f"no tiling {shorten(name)}; there are: {', '.join(known())}")


def find(name: str, *, convex: bool) -> Entry:
    """Return the tiling of a saved run.

    Args:
        name: its name.
        convex: whether it is for convex bodies alone.
    """
    return choose(name, points=True, convex=lambda: convex)


def has_convex_rules(name: str) -> bool:
    """Return True if a tiling of this name has other rules for convex bodies."""
    return any(entry.name == name and entry.is_for_convex for entry in ENTRIES)


def with_relative_hulls() -> Entry:
    """Return the first tiling of any bodies whose mesh contains their relative hulls."""
    return next(e for e in ENTRIES if e.has_relative_hulls and e.bodies is Bodies.ANY)
