"""Bodies and motions of every kind with tiny integers: degeneracies of every kind."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Motion, Pieces, Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import cells, is_valid, points_near, valid_scene

RADIUS: Final = 2
ATTEMPTS: Final = 20


def bodies_on_grid(rng: Random) -> Scene:
    """Points, segments, chains and polygons with motions of every kind."""
    centers = cells(rng, rng.randint(2, 5), rng.choice([4, 5, 6]))
    bodies = [_body(rng, f"b{i}", center) for i, center in enumerate(centers)]
    return Scene(bodies, (0, rng.choice([1, 2, 4])))


def _body(rng: Random, name: str, center: Point) -> Body:
    size = rng.choice([1, 2, 3, 3, 4, 4, 5, 6])
    closed = rng.random() < 0.6
    for _ in range(ATTEMPTS):
        kind = rng.randrange(5)
        if kind == 0:
            frames = [(t, points_near(rng, center, RADIUS, size)) for t in (0, 1, 2)]
            body = Body(name, keyframes=frames, closed=closed)
        elif kind == 1:
            body = Body(name, _paths(rng, points_near(rng, center, RADIUS, size)), closed=closed)
        else:
            body = Body(
                name, points_near(rng, center, RADIUS, size), _motion(rng, center), closed=closed
            )
        if is_valid(body):
            return body
    return Body(name, [center])


def chains_on_grid(rng: Random) -> Scene:
    """Open chains whose end edges point at each other's vertices; they move, turn, deform."""
    bodies = []
    for i, center in enumerate(cells(rng, rng.randint(2, 4), 4)):
        ring = points_near(rng, center, RADIUS, rng.choice([1, 2, 3, 3, 3, 4, 5]))
        closed = rng.random() < 0.3
        kind = rng.randrange(6)
        if kind < 3:
            body = Body(f"b{i}", _paths(rng, ring), closed=closed)
        elif kind == 3:
            turn = Rigid([0, rng.choice([QQ(1, 2), QQ(1), QQ(-1)])], pivot=rng.choice(ring))
            body = Body(f"b{i}", ring, turn, closed=closed)
        else:
            body = Body(f"b{i}", ring, Translation(_path(rng, 1), _path(rng, 1)), closed=closed)
        bodies.append(body)
    return valid_scene(bodies, (0, rng.choice([1, 2, 4])))


def _paths(rng: Random, ring: list[Point]) -> list[tuple[Polynomial, Polynomial]]:
    return [
        (Polynomial([x, rng.randint(-1, 1)]), Polynomial([y, rng.randint(-1, 1)])) for x, y in ring
    ]


def _path(rng: Random, degree: int) -> Polynomial:
    """A polynomial that is 0 at t = 0, often identically."""
    return Polynomial([0, *rng.choices([QQ(c) for c in (0, 0, 1, -1, 2, "1/2")], k=degree)])


def _motion(rng: Random, pivot: Point) -> Motion:
    kind = rng.randrange(4)
    x = _path(rng, 1)
    if kind == 0:
        return Translation(_path(rng, 2), _path(rng, 2))
    if kind == 1:
        return Rigid(_path(rng, 1), pivot=pivot, x=x)
    if kind == 2:
        shear, stretch = _path(rng, 1), _path(rng, 1)
        return Affine([[1, shear], [0, stretch + Polynomial([1])]], x=x)
    y, back, until = _path(rng, 1), _path(rng, 1), rng.choice([QQ(1, 2), QQ(1), QQ(2)])
    jump = Polynomial([x(until) - back(until)])
    return Pieces([(until, Translation(x, y)), (None, Translation(back + jump, [y(until)]))])
