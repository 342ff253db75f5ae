"""Places on the integer lattice, and three of them: a point and the ends of a segment."""

from __future__ import annotations

from typing import TypeAlias

Place: TypeAlias = tuple[int, int]
Corners: TypeAlias = tuple[Place, Place, Place]


def plus(a: Place, b: Place) -> Place:
    """a + b."""
    return a[0] + b[0], a[1] + b[1]


def minus(a: Place, b: Place) -> Place:
    """a - b."""
    return a[0] - b[0], a[1] - b[1]


def times(a: Place, k: int) -> Place:
    """k times a."""
    return a[0] * k, a[1] * k


def mean(a: Place, b: Place, sixteenths: int) -> Place:
    """The point between a and b, rounded down to units."""
    x, y = ((u * (16 - sixteenths) + v * sixteenths) // 16 for u, v in zip(a, b, strict=True))
    return x, y


def cross(a: Place, b: Place) -> int:
    """The cross product a x b."""
    return a[0] * b[1] - a[1] * b[0]


def shifted(corners: Corners, by: Place) -> Corners:
    """All corners, moved by an offset."""
    p, a, b = corners
    return plus(p, by), plus(a, by), plus(b, by)
