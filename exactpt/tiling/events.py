"""What happened: the record of one event of a tiling."""

from __future__ import annotations

from typing import NamedTuple, final

from exactpt.certificates.queue import EventTime
from exactpt.motion.incidence import Touch

__all__ = ["ContactFound", "Stats", "TilingEvent"]


class TilingEvent(NamedTuple):
    """A change of a tiling.

    Attributes:
        time: when.
        kind: "corner", "reflex", "hull", "diagonal", "motion", "x-order" or "contact".
        removed, added: edges, as pairs of vertex ids.
    """

    time: EventTime
    kind: str
    removed: tuple[tuple[int, int], ...]
    added: tuple[tuple[int, int], ...]


@final
class ContactFound(Exception):  # noqa: N818 - an outcome that ends the run, no error
    """The first contact has been reached.

    Attributes:
        touches: every vertex-edge and vertex-vertex incidence at that time.
    """

    def __init__(self, touches: list[Touch]) -> None:
        super().__init__(f"{len(touches)} touches")
        self.touches = touches


@final
class Stats:
    """Counts of a run.

    Attributes:
        events: changes of the tiling by kind.
        batches: times at which more than one certificate failed.
        rebuilds: how often a batch had to be settled by building the tiling anew.
        flips: repair flips after a batch, towards the canonical tiling.
        most: the largest number of certificates with a pending failure.
        fan: edges that have come or gone in the fan triangulation of points, if it is kept.
    """

    def __init__(self) -> None:
        self.events: dict[str, int] = {}
        self.batches: int = 0
        self.rebuilds: int = 0
        self.flips: int = 0
        self.most: int = 0
        self.fan: int = 0

    def count(self, kind: str) -> None:
        """Note an event."""
        self.events[kind] = self.events.get(kind, 0) + 1

    @property
    def total(self) -> int:
        """The number of events of all kinds."""
        return sum(self.events.values())
