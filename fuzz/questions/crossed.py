"""A small body, and a polygon of which some vertices move: it may cross itself before they meet."""

from __future__ import annotations

import math
from random import Random

from exactpt import Body, InputError, Scene, Translation
from exactpt.motion.shape import VertexLike

__all__ = ["crossed_pair"]


def crossed_pair(random: Random) -> Scene:
    """Return a deforming polygon, and a point or triangle that is aimed at it from afar."""
    angle = random.uniform(0, 2 * math.pi)
    x, y = round(6 * math.cos(angle), 2), round(6 * math.sin(angle), 2)
    velocity = [random.randint(-15, 15) / 10 - c / 2 for c in (x, y)]
    motion = Translation([0, velocity[0]], [0, velocity[1]])
    shape = [(x, y), (x + 0.5, y), (x, y + 0.5)][: random.choice([1, 3])]
    return Scene([_deforming(random), Body("robot", shape, motion)], (0, 3))


def _deforming(random: Random) -> Body:
    while True:
        ring: list[VertexLike] = []
        for k in range(random.randint(3, 6)):
            angle, far = math.pi * k / 3 + random.random(), random.randint(1, 3)
            x, y = round(far * math.cos(angle), 1), round(far * math.sin(angle), 1)
            moves = random.random() < 0.5
            to = [random.randint(-3, 3) if moves else 0 for _ in "xy"]
            ring.append({"x": [str(x), to[0]], "y": [str(y), to[1]]})
        try:
            body = Body("obstacle", ring)
            Scene([body], (0, 3))
        except InputError:
            continue  # not simple at the start
        return body
