"""Contacts at the start of a scene, decided exactly before any tiling is built."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.geometry.predicates import Point, between, side
from exactpt.motion.incidence import Touch
from exactpt.scene.scene import Scene

__all__ = ["initial_touches"]


def initial_touches(scene: Scene) -> tuple[list[Touch], list[tuple[int, int]]]:
    """All incidences at the start, and the pairs of bodies (as indices) that share a point then.

    The list of pairs is empty if and only if there is no contact at the start. There are no
    self-contacts: a scene with a polygon that is not simple at the start is refused.
    """
    points = [body._at(scene._start) for body in scene.bodies]
    near = [
        (i, j)
        for first, second in overlapping_pairs(boxes_of_points(points))
        for i, j in zip(first.tolist(), second.tolist(), strict=True)
    ]
    touches: set[Touch] = set()
    pairs: set[tuple[int, int]] = set()
    for e, f in _near_edges(scene, points, {i for pair in near for i in pair}):
        if segments_meet(e.a, e.b, f.a, f.b):
            pairs.add((e.body, f.body))
            touches.update(_incidences(e, f))
            touches.update(_incidences(f, e))
    for i, j in near:
        if (i, j) not in pairs and _one_is_inside(scene, i, j, points):
            pairs.add((i, j))
    return sorted(touches), sorted(pairs)


class _Edge(NamedTuple):
    """An edge of a body; a point is the edge -1 from itself to itself."""

    body: int
    number: int
    a: Point
    b: Point
    ends: tuple[int, int]


def _near_edges(
    scene: Scene, points: Sequence[Sequence[Point]], bodies: set[int]
) -> Iterator[tuple[_Edge, _Edge]]:
    """The pairs of edges of different bodies whose bounding boxes meet, ordered by body."""
    found = []
    for i in sorted(bodies):
        body, at = scene.bodies[i], points[i]
        pairs = body.edges
        found += [_Edge(i, k, at[u], at[v], (u, v)) for k, (u, v) in enumerate(pairs)]
        if not pairs:
            found.append(_Edge(i, -1, at[0], at[0], (0, 0)))
    if not found:
        return
    for first, second in overlapping_pairs(boxes_of_points([(e.a, e.b) for e in found])):
        for i, j in zip(first.tolist(), second.tolist(), strict=True):
            if found[i].body != found[j].body:
                yield found[i], found[j]


def _incidences(e: _Edge, f: _Edge) -> Iterator[Touch]:
    """The incidences of an end of edge e with edge f or with an end of f."""
    for v, p in zip(e.ends, (e.a, e.b), strict=True):
        meeting = [w for w, q in zip(f.ends, (f.a, f.b), strict=True) if p == q]
        for w in meeting:
            if e.body < f.body:  # report each vertex-vertex incidence once
                yield Touch(e.body, v, f.body, -1, w)
        if not meeting and side(f.a, f.b, p) == 0 and between(f.a, f.b, p):
            yield Touch(e.body, v, f.body, f.number, -1)


def _one_is_inside(scene: Scene, i: int, j: int, points: Sequence[Sequence[Point]]) -> bool:
    """Whether one of two bodies with disjoint boundaries contains the other."""
    a, b = scene.bodies[i], scene.bodies[j]
    return (a.has_interior and contains(points[i], points[j][0])) or (
        b.has_interior and contains(points[j], points[i][0])
    )
