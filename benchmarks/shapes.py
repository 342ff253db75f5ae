"""Outlines and scenes of any size: crowds, combs, spirals, clamps."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt import Body, Polynomial, Scene, Translation
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.testing.scenes.shapes import box, cells, convex_polygon, velocity
from exactpt.testing.scenes.simple import star

__all__ = [
    "TANGLES",
    "Tangle",
    "TangleFamily",
    "clamp",
    "combs",
    "crowd",
    "deforming",
    "grazing",
    "spirals",
    "tangle",
    "thin_and_fast",
]


class Tangle(NamedTuple):
    """Two interlocked outlines, and their diameter."""

    first: list[Point]
    second: list[Point]
    diameter: int


def crowd(k: int, rng: Random, *, radius: int, end: int) -> Scene:
    """Convex bodies in cells of width 1,000, in linear motion, sparse or dense by the radius."""
    bodies = [
        Body(f"b{i}", convex_polygon(rng, c, radius, rng.randint(3, 9)), velocity(rng, 1000))
        for i, c in enumerate(cells(rng, k, 1000))
    ]
    return Scene(bodies, (0, end))


def combs(vertices: int) -> Tangle:
    """Two interlocked combs, with teeth of width 2 at distance 8."""
    teeth = max(1, (vertices - 4) // 4)
    lower: list[tuple[int, int]] = [(-2, -2), (8 * teeth, -2), (8 * teeth, 0)]
    for i in reversed(range(teeth)):
        lower += [(8 * i + 2, 0), (8 * i + 2, 9), (8 * i, 9), (8 * i, 0)]
    lower.append((-2, 0))
    upper = [(x + 4, 11 - y) for x, y in reversed(lower)]
    return Tangle(_points(lower), _points(upper), 8 * teeth + 20)


def spirals(vertices: int) -> Tangle:
    """Two rectilinear spirals, with walls of width 1 in corridors of width 3."""
    steps = max(4, vertices // 2 - 1)
    x = y = 0
    center, length = [(0, 0)], 4
    for i in range(steps):
        dx, dy = ((1, 0), (0, 1), (-1, 0), (0, -1))[i % 4]
        x, y = x + dx * length, y + dy * length
        center.append((x, y))
        length += 4 * (i % 2)
    left, right = [], []
    for i, (x, y) in enumerate(center):
        before, after = center[max(0, i - 1)], center[min(len(center) - 1, i + 1)]
        ux, uy = _sign(x - before[0]), _sign(y - before[1])
        vx, vy = _sign(after[0] - x), _sign(after[1] - y)
        nx, ny = -(uy + vy), ux + vx
        left.append((4 * x + 2 * nx, 4 * y + 2 * ny))
        right.append((4 * x - 2 * nx, 4 * y - 2 * ny))
    spiral = right + left[::-1]
    other = [(8 - x, 8 - y) for x, y in spiral]
    return Tangle(_points(spiral), _points(other), 16 * (length + 4))


TangleFamily: TypeAlias = Callable[[int], Tangle]

TANGLES: Final[dict[str, TangleFamily]] = {"combs": combs, "spirals": spirals}
"""By name, functions from the number of vertices of each polygon to two outlines."""


def tangle(given: Tangle, *, shift: int = 0) -> Scene:
    """One of two outlines drifts, along the teeth or the corridor; ``shift`` separates them."""
    moved = [(x + shift, y) for x, y in given.second]
    drift = Translation([0, "1/7"], [0, "1/5"])
    return Scene([Body("a", given.first), Body("b", moved, drift)], (0, 41))


def clamp(n: int, rng: Random) -> Scene:
    """A jaw with n teeth on each side that closes on itself."""
    bottom = [_vertex([200 * i], [rng.randint(0, 90)]) for i in range(n)]
    top = [
        _vertex([200 * i, rng.randint(-20, 20)], [rng.randint(300, 500), rng.randint(-80, -20)])
        for i in range(n)
    ]
    outline = [
        _vertex([-200], [-100]),
        _vertex([200 * n], [-100]),
        *reversed(bottom),
        _vertex([-100], [100]),
        *top,
        _vertex([200 * n], [700, -20]),
        _vertex([-200], [700, -20]),
    ]
    return Scene([Body("jaw", outline)], (0, 8))


def deforming(k: int, rng: Random) -> Scene:
    """Star-shaped bodies of 16 vertices, each vertex in its own linear motion."""
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        outline = [
            _vertex([x, rng.randint(-10, 10)], [y, rng.randint(-10, 10)])
            for x, y in star(rng, c, 48, 16)
        ]
        bodies.append(Body(f"b{i}", outline))
    return Scene(bodies, (0, 4))


def grazing(k: int, rng: Random) -> Scene:
    """Bodies thrown up to a ceiling: one touches it at t = 2, the others miss it by 2^-40."""
    bodies = [Body("ceiling", [(-10, 10), (10 * k, 10), (10 * k, 12), (-10, 12)])]
    touching = rng.randrange(k)
    for i in range(k):
        rise = QQ(8) if i == touching else QQ(8) - power_of_two(-40)
        outline = [(10 * i, 0), (10 * i + 4, 0), (10 * i + rng.choice([1, 2]), 2)]
        bodies.append(Body(f"b{i}", outline, Translation([0, "1/3"], [0, rise, -rise / 4])))
    return Scene(bodies, (0, QQ(37, 10)))


def thin_and_fast(k: int, rng: Random) -> Scene:
    """Small bodies at speed 1,000 in lanes, half of them crossed by a wall of width 1/100."""
    bodies = []
    for i in range(k):
        y = 10 * i
        bullet = box(QQ(-5 - rng.randint(0, 99), 2), y + 4)[:3]
        bodies.append(Body(f"bullet{i}", bullet, Translation([0, 1000])))
        if i % 2 == 0:
            x = QQ(rng.randint(10_000, 90_000), 97)
            wall = [(x, y), (x + QQ(1, 100), y), (x + QQ(1, 100), y + 9), (x, y + 9)]
            bodies.append(Body(f"wall{i}", wall, Translation([0, rng.randint(-9, 9)])))
    return Scene(bodies, (0, 1))


def _vertex(x: list[QQ | int], y: list[QQ | int]) -> tuple[Polynomial, Polynomial]:
    return Polynomial(x), Polynomial(y)


def _points(outline: list[tuple[int, int]]) -> list[Point]:
    return [(QQ(x), QQ(y)) for x, y in outline]


def _sign(d: int) -> int:
    return (d > 0) - (d < 0)
