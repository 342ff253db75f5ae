"""Contacts at the start: decided exactly, before anything is tiled."""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import contains, edges, segments_meet
from exactpt.geometry.predicates import Point, between, side
from exactpt.motion.incidence import Touch
from exactpt.scene.scene import Scene

__all__ = ["initial_touches"]


def initial_touches(scene: Scene) -> tuple[list[Touch], list[tuple[int, int]]]:
    """All incidences at the start, and the pairs of bodies that share a point then.

    The second list is empty if and only if there is no contact at the start. (Within one
    body there is none: a scene whose polygons are not simple at the start is refused.)
    """
    points = [body.at(scene.start) for body in scene.bodies]
    touches: list[Touch] = []
    pairs: list[tuple[int, int]] = []
    for first, second in overlapping_pairs(boxes_of_points(points)):
        for i, j in zip(first.tolist(), second.tolist(), strict=True):
            found = _incidences(scene, i, j, points) + _incidences(scene, j, i, points)
            if found or _overlap(scene, i, j, points):
                touches += found
                pairs.append((i, j))
    return sorted(set(touches)), sorted(pairs)


def _incidences(scene: Scene, i: int, j: int, points: Sequence[Sequence[Point]]) -> list[Touch]:
    """The vertices of body i on edges and vertices of body j."""
    found = []
    vertices = {p: k for k, p in enumerate(points[j])}
    for v, p in enumerate(points[i]):
        if p in vertices:
            if i < j:  # vertex on vertex counts once
                found.append(Touch(i, v, j, -1, vertices[p]))
            continue
        for e, (a, b) in enumerate(edges(scene.bodies[j].size, closed=scene.bodies[j].closed)):
            u, w = points[j][a], points[j][b]
            if side(u, w, p) == 0 and between(u, w, p):
                found.append(Touch(i, v, j, e, -1))
    return found


def _overlap(scene: Scene, i: int, j: int, points: Sequence[Sequence[Point]]) -> bool:
    """Whether edges cross or one body is inside the other."""
    a, b = scene.bodies[i], scene.bodies[j]
    for u, v in edges(a.size, closed=a.closed):
        for x, y in edges(b.size, closed=b.closed):
            if segments_meet(points[i][u], points[i][v], points[j][x], points[j][y]):
                return True
    return (a.closed and a.size > 2 and contains(points[i], points[j][0])) or (
        b.closed and b.size > 2 and contains(points[j], points[i][0])
    )
