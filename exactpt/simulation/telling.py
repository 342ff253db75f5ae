"""The events of a tiling, as users see them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, final

from exactpt.certificates.queue import EventTime
from exactpt.indices import VertexId
from exactpt.simulation.event import Event
from exactpt.tiling.events import TilingEvent
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.tiling.events import Edges

__all__ = ["Teller"]


@final
class Teller:
    """A tiling, the names of its vertices, and how far it has come.

    Nothing of an event is computed until it is asked for, except the names: the id of a vertex
    may be that of another one by then.

    Attributes:
        tiling: the tiling.
        passed: the last time up to which it has been advanced.
    """

    def __init__(self, tiling: Tiling) -> None:
        self.tiling: Tiling = tiling
        self.passed: EventTime | None = None
        self._names: dict[VertexId, str] = {}

    def advance(self, until: QQ) -> list[TilingEvent] | None:
        """As `Tiling.advance`."""
        events = self.tiling.advance(until)
        self.passed = self.tiling.certifier.now
        return events

    def told(self, events: Sequence[TilingEvent]) -> list[Event]:
        """Events that have just happened, with vertices named as in the scene."""
        certifier = self.tiling.certifier
        return [
            Event(certifier.moment(e.time), e.kind, self._named(e.removed), self._named(e.added))
            for e in events
        ]

    def _named(self, edges: Edges) -> tuple[tuple[str, str], ...]:
        return tuple([(self.name(u), self.name(v)) for u, v in edges])

    def name(self, vertex_id: VertexId) -> str:
        """The name of a vertex in events; of a removed one, as long as its id is not used again."""
        name = self._names.get(vertex_id)
        if name is None:
            name = self._names[vertex_id] = self.tiling.vertices.name(vertex_id)
        return name

    def forget(self, ring: Iterable[VertexId]) -> None:
        """Forget the names of the vertices whose ids a new body has."""
        for vertex_id in ring:
            self._names.pop(vertex_id, None)
