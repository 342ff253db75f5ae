"""Pairs of small shapes in any unit of length and far from the origin, and of many vertices."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import Final

from exactpt import Affine, Body, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["scaled_pair", "wheels"]

SHAPES: Final = (
    [(0, 0)],
    [(0, 0), (2, 1)],
    [(0, 0), (2, 0), (0, 2)],
    [(0, 0), (2, 0), (2, 2), (1, 1)],
    [(-1, -1), (3, -1), (3, 2), (1, 0), (-1, 2)],
)

UNITS: Final = tuple(
    map(Fraction, ["1", "1/3", "10/7", f"1/{2**60}", str(2**70), f"1/{10**30}", f"1/{2**300}",
                   str(2**300), f"1/{2**1200}"])
)  # fmt: skip
"""Units of length: no double is as small as the last one."""

FAR: Final = (0, 0, 10**6, 2**36, 10**13)
"""Distances from the origin, in units."""

RADII: Final = tuple(map(Fraction, ["0", "1/3", "1/2", "1", "5/4"]))

GAPS: Final = tuple(map(Fraction, ["0", "0", "1/3", f"1/{10**12}"]))
"""What is added to a whole distance across the motion: bodies touch, miss or hit by very little."""


def scaled_pair(random: Random) -> Scene:
    """Return two bodies in straight motion on a grid of some unit, often far from the origin."""
    unit, far = random.choice(UNITS), random.choice(FAR)
    across = random.randint(-6, 6) + random.choice(GAPS)
    velocity = random.randint(1, 3), random.randint(-1, 1)
    other_velocity = random.randint(-1, 0), random.randint(-1, 1)
    radius = random.choice(RADII)
    moving = _placed("a", random, unit, (far - 9, far + across), velocity, radius)
    still = _placed("b", random, unit, (far, far), other_velocity, Fraction(0))
    return Scene([moving, still], time=(0, 12))


def _placed(
    name: str,
    random: Random,
    unit: Fraction,
    offset: tuple[int | Fraction, int | Fraction],
    velocity: tuple[int, int],
    radius: Fraction,
) -> Body:
    shape = random.choice(SHAPES)
    if random.random() < 0.5:
        shape = [(y, -x) for x, y in shape]  # turned by a right angle
    dx, dy = offset
    vertices = [((x + dx) * unit, (y + dy) * unit) for x, y in shape]
    motion = Translation([0, velocity[0] * unit], [0, velocity[1] * unit])
    return Body(name, vertices, motion, radius=radius * unit)


def wheels(random: Random) -> Scene:
    """Return two regular polygons of many vertices, which are doubles, that pass each other.

    So few of many pairs of features are nearest: filters leave most of them out.
    """
    far = random.choice([0, 0, 0, 10**6, 10**30])
    sides = random.choice([(1, 12), (4, 5), (6, 18), (12, 12), (18, 18)])
    y = random.uniform(-1, 1)
    a = Body("a", _ring(sides[0], far, far), _motion(random, far))
    b = Body("b", _ring(sides[1], far + random.uniform(3, 5), far + y))
    return Scene([a, b], time=(0, 2))


def _ring(sides: int, x: float, y: float) -> list[tuple[Fraction, Fraction]]:
    angles = [2 * math.pi * k / sides for k in range(sides)]
    return [(Fraction(math.cos(t)) + Fraction(x), Fraction(math.sin(t)) + Fraction(y))
            for t in angles]  # fmt: skip


def _motion(random: Random, far: int) -> Motion:
    bend = Fraction(random.randint(-9, 9), 9)
    motions: list[Motion] = [
        Translation([0, random.choice([1, 2])], [0, Fraction(1, 8)]),
        Translation([0, bend], [random.uniform(-2, 0), 2]),
        Translation([0, 0, 1], [0, -1, Fraction(1, 3)]),
        Rigid([0, Fraction(1, 2)], pivot=(far, far)),
        Rigid([0, Fraction(1, 3)], pivot=(far + 50, far + 1), x=[0, 1]),
    ]
    if not far:
        motions.append(Affine([[[1, Fraction(1, 2)], [0]], [[0], [1]]]))
    return random.choice(motions)
