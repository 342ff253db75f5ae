"""What is no scene, or no name of a body, where a question about a scene is asked."""

import pytest

import exactpt
from exactpt.errors import InputError

ASK = {
    "first_contact": exactpt.first_contact,
    "first_contact_enclosed": exactpt.first_contact_enclosed,
    "first_within": lambda scene: exactpt.first_within(scene, distance=1, norm="x"),
    "first_within of two": lambda scene: exactpt.first_within(scene, "a", "b", 1, norm="x"),
    "clearance": lambda scene: exactpt.clearance(scene, "a", "b"),
    "distance": lambda scene: exactpt.distance(scene, "a", "b", 0),
    "contact_intervals": lambda scene: exactpt.contact_intervals(scene, "a", "b"),
    "contacts": exactpt.contacts,
    "prove": exactpt.prove,
    "Simulation": exactpt.Simulation,
}


@pytest.mark.parametrize("ask", ASK.values(), ids=ASK)
@pytest.mark.parametrize("value", [None, "scene.json", [exactpt.Body("a", [(0, 0)])]])
def test_what_is_no_scene_is_refused(ask, value):
    with pytest.raises(InputError, match=r"^not a scene: "):
        ask(value)


@pytest.mark.parametrize("count", [0, 1, 2])
@pytest.mark.parametrize("one", [1, "a"])
def test_one_argument_is_neither_two_names_nor_a_distance(count, one):
    bodies = [exactpt.Body(name, [(i, 0)]) for i, name in enumerate("ab"[:count])]
    scene = exactpt.Scene(bodies, (0, 1))

    with pytest.raises(InputError, match="two names of bodies are given, or none for all bodies"):
        exactpt.first_within(scene, one)
