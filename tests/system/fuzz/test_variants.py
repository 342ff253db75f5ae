"""Variants: symmetries of scenes, and what makes them see a difference."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
from folding import every

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.scene.format import loads
from exactpt.scene.generate import FAMILIES, generate
from exactpt.scene.written import to_json
from fuzz.questions.all_pairs import first_contact_allpairs
from fuzz.variants import VARIANTS, difference, expected_time

FORWARDS = [name for name in VARIANTS if name != "backwards"]


def colliding(family):
    """The first small scene of a family with a contact, and the contact."""
    for seed in range(40):
        scene = generate(family, seed)
        if scene.vertex_count <= 24 and (contact := first_contact_allpairs(scene)):
            return scene, contact
    return None


@pytest.mark.parametrize("family", [f for f in sorted(FAMILIES) if f not in ("convoy", "chains")])
def test_the_reference_is_symmetric(family):
    found = colliding(family)
    if found is None:
        return
    scene, contact = found
    for name in FORWARDS:
        image = VARIANTS[name].scene(scene)
        assert difference(VARIANTS[name], scene, contact, first_contact_allpairs(image)) is None, (
            name
        )


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
    names = ("time", "kind", "pairs", "overlaps")
    return SimpleNamespace(**{name: getattr(contact, name) for name in names} | changes)


def test_each_kind_of_difference_is_seen():
    scene, contact = colliding("small_grid")
    plain = VARIANTS["mirrored"]
    image = first_contact_allpairs(plain.scene(scene))
    pair = image.pairs[0]
    moved = replace(pair, point=(pair.point[0] + 1e-3, pair.point[1]))

    assert difference(plain, scene, contact, image) is None
    assert difference(plain, scene, contact, None) == "missed"
    assert difference(plain, scene, None, image) == "found"
    assert difference(plain, scene, contact, altered(image, kind="self")) == "kind"
    assert difference(plain, scene, contact, altered(image, pairs=image.pairs[1:])) == "pairs"
    assert difference(plain, scene, contact, altered(image, overlaps=(("a", "b"),))) == "overlaps"
    assert (
        difference(plain, scene, contact, altered(image, time=AlgebraicNumber(QQ(1, 7)))) == "time"
    )
    assert (
        difference(plain, scene, contact, altered(image, pairs=(moved, *image.pairs[1:])))
        == "point"
    )
