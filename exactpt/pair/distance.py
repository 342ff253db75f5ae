"""The Euclidean distance of two bodies at a rational time."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import final

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, show
from exactpt.kernel.square_root import exact_square_root, nearest_root_less
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence
from exactpt.pair.features import Feature
from exactpt.pair.nearest_at import TwoAtTime
from exactpt.pair.pieces_of_two import two_bodies
from exactpt.scene.scene import Scene


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
    t = time_in_span(scene, at)
    there = TwoAtTime(first, second, t)
    squared, radius = there.squared, first.radius + second.radius
    assert squared is not None  # noqa: S101 - it has no limit
    nearest = [pair.features for pair in there.nearest if pair.squared == squared]
    return Distance(
        fraction(squared), tuple(sorted(map(_features, nearest), key=_in_order)), radius
    )


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


def compare_distance(a: Body, b: Body, t: QQ, squared: QQ) -> int:
    """Return the sign of the squared distance of two cores less a number, at a rational time."""
    found = TwoAtTime(a, b, t, squared).squared
    return 1 if found is None else (found > squared) - (found < squared)


def cores_intersect(a: Body, b: Body, t: QQ) -> bool:
    """Return True if the cores of two bodies have a point in common at a rational time."""
    return compare_distance(a, b, t, QQ(0)) == 0


def time_in_span(scene: Scene, at: Rational | AlgebraicNumber) -> QQ:
    """Return a time of a caller as a rational number.

    Raises:
        InputError: if it is irrational, or outside of the time span of the scene.
    """
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


def _features(pair: Incidence) -> tuple[Feature, Feature]:
    """Return the features of the bodies 0 and 1."""
    one = Feature(pair.vertex, None)
    if pair.edge < 0:
        return one, Feature(pair.other_vertex, None)
    two = Feature(None, pair.edge)
    return (one, two) if pair.body < pair.other else (two, one)
