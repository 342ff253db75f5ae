"""Answers of the package beside plain values: each way to differ is told."""

import pytest

from exactpt import (
    AlgebraicNumber,
    Body,
    Contact,
    InputError,
    Scene,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_within,
)
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement, plain

BALL = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
WALL = Body("wall", [(9, -5), (9, 5)])
SCENE = Scene([BALL, WALL], time=(0, 10))


@pytest.fixture
def expected():
    return reference.first_contact(SCENE)


def test_answers_that_are_right_agree(expected):
    """The vertex (1, 0) is at x = 9 at t = 4, and (0, 1) leaves x = 9 at t = 9/2."""
    assert disagreement(expected, first_contact(SCENE)) is None
    assert expected.time == 4
    found = [(AlgebraicNumber(4), AlgebraicNumber("9/2"))]
    assert disagreement(found, contact_intervals(SCENE, "ball", "wall")) is None
    assert disagreement(found, contacts(SCENE)) is None
    assert disagreement(found, clearance(SCENE, "ball", "wall").below(0)) is None
    assert disagreement([], clearance(SCENE.until(1), "ball", "wall").below(0)) is None
    there = distance(SCENE, "ball", "wall", at=1)
    assert disagreement(reference.nearest(BALL, WALL, 1), there) is None
    near = first_within(SCENE, distance=2)
    assert disagreement((AlgebraicNumber(3), {frozenset({"ball", "wall"})}), near) is None
    assert disagreement(None, first_contact(SCENE.until(1))) is None


def changed(contact, **changes):
    names = ("time", "kind", "pairs", "initial_pairs")
    return Contact(**{name: getattr(contact, name) for name in names} | changes)


@pytest.mark.parametrize(
    "what, changes",
    [
        ("time", {"time": AlgebraicNumber(5)}),
        ("kind", {"kind": "self"}),
        ("incidences", {"pairs": ()}),
        ("initial_pairs", {"initial_pairs": (("ball", "wall"),)}),
    ],
)
def test_what_differs_of_a_contact_is_told(expected, what, changes):
    found = disagreement(expected, changed(first_contact(SCENE), **changes))

    assert found.what == what
    assert str(found).startswith(f"{what}: ")


def test_a_contact_that_is_missed_found_or_repeated_is_told(expected):
    contact = first_contact(SCENE)

    assert disagreement(expected, None).what == "missed"
    assert disagreement(None, contact).what == "found"
    twice = changed(contact, pairs=contact.pairs * 2)
    assert disagreement(expected, twice).what == "repeated"


def test_other_answers_have_a_wrong_value():
    right = reference.contact_intervals(BALL, WALL, SCENE.time)

    assert disagreement(right, []).what == "value"
    assert disagreement(reference.nearest(BALL, WALL, 2), distance(SCENE, "ball", "wall", 1))
    assert plain(right) is right


def test_a_pair_of_unknown_bodies_is_refused():
    with pytest.raises(InputError, match="'nobody'"):
        reference.first_contact(SCENE, between=[("ball", "nobody")])
    with pytest.raises(InputError, match="'nobody'"):
        reference.first_new_contact(SCENE, between=[("ball", "nobody")])


def test_a_contact_between_named_bodies_only():
    """The post at x = 5 is passed at t = 2, and does not count."""
    scene = Scene([BALL, WALL, Body("post", [(5, 0)])], time=(0, 10))

    assert reference.first_contact(scene).time == 2
    assert reference.first_contact(scene, between=[("wall", "ball")]) == reference.first_contact(
        SCENE
    )
