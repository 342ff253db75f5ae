"""How the chains of a structure are kept: walked along, or searched."""

from __future__ import annotations

from typing import Final, Literal, TypeAlias, final

__all__ = ["PATIENCE", "ChainKind", "Chains"]

ChainKind: TypeAlias = Literal["auto", "linked", "searchable"]

PATIENCE: Final = 8
"""Steps along chains for each event, and each point, before chains are made searchable."""


@final
class Chains:
    """How chains are kept.

    Args and attributes:
        kind: "linked" walks along chains, "searchable" searches them in O(log n); "auto"
            walks until the steps of all walks exceed what is allowed, `PATIENCE` an event.
        allowed: how many steps are allowed so far.
    """

    __slots__ = ("allowed", "kind")

    def __init__(self, kind: ChainKind, allowed: int) -> None:
        self.kind: ChainKind = kind
        self.allowed: int = allowed

    def are_long(self, steps: int) -> bool:
        """After one more event: whether so many steps are too many; then search from now on."""
        self.allowed += PATIENCE
        if steps > self.allowed:
            self.kind = "searchable"
        return self.kind == "searchable"
