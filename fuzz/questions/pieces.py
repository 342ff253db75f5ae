"""Scenes whose bodies are near each other in few pieces of motion, or along a line only.

What boxes of pieces and oriented boxes leave out matters here: bodies whose velocities change
often, and long thin ones side by side.
"""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import Final

from exactpt import Body, Pieces, Rigid, Scene, Translation

__all__ = ["planks", "sliders", "walkers"]

PIECES: Final = 20
"""Number of pieces of the motion of a walker."""

LENGTH: Final = 1000
"""Length of a plank, of which the ends are a tenth of a unit wide."""

UNITS: Final = (*[Fraction(1)] * 4, Fraction(2) ** 1013, Fraction(1, 2**1080))
"""Units of length: in most cases one, else one that leaves the range of doubles."""


def walkers(random: Random) -> Scene:
    """Return boxes that change their velocities often, at times of their own."""
    bodies = [_walker(f"w{k}", random) for k in range(random.choice([2, 3, 6]))]
    if random.random() < 0.3:
        bodies.append(Body("mill", [(0, 0), (40, 0)], Rigid([0, 1])))
    return Scene(bodies, time=(0, 100))


def _walker(name: str, random: Random) -> Body:
    """Return a box with another velocity in each piece, at rest in the last one."""
    x = random.randint(-12, 12)
    y = random.randint(-12, 12)
    now = 0
    pieces: list[tuple[int | None, Translation]] = []
    for _ in range(PIECES - 1):
        until = now + random.randint(1, 9)
        u = random.randint(-3, 3)
        v = random.randint(-3, 3)
        pieces.append((until, Translation([x - u * now, u], [y - v * now, v])))
        x += u * (until - now)
        y += v * (until - now)
        now = until
    pieces.append((None, Translation([x], [y])))
    return Body(name, [(0, 0), (2, 0), (2, 1), (0, 1)], Pieces(pieces))


def sliders(random: Random) -> Scene:
    """Return a chain that slides along its own line, in doubles, towards the end of another one.

    It may turn back before, at or after that end. A point comes to a post at some time, and others
    fly past. So a vertex and an edge are in line all the time, and a formula is wrong later.
    """
    dx, dy = random.choice([(1.0, 1.0), (1.0, 2.0), (2.0, 1.0)])
    place = float(random.choice([5, 5, 20, 40]))
    there = Translation([0.0, dx], [0.0, dy])
    turn = random.randint(1, 3)
    motion: Translation | Pieces = there
    if random.random() < 0.5:
        back = Translation([2.0 * turn * dx, -dx], [2.0 * turn * dy, -dy])
        motion = Pieces([(turn, there), (None, back)])
    line = [(k * dx, k * dy) for k in range(3)]
    end = place * dx, place * dy
    around = [end, (place * dx + 1.0, 0.0), (1.0, -1.0)]
    point_x = -10.0 - random.randint(1, 20)
    bodies = [
        Body("slider", line, motion, closed=False),
        Body("corner", around, closed=False),
        Body("point", [(point_x, 0.0)], Translation([0.0, 1.0])),
        Body("post", [(-10.0, -1.0), (-10.0, 1.0)], closed=False),
    ]
    for k in range(random.choice([0, 4])):
        x, speed = random.choice([(-50.0, -9.0), (90.0, 9.0)])
        bodies.append(Body(f"far {k}", [(x, float(k))], Translation([0.0, speed])))
    return Scene(bodies, time=(0, random.choice([3, 100, 100])))


def planks(random: Random) -> Scene:
    """Return long thin triangles side by side, at angles about one direction, that drift apart."""
    angle = math.radians(random.choice([45, 20, 70, 90]))
    spread = math.radians(random.choice([0, 0.01, 0.1]))
    unit = random.choice(UNITS)
    bodies = []
    for k in range(random.choice([6, 26])):
        # Planks begin 1.5 apart, beside each other across the direction.
        x = -1.5 * k * math.sin(angle)
        y = 1.5 * k * math.cos(angle)
        turn = angle + random.uniform(-spread, spread)
        end_x = x + LENGTH * math.cos(turn)
        end_y = y + LENGTH * math.sin(turn)
        tip = end_x - 0.1 * math.sin(turn), end_y + 0.1 * math.cos(turn)
        drift = random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)
        corners = [_times(point, unit) for point in ((x, y), (end_x, end_y), tip)]
        u, v = _times(drift, unit)
        bodies.append(Body(f"p{k}", corners, Translation([0, u], [0, v])))
    return Scene(bodies, time=(0, 3))


def _times(vector: tuple[float, float], unit: Fraction) -> tuple[float | Fraction, ...]:
    """Return a vector in another unit: doubles stay doubles, which are read in another way."""
    if unit == 1:
        return vector
    return tuple(Fraction(c) * unit for c in vector)
