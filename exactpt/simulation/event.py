"""Events as users see them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, TypeAlias, cast, final

from mypy_extensions import mypyc_attr

from exactpt.brief import counted, cut
from exactpt.certificates.moment import Moment
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.vertex import Vertex, VertexList
from exactpt.tiling.events import Edges, TilingEvent
from exactpt.tiling.tiling import Tiling

_Names: TypeAlias = tuple[tuple[str, str], ...]
_Ends: TypeAlias = tuple[tuple[Vertex, Vertex], ...]


@final
@mypyc_attr(acyclic=True)
class RunEvent:
    """A change of the tiling, or a contact.

    Attributes:
        time: the exact time.
        kind: "corner", "reflex", "hull", "diagonal", "x-order", "motion", "fan" or "contact".
        removed, added: edges of the tiling, as pairs of names "body:vertex"; edges of the fan
            triangulation, if the kind is "fan".
    """

    __slots__ = ("_added", "_kind", "_removed", "_time")
    __match_args__: ClassVar = ("time", "kind", "removed", "added")

    def __init__(
        self,
        time: AlgebraicNumber | Moment,
        kind: str,
        removed: _Names | _Ends = (),
        added: _Names | _Ends = (),
    ) -> None:
        self._time: AlgebraicNumber | Moment = time
        self._kind: str = kind
        self._removed: _Names | _Ends = removed
        self._added: _Names | _Ends = added

    @property
    def time(self) -> AlgebraicNumber:
        """The exact time, computed on first access."""
        if isinstance(self._time, Moment):
            self._time = self._time.number
        return self._time

    @property
    def kind(self) -> str:
        """The kind of the event."""
        return self._kind

    @property
    def removed(self) -> tuple[tuple[str, str], ...]:
        """The edges of the tiling that have been removed."""
        self._removed = names = _named(self._removed)
        return names

    @property
    def added(self) -> tuple[tuple[str, str], ...]:
        """The edges of the tiling that have been added."""
        self._added = names = _named(self._added)
        return names

    def to_json(self) -> dict[str, object]:
        """Return the event as a JSON object, a line of ``simulate --events`` (docs/format.md)."""
        return {
            "time": self.time.to_json(),
            "kind": self.kind,
            "removed": [list(edge) for edge in self.removed],
            "added": [list(edge) for edge in self.added],
        }

    def __repr__(self) -> str:
        edges = f"removed={self.removed!r}, added={self.added!r}"
        if len(edges) > 90:
            edges = f"{counted(len(self.removed), 'edge')} removed, {len(self.added)} added"
        return f"RunEvent(time={cut(repr(self.time), 80)}, kind={self.kind!r}, {edges})"

    def __reduce__(self) -> tuple[object, ...]:
        return RunEvent, (self.time, self.kind, self.removed, self.added)


def events_of(tiling: Tiling, events: Sequence[TilingEvent]) -> list[RunEvent]:
    """Return the public events of a tiling that have just happened.

    Nothing of an event is computed until it is read, neither its time nor the names of its
    vertices. It keeps the vertices that have their ids now: ids are used again.
    """
    moment, every = tiling.certifier.moment, tiling.vertices.all
    return [
        RunEvent(moment(e.time), e.kind, _vertices(every, e.removed), _vertices(every, e.added))
        for e in events
    ]


def _vertices(every: VertexList, edges: Edges) -> _Ends:
    return tuple([(every[u], every[v]) for u, v in edges])


def _named(edges: _Names | _Ends) -> _Names:
    """Return edges as pairs of names, which they may be already."""
    if not edges or isinstance(edges[0][0], str):
        return cast("_Names", edges)
    return tuple([(u.name, v.name) for u, v in edges])
