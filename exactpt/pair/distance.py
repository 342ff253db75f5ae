"""The Euclidean distance of two bodies at a rational time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Final, final

from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, show
from exactpt.kernel.square_root import exact_square_root, nearest_root_less
from exactpt.motion.body import Body
from exactpt.pair.features import Feature
from exactpt.pair.pieces_of_two import cores_intersect, two_bodies
from exactpt.scene.scene import Scene

FEW: Final = 128
"""Maximum number of pairs of vertices of two bodies of which all features are compared exactly."""


@final
@dataclass(frozen=True, slots=True)
class Distance:
    """The distance of two bodies at one time; ``float`` gives the nearest double.

    That of rounded bodies is the distance of their cores less the radii; 0 where they overlap.
    Distances are ordered by their exact values; equal ones (==) have equal attributes, too.

    Attributes:
        core_squared: the square of the distance of the cores, exactly.
        features: the pairs of nearest features of the cores, of the first body and of the second
            one: a vertex and a vertex, or a vertex and the interior of an edge. At distance 0
            these are incidences; there may be none, if edges cross or one core contains the other.
        radius: the sum of the radii.
    """

    core_squared: Fraction
    features: tuple[tuple[Feature, Feature], ...]
    radius: Fraction = Fraction(0)

    @property
    def squared(self) -> Fraction:
        """The square of the distance, exactly.

        Raises:
            InputError: if it is irrational, which only that of rounded bodies can be.
        """
        return squared_gap(self.core_squared, self.radius)

    def __lt__(self, other: object) -> bool:
        """Return True if this distance is less than another distance, exactly."""
        return NotImplemented if not isinstance(other, Distance) else _is_less(self, other)

    def __gt__(self, other: object) -> bool:
        return NotImplemented if not isinstance(other, Distance) else _is_less(other, self)

    def __le__(self, other: object) -> bool:
        return NotImplemented if not isinstance(other, Distance) else not _is_less(other, self)

    def __ge__(self, other: object) -> bool:
        return NotImplemented if not isinstance(other, Distance) else not _is_less(self, other)

    def __repr__(self) -> str:
        count = len(self.features)
        return f"<Distance {float(self)!r}, nearest pairs of features: {count}>"

    def __float__(self) -> float:
        return max(0.0, nearest_root_less(QQ(self.core_squared), QQ(self.radius)))


def _is_less(one: Distance, other: Distance) -> bool:
    """Return True if max(0, sqrt(c) - r) is less for one distance than for another."""
    c, r = QQ(one.core_squared), QQ(one.radius)
    d, s = QQ(other.core_squared), QQ(other.radius)
    if d <= s * s:
        return False
    if c <= r * r:
        return True
    # sqrt(c) < sqrt(d) + (r - s); with k = r - s, of either sign:
    k = r - s
    if k < 0 and d <= k * k:
        return False
    # both sides are positive: c - d - k^2 < 2 k sqrt(d)
    left = c - d - k * k
    if k >= 0:
        return left < 0 or left * left < 4 * k * k * d
    return left < 0 and left * left > 4 * k * k * d


def distance(scene: Scene, a: str, b: str, at: Rational | AlgebraicNumber) -> Distance:
    """Return the Euclidean distance of two bodies at a time.

    >>> from exactpt import Body, Scene
    >>> scene = Scene([Body("point", [(3, 1)]), Body("line", [(0, 0), (1, -1)])], time=(0, 1))
    >>> there = distance(scene, "point", "line", at=0)
    >>> there.squared, float(there)
    (Fraction(8, 1), 2.8284271247461903)
    >>> there.features
    ((Feature(vertex=0, edge=None), Feature(vertex=1, edge=None)),)

    Args:
        scene: the bodies.
        a: the name of a body.
        b: the name of another body.
        at: a rational time in the time span of the scene.

    Raises:
        InputError: if a body does not exist, the bodies ignore each other in the scene, or the time
            is irrational or outside the span.
    """
    first, second = two_bodies(scene, a, b)
    t = _rational_time(scene, at)
    found = list(_near_features(first, second, t))
    least, radius = min(squared for squared, _ in found), first.radius + second.radius
    if least and cores_intersect(first, second, t):
        return Distance(Fraction(0), (), radius)
    nearest = tuple(sorted({pair for s, pair in found if s == least}, key=_in_order))
    return Distance(fraction(least), nearest, radius)


def squared_gap(core_squared: Fraction, radius: Fraction) -> Fraction:
    """Return the square of the distance of two rounded bodies, exactly.

    Raises:
        InputError: if it is irrational.
    """
    if radius == 0:
        return core_squared
    if core_squared <= radius**2:
        return Fraction(0)
    root = exact_square_root(QQ(core_squared))
    if root is None:
        raise InputError(
            "the squared distance of rounded bodies is irrational here: the root of core_squared, "
            "less radius, is their distance; float() rounds it"
        )
    return fraction((root - QQ(radius)) ** 2)


def squared_distance(a: Body, b: Body, t: QQ) -> QQ:
    """Return the squared distance of the cores of two bodies at a rational time."""
    return (
        QQ(0)
        if cores_intersect(a, b, t)
        else min(squared for squared, _ in _near_features(a, b, t))
    )


def _rational_time(scene: Scene, at: Rational | AlgebraicNumber) -> QQ:
    if isinstance(at, AlgebraicNumber):
        at = at.simplified()
        if not at.is_rational:
            raise InputError("an irrational time: use .low, .high or float()")
        t = at.exact_low
    else:
        t = rational(at)
    if not scene.exact_start <= t <= scene.exact_end:
        raise InputError(
            f"the time {show(t)} is outside of [{show(scene.exact_start)}, {show(scene.exact_end)}]"
        )
    return t


def _in_order(pair: tuple[Feature, Feature]) -> list[int]:
    return [-1 if number is None else number for feature in pair for number in feature]


def _near_features(a: Body, b: Body, t: QQ) -> Iterator[tuple[QQ, tuple[Feature, Feature]]]:
    """Yield squared distances of vertices from vertices, and from the interiors of edges.

    All that are least are among them.
    """
    p, q = a.exact_at(t), b.exact_at(t)
    if a.size * b.size > FEW:
        yield from _filtered_features(a, p, b, q)
        return
    for (i, u), (j, v) in product(enumerate(p), enumerate(q)):
        yield _squared(u, v), (Feature(i, None), Feature(j, None))
    for (e, (k, l)), (j, v) in product(enumerate(a.edges), enumerate(q)):
        squared = squared_from_interior(v, p[k], p[l])
        if squared is not None:
            yield squared, (Feature(None, e), Feature(j, None))
    for (i, u), (e, (k, l)) in product(enumerate(p), enumerate(b.edges)):
        squared = squared_from_interior(u, q[k], q[l])
        if squared is not None:
            yield squared, (Feature(i, None), Feature(None, e))


def _filtered_features(
    a: Body, p: list[Point], b: Body, q: list[Point]
) -> Iterator[tuple[QQ, tuple[Feature, Feature]]]:
    """Yield the same of those features that may be nearest, given the vertices of the bodies."""
    from exactpt.pair.nearest_at import incidences_that_may_be_nearest

    edges, points = (a.edges, b.edges), (p, q)
    for body, vertex, other, edge, other_vertex in incidences_that_may_be_nearest(a, p, b, q):
        check_budget()
        one, v = Feature(vertex, None), points[body][vertex]
        if edge < 0:
            yield _squared(v, points[other][other_vertex]), (one, Feature(other_vertex, None))
            continue
        k, l = edges[other][edge]
        squared = squared_from_interior(v, points[other][k], points[other][l])
        if squared is not None:
            two = Feature(None, edge)
            yield squared, (one, two) if body < other else (two, one)


def _squared(u: Point, v: Point) -> QQ:
    return (u[0] - v[0]) ** 2 + (u[1] - v[1]) ** 2


def squared_from_segment(v: Point, segment: tuple[Point, Point]) -> QQ:
    """Return the squared distance of a point from a segment."""
    inside = squared_from_interior(v, *segment)
    if inside is not None:
        return inside
    return min((v[0] - x) ** 2 + (v[1] - y) ** 2 for x, y in segment)


def squared_from_interior(v: Point, a: Point, b: Point) -> QQ | None:
    """Return the squared distance of v from ab; None if the nearest point is an end."""
    x, y = b[0] - a[0], b[1] - a[1]
    along, length = x * (v[0] - a[0]) + y * (v[1] - a[1]), x * x + y * y
    if not 0 < along < length:
        return None
    return (x * (v[1] - a[1]) - y * (v[0] - a[0])) ** 2 / length
