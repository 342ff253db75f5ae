"""The representation of the chains of a structure: linked, or searchable."""

from __future__ import annotations

from typing import Final, Literal, TypeAlias, final

ChainKind: TypeAlias = Literal["auto", "linked", "searchable"]

PATIENCE: Final = 8
"""Number of steps along chains, per event and per point, before chains are made searchable."""


@final
class Chains:
    """The representation of chains.

    Args and attributes:
        kind: "linked" (chains are walked along), "searchable" (chains are searched in
            O(log n)), or "auto": linked until more steps have been made than are allowed,
            `PATIENCE` per event.
        allowed: the number of steps allowed so far.
    """

    __slots__ = ("allowed", "kind")

    def __init__(self, kind: ChainKind, allowed: int) -> None:
        self.kind: ChainKind = kind
        self.allowed: int = allowed

    def are_long(self, steps: int) -> bool:
        """After one more event, whether more steps have been made than are allowed.

        If so, the representation becomes searchable.
        """
        self.allowed += PATIENCE
        if steps > self.allowed:
            self.kind = "searchable"
        return self.kind == "searchable"
