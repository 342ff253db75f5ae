"""Shapes and motions of which the scene families are made."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random

from exactpt.errors import InputError
from exactpt.geometry.predicates import Point, orientation
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene


def convex_polygon(rng: Random, center: Point, radius: int, size: int) -> list[Point]:
    """A convex polygon of 3 to ``size`` integer vertices around a center, counter-clockwise.

    It is the hull of random integer points in the square of half-width ``radius``.
    """
    while True:
        chain = hull(points_near(rng, center, radius, size))
        if len(chain) > 2:
            return chain


def points_near(rng: Random, center: Point, radius: int, count: int) -> list[Point]:
    """Random integer points, seen from a center, in the square of half-width ``radius``."""
    (x, y), r = center, radius
    return [(x + rng.randint(-r, r), y + rng.randint(-r, r)) for _ in range(count)]


def hull(points: Sequence[Point]) -> list[Point]:
    """The strictly convex hull, by Andrew's monotone chain."""
    ordered = sorted(set(points))
    halves: list[Point] = []
    for sequence in (ordered, ordered[::-1]):
        chain: list[Point] = []
        for p in sequence:
            while len(chain) > 1 and orientation(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        halves += chain[:-1]
    return halves


def cells(rng: Random, count: int, spacing: int) -> list[tuple[QQ, QQ]]:
    """Centers of distinct cells of a square grid, about a third of which stays empty."""
    width = math.ceil(math.sqrt(1.5 * count)) + 1
    chosen = rng.sample(range(width * width), count)
    return [(QQ(spacing * (c % width)), QQ(spacing * (c // width))) for c in chosen]


def poly(*coefficients: QQ | int) -> Polynomial:
    """The polynomial with these coefficients, the constant first."""
    return Polynomial(coefficients)


def velocity(rng: Random, speed: int) -> Translation:
    """A random integer velocity with coordinates up to ``speed``."""
    return Translation([0, rng.randint(-speed, speed)], [0, rng.randint(-speed, speed)])


def shape(rng: Random, center: Point, radius: int) -> list[Point]:
    """A polygon, or sometimes a segment or a point."""
    kind = rng.randrange(8)
    if kind == 0:
        return points_near(rng, center, radius, 1)
    if kind == 1:
        while True:
            a, b = points_near(rng, center, radius, 2)
            if a != b:
                return [a, b]
    return convex_polygon(rng, center, radius, rng.randint(3, 9))


def box(x: QQ | int, y: QQ | int, width: QQ | int = 2, height: QQ | int = 2) -> list[Point]:
    """A box with its lower left corner at (x, y)."""
    a, b = QQ(x), QQ(y)
    return [(a, b), (a + width, b), (a + width, b + height), (a, b + height)]


def is_valid(body: Body) -> bool:
    """Return True if a body is valid at t = 0, as a scene requires."""
    try:
        Scene([body], (0, 1))
    except InputError:
        return False
    return True


def valid_scene(bodies: Sequence[Body], time: tuple[int, int]) -> Scene:
    """The scene of those bodies that are valid."""
    return Scene([body for body in bodies if is_valid(body)], time)


def in_cells(
    rng: Random,
    count: int,
    spacing: int,
    size: int,
    speed: int,
    outline: Callable[[Random, Point, int], list[Point]] = shape,
) -> list[Body]:
    """Bodies in linear motion around the centers of `cells`; by default each any `shape`."""
    return [
        Body(f"b{i}", outline(rng, c, size), velocity(rng, speed))
        for i, c in enumerate(cells(rng, count, spacing))
    ]
