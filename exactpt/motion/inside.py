"""Containment of points, and of bodies in each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Final

from exactpt.geometry.polygon import contains
from exactpt.geometry.predicates import Point
from exactpt.motion.body import Body

FEW: Final = 16
"""Maximum number of pairs of a ring and a place of which all are tested."""


def covers(body: Body, points: Sequence[Point], p: Point) -> bool:
    """Return True if the polygon that is a body, with its vertices at given points, contains p."""
    return body.has_interior and contains(points, p, body.edges if body.has_rings else None)


def one_is_inside(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point]) -> bool:
    """Return True if a point of one body is in the other, if their boundaries are disjoint."""
    return bool(nested_pairs({0: (a, p), 1: (b, q)}, [(0, 1)]))


def nested_pairs(
    bodies: Mapping[int, tuple[Body, Sequence[Point]]], apart: Iterable[tuple[int, int]]
) -> set[tuple[int, int]]:
    """Return those pairs i < j, of pairs with disjoint boundaries, that have a point in common.

    Let a point be in both. On a path from it within its part of i, or within that of j, the
    boundary of one of them comes first; this point of it is in the other body, and so is the
    whole ring. So one vertex of each ring decides: whether it is in an odd number of rings.

    Args:
        bodies: the bodies by number, with the points of their vertices.
        apart: the pairs.
    """
    compared = set(apart)
    rings = [(i, points[r.start : r.stop]) for i, (body, points) in bodies.items()
             for r in body.rings]  # fmt: skip
    solid = [(i, ring) for i, ring in rings if bodies[i][0].has_interior]
    near: Iterable[tuple[int, int]] = product(range(len(solid)), range(len(rings)))
    if len(solid) * len(rings) > FEW:
        from exactpt.geometry.boxes import boxes_of_points, crossing_pairs

        boxes = boxes_of_points([*(ring for _, ring in solid), *(ring[:1] for _, ring in rings)])
        chunks = crossing_pairs(boxes[: len(solid)], boxes[len(solid) :])
        near = (two for i, j in chunks for two in zip(i.tolist(), j.tolist(), strict=True))
    inside: set[tuple[int, int]] = set()
    for k, of_other in near:
        (i, ring), (j, other) = solid[k], rings[of_other]
        if ((i, j) if i < j else (j, i)) in compared and contains(ring, other[0]):
            inside ^= {(i, of_other)}
    return {(min(i, rings[k][0]), max(i, rings[k][0])) for i, k in inside}
