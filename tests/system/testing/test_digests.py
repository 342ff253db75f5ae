"""A family of generated scenes or questions is what it was: its digest is in a file.

The seeds and numbers of scenes are quoted in reports, and the open set is published, so that a
change of a family must be meant. A family that is new is not in the file, and nothing fails;
`make accept` writes the file anew, and the difference names the families that have changed.
"""

import hashlib
import json
from pathlib import Path
from random import Random

import pytest

from benchmarks import first_contact, planted, point_scenes
from benchmarks.collision_set import passages
from benchmarks.everyday import EVERYDAY
from benchmarks.everyday_later import EVERYDAY_LATER
from exactpt.scene.written import to_json
from exactpt.testing.families import FAMILIES as QUESTIONS
from exactpt.testing.families import make_question
from exactpt.testing.scenes import EVERY, generate
from exactpt.testing.space.families import FAMILIES as SPACE
from exactpt.testing.space.families import make_query
from fuzz.battery import BATTERY
from fuzz.changes.excerpts import scene_of
from fuzz.questions import rounded, scenes, tiny
from fuzz.small_scope.scope import planned

WRITTEN = Path(__file__).parents[2] / "data" / "digests.json"
PAIRS = {
    make.__name__: make
    for make in (
        scenes.distant_scene,
        scenes.crowded_scene,
        scenes.meeting_scene,
        tiny.pair_scene,
        tiny.touching_scene,
        rounded.rounded_pair,
    )
}


def passage(family, number):
    made = passages.make_passage(family, number)
    return [*made.start, *made.end, made.bits]


def queries(family):
    kinds = ("vertex-face", "edge-edge")
    return (make_query(kind, family, 0, n).to_json() for kind in kinds for n in range(3))


def questions(family):
    return (make_question(family, s, n).to_json() for s in range(2) for n in range(3))


def scenes_of(family):
    return (to_json(generate(family, s)) for s in range(3))


def subscenes(family):
    return (to_json(scene_of(family + thin, s)) for thin in ("", "/thin") for s in (1, 2))


CATALOGUES = {
    "scenes": (EVERY, scenes_of),
    "questions": (QUESTIONS, questions),
    "passages": (passages.FAMILIES, lambda f: (passage(f, n) for n in range(20))),
    "space": (SPACE, queries),
    "planted": (
        planted.FAMILIES,
        lambda f: (to_json(planted.FAMILIES[f](Random(f"{f}:{s}")).scene) for s in range(3)),
    ),
    "point scenes": (
        point_scenes.FAMILIES,
        lambda f: [to_json(point_scenes.FAMILIES[f](20, Random(f)))],
    ),
    "first contact": (
        first_contact.FAMILIES,
        lambda f: [to_json(first_contact.FAMILIES[f](8, Random(f)))],
    ),
    "everyday": (EVERYDAY, lambda f: [to_json(EVERYDAY[f](Random(f), 2))]),
    "everyday, later": (EVERYDAY_LATER, lambda f: [to_json(EVERYDAY_LATER[f](Random(f), 2))]),
    "subscenes": (EVERY, subscenes),
    "battery": (
        [name for name, test in BATTERY.items() if not test.large],
        lambda f: [to_json(BATTERY[f].build())],
    ),
    "pairs of the fuzzer": (
        PAIRS,
        lambda f: (to_json(PAIRS[f](Random(f"{f} {s}"))) for s in range(20)),
    ),
    "small scope": (
        ["planned"],
        lambda _: (to_json(planned(n).scene) for n in range(0, 40000, 400)),
    ),
}
"""For each catalogue the names of its families, and a function from a name to what it writes."""

RECORDED = json.loads(WRITTEN.read_text(encoding="utf-8"))


def digest(items):
    sha = hashlib.sha256()
    for item in items:
        sha.update(json.dumps(item, sort_keys=True).encode())
    return sha.hexdigest()[:16]


def digests():
    return {
        catalogue: {name: digest(make(name)) for name in sorted(names)}
        for catalogue, (names, make) in CATALOGUES.items()
    }


@pytest.mark.parametrize("catalogue", RECORDED)
def test_a_recorded_family_is_what_it_was(catalogue):
    names, make = CATALOGUES[catalogue]
    recorded = RECORDED[catalogue]

    changed = [n for n in names if n in recorded and recorded[n] != digest(make(n))]

    assert changed == [], "if this is meant: make accept, and say why in the commit"


if __name__ == "__main__":
    WRITTEN.write_text(json.dumps(digests(), indent=1) + "\n", encoding="utf-8")
