"""Witnesses of scenes, of their variants and of sub-scenes."""

import json
from dataclasses import replace
from random import Random
from types import SimpleNamespace

import pytest
from folding import every

from exactpt import AlgebraicNumber, Scene, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing.audits import run_and_audit
from exactpt.testing.scenes import FAMILIES, POINTS, RINGS, ROUNDED, TOUCHING, generate
from exactpt.tiling.start import TILINGS
from fuzz.cases import failure_of
from fuzz.changes.excerpts import MOST, WHOLE, scene_of, subscene
from fuzz.changes.thin import SUFFIX
from fuzz.changes.variants import VARIANTS, difference, expected_time
from fuzz.old_engine.build import is_built
from fuzz.witnesses import OLD, WITNESSES

GENERIC = ("convex", "mixed_shapes", "ballistic", "turning", "deforming", "pieces", "keyframed")
QUICK = ("reference", "static", "filters")
PRESENT = [name for name in WITNESSES if name != OLD or is_built()]
"""All witnesses; the old engine only where it is built (`make old-engine`)."""


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS, *TOUCHING])
def test_no_witness_objects(family):
    for seed in (1, 2, 3):
        scene = scene_of(family, seed)
        for witness in QUICK:
            assert failure_of(witness, scene, seed) is None


@pytest.mark.parametrize("family", [*ROUNDED, *RINGS, *TOUCHING])
def test_variants_of_rounded_bodies_and_rings_have_the_image_of_the_contact(family):
    """Bug: of discs that just touch, the contact was missed 2^60 from the origin."""
    for seed in range(1, 21):
        assert failure_of("symmetry", scene_of(family, seed), seed) is None


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", GENERIC)
def test_what_is_generic_needs_no_rebuild(family, tiling):
    """A repair that is left out or done wrongly would be made good by one, and go unseen."""
    events = 0
    for seed in range(1, 9):
        run = run_and_audit(scene_of(family, seed), tiling, middle=False)
        if run is not None:
            stats = run.kinetic.stats
            events += stats.total
            assert (stats.rebuilds, stats.flips) == (0, 0)

    assert events


@pytest.mark.slow
@pytest.mark.cgal
@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_no_witness_objects_to_more(family, program):
    for seed in range(4, 24):
        scene = scene_of(family, seed)
        for witness in PRESENT:
            assert failure_of(witness, scene, seed) is None


# Variants: symmetries of scenes, and what makes them see a difference

FORWARDS = [name for name in VARIANTS if name != "backwards"]


def colliding(family):
    """The first small scene of a family with a contact, and the contact."""
    for seed in range(40):
        scene = generate(family, seed)
        if scene.vertex_count <= 24 and (contact := first_contact(scene, exact_only=True)):
            return scene, contact
    return None


@pytest.mark.parametrize("family", [f for f in sorted(FAMILIES) if f not in ("convoy", "chains")])
def test_the_exact_search_is_symmetric(family):
    found = colliding(family)
    if found is None:
        return
    scene, contact = found
    for name in FORWARDS:
        found = first_contact(VARIANTS[name].scene(scene), exact_only=True)
        assert difference(VARIANTS[name], scene, contact, found) is None, name


@every("name", VARIANTS)
@every("family", ["turning", "deforming", "pieces", "keyframed", "blobs"])
def test_positions_go_where_they_should(family, name):
    """At a time of the scene, each vertex of the image is at the image of the vertex."""
    scene, variant = generate(family, 1).until("1/1000"), VARIANTS[name]
    image = variant.scene(scene)
    t = (2 * scene.start + scene.end) / 3
    there = image.at(variant.rate * t + variant.delay)
    (a, b), (c, d) = variant.matrix
    for body in scene.bodies:
        for i, (x, y) in enumerate(body.at(t)):
            p, q = x + variant.drift[0] * t, y + variant.drift[1] * t
            expected = (a * p + b * q + variant.shift[0], c * p + d * q + variant.shift[1])
            assert there[variant.name(body.name)][variant.vertex(body, i)] == expected


def test_images_are_scenes_of_the_format():
    for family in ("pieces", "turning", "deforming", "keyframed", "blobs"):
        scene = generate(family, 1)
        for name in FORWARDS:
            data = to_json(VARIANTS[name].scene(scene))
            assert to_json(loads(json.dumps(data))) == data


def test_times_are_mapped_exactly():
    root = AlgebraicNumber.root((-2, 0, 1), QQ(1), QQ(2))
    variant = VARIANTS["slower"]

    mapped = expected_time(variant, root)

    assert mapped.sign_of((-94, 8, 4)) == 0  # (2 (t + 1) / 7)^2 = 2
    assert float(mapped) == pytest.approx(3.5 * 2**0.5 - 1)
    assert expected_time(variant, AlgebraicNumber(2)) == 6


def altered(contact, **changes):
    """What looks like a contact, but for some attributes."""
    names = ("time", "kind", "pairs", "initial_pairs")
    return SimpleNamespace(**{name: getattr(contact, name) for name in names} | changes)


def test_each_kind_of_difference_is_seen():
    scene, contact = colliding("small_grid")
    plain = VARIANTS["mirrored"]
    image = first_contact(plain.scene(scene), exact_only=True)
    pair = image.pairs[0]
    moved = replace(pair, point=(pair.point[0] + 1e-3, pair.point[1]))

    assert difference(plain, scene, contact, image) is None
    assert difference(plain, scene, contact, None) == "missed"
    assert difference(plain, scene, None, image) == "found"
    assert difference(plain, scene, contact, altered(image, kind="self")) == "kind"
    assert difference(plain, scene, contact, altered(image, pairs=image.pairs[1:])) == "pairs"
    assert (
        difference(plain, scene, contact, altered(image, initial_pairs=(("a", "b"),)))
        == "initial_pairs"
    )
    assert (
        difference(plain, scene, contact, altered(image, time=AlgebraicNumber(QQ(1, 7)))) == "time"
    )
    assert (
        difference(plain, scene, contact, altered(image, pairs=(moved, *image.pairs[1:])))
        == "point"
    )


# Sub-scenes: a few bodies of a scene, the same in every run; one in `WHOLE` scenes is whole

FAMILIES_AND_POINTS = [*FAMILIES, *POINTS]


@every("family", FAMILIES_AND_POINTS)
def test_a_subscene_is_a_part_of_the_scene(family):
    for seed in range(1, 6):
        whole, part = to_json(generate(family, seed)), to_json(scene_of(family, seed))

        kept = [body for body in whole["bodies"] if body in part["bodies"]]
        assert part == {**whole, "bodies": kept}
        assert len(kept) >= min(2, len(whole["bodies"]))


@every("family", FAMILIES_AND_POINTS)
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
