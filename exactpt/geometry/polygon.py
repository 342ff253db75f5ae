"""Polygons and chains at one instant: orientation, convexity, simplicity, containment.

All results are exact. Float boxes, rounded outward, only rule out pairs of edges.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise
from typing import Final

from exactpt.geometry.predicates import Point, between, orientation
from exactpt.geometry.simple import edges
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ

FEW: Final = 12
"""Maximum number of groups of points whose boxes are all compared."""


def signed_area2(points: Sequence[Point]) -> QQ:
    """Return twice the signed area, positive if counter-clockwise."""
    total = QQ(0)
    for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True):
        total += x0 * y1 - x1 * y0
    return total


def are_collinear(points: Sequence[Point]) -> bool:
    """Return True if all points are on one line."""
    first = points[0]
    second = next((p for p in points if p != first), first)
    return not any(orientation(first, second, p) for p in points)


def is_counter_clockwise(points: Sequence[Point]) -> bool:
    """Return True if a polygon of nonzero area is counter-clockwise.

    A simple polygon is oriented as it turns at its leftmost vertex, the lowest if there are
    several: the interior angle there is less than pi. (It is neither 0 nor pi.)
    """
    n = len(points)
    first = min(range(n), key=points.__getitem__)
    turn = orientation(points[first - 1], points[first], points[(first + 1) % n])
    return turn > 0 if turn else signed_area2(points) > 0


def is_convex(points: Sequence[Point]) -> bool:
    """Return True if at least three points are the corners of a convex polygon, in order.

    Corners may be on a straight line with their neighbours. A closed polygon that turns to one side
    only, and changes from leftward to rightward once, turns by 2 pi: it is convex, and simple.
    """
    is_left = is_right = False
    steps = [(x - u, y - v) for (u, v), (x, y) in pairwise([*points, points[0]])]
    for (x, y), (u, v) in pairwise([*steps, steps[0]]):
        turn = x * v - y * u
        is_left, is_right = is_left or turn > 0, is_right or turn < 0
        if (is_left and is_right) or (turn == 0 and x * u + y * v <= 0):
            return False
    # A vertical step has the direction of the step before it.
    directions = [x > 0 for x, _ in steps if x]
    changes = sum(
        a != b for a, b in zip(directions, [*directions[1:], *directions[:1]], strict=True)
    )
    return is_left != is_right and changes == 2


def segments_meet(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return True if the closed segments ab and cd intersect."""
    abc, abd = orientation(a, b, c), orientation(a, b, d)
    cda, cdb = orientation(c, d, a), orientation(c, d, b)
    if abc * abd < 0 and cda * cdb < 0:
        return True
    return (
        (abc == 0 and between(a, b, c))
        or (abd == 0 and between(a, b, d))
        or (cda == 0 and between(c, d, a))
        or (cdb == 0 and between(c, d, b))
    )


def first_self_touch(points: Sequence[Point], *, closed: bool) -> tuple[int, int] | None:
    """Return two edges that share more than a common end, or one edge (i, i) of length 0, or None.

    The polygon (or chain) is simple if and only if the result is None.
    """
    pairs = edges(len(points), closed=closed)
    for i, (u, v) in enumerate(pairs):
        if points[u] == points[v]:
            return i, i
    near = near_groups([(points[u], points[v]) for u, v in pairs])
    return min((ij for ij in near if edges_touch(points, *(pairs[k] for k in ij))), default=None)


def near_groups(groups: Sequence[Sequence[Point]]) -> Iterator[tuple[int, int]]:
    """Yield the pairs i < j of groups of points whose bounding boxes, rounded outward, intersect.

    A few groups are compared exactly, without numpy.
    """
    if len(groups) > FEW:
        from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs

        for first, second in overlapping_pairs(boxes_of_points(groups)):
            for i, j in zip(first.tolist(), second.tolist(), strict=True):
                check_budget()
                yield i, j
        return
    boxes = [(min(x), max(x), min(y), max(y)) for x, y in (zip(*g, strict=True) for g in groups)]
    for (i, (left, right, low, high)), (j, b) in combinations(enumerate(boxes), 2):
        if left <= b[1] and b[0] <= right and low <= b[3] and b[2] <= high:
            check_budget()
            yield i, j


def edges_touch(points: Sequence[Point], e: tuple[int, int], f: tuple[int, int]) -> bool:
    """Return True if two edges, as pairs of vertices, share more than a common vertex."""
    common = set(e) & set(f)
    if not common:
        return segments_meet(points[e[0]], points[e[1]], points[f[0]], points[f[1]])
    (v,) = common
    a = points[e[0] if e[1] == v else e[1]]
    b = points[f[0] if f[1] == v else f[1]]
    # Edges with a common end overlap if they leave it in the same direction.
    return orientation(a, points[v], b) == 0 and (
        between(points[v], a, b) or between(points[v], b, a)
    )


def contains(
    points: Sequence[Point], p: Point, pairs: Sequence[tuple[int, int]] | None = None
) -> bool:
    """Return True if the closed simple polygon, of either orientation, contains p.

    Args:
        points: its vertices.
        p: a point.
        pairs: the edges of a polygon with holes or of several parts, as pairs of vertices.
    """
    x, y = p
    inside = False
    sides = _cyclic_pairs(points) if pairs is None else ((points[i], points[j]) for i, j in pairs)
    for a, b in sides:
        above = a[1] > y
        if (above == (b[1] > y) and a[1] != y and b[1] != y) or (a[0] < x and b[0] < x):
            continue  # the edge contains no point of the ray to the right from p
        s = orientation(a, b, p)
        if s == 0 and between(a, b, p):
            return True
        # The ray crosses the edge (half-open in y, so a vertex counts once).
        if above != (b[1] > y) and (s > 0) == (b[1] > a[1]):
            inside = not inside
    return inside


def _cyclic_pairs(points: Sequence[Point]) -> Iterator[tuple[Point, Point]]:
    return zip(points, [*points[1:], points[0]], strict=True)
