"""Answers pickled by version 0.2.0 load (tests/data/pickles.json), whichever modules have moved."""

import base64
import json
import pickle
from pathlib import Path

import pytest

from exactpt import (
    Body,
    Scene,
    Translation,
    clearance,
    contacts,
    distance,
    first_contact,
    first_contact_enclosed,
    first_within,
)

PICKLES = json.loads((Path(__file__).parents[2] / "data" / "pickles.json").read_text())
BALL = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
SCENE = Scene([BALL, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
ANSWERS = {
    "contact": lambda: first_contact(SCENE),
    "pair": lambda: first_contact(SCENE).pairs[0],
    "approach": lambda: first_within(SCENE, distance=1, norm="euclidean"),
    "interval": lambda: contacts(SCENE)[0],
    "distance": lambda: distance(SCENE, "ball", "wall", 0),
    "clearance": lambda: clearance(SCENE, "ball", "wall"),
    "minimum": lambda: clearance(SCENE, "ball", "wall").minimum,
    "enclosed": lambda: first_contact_enclosed(SCENE),
}


@pytest.mark.parametrize("name", ANSWERS)
def test_pickled_answer_loads_as_the_fresh_answer(name):
    loaded = pickle.loads(base64.b64decode(PICKLES[name]))

    fresh = ANSWERS[name]()
    assert type(loaded) is type(fresh)
    assert repr(loaded) == repr(fresh)


def test_fresh_answers_can_be_pickled():
    for answer in ANSWERS.values():
        fresh = answer()
        assert repr(pickle.loads(pickle.dumps(fresh))) == repr(fresh)
