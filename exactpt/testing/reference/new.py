"""The first new contact.

Two bodies come into a new contact when they meet after they have been apart, or when they
overlap just after a time but not just before it (at the start of the scene: not then). They
overlap if a point of one is in the interior of the other: that is decided between any two critical
times, by vertical lines. Chains overlap if they cross (`exactpt.testing.reference.crossing`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations, pairwise, product
from typing import TypeAlias

from exactpt.geometry.predicates import Point, orient2d
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene, scene_of
from exactpt.testing.reference.contact import counted_pairs, first_contact
from exactpt.testing.reference.crossing import chains_cross
from exactpt.testing.reference.features import bodies_meet, coordinate_differences, orientations
from exactpt.testing.reference.shapes import Points, edges_of, is_on_segment, segments_cross
from exactpt.testing.reference.times import critical_times, pieces, tracks_after

__all__ = ["first_new_contact", "new_contact", "overlap"]

Edge: TypeAlias = tuple[Point, Point]


def first_new_contact(
    scene: Scene, between: Iterable[Sequence[str]] | None = None
) -> tuple[AlgebraicNumber, set[frozenset[str]]] | None:
    """Return the time of the first new contact, and the names of any two bodies that come into it.

    A body that comes to touch itself has its name alone.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0)], Translation([0, 4, -1]))
    >>> scene = Scene([ball, Body("wall", [(0, -9), (0, 9)])], time=(0, 5))
    >>> time, pairs = first_new_contact(scene)
    >>> time, [sorted(pair) for pair in pairs]
    (AlgebraicNumber('4'), [['ball', 'wall']])

    Args:
        scene: the scene; its bodies have no radii.
        between: the pairs of names that count, twice the same name for a body with itself; all
            if not given.
    """
    of_two = [(a.name, b.name) for a, b in counted_pairs(scene)]
    every = [*of_two, *((body.name, body.name) for body in scene.bodies)]
    found: list[tuple[AlgebraicNumber, frozenset[str]]] = []
    for one, other in every if between is None else between:
        a, b = scene.body(one), scene.body(other)
        time = _of_one(scene, a) if a is b else new_contact(a, b, scene.time)
        found += [] if time is None else [(time, frozenset({one, other}))]
    if not found:
        return None
    first = min(time for time, _ in found)
    return first, {pair for time, pair in found if time == first}


def _of_one(scene: Scene, body: Body) -> AlgebraicNumber | None:
    """Return when a body first touches itself."""
    contact = first_contact(scene_of([body], scene.exact_start, scene.exact_end))
    return None if contact is None else contact.time


def new_contact(a: Body, b: Body, time: Sequence[Rational]) -> AlgebraicNumber | None:
    """Return the time of the first new contact of two bodies; None if there is none.

    >>> from exactpt import Body, Translation
    >>> ball = Body("ball", [(0, 0)], Translation([0, 4, -1]))
    >>> new_contact(ball, Body("box", [(-1, -1), (3, -1), (3, 1), (-1, 1)]), (0, 9))
    AlgebraicNumber('3')

    The ball is in the box at first, leaves it at t = 1, and comes back.

    Args:
        a: a body.
        b: another one.
        time: the start and the end of the time span.
    """
    start, end = map(rational, time)
    last = AlgebraicNumber(start)
    were_apart = not bodies_meet(last, a, b, *tracks_after(a, b, start))
    overlapped = overlap(a, b, start)
    for piece in pieces(a, b, start, end):
        p, q = piece.first, piece.second
        polynomials = [*orientations(p, q), *coordinate_differences(p, q)]
        for t in critical_times(polynomials, piece.begin, piece.end):
            middle = rational_between(last, t)
            overlap_now = overlap(a, b, middle)
            if overlap_now and not overlapped:
                return last
            overlapped = overlap_now
            were_apart = were_apart or not bodies_meet(AlgebraicNumber(middle), a, b, p, q)
            if were_apart and bodies_meet(t, a, b, p, q):
                return t
            last = t
    return None


def overlap(a: Body, b: Body, at: Rational) -> bool:
    """Return True if two bodies overlap at a rational time: one has a point inside of the other.

    Of two bodies without interior: they cross.

    >>> from exactpt import Body
    >>> box = Body("box", [(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> overlap(box, Body("in", [(1, 1)]), 0), overlap(box, Body("on", [(4, 1)]), 0)
    (True, False)

    Args:
        a: a body.
        b: another one.
        at: the time.
    """
    t = rational(at)
    if not a.has_interior and not b.has_interior:
        return chains_cross(a.exact_at(t), b.exact_at(t))
    p, q = _sheared(a.exact_at(t), b.exact_at(t))
    e = [(p[i], p[j]) for i, j in edges_of(a)]
    f = [(q[i], q[j]) for i, j in edges_of(b)]
    if _is_point_on(e, f) or _is_point_on(f, e):
        return False
    return any(_overlap_at(x, a, e, b, f) for x in _lines(e, f))


def _sheared(p: Points, q: Points) -> tuple[list[Point], list[Point]]:
    """Return the points with x + y / n for x: no two different ones have equal x then."""
    points = {*p, *q}
    n = 1
    while len({x + y / n for x, y in points}) < len(points):
        n += 1
    return [(x + y / n, y) for x, y in p], [(x + y / n, y) for x, y in q]


def _crossing(e: Edge, f: Edge) -> QQ | None:
    """Return the x of the point in which two edges cross each other; None if they do not."""
    if not segments_cross(*e, *f):
        return None
    c, d = f
    before, after = orient2d(*e, c), orient2d(*e, d)
    return c[0] + (d[0] - c[0]) * before / (before - after)


def _is_point_on(e: list[Edge], f: list[Edge]) -> bool:
    """Return True if a body is a point, and on the boundary of another body: not in its interior.

    Where it is a vertex whose edges are on one side, a line through it meets none of these.
    """
    p, end = e[0]
    return p == end and any(is_on_segment(p, a, b) for a, b in f)


def _lines(e: list[Edge], f: list[Edge]) -> Iterator[QQ]:
    """Yield an x between any two neighbours at which the order along a vertical line may change.

    Of a body that is a point, also its own.
    """
    xs = {x for edge in (*e, *f) for x, _ in edge}
    xs |= {x for u, v in combinations([*e, *f], 2) if (x := _crossing(u, v)) is not None}
    yield from ((x + y) / 2 for x, y in pairwise(sorted(xs)))
    yield from (u[0] for u, v in (*e, *f) if u == v)


def _overlap_at(x: QQ, a: Body, e: list[Edge], b: Body, f: list[Edge]) -> bool:
    """Return True if the bodies overlap on the vertical line at x."""
    first, second = _section(x, a, e), _section(x, b, f)
    for (low, high), (least, most) in product(first, second):
        bottom, top = max(low, least), min(high, most)
        middle = (bottom + top) / 2
        in_first = not a.has_interior or low < middle < high
        in_second = not b.has_interior or least < middle < most
        if bottom <= top and in_first and in_second:
            return True
    return False


def _section(x: QQ, body: Body, edges: list[Edge]) -> list[tuple[QQ, QQ]]:
    """Return the intervals of a body on a vertical line; of a body without interior, points."""
    ys = []
    for (a, b), (c, d) in edges:
        if a == c == x:
            ys.append(b)
        elif min(a, c) <= x < max(a, c):
            ys.append(b + (d - b) * (x - a) / (c - a))
    ys.sort()
    if not body.has_interior:
        return [(y, y) for y in ys]
    return list(zip(ys[::2], ys[1::2], strict=True))
