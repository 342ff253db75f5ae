"""Pairs of bodies that the filters leave open, decided exactly one by one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Final

from exactpt.arrays.answers import record
from exactpt.arrays.contacts import Contacts
from exactpt.arrays.exact import Incidence, Place, Translating, incidence
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import Touch
from exactpt.pairs.features_sweep import PairsSearch
from exactpt.pairs.start import Edge, incidences

__all__ = ["decide", "search"]

MOST: Final = 64
"""Maximum number of candidates, and of pairs of edges at the start, that are decided here.

With more, the search by boxes is faster."""


def decide(
    contacts: Contacts,
    k: int,
    bodies: tuple[Translating, Translating],
    span: tuple[QQ, QQ],
    candidates: Sequence[tuple[int, int, int]],
    *,
    unclear: bool,
) -> None:
    """Record the first contact of pair k.

    Args:
        contacts: the answers.
        k: the number of the pair.
        bodies: its bodies.
        span: the start and the end.
        candidates: what may meet first: 0 or 1 as the vertex is of the first or the second body,
            its number, and that of the edge of the other.
        unclear: whether the bodies may touch at the start.
    """
    if len(candidates) > MOST or (unclear and len(bodies[0].edges) * len(bodies[1].edges) > MOST):
        search(contacts, k)
        return
    start = AlgebraicNumber(span[0])
    if unclear:
        touches, overlap = _touches_at(bodies, span[0])
        if overlap:
            record(contacts, k, start, touches, initial=True)
            return
    meetings = [_incidence(bodies, c) for c in candidates]
    best: AlgebraicNumber | None = None
    for each in meetings:
        time = each.first_time(start, span[1] if best is None else best._high)
        if time is not None and (best is None or time.compare(best) < 0):
            best = time
    found: set[Touch] = set()
    if best is not None:
        for each, candidate in zip(meetings, candidates, strict=True):
            touch = _touch(bodies, candidate, each.place_at(best))
            if touch is not None:
                found.add(touch)
    record(contacts, k, best, sorted(found), initial=False)


def _touches_at(bodies: tuple[Translating, Translating], t: QQ) -> tuple[list[Touch], bool]:
    """All incidences at a time, and whether the bodies share a point then."""
    p, q = (body.at(t) for body in bodies)
    first, second = (
        [Edge(i, e if a != b else -1, at[a], at[b], (a, b)) for e, (a, b) in enumerate(body.edges)]
        for i, (body, at) in enumerate(zip(bodies, (p, q), strict=True))
    )
    found: set[Touch] = set()
    meet = False
    for e, f in product(first, second):
        if segments_meet(e.a, e.b, f.a, f.b):
            meet = True
            found.update(incidences(e, f))
            found.update(incidences(f, e))
    meet = meet or (bodies[0].has_interior and contains(p, q[0]))
    meet = meet or (bodies[1].has_interior and contains(q, p[0]))
    return sorted(found), meet


def search(contacts: Contacts, k: int) -> None:
    """Record the first contact of pair k, as `PairsSearch` finds it."""
    scene = contacts.scene(k)
    contact = PairsSearch(scene).run_to_contact()
    if contact is None:
        record(contacts, k, None, [], initial=False)
        return
    first = scene.bodies[0].name
    touches = [
        Touch(
            int(p.body != first), p.vertex, int(p.other != first),
            -1 if p.edge is None else p.edge, -1 if p.other_vertex is None else p.other_vertex,
        )
        for p in contact.pairs
    ]  # fmt: skip
    record(contacts, k, contact.time, touches, initial=contact.kind == "initial")


def _incidence(
    bodies: tuple[Translating, Translating], candidate: tuple[int, int, int]
) -> Incidence:
    side, vertex, edge = candidate
    mine, other = bodies[side], bodies[1 - side]
    a, b = other.edges[edge]
    return incidence(mine.path(vertex), other.path(a), other.path(b))


def _touch(
    bodies: tuple[Translating, Translating], candidate: tuple[int, int, int], place: Place | None
) -> Touch | None:
    """The incidence of a vertex that is at this place of an edge; None if it is not on it."""
    side, vertex, edge = candidate
    if place is None:
        return None
    if place == "inside":
        return Touch(side, vertex, 1 - side, edge, -1)
    other = bodies[1 - side].edges[edge][place == "last"]
    mine, theirs = (vertex, other) if side == 0 else (other, vertex)
    return Touch(0, mine, 1, -1, theirs)
