"""Other programs on whole scenes: `benchmarks.programs` with a scene in doubles.

Some take time steps; velocities that change are set before every step of pymunk, so that each
step ends at the exact position of the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, Final, TypeAlias

import numpy as np

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.moving import Floats, Moving, Shape
from benchmarks.peers import is_installed
from benchmarks.programs import with_box2d, with_fcl, with_ipctk, with_pymunk, with_shapely
from exactpt.scene.scene import Scene

__all__ = ["BOX2D", "FCL", "additive", "pymunk", "shapely", "tight_inclusion"]

Vertex: TypeAlias = tuple[float, float]

ITERATIONS: Final = 1_000_000
"""The limit of iterations of ipctk."""
MOST: Final = 16
"""Maximum number of vertices of a polygon of Box2D."""


def _asked(moving: Moving, shape: Shape) -> dict[str, Any]:
    """A body that translates, at the start of the time span; see `benchmarks.engines.domain`."""
    linear = moving.degree > 0
    return {
        "vertices": moving.at(moving.start, shape.range).tolist(),
        "closed": shape.closed,
        "x": [0.0, float(moving.x[shape.first, 1]) if linear else 0.0],
        "y": [0.0, float(moving.y[shape.first, 1]) if linear else 0.0],
    }


def _box2d(scene: Scene) -> Callable[[], Answer]:
    moving = Moving(scene)
    for shape in moving.shapes:
        if shape.deforms or not shape.closed or shape.size > MOST:
            raise UnsuitableScene("other bodies than small polygons that translate")
    if len(moving.shapes) != 2 or moving.degree > 1:
        raise UnsuitableScene("more than two bodies in linear motion")
    a, b = (_asked(moving, shape) for shape in moving.shapes)
    span = moving.end - moving.start
    find = with_box2d.impact_of({"a": a, "b": b, "span": span})

    def answer() -> float | None:
        time = with_box2d.time_of(*find(), span)
        return None if time is None else moving.start + time

    return answer


BOX2D: Final = Method("Box2D", "time of impact", _box2d, "box2d")
"""Convex polygons alone (of others Box2D takes the convex hull), in single precision.

It stops at a distance of about its slop, 1/200.
"""


def _fcl(scene: Scene) -> Callable[[], Answer]:
    moving = Moving(scene)
    bodies = [_asked(moving, shape) for shape in moving.shapes]
    if moving.degree > 1:
        raise UnsuitableScene("other motions than linear ones")
    for shape, body in zip(moving.shapes, bodies, strict=True):
        if shape.deforms or not shape.closed or not _is_convex(body["vertices"]):
            raise UnsuitableScene("other bodies than convex polygons that translate")
    firsts, span = [shape.first for shape in moving.shapes], moving.end - moving.start
    ends = np.stack([moving.at(moving.start), moving.at(moving.end)])
    low = np.minimum.reduceat(ends.min(axis=0), firsts)
    high = np.maximum.reduceat(ends.max(axis=0), firsts)

    def ask() -> Answer:
        near = (low[:, None] <= high[None]).all(axis=2)
        times = [
            with_fcl.answer({"a": bodies[i], "b": bodies[j], "span": span}, _CONSERVATIVE)
            for i, j in np.argwhere(np.triu(near & near.T, 1)).tolist()
        ]
        found = [time for time in times if time is not None]
        return moving.start + min(found) if found else None

    return ask


_CONSERVATIVE: Final = "conservative advancement"
FCL: Final = Method("fcl", _CONSERVATIVE, _fcl, "python-fcl")
"""Pairs whose boxes over the whole time intersect, one by one, as prisms; objects are made within.

Its default tolerance of the time, 1e-4, is taken as a share of the time span.
"""


def tight_inclusion(tolerance: float, pieces: int) -> Method:
    """Tight-Inclusion of ipctk, which stops within a tolerance of the contact."""
    options = {"tolerance": tolerance, "conservative_rescaling": 1.0 - tolerance}
    return _ipctk("tight inclusion", f"tolerance {tolerance:g}", options, pieces)


def additive(rescaling: float, pieces: int) -> Method:
    """Additive CCD of ipctk, which covers a given share of the distance to the contact."""
    return _ipctk(
        "additive", f"rescaling {rescaling:g}", {"conservative_rescaling": rescaling}, pieces
    )


def _ipctk(way: str, setting: str, options: dict[str, float], pieces: int) -> Method:
    """A method of ipctk in linear pieces of the motion; rigid bodies do not meet themselves."""

    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        deforms = np.array([shape.deforms for shape in moving.shapes])[moving.body]
        own = len(moving.shapes) + np.arange(len(moving.body), dtype=np.int32)
        patches = np.where(deforms, own, moving.body).astype(np.int32)
        length = (moving.end - moving.start) / pieces

        def places(i: int) -> Floats:
            return np.asfortranarray(moving.at(moving.start + length * i))

        mesh = with_ipctk.mesh_of(places(0), np.asfortranarray(moving.edges), patches)

        def ask() -> Answer:
            method = with_ipctk.method_of(way, max_iterations=ITERATIONS, **options)
            step = with_ipctk.first_step(mesh, places, method, pieces)
            return None if step is None else moving.start + length * step

        return ask

    return Method(f"ipctk, {way}", f"{setting}, {pieces} pieces", prepare, "ipctk")


def pymunk(steps: int) -> Method:
    """Chipmunk with a number of steps: bodies with velocities, until a collision begins."""

    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        if any(shape.deforms for shape in moving.shapes):
            raise UnsuitableScene("bodies that deform")
        bodies = [_asked(moving, shape) for shape in moving.shapes]
        space, moved = with_pymunk.space_of([{**b, "parts": _parts(b)} for b in bodies])
        space.iterations = 1
        span = moving.end - moving.start
        steer = _steering(moving, moved, steps) if moving.degree > 1 else lambda _: None

        def ask() -> Answer:
            step = with_pymunk.first_step(space, span / steps, steps, steer)
            return None if step is None else moving.start + span * step / steps

        return ask

    return Method("pymunk", f"{steps} steps", prepare, "pymunk")


def _steering(moving: Moving, bodies: Sequence[Any], steps: int) -> Callable[[int], None]:
    """The function that sets places and velocities before a step."""
    firsts = [shape.first for shape in moving.shapes]
    span, rest = moving.end - moving.start, moving.at(moving.start, firsts)
    middles = np.array([tuple(body.position) for body in bodies]) - rest
    dt = span / steps

    def steer(step: int) -> None:
        here = moving.at(moving.start + span * (step - 1) / steps, firsts)
        there = moving.at(moving.start + span * step / steps, firsts)
        for body, place, velocity in zip(
            bodies, (here + middles).tolist(), ((there - here) / dt).tolist(), strict=True
        ):
            body.position, body.velocity = tuple(place), tuple(velocity)

    return steer


def _parts(body: dict[str, Any]) -> list[list[Vertex]]:
    """The convex parts of a body: other polygons than convex ones are cut by Shapely.

    (Chipmunk's own decomposition covers more than the polygon where vertices are collinear.)
    """
    points = [(x, y) for x, y in body["vertices"]]
    if len(points) == 1:
        return [points]
    if not body["closed"]:
        return [[p, q] for p, q in pairwise(points)]
    if _is_convex(points):
        return [points]
    if not is_installed("shapely"):
        raise UnsuitableScene("bodies that are not convex, without Shapely to cut them")
    return with_shapely.triangles(points)


def _turn(p: Vertex, q: Vertex, r: Vertex) -> float:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def _is_convex(points: Sequence[Vertex]) -> bool:
    turns = [_turn(points[i - 2], points[i - 1], points[i]) for i in range(len(points))]
    return min(turns) >= 0.0 or max(turns) <= 0.0


def shapely(steps: int, *, bisect: bool) -> Method:
    """Shapely with a number of steps; the first one with a contact is bisected on demand.

    It is bisected down to the resolution of doubles, for the bodies involved alone.
    """

    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        start, end = moving.start, moving.end

        def touching(some: Sequence[int], t: float) -> list[int]:
            shapes = [moving.shapes[i] for i in some]
            at = moving.at(t) if len(some) == len(moving.shapes) else None
            outlines = [moving.at(t, s.range) if at is None else at[s.range] for s in shapes]
            kinds = [s.closed for s in shapes], [s.deforms for s in shapes]
            return [some[k] for k in with_shapely.touching(outlines, *kinds)]

        def ask() -> Answer:
            before = start
            for i in range(1, steps + 1):
                now = start + (end - start) * i / steps
                found = touching(range(len(moving.shapes)), now)
                if found and bisect:
                    return with_shapely.halved(before, now, partial(touching, found))
                if found:
                    return now
                before = now
            return None

        return ask

    name = "shapely, bisection" if bisect else "shapely"
    return Method(name, f"{steps} steps", prepare, "shapely")
