"""Contacts at the start of a scene, decided exactly before any tiling is built."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final, NamedTuple

from exactpt.errors import InputError
from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import segments_meet
from exactpt.geometry.predicates import Point, between, side
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
from exactpt.motion.incidence import Touch
from exactpt.motion.inside import one_is_inside
from exactpt.scene.scene import Scene

__all__ = ["Edge", "incidences", "initial_touches"]

MOST_PAIRS: Final = 250_000
"""Maximum number of pairs of bodies that share a point at the start."""


def initial_touches(
    scene: Scene, near: Sequence[tuple[int, int]] | None = None
) -> tuple[list[Touch], list[tuple[int, int]]]:
    """All incidences at the start, and the pairs of bodies (as indices) that share a point then.

    The list of pairs is empty if and only if there is no contact at the start. There are no
    self-contacts: a scene with a polygon that is not simple at the start is refused. Rounded
    bodies have incidences if they touch and do not overlap.

    Args:
        scene: the scene.
        near: pairs i < j of bodies that are compared; all others are known to be disjoint.
            All pairs if not given.

    Raises:
        InputError: if too many pairs share a point.
    """
    if scene.is_rounded:
        return _of_rounded(scene, near)
    some = range(len(scene.bodies)) if near is None else sorted({i for ij in near for i in ij})
    points = {i: scene.bodies[i]._at(scene._start) for i in some}
    compared = None if near is None else set(near)
    touches: set[Touch] = set()
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
        for i, j in zip(first, second, strict=True):
            ask()
            a, b = scene.bodies[i], scene.bodies[j]
            if (i, j) not in pairs and one_is_inside(a, points[i], b, points[j]):
                pairs.add((i, j))
                _check_count(pairs)
    return sorted(touches), sorted(pairs)


def _of_rounded(
    scene: Scene, near: Sequence[tuple[int, int]] | None
) -> tuple[list[Touch], list[tuple[int, int]]]:
    """As `initial_touches`, where some of the bodies are rounded."""
    from exactpt.pairs.radius_search import RoundedSearch

    search, asked = RoundedSearch(scene, ()), None if near is None else set(near)
    met = {ij: deep for ij, deep in search.at_start() if asked is None or ij in asked}
    _check_count(set(met))
    plain = [i for i, body in enumerate(scene.bodies) if not body._radius]
    number = {i: k for k, i in enumerate(plain)}
    part = scene.going_on([scene.bodies[i] for i in plain], scene._start)
    some = None
    if near is not None:
        some = [(number[i], number[j]) for i, j in near if i in number and j in number]
    touches, overlaps = initial_touches(part, some)
    of_plain = [t._replace(body=plain[t.body], other=plain[t.other]) for t in touches]
    touching = [ij for ij, deep in met.items() if not deep]
    of_rounded = search.touches(touching, AlgebraicNumber(scene._start))
    pairs = [(plain[i], plain[j]) for i, j in overlaps]
    return sorted([*of_plain, *of_rounded]), sorted([*pairs, *met])


def _chunks(
    points: Mapping[int, Sequence[Point]], near: Sequence[tuple[int, int]] | None
) -> Iterator[tuple[list[int], list[int]]]:
    """The given pairs of bodies; else all whose bounding boxes meet, in chunks."""
    if near is not None:
        yield [i for i, _ in near], [j for _, j in near]
        return
    for first, second in overlapping_pairs(boxes_of_points(list(points.values()))):
        yield first.tolist(), second.tolist()


def _check_count(pairs: set[tuple[int, int]]) -> None:
    if len(pairs) > MOST_PAIRS:
        raise InputError(f"more than {MOST_PAIRS} pairs of bodies share a point at the start")


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
    """The pairs of edges of different bodies whose bounding boxes meet, ordered by body."""
    found = []
    for i in sorted(bodies):
        body, at = scene.bodies[i], points[i]
        pairs = body.edges
        found += [Edge(i, k, at[u], at[v], (u, v)) for k, (u, v) in enumerate(pairs)]
        if not pairs:
            found.append(Edge(i, -1, at[0], at[0], (0, 0)))
    if not found:
        return
    for first, second in overlapping_pairs(boxes_of_points([(e.a, e.b) for e in found])):
        for i, j in zip(first.tolist(), second.tolist(), strict=True):
            ask()
            if found[i].body != found[j].body:
                yield found[i], found[j]


def incidences(e: Edge, f: Edge) -> Iterator[Touch]:
    """The incidences of an end of edge e with edge f or with an end of f."""
    for v, p in zip(e.ends, (e.a, e.b), strict=True):
        meeting = [w for w, q in zip(f.ends, (f.a, f.b), strict=True) if p == q]
        for w in meeting:
            if e.body < f.body:  # report each vertex-vertex incidence once
                yield Touch(e.body, v, f.body, -1, w)
        if not meeting and side(f.a, f.b, p) == 0 and between(f.a, f.b, p):
            yield Touch(e.body, v, f.body, f.number, -1)
