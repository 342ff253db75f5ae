"""When two bodies are within a distance of each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.motion.body import Body
from exactpt.testing.reference.features import (
    bodies_meet,
    corners,
    excess,
    has_foot,
    orientations,
    sides_of_foot,
    squared_from_line,
    squared_of_vertices,
)
from exactpt.testing.reference.times import (
    Instant,
    Interval,
    Tracks,
    critical_times,
    intervals_of,
    pieces,
    states,
    tracks_after,
)

__all__ = ["changes_within", "first_within", "intervals_within", "is_within"]


def intervals_within(
    a: Body, b: Body, time: Sequence[Rational], core_squared: Rational
) -> list[Interval]:
    """Return the maximal closed intervals in which two bodies are within a distance.

    >>> from exactpt import Body, Translation
    >>> ball = Body("ball", [(0, 0)], Translation([0, 1]))
    >>> intervals_within(ball, Body("wall", [(5, -9), (5, 9)]), (0, 10), 4)
    [(AlgebraicNumber('3'), AlgebraicNumber('7'))]

    Args:
        a: a body.
        b: another one.
        time: the start and the end of the time span.
        core_squared: the square of the distance of the cores: of the bodies without their radii.
    """
    start, end = map(rational, time)
    squared = rational(core_squared)

    def holds(t: Instant, p: Tracks, q: Tracks) -> bool:
        return is_within(t, a, b, p, q, squared)

    def polynomials(p: Tracks, q: Tracks) -> Iterator[IntPoly]:
        return changes_within(a, b, p, q, squared)

    return intervals_of(states(a, b, start, end, holds, polynomials))


def first_within(
    a: Body, b: Body, time: Sequence[Rational], core_squared: Rational
) -> AlgebraicNumber | None:
    """Return the first time at which two bodies are within a distance; None if they never are.

    Bodies that are farther apart come to that distance at two vertices, or at a vertex and the
    inside of an edge: at a root of the polynomial of one of these pairs.

    >>> from exactpt import Body, Translation
    >>> ball = Body("ball", [(0, 0)], Translation([0, 1]))
    >>> first_within(ball, Body("wall", [(5, -9), (5, 9)]), (0, 10), 2)
    <3.585786437626905... (root of a polynomial of degree 2)>

    Args:
        a: a body.
        b: another one.
        time: the start and the end of the time span.
        core_squared: the square of the distance of the cores: of the bodies without their radii.
    """
    start, end = map(rational, time)
    squared = rational(core_squared)
    now = AlgebraicNumber(start)
    if is_within(now, a, b, *tracks_after(a, b, start), squared):
        return now
    for piece in pieces(a, b, start, end):
        p, q = piece.first, piece.second
        for t in critical_times(_excesses(a, b, p, q, squared), piece.begin, piece.end):
            if is_within(t, a, b, p, q, squared):
                return t
    return None


def is_within(t: Instant, a: Body, b: Body, p: Tracks, q: Tracks, squared: QQ) -> bool:
    """Return True if the squared distance of the cores is at most a number at a time.

    Args:
        t: the time, or another judge of the signs of polynomials.
        a: a body.
        b: another one.
        p: the trajectories of the vertices of the first.
        q: those of the second.
        squared: the number.
    """
    if bodies_meet(t, a, b, p, q):
        return True
    near_vertices = any(
        t.sign_of(excess(squared_of_vertices(u, v), squared)) <= 0 for u, v in product(p, q)
    )
    if near_vertices:
        return True
    return any(
        t.sign_of(excess(squared_from_line(corner), squared)) <= 0 and has_foot(t, corner)
        for corner in corners(a, b, p, q)
    )


def changes_within(a: Body, b: Body, p: Tracks, q: Tracks, squared: QQ) -> Iterator[IntPoly]:
    """Yield the polynomials without whose roots two cores stay within a distance, or farther.

    Args:
        a: a body.
        b: another one.
        p: the trajectories of the vertices of the first.
        q: those of the second.
        squared: the square of the distance.
    """
    yield from orientations(p, q)
    for corner in corners(a, b, p, q):
        yield from sides_of_foot(corner)
    yield from _excesses(a, b, p, q, squared)


def _excesses(a: Body, b: Body, p: Tracks, q: Tracks, squared: QQ) -> Iterator[IntPoly]:
    """Yield the polynomials that are positive where two features are farther apart."""
    for u, v in product(p, q):
        yield excess(squared_of_vertices(u, v), squared)
    for corner in corners(a, b, p, q):
        yield excess(squared_from_line(corner), squared)
