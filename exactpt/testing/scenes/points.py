"""Moving points: generic and highly degenerate families."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion, Pieces, Rigid, SimpleMotion, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import poly, velocity


def _points(positions: list[tuple[QQ | int, QQ | int]], motions: Sequence[Motion]) -> list[Body]:
    return [
        Body(f"p{i}", [p], motion)
        for i, (p, motion) in enumerate(zip(positions, motions, strict=True))
    ]


def _distinct(rng: Random, count: int, size: int) -> list[tuple[QQ | int, QQ | int]]:
    return [divmod(cell, size) for cell in rng.sample(range(size * size), count)]


def linear_points(rng: Random) -> Scene:
    """Random integer positions and velocities."""
    n = rng.randint(1, 14)
    motions: list[SimpleMotion] = [velocity(rng, 1000) for _ in range(n)]
    return Scene(_points(_distinct(rng, n, 1000), motions), (0, 3))


def ballistic_points(rng: Random) -> Scene:
    """Random quadratic motions, each with its own acceleration."""
    n = rng.randint(2, 10)

    def motion() -> SimpleMotion:
        x, y = ([0, rng.randint(-1000, 1000), rng.randint(-300, 300)] for _ in range(2))
        return Translation(Polynomial(x), Polynomial(y))

    return Scene(_points(_distinct(rng, n, 1000), [motion() for _ in range(n)]), (0, 4))


def piecewise_points(rng: Random) -> Scene:
    """Linear motions with one change of velocity, often simultaneous."""
    n = rng.randint(2, 10)
    motions: list[Motion] = []
    for _ in range(n):
        until = QQ(rng.choice([1, 1, rng.randint(1, 7)]), 2)
        a, b, c, d = (rng.randint(-500, 500) for _ in range(4))
        motions.append(
            Pieces(
                [
                    (until, Translation(poly(0, a), poly(0, b))),
                    (None, Translation(poly((a - c) * until, c), poly((b - d) * until, d))),
                ]
            )
        )
    return Scene(_points(_distinct(rng, n, 1000), motions), (0, 3))


def turning_points(rng: Random) -> Scene:
    """Points on circles, some in step about one pivot, and points that pass by."""
    n = rng.randint(2, 7)
    in_step = Rigid(poly(0, rng.choice([QQ(1), QQ(-1, 2)])), pivot=(QQ(3), QQ(3)))
    motions: list[SimpleMotion] = []
    for _ in range(n):
        own = Rigid(
            poly(0, QQ(rng.choice([-2, -1, 1, 2]), 2)),
            x=[0, rng.randint(-1, 1)],
            pivot=(QQ(rng.randint(0, 6)), QQ(rng.randint(0, 6))),
        )
        choices: list[SimpleMotion] = [in_step, in_step, own, velocity(rng, 2)]
        motions.append(rng.choice(choices))
    return Scene(_points(_distinct(rng, n, 7), motions), (0, 2))


def grid_points(rng: Random) -> Scene:
    """Tiny integer positions and velocities: collinear triples and equal x everywhere."""
    n = rng.randint(2, 10)
    size = rng.randint(3, 6)
    n = min(n, size * size)
    speed = rng.choice([1, 1, 2])
    motions: list[SimpleMotion] = [velocity(rng, speed) for _ in range(n)]
    return Scene(_points(_distinct(rng, n, size), motions), (0, rng.choice([2, 5])))


def point_convoy(rng: Random) -> Scene:
    """Points of a small grid with two or three velocities: many stay collinear."""
    n = rng.randint(3, 14)
    size = rng.randint(4, 6)
    choices: list[SimpleMotion] = [velocity(rng, 2) for _ in range(rng.randint(1, 3))]
    motions = [rng.choice(choices) for _ in range(n)]
    return Scene(_points(_distinct(rng, n, size), motions), (0, 6))


def point_grids_passing(rng: Random) -> Scene:
    """Two grids, one passing through the gaps of the other: whole columns simultaneously."""
    n = rng.randint(2, 4)
    dx, dy = rng.choice([(1, 0), (0, 1), (1, 1), (2, 1)])
    gap = rng.choice([QQ(1, 2), QQ(1, 3), QQ(0)])
    far = n * max(dx, dy)
    bodies = [Body(f"s{i}.{j}", [(i, j)]) for i in range(n) for j in range(n)]
    bodies += [
        Body(
            f"m{i}.{j}",
            [(i - far * dx + gap * dy, j - far * dy + gap)],
            Translation([0, dx], [0, dy]),
        )
        for i in range(n)
        for j in range(n)
    ]
    return Scene(bodies, (0, 3 * n))


def points_in_line(rng: Random) -> Scene:
    """Points on one line that turns or stretches, and a few other points."""
    n = rng.randint(3, 9)
    # Point i is at i * (x(t), y(t)).
    a, b, c, d = (rng.randint(-2, 2) for _ in range(4))
    at = rng.sample(range(-6, 7), n)
    bodies = [
        Body(f"p{i}", [{"x": [k * a + QQ(1, 3), k * b], "y": [k * c, k * d]}])
        for i, k in enumerate(at)
    ]
    bodies += [
        Body(f"q{i}", [(rng.randint(-6, 6), rng.randint(-6, 6))], velocity(rng, 3))
        for i in range(rng.randint(0, 4))
    ]
    return Scene(bodies, (0, 4))


def crossing_lines(rng: Random) -> Scene:
    """Points on two lines that pass through each other, evenly spaced."""
    n = rng.randint(2, 6)
    slope = rng.choice([0, 1, -1, 2])
    gap = rng.choice([QQ(1, 2), QQ(1, 3), QQ(0)])
    bodies = [Body(f"s{i}", [(i, slope * i)]) for i in range(n)]
    motion = rng.choice([velocity(rng, 2), Translation([0], [0, 1]), Translation([0, 1])])
    start = rng.choice([-n, 0, n])
    for i in range(n):
        x = i + gap
        bodies.append(Body(f"m{i}", [(x - start, slope * x - n)], motion))
    return Scene(bodies, (0, 3 * n))


def parabola_points(rng: Random) -> Scene:
    """A parabola of points, open to the left, sweeps over points on a line."""
    n = rng.randint(2, 7)
    bodies = [Body(f"a{i}", [(-i * i, 2 * i)], Translation([0, 1])) for i in range(-n, n + 1)]
    tilt = rng.choice([0, 0, 1])
    shift = rng.choice([QQ(1, 2), QQ(1)])
    for i in range(rng.randint(1, n)):
        y = 2 * i - n + shift
        bodies.append(Body(f"b{i}", [(tilt * y + n, y)], Translation([0, rng.choice([0, 0, -1])])))
    return Scene(bodies, (0, n * n + 2 * n))


def simultaneous_swaps(rng: Random) -> Scene:
    """Points that all have equal x at one time, and are mirror images at another."""
    n = rng.randint(2, 9)
    x = rng.sample(range(-8, 9), n)
    y = rng.sample(range(-8, 9), n)
    slow = rng.choice([0, 0, 1])
    bodies = [
        Body(f"p{i}", [(-2 * a, b)], Translation([0, a], [0, slow * rng.randint(-1, 1)]))
        for i, (a, b) in enumerate(zip(x, y, strict=True))
    ]
    return Scene(bodies, (0, 5))
