"""New contacts after the start: the search for them, against the definition."""

from fractions import Fraction

import pytest

from exactpt import Body, Pieces, Rigid, Scene, Translation, first_contact
from exactpt.search.first import ContactQuery, search_for
from exactpt.testing import reference
from exactpt.testing.scenes import FAMILIES, generate

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
FLOOR = Body("floor", [(-9, -2), (9, -2), (9, 0), (-9, 0)])


def new_contact_search(scene, *, exact_only=False, between=None):
    query = ContactQuery("auto", "auto", exact_only=exact_only, between=between, after_start=True)
    return search_for(scene, query)


def jumping(height=1):
    """From the floor at t = 0 up, and on it again at t = 2 * height."""
    return Body("ball", SQUARE, Translation([0], [0, 2 * height, -1]))


@pytest.mark.parametrize("exact_only", [False, True])
def test_bodies_that_part_and_touch_again_have_a_new_contact(exact_only):
    contact = new_contact_search(
        Scene([FLOOR, jumping()], (0, 9)), exact_only=exact_only
    ).run_to_contact()

    assert contact.time == 2
    assert contact.kind == "vertex-edge"


def test_bodies_that_touch_and_begin_to_overlap_have_one_at_the_start():
    down = Body("ball", SQUARE, Translation([0], [0, -1]))

    contact = new_contact_search(Scene([FLOOR, down], (0, 9))).run_to_contact()

    assert (contact.time, contact.kind) == (0, "initial")
    assert contact.initial_pairs == (("floor", "ball"),)


@pytest.mark.parametrize(
    "height, first", [(1, {"ball"}), (2, {"other"}), ("3/2", {"ball", "other"})]
)
def test_earliest_of_a_renewed_contact_and_of_another_one_is_found(height, first):
    """The ball is back at t = 2 height; another one, 3 above the floor, comes down at t = 3."""
    other = Body("other", [(x + 5, y + 3) for x, y in SQUARE], Translation([0], [0, -1]))
    scene = Scene([FLOOR, jumping(Fraction(height)), other], (0, 9))

    contact = new_contact_search(scene).run_to_contact()

    assert contact.time == min(2 * Fraction(height), 3)
    assert {pair.body for pair in contact.pairs} | {pair.other for pair in contact.pairs} == {
        "floor",
        *first,
    }


def test_bodies_that_stay_in_touch_have_none():
    ride = Translation([0, 1])
    bodies = [FLOOR.with_motion(ride), Body("rider", SQUARE, ride)]

    search = new_contact_search(Scene(bodies, (0, 9)))

    assert search.run_to_contact() is None
    assert search.contact_free_until() is None
    assert search.name is None
    assert search.stats["bodies"] == 2


def test_named_pairs_alone_count():
    scene = Scene([FLOOR, jumping(), Body("post", [(0, 9), (1, 9)])], (0, 9))

    assert new_contact_search(scene, between=[("ball", "post")]).run_to_contact() is None


def test_body_that_turns_away_and_comes_back_has_a_new_contact():
    """A flap on the floor turns up by pieces, and down again: flat at t = 0 and t = 2."""
    up, down = Rigid([0, 1], pivot=(0, 0)), Rigid([2, -1], pivot=(0, 0))
    flap = Body("flap", [(0, 0), (3, 0), (3, 1)], Pieces([(1, up), (None, down)]))
    scene = Scene([FLOOR, flap], (0, 3))

    contact = new_contact_search(scene).run_to_contact()

    assert contact.time == 2
    assert defined_by(contact) == reference.first_new_contact(scene)


def defined_by(contact):
    """The time of a contact and the names of the bodies, in the form of the definition."""
    if contact is None:
        return None
    names = {frozenset((pair.body, pair.other)) for pair in contact.pairs}
    return contact.time, names or {frozenset(pair) for pair in contact.initial_pairs}


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_new_contacts_are_those_of_the_definition(family):
    for seed in range(3):
        scene = generate(family, seed)
        bodies = [body for body in scene.bodies if body.size <= 6][:3]
        few = Scene(bodies, (scene.start, scene.end))
        expected = reference.first_new_contact(few)
        for exact_only in (False, True):
            contact = new_contact_search(few, exact_only=exact_only).run_to_contact()
            assert defined_by(contact) == expected
            assert contact == first_contact(few, after_start=True)
