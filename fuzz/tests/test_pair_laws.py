"""Laws about pairs of bodies find wrong answers: one mistake for each, in few cases."""

from dataclasses import replace

import pytest

import exactpt
from exactpt.pair.features import Feature
from exactpt.search.clearance import Clearance, Minimum
from fuzz.laws.runner import cases_of, look

CASES = 60


def never(*_, **__):
    return None


def nothing(*_, **__):
    return []


def without_first_piece(right):
    """The clearance begins with its second piece, if it has one."""

    def wrong(scene, a, b=None):
        gap = right(scene, a, b)
        return replace(gap, pieces=gap.pieces[-1:]) if isinstance(gap, Clearance) else gap

    return wrong


def with_an_edge_for_its_end(right):
    """A piece of two vertices has an edge of which one of them is an end."""

    def wrong(scene, a, b=None):
        gap = right(scene, a, b)
        if not isinstance(gap, Clearance):
            return gap
        edges = scene.body(b).edges
        return replace(gap, pieces=tuple(_of_an_edge(piece, edges) for piece in gap.pieces))

    return wrong


def _of_an_edge(piece, edges):
    if piece.features is None or piece.features[0].vertex is None:
        return piece
    one, two = piece.features
    of_end = [e for e, ends in enumerate(edges) if two.vertex in ends]
    return piece._replace(features=(one, Feature(None, of_end[0]))) if of_end else piece


def with_late_minimum(right):
    def wrong(scene, a, b=None):
        gap = right(scene, a, b)
        late = Minimum(exactpt.AlgebraicNumber(scene.exact_end), gap.minimum.squared)
        object.__setattr__(gap, "minimum", late)
        return gap

    return wrong


def without_last_below(right):
    """Of two intervals in which a body is near, the last one is forgotten."""

    class Forgetful:
        def __init__(self, around):
            self.around = around

        def below(self, distance):
            return self.around.below(distance)[:-1]

        def __getattr__(self, name):
            return getattr(self.around, name)

        def __call__(self, at):
            return self.around(at)

    def wrong(scene, a, b=None):
        found = right(scene, a, b)
        return Forgetful(found) if b is None else found

    return wrong


def with_features_of_one_body(right):
    def wrong(*args, **kwargs):
        there = right(*args, **kwargs)
        return replace(there, features=tuple((a, a) for a, _ in there.features))

    return wrong


def with_flipped_normals(right):
    def wrong(*args, **kwargs):
        contact = right(*args, **kwargs)
        if contact is None:
            return None
        pairs = tuple(
            pair if pair.normal is None else replace(pair, normal=(-pair.normal[0], pair.normal[1]))
            for pair in contact.pairs
        )
        return replace(contact, pairs=pairs)

    return wrong


def never_between(right):
    """Chosen pairs of bodies never meet."""

    def wrong(scene, *args, between=None, **kwargs):
        return right(scene, *args, **kwargs) if between is None else None

    return wrong


def always(value):
    return lambda _: value


@pytest.mark.parametrize(
    ("law", "name", "wrong"),
    [
        ("contacts/reference", "contact_intervals", always(nothing)),
        ("contacts/methods", "contact_intervals", always(nothing)),
        ("contacts/times", "contacts", always(nothing)),
        ("contacts/choices", "first_within", never_between),
        ("first within/reference", "first_within", always(never)),
        ("first within/methods", "clearance", without_first_piece),
        ("distance/reference", "distance", with_features_of_one_body),
        ("distance/below", "clearance", without_first_piece),
        ("distance/clearance", "clearance", without_first_piece),
        ("distance/clearance", "clearance", with_an_edge_for_its_end),
        ("distance/least", "clearance", with_late_minimum),
        ("distance/surroundings", "clearance", without_last_below),
        ("new contact/reference", "first_contact", always(never)),
        ("new contact/methods", "first_contact", never_between),
        ("first contact/points", "first_contact", with_flipped_normals),
    ],
)
def test_law_is_broken_by_a_wrong_answer(law, name, wrong, monkeypatch):
    monkeypatch.setattr(exactpt, name, wrong(getattr(exactpt, name)))

    assert any(look(case).fault for case in cases_of(law, 0, CASES))
