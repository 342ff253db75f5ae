"""What the catalogue says of a tiling."""

from __future__ import annotations

from enum import Enum, unique
from typing import NamedTuple, final

__all__ = ["Bodies", "Entry"]


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
