"""First contacts of many pairs, as arrays."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.doubles import Flags, Floats
from exactpt.kernel.numbers import shorten
from exactpt.search.first import pair_search

if TYPE_CHECKING:
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene

KINDS: Final = ("none", "initial", "self", "vertex-edge", "vertex-vertex")
"""The kinds of contacts, as in `Contact.kind`; "none" where there is none."""

Numbers: TypeAlias = NDArray[np.int32]
Errors: TypeAlias = Literal["raise", "mask"]
"""What refused geometry of one pair does: raise an error, or leave that pair without an answer."""


def masks(errors: Errors) -> bool:
    """Return whether refused pairs are masked, or else an error is raised.

    Raises:
        InputError: if ``errors`` is neither "raise" nor "mask".
    """
    if errors not in {"raise", "mask"}:
        raise InputError(f'errors: "raise" or "mask" is needed, not {shorten(errors)}')
    return errors == "mask"


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
        exact: whether exact arithmetic has decided the result; else a filter in doubles has,
            whose bounds are proved.
        refused: with ``errors="mask"``, true for a pair whose geometry is refused, without a
            result: `low` and `high` are NaN, and `found` is false (see `reasons`).
    """

    __slots__ = (
        "_reasons", "_scene", "body", "edge", "exact", "found", "high", "kind", "low",
        "other_vertex", "refused", "vertex",
    )  # fmt: skip

    def __init__(self, count: int, scene: Callable[[int], Scene]) -> None:
        self._scene = scene
        self._reasons: dict[int, str] = {}
        self.low: Floats = np.full(count, np.inf)
        self.high: Floats = np.full(count, np.inf)
        self.kind: NDArray[np.int8] = np.zeros(count, dtype=np.int8)
        self.body: NDArray[np.int8] = np.full(count, -1, dtype=np.int8)
        self.vertex: Numbers = np.full(count, -1, dtype=np.int32)
        self.edge: Numbers = np.full(count, -1, dtype=np.int32)
        self.other_vertex: Numbers = np.full(count, -1, dtype=np.int32)
        self.exact: Flags = np.zeros(count, dtype=np.bool_)
        self.found: Flags = np.zeros(count, dtype=np.bool_)
        self.refused: Flags = np.zeros(count, dtype=np.bool_)

    def __len__(self) -> int:
        return len(self.low)

    @property
    def exact_share(self) -> float:
        """The fraction of pairs that exact arithmetic has decided, from 0 to 1."""
        return float(self.exact.mean()) if len(self) else 0.0

    def contact(self, i: int) -> Contact | None:
        """Return the exact contact of a pair, equal to `exactpt.first_contact`, or None.

        Raises:
            IndexError: if the pair does not exist.
            InputError: if the pair is refused.
        """
        k = range(len(self))[operator.index(i)]
        if self.refused[k]:
            raise InputError(self._reasons[k])
        return pair_search(self.scene(k)).run_to_contact() if self.found[k] else None

    def refuse(self, i: int, reason: str) -> None:
        """Mark a pair without a result as refused, for a reason of one line."""
        self.refused[i] = True
        self.low[i] = self.high[i] = np.nan
        self._reasons[i] = reason

    def reasons(self) -> list[tuple[int, str]]:
        """Return the number of each refused pair in order, with the reason in one line."""
        return sorted(self._reasons.items())

    def scene(self, i: int) -> Scene:
        """Return the scene of the two bodies of a pair.

        Raises:
            IndexError: if the pair does not exist.
        """
        return self._scene(range(len(self))[operator.index(i)])

    def __repr__(self) -> str:
        return (
            f"<Contacts: {int(self.found.sum())} of {counted(len(self), 'pair')} touch, "
            f"{int(self.exact.sum())} decided exactly>"
        )
