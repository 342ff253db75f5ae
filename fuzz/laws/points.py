"""Laws about where bodies touch: the points and normals of a contact, from positions at its time.

A time that is irrational is bounded to `CLOSE`. Positions at the lower bound are so near to those
at the time that no digit of a double depends on the difference.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import Final, NamedTuple, TypeAlias

import exactpt
from exactpt import Contact, ContactPoint, Scene
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import QQ, fraction, power_of_two, shorten
from exactpt.testing import reference
from exactpt.testing.reference.shapes import is_inside
from fuzz.laws.law import refuse_unless
from fuzz.witnesses import Difference

__all__ = ["points_are_where_bodies_touch"]

CLOSE: Final = power_of_two(-400)
"""Width of the bounds of a time."""

SLACK: Final = power_of_two(-300)
"""How far positions at a bound of a time may be from those at the time."""

BESIDE: Final = power_of_two(-80)
"""Distance of a point beside an edge from the edge, as a part of the length of that."""

BEFORE: Final = power_of_two(-90)
"""How long before a contact a vertex is on the side from which it comes."""

TURNED: Final = 1e-14
"""Error of a normal."""

LARGEST: Final = sys.float_info.max

Vector: TypeAlias = tuple[QQ, QQ]


class Place(NamedTuple):
    """Where a vertex touches an edge or a vertex.

    Attributes:
        vertex: the position of the vertex.
        start, end: those of the ends of the edge, or twice that of the other vertex.
    """

    vertex: Vector
    start: Vector
    end: Vector

    @property
    def along(self) -> Vector:
        """The vector from the start of the edge to its end."""
        return self.end[0] - self.start[0], self.end[1] - self.start[1]

    @property
    def foot(self) -> Vector:
        """The point of the edge that is nearest to the vertex."""
        u, v = self.along
        length = u * u + v * v
        if length == 0:
            return self.start
        (x, y), (px, py) = self.start, self.vertex
        part = (u * (px - x) + v * (py - y)) / length
        return x + part * u, y + part * v


def points_are_where_bodies_touch(scene: Scene, random: Random) -> str:
    """The points of a contact are the nearest doubles, and normals point out of the edge's body."""
    pairs = [(a.name, b.name) for a, b in reference.counted_pairs(scene)]
    of_pairs = bool(pairs) and random.random() < 0.5
    # Asked about two bodies, a deforming one may have touched itself before.
    contact = exactpt.first_contact(scene, between=[random.choice(pairs)] if of_pairs else None)
    refuse_unless(contact is not None and contact.pairs)
    assert contact is not None  # noqa: S101 - just refused
    at = _just_at(scene, contact)
    for pair in contact.pairs:
        _check(scene, contact, pair, at)
    normals = sum(pair.normal is not None for pair in contact.pairs)
    return f"{contact.kind}, {'normals' if normals else 'no normal'}"


def _just_at(scene: Scene, contact: Contact) -> QQ:
    """Return the time of a contact, or a lower bound of it."""
    time = contact.time.simplified()
    while not time.is_rational and time.exact_high - time.exact_low > CLOSE:
        time.refine()
    return max(time.exact_low, scene.exact_start)


def _check(scene: Scene, contact: Contact, pair: ContactPoint, at: QQ) -> None:
    place = _place(scene, pair, at)
    one, other = scene.body(pair.body), scene.body(pair.other)
    reach = one.exact_radius + other.exact_radius
    if reach:
        foot = place.foot
        normal = (place.vertex[0] - foot[0]) / reach, (place.vertex[1] - foot[1]) / reach
        rise = other.exact_radius
        _check_doubles("normal", pair, pair.normal, normal)
        point = foot[0] + rise * normal[0], foot[1] + rise * normal[1]
        _check_doubles("point", pair, pair.point, point)
        return
    _check_doubles("point", pair, pair.point, place.vertex)
    if pair.edge is None:
        if pair.normal is not None:
            raise Difference("normal", f"of two vertices: {pair!r}")
        return
    # A body that touches itself has no side that is out of it at that time, if it folds.
    before = _just_before(scene, contact)
    side = _outer_side(scene, pair, before if one is other else at)
    if side is not None:
        _check_direction(pair, place, [side])
    elif contact.time == scene.start:
        _check_direction(pair, place, [1, -1])  # the vertex has not come from anywhere
    else:
        _check_direction(pair, place, [_side_of_vertex(scene, pair, before)])


def _place(scene: Scene, pair: ContactPoint, at: QQ) -> Place:
    vertex = scene.body(pair.body).exact_at(at)[pair.vertex]
    other = scene.body(pair.other)
    places = other.exact_at(at)
    if pair.edge is None:
        assert pair.other_vertex is not None  # noqa: S101
        return Place(vertex, places[pair.other_vertex], places[pair.other_vertex])
    return Place(vertex, places[pair.edge], places[other.end_of_edge(pair.edge)])


def _check_doubles(
    what: str, pair: ContactPoint, found: tuple[float, float] | None, expected: Vector
) -> None:
    """Check that two doubles are the nearest to two numbers."""
    if found is None or not all(map(_is_nearest, found, expected)):
        x, y = map(str, expected)
        raise Difference(what, f"{found}, expected {shorten(x)}, {shorten(y)}, of {pair!r}")


def _is_nearest(found: float, expected: QQ) -> bool:
    """Return True if a double is the nearest finite one to a number."""
    if abs(expected) >= LARGEST:
        return found == math.copysign(LARGEST, 1 if expected > 0 else -1)
    error = abs(Fraction(found) - fraction(expected))
    largest = math.ulp(found) / 2
    return error <= Fraction(largest) + fraction(SLACK * (1 + abs(expected)))


def _outer_side(scene: Scene, pair: ContactPoint, at: QQ) -> int | None:
    """Return 1 if the left side of an edge is out of its body, -1 if the right side is.

    By the even-odd rule just after the point. None if both sides are in it, or neither is.
    """
    other, place = scene.body(pair.other), _place(scene, pair, at)
    places = other.exact_at(at)
    (u, v), (x, y) = place.along, place.foot
    far = BESIDE
    middle = x + far * u, y + far * v
    left = middle[0] - far * far * v, middle[1] + far * far * u
    right = middle[0] + far * far * v, middle[1] - far * far * u
    is_left_in, is_right_in = (is_inside(point, other, places) for point in (left, right))
    if is_left_in == is_right_in:
        return None
    return -1 if is_left_in else 1


def _just_before(scene: Scene, contact: Contact) -> QQ:
    """Return a time just before a contact, or its time at the start."""
    return max(_just_at(scene, contact) - BEFORE, scene.exact_start)


def _side_of_vertex(scene: Scene, pair: ContactPoint, at: QQ) -> int:
    """Return 1 if the vertex is on the left of the edge, -1 if on its right or on its line."""
    place = _place(scene, pair, at)
    return 1 if orientation(place.start, place.end, place.vertex) > 0 else -1


def _check_direction(pair: ContactPoint, place: Place, sides: Sequence[int]) -> None:
    """Check that a normal is the unit vector across an edge, to one of some sides of it."""
    u, v = (float(part) for part in _scaled(place.along))
    size = math.hypot(u, v)
    expected = [(-side * v / size, side * u / size) for side in sides]
    if pair.normal is None or not any(_is_near(pair.normal, normal) for normal in expected):
        raise Difference("normal", f"{pair.normal}, expected {expected}, of {pair!r}")


def _is_near(normal: tuple[float, float], other: tuple[float, float]) -> bool:
    return all(abs(a - b) <= TURNED for a, b in zip(normal, other, strict=True))


def _scaled(vector: Vector) -> Vector:
    """Return a vector of the same direction, of which doubles keep the digits."""
    most = max(abs(part) for part in vector)
    return vector[0] / most, vector[1] / most
