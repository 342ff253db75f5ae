"""Events as users see them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from exactpt.collision.contact import time_to_json
from exactpt.kernel.algebraic import AlgebraicNumber

__all__ = ["Event"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Event:
    """A change of the tiling, or a contact.

    Attributes:
        time: the exact time.
        kind: "corner", "reflex", "hull", "diagonal", "x-order", "motion" or "contact".
        removed, added: edges of the tiling, as pairs of names "body:vertex".
    """

    time: AlgebraicNumber
    kind: str
    removed: tuple[tuple[str, str], ...] = ()
    added: tuple[tuple[str, str], ...] = ()

    def to_json(self) -> dict[str, object]:
        """The event as a JSON object, see docs/format.md (a line of ``simulate --events``)."""
        return {
            "time": time_to_json(self.time),
            "kind": self.kind,
            "removed": [list(edge) for edge in self.removed],
            "added": [list(edge) for edge in self.added],
        }
