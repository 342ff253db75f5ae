"""The other way to answer a query: every vertex and every edge of every body, no tiling.

Written from the definitions in plain rational arithmetic; shares nothing with
`exactpt.query` or the tilings.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from random import Random
from typing import Any, TypeAlias

from gmpy2 import mpq

from exactpt import Body, Scene
from exactpt.kernel.numbers import Rational

Point: TypeAlias = "tuple[Any, Any]"
"""A point with rational coordinates: mpq, `Fraction` or int."""
Places: TypeAlias = "Mapping[str, list[Point]]"
"""The points of each body, by its name."""
Owner: TypeAlias = "tuple[str, int | None, int | None]"
"""A body and its vertex or its edge, or neither inside it."""


def cross(o: Point, a: Point, b: Point) -> Any:  # noqa: ANN401 - a rational of any type
    """Return the cross product of a - o and b - o: positive if b is to the left of the line."""
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def on_segment(p: Point, a: Point, b: Point) -> bool:
    """Return True if a point lies in a closed segment."""
    if cross(a, b, p) != 0:
        return False
    return all(bool(min(a[k], b[k]) <= p[k] <= max(a[k], b[k])) for k in (0, 1))


class OpenChain(list[Point]):
    """The points of an open chain; those of any other body are in a plain list."""


class Rings(list[Point]):
    """The points of a body with several rings, which are given as ranges.

    Attributes:
        parts: for each part its rings, the outline first.
    """

    def __init__(self, points: Iterable[Point], parts: Sequence[Sequence[range]]) -> None:
        super().__init__(points)
        self.parts = parts


def points_of(scene: Scene, t: Rational) -> dict[str, list[Point]]:
    """Return the points of each body at a time, by its name."""
    at = scene.at(t)
    return {b.name: _points_of(b, [(mpq(x), mpq(y)) for x, y in at[b.name]]) for b in scene.bodies}


def _points_of(body: Body, points: list[Point]) -> list[Point]:
    if len(body.rings) > 1:
        return Rings(points, body.parts)
    return points if body.closed else OpenChain(points)


def rings_of(points: list[Point]) -> list[tuple[list[int], bool]]:
    """Return the vertices of each ring of a body, and whether it is a hole."""
    parts = points.parts if isinstance(points, Rings) else [[range(len(points))]]
    return [(list(ring), k > 0) for part in parts for k, ring in enumerate(part)]


def split_into_parts(scene: Places) -> dict[tuple[str, int], list[Point]]:
    """Return each part of each body as a body of its own, by its name and its number."""
    found = {}
    for name, points in scene.items():
        for i, part in enumerate(points.parts if isinstance(points, Rings) else [None]):
            if part is None:
                found[name, i] = points
            else:
                first = part[0].start
                own = points[first : part[-1].stop]
                shifted = [range(ring.start - first, ring.stop - first) for ring in part]
                found[name, i] = Rings(own, [shifted]) if len(part) > 1 else own
    return found


def edges_of(points: list[Point]) -> list[tuple[int, Point, Point]]:
    """Return the number and the ends of each edge: a body of two vertices has one, a point none."""
    if isinstance(points, Rings):
        return [
            (i, points[i], points[j])
            for ring, _ in rings_of(points)
            for i, j in pairwise([*ring, ring[0]])
        ]
    n = len(points)
    count = n if n > 2 and not isinstance(points, OpenChain) else n - 1
    return [(i, points[i], points[(i + 1) % n]) for i in range(count)]


def is_inside(p: Point, points: list[Point]) -> bool:
    """Return True if a point that is on no edge of a polygon is inside of it, and in no hole."""
    turns = sum(
        winding(p, [points[i] for i in ring]) % 2 * (-1 if is_hole else 1)
        for ring, is_hole in rings_of(points)
    )
    return turns != 0


def is_in_hole(p: Point, points: list[Point]) -> bool:
    """Return True if a point is in a hole of a body."""
    return any(
        is_hole and winding(p, [points[i] for i in ring]) for ring, is_hole in rings_of(points)
    )


def winding(p: Point, points: list[Point]) -> int:
    """Return how often a polygon of one ring turns around a point that is not on it."""
    total = 0
    for _, a, b in edges_of(points):
        if a[1] <= p[1] < b[1] and cross(a, b, p) > 0:
            total += 1
        elif b[1] <= p[1] < a[1] and cross(a, b, p) < 0:
            total -= 1
    return total


def owner(p: Point, scene: Places) -> Owner | None:
    """Return the body that has a point, with the vertex or edge there; None if none has it."""
    for name, points in scene.items():
        if p in points:
            return name, points.index(p), None
        for i, a, b in edges_of(points):
            if on_segment(p, a, b):
                return name, None, i
        if len(points) > 2 and not isinstance(points, OpenChain) and is_inside(p, points):
            return name, None, None
    return None


def first_hit(
    origin: Point, direction: Point, scene: Places
) -> tuple[Any, str, int | None, int | None] | None:
    """Return the parameter and the owner of the first point of a ray in a body, or None."""
    found = owner(origin, scene)
    if found is not None:
        return (0, *found)
    (ox, oy), (dx, dy) = origin, direction
    tip = (ox + dx, oy + dy)
    best: tuple[Any, str, int | None, int | None] | None = None
    for name, points in scene.items():
        for i, p in enumerate(points):
            if cross(origin, tip, p) == 0:
                t = ((p[0] - ox) * dx + (p[1] - oy) * dy) / (dx * dx + dy * dy)
                if t >= 0 and (best is None or t < best[0]):
                    best = (t, name, i, None)
        for i, a, b in edges_of(points):
            if cross(origin, tip, a) * cross(origin, tip, b) < 0:
                ex, ey = b[0] - a[0], b[1] - a[1]
                t = ((a[0] - ox) * ey - (a[1] - oy) * ex) / (dx * ey - dy * ex)
                if t >= 0 and (best is None or t < best[0]):
                    best = (t, name, None, i)
    return best


def convex_hull(points: list[Point]) -> list[Point]:
    """The strictly convex hull, counter-clockwise (gift wrapping)."""
    start = here = min(points)
    cycle = []
    while True:
        cycle.append(here)
        best = None
        for p in points:
            if p == here:
                continue
            turn = 1 if best is None else -cross(here, best, p)
            far = best is not None and cross(here, best, p) == 0 and on_segment(best, here, p)
            if best is None or turn > 0 or far:
                best = p
        if best is None or best == start:
            return cycle
        here = best


def crosses(p: Point, q: Point, scene: Places) -> bool:
    """Return True if the open segment from p to q goes through a body; touching is fine."""
    if p == q:
        return False
    d = (q[0] - p[0], q[1] - p[1])
    stops = [0, 1]
    for points in scene.values():
        for _, a, b in edges_of(points):
            if cross(p, q, a) * cross(p, q, b) < 0 and cross(a, b, p) * cross(a, b, q) < 0:
                return True
        level = [a for a in points if cross(p, q, a) == 0]
        norm = d[0] ** 2 + d[1] ** 2
        stops += [((a[0] - p[0]) * d[0] + (a[1] - p[1]) * d[1]) / norm for a in level]
    stops = sorted(t for t in stops if 0 <= t <= 1)
    for s, t in pairwise(stops):
        m = (s + t) / 2
        found = owner((p[0] + m * d[0], p[1] + m * d[1]), scene)
        if found is not None and found[1:] == (None, None):
            return True
    return False


def bends_around(
    before: Point, here: Point, after: Point, points: list[Point], vertex: int
) -> bool:
    """Return True if a path turns at a vertex with the body on the inner side of the turn."""
    turn = cross(before, here, after)
    nearby = [
        b if a == points[vertex] else a for _, a, b in edges_of(points) if points[vertex] in (a, b)
    ]

    def within(p: Point) -> bool:
        a, b = cross(here, before, p), cross(here, after, p)
        if turn == 0:  # back the way it came, around the end of a segment
            return bool(a == 0) and ahead(here, before, p)
        return bool(a <= 0 <= b if turn > 0 else b <= 0 <= a)

    return (turn != 0 or ahead(here, before, after)) and all(map(within, nearby))


def ahead(o: Point, a: Point, p: Point) -> bool:
    """Return True if p, on the line through o and a, is on the side of a."""
    return bool((a[0] - o[0]) * (p[0] - o[0]) + (a[1] - o[1]) * (p[1] - o[1]) > 0)


def inner_point(points: list[Point], rng: Random) -> Point:
    """A random point inside a polygon; the middle of the first edge of a chain; a point."""
    n = len(points)
    if n < 3 or isinstance(points, OpenChain):
        ends = points[:2]
        return tuple(sum(c) / len(ends) for c in zip(*ends, strict=True))
    while True:
        i = rng.randrange(n)
        ring = next(ring for ring, _ in rings_of(points) if i in ring)
        k = ring.index(i)
        a, b, c = (points[j] for j in (ring[k - 1], i, ring[(k + 1) % len(ring)]))
        u, v, w = (rng.randint(1, 997) for _ in range(3))
        s, far = u + v + w, rng.choice([1, 2, 4, 8, 64])
        m = tuple((a[k] * u + b[k] * v + c[k] * w) / s for k in (0, 1))
        p = tuple(b[k] + (m[k] - b[k]) / far for k in (0, 1))
        if owner(p, {"": points}) == ("", None, None):
            return p


def anchors_beside(
    path: Sequence[Point], scene: Mapping[Any, list[Point]], inner: Mapping[Any, Point]
) -> dict[Any, Point]:
    """Return a point of each body that a path does not pass, by name; some bodies have none.

    A taut path touches bodies, and where it runs along an open chain its points do not tell on
    which side of the chain it is: both classes have the same points there. Beside an anchor
    that is not on the path they do tell, since the path can be pushed off the bodies by less
    than its distance from the anchors. Leaving anchors out keeps equal words equal.

    Args:
        path: its vertices.
        scene: the points of each body.
        inner: of each body, the point to be preferred; else it is a vertex.
    """
    legs = list(pairwise(path))
    beside = {}
    for name, points in scene.items():
        for p in (inner[name], *points):
            if not any(on_segment(p, a, b) for a, b in legs):
                beside[name] = p
                break
    return beside


def crossing_word(path: Sequence[Point], anchors: Mapping[Any, Point]) -> list[tuple[Any, int]]:
    """Return how a path passes above each anchor, reduced.

    It is equal for two paths with the same ends if and only if one can be deformed into the other
    in the plane without the anchors.

    No anchor is on a path. Each is a little to the left of where it is given, of two in one
    column the one whose name is first the farther: so no two are passed at once, none is left or
    right of an end by chance, and a way back passes them in the opposite order.
    """
    columns = sorted(anchors.items(), key=lambda anchor: (anchor[1][0], anchor[0]))
    word: list[tuple[Any, int]] = []
    for p, q in pairwise(path):
        way = 1 if p[0] < q[0] else -1
        for name, (x, y) in columns[::way]:
            if (p[0] < x) != (q[0] < x) and way * cross(p, q, (x, y)) < 0:
                if word and word[-1] == (name, -way):
                    word.pop()
                else:
                    word.append((name, way))
    return word
