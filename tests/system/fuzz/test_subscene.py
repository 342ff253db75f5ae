"""Sub-scenes: a few bodies of a scene, the same in every run; one in `WHOLE` scenes is whole."""

from random import Random

import pytest
from folding import every

from exactpt.scene.generate import FAMILIES, POINTS, generate
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from fuzz.subscene import MOST, WHOLE, scene_of, subscene
from fuzz.thin import SUFFIX

ALL = [*FAMILIES, *POINTS]


@every("family", ALL)
def test_a_subscene_is_a_part_of_the_scene(family):
    for seed in range(1, 6):
        whole, part = to_json(generate(family, seed)), to_json(scene_of(family, seed))

        kept = [body for body in whole["bodies"] if body in part["bodies"]]
        assert part == {**whole, "bodies": kept}
        assert len(kept) >= min(2, len(whole["bodies"]))


@every("family", ALL)
def test_now_and_then_a_scene_is_whole(family):
    assert to_json(scene_of(family, 5 * WHOLE)) == to_json(generate(family, 5 * WHOLE))


def test_subscenes_are_small_and_of_every_size():
    """Bodies are added while they are too few: never more than one body too many."""
    sizes = set()
    for seed in range(200):
        scene = subscene(generate("convex", 7), Random(seed))
        smaller = scene.vertex_count - min(body.size for body in scene.bodies)
        assert len(scene.bodies) == 2 or smaller < MOST
        sizes.add(len(scene.bodies))

    assert {2, 3, 4} <= sizes


def test_neighbours_are_more_likely_than_strangers():
    row = generate("row", 0)
    places = [body.at(row.start)[0] for body in row.bodies]
    by_x = sorted(range(len(places)), key=lambda i: places[i])
    names = [row.bodies[i].name for i in by_x]
    adjacent = 0
    for seed in range(100):
        found = sorted(names.index(b.name) for b in subscene(row, Random(seed)).bodies)
        adjacent += found[1] - found[0] == 1

    assert adjacent > 60


def test_a_scene_without_bodies_is_its_own_subscene():
    assert subscene(Scene([], (0, 1)), Random(0)).bodies == ()


@pytest.mark.parametrize("family", FAMILIES)
def test_thinned_scenes_have_chains_segments_or_points(family):
    """Half of the bodies are parts of what they were; the others are as they were."""
    bodies = [body for seed in range(1, 9) for body in to_json(scene_of(family, seed))["bodies"]]
    thin = [
        body for seed in range(1, 9) for body in to_json(scene_of(family + SUFFIX, seed))["bodies"]
    ]

    changed = [body for body in thin if body not in bodies]
    assert len(thin) == len(bodies)
    assert 0 < len(changed) < len(bodies)
    assert all(body.get("closed", len(shape(body)) > 2) is False for body in changed)


def shape(body):
    return body["keyframes"][0]["vertices"] if "keyframes" in body else body["vertices"]
