"""pymunk (Chipmunk) in time steps: bodies with velocities, until a collision begins.

Simple polygons are decomposed into convex ones, as Chipmunk asks for. A velocity that
changes is set before every step, so that each step ends where the motion does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from exactpt.bench.methods.method import Answer, Method, UnsuitableScene
from exactpt.bench.methods.moving import Floats, Moving, Shape
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    import pymunk

__all__ = ["with_pymunk"]

KIND = 1
"""The collision type of everything."""


def with_pymunk(steps: int) -> Method:
    """Chipmunk in so many steps."""

    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        if not all(shape.translates for shape in moving.shapes):
            raise UnsuitableScene("bodies that deform")
        space, bodies = _space(moving)
        return lambda: _first(moving, space, bodies, steps)

    return Method("pymunk", f"{steps} steps", prepare, "pymunk")


def _space(moving: Moving) -> tuple[pymunk.Space, list[pymunk.Body]]:
    import pymunk

    space = pymunk.Space()
    space.iterations = 1
    at = moving.at(moving.start)
    bodies = []
    for shape in moving.shapes:
        body = pymunk.Body(1.0, float("inf"))
        parts = _parts(body, at[shape.range], shape)
        for part in parts:
            part.collision_type = KIND
        space.add(body, *parts)
        bodies.append(body)
    return space, bodies


def _parts(body: pymunk.Body, outline: Floats, shape: Shape) -> Sequence[pymunk.Shape]:
    import pymunk
    from pymunk.autogeometry import convex_decomposition, is_closed

    points = [(float(x), float(y)) for x, y in outline]
    if shape.size == 1:
        return [pymunk.Circle(body, 0.0, points[0])]
    if not shape.closed:
        return [pymunk.Segment(body, p, q, 0.0) for p, q in pairwise(points)]
    if _area(points) < 0.0:
        points.reverse()
    if _is_convex(points):
        return [pymunk.Poly(body, points)]
    ring = [*points, points[0]]
    if not is_closed(ring):
        raise UnsuitableScene("an outline that Chipmunk takes for open")
    return [pymunk.Poly(body, part) for part in convex_decomposition(ring, 0.0)]


def _turn(p: tuple[float, float], q: tuple[float, float], r: tuple[float, float]) -> float:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _area(points: Sequence[tuple[float, float]]) -> float:
    return sum(_turn(points[0], p, q) for p, q in pairwise(points[1:]))


def _is_convex(points: Sequence[tuple[float, float]]) -> bool:
    n = len(points)
    return all(_turn(points[i - 2], points[i - 1], points[i]) >= 0.0 for i in range(n))


def _first(
    moving: Moving, space: pymunk.Space, bodies: Sequence[pymunk.Body], steps: int
) -> float | None:
    hit = False

    def begin(*_: Any) -> None:  # noqa: ANN401 - an arbiter, a space, data
        nonlocal hit
        hit = True

    space.on_collision(KIND, KIND, begin=begin)
    firsts = [shape.first for shape in moving.shapes]
    dt = (moving.end - moving.start) / steps
    rest = moving.at(moving.start, firsts)
    here = rest
    for i in range(1, steps + 1):
        now = moving.start + (moving.end - moving.start) * i / steps
        if i == 1 or moving.degree > 1:
            there = moving.at(now, firsts)
            for body, p, q, r in zip(bodies, rest, here, there, strict=True):
                body.position = (float(q[0] - p[0]), float(q[1] - p[1]))
                body.velocity = (float((r[0] - q[0]) / dt), float((r[1] - q[1]) / dt))
            here = there
        space.step(dt)
        if hit:
            return now
    return None
