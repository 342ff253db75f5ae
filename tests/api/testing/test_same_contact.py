"""assert_same_contact: missed, invented, early, late, or the wrong witness, in one line."""

import re
from fractions import Fraction

import pytest

from exactpt import Body, Scene, Translation, first_contact
from exactpt.errors import InputError
from exactpt.testing import assert_same_contact

BOX = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1]))
WALL = Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])
HIT = Scene([BOX, WALL], (0, 10))
MISS = Scene([BOX, WALL], (0, 1))
ROOT = Scene([Body("p", [(0, 0)], Translation([0, 0, 1])), Body("s", [(2, -1), (2, 1)])], (0, 2))
TRUTH = "the truth is a contact at t = 2 (vertex-edge): vertex 1 of box and edge 3 of wall, "


@pytest.mark.parametrize("answer", [2, 2.0, Fraction(2), "2", 2 + 1e-10])
def test_what_is_right_passes(answer):
    assert_same_contact(HIT, answer)


def test_contacts_pass_and_their_json():
    contact = first_contact(HIT)

    assert_same_contact(HIT, contact)
    assert_same_contact(HIT, contact.to_json())
    assert_same_contact(HIT, contact.time)
    assert_same_contact(ROOT, first_contact(ROOT).time)
    assert_same_contact(MISS, None)


@pytest.mark.parametrize(
    "scene, answer, says",
    [
        (HIT, None, f"missed: the answer is no contact; {TRUTH}"),
        (MISS, 0.5, "invented: the answer is a contact at t = 0.5; the truth is no contact"),
        (HIT, 1.5, f"early: the answer is a contact at t = 1.5; {TRUTH}"),
        (HIT, 2.5, f"late: the answer is a contact at t = 2.5; {TRUTH}"),
        (ROOT, 1.5, "t = 1.4142135623730951, a root of [-2, 0, 1] (vertex-edge): vertex 0 of p"),
    ],
)
def test_what_is_wrong_is_one_line(scene, answer, says):
    with pytest.raises(AssertionError, match=re.escape(says)) as raised:
        assert_same_contact(scene, answer)

    assert "\n" not in str(raised.value)


def test_a_wrong_witness():
    wrong = {
        "time": 2,
        "pairs": [{"a": {"body": "box", "vertex": 0}, "b": {"body": "wall", "edge": 3}}],
    }

    with pytest.raises(AssertionError, match="wrong witness: vertex 0 of box and edge 3 of wall"):
        assert_same_contact(HIT, wrong)


@pytest.mark.parametrize("answer", [float("nan"), "soon", {"time": []}, {"time": 2, "pairs": 3}])
def test_what_is_no_answer_is_refused(answer):
    with pytest.raises(InputError, match="not "):
        assert_same_contact(HIT, answer)
