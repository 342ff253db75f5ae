"""First contacts of many pairs, as arrays."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Final, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.ragged import Flags
from exactpt.kernel.doubles import Floats
from exactpt.pairs.features_sweep import PairsSearch

if TYPE_CHECKING:
    from exactpt.pairs.contact import Contact
    from exactpt.scene.scene import Scene

__all__ = ["KINDS", "Contacts"]

KINDS: Final = ("none", "initial", "self", "vertex-edge", "vertex-vertex")
"""The kinds of contacts, as in `Contact.kind`; "none" where there is none."""

Numbers: TypeAlias = NDArray[np.int32]


@final
class Contacts:
    """For each pair its first contact: whether there is one, when, and where.

    Attributes:
        found: whether there is a contact in the closed time span.
        low, high: doubles that enclose the time, low <= time <= high; both infinite without a
            contact.
        kind: the index of the contact's kind in `KINDS`.
        body, vertex: the vertex of the first of the incidences (``Contact.pairs``): 0 or 1 as it
            is of the first or the second body, and its number; -1 without an incidence.
        edge, other_vertex: the edge or the vertex of the other body that it touches; -1 if it
            touches none, or the other kind.
        exact: whether exact arithmetic has decided the answer; else a filter in doubles has,
            whose bounds are proved.
    """

    __slots__ = (
        "_scene", "body", "edge", "exact", "found", "high", "kind", "low", "other_vertex", "vertex",
    )  # fmt: skip

    def __init__(self, count: int, scene: Callable[[int], Scene]) -> None:
        self._scene = scene
        self.low: Floats = np.full(count, np.inf)
        self.high: Floats = np.full(count, np.inf)
        self.kind: NDArray[np.int8] = np.zeros(count, dtype=np.int8)
        self.body: NDArray[np.int8] = np.full(count, -1, dtype=np.int8)
        self.vertex: Numbers = np.full(count, -1, dtype=np.int32)
        self.edge: Numbers = np.full(count, -1, dtype=np.int32)
        self.other_vertex: Numbers = np.full(count, -1, dtype=np.int32)
        self.exact: Flags = np.zeros(count, dtype=np.bool_)
        self.found: Flags = np.zeros(count, dtype=np.bool_)

    def __len__(self) -> int:
        return len(self.low)

    @property
    def exact_share(self) -> float:
        """The share of answers that exact arithmetic has decided, from 0 to 1."""
        return float(self.exact.mean()) if len(self) else 0.0

    def contact(self, i: int) -> Contact | None:
        """The exact contact of a pair: that of `exactpt.first_contact`; None if there is none.

        Raises:
            IndexError: if there is no such pair.
        """
        k = range(len(self))[operator.index(i)]
        return PairsSearch(self.scene(k)).run_to_contact() if self.found[k] else None

    def scene(self, i: int) -> Scene:
        """The scene of the two bodies of a pair.

        Raises:
            IndexError: if there is no such pair.
        """
        return self._scene(range(len(self))[operator.index(i)])

    def __repr__(self) -> str:
        return (
            f"<Contacts: {int(self.found.sum())} of {len(self)} pairs touch, "
            f"{int(self.exact.sum())} decided exactly>"
        )
