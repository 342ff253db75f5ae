"""Results, written into the arrays of `Contacts`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from exactpt.arrays.contacts import KINDS, Contacts
from exactpt.kernel.doubles import Floats, Indices
from exactpt.motion.track import Incidence

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber


def record_edges(
    contacts: Contacts, pairs: Indices, low: Floats, high: Floats,
    body: Indices | int = 0, vertex: Indices | int = 0, edge: Indices | int = 0,
    other_vertex: Indices | int = -1,
) -> None:  # fmt: skip
    """Record contacts found by a filter: of a vertex with a vertex or the inside of an edge."""
    contacts.found[pairs] = True
    kinds = np.array([KINDS.index("vertex-vertex"), KINDS.index("vertex-edge")])
    contacts.kind[pairs] = kinds[np.asarray(other_vertex < 0).astype(np.int64)]
    contacts.other_vertex[pairs] = other_vertex
    contacts.low[pairs] = low
    contacts.high[pairs] = high
    contacts.body[pairs] = body
    contacts.vertex[pairs] = vertex
    contacts.edge[pairs] = edge


def record_overlaps(contacts: Contacts, pairs: Indices, start: Floats) -> None:
    """Record bodies that overlap at the start, without an incidence."""
    contacts.found[pairs] = True
    contacts.kind[pairs] = KINDS.index("initial")
    contacts.low[pairs] = start
    contacts.high[pairs] = start


def record(
    contacts: Contacts, i: int, time: AlgebraicNumber | None, touches: Sequence[Incidence],
    *, initial: bool,
) -> None:  # fmt: skip
    """Record a pair decided exactly; no contact if the time is None."""
    contacts.exact[i] = True
    if time is None:
        return
    contacts.found[i] = True
    contacts.low[i], contacts.high[i] = time.enclosure()
    if initial:
        kind = "initial"
    elif all(touch.body == touch.other for touch in touches):
        kind = "self"
    elif any(touch.edge >= 0 for touch in touches if touch.body != touch.other):
        kind = "vertex-edge"
    else:
        kind = "vertex-vertex"
    contacts.kind[i] = KINDS.index(kind)
    if touches:
        first = min(touches)
        contacts.body[i], contacts.vertex[i] = first.body, first.vertex
        contacts.edge[i], contacts.other_vertex[i] = first.edge, first.other_vertex
