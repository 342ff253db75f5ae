"""How near two bodies are at a time, and when they are nearest."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from exactpt.kernel.numbers import QQ, Rational, fraction, rational
from exactpt.motion.body import Body
from exactpt.testing.reference.shapes import bodies_meet, squared_distance, squared_to_interior

__all__ = ["Nearest", "Place", "nearest"]


class Place(NamedTuple):
    """A vertex of a body, or the inside of one of its edges, by its number; the other is None."""

    vertex: int | None
    edge: int | None


class Nearest(NamedTuple):
    """The distance of two bodies at a time.

    Attributes:
        core_squared: the square of the distance of the cores, the bodies without their radii.
        features: all pairs of places at that distance, of the first body and of the second. None
            if cores share a point, but no vertex of one of them is on the other's boundary.
    """

    core_squared: Fraction
    features: frozenset[tuple[Place, Place]]


def nearest(a: Body, b: Body, at: Rational) -> Nearest:
    """Return the distance of two bodies at a rational time.

    >>> from exactpt import Body
    >>> found = nearest(Body("a", [(0, 0), (4, 0)]), Body("b", [(1, 3)]), 0)
    >>> found.core_squared, [*found.features]
    (Fraction(9, 1), [(Place(vertex=None, edge=0), Place(vertex=0, edge=None))])

    Args:
        a: a body.
        b: another one.
        at: the time.
    """
    t = rational(at)
    p, q = a.exact_at(t), b.exact_at(t)
    found = [*_distances(a, b, p, q)]
    least = min(squared for squared, _ in found)
    if least and bodies_meet(a, p, b, q):
        return Nearest(Fraction(0), frozenset())
    features = frozenset(pair for squared, pair in found if squared == least)
    return Nearest(fraction(least), features)


def _distances(
    a: Body, b: Body, p: list[tuple[QQ, QQ]], q: list[tuple[QQ, QQ]]
) -> Iterator[tuple[QQ, tuple[Place, Place]]]:
    """Yield the squared distance of every two vertices, and of every vertex above an edge."""
    for (i, u), (j, v) in product(enumerate(p), enumerate(q)):
        yield squared_distance(u, v), (Place(i, None), Place(j, None))
    for (i, u), (e, (k, l)) in product(enumerate(p), enumerate(b.edges)):
        squared = squared_to_interior(u, q[k], q[l])
        if squared is not None:
            yield squared, (Place(i, None), Place(None, e))
    for (e, (k, l)), (j, v) in product(enumerate(a.edges), enumerate(q)):
        squared = squared_to_interior(v, p[k], p[l])
        if squared is not None:
            yield squared, (Place(None, e), Place(j, None))
