"""Contacts at the start of a scene, decided exactly before any search."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import chain, combinations
from math import nextafter
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from exactpt.certificates.positions import Positions, positions_at
from exactpt.errors import InputError
from exactpt.filters.rounding import INFINITY
from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import near_groups, segments_meet
from exactpt.geometry.predicates import Point, between, orientation
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Indices
from exactpt.kernel.numbers import QQ
from exactpt.motion.inside import nested_pairs
from exactpt.motion.track import Incidence, renumbered
from exactpt.motion.vertices import Vertices
from exactpt.pair.distance import compare_distance
from exactpt.pair.features import feature_pairs
from exactpt.pair.incidences import tracks_just_before
from exactpt.scene.scene import Scene

Limit: TypeAlias = Callable[[int, int], QQ]
"""The square of the distance that two bodies keep, by their indices."""
Apart: TypeAlias = Callable[[Indices, Indices], Flags]
"""Which pairs of bodies, by two arrays of indices, keep a distance."""

MAX_PAIRS: Final = 250_000
"""Maximum number of pairs of bodies that share a point at the start."""
FEW: Final = 32
"""Maximum number of vertices whose positions at the start are computed without numpy."""


def initial_touches(
    scene: Scene, near: Sequence[tuple[int, int]] | None = None
) -> tuple[list[Incidence], list[tuple[int, int]]]:
    """Return all incidences at the start, and the pairs of bodies (as indices) that share a point.

    The list of pairs is empty if and only if no contact exists at the start. There are no
    self-contacts: a scene with a polygon that is not simple at the start is refused. Rounded
    bodies have incidences if they touch and do not overlap.

    Args:
        scene: the scene.
        near: pairs i < j of bodies that are compared; all others are known to be disjoint.
            All pairs if not given.

    Raises:
        InputError: if too many pairs share a point.
    """
    if scene.has_radius:
        return _with_radii(scene, near)
    some = range(len(scene.bodies)) if near is None else sorted({i for ij in near for i in ij})
    points = {i: scene.bodies[i].exact_at(scene.exact_start) for i in some}
    compared = None if near is None else set(near)
    touches: set[Incidence] = set()
    pairs: set[tuple[int, int]] = set()
    bodies = {i for first, second in _chunks(points, near) for i in {*first, *second}}
    for e, f in _near_edges(scene, points, bodies):
        if compared is not None and (e.body, f.body) not in compared:
            continue
        if segments_meet(e.a, e.b, f.a, f.b):
            pairs.add((e.body, f.body))
            touches.update(incidences(e, f))
            touches.update(incidences(f, e))
            _check_count(pairs)
    for first, second in _chunks(points, near):
        check_budget()
        involved = {i: (scene.bodies[i], points[i]) for i in {*first, *second}}
        pairs |= nested_pairs(involved, set(zip(first, second, strict=True)) - pairs)
        _check_count(pairs)
    return sorted(touches), sorted(pairs)


@np.errstate(all="ignore")
def near_pairs(vertices: Vertices, start: QQ) -> list[tuple[int, int]] | None:
    """Return the pairs i < j of bodies whose boxes intersect at a time; None if too many.

    Bodies of other pairs are certainly disjoint.
    """
    rings = [moving.ring for moving in vertices.bodies]
    if sum(map(len, rings)) <= FEW:
        return _near_of_few(vertices, start)
    x, y, error = positions_at(vertices, *vertices.normalization.time(start))
    ids = np.fromiter(chain.from_iterable(rings), np.int64)
    firsts = np.cumsum([0, *map(len, rings[:-1])])
    boxes = np.empty((len(rings), 4))
    for k, values in enumerate((x[ids], y[ids])):
        boxes[:, 2 * k] = np.minimum.reduceat(values, firsts) - error
        boxes[:, 2 * k + 1] = np.maximum.reduceat(values, firsts) + error
    low, high = boxes[:, ::2], boxes[:, 1::2]
    unknown = np.isnan(boxes).any(axis=1)
    low[unknown], high[unknown] = -INFINITY, INFINITY
    np.nextafter(low, -INFINITY, out=low)
    np.nextafter(high, INFINITY, out=high)
    near: list[tuple[int, int]] = []
    for first, second in overlapping_pairs(boxes):
        near += zip(first.tolist(), second.tolist(), strict=True)
        if len(near) > MAX_PAIRS:
            return None
    return near


def _near_of_few(vertices: Vertices, start: QQ) -> list[tuple[int, int]]:
    """Return the result of `near_pairs`, without numpy.

    An infinite error makes a side infinite or NaN, which separates nothing.
    """
    here, boxes = Positions(vertices), list[tuple[float, float, float, float]]()
    here.move_to(*vertices.normalization.time(start))
    for moving in vertices.bodies:
        ring = [vertices.all[v] for v in moving.ring]
        for vertex in ring:
            here.find(vertex)
        error = max(vertex.error for vertex in ring)
        xs, ys = [vertex.x for vertex in ring], [vertex.y for vertex in ring]
        low = nextafter(min(xs) - error, -INFINITY), nextafter(min(ys) - error, -INFINITY)
        high = nextafter(max(xs) + error, INFINITY), nextafter(max(ys) + error, INFINITY)
        boxes.append((*low, *high))
    return [
        (i, j)
        for (i, (x, y, right, top)), (j, (u, v, end, above)) in combinations(enumerate(boxes), 2)
        if not (x > end or u > right or y > above or v > top)
    ]


def _with_radii(
    scene: Scene, near: Sequence[tuple[int, int]] | None
) -> tuple[list[Incidence], list[tuple[int, int]]]:
    """Return the result of `initial_touches`, where some of the bodies have a radius."""
    radii = [body.exact_radius for body in scene.bodies]
    has_radius = np.array([r > 0 for r in radii], np.bool_)

    def squared(i: int, j: int) -> QQ:
        return (radii[i] + radii[j]) ** 2

    def apart(i: Indices, j: Indices) -> Flags:
        watched: Flags = (has_radius[i] | has_radius[j]) & (i != j)
        return watched

    if near is None:
        compared: Iterable[tuple[int, int]] = near_at_start(scene, radii, apart)
    else:
        compared = [(i, j) for i, j in near if radii[i] or radii[j]]
    met: dict[tuple[int, int], bool] = {}
    for ij, is_deep in within_at_start(scene, squared, compared):
        met[ij] = is_deep
        _check_count(met)
    plain = [i for i, r in enumerate(radii) if not r]
    number = {i: k for k, i in enumerate(plain)}
    part = scene.going_on([scene.bodies[i] for i in plain], scene.exact_start)
    some = None
    if near is not None:
        some = [(number[i], number[j]) for i, j in near if i in number and j in number]
    touches, initial_pairs = initial_touches(part, some)
    of_plain = [t._replace(body=plain[t.body], other=plain[t.other]) for t in touches]
    touching = [ij for ij, is_deep in met.items() if not is_deep]
    at_distance = touches_at_distance(scene, touching, AlgebraicNumber(scene.exact_start))
    pairs = [(plain[i], plain[j]) for i, j in initial_pairs]
    return sorted([*of_plain, *at_distance]), sorted([*pairs, *met])


def near_at_start(scene: Scene, reach: Sequence[QQ], apart: Apart) -> Iterator[tuple[int, int]]:
    """Yield the pairs i < j of bodies whose boxes intersect at the start.

    Args:
        scene: the bodies.
        reach: the length by which the box of each body is grown, on each side.
        apart: which pairs are compared.
    """
    points = [body.exact_at(scene.exact_start) for body in scene.bodies]
    grown = [
        [(x + s * d, y + s * d) for x, y in ring for s in (-1, 1)]
        for ring, d in zip(points, reach, strict=True)
    ]
    for first, second in overlapping_pairs(boxes_of_points(grown)):
        watched = apart(first, second)
        yield from sorted(zip(first[watched].tolist(), second[watched].tolist(), strict=True))


def within_at_start(
    scene: Scene, squared: Limit, near: Iterable[tuple[int, int]]
) -> Iterator[tuple[tuple[int, int], bool]]:
    """Yield those of some pairs that are within their distance, and whether they are nearer."""
    for i, j in near:
        check_budget()
        two = scene.bodies[i], scene.bodies[j]
        sign = compare_distance(*two, scene.exact_start, squared(i, j))
        if sign <= 0:
            yield (i, j), sign < 0


def touches_at_distance(
    scene: Scene, pairs: Iterable[tuple[int, int]], time: AlgebraicNumber
) -> Iterator[Incidence]:
    """Yield the incidences of pairs of bodies that touch at a time at the sum of their radii."""
    for i, j in pairs:
        two = scene.bodies[i], scene.bodies[j]
        squared = (two[0].exact_radius + two[1].exact_radius) ** 2
        p, q = (tracks_just_before(body, time, scene.exact_start) for body in two)
        for pair in feature_pairs(*two, p, q):
            if time.sign_of(pair.at_distance(squared)) == 0 and pair.is_inside(time):
                yield from renumbered([pair.touch], i, j)


def _chunks(
    points: Mapping[int, Sequence[Point]], near: Sequence[tuple[int, int]] | None
) -> Iterator[tuple[list[int], list[int]]]:
    """Yield the given pairs of bodies; else all whose bounding boxes intersect, in chunks."""
    if near is not None:
        yield [i for i, _ in near], [j for _, j in near]
        return
    for first, second in overlapping_pairs(boxes_of_points(list(points.values()))):
        yield first.tolist(), second.tolist()


def _check_count(pairs: Collection[tuple[int, int]]) -> None:
    if len(pairs) > MAX_PAIRS:
        raise InputError(f"more than {MAX_PAIRS} pairs of bodies share a point at the start")


class Edge(NamedTuple):
    """An edge of a body; a point is the edge -1 from itself to itself."""

    body: int
    number: int
    a: Point
    b: Point
    ends: tuple[int, int]


def _near_edges(
    scene: Scene, points: Mapping[int, Sequence[Point]], bodies: set[int]
) -> Iterator[tuple[Edge, Edge]]:
    """Yield the pairs of edges of different bodies whose boxes intersect, ordered by body."""
    found = []
    for i in sorted(bodies):
        body, at = scene.bodies[i], points[i]
        pairs = body.edges
        found += [Edge(i, k, at[u], at[v], (u, v)) for k, (u, v) in enumerate(pairs)]
        if not pairs:
            found.append(Edge(i, -1, at[0], at[0], (0, 0)))
    for i, j in near_groups([(e.a, e.b) for e in found]):
        if found[i].body != found[j].body:
            yield found[i], found[j]


def incidences(e: Edge, f: Edge) -> Iterator[Incidence]:
    """Yield the incidences of an end of edge e with edge f or with an end of f."""
    for v, p in zip(e.ends, (e.a, e.b), strict=True):
        meeting = [w for w, q in zip(f.ends, (f.a, f.b), strict=True) if p == q]
        for w in meeting:
            if e.body < f.body:  # report each vertex-vertex incidence once
                yield Incidence(e.body, v, f.body, -1, w)
        if not meeting and orientation(f.a, f.b, p) == 0 and between(f.a, f.b, p):
            yield Incidence(e.body, v, f.body, f.number, -1)
