"""A law about the order of distances, whose values are roots less radii."""

from __future__ import annotations

import sys
from fractions import Fraction
from math import isinf, isqrt, nextafter
from random import Random
from typing import Final, NamedTuple

import exactpt
from exactpt import Distance, Scene
from exactpt.kernel.numbers import fraction
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time, two_names
from fuzz.witnesses import Difference

__all__ = ["distances_are_ordered_as_their_values"]

COUNT: Final = 4
"""Number of distances that are measured in a scene; each one has a near one beside it."""

BITS: Final = 4000
"""Bits of an enclosure: more than a difference of two values that is not 0 has zeros. It is a root
of a polynomial of degree 4, whose coefficients have as many bits as eight numbers of a scene."""

SHIFTS: Final = (Fraction(0), Fraction(1, 3), Fraction(1), Fraction(5, 2), Fraction(-1, 7))
HAIRS: Final = (Fraction(0), Fraction(1, 2**40), Fraction(-1, 2**40), Fraction(-1, 2**90))


class Enclosure(NamedTuple):
    """Two rationals between which a value is, or which it is equal to."""

    low: Fraction
    high: Fraction


def distances_are_ordered_as_their_values(scene: Scene, random: Random) -> str:
    """Distances are ordered as the numbers max(0, sqrt(c) - r) are, and float is the nearest."""
    found = []
    for _ in range(COUNT):
        pair, time = two_names(scene, random), fraction(a_time(scene, random))
        measured = exactpt.distance(scene, *pair, at=time)
        found += [measured, _beside(measured, random)]
    refuse_unless(found)
    values = [_enclosure(one) for one in found]
    ties = 0
    for one, value in zip(found, values, strict=True):
        _check_double(one, value)
        for other, against in zip(found, values, strict=True):
            is_less, is_more = value.high < against.low, against.high < value.low
            ties += one is not other and not is_less and not is_more
            said = (one < other, one <= other, one > other, one >= other)
            expected = (is_less, not is_more, is_more, not is_less)
            check_equal(f"order of {one!r} and {other!r}", said, expected)
    return "some ties" if ties else "no ties"


def _beside(one: Distance, random: Random) -> Distance:
    """Return a distance with another radius that is about as long, or exactly as long."""
    root, shift = _root_below(one.core_squared, 60), random.choice(SHIFTS)
    core = max(Fraction(0), root + shift)
    radius = max(Fraction(0), one.radius + shift)
    return Distance(core**2 + max(-(core**2), random.choice(HAIRS)), (), radius)


def _enclosure(one: Distance) -> Enclosure:
    low = _root_below(one.core_squared, BITS)
    high = low if low**2 == one.core_squared else low + Fraction(1, 2**BITS)
    return Enclosure(max(Fraction(0), low - one.radius), max(Fraction(0), high - one.radius))


def _root_below(square: Fraction, bits: int) -> Fraction:
    """Return a root if it is rational; else the largest multiple of 2^-bits that is less."""
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    if root**2 == square:
        return root
    return Fraction(isqrt(square.numerator * 4**bits // square.denominator), 2**bits)


def _check_double(one: Distance, value: Enclosure) -> None:
    """Check that the double of a distance is not farther from it than its neighbours are.

    Raises:
        Difference: if it is.
    """
    double = float(one)
    if isinf(double):
        if value.high <= sys.float_info.max:
            raise Difference("double", f"{double!r} of {one!r}, which is in the range of doubles")
        return
    off = abs(Fraction(double) - value.low)
    width = value.high - value.low
    for neighbour in (nextafter(double, 0.0), nextafter(double, float("inf"))):
        if isinf(neighbour):
            continue
        if abs(Fraction(neighbour) - value.low) + width < off:
            raise Difference("double", f"{double!r} of {one!r}, but {neighbour!r} is nearer")
