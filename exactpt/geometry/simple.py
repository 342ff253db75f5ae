"""Float filters for simple polygons and chains: accepted ones are simple, with an area.

The sign of an orientation. With coordinates off by at most e, a rounded difference u has an
error of at most 2 e + U |u|, so the determinant p - q of two differences u, v one of at most
6 U (|p| + |q|) + 2 e (|ux| + |uy| + |vx| + |vy|) + 8 e^2; 8 U covers the rounding of the bound.
An overflow makes the bound infinite or NaN, and then no sign is certain; `TINY` covers
underflow.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Final

from exactpt.filters.rounding import SLACK, TINY, U

Edge = tuple[float, float, float, float]

K: Final = 8.0 * U
FEW: Final = 20
"""Maximum number of vertices of which all pairs of edges are compared here, without numpy."""


def edges(size: int, *, closed: bool) -> list[tuple[int, int]]:
    """Return the edges of a body as pairs of vertices; edge i starts at vertex i.

    A point has none, a segment one (closed or not), a polygon as many as it has vertices.
    """
    pairs = [(i, i + 1) for i in range(size - 1)]
    if closed and size > 2:
        pairs.append((size - 1, 0))
    return pairs


def is_surely_simple(
    xs: Sequence[float], ys: Sequence[float], *, closed: bool, error: float = 0.0
) -> bool:
    """Return True if a polygon (or chain) certainly is simple, and a polygon has an area.

    Args:
        xs: finite coordinates.
        ys: the other coordinates.
        closed: whether it is a polygon, if it has three or more vertices.
        error: a bound on the errors of all coordinates; 0, or at least U times the largest.
    """
    n = len(xs)
    if n <= 2:
        return n == 1 or abs(xs[1] - xs[0]) > 3.0 * error or abs(ys[1] - ys[0]) > 3.0 * error
    if closed and n == 3:
        sides = xs[1] - xs[0], ys[1] - ys[0], xs[2] - xs[1], ys[2] - ys[1]
        return cross_sign(*sides, error) != 0
    if closed and _turns_once(xs, ys, error):
        return True
    if n > FEW:
        return _is_simple_of_many(xs, ys, error, closed=closed)
    return _no_edges_meet(xs, ys, error, closed=closed)


def orientation_of_doubles(xs: Sequence[float], ys: Sequence[float], *, is_exact: bool) -> int:
    """1 if a simple polygon is counter-clockwise, -1 if it is clockwise, 0 if not certain.

    It is oriented as it turns at its leftmost vertex (`exactpt.geometry.polygon`). Numbers keep
    their order when they are rounded, but may become equal.

    Args:
        xs: coordinates.
        ys: the other coordinates.
        is_exact: whether they are exact; else they are the nearest doubles.
    """
    x = min(xs)
    i = xs.index(x)
    if xs.count(x) > 1:
        if not is_exact:
            return 0
        i = min(range(len(xs)), key=lambda k: (xs[k], ys[k]))
    j = i + 1 if i + 1 < len(xs) else 0
    error = 0.0
    if not is_exact:
        error = 2.0 * U * max(abs(v) for k in (i - 1, i, j) for v in (xs[k], ys[k]))
    vx, vy = xs[j] - x, ys[j] - ys[i]
    return cross_sign(x - xs[i - 1], ys[i] - ys[i - 1], vx, vy, error)


def _turns_once(xs: Sequence[float], ys: Sequence[float], error: float) -> bool:
    """Return True if a polygon certainly is strictly convex.

    It is, and hence simple, if it turns to the same side at each vertex, by less than pi, and
    by 2 pi in all. Its edges then change their direction along x, those that go neither way
    left out, twice in each turn of 2 pi: none of the two open half turns without an upright
    edge can be left out, as that takes a turn of pi or more.
    """
    ux, uy = xs[0] - xs[-1], ys[0] - ys[-1]
    side = changes = 0
    along = first_along = 0.0
    for i in range(len(xs)):
        if abs(ux) > 3.0 * error:
            if ux * along < 0.0:
                changes += 1
            along = 1.0 if ux > 0.0 else -1.0
            first_along = first_along or along
        elif error:
            return False  # perhaps upright, perhaps not
        j = i + 1 if i + 1 < len(xs) else 0
        vx, vy = xs[j] - xs[i], ys[j] - ys[i]
        s = cross_sign(ux, uy, vx, vy, error)
        if s in (0, -side):
            return False
        side = s
        ux, uy = vx, vy
    return changes + (first_along != along) == 2


def _is_simple_of_many(
    xs: Sequence[float], ys: Sequence[float], error: float, *, closed: bool
) -> bool:
    import numpy as np

    from exactpt.geometry.ragged import surely_simple

    rounded = np.array([error]) if error else None
    points = np.array((xs, ys)).T
    return bool(surely_simple(points, np.array([0, len(xs)]), np.array([closed]), rounded)[0])


def _no_edges_meet(xs: Sequence[float], ys: Sequence[float], error: float, *, closed: bool) -> bool:
    """Return True if certainly no two edges share more than a common end.

    Two with a common end do not if they are not parallel.
    """
    n = len(xs)
    rows = [(xs[i], ys[i], xs[j], ys[j]) for i, j in edges(n, closed=closed)]
    m = len(rows)
    for i, j in combinations(range(m), 2):
        if j == i + 1 or (closed and j - i == m - 1):
            a, b = (rows[i], rows[j]) if j == i + 1 else (rows[j], rows[i])
            if not cross_sign(a[2] - a[0], a[3] - a[1], b[2] - b[0], b[3] - b[1], error):
                return False
        elif not are_apart(rows[i], rows[j], error):
            return False
    return True


def are_apart(e: Edge, f: Edge, error: float) -> bool:
    """Return True if two edges are certainly disjoint, by boxes or by the line of one."""
    ax, ay, bx, by = e
    cx, cy, dx, dy = f
    off = 4.0 * error  # of which two count, and one covers rounding
    if (
        min(ax, bx) - off > max(cx, dx)
        or min(cx, dx) - off > max(ax, bx)
        or min(ay, by) - off > max(cy, dy)
        or min(cy, dy) - off > max(ay, by)
    ):
        return True
    ux, uy = bx - ax, by - ay
    s = cross_sign(ux, uy, cx - ax, cy - ay, error)
    if s and s == cross_sign(ux, uy, dx - ax, dy - ay, error):
        return True
    vx, vy = dx - cx, dy - cy
    s = cross_sign(vx, vy, ax - cx, ay - cy, error)
    return bool(s) and s == cross_sign(vx, vy, bx - cx, by - cy, error)


def cross_sign(ux: float, uy: float, vx: float, vy: float, error: float) -> int:
    """Return the sign of u x v, rounded differences of coordinates; 0 if it is not certain."""
    p, q = ux * vy, uy * vx
    bound = K * (abs(p) + abs(q)) + TINY
    if error:
        size = abs(ux) + abs(uy) + abs(vx) + abs(vy)
        bound = (bound + 2.0 * error * (size + 4.0 * error)) * SLACK
    value = p - q
    return 1 if value > bound else -1 if value < -bound else 0
