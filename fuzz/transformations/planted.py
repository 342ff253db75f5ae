"""A fault for each transformation, made on purpose, which the transformation must show."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any, Final
from unittest.mock import patch

import exactpt
from exactpt import Body, Contact
from fuzz.transformations.run import Fault, check

__all__ = ["PLANTED", "hunt"]

Edges = list[tuple[int, int]]


def _edges(chosen: Callable[[Body, Edges], Edges]) -> AbstractContextManager[object]:
    """Return a context in which bodies have some of their edges only."""
    right: Any = vars(Body)["edges"]
    return patch.object(Body, "edges", property(lambda body: chosen(body, right.__get__(body))))


def _without_the_last(body: Body, edges: Edges) -> Edges:
    return [(i, j) for i, j in edges if i < j]


def _of_first_part(body: Body, edges: Edges) -> Edges:
    return [(i, j) for i, j in edges if any(i in ring for ring in body.parts[0])]


def _short(body: Body, edges: Edges) -> Edges:
    """Leave out an edge if the next one is parallel to it."""
    at = dict(edges)
    place = [tuple(f.coefficients[0] if f.coefficients else 0 for f in v) for v in body.vertices]

    def is_straight(i: int, j: int, k: int) -> bool:
        (ax, ay), (bx, by), (cx, cy) = place[i], place[j], place[k]
        return bool((bx - ax) * (cy - by) == (by - ay) * (cx - bx))

    return [(i, j) for i, j in edges if j not in at or not is_straight(i, j, at[j])]


def _first_overlap() -> AbstractContextManager[object]:
    """Return a context in which a contact reports the first of its overlaps and pairs."""
    right = Contact.__init__

    def wrong(self: Contact, time: Any, kind: Any, pairs: Any, initial_pairs: Any = ()) -> None:
        right(self, time, kind, pairs, initial_pairs[:1])

    return patch.object(Contact, "__init__", wrong)


def _without_the_first_interval() -> AbstractContextManager[object]:
    """Return a context in which the first interval of several is lost."""
    right = exactpt.contact_intervals

    def wrong(*args: Any) -> Any:
        found = right(*args)
        return found[1:] if len(found) > 1 else found

    return patch.object(exactpt, "contact_intervals", wrong)


def _in_one_direction(body: Body, edges: Edges) -> Edges:
    """Leave out edges that go to the left: those of another ring order stay."""
    place = [tuple(f.coefficients[0] if f.coefficients else 0 for f in v) for v in body.vertices]
    return [(i, j) for i, j in edges if place[i][0] <= place[j][0]]


PLANTED: Final[dict[str, Callable[[], AbstractContextManager[object]]]] = {
    "subdivided": lambda: _edges(_short),
    "renumbered": lambda: _edges(_without_the_last),
    "reversed": lambda: _edges(_in_one_direction),
    "permuted": _first_overlap,
    "joined": lambda: _edges(_of_first_part),
    "separated": lambda: _edges(_of_first_part),
    "mirrored": lambda: _edges(_in_one_direction),
    "backwards": _without_the_first_interval,
}
"""By transformation: a function that returns a context in which the fault is made.

Edges before a straight angle are lost; the edge that closes a ring; edges to the left; all overlaps
but the first; edges of all parts but the first; edges to the left again; the first of the intervals
in which two bodies touch.
"""


def hunt(transformation: str, most: int = 200, seed: int = 0) -> Fault | None:
    """Return the first disagreement that a planted fault causes in the first scenes of a run."""
    for number in range(most):
        found = check(number, seed, lambda _, name: name == transformation, PLANTED[transformation])
        for _, _, fault in found:
            if fault is not None:
                return fault
    return None
