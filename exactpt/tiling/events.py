"""What happened: the record of one event of a tiling, the log, and the counts."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias, final

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.motion.incidence import Touch

__all__ = ["ContactFound", "Edges", "Log", "Stats", "TilingEvent"]


Edges: TypeAlias = "tuple[tuple[int, int], ...]"
"""Edges, as pairs of vertex ids."""


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


@final
class Log:
    """What has happened since it was last told.

    Attributes:
        stats: counts of the run.
    """

    def __init__(self, certifier: Certifier, stats: Stats) -> None:
        self._certifier: Certifier = certifier
        self.stats: Stats = stats
        self._events: list[TilingEvent] = []

    def record(self, kind: str, removed: Edges, added: Edges) -> None:
        """Note a change; one between copies of a thin vertex is none for the outside."""
        if self._has_copies(removed) and self._scene_edges(removed) == self._scene_edges(added):
            self.stats.count("internal")
        else:
            self.stats.count(kind)
            self._events.append(TilingEvent(self._certifier.now, kind, removed, added))

    def take(self) -> list[TilingEvent]:
        """The changes that have not been told yet."""
        events, self._events = self._events, []
        return events

    def _has_copies(self, edges: Edges) -> bool:
        """Whether an edge ends at a vertex that has copies."""
        every = self._certifier.all
        for a, b in edges:  # noqa: SIM110 - called at every event
            if every[a].offset is not None or every[b].offset is not None:
                return True
        return False

    def _scene_edges(self, edges: Edges) -> set[frozenset[tuple[int, int]]]:
        v = self._certifier.all
        return {frozenset((v[i].body, v[i].index) for i in edge) for edge in edges}
