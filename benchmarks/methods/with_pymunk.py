"""pymunk (Chipmunk) in time steps: bodies with velocities, until a collision begins.

Chipmunk requires convex shapes: other polygons are triangulated by Shapely (its own
decomposition covers more than the polygon where vertices are collinear). Velocities that change
are set before every step, so that each step ends at the exact position of the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.moving import Floats, Moving, Shape
from benchmarks.peers import is_installed
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    import pymunk

__all__ = ["with_pymunk"]

Vertex: TypeAlias = tuple[float, float]

KIND: Final = 1
"""The collision type of all shapes."""


def with_pymunk(steps: int) -> Method:
    """Chipmunk with a number of steps."""

    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        if any(shape.deforms for shape in moving.shapes):
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

    points = [(float(x), float(y)) for x, y in outline]
    if shape.size == 1:
        return [pymunk.Circle(body, 0.0, points[0])]
    if not shape.closed:
        return [pymunk.Segment(body, p, q, 0.0) for p, q in pairwise(points)]
    if _is_convex(points):
        return [pymunk.Poly(body, points)]
    return [pymunk.Poly(body, triangle) for triangle in _triangles(points)]


def _triangles(points: Sequence[Vertex]) -> list[list[Vertex]]:
    if not is_installed("shapely"):
        raise UnsuitableScene("bodies that are not convex, without Shapely to cut them")
    import shapely

    cut = shapely.constrained_delaunay_triangles(shapely.Polygon(points))
    return [list(triangle.exterior.coords)[:3] for triangle in cut.geoms]


def _turn(p: Vertex, q: Vertex, r: Vertex) -> float:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _is_convex(points: Sequence[Vertex]) -> bool:
    n = len(points)
    turns = [_turn(points[i - 2], points[i - 1], points[i]) for i in range(n)]
    return min(turns) >= 0.0 or max(turns) <= 0.0


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
