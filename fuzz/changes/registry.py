"""Changes of scenes, by name: each returns another scene in which a law must hold too."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from fractions import Fraction
from random import Random
from typing import Any, Final, TypeAlias

from exactpt import Scene
from fuzz.changes.awkward import awkward
from fuzz.changes.images import TRANSFORMATIONS, halved
from fuzz.changes.thin import thinned
from fuzz.changes.variants import VARIANTS

__all__ = ["CHANGES", "Change", "changed"]

Change: TypeAlias = Callable[[Scene, Random], Scene]

Json: TypeAlias = Any
"""A part of a scene as JSON data."""

SMALL_STEPS: Final = (30, 45, 50, 52, 53, 54, 56, 60, 80)
"""Binary logarithms of how often a nudge fits into the size of a number: doubles have 53 bits."""


def _numbers(data: Json, skipped: tuple[str, ...]) -> Iterator[tuple[Json, Any]]:
    """Yield the number texts in JSON data of bodies: their containers, and their keys in these."""
    items = list(data.items()) if isinstance(data, dict) else list(enumerate(data))
    for key, value in items:
        if key in skipped:
            continue
        if isinstance(value, str):
            yield data, key
        elif isinstance(value, dict | list):
            yield from _numbers(value, skipped)


def nudged(scene: Scene, random: Random) -> Scene:
    """Return a scene in which one or two numbers are a little more or less: near ties."""
    data = json.loads(json.dumps(scene.to_json()))
    places = list(_numbers(data["bodies"], ("name", "properties", "time")))
    count = min(len(places), random.choice([1, 1, 2]))
    for container, key in random.sample(places, count):
        number = Fraction(container[key])
        size = max(abs(number), Fraction(1))
        part = Fraction(random.choice([1, -1]), random.choice([1, 3]))
        container[key] = str(number + size * part / 2 ** random.choice(SMALL_STEPS))
    return Scene.from_json(data)


def rounded(scene: Scene, random: Random) -> Scene:
    """Return an awkward image whose numbers are rounded to doubles: near ties of doubles.

    Radii stay as they are: an exact tie of a radius with a distance would be lost.
    """
    data = json.loads(json.dumps(awkward(scene, random).to_json()))
    for container, key in _numbers(data["bodies"], ("name", "properties", "radius")):
        container[key] = _nearest_double(container[key])
    data["time"] = [_nearest_double(t) for t in data["time"]]
    return Scene.from_json(data)


def _nearest_double(number: str) -> str:
    exact = Fraction(number)
    if abs(exact) > sys.float_info.max:
        return number  # doubles do not have it
    return str(Fraction(float(exact)))


def _image_by(transformation: str) -> Change:
    """Return the change that replaces a scene by its image; the same scene if there is none."""

    def change(scene: Scene, random: Random) -> Scene:
        image = TRANSFORMATIONS[transformation](scene, random)
        return scene if image is None else image.new.scene

    return change


def _halved(scene: Scene, random: Random) -> Scene:  # noqa: ARG001
    return halved(scene)


def _cut(scene: Scene, random: Random) -> Scene:  # noqa: ARG001
    return VARIANTS["cut"].scene(scene)


CHANGES: Final[dict[str, Change]] = {
    "awkward": awkward,
    "nudged": nudged,
    "rounded": rounded,
    "thin": thinned,
    "halved": _halved,
    "subdivided": _image_by("subdivided"),
    "cut": _cut,
    "renumbered": _image_by("renumbered"),
    "reversed": _image_by("reversed"),
    "permuted": _image_by("permuted"),
    "joined": _image_by("joined"),
    "separated": _image_by("separated"),
    "mirrored": _image_by("mirrored"),
}
"""Awkward: no number is a double any more, and ties stay ties. Nudged, rounded: ties become near
ties. Thin: bodies become parts of their boundaries. Cut: motions have more pieces than needed."""


def changed(scene: Scene, names: list[str], random: Random) -> Scene:
    """Return a scene after some changes, one after the other.

    Raises:
        InputError, TypeError, ValueError: if a change is not possible for the scene.
    """
    for name in names:
        scene = CHANGES[name](scene, random)
    return scene
