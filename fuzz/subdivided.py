"""The same scene with other vertices: each edge is cut in the middle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from exactpt import Body, Polynomial, Scene

__all__ = ["subdivided"]

Position = tuple[Polynomial, Polynomial]


def subdivided(scene: Scene) -> Scene:
    """Return a scene of the same sets of points; bodies given by keyframes are left as they are."""
    return Scene([_cut(body) for body in scene.bodies], (scene.start, scene.end))


def _cut(body: Body) -> Body:
    if body.size == 1 or not body.vertices:
        return body
    rings = [
        [{"vertices": list(_with_middles(body, ring))} for ring in rings] for rings in body.parts
    ]
    parts = [{**outline, "holes": [h["vertices"] for h in holes]} for outline, *holes in rings]
    radius = str(body.radius)
    if body.has_rings:
        return Body(body.name, motion=body.motion, parts=parts, radius=radius)
    (outline,) = rings[0]
    closed = body.has_interior
    return Body(body.name, outline["vertices"], body.motion, closed=closed, radius=radius)


def _with_middles(body: Body, ring: Sequence[int]) -> Iterator[Position]:
    """Return the positions of a ring, or of a chain, and the middle after each of them."""
    places = [body.vertices[v] for v in ring]
    for (x, y), (u, v) in pairwise([*places, places[0]] if body.has_interior else places):
        yield x, y
        yield (x + u) * Fraction(1, 2), (y + v) * Fraction(1, 2)
    if not body.has_interior:
        yield places[-1]
