"""The first time at which two bodies are within a distance, along an axis or in the maximum norm.

In the maximum norm two sets are within distance d if and only if one of them meets the
Minkowski sum of the other with a square of half-side d. At the first such time either a vertex
of one body lies on an edge of the other translated by a corner of the square, or two vertices
differ by exactly d in one coordinate and by at most d in the other. Both are roots of
polynomials in time, as contacts are.

All pairs of features are tested: the question concerns two bodies, not a whole scene.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain, product
from typing import Final, Literal, TypeAlias

from exactpt.errors import InputError
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ, Rational, rational
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.incidence import difference, lies_on, orientation
from exactpt.motion.track import Track
from exactpt.scene.scene import Scene

__all__ = ["NORMS", "Norm", "first_within"]

Norm: TypeAlias = Literal["max", "x", "y"]
NORMS: Final = ("max", "x", "y")
"""Supported norms: "max" is the larger of the distances in x and y; "x", "y" use one axis."""

Candidate: TypeAlias = "tuple[IntPoly, Callable[[AlgebraicNumber], bool]]"
"""A polynomial, and the predicate that tells which of its roots count."""


def first_within(
    scene: Scene, a: str, b: str, distance: Rational, *, norm: Norm = "max"
) -> AlgebraicNumber | None:
    """The first time in the scene's span at which two bodies are at most a distance apart.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    >>> first_within(scene, "ball", "wall", 1)
    AlgebraicNumber('7/2')

    Args:
        scene: the bodies and the time span; bodies other than a and b are irrelevant.
        a: the name of a body.
        b: the name of another body.
        distance: a number >= 0; 0 asks for the first contact.
        norm: "max": the larger of the distances in x and in y; "x" or "y": the gap between the
            projections of the bodies on that axis.

    Returns:
        The exact time; None if the bodies stay farther apart.

    Raises:
        InputError: if there is no such body or norm, or the distance is negative.
    """
    d = rational(distance)
    if d < 0:
        raise InputError(f"a distance is not negative: {d}")
    if norm not in NORMS:
        raise InputError(f"no norm {norm!r}; there are: {', '.join(NORMS)}")
    first, second = scene.body(a), scene.body(b)
    if first is second:
        raise InputError(f"two bodies are asked for, not {a!r} twice")
    if _is_within(first, second, scene._start, d, norm):
        return AlgebraicNumber(scene._start)
    begin = scene._start
    ends = {t for t in (*first._breakpoints, *second._breakpoints) if begin < t < scene._end}
    for end in (*sorted(ends), scene._end):
        p, q = first._piece_after(begin).tracks, second._piece_after(begin).tracks
        if norm == "max":
            candidates = _in_both(first, second, p, q, d)
        else:
            candidates = _on_axis(p, q, d, norm)
        time = _earliest(candidates, AlgebraicNumber(begin), end)
        if time is not None:
            return time
        begin = end
    return None


def _earliest(
    candidates: Iterator[Candidate], begin: AlgebraicNumber, end: QQ
) -> AlgebraicNumber | None:
    """The earliest root in (begin, end] that satisfies the predicate of its candidate."""
    best: AlgebraicNumber | None = None
    for f, counts in candidates:
        limit = end if best is None else best._high
        # If f vanishes identically, another candidate yields the time.
        for root in roots_after(f, begin, limit) if f else ():
            if counts(root.time):
                if best is None or root.time.compare(best) < 0:
                    best = root.time
                break
    return best


def _on_axis(
    p: tuple[Track, ...], q: tuple[Track, ...], d: QQ, axis: Literal["x", "y"]
) -> Iterator[Candidate]:
    """Candidates for "x" and "y": two vertices d apart; at the first such time none are nearer."""
    for u, v in product(p, q):
        for side in (d, -d):
            yield _offset(u, v, side, axis), lambda _: True


def _in_both(
    a: Body, b: Body, p: tuple[Track, ...], q: tuple[Track, ...], d: QQ
) -> Iterator[Candidate]:
    """Candidates for "max": a vertex on a translated edge, or two vertices d apart in x or y."""
    corners: list[Point] = [(x, y) for x in (d, -d) for y in (d, -d)]
    pairs = chain(
        product(p, ((q[i], q[j]) for i, j in b.edges)),
        product(q, ((p[i], p[j]) for i, j in a.edges)),
    )
    for (v, (u, w)), corner in product(pairs, corners):
        moved = _moved(v, corner)
        yield orientation(u, w, moved), _on_edge(moved, u, w)
    for u, v in product(p, q):
        for side in (d, -d):
            yield _offset(u, v, side, "x"), _at_most(u, v, d, "y")
            yield _offset(u, v, side, "y"), _at_most(u, v, d, "x")


def _offset(u: Track, v: Track, d: QQ, axis: Literal["x", "y"]) -> IntPoly:
    """A positive multiple of the polynomial v - u - d in one coordinate."""
    along = (u.x, v.x) if axis == "x" else (u.y, v.y)
    gap = scale(difference(along[0], u.w, along[1], v.w), ZZ(d.denominator))
    return subtract(gap, scale(multiply(u.w, v.w), ZZ(d.numerator)))


def _at_most(
    u: Track, v: Track, d: QQ, axis: Literal["x", "y"]
) -> Callable[[AlgebraicNumber], bool]:
    def holds(t: AlgebraicNumber) -> bool:
        low, high = _offset(u, v, -d, axis), _offset(u, v, d, axis)
        return t.sign_of(low) >= 0 and t.sign_of(high) <= 0

    return holds


def _on_edge(v: Track, a: Track, b: Track) -> Callable[[AlgebraicNumber], bool]:
    return lambda t: lies_on(v, a, b, t)


def _moved(v: Track, by: Point) -> Track:
    """The trajectory of a vertex translated by a constant vector."""
    m = ZZ(by[0].denominator * by[1].denominator)
    x, y = (add(scale(f, m), scale(v.w, ZZ(c * m))) for f, c in zip((v.x, v.y), by, strict=True))
    return Track(x, y, scale(v.w, m), None)


def _is_within(a: Body, b: Body, t: QQ, d: QQ, norm: Norm) -> bool:
    p, q = a._at(t), b._at(t)
    if norm != "max":
        axis = "xy".index(norm)
        (low, high), (left, right) = (
            (min(v[axis] for v in points), max(v[axis] for v in points)) for points in (p, q)
        )
        return left - high <= d and low - right <= d
    p_edges = a.edges or [(0, 0)]
    q_edges = b.edges or [(0, 0)]
    return (
        any(segments_meet(p[i], p[j], q[k], q[l]) for i, j in p_edges for k, l in q_edges)
        or any(_is_near(v, q[k], q[l], d) for v in p for k, l in q_edges)
        or any(_is_near(v, p[i], p[j], d) for v in q for i, j in p_edges)
        or (a.has_interior and contains(p, q[0]))
        or (b.has_interior and contains(q, p[0]))
    )


def _is_near(v: Point, a: Point, b: Point, d: QQ) -> bool:
    """Whether the closed segment ab meets the square of half-side d around v."""
    low, high = QQ(0), QQ(1)
    for at, start, end in zip(v, a, b, strict=True):
        if start == end:
            if abs(start - at) > d:
                return False
            continue
        enter, leave = sorted(((at - d - start) / (end - start), (at + d - start) / (end - start)))
        low, high = max(low, enter), min(high, leave)
    return low <= high
