"""Answers of the package beside the plain values of `exactpt.testing.reference`."""

from __future__ import annotations

from typing import NamedTuple

from exactpt.pair.contact import Contact
from exactpt.pair.distance import Distance
from exactpt.pair.features import Feature
from exactpt.pair.incidences import ContactPoint
from exactpt.search.clearance import CloseInterval
from exactpt.search.intervals import ContactInterval
from exactpt.search.within import Approach
from exactpt.testing.reference import FirstContact, NamedIncidence, Nearest, Place

__all__ = ["Disagreement", "disagreement", "plain", "plain_contact"]


class Disagreement(NamedTuple):
    """An answer that is not the one by definition.

    Attributes:
        what: "missed" or "found" if one of the two is None; "repeated" if a contact has an
            incidence twice; else the attribute that differs, of first contacts "time", "kind",
            "incidences" or "initial_pairs"; "value" of other answers.
        expected: the value by definition.
        found: the answer as a plain value.
    """

    what: str
    expected: object
    found: object

    def __str__(self) -> str:
        return f"{self.what}: {self.found}, by definition {self.expected}"


def disagreement(expected: object, answer: object) -> Disagreement | None:
    """Return how an answer differs from the value by definition; None if they agree.

    >>> from exactpt import Body, Scene, Translation, first_contact
    >>> from exactpt.testing import reference
    >>> ball = Body("ball", [(0, 0)], Translation([0, 2]))
    >>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    >>> disagreement(reference.first_contact(scene), first_contact(scene)) is None
    True
    >>> disagreement(None, first_contact(scene)).what
    'found'

    Args:
        expected: what a function of `exactpt.testing.reference` has returned.
        answer: the answer of the package, of any type that `plain` knows.
    """
    found = plain(answer)
    if isinstance(answer, Contact) and _has_repetitions(answer):
        return Disagreement("repeated", expected, answer.pairs)
    if expected == found:
        return None
    if expected is None or found is None:
        what = "found" if expected is None else "missed"
    elif isinstance(expected, FirstContact) and isinstance(found, FirstContact):
        what = next(
            name for name in FirstContact._fields if getattr(expected, name) != getattr(found, name)
        )
    else:
        what = "value"
    return Disagreement(what, expected, found)


def plain(answer: object) -> object:
    """Return an answer of the package as the plain value that the definition has.

    >>> from exactpt import Body, Scene, distance
    >>> plain(distance(Scene([Body("a", [(0, 0)]), Body("b", [(3, 4)])]), "a", "b", at=0))
    Nearest(core_squared=Fraction(25, 1), features=frozenset({(Place(vertex=0, edge=None), \
Place(vertex=0, edge=None))}))

    Args:
        answer: a `Contact`, a `Distance`, an `Approach`, a list of intervals; anything else, such
            as None or a time, is a plain value already.
    """
    match answer:
        case Contact():
            return plain_contact(answer)
        case Distance():
            pairs = frozenset((_place(a), _place(b)) for a, b in answer.features)
            return Nearest(answer.core_squared, pairs)
        case Approach():
            return answer.time, set(map(frozenset, answer.pairs))
        case list() | tuple() if answer and all(map(_is_interval, answer)):
            return [(interval.start, interval.end) for interval in answer]
        case ():
            return []
    return answer


def plain_contact(contact: Contact | None) -> FirstContact | None:
    """Return a first contact without its points and normals; None for none.

    >>> from exactpt import Body, Scene, first_contact
    >>> scene = Scene([Body("a", [(0, 0), (4, 0)]), Body("b", [(0, 0), (1, 0)])])
    >>> sorted(plain_contact(first_contact(scene)).initial_pairs)
    [('a', 'b')]

    Args:
        contact: the contact, of any search.
    """
    if contact is None:
        return None
    incidences = frozenset(map(_incidence, contact.pairs))
    initial_pairs = frozenset(contact.initial_pairs)
    return FirstContact(contact.time, contact.kind, incidences, initial_pairs)


def _has_repetitions(contact: Contact) -> bool:
    incidences = list(map(_incidence, contact.pairs))
    pairs = contact.initial_pairs
    return len(incidences) > len(set(incidences)) or len(pairs) > len(set(pairs))


def _is_interval(answer: object) -> bool:
    return isinstance(answer, ContactInterval | CloseInterval)


def _incidence(point: ContactPoint) -> NamedIncidence:
    return NamedIncidence(point.body, point.vertex, point.other, point.edge, point.other_vertex)


def _place(feature: Feature) -> Place:
    return Place(feature.vertex, feature.edge)
