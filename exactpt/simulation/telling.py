"""The events of a tiling, as users see them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, final

from exactpt.motion.vertex import Vertex
from exactpt.simulation.event import Event
from exactpt.tiling.events import TilingEvent
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.tiling.events import Edges

__all__ = ["Teller"]


@final
class Teller:
    """Makes the events of a tiling, as users see them.

    Nothing of an event is computed until it is asked for, neither its time nor the names of its
    vertices. An event keeps the vertices, since their ids may be those of other ones by then.

    Attributes:
        tiling: the tiling.
    """

    def __init__(self, tiling: Tiling) -> None:
        self.tiling: Tiling = tiling

    def told(self, events: Sequence[TilingEvent]) -> list[Event]:
        """Events that have just happened, with the vertices that have their ids now."""
        certifier = self.tiling.certifier
        return [
            Event(certifier.moment(e.time), e.kind, self._ends(e.removed), self._ends(e.added))
            for e in events
        ]

    def _ends(self, edges: Edges) -> tuple[tuple[Vertex, Vertex], ...]:
        every = self.tiling.vertices.all
        return tuple([(every[u], every[v]) for u, v in edges])
