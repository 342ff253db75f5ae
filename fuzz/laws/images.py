"""Laws about images: what is true of a scene is true of its image, by a map of space and time."""

from __future__ import annotations

from random import Random

import exactpt
from exactpt import Scene
from exactpt.kernel.numbers import QQ, fraction
from fuzz.changes.awkward import awkward_variant
from fuzz.changes.variants import Variant, difference, expected_time
from fuzz.laws.law import check_equal
from fuzz.laws.questions import a_time, contact_kind, contact_value, two_names
from fuzz.witnesses import Difference, tilings_of

__all__ = ["first_contact_of_image", "pairs_of_image"]


def first_contact_of_image(scene: Scene, random: Random) -> str:
    """The first contact of an image is the image of the first contact."""
    variant = awkward_variant(random)
    image = variant.scene(scene)
    names = [*tilings_of(scene), "auto", "auto"]
    contact = exactpt.first_contact(scene, tiling=random.choice(names))
    of_image = exactpt.first_contact(image, tiling=random.choice(names))
    if kind := difference(variant, scene, contact, of_image):
        raise Difference(kind, f"{of_image}, but the original {contact}")
    return contact_kind(contact_value(contact))


def pairs_of_image(scene: Scene, random: Random) -> str:
    """Intervals, distances and clearances of an image are the images of those of the scene."""
    variant = awkward_variant(random)
    image = variant.scene(scene)
    first, second = two_names(scene, random)
    compare = random.choice([_compare_intervals, _compare_distances, _compare_clearances])
    compare(variant, scene, image, (first, second), a_time(scene, random))
    return compare.__name__.removeprefix("_compare_")


Names = tuple[str, str]


def _image_of(variant: Variant, names: Names) -> Names:
    return variant.name(names[0]), variant.name(names[1])


def _intervals(scene: Scene, names: Names) -> list[tuple[exactpt.AlgebraicNumber, ...]]:
    """Return the intervals in which two bodies touch, in whichever order the scene has them."""
    return [(i.start, i.end) for i in exactpt.contact_intervals(scene, *names)]


def _compare_intervals(
    variant: Variant, scene: Scene, image: Scene, names: Names, time: QQ  # noqa: ARG001
) -> None:  # fmt: skip
    expected = [
        tuple(expected_time(variant, end) for end in interval)
        for interval in _intervals(scene, names)
    ]
    check_equal("intervals", _intervals(image, _image_of(variant, names)), expected)


def _compare_distances(
    variant: Variant, scene: Scene, image: Scene, names: Names, time: QQ
) -> None:
    later = variant.rate * time + variant.delay
    here = exactpt.distance(scene, *names, at=fraction(time))
    there = exactpt.distance(image, *_image_of(variant, names), at=fraction(later))
    (a, _), (c, _) = variant.matrix
    squared = here.core_squared * fraction(a * a + c * c)
    check_equal("squared distance", there.core_squared, squared)
    check_equal("number of nearest features", len(there.features), len(here.features))


def _compare_clearances(
    variant: Variant, scene: Scene, image: Scene, names: Names, time: QQ  # noqa: ARG001
) -> None:  # fmt: skip
    least = exactpt.clearance(scene, *names).minimum.time
    of_image = exactpt.clearance(image, *_image_of(variant, names)).minimum.time
    check_equal("time of the least distance", of_image, expected_time(variant, least))
