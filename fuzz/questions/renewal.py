"""The first new contact, from the definition.

Two bodies come into a new contact when they meet after they have been apart, or when they
overlap just after a time but not just before it (at the start of the scene: not then). They
overlap if a point of one is in the interior of the other: that is decided between any two critical
times, by vertical lines. Chains overlap if they cross (`fuzz.questions.crossing`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import combinations, combinations_with_replacement, pairwise, product
from typing import TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene, scene_of
from fuzz.questions.all_pairs import first_contact_allpairs
from fuzz.questions.crossing import chains_cross
from fuzz.questions.reference import edges_of, meet_at, moments, pieces, tracks

__all__ = ["first_new_contact", "new_contact", "overlap"]

Point: TypeAlias = tuple[QQ, QQ]
Edge: TypeAlias = tuple[Point, Point]


def first_new_contact(
    scene: Scene, between: Collection[tuple[int, int]] | None = None
) -> tuple[AlgebraicNumber, set[tuple[int, int]]] | None:
    """The first new contact, and the pairs i <= j of bodies that come into contact then."""
    best: AlgebraicNumber | None = None
    found: set[tuple[int, int]] = set()
    every = combinations_with_replacement(range(len(scene.bodies)), 2)
    for i, j in every if between is None else between:
        time = _of_one(scene, i) if i == j else _of_two(scene, i, j)
        if time is None or (best is not None and time.compare(best) > 0):
            continue
        if best is None or time.compare(best) < 0:
            best, found = time, set()
        found.add((i, j))
    return None if best is None else (best, found)


def _of_two(scene: Scene, i: int, j: int) -> AlgebraicNumber | None:
    return new_contact(scene.bodies[i], scene.bodies[j], scene.exact_start, scene.exact_end)


def _of_one(scene: Scene, i: int) -> AlgebraicNumber | None:
    """When a body first touches itself."""
    contact = first_contact_allpairs(
        scene_of([scene.bodies[i]], scene.exact_start, scene.exact_end)
    )
    return None if contact is None else contact.time


def new_contact(a: Body, b: Body, start: QQ, end: QQ) -> AlgebraicNumber | None:
    """The first new contact of two bodies."""
    last = AlgebraicNumber(start)
    apart = not meet_at(last, a, b, *tracks(a, b, start))
    overlapped = overlap(a, b, start)
    for begin, until, p, q in pieces(a, b, start, end):
        for time in moments(begin, until, p, q):
            between = rational_between(last, time)
            if overlap(a, b, between) and not overlapped:
                return last
            overlapped = overlap(a, b, between)
            apart = apart or not meet_at(AlgebraicNumber(between), a, b, p, q)
            if apart and meet_at(time, a, b, p, q):
                return time
            last = time
    return None


def overlap(a: Body, b: Body, t: QQ) -> bool:
    """Return True if two bodies overlap at a rational time."""
    p, q = _sheared(a.exact_at(t), b.exact_at(t))
    e = [(p[i], p[j]) for i, j in edges_of(a)]
    f = [(q[i], q[j]) for i, j in edges_of(b)]
    if not a.has_interior and not b.has_interior:
        return chains_cross(a.exact_at(t), b.exact_at(t))
    if _is_point_on(e, f) or _is_point_on(f, e):
        return False
    return any(_overlap_at(x, a, e, b, f) for x in _lines(e, f))


def _sheared(p: list[Point], q: list[Point]) -> tuple[list[Point], list[Point]]:
    """The points with x + y / n for x: no two different ones have equal x then."""
    points = {*p, *q}
    n = 1
    while len({x + y / n for x, y in points}) < len(points):
        n += 1
    return [(x + y / n, y) for x, y in p], [(x + y / n, y) for x, y in q]


def _crossing(e: Edge, f: Edge) -> QQ | None:
    """The x of the point in which two edges cross each other."""
    (a, b), (c, d) = e, f
    sides = [_side(a, b, c), _side(a, b, d), _side(c, d, a), _side(c, d, b)]
    if sides[0] * sides[1] >= 0 or sides[2] * sides[3] >= 0:
        return None
    return c[0] + (d[0] - c[0]) * sides[0] / (sides[0] - sides[1])


def _is_point_on(e: list[Edge], f: list[Edge]) -> bool:
    """Return True if a body is a point, and on the boundary of another body: not in its interior.

    Where it is a vertex whose edges are on one side, a line through it meets none of these.
    """
    p, end = e[0]
    if p != end:
        return False
    return any(_side(a, b, p) == 0 and min(a, b) <= p <= max(a, b) for a, b in f)


def _side(a: Point, b: Point, c: Point) -> QQ:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _lines(e: list[Edge], f: list[Edge]) -> Iterator[QQ]:
    """Between any two x at which the order along a vertical line may change; of points, theirs."""
    xs = {x for edge in (*e, *f) for x, _ in edge}
    xs |= {x for u, v in combinations([*e, *f], 2) if (x := _crossing(u, v)) is not None}
    yield from ((x + y) / 2 for x, y in pairwise(sorted(xs)))
    yield from (u[0] for u, v in (*e, *f) if u == v)


def _overlap_at(x: QQ, a: Body, e: list[Edge], b: Body, f: list[Edge]) -> bool:
    """Return True if the bodies overlap on the vertical line at x."""
    first, second = _section(x, a, e), _section(x, b, f)
    for (low, high), (least, most) in product(first, second):
        middle = max(low, least) + min(high, most)
        inside = [low < middle / 2 < high] * a.has_interior
        inside += [least < middle / 2 < most] * b.has_interior
        if max(low, least) <= min(high, most) and all(inside):
            return True
    return False


def _section(x: QQ, body: Body, edges: list[Edge]) -> list[tuple[QQ, QQ]]:
    """The intervals of a body on a vertical line; of a body without interior, points."""
    ys = []
    for (a, b), (c, d) in edges:
        if a == c == x:
            ys.append(b)
        elif min(a, c) <= x < max(a, c):
            ys.append(b + (d - b) * (x - a) / (c - a))
    ys.sort()
    return list(zip(ys[::2], ys[1::2], strict=True)) if body.has_interior else [(y, y) for y in ys]
