"""Distances of two bodies of a family in each kind of motion, at some times, by definition."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Scene, clearance, distance
from exactpt.kernel.numbers import QQ, fraction, rational
from exactpt.testing import reference
from exactpt.testing.scenes import generate
from fuzz.changes.awkward import awkward
from fuzz.changes.excerpts import subscene

__all__ = ["KINDS", "wrong_clearance"]

KINDS: Final[dict[str, tuple[str, ...]]] = {
    "turning": ("turning", "turning_stars", "turning_points"),
    "deforming": ("deforming", "keyframed"),
    "curved": ("ballistic", "ballistic_points", "parabola_points"),
    "in pieces": ("pieces", "piecewise_points"),
    "straight": ("convex", "mixed_shapes", "stars", "linear_points"),
    "with rings": ("lakes", "frames"),
}
"""Families by the kind of their motions: each kind has the same share, whatever their number."""

TIMES: Final = 6
"""Number of times at which a distance is compared."""


def wrong_clearance(random: Random) -> tuple[Scene, str, str | None]:
    """Return two bodies, the kind of their motions, and a fault of their distance."""
    kind = random.choice([*KINDS])
    family = random.choice(KINDS[kind])
    scene = subscene(generate(family, random.getrandbits(20)), random)
    while len(scene.bodies) < 2:
        scene = subscene(generate(family, random.getrandbits(20)), random)
    if random.random() < 0.4:
        scene = awkward(scene, random)
    a, b = random.sample(scene.bodies, 2)
    scene = Scene([a, b], (scene.start, scene.end))
    gap = clearance(scene, a.name, b.name)
    least = gap.minimum.squared
    for _ in range(TIMES):
        t = scene.exact_start + (scene.exact_end - scene.exact_start) * QQ(
            random.randint(0, 60), 60
        )
        expected = rational(reference.nearest(a, b, t).core_squared)
        found = QQ(gap.squared(fraction(t)))
        there = QQ(distance(scene, a.name, b.name, at=fraction(t)).core_squared)
        if not found == there == expected:
            fault = f"the squared distance at {t}: {found}, {there}, not {expected}"
            return scene, kind, fault
        if least.compare_rational(expected) > 0:
            return scene, kind, f"the minimum {least} is more than {expected} at {t}"
    return scene, kind, None
