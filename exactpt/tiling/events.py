"""Events of a tiling: the record of one event, the log, and counts."""

from __future__ import annotations

from typing import TypeAlias, final

from mypy_extensions import mypyc_attr

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.indices import Ends, VertexId
from exactpt.motion.track import Incidence

Edges: TypeAlias = tuple[Ends, ...]
"""Edges, as pairs of vertex ids."""


@final
@mypyc_attr(acyclic=True)
class TilingEvent:
    """A change of a tiling.

    Attributes:
        time: the time of the event.
        kind: "corner", "reflex", "hull", "diagonal", "motion", "x-order", "fan" or "contact".
        removed, added: the edges removed and added, as pairs of vertex ids; of the fan
            triangulation, if the kind is "fan".
    """

    __slots__ = ("added", "kind", "removed", "time")

    def __init__(self, time: EventTime, kind: str, removed: Edges, added: Edges) -> None:
        self.time: EventTime = time
        self.kind: str = kind
        self.removed: Edges = removed
        self.added: Edges = added


@final
class ContactFound(Exception):  # noqa: N818 - an outcome that ends the run, no error
    """The first contact has been reached.

    Attributes:
        touches: all incidences of a vertex with an edge or a vertex at that time.
    """

    def __init__(self, touches: list[Incidence]) -> None:
        super().__init__(f"{len(touches)} touches")
        self.touches = touches


@final
class Stats:
    """Counts of a run.

    Attributes:
        events: changes of the tiling by kind.
        batches: times at which more than one certificate failed.
        rebuilds: number of times at which the repairs failed and the tiling was rebuilt.
        flips: number of flips made by checks after a failure group, to make the tiling canonical.
        most: maximum number of pending certificates.
    """

    def __init__(self) -> None:
        self.events: dict[str, int] = {}
        self.batches: int = 0
        self.rebuilds: int = 0
        self.flips: int = 0
        self.most: int = 0

    def count(self, kind: str) -> None:
        """Count an event."""
        self.events[kind] = self.events.get(kind, 0) + 1

    @property
    def total(self) -> int:
        """The number of events of all kinds."""
        return sum(self.events.values())


@final
class Log:
    """The events not yet reported.

    Attributes:
        stats: counts of the run.
        is_recording: whether events are reported; otherwise they are only counted.
    """

    def __init__(self, certifier: Certifier, stats: Stats) -> None:
        self._certifier: Certifier = certifier
        self.stats: Stats = stats
        self.is_recording: bool = True
        self._events: list[TilingEvent] = []

    def slide(self, kind: str, old: VertexId, fixed: VertexId, new: VertexId) -> None:
        """Record the slide of one end of an edge; no vertex has copies."""
        self.stats.count(kind)
        if self.is_recording:
            now = self._certifier.now
            self._events.append(TilingEvent(now, kind, ((old, fixed),), ((new, fixed),)))

    def record(self, kind: str, removed: Edges, added: Edges) -> None:
        """Record a change; one that only permutes copies of a vertex is counted as internal."""
        if self._has_copies(removed) and self._scene_edges(removed) == self._scene_edges(added):
            self.stats.count("internal")
        else:
            self.stats.count(kind)
            if self.is_recording:
                self._events.append(TilingEvent(self._certifier.now, kind, removed, added))

    def record_fan(self, removed: Edges, added: Edges) -> None:
        """Record a change of the fan triangulation, which is no event of the tiling's counts."""
        if self.is_recording:
            self._events.append(TilingEvent(self._certifier.now, "fan", removed, added))

    def take(self) -> list[TilingEvent]:
        """Return the events not yet reported, which then count as reported."""
        events, self._events = self._events, []
        return events

    def _has_copies(self, edges: Edges) -> bool:
        """Return True if an edge ends at a vertex that has copies."""
        every = self._certifier.all
        for a, b in edges:  # noqa: SIM110 - called at every event
            if every[a].offset is not None or every[b].offset is not None:
                return True
        return False

    def _scene_edges(self, edges: Edges) -> set[frozenset[tuple[int, int]]]:
        v = self._certifier.all
        return {frozenset((v[i].body, v[i].index) for i in edge) for edge in edges}
