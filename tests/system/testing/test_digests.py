"""Every catalogue of generated scenes and questions writes what it always wrote.

The seeds and numbers of scenes are quoted in reports, and the open set is published: a change of
one byte is found here. `python tests/system/testing/test_digests.py` from the root of a checkout
writes the digests anew.
"""

import hashlib
import json
from pathlib import Path
from random import Random

import pytest

from benchmarks import first_contact, planted, point_scenes
from benchmarks.everyday import EVERYDAY
from benchmarks.everyday_later import EVERYDAY_LATER
from exactpt.collision_set import passages
from exactpt.scene.generate import EVERY, generate
from exactpt.scene.written import to_json
from exactpt.testing.families import FAMILIES as QUESTIONS
from exactpt.testing.families import make_question
from exactpt.testing.space.families import FAMILIES as SPACE
from exactpt.testing.space.families import make_query
from fuzz.battery import BATTERY
from fuzz.questions import rounded, scenes, tiny
from fuzz.small_scope.scope import planned
from fuzz.subscene import scene_of

WRITTEN = Path(__file__).parents[2] / "data" / "digests.json"
PAIRS = [
    scenes.distant_scene,
    scenes.crowded_scene,
    scenes.meeting_scene,
    tiny.pair_scene,
    tiny.touching_scene,
    rounded.rounded_pair,
]


def passage(family, number):
    made = passages.make_passage(family, number)
    return [*made.start, *made.end, made.bits]


CATALOGUES = {
    "scenes": lambda: (to_json(generate(f, s)) for f in EVERY for s in range(3)),
    "questions": lambda: (
        make_question(f, s, n).to_json() for f in QUESTIONS for s in range(2) for n in range(3)
    ),
    "passages": lambda: (passage(f, n) for f in passages.FAMILIES for n in range(20)),
    "space": lambda: (
        make_query(kind, f, 0, n).to_json()
        for kind in ("vertex-face", "edge-edge")
        for f in SPACE
        for n in range(3)
    ),
    "planted": lambda: (
        to_json(make(Random(f"{f}:{s}")).scene)
        for f, make in planted.FAMILIES.items()
        for s in range(3)
    ),
    "point scenes": lambda: (
        to_json(make(20, Random(f))) for f, make in point_scenes.FAMILIES.items()
    ),
    "first contact": lambda: (
        to_json(make(8, Random(f))) for f, make in first_contact.FAMILIES.items()
    ),
    "everyday": lambda: (
        to_json(make(Random(f), 2)) for f, make in {**EVERYDAY, **EVERYDAY_LATER}.items()
    ),
    "subscenes": lambda: (
        to_json(scene_of(f + thin, s)) for f in EVERY for thin in ("", "/thin") for s in (1, 2)
    ),
    "battery": lambda: (to_json(test.build()) for test in BATTERY.values() if not test.large),
    "pairs of the fuzzer": lambda: (
        to_json(make(Random(f"{make.__name__} {s}"))) for make in PAIRS for s in range(20)
    ),
    "small scope": lambda: (to_json(planned(n).scene) for n in range(0, 40000, 400)),
}


def digest(items):
    sha = hashlib.sha256()
    for item in items:
        sha.update(json.dumps(item, sort_keys=True).encode())
    return sha.hexdigest()[:16]


@pytest.mark.parametrize("name", CATALOGUES)
def test_a_catalogue_is_what_it_was(name):
    assert digest(CATALOGUES[name]()) == json.loads(WRITTEN.read_text(encoding="utf-8"))[name]


def test_every_digest_has_its_catalogue():
    assert set(json.loads(WRITTEN.read_text(encoding="utf-8"))) == set(CATALOGUES)


if __name__ == "__main__":
    digests = {name: digest(items()) for name, items in CATALOGUES.items()}
    WRITTEN.write_text(json.dumps(digests, indent=2) + "\n", encoding="utf-8")
