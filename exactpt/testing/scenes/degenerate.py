"""Highly degenerate scenes: grids, rows, mirror images, grazing passes."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import box, cells, in_cells, poly, shape, velocity


def small_grid(rng: Random) -> Scene:
    """Shapes with tiny integer coordinates and velocities: degeneracies everywhere."""
    bodies = in_cells(rng, rng.randint(2, 8), 3, 1, 1)
    return Scene(bodies, (0, rng.choice([1, 3, 6])))


def grids_passing(rng: Random) -> Scene:
    """Two grids of equal boxes, one passing through the gaps of the other."""
    n = rng.randint(2, 4)
    pitch = rng.choice([5, 6])
    offset = rng.choice([QQ(2), QQ(3), QQ(5, 2)])
    velocity = rng.choice([Translation([0, 1]), Translation([0, -1]), Translation([0], [0, 1])])
    return grids(n, pitch, offset, velocity)


def grids(n: int, pitch: int, offset: QQ, velocity: Translation) -> Scene:
    """A grid of n x n boxes of width 2, and one of width 1 that starts next to it.

    The offset, across the velocity, is in (2, pitch - 1) if the boxes pass through gaps.
    """
    still = [Body(f"s{i}.{j}", box(pitch * i, pitch * j)) for i in range(n) for j in range(n)]
    far = QQ(-pitch * n)
    dx, dy = (far, offset) if velocity.x.degree == 1 else (offset, far)
    moving = [
        Body(f"m{i}.{j}", box(dx + pitch * i, dy + pitch * j, 1, 1), velocity)
        for i in range(n)
        for j in range(n)
    ]
    return Scene([*still, *moving], (0, 2 * pitch * n))


def row(rng: Random) -> Scene:
    """Equal boxes (some flat, some points) sliding along one line, meeting end to end."""
    k = rng.randint(2, 7)
    horizontal = rng.random() < 0.5
    bodies = []
    at = 0
    for i in range(k):
        width, height = rng.randint(0, 3), rng.choice([0, 2, 2, 2])
        outline: list[Point] = [(QQ(at + x), y) for x, y in box(0, 0, width, height)]
        outline = list(dict.fromkeys(outline))
        if rng.random() < 0.3:
            outline = [(x, -y) for x, y in reversed(outline)]
        if not horizontal:
            outline = [(y, x) for x, y in reversed(outline)]
        speed = rng.randint(-2, 2)
        motion = Translation([0, speed]) if horizontal else Translation([0], [0, speed])
        bodies.append(Body(f"b{i}", outline, motion))
        at += width + rng.randint(1, 4)
    return Scene(bodies, (0, rng.choice([1, 4])))


def convoy(rng: Random) -> Scene:
    """Bodies with a common velocity, except perhaps one."""
    k = rng.randint(3, 10)
    common = velocity(rng, 20)
    bodies = [Body(f"b{i}", shape(rng, c, 40), common) for i, c in enumerate(cells(rng, k, 100))]
    if rng.random() < 0.7:
        bodies[0] = Body("b0", bodies[0].vertices, velocity(rng, 50))
    return Scene(bodies, (0, 3))


def mirrored(rng: Random) -> Scene:
    """A scene and its mirror image: events come in pairs."""
    k = rng.randint(1, 5)
    bodies = []
    for i, (x, y) in enumerate(cells(rng, k, 100)):
        outline = shape(rng, (x + 60, y), 40)
        move = velocity(rng, 30)
        bodies.append(Body(f"r{i}", outline, move))
        image = [(-u, v) for u, v in reversed(outline)]
        bodies.append(Body(f"l{i}", image, Translation(-move.x, move.y)))
    return Scene(bodies, (0, 3))


def polygons_in_step(rng: Random) -> Scene:
    """Equal squares on a grid that turn in step."""
    n = rng.randint(1, 3)
    half_turn = poly(0, rng.choice([QQ(1), QQ(1, 2)]))
    bodies = []
    for i in range(n):
        for j in range(n):
            x, y = QQ(rng.choice([6, 7]) * i), QQ(6 * j)
            outline = [(x + 2, y), (x, y + 2), (x - 2, y), (x, y - 2)]
            turn = half_turn if rng.random() < 0.8 else -half_turn
            bodies.append(Body(f"b{i}.{j}", outline, Rigid(turn, pivot=(x, y))))
    return Scene(bodies, (0, 2))


def grazing(rng: Random) -> Scene:
    """Bodies thrown up at a ceiling, which they graze or miss, some by very little."""
    k = rng.randint(1, 5)
    bodies = [Body("ceiling", [(-10, 10), (10 * k, 10), (10 * k, 12), (-10, 12)])]
    tiny = QQ(1, 10 ** rng.choice([3, 12, 40]))
    for i in range(k):
        # Height 10 - 2 at the apex t = 2, for a body of height 2.
        miss = rng.choice([QQ(0), -tiny, -tiny, QQ(-1)])
        top = rng.choice([1, 2])
        outline = [(10 * i, 0), (10 * i + 4, 0), (10 * i + top, 2)]
        rise = QQ(8) + miss
        y = poly(0, rise, -rise / 4)
        bodies.append(Body(f"b{i}", outline, Translation([0, rng.randint(-1, 1)], y)))
    return Scene(bodies, (0, 4))


def concentric(rng: Random) -> Scene:
    """Concentric rings of equal bodies that turn about the center or grow from it."""
    counts = [rng.choice([2, 2, 4, 8]) for _ in range(rng.randint(1, 2))]
    turns = [rng.choice([QQ(0), QQ(1, 2), QQ(1, 2), QQ(-1), QQ(1, 4)]) for _ in counts]
    reach = rng.choice([2, 3, 4])
    return rings(counts, turns, reach, (0, rng.choice([1, 2])))


def rings(counts: Sequence[int], turns: Sequence[QQ], reach: int, time: tuple[int, int]) -> Scene:
    """Rings of 2, 4 or 8 diamonds around a square, each ring turning in step.

    Args:
        counts: the number of bodies of each ring.
        turns: for each ring, the tangent of half its angle at t = 1.
        reach: half the width of a diamond; the rings are 7 apart.
        time: the time span.
    """
    bodies = [Body("center", [(2, 0), (0, 2), (-2, 0), (0, -2)])]
    for ring, (count, turn) in enumerate(zip(counts, turns, strict=True), start=1):
        for i in range(0, 8, 8 // count):
            # Points at equal distance: (4, 3), (3, 4), ... on a circle of radius 5.
            x, y = (QQ(c * 7 * ring, 5) for c in _COMPASS[i])
            half = QQ(reach)
            diamond = [(x + half, y), (x, y + half), (x - half, y), (x, y - half)]
            bodies.append(Body(f"r{ring}.{i}", diamond, Rigid(poly(0, turn))))
    return Scene(bodies, time)


_COMPASS: Final = ((5, 0), (4, 3), (0, 5), (-3, 4), (-5, 0), (-4, -3), (0, -5), (3, -4))


def sweeping(rng: Random) -> Scene:
    """Bodies that slide along the line of another body's edge, or a little off it."""
    k = rng.randint(1, 4)
    tiny = QQ(1, 10 ** rng.choice([1, 12, 40]))
    bodies = [Body("table", box(0, -3, 6 * k, 3))]
    for i in range(k):
        gap = rng.choice([QQ(0), tiny, tiny, -tiny, QQ(1)])
        size = rng.randint(1, 3)
        left = rng.random() < 0.5
        x = QQ(-6 * (i // 2) - 5) if left else QQ(6 * k + 2 + 6 * (i // 2))
        above = rng.random() < 0.5
        y = gap if above else -3 - gap - size
        speed = QQ(rng.choice([1, 2, 2, 3]))
        outline = box(x, y, size, size)
        if rng.random() < 0.3:
            edge = outline[:2] if above else outline[2:]
            outline = edge[: rng.choice([1, 2])]
        bodies.append(Body(f"b{i}", outline, Translation([0, speed if left else -speed])))
    return Scene(bodies, (0, rng.choice([4, 20])))


def hairs(rng: Random) -> Scene:
    """A comb that comes down on a wall, all teeth at once, with coefficients of any size."""
    teeth = rng.choice([2, 5, 9, 28])
    e = rng.choice([0, 1, -1]) * QQ(1, 10 ** rng.choice([20, 40, 400]))
    gap = rng.choice([0, 0, 1, -1]) * QQ(1, 10 ** rng.choice([1, 40]))
    # Down at t = 1, then up again or through.
    path = rng.choice([[QQ(0), e - 2, 1 - 2 * e, e], [QQ(0), -1 - e, QQ(0), e]])
    drift = rng.choice([poly(0), poly(0, e), poly(0, 1)])
    tips = [p for i in range(teeth) for p in ((2 * i + 1, 1), (2 * i + 2, 5))][:-1]
    comb = [(0, 10), *tips, (2 * teeth, 10)]
    bodies = [
        Body("comb", [(x, y + gap) for x, y in comb], Translation(drift, poly(*path))),
        Body("wall", box(-5, -1, 2 * teeth + 15, 1)),
        Body("stone", box(-20, 3), Translation(poly(0, rng.choice([QQ(1), e, 10 + e])))),
    ]
    return Scene(bodies, (0, rng.choice([1, 3])))
