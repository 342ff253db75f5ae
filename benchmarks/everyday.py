"""Ten families of scenes as users bring them, written after the methods had been tuned."""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from typing import Final, TypeAlias

from exactpt import Body, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["EVERYDAY", "Family", "Points"]

Points: TypeAlias = "list[tuple[float, float]]"
Family: TypeAlias = Callable[[Random, int], Scene]


def _moving(x: float, y: float) -> Translation:
    return Translation([0.0, x], [0.0, y])


def _box(x: float, y: float, width: float, height: float) -> Points:
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def _rock(rng: Random, x: float, y: float, radius: float, corners: int) -> Points:
    """A star-shaped polygon about (x, y)."""
    turns = [2.0 * math.pi * (i + rng.uniform(0.1, 0.9)) / corners for i in range(corners)]
    sizes = [radius * rng.uniform(0.5, 1.0) for _ in turns]
    return [(x + s * math.cos(a), y + s * math.sin(a)) for s, a in zip(sizes, turns, strict=True)]


def _junction(rng: Random, size: int) -> Scene:
    """Cars on two roads that cross."""
    cars = []
    for i in range(6 * size):
        lane, queue = i % 4, 12.0 * (i // 4) + rng.uniform(10.0, 14.0)
        speed, offset = rng.uniform(8.0, 12.0), (2.0, -4.0)[lane % 2]
        sign = (-1.0, 1.0)[lane % 2]
        if lane < 2:
            cars.append((_box(-sign * queue - 2.0, offset, 4.0, 2.0), _moving(sign * speed, 0.0)))
        else:
            cars.append((_box(offset, sign * queue - 2.0, 2.0, 4.0), _moving(0.0, -sign * speed)))
    return Scene([Body(f"car{i}", *car) for i, car in enumerate(cars)], (0, 10))


def _belt(rng: Random, size: int) -> Scene:
    """Rocks that spin and drift along a belt."""
    rocks = []
    for i in range(5 * size):
        x, y = 6.0 * (i % 10), 6.0 * (i // 10)
        spin = Rigid(
            [0.0, rng.uniform(-0.5, 0.5)], pivot=(x, y), x=[0.0, rng.uniform(0.5, 1.0)],
            y=[0.0, rng.uniform(-0.1, 0.1)],
        )  # fmt: skip
        rocks.append(Body(f"rock{i}", _rock(rng, x, y, 2.0, rng.randint(5, 9)), spin))
    return Scene(rocks, (0, 20))


def _combs(rng: Random, size: int) -> Scene:
    """A comb that slides into another."""
    teeth = 10 * size
    lower: Points = [(-1.0, -2.0), (4.0 * teeth, -2.0)]
    for i in reversed(range(teeth)):
        width = rng.uniform(0.8, 1.2)
        lower += [(4.0 * i + width, 0.0), (4.0 * i + width, 8.0), (4.0 * i, 8.0), (4.0 * i, 0.0)]
    upper = [(x + 2.0, 18.5 - y) for x, y in reversed(lower)]
    slide = _moving(rng.uniform(-0.02, 0.02), -1.0)
    return Scene([Body("lower", lower), Body("upper", upper, slide)], (0, 20))


def _rain(rng: Random, size: int) -> Scene:
    """Points that fall onto a slope."""
    width = 100.0
    ground = [(width * i / 40, 0.2 * width * i / 40 + rng.uniform(0.0, 2.0)) for i in range(41)]
    slope = Body("slope", [*ground, (width, -5.0), (0.0, -5.0)])
    drops = [
        Body(
            f"drop{i}",
            [(rng.uniform(0.0, width), rng.uniform(60.0, 160.0))],
            Translation([0.0, rng.uniform(-1.0, 1.0)], [0.0, rng.uniform(-2.0, 0.0), -4.905]),
        )
        for i in range(30 * size)
    ]
    return Scene([slope, *drops], (0, 4))


def _worm(rng: Random, size: int) -> Scene:
    """A long worm that curls."""
    links = 10 * size

    def side(height: float, order: range) -> list[dict[str, list[float]]]:
        return [
            {
                "x": [float(i), rng.uniform(-0.05, 0.05), -0.004 * (i - links / 2)],
                "y": [height, rng.uniform(-0.05, 0.05), 0.06 * (i - links / 2) ** 2 / links],
            }
            for i in order
        ]

    outline = side(0.0, range(links)) + side(1.0, range(links - 1, -1, -1))
    return Scene([Body("worm", outline)], (0, 20))


def _bullet(rng: Random, size: int) -> Scene:
    """Many boxes at rest, and one bullet."""
    boxes = [
        Body(f"box{i}", _box(5.0 * (i % 20), 5.0 * (i // 20), rng.uniform(1, 3), rng.uniform(1, 3)))
        for i in range(20 * size)
    ]
    bullet = Body("bullet", _box(-9.0, 4.2, 0.2, 0.1), _moving(900.0, rng.uniform(10.0, 60.0)))
    return Scene([*boxes, bullet], (0, 1))


def _clusters(rng: Random, size: int) -> Scene:
    """Two dense clusters that pass each other."""
    bodies = []
    for name, x, y, speed in (("left", -60.0, 0.0, 3.0), ("right", 60.0, 9.0, -3.0)):
        for i in range(6 * size):
            place = (x + 2.5 * (i % 10), y + 2.5 * (i // 10) * (1 if y else -1))
            drift = _moving(speed, rng.uniform(-0.01, 0.01))
            bodies.append(Body(f"{name}{i}", _rock(rng, *place, 1.1, rng.randint(4, 7)), drift))
    return Scene(bodies, (0, 40))


def _rings(rng: Random, size: int) -> Scene:
    """Broken rings around each other that turn, and graze in the end."""
    corners = 4 * size
    rings = []
    for k in range(5):
        inner, outer = 4.0 * k + 3.0, 4.0 * k + 5.0
        angles = [2.0 * math.pi * 0.9 * i / corners for i in range(corners + 1)]
        outline = [(outer * math.cos(a), outer * math.sin(a)) for a in angles]
        outline += [(inner * math.cos(a), inner * math.sin(a)) for a in reversed(angles)]
        drift: list[float] = [0.0, rng.uniform(-0.1, 0.1)]
        rings.append(Body(f"ring{k}", outline, Rigid([0.0, rng.uniform(-0.3, 0.3)], x=drift)))
    return Scene(rings, (0, 20))


def _lanes(rng: Random, size: int) -> Scene:
    """Boxes in lanes, each at one of seven velocities."""
    velocities = [rng.uniform(-2.0, 2.0) for _ in range(7)]
    boxes = []
    for i in range(20 * size):
        lane, place = i % 20, 8.0 * (i // 20)
        speed = velocities[lane % 7]
        corner = (place + rng.uniform(0.0, 3.0), 3.0 * lane)
        boxes.append(Body(f"box{i}", _box(*corner, rng.uniform(2, 4), 2.0), _moving(speed, 0.0)))
    return Scene(boxes, (0, 100))


def _far(rng: Random, size: int) -> Scene:
    """Random doubles at a huge offset."""
    bodies = []
    for i in range(6 * size):
        x, y = 2.0**40 + 5.0 * (i % 10), -(2.0**40) + 5.0 * (i // 10)
        motion: Motion = _moving(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0))
        bodies.append(Body(f"b{i}", _rock(rng, x, y, 1.5, rng.randint(3, 8)), motion))
    return Scene(bodies, (0, 20))


EVERYDAY: Final[dict[str, Family]] = {
    "cars at a junction": _junction,
    "spinning rocks": _belt,
    "a comb into a comb": _combs,
    "rain on a slope": _rain,
    "a worm that curls": _worm,
    "a bullet among boxes": _bullet,
    "two clusters pass": _clusters,
    "rings that turn": _rings,
    "lanes at 7 velocities": _lanes,
    "a huge offset": _far,
}
"""By name; scenes of size 6 have 30 to 180 bodies, or 1 to 5 of many vertices."""
