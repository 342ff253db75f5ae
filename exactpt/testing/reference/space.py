"""The free space at one time: places, rays, visible points, hulls.

Every vertex and every edge of every body is looked at; there is no tiling and no walk.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

from exactpt.geometry.predicates import orient2d
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene
from exactpt.testing.reference.shapes import is_on_segment, segments_cross

__all__ = [
    "Hit", "OpenChain", "Owner", "Places", "Point", "Rings", "bends_around", "components",
    "convex_hull", "crosses", "edges_crossed", "first_hit", "is_in_hole", "owner", "points_of",
    "winding",
]  # fmt: skip

Point: TypeAlias = "tuple[Any, Any]"
"""A point with rational coordinates: mpq, `Fraction` or int."""
Places: TypeAlias = "Mapping[str, list[Point]]"
"""The points of each body, by its name."""


class Owner(NamedTuple):
    """A body that has a point: with the vertex or the edge there, or neither inside it."""

    body: str
    vertex: int | None
    edge: int | None


class Hit(NamedTuple):
    """The first point of a ray in a body: at origin + at * direction."""

    at: QQ
    body: str
    vertex: int | None
    edge: int | None


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
    """Return the points of each body at a time, by its name.

    >>> from exactpt import Body, Scene
    >>> places = points_of(Scene([Body("a", [(0, 0), (4, 0)])]), 0)
    >>> owner((1, 0), places), owner((1, 1), places)
    (Owner(body='a', vertex=None, edge=0), None)

    Args:
        scene: the scene.
        t: the time.
    """
    at = rational(t)
    return {body.name: _points_of(body, body.exact_at(at)) for body in scene.bodies}


def _points_of(body: Body, points: list[Point]) -> list[Point]:
    if len(body.rings) > 1:
        return Rings(points, body.parts)
    return points if body.closed else OpenChain(points)


def rings_of(points: list[Point]) -> list[tuple[list[int], bool]]:
    """Return the vertices of each ring of a body, and whether it is a hole."""
    parts = points.parts if isinstance(points, Rings) else [[range(len(points))]]
    return [(list(ring), k > 0) for part in parts for k, ring in enumerate(part)]


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
        if a[1] <= p[1] < b[1] and orient2d(a, b, p) > 0:
            total += 1
        elif b[1] <= p[1] < a[1] and orient2d(a, b, p) < 0:
            total -= 1
    return total


def owner(p: Point, scene: Places) -> Owner | None:
    """Return the body that has a point, with the vertex or edge there; None if none has it."""
    for name, points in scene.items():
        if p in points:
            return Owner(name, points.index(p), None)
        for i, a, b in edges_of(points):
            if is_on_segment(p, a, b):
                return Owner(name, None, i)
        if len(points) > 2 and not isinstance(points, OpenChain) and is_inside(p, points):
            return Owner(name, None, None)
    return None


def first_hit(origin: Point, direction: Point, scene: Places) -> Hit | None:
    """Return the first point of a ray in a body; None if it meets none.

    >>> hit = first_hit((0, 0), (1, 0), {"wall": [(3, -1), (3, 1)]})
    >>> hit.at == 3, hit.body, hit.edge
    (True, 'wall', 0)

    Args:
        origin: a point.
        direction: a vector that is not zero; its length is the unit of the parameter.
        scene: the points of each body.
    """
    found = owner(origin, scene)
    if found is not None:
        return Hit(QQ(0), *found)
    (ox, oy), (dx, dy) = origin, direction
    tip = (ox + dx, oy + dy)
    best: Hit | None = None
    for name, points in scene.items():
        for i, p in enumerate(points):
            if orient2d(origin, tip, p) == 0:
                t = _ratio((p[0] - ox) * dx + (p[1] - oy) * dy, dx * dx + dy * dy)
                if t >= 0 and (best is None or t < best.at):
                    best = Hit(t, name, i, None)
        for i, a, b in edges_of(points):
            if orient2d(origin, tip, a) * orient2d(origin, tip, b) < 0:
                ex, ey = b[0] - a[0], b[1] - a[1]
                t = _ratio((a[0] - ox) * ey - (a[1] - oy) * ex, dx * ey - dy * ex)
                if t >= 0 and (best is None or t < best.at):
                    best = Hit(t, name, None, i)
    return best


def _ratio(numerator: Rational, denominator: Rational) -> QQ:
    return rational(numerator) / rational(denominator)


def convex_hull(points: list[Point]) -> list[Point]:
    """Return the strictly convex hull, counter-clockwise (gift wrapping)."""
    start = here = min(points)
    cycle = []
    while True:
        cycle.append(here)
        best = None
        for p in points:
            if p == here:
                continue
            turn = 1 if best is None else -orient2d(here, best, p)
            far = best is not None and orient2d(here, best, p) == 0 and is_on_segment(best, here, p)
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
    stops = [QQ(0), QQ(1)]
    for points in scene.values():
        for _, a, b in edges_of(points):
            if segments_cross(p, q, a, b):
                return True
        level = [a for a in points if orient2d(p, q, a) == 0]
        norm = d[0] ** 2 + d[1] ** 2
        stops += [_ratio((a[0] - p[0]) * d[0] + (a[1] - p[1]) * d[1], norm) for a in level]
    stops = sorted(t for t in stops if 0 <= t <= 1)
    for s, t in pairwise(stops):
        m = (s + t) / 2
        found = owner((p[0] + m * d[0], p[1] + m * d[1]), scene)
        if found is not None and found[1:] == (None, None):
            return True
    return False


def edges_crossed(p: Point, q: Point, edges: Sequence[tuple[Point, Point]]) -> list[int]:
    """Return which edges the segment from p to q crosses, in an inner point of both, by index.

    >>> gates = [((1, -1), (1, 1)), ((2, 0), (2, 1)), ((5, -1), (5, 1))]
    >>> edges_crossed((0, 0), (3, 0), gates)  # it passes an end of the second one
    [0]

    Args:
        p: an end of the segment.
        q: the other end.
        edges: the two ends of each edge.
    """
    return [k for k, (a, b) in enumerate(edges) if segments_cross(p, q, a, b)]


def bends_around(
    before: Point, here: Point, after: Point, points: list[Point], vertex: int
) -> bool:
    """Return True if a path turns at a vertex with the body on the inner side of the turn."""
    turn = orient2d(before, here, after)
    nearby = [
        b if a == points[vertex] else a for _, a, b in edges_of(points) if points[vertex] in (a, b)
    ]

    def within(p: Point) -> bool:
        a, b = orient2d(here, before, p), orient2d(here, after, p)
        if turn == 0:  # back the way it came, around the end of a segment
            return bool(a == 0) and ahead(here, before, p)
        return bool(a <= 0 <= b if turn > 0 else b <= 0 <= a)

    return (turn != 0 or ahead(here, before, after)) and all(map(within, nearby))


def ahead(o: Point, a: Point, p: Point) -> bool:
    """Return True if p, on the line through o and a, is on the side of a."""
    return bool((a[0] - o[0]) * (p[0] - o[0]) + (a[1] - o[1]) * (p[1] - o[1]) > 0)


def components(scene: Scene) -> dict[tuple[str, int] | None, list[str]]:
    """Return the components of the free space, with the bodies of the outlines in each.

    A component is the outside (None), or a hole: the name of its body and its first vertex. A body
    is named once for each of its parts; no two bodies share a point.

    >>> from exactpt import Body, Scene
    >>> frame = Body("frame", [(0, 0), (9, 0), (9, 9), (0, 9)], holes=[[(1, 1), (8, 1), (8, 8)]])
    >>> components(Scene([frame, Body("in", [(6, 3)])]))
    {None: ['frame'], ('frame', 4): ['in']}

    Args:
        scene: the scene, at its start.
    """
    places = points_of(scene, scene.start)
    holes = {
        (name, ring[0]): [points[i] for i in ring]
        for name, points in places.items()
        for ring, is_hole in rings_of(points)
        if is_hole
    }
    found: dict[tuple[str, int] | None, list[str]] = {}
    for name, points in places.items():
        for ring, is_hole in rings_of(points):
            if not is_hole:
                found.setdefault(_innermost(points[ring[0]], holes), []).append(name)
    return found


def _innermost(p: Point, holes: Mapping[tuple[str, int], list[Point]]) -> tuple[str, int] | None:
    """Return the hole around a point that is in all other holes around it; None for none."""
    around = [hole for hole, ring in holes.items() if winding(p, ring)]
    for hole in around:
        if all(winding(holes[hole][0], holes[other]) for other in around if other != hole):
            return hole
    return None
