"""Events as users see them."""

from __future__ import annotations

from typing import ClassVar, final

from mypy_extensions import mypyc_attr

from exactpt.certificates.moment import Moment
from exactpt.kernel.algebraic import AlgebraicNumber

__all__ = ["Event"]


@final
@mypyc_attr(acyclic=True)
class Event:
    """A change of the tiling, or a contact.

    Attributes:
        time: the exact time.
        kind: "corner", "reflex", "hull", "diagonal", "x-order", "motion" or "contact".
        removed, added: edges of the tiling, as pairs of names "body:vertex".
    """

    __slots__ = ("_added", "_kind", "_removed", "_time")
    __match_args__: ClassVar = ("time", "kind", "removed", "added")

    def __init__(
        self,
        time: AlgebraicNumber | Moment,
        kind: str,
        removed: tuple[tuple[str, str], ...] = (),
        added: tuple[tuple[str, str], ...] = (),
    ) -> None:
        self._time: AlgebraicNumber | Moment = time
        self._kind = kind
        self._removed = removed
        self._added = added

    @property
    def time(self) -> AlgebraicNumber:
        """The exact time, computed when it is first asked for."""
        if isinstance(self._time, Moment):
            self._time = self._time.number
        return self._time

    @property
    def kind(self) -> str:
        """What has happened."""
        return self._kind

    @property
    def removed(self) -> tuple[tuple[str, str], ...]:
        """The edges of the tiling that have been removed."""
        return self._removed

    @property
    def added(self) -> tuple[tuple[str, str], ...]:
        """The edges of the tiling that have been added."""
        return self._added

    def to_json(self) -> dict[str, object]:
        """The event as a JSON object, see docs/format.md (a line of ``simulate --events``)."""
        return {
            "time": self.time.to_json(),
            "kind": self.kind,
            "removed": [list(edge) for edge in self.removed],
            "added": [list(edge) for edge in self.added],
        }

    def __repr__(self) -> str:
        return (
            f"Event(time={self.time!r}, kind={self.kind!r}, "
            f"removed={self.removed!r}, added={self.added!r})"
        )

    def __reduce__(self) -> tuple[object, ...]:
        return Event, (self.time, self.kind, self.removed, self.added)
