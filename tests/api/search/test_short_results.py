"""Results fit a terminal, and a scene is a collection of its bodies."""

import pickle
from fractions import Fraction
from itertools import pairwise

import pytest

from exactpt import (
    Body,
    InputError,
    Pieces,
    Rigid,
    Scene,
    Simulation,
    Translation,
    clearance,
    contact_intervals,
    distance,
    first_contact,
)
from exactpt.testing.scenes import generate

NAME = "a name that is much longer than anybody would like to read in a terminal " * 3
BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]


def scene(name="b"):
    mover = Body("a", BOX, Translation([0, 1], [0, 0, "1/9"]))
    turning = Body(name, [(3, 0), (4, 0), (4, 1), (3, 3)], Rigid([0, "1/2"], pivot=(3, 2)))
    return Scene([mover, turning], (0, 5))


@pytest.mark.parametrize("name", ["b", NAME])
def test_repr_of_results_has_at_most_200_characters(name):
    both = scene(name)
    gap = clearance(both, "a", name)
    contact = first_contact(both)
    results = [contact, gap, gap.minimum, distance(both, "a", name, at=0), *gap.pieces]
    results += [*contact.pairs[:0], *Simulation(both).run()]
    if name == "b":
        results += [*contact_intervals(both, "a", name), *contact.pairs]

    assert len(results) > 10
    for result in results:
        assert len(repr(result)) <= 200, repr(result)


def test_bug_repr_of_a_contact_ended_within_a_long_polynomial():
    ball = Body("ball", BOX, Translation([0], [9, 1, f"-1/{10**60}"]))
    contact = first_contact(Scene([ball, Body("floor", [(-1, 0), (2, 0)])], (0, 10**70)))
    assert "... (root of a polynomial of degree 2), vertex-" in repr(contact)
    late = Body("late", [(-1, 0)], Translation([0, f"1/{10**60 + 7}"]))
    contact = first_contact(Scene([late, Body("wall", [(0, -1), (0, 1)])], (0, 10**99)))
    assert repr(contact).startswith("<Contact at t = 1000000000000000000")
    late = Body("late", [(-1, 0)], Translation([0, f"{10**50 + 7}/{10**50 + 9}"]))
    contact = first_contact(Scene([late, Body("wall", [(0, -1), (0, 1)])], (0, 9)))
    assert repr(contact).startswith("<Contact at t = 1.0..., vertex-edge")


def test_repr_of_events_of_a_crowd_has_at_most_200_characters():
    for event in Simulation(generate("mixed_shapes", 3)).run():
        assert len(repr(event)) <= 200


def test_bodies_of_a_contact_of_each_kind():
    both = scene()
    assert first_contact(both).bodies == ("a", "b")
    nested = Scene([Body("in", [(1, 1)]), Body("out", [(0, 0), (9, 0), (0, 9)])])
    initial = first_contact(nested)
    assert (initial.pairs, initial.bodies) == ((), ("in", "out"))
    assert pickle.loads(pickle.dumps(initial)) == initial


def test_distances_are_ordered_exactly():
    bodies = [Body("o", [(0, 0)]), Body("p", [(3, 4)]), Body("q", [(5, 0)], radius=1)]
    bodies += [
        Body("r", [(6, 0)], radius="1/2"),
        Body("s", [(1, 1)], radius=3),
        Body("t", [(1, 2)]),
    ]
    far = Scene(bodies)
    names = ["s", "t", "q", "p", "r"]  # 0, root 5, 4, 5, 11/2

    found = [distance(far, "o", name, at=0) for name in names]

    assert sorted([found[k] for k in (3, 0, 4, 2, 1)]) == found
    for x, y in pairwise(found):
        assert x < y
        assert x <= y
        assert y > x
        assert y >= x
        assert not y < x
        assert not y <= x
    assert min(found) is found[0]


def test_distances_of_bodies_with_radii_are_ordered_by_their_roots():
    """Roots of sums: sqrt(2) - 1/7 and sqrt(3) - r for r near sqrt(3) - sqrt(2) + 1/7."""
    near = Fraction(3**0.5) - Fraction(2**0.5) + Fraction(1, 7)
    for r in (near - Fraction(1, 10**12), near + Fraction(1, 10**12)):
        bodies = [Body("o", [(0, 0)]), Body("p", [(1, 1)], radius="1/7")]
        q = Body("q", [(1, 0), (3, 2)], radius=r)  # its core's distance is 1
        two = Scene([*bodies, q])
        one, other = distance(two, "o", "p", at=0), distance(two, "o", "q", at=0)
        assert (one < other) == (1 - float(r) > 2**0.5 - 1 / 7)


def test_scene_is_a_collection_of_bodies():
    both = scene()

    assert [body.name for body in both] == ["a", "b"]
    assert both["b"] is both.bodies[1]
    assert len(both) == 2
    assert "a" in both
    assert "c" not in both
    assert Scene([])
    with pytest.raises(KeyError, match="there is no body 'c'"):
        both["c"]


def test_pieces_have_their_argument():
    given = [(Fraction(1), Translation([0, 1])), (None, Translation([1]))]

    assert list(Pieces(given).pieces) == given


def test_jump_has_decimals_its_size_and_what_to_do():
    jumping = Pieces([("1/3", Translation([0, 1])), (None, Translation([5], [4]))])

    with pytest.raises(InputError) as error:
        Body("a", BOX, jumping)
    assert "from (0.333333333, 0) to (5, 4), by 6.15" in str(error.value)
    assert "exactpt.in_local_time" in str(error.value)
    run = Simulation(scene())
    with pytest.raises(InputError, match=r"by 7; exactpt\.onward continues"):
        run.set_motion("a", Translation([7]))
