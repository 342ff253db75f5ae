"""Awkward numbers: multiples of 1/3, 1/7, 1/9 and 1/13, so that no number is a double any more.

A scene of integers, or of doubles, hides mistakes in the bounds of filters: there nothing is
rounded. An awkward scene is the exact image of another one. So ties stay ties, and all filters have
rounding errors to mind.
"""

from __future__ import annotations

from random import Random
from typing import Final, TypeAlias

from exactpt.kernel.numbers import QQ
from exactpt.scene.scene import Scene
from fuzz.changes.variants import Variant

__all__ = ["SUFFIX", "TURNS", "awkward", "awkward_number", "awkward_variant"]

Vector: TypeAlias = tuple[QQ, QQ]

SUFFIX: Final = "/awkward"
"""Suffix of the name of a family whose scenes are replaced by their awkward images."""

DENOMINATORS: Final = (3, 7, 9, 13)

TURNS: Final[tuple[Vector, ...]] = tuple(
    (QQ(x, n), QQ(y, n))
    for a, b, n in [(3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29), (1, 0, 1)]
    for x, y in [(a, b), (b, a), (-a, b), (b, -a)]
)
"""The cosine and the sine of some angles."""

FACTORS: Final = (QQ(1), QQ(2, 3), QQ(10, 7), QQ(7, 9), QQ(1000, 13))

FAR: Final = (1, 1, 1, 1000, 10**6)
"""Sizes of the shift in space, in units of the scene."""

LATE: Final = (2, 2, 2, 1000, 10**9)
"""Sizes of the shift in time."""


def awkward_number(random: Random, most: int) -> QQ:
    """Return a multiple of 1/3, 1/7, 1/9 or 1/13 from -most to most."""
    n = random.choice(DENOMINATORS)
    return QQ(random.randint(-most * n, most * n), n)


def awkward_variant(random: Random) -> Variant:
    """Return a similarity, a drift and an affine map of time, all of them awkward."""
    cosine, sine = random.choice(TURNS)
    factor, far = random.choice(FACTORS), random.choice(FAR)
    a, b = factor * cosine, factor * sine
    turn = random.choice([((a, -b), (b, a)), ((a, b), (b, -a))])
    return Variant(
        matrix=turn,
        shift=(awkward_number(random, 3 * far), awkward_number(random, 3 * far)),
        rate=QQ(random.choice([1, 2, 4, 7]), random.choice(DENOMINATORS)),
        delay=awkward_number(random, random.choice(LATE)),
        drift=(awkward_number(random, 1), awkward_number(random, 1)),
        renumber=random.choice(["none", "turned", "reversed"]),
        reorder=random.random() < 0.5,
    )


def awkward(scene: Scene, random: Random) -> Scene:
    """Return an awkward image of a scene."""
    return awkward_variant(random).scene(scene)
