"""Pairs of bodies that the filters leave open, decided exactly one by one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

from exactpt.arrays.answers import record
from exactpt.arrays.contacts import Contacts
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.outline import straight_pieces
from exactpt.motion.track import Incidence, renumbered
from exactpt.pair.features import FeaturePair
from exactpt.pair.pieces_of_two import segments_of
from exactpt.pair.start import initial_touches
from exactpt.pair.straight import Candidate, LinearContact, earliest, first_incidence, span_of
from exactpt.search.first import pair_search

MOST: Final = 64
"""Maximum number of candidates that are decided here; with more, the search is faster."""


def decide(contacts: Contacts, k: int, candidates: Sequence[Candidate], *, unclear: bool) -> None:
    """Record the first contact of pair k.

    Args:
        contacts: where the results are written.
        k: the number of the pair.
        candidates: its possible first incidences, in the order of time.
        unclear: whether the bodies may touch at the start.
    """
    if len(candidates) > MOST:
        search(contacts, k)
        return
    scene = contacts.scene(k)
    if unclear:
        touches, initial_pairs = initial_touches(scene, [(0, 1)])
        if initial_pairs:
            record(contacts, k, AlgebraicNumber(scene.exact_start), touches, initial=True)
            return
    a, b = scene.bodies
    squared = (a.exact_radius + b.exact_radius) ** 2
    p = None if squared else straight_pieces(a)
    q = p and straight_pieces(b)
    if p and q:
        span = span_of(scene.exact_start, scene.exact_end)
        found = first_incidence(p[0][0], q[0][0], span, candidates)
    else:
        found = _first_at_distance((a, b), scene.exact_start, scene.exact_end, candidates, squared)
    touches = [] if found is None else sorted(renumbered(found.touches, 0, 1))
    record(contacts, k, None if found is None else found.number, touches, initial=False)


def search(contacts: Contacts, k: int) -> None:
    """Record the first contact of pair k, as a search for it by itself finds it."""
    scene = contacts.scene(k)
    contact = pair_search(scene).run_to_contact()
    if contact is None:
        record(contacts, k, None, [], initial=False)
        return
    numbers = {body.name: i for i, body in enumerate(scene.bodies)}
    initial = contact.kind == "initial"
    record(contacts, k, contact.exact_time, contact.exact_incidences(numbers), initial=initial)


def _first_at_distance(
    bodies: tuple[Body, Body],
    start: QQ,
    end: QQ,
    candidates: Iterable[Candidate],
    squared: QQ,
) -> LinearContact | None:
    """Return the first time in (start, end] at which candidates are at a distance, exactly.

    Args:
        bodies: two bodies, farther apart than the distance at the start.
        start: the start; from there on each body is in one piece of its motion.
        end: the end.
        candidates: in the order of their earliest times. Of vertices and edges alone, if the
            distance is 0.
        squared: the square of the distance.
    """
    pieces = [body.exact_piece_after(start) for body in bodies]
    begin = AlgebraicNumber(start)

    def first(touch: Incidence, until: QQ) -> tuple[AlgebraicNumber, Incidence] | None:
        i, vertex, j, edge, other = touch
        ends = (other,) if edge < 0 else segments_of(bodies[j])[edge]
        pair = FeaturePair(touch, pieces[i].track(vertex), tuple(map(pieces[j].track, ends)))
        time = pair.first_time(squared, begin, until)
        return None if time is None else (time, pair.touch_at(time, ends))

    return earliest(candidates, first, end)
