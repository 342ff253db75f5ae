"""Bodies that are turned first: one scene for all who read a motion."""

import json
from random import Random

import pytest

import exactpt
from exactpt import Body, Pieces, Rigid, Scene, onward
from exactpt.kernel.numbers import QQ
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from fuzz.changes.variants import VARIANTS, difference

QUARTERS = [(1, 0), (0, 1), (-1, 0), (0, -1)]
UNITS = [*QUARTERS, ("3/5", "4/5"), ("-4/5", "3/5"), ("5/13", "-12/13")]


def whole_turn(first, pivot):
    """Four quarter turns, each in a time of 1, beginning with a given quarter."""
    pieces = [
        (i + 1, Rigid([-i, 1], pivot=pivot, orientation=QUARTERS[(first + i) % 4]))
        for i in range(4)
    ]
    return Pieces([*pieces[:-1], (None, pieces[-1][1])])


def turned_scene(seed):
    """A mill that makes a whole turn, a body turned at the start, and posts around them."""
    rng = Random(seed)
    arm = rng.randint(3, 5)
    blade = [(0, 0), (arm, 0), (arm, 1), (1, 1)]
    pivot = (QQ(1, 2), QQ(1, 2))
    drifting = Rigid(
        [0, QQ(rng.randint(-3, 3), 4)], pivot=(12, 0), x=[0, -1], orientation=rng.choice(UNITS)
    )
    bodies = [
        Body("mill", blade, whole_turn(rng.randrange(4), pivot)),
        Body("other", [(11, -1), (13, -1), (12, 2)], drifting),
        Body("post", [(rng.randint(-7, -3), rng.randint(-6, 6))]),
        Body("wall", [(-3, -6), (3, -6 - rng.randint(0, 2))]),
    ]
    return Scene(bodies, time=(0, 4))


@pytest.mark.parametrize("seed", range(6))
def test_every_method_finds_the_contact_of_the_reference(seed):
    scene = turned_scene(seed)
    expected = reference.first_contact(scene)
    for options in ({"method": "pairs"}, {"tiling": "lazy"}, {"tiling": "mixed"}):
        found = exactpt.first_contact(scene, **options)
        assert disagreement(expected, found) is None


@pytest.mark.long
def test_the_images_of_a_turned_scene_have_the_images_of_its_contact():
    scene = next(s for s in map(turned_scene, range(9)) if exactpt.first_contact(s))
    contact = exactpt.first_contact(scene, exact_only=True)
    for name, variant in VARIANTS.items():
        if name != "backwards":
            found = exactpt.first_contact(variant.scene(scene), exact_only=True)
            assert difference(variant, scene, contact, found) is None, name


def test_a_turned_scene_is_the_same_after_saving():
    scene = turned_scene(0)
    again = loads(json.dumps(to_json(scene)))

    assert again == scene
    assert again.bodies[1].motion.orientation == scene.bodies[1].motion.orientation


def test_a_turned_body_goes_onward_as_it_is_turned():
    body = turned_scene(0).bodies[1]

    assert body.with_motion(onward(body, 1, (3, 0))).at(1) == body.at(1)
