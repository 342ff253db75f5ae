"""Box2D: the time of impact of two convex polygons, in single precision.

It stops at a distance of about its slop, 1/200.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any, Final

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.moving import Moving
from exactpt.scene.scene import Scene

__all__ = ["BOX2D", "time_of_impact"]

MOST: Final = 16
"""Maximum number of vertices of its polygons."""


def time_of_impact(
    shapes: Sequence[Sequence[Sequence[float]]], steps: Sequence[Sequence[float]]
) -> Callable[[], Any]:
    """What asks for the time of impact of two polygons that translate by ``steps``.

    The question returns a state and the share of the steps.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of SWIG
        import Box2D

    bodies = [Box2D.b2PolygonShape(vertices=[tuple(p) for p in points]) for points in shapes]
    sweeps = [
        Box2D.b2Sweep(
            localCenter=(0.0, 0.0), c0=(0.0, 0.0), c=tuple(step), a0=0.0, a=0.0, alpha0=0.0
        )
        for step in steps
    ]
    given = dict(zip(("shapeA", "shapeB", "sweepA", "sweepB"), (*bodies, *sweeps), strict=True))
    return lambda: Box2D.b2TimeOfImpact(**given, tMax=1.0)


def _prepare(scene: Scene) -> Callable[[], Answer]:
    moving = Moving(scene)
    for shape in moving.shapes:
        if shape.deforms or not shape.closed or shape.size > MOST:
            raise UnsuitableScene("other bodies than small polygons that translate")
    if len(moving.shapes) != 2 or moving.degree > 1:
        raise UnsuitableScene("more than two bodies in linear motion")
    at, later = moving.at(moving.start), moving.at(moving.end)
    firsts = [shape.first for shape in moving.shapes]
    ask = time_of_impact(
        [at[shape.range].tolist() for shape in moving.shapes], (later - at)[firsts].tolist()
    )

    def answer() -> float | None:
        import Box2D

        state, share = ask()
        if state == Box2D.b2TOIOutput.e_separated:
            return None
        time: float = moving.start + share * (moving.end - moving.start)
        return time

    return answer


BOX2D: Final = Method("Box2D", "time of impact", _prepare, "box2d")
"""Convex polygons alone; of others Box2D takes the convex hull."""
