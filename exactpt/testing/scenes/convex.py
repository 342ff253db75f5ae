"""Convex bodies in all kinds of motion: generic scenes."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from exactpt.geometry.polygon import first_self_touch
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Motion, Pieces, Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import cells, convex_polygon, in_cells, poly, shape, velocity


def convex(rng: Random) -> Scene:
    """Convex polygons in linear motion."""

    def outline(rng: Random, center: Point, radius: int) -> list[Point]:
        return convex_polygon(rng, center, radius, rng.randint(3, 9))

    bodies = in_cells(rng, rng.randint(2, 12), 100, 40, 50, outline)
    return Scene(bodies, (0, rng.choice([1, 2, 5])))


def mixed_shapes(rng: Random) -> Scene:
    """Convex polygons, segments and points in linear motion."""
    bodies = in_cells(rng, rng.randint(1, 12), 100, 40, 50)
    return Scene(bodies, (0, rng.choice([1, 2, 5])))


def ballistic(rng: Random) -> Scene:
    """Shapes that move along parabolas."""
    k = rng.randint(2, 9)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        x = poly(0, rng.randint(-50, 50), QQ(rng.randint(-20, 20), 2))
        y = poly(0, rng.randint(-50, 50), QQ(rng.randint(-20, 20), 2))
        bodies.append(Body(f"b{i}", shape(rng, c, 40), Translation(x, y)))
    return Scene(bodies, (0, rng.choice([1, 2, 4])))


def turning(rng: Random) -> Scene:
    """Shapes that turn while they move."""
    k = rng.randint(2, 7)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        outline = shape(rng, c, 30)
        if rng.random() < 0.7:
            pivot = (c[0] + rng.randint(-5, 5), c[1] + rng.randint(-5, 5))
            half_turn = poly(rng.randint(-1, 1), QQ(rng.randint(-4, 4), 4))
            move = velocity(rng, 20)
            motion: Motion = Rigid(half_turn, pivot=pivot, x=move.x, y=move.y)
        else:
            motion = velocity(rng, 20)
        bodies.append(Body(f"b{i}", outline, motion))
    return Scene(bodies, (0, rng.choice([1, 2])))


def deforming(rng: Random) -> Scene:
    """Convex shapes under affine maps with positive determinant, or scaled and sheared."""
    k = rng.randint(2, 7)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        outline = shape(rng, c, 25)
        a = QQ(rng.randint(-2, 2), 4)
        b = QQ(rng.randint(-2, 2), 8)
        move = velocity(rng, 20)
        # The matrix [[1 + a t / 2, b t], [-b t, 1 + a t / 2]] has positive determinant.
        p = poly(1, a / 2) if a >= 0 else poly(1, 0, a * a / 8)
        matrix = [[p, poly(0, b)], [poly(0, -b), p]]
        centered = [(v[0] - c[0], v[1] - c[1]) for v in outline]
        x, y = poly(c[0]) + move.x, poly(c[1]) + move.y
        bodies.append(Body(f"b{i}", centered, Affine(matrix, x=x, y=y)))
    return Scene(bodies, (0, rng.choice([1, 2, 3])))


def pieces(rng: Random) -> Scene:
    """Shapes that change velocity at rational times, some of them simultaneously."""
    k = rng.randint(2, 9)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        bodies.append(Body(f"b{i}", shape(rng, c, 40), _zigzag(rng)))
    return Scene(bodies, (0, 4))


def keyframed(rng: Random) -> Scene:
    """Triangles, segments and points between keyframes."""
    k = rng.randint(2, 6)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        size = rng.choice([1, 2, 3, 3])
        outline = convex_polygon(rng, c, 40, 3)[:size]
        times = sorted(rng.sample(range(-1, 5), rng.randint(1, 3)))
        body = _shaken(rng, f"b{i}", outline, times)
        while first_self_touch(body.exact_at(QQ(0)), closed=True) is not None:
            body = _shaken(rng, f"b{i}", outline, times)
        bodies.append(body)
    return Scene(bodies, (0, 4))


def _shaken(rng: Random, name: str, outline: Sequence[Point], times: Sequence[int]) -> Body:
    """A body with a keyframe at each time, its vertices randomly near an outline."""
    frames = [
        (t, [(x + rng.randint(-9, 9), y + rng.randint(-9, 9)) for x, y in outline]) for t in times
    ]
    return Body(name, keyframes=frames)


def _zigzag(rng: Random) -> Motion:
    ends = sorted(rng.sample([QQ(n, 2) for n in range(1, 8)], rng.randint(1, 3)))
    x = y = t = QQ(0)
    parts: list[tuple[QQ | None, Translation]] = []
    for end in (*ends, None):
        vx, vy = rng.randint(-40, 40), rng.randint(-40, 40)
        parts.append((end, Translation([x - vx * t, vx], [y - vy * t, vy])))
        if end is not None:
            x, y, t = x + vx * (end - t), y + vy * (end - t), end
    return Pieces(parts)
