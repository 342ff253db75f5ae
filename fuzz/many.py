"""Scenes of many bodies, of the kinds in which tilings have most to do.

Crowds in linear motion, in which nearly all events are alone at their time. Small bodies far
apart, whose tiles are long and bent. Shapes on a lattice, of which many have a common tangent.
Outlines of many vertices, which are searched instead of walked along. Chains of the tiling of
points that are long enough to be searched. Crowds with the coordinates of doubles, whose tilings
begin in arrays.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import cos, pi, sin
from random import Random
from typing import Final, TypeAlias

from exactpt import Body, Pieces, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["KINDS", "long_arc"]

Outline: TypeAlias = list[tuple[Fraction, Fraction]]

SHAPES: Final = (
    [(0, 0), (2, 0), (0, 1)],
    [(0, 0), (2, 0), (2, 2), (0, 2)],
    [(0, 0), (1, -1), (2, 0), (1, 1)],
    [(0, 0), (3, 1), (1, 2)],
)
"""Shapes of which many sides are parallel."""

MOST_BODIES: Final = 30


def crowd(random: Random) -> Scene:
    """Convex bodies in cells of width 20, in linear motion."""
    count = random.choice([3, 8, 8, MOST_BODIES])
    end = random.choice([1, 4])
    bodies = [
        Body(f"b{i}", _around(random, center, 6, random.randint(3, 7)), _velocity(random, 12))
        for i, center in enumerate(_cells(random, count, 20))
    ]
    return Scene(bodies, (0, end))


def scattered(random: Random) -> Scene:
    """Small convex bodies in far too large a square, so that tiles are long and bent."""
    bodies = [
        Body(f"b{i}", _around(random, center, 5, random.randint(3, 6)), _velocity(random, 40))
        for i, center in enumerate(_cells(random, random.randint(4, 12), 40, room=8))
    ]
    return Scene(bodies, (0, 1))


def lattice(random: Random) -> Scene:
    """Bodies of few shapes on a lattice: many bitangents are parallel, or on one line."""
    side, spacing = random.randint(2, 4), random.choice([4, 7])
    loose = random.random() < 0.5 and spacing == 7
    bodies = []
    for i in range(side):
        for j in range(side):
            x, y = Fraction(spacing * i), Fraction(spacing * j)
            if loose:
                x, y = x + random.randint(0, 2), y + random.randint(0, 2)
            outline = [(x + u, y + v) for u, v in random.choice(SHAPES)]
            bodies.append(Body(f"{i} {j}", outline, _lattice_motion(random)))
    return Scene(bodies, (0, 2))


def _lattice_motion(random: Random) -> Translation:
    """Return a motion along an axis, or none."""
    speed = Fraction(random.choice([0, 0, 0, 2, -2, 1]), 2)
    return random.choice([Translation([0, speed]), Translation([0], [0, speed])])


def round_bodies(random: Random) -> Scene:
    """Outlines of up to 97 vertices, with ties of x, of slopes, flat vertices; and a small body."""
    shapes = [
        _round(random, random.choice([3, 13, 40, 97]), (0, 0), 4),
        _with_stops(random.choice([1, 4, 9]), 12, random.randint(-6, 6), 5),
        _symmetric(64, (3, 14), 5),
        _small(random, (12, 14)),
    ]
    bodies = []
    for i, shape in enumerate(shapes):
        drift = Translation([0, random.randint(-2, 2)], [0, random.randint(-2, 2)])
        turn = Rigid([0, Fraction(1, 8)], pivot=(5, 5))
        motions: list[Motion] = [Translation(), turn, drift]
        bodies.append(Body(f"b{i}", shape[:: random.choice([1, -1])], random.choice(motions)))
    return Scene(bodies, (0, 1))


def arc_of_points(random: Random) -> Scene:
    """Two points change places time and again beside an arc, whose chain is walked along."""
    return _beside_arc(random.choice([10, 40]), 8)


def long_arc(random: Random) -> Scene:
    """An arc so long, and so many changes of places, that its chain comes to be searched."""
    return _beside_arc(random.choice([160, 200]), 160)


def _beside_arc(size: int, swaps: int) -> Scene:
    """Return an arc of points, and two points beside it that change places at each half."""
    arc = [Body(f"a{y}", [(-y * y, 2 * y)]) for y in range(-size + 1, size, 2)]
    middle = size * size
    pair = []
    for name, side, y in (("p", 1, 3 * size), ("q", -1, -3 * size)):
        pieces: list[tuple[int | None, Translation]] = []
        for k in range(swaps):
            here = side * (-1) ** k
            pieces.append((k + 1, Translation([middle + here * (2 * k + 1), -2 * here], [y])))
        last = side * (-1) ** swaps
        pieces.append((None, Translation([middle + last], [y])))
        pair.append(Body(name, [(0, 0)], Pieces(pieces)))
    return Scene([*arc, *pair], (0, swaps))


def doubles(random: Random) -> Scene:
    """Triangles of doubles of either orientation, with an upright side, some of them at rest.

    Sometimes one is in free fall, so that not all of them are in linear motion. Sometimes there are
    so many that the mesh is made in numpy, in a short time span.
    """
    side = random.choice([5, 5, 5, 10])
    unit = 2.0 ** random.choice([0, 0, -40, 40, 90, 1000])
    fall = random.choice([[], [], [-0.25]])
    bodies = []
    for i in range(side * side):
        x, y = (40.0 * k + random.uniform(-9, 9) for k in divmod(i, side))
        corners = [(x, y), (x + random.uniform(1, 5), y), (x, y + 3.5)]
        if random.random() < 0.5:
            corners.reverse()
        speed = [0.0, random.choice([0.0, 0.25, 3 + 2.0**-30, random.uniform(-9, 9)])]
        rise = [0.0, random.choice([0.0, -0.5, random.uniform(-9, 9)]), *(fall if i == 0 else [])]
        motion = Translation([c * unit for c in speed], [c * unit for c in rise])
        bodies.append(Body(f"b{i}", [(a * unit, b * unit) for a, b in corners], motion))
    start = random.choice([Fraction(0), Fraction(1, 3)])
    span = random.choice([1, 4]) if side == 5 else Fraction(1, 16)
    return Scene(bodies, (start, start + span))


KINDS: Final[tuple[Callable[[Random], Scene], ...]] = (
    crowd,
    scattered,
    lattice,
    round_bodies,
    arc_of_points,
    doubles,
)
"""The kinds of scenes, apart from `long_arc`, which is for the tiling of points alone."""


# Places, outlines, motions


def _cells(
    random: Random, count: int, spacing: int, *, room: int | None = None
) -> list[tuple[Fraction, Fraction]]:
    """Return the centers of distinct cells of a square grid with ``room`` cells in a row."""
    width = room or int((1.5 * count) ** 0.5) + 2
    chosen = random.sample(range(width * width), count)
    return [(Fraction(spacing * (c % width)), Fraction(spacing * (c // width))) for c in chosen]


def _velocity(random: Random, speed: int) -> Translation:
    return Translation([0, random.randint(-speed, speed)], [0, random.randint(-speed, speed)])


def _around(random: Random, center: tuple[Fraction, Fraction], radius: int, size: int) -> Outline:
    """Return a convex polygon of vertices on an ellipse, rounded to sixteenths."""
    first, squeeze = random.random(), random.choice([1.0, 0.4])
    corners = []
    for k in range(size):
        angle = 2 * pi * (k + first) / size
        x = Fraction(round(16 * radius * cos(angle)), 16)
        y = Fraction(round(16 * radius * squeeze * sin(angle)), 16)
        corners.append((center[0] + x, center[1] + y))
    return corners


def _round(random: Random, size: int, center: tuple[int, int], radius: int) -> Outline:
    """Return a polygon of vertices on an ellipse, as doubles."""
    turn, squeeze = random.random(), random.choice([1.0, 0.1])
    angles = [2 * pi * (k + turn) / size for k in range(size)]
    return [
        (Fraction(center[0] + radius * cos(a)), Fraction(center[1] + squeeze * radius * sin(a)))
        for a in angles
    ]


def _small(random: Random, place: tuple[int, int]) -> Outline:
    """Return a point, a segment or a triangle."""
    x, y = Fraction(place[0]), Fraction(place[1] + random.randint(0, 3))
    return [(x, y), (x + 2, y + 1), (x, y + 2)][: random.randint(1, 3)]


def _symmetric(size: int, center: tuple[int, int], radius: int) -> Outline:
    """Return a polygon whose vertices have equal x in pairs, and equal slopes in pairs."""
    quarter = [
        (Fraction(radius * cos(a)), Fraction(radius * sin(a)))
        for a in (2 * pi * (k + 0.5) / size for k in range(size // 4))
    ]
    half = [*quarter, *((-x, y) for x, y in reversed(quarter))]
    whole = [*half, *((x, -y) for x, y in reversed(half))]
    return [(center[0] + x, center[1] + y) for x, y in whole]


def _with_stops(stops: int, x: int, y: int, size: int) -> Outline:
    """Return a square whose sides have vertices inside, which are flat."""
    along = [Fraction(size * k, stops) for k in range(stops)]
    return [
        *((x + s, Fraction(y)) for s in along),
        *((Fraction(x + size), y + s) for s in along),
        *((x + size - s, Fraction(y + size)) for s in along),
        *((Fraction(x), y + size - s) for s in along),
    ]
