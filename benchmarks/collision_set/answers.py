"""The exact answers to passages: found by arrays, their times as roots of integer polynomials."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ldexp

import numpy as np

from benchmarks.collision_set.passages import Passage, polynomial
from exactpt.arrays.contacts import KINDS, Contacts
from exactpt.arrays.queries import point_segment_contacts
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, rational
from exactpt.testing.truth import Truth, first_pair, root_between


def answers(passages: Sequence[Passage]) -> Iterator[Truth]:
    """The first contact of each point, body "a", with its segment, "b", for t in [0, 1]."""
    rows = np.array([coordinates(p) for p in passages]).reshape(-1, 2, 3, 2)
    places, velocities = rows[:, 0], rows[:, 1]
    found = point_segment_contacts(
        *(places[:, k] for k in range(3)), velocities=[velocities[:, k] for k in range(3)]
    )
    for k, passage in enumerate(passages):
        yield _answer(found, k, passage) if found.found[k] else Truth(None)


def coordinates(p: Passage) -> list[float]:
    """Positions at time 0, then velocities: twelve doubles, none of which is rounded."""
    places = [c for corner in p.start for c in corner]
    ends = [c for corner in p.end for c in corner]
    speeds = [last - first for first, last in zip(places, ends, strict=True)]
    return [ldexp(c, -p.bits) for c in places + speeds]


def _answer(found: Contacts, k: int, passage: Passage) -> Truth:
    kind, pair = KINDS[found.kind[k]], first_pair(found, k)
    edge, end = int(found.edge[k]), int(found.other_vertex[k])
    if kind == "initial":
        return Truth(AlgebraicNumber(0), kind, pair)
    return Truth(_on_edge(found, k, passage) if edge >= 0 else _at_end(passage, end), kind, pair)


def _on_edge(found: Contacts, k: int, passage: Passage) -> AlgebraicNumber:
    """The root of the incidence's polynomial in the enclosure of arrays."""
    low, high = (rational(float(bound[k])) for bound in (found.low, found.high))
    time = root_between(polynomial(passage), low, high)
    if time is None:  # two roots are too near to each other for doubles
        contact = found.contact(k)
        assert contact is not None  # noqa: S101 - it is found
        return contact.time
    return time


def _at_end(passage: Passage, end: int) -> AlgebraicNumber:
    """The time at which the point is at an end of the segment."""
    apart = [
        (first[0][axis] - first[1 + end][axis], last[0][axis] - last[1 + end][axis])
        for axis in (0, 1)
        for first, last in [(passage.start, passage.end)]
    ]
    first, last = next((f, g) for f, g in apart if f != g)
    return AlgebraicNumber(QQ(first, first - last))
