"""Laws about distances over time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product
from random import Random
from typing import Final

import exactpt
from exactpt import AlgebraicNumber, Body, Clearance, Scene
from exactpt.kernel.algebraic import rational_between
from exactpt.kernel.algebraic_value import square_root
from exactpt.kernel.numbers import QQ, ZZ, fraction
from exactpt.search.clearance import ClearancePiece, CloseInterval
from exactpt.testing import reference
from exactpt.testing.reference import Nearest, Place
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import DISTANCES, a_time, two_names
from fuzz.witnesses import Difference

__all__ = ["clearance_is_the_distance", "surroundings_are_of_each_pair"]

TIMES: Final = 6
"""Number of times at which a clearance is compared, and of pieces in which it is."""

STEPS: Final = 60
"""Those times are multiples of this part of the time span."""

INSTANTS: Final = 16
"""More than the number of times in a piece at which the nearest point may be an end of the edge."""

HALVINGS: Final = 12
"""Most halvings of a piece towards one of its ends, for a time near that end."""


def clearance_is_the_distance(scene: Scene, random: Random) -> str:
    """The clearance of two bodies is their distance at each time, in pieces without a gap."""
    first, second = two_names(scene, random)
    gap = exactpt.clearance(scene, first, second)
    start, end = AlgebraicNumber(scene.exact_start), AlgebraicNumber(scene.exact_end)
    _check_cover("pieces", gap.pieces, start, end)
    _check_changes(scene, gap)
    for _ in range(TIMES):
        _check_at(scene, gap, a_time(scene, random, STEPS))
    pieces = [piece for piece in gap.pieces if piece.start < piece.end]
    for piece in random.sample(pieces, min(TIMES, len(pieces))):
        _check_piece(scene, gap, piece, _time_in(piece, random))
    for interval in gap.below(fraction(random.choice(DISTANCES))):
        _check_cover("pieces of below", interval.pieces, interval.start, interval.end)
    return "they touch" if gap.minimum.squared == 0 else "they stay apart"


def _check_cover(
    what: str, pieces: Sequence[ClearancePiece], start: AlgebraicNumber, end: AlgebraicNumber
) -> None:
    """Check that pieces cover an interval, one after the other."""
    check_equal(what, (pieces[0].start, pieces[-1].end), (start, end))
    for before, after in pairwise(pieces):
        check_equal(what, before.end, after.start)


def _check_changes(scene: Scene, gap: Clearance) -> None:
    """Check that a piece ends where the nearest features change, or a motion does."""
    bodies = scene.body(gap.a), scene.body(gap.b)
    changes = {t for body in bodies for t in body.breakpoints_between(*scene.time)}
    for before, after in pairwise(gap.pieces):
        if before.features == after.features and not any(before.end == t for t in changes):
            raise Difference("pieces", f"cut at {before.end}, where nothing changes")


def _check_at(scene: Scene, gap: Clearance, time: QQ) -> Nearest:
    """Compare a clearance with the definition at a time, and return what that says."""
    at = fraction(time)
    expected = reference.nearest(scene.body(gap.a), scene.body(gap.b), at)
    squared = max(expected.core_squared, gap.radius**2)  # cores may be nearer than the radii
    check_equal("clearance", gap.squared_with_radius(at), squared)
    there = exactpt.distance(scene, gap.a, gap.b, at=at)
    check_equal("double", gap(at), float(there))
    if _is_more(gap, squared):
        raise Difference("minimum", f"{gap.minimum!r}, but {gap(at)} at {time}")
    return expected


def _is_more(gap: Clearance, squared: Fraction) -> bool:
    """Return True if the minimum, with the radii, is more than the root of a number."""
    if not gap.radius:
        return gap.minimum.squared > squared
    least = gap.minimum.distance + gap.radius
    return least.sign_of((-ZZ(squared.numerator), ZZ(0), ZZ(squared.denominator))) > 0


def _time_in(piece: ClearancePiece, random: Random) -> QQ:
    """Return a time inside of a piece, often near one of its ends."""
    time = rational_between(piece.start, piece.end)
    is_early = random.random() < 0.5
    for _ in range(random.choice([0, 1, HALVINGS])):
        here = AlgebraicNumber(time)
        low, high = (piece.start, here) if is_early else (here, piece.end)
        time = rational_between(low, high)
    return time


def _check_piece(scene: Scene, gap: Clearance, piece: ClearancePiece, time: QQ) -> None:
    """Compare the nearest features of a piece with the definition at a time in it."""
    expected = _check_at(scene, gap, time)
    meet = expected.core_squared <= gap.radius**2
    if piece.features is None or meet:
        check_equal("meeting", piece.features is None, meet)
        return
    a, b = scene.body(gap.a), scene.body(gap.b)
    first, second = (Place(*feature) for feature in piece.features)
    if (first, second) in expected.features:
        return
    is_at_an_end = not expected.features.isdisjoint(product(_ends(a, first), _ends(b, second)))
    by_definition = (reference.nearest(a, b, fraction(t)).features for t in _some_times(piece))
    if not is_at_an_end or all((first, second) not in pairs for pairs in by_definition):
        raise Difference("features", f"{first, second} at {time}, not {expected.features}")


def _ends(body: Body, place: Place) -> list[Place]:
    """Return the ends of an edge, or a vertex alone."""
    if place.edge is None:
        return [place]
    return [Place(end, None) for end in body.edges[place.edge]]


def _some_times(piece: ClearancePiece) -> Iterator[QQ]:
    """Yield times in a piece, more than those at which the nearest point is an end of the edge.

    It is an end at single times only: if it is one for all t, two vertices are nearest.
    """
    now = piece.start
    for _ in range(INSTANTS):
        time = rational_between(now, piece.end)
        yield time
        now = AlgebraicNumber(time)


def surroundings_are_of_each_pair(scene: Scene, random: Random) -> str:
    """What is near a body, and when, follows from its clearance to each of the others alone."""
    pairs = [{a.name, b.name} for a, b in reference.counted_pairs(scene)]
    refuse_unless(pairs)
    names = [body.name for body in scene.bodies]
    name = random.choice([name for name in names if any(name in pair for pair in pairs)])
    others = [other for other in names if {name, other} in pairs]
    around = exactpt.clearance(scene, name)
    alone = {other: exactpt.clearance(scene, name, other) for other in others}
    check_equal("others", around.others, tuple(others))
    least = min((gap.minimum.squared, gap.minimum.time) for gap in alone.values())
    check_equal("minimum", (around.minimum.squared, around.minimum.time), least)
    of_least = [other for other in others if alone[other].minimum[::-1] == least]
    check_equal("body of the minimum", around.minimum.body, of_least[0])
    at = fraction(a_time(scene, random))
    distances = {other: exactpt.distance(scene, name, other, at=at) for other in others}
    nearest = min(others, key=lambda other: _exactly(distances[other]))
    check_equal("nearest", around.nearest(at), (nearest, distances[nearest]))
    _check_order(scene, random)
    check_equal("double", around(at), min(gap(at) for gap in alone.values()))
    distance = _a_distance_of(around, random)
    near = [interval for gap in alone.values() for interval in gap.below(distance)]
    check_equal("below", around.below(distance), tuple(sorted(near, key=_start_of)))
    return f"{min(len(near), 4)} intervals"


def _check_order(scene: Scene, random: Random) -> None:
    """Check that distances of pairs of bodies at some times are ordered by their exact values."""
    times = [fraction(a_time(scene, random, STEPS)) for _ in range(TIMES)]
    pairs = [(a.name, b.name) for a, b in reference.counted_pairs(scene)]
    some = random.sample(pairs, min(TIMES, len(pairs)))
    distances = [exactpt.distance(scene, *pair, at=at) for at in times for pair in some]
    check_equal("order", sorted(distances), sorted(distances, key=_exactly))


def _exactly(there: exactpt.Distance) -> AlgebraicNumber:
    """Return a distance as an exact number."""
    root = square_root(AlgebraicNumber(there.core_squared))
    return max(root - there.radius, AlgebraicNumber(0))


def _a_distance_of(around: exactpt.Surroundings, random: Random) -> Fraction:
    """Return a distance: the least one if it is rational, in half of the cases."""
    least = around.minimum.distance.simplified()
    if least.is_rational and random.random() < 0.5:
        return fraction(least.exact_low)
    return fraction(random.choice(DISTANCES))


def _start_of(interval: CloseInterval) -> AlgebraicNumber:
    return interval.start
