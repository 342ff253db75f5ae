"""Scenes close to degeneracy with a known first contact.

All coordinates are doubles, except those of the rational grids and the largest offsets; so
other programs are given the same scene as exactpt.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt import AlgebraicNumber, Body, Scene, Translation
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.testing import reference
from exactpt.testing.scenes.shapes import cells, convex_polygon

__all__ = ["FAMILIES", "Planted", "PlantedFamily"]

END: Final = 2
TINY: Final = power_of_two(-40)
"""About 10^-12."""
LEAST: Final = power_of_two(-47)
"""About 10^-14."""
BITS: Final = 36
"""Coordinates of polygons are multiples of 2^-36, derived coordinates of 2^-47."""


class Planted(NamedTuple):
    """A scene and the time of its first contact; None if there is none."""

    scene: Scene
    truth: AlgebraicNumber | None


PlantedFamily: TypeAlias = Callable[[Random], Planted]


def corner_pass(gap: QQ, rng: Random) -> Planted:
    """Two convex bodies pass; transversally to their motion one vertex of each is extreme.

    With gap 0 these vertices touch at one time; with a negative gap the bodies overlap slightly.
    """
    while True:
        va, vb = _velocity(rng, 8), _velocity(rng, 8)
        p, q = vb[0] - va[0], vb[1] - va[1]
        if p == 0 == q:
            continue
        normal = (-q, p)
        a, b = _polygon(rng, BITS), _polygon(rng, BITS)
        top, bottom = _extreme(a, normal, 1), _extreme(b, normal, -1)
        if top is not None and bottom is not None:
            break
    shift = _across(normal, gap)
    b = [(x + top[0] - bottom[0] + shift[0], y + top[1] - bottom[1] + shift[1]) for x, y in b]
    time = QQ(rng.randint(128, 384), 256)
    bodies = [Body("a", a, _through(va, time)), Body("b", b, _through(vb, time))]
    return _planted(Scene(bodies, (0, END)), gap, time)


def tangential_touch(gap: QQ, rng: Random) -> Planted:
    """A vertex moves on a parabola to an edge, touches its midpoint, and leaves again."""
    while True:
        a, b = _polygon(rng, BITS), _polygon(rng, BITS)
        i = rng.randrange(len(a))
        u, v = a[i - 1], a[i]
        normal = (v[1] - u[1], u[0] - v[0])  # outward: the vertices of a are counter-clockwise
        bottom = _extreme(b, normal, -1)
        if bottom is not None:
            break
    shift = _across(normal, gap)
    middle = ((u[0] + v[0]) / 2, (u[1] + v[1]) / 2)
    b = [(x + middle[0] - bottom[0] + shift[0], y + middle[1] - bottom[1] + shift[1]) for x, y in b]
    time = QQ(rng.randint(4, 12), 8)
    va, along = _velocity(rng, 4), QQ(rng.randint(-8, 8), 16)
    bend = QQ(rng.randint(1, 8), 16)
    vb = (va[0] - along * normal[1], va[1] + along * normal[0])
    # Position relative to that at the time: velocity * (t - time) + bend * normal * (t - time)^2.
    paths = [
        [c * bend * time * time - w * time, w - 2 * c * bend * time, c * bend]
        for c, w in zip(normal, vb, strict=True)
    ]
    bodies = [Body("a", a, _through(va, time)), Body("b", b, Translation(*paths))]
    return _planted(Scene(bodies, (0, END)), gap, time)


def grid(scale: QQ, rng: Random) -> Planted:
    """Small polygons on a grid with tiny velocities: everything coincides."""
    while True:
        k = rng.randint(2, 8)
        bodies = []
        for i, (x, y) in enumerate(cells(rng, k, 4)):
            outline = convex_polygon(rng, (x, y), 1, rng.randint(3, 5))
            speed = [rng.randint(-1, 1) * scale for _ in range(2)]
            scaled = [(u * scale, v * scale) for u, v in outline]
            bodies.append(Body(f"b{i}", scaled, Translation([0, speed[0]], [0, speed[1]])))
        planted = _searched(Scene(bodies, (0, 3)))
        if planted.truth is None or planted.truth.compare_rational(QQ(0)) > 0:
            return planted


def rational_grid(rng: Random) -> Planted:
    """As `grid`, scaled by a third, a seventh, and so on."""
    return grid(QQ(1, rng.choice([3, 7, 11, 49])), rng)


def far_away(rng: Random) -> Planted:
    """Two bodies that meet, 2^30 to 2^50 away from the origin."""
    x = y = power_of_two(rng.randint(30, 50))
    a, b = _polygon(rng, 6), _polygon(rng, 6)
    speed = QQ(rng.randint(12, 20))
    drift = QQ(rng.randint(-4, 4))
    at = [(x + u, y + v) for u, v in a]
    off = [(x + 14 + u, y + v) for u, v in b]
    bodies = [Body("a", at), Body("b", off, Translation([0, -speed], [0, drift]))]
    return _searched(Scene(bodies, (0, END)))


def _polygon(rng: Random, bits: int) -> list[Point]:
    """A convex polygon within distance 6 of the origin, in multiples of 2^-bits."""
    outline = convex_polygon(rng, (QQ(0), QQ(0)), 6 << bits, rng.randint(3, 7))
    unit = power_of_two(-bits)
    return [(x * unit, y * unit) for x, y in outline]


def _velocity(rng: Random, most: int) -> tuple[QQ, QQ]:
    """A velocity in multiples of 1/256."""
    x, y = (QQ(rng.randint(-256 * most, 256 * most), 256) for _ in range(2))
    return x, y


def _through(velocity: tuple[QQ, QQ], time: QQ) -> Translation:
    """The linear motion with a velocity whose displacement is 0 at a time."""
    x, y = velocity
    return Translation([-x * time, x], [-y * time, y])


def _extreme(points: list[Point], normal: Point, sign: int) -> Point | None:
    """The vertex that is extreme in a direction, if it is unique."""
    heights = [sign * (normal[0] * x + normal[1] * y) for x, y in points]
    best = max(heights)
    return points[heights.index(best)] if heights.count(best) == 1 else None


def _across(normal: Point, gap: QQ) -> Point:
    """The shift by a gap along the coordinate axis nearest to a normal."""
    x, y = normal
    if abs(x) >= abs(y):
        return (gap if x > 0 else -gap, QQ(0))
    return (QQ(0), gap if y > 0 else -gap)


def _planted(scene: Scene, gap: QQ, time: QQ) -> Planted:
    if gap < 0:
        return _searched(scene)
    return Planted(scene, AlgebraicNumber(time) if gap == 0 else None)


def _searched(scene: Scene) -> Planted:
    contact = reference.first_contact(scene)
    return Planted(scene, None if contact is None else contact.time)


FAMILIES: Final[dict[str, PlantedFamily]] = {
    "exact graze": partial(corner_pass, QQ(0)),
    "graze, gap 2^-40": partial(corner_pass, TINY),
    "graze, overlap 2^-40": partial(corner_pass, -TINY),
    "tangential touch": partial(tangential_touch, QQ(0)),
    "tangential, gap 2^-47": partial(tangential_touch, LEAST),
    "tangential, crossing 2^-47": partial(tangential_touch, -LEAST),
    "integer grid": partial(grid, QQ(1)),
    "rational grid": rational_grid,
    "offset 2^30 to 2^50": far_away,
}
"""By name, functions from a random generator to a scene and its first contact."""
