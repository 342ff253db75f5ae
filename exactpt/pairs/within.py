"""The first time at which two bodies are within a distance, in the maximum norm or on an axis.

(In the Euclidean norm, a vertex of one body is then at this distance from a vertex of the other,
or from an edge, at the foot of the perpendicular: `exactpt.pairs.approach` finds that time.)

In the maximum norm two sets are within distance d if and only if one of them intersects the
Minkowski sum of the other with a square of half-side d. At the first such time either a vertex
of one body lies on an edge of the other translated by a corner of the square, or two vertices
differ by exactly d in one coordinate and by at most d in the other. Both are roots of
polynomials in time, as contacts are.

Rounded bodies are within a distance if their cores are within it and the radii: in the Euclidean
norm and along an axis, not in the maximum norm.

All pairs of features are tested: the question concerns two bodies, not a whole scene.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain, product
from typing import Final, Literal, TypeAlias

from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale, subtract
from exactpt.kernel.numbers import QQ, ZZ, Rational, rational, shorten, show
from exactpt.kernel.roots import roots_after
from exactpt.kernel.square_root import exact_square_root
from exactpt.motion.body import Body
from exactpt.motion.track import Track, difference, lies_on, orientation_polynomial
from exactpt.pairs.distance import squared_distance
from exactpt.pairs.piece_pairs import PiecePair, cores_intersect, piece_pairs, segments_of
from exactpt.pairs.rational import Earliest

Norm: TypeAlias = Literal["euclidean", "max", "x", "y"]
NORMS: Final = ("euclidean", "max", "x", "y")
"""Supported norms: "max" is the larger of the distances in x and y; "x", "y" use one axis."""

Candidate: TypeAlias = "tuple[IntPoly, Callable[[AlgebraicNumber], bool]]"
"""A polynomial, and the predicate that tells which of its roots count."""


def time_within(
    first: Body, second: Body, start: QQ, end: QQ, d: QQ, norm: Norm
) -> AlgebraicNumber | None:
    """Return the first time in [start, end] at which two bodies are within d.

    In the Euclidean norm d is the square, and the end the start.
    """
    d = of_cores(d, first._radius + second._radius, norm)
    if _is_within(first, second, start, d, norm):
        return AlgebraicNumber(start)
    if norm == "euclidean":
        return None
    for piece_pair in piece_pairs(first, second, start, end):
        candidates = _candidates(first, second, piece_pair, d, norm)
        time = _earliest(candidates, AlgebraicNumber(piece_pair.begin), piece_pair.end)
        if time is not None:
            return time
    return None


def asked_distance(
    distance: Rational | None, squared: Rational | None, norm: Norm | None
) -> tuple[Norm, QQ]:
    """Return the norm, and the distance in it; the square of a Euclidean one.

    Raises:
        InputError: if the norm does not exist, or not exactly one distance is given, which is
            not negative.
    """
    if norm is None:
        raise InputError(f"a norm has to be named: {', '.join(NORMS)}")
    if norm not in NORMS:
        raise InputError(f"no norm {shorten(norm)}; there are: {', '.join(NORMS)}")
    asked = squared if distance is None else distance
    if asked is None or (distance is not None and squared is not None):
        raise InputError("expected either a distance or its square")
    given = rational(asked)
    if given < 0:
        raise InputError(f"a distance is not negative: {show(given)}")
    if norm != "euclidean" and distance is None:
        raise InputError(f"a squared distance is for the Euclidean norm, not for {norm!r}")
    return norm, given * given if norm == "euclidean" and squared is None else given


def of_cores(d: QQ, radii: QQ, norm: Norm) -> QQ:
    """Return the distance of the cores at which bodies with radii of this sum are within d.

    Both as of `asked_distance`.

    Raises:
        InputError: if the norm is "max", or the distance of the cores has no rational square.
    """
    if not radii:
        return d
    if norm == "max":
        raise InputError('norm "max" is for bodies without radius; there are: euclidean, x, y')
    if norm != "euclidean":
        return d + radii
    root = exact_square_root(d)
    if root is None:
        raise InputError(
            f"distance_squared={show(d)}: of rounded bodies it must be the square of a rational"
        )
    return (root + radii) ** 2


def _candidates(
    a: Body, b: Body, piece_pair: PiecePair, d: QQ, norm: Literal["max", "x", "y"]
) -> Iterator[Candidate]:
    p, q = piece_pair.first, piece_pair.second
    if norm == "max":
        return _in_both(a, b, p, q, d)
    return _on_axis(p, q, d, norm)


def _earliest(
    candidates: Iterator[Candidate], begin: AlgebraicNumber, end: QQ
) -> AlgebraicNumber | None:
    """Return the earliest root in (begin, end] that satisfies the predicate of its candidate."""
    best: Earliest[None] = Earliest()
    for f, counts in candidates:
        # If f vanishes identically, another candidate yields the time.
        for root in roots_after(f, begin, best.until(end)) if f else ():
            if counts(root.time):
                best.add(root.time, ())
                break
    return best.number


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
        yield orientation_polynomial(u, w, moved), _on_edge(moved, u, w)
    for u, v in product(p, q):
        for side in (d, -d):
            yield _offset(u, v, side, "x"), _at_most(u, v, d, "y")
            yield _offset(u, v, side, "y"), _at_most(u, v, d, "x")


def _offset(u: Track, v: Track, d: QQ, axis: Literal["x", "y"]) -> IntPoly:
    """Return a positive multiple of the polynomial v - u - d in one coordinate."""
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
    """Return the trajectory of a vertex translated by a constant vector."""
    m = ZZ(by[0].denominator * by[1].denominator)
    x, y = (add(scale(f, m), scale(v.w, ZZ(c * m))) for f, c in zip((v.x, v.y), by, strict=True))
    return Track(x, y, scale(v.w, m), None)


def _is_within(a: Body, b: Body, t: QQ, d: QQ, norm: Norm) -> bool:
    if norm == "euclidean":
        return squared_distance(a, b, t) <= d
    p, q = a._at(t), b._at(t)
    if norm != "max":
        axis = "xy".index(norm)
        (low, high), (left, right) = (
            (min(v[axis] for v in points), max(v[axis] for v in points)) for points in (p, q)
        )
        return left - high <= d and low - right <= d
    return (
        cores_intersect(a, b, t)
        or any(_is_near(v, q[k], q[l], d) for v in p for k, l in segments_of(b))
        or any(_is_near(v, p[i], p[j], d) for v in q for i, j in segments_of(a))
    )


def _is_near(v: Point, a: Point, b: Point, d: QQ) -> bool:
    """Return True if the closed segment ab intersects the square of half-side d around v."""
    low, high = QQ(0), QQ(1)
    for at, start, end in zip(v, a, b, strict=True):
        if start == end:
            if abs(start - at) > d:
                return False
            continue
        enter, leave = sorted(((at - d - start) / (end - start), (at + d - start) / (end - start)))
        low, high = max(low, enter), min(high, leave)
    return low <= high
