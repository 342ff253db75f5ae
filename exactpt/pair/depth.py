"""A point deep inside two polygons: found in doubles, decided exactly.

The depth of a point in a polygon is its distance from the boundary, negative outside. Depths change
by at most the distance of two points, so the sum of two depths changes by at most twice that. Sums
are computed on a grid over the common part of two boxes, which is refined around its best point
as long as a point of a cell around it may be deep enough. The result need not be the deepest point:
how it is found needs no proof, for `have_deep_point` decides by rational numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeAlias

import numpy as np

from exactpt.geometry.predicates import Point
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats
from exactpt.kernel.numbers import QQ, nearest_float, rational
from exactpt.kernel.square_root import root_bounds
from exactpt.motion.body import Body
from exactpt.motion.inside import covers
from exactpt.pair.nearest_at import squared_from_segment

GRID: Final = 12
"""Points of a grid along one side."""
ROUNDS: Final = 5
"""Grids, each on the cells around the best point of the one before."""

Doubles: TypeAlias = "Floats"


def have_deep_point(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point], depth: QQ) -> bool:
    """Return True if a point is found whose depths in two polygons add up to a positive number.

    Args:
        a: a body.
        p: the places of its vertices.
        b: another body.
        q: the places of its vertices.
        depth: the number.
    """
    if not (a.has_interior and b.has_interior):
        return False
    found = _candidate([(a, p), (b, q)], nearest_float(depth))
    if found is None:
        return False
    depths = [_depth_below(a, p, found), _depth_below(b, q, found)]
    return all(d is not None for d in depths) and sum(d for d in depths if d is not None) >= depth


def _depth_below(body: Body, points: Sequence[Point], x: Point) -> QQ | None:
    """Return a lower bound on the depth of a point in a polygon; None if it is outside."""
    if not covers(body, points, x):
        return None
    squared = min(squared_from_segment(x, (points[i], points[j])) for i, j in body.edges)
    return root_bounds(squared).low


@np.errstate(all="ignore")
def _candidate(polygons: Sequence[tuple[Body, Sequence[Point]]], depth: float) -> Point | None:
    """Return a point that may be deep enough, in doubles; None if none is found."""
    corners = [
        np.array([[nearest_float(c) for c in point] for point in points]) for _, points in polygons
    ]
    edges = [
        points[np.array(body.edges)] for (body, _), points in zip(polygons, corners, strict=True)
    ]
    low = np.max([points.min(axis=0) for points in corners], axis=0)
    high = np.min([points.max(axis=0) for points in corners], axis=0)
    if not (np.isfinite([low, high]).all() and (low <= high).all()):
        return None
    best, deepest = low, -np.inf
    for _ in range(ROUNDS):
        check_budget()
        axes = [np.linspace(low[k], high[k], GRID) for k in (0, 1)]
        grid = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
        depths = np.sum([_depths(e, grid) for e in edges], axis=0)
        k = int(np.argmax(depths))
        if depths[k] > deepest:
            best, deepest = grid[k], float(depths[k])
        step = (high - low) / (GRID - 1)
        if deepest >= depth or deepest + 2 * float(np.hypot(*step)) < depth:
            break
        low, high = np.maximum(best - step, low), np.minimum(best + step, high)
    return (rational(float(best[0])), rational(float(best[1]))) if deepest >= depth else None


def _depths(edges: Doubles, points: Doubles) -> Doubles:
    """Return the depths of points in a polygon.

    Args:
        edges: the ends of its edges, shape (m, 2, 2).
        points: shape (n, 2).
    """
    begin, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    from_begin = points[:, None] - begin
    part = (from_begin * along).sum(axis=2) / np.maximum((along * along).sum(axis=1), 1e-300)
    nearest = np.clip(part, 0, 1)[:, :, None] * along
    distance = np.hypot(*np.moveaxis(from_begin - nearest, 2, 0)).min(axis=1)
    above = edges[None, :, :, 1] > points[:, None, None, 1]
    passes = above[:, :, 0] != above[:, :, 1]
    left = along[:, 0] * from_begin[:, :, 1] > along[:, 1] * from_begin[:, :, 0]
    is_inside = (passes & (left == (along[:, 1] > 0))).sum(axis=1) % 2 == 1
    signed: Doubles = np.where(is_inside, distance, -distance)
    return signed
