"""A test if two simple chains cross, by counting: move one of them a little.

A connected piece C that the chains have in common is a path in both. If an end of a chain is in
C, they do not cross there: that chain does not divide the neighbourhood of C, and leaves C at one
end at most. Else take C and a bit of each chain on both sides of it. These two paths share C alone,
and their ends are not on the other path. Move one by less than the distance of any end from the
other path, in a direction such that edges cross at inner points only. While it moves, no end
comes to the other path, so the number of crossings stays even, or stays odd. It is odd if and only
if the two bits are on different sides.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import count, pairwise, product
from typing import TypeAlias

from exactpt.geometry.predicates import Point, crossing_of_lines, orientation
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.testing.reference.shapes import (
    is_on_segment,
    segments_cross,
    squared_distance,
    squared_to_interior,
)

__all__ = ["chains_cross"]

Path: TypeAlias = Sequence[Point]
Given: TypeAlias = "tuple[Rational, Rational]"


def chains_cross(p: Sequence[Given], q: Sequence[Given]) -> bool:
    """Return True if two simple chains cross.

    >>> chains_cross([(0, 0), (2, 2)], [(0, 2), (2, 0)]), chains_cross([(0, 0), (2, 2)], [(0, 0)])
    (True, False)

    Args:
        p: the vertices of one; of a point, one.
        q: those of the other.
    """
    first, second = ([(rational(x), rational(y)) for x, y in chain] for chain in (p, q))
    u, v = _refined(first, second), _refined(second, first)
    return any(_crossings(a, b) % 2 for a, b in _pieces(u, v))


def _refined(p: Path, q: Path) -> list[Point]:
    """Return a chain with the points at which edges of another one end on it or cross it."""
    found = [p[0]]
    for a, b in pairwise(p):
        cuts = {b, *(c for c in q if is_on_segment(c, a, b))}
        crossed = [(c, d) for c, d in pairwise(q) if segments_cross(a, b, c, d)]
        cuts |= {crossing_of_lines(a, b, c, d) for c, d in crossed}
        found += sorted(cuts - {a}, key=partial(squared_distance, a))
    return found


def _pieces(u: Path, v: Path) -> Iterator[tuple[Path, Path]]:
    """Return both paths along each common piece without an end of a chain, and a bit beyond."""
    i = 0
    while i < len(u):
        j = i
        if u[i] in v:
            while j + 1 < len(u) and _is_on_path(_middle(u[j], u[j + 1]), v):
                j += 1
            numbers = [k for k, at in enumerate(v) if at in u[i : j + 1]]
            first, last = min(numbers), max(numbers)
            if i > 0 and first > 0 and j + 1 < len(u) and last + 1 < len(v):
                yield _around(u, i, j), _around(v, first, last)
        i = j + 1


def _is_on_path(v: Point, path: Path) -> bool:
    return any(is_on_segment(v, a, b) for a, b in pairwise(path))


def _around(u: Path, i: int, j: int) -> Path:
    return [_middle(u[i - 1], u[i]), *u[i : j + 1], _middle(u[j], u[j + 1])]


def _middle(a: Point, b: Point) -> Point:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def _crossings(p: Path, q: Path) -> int:
    """Return how many edges cross after the second path has been moved a little."""
    ends = [(end, q) for end in (p[0], p[-1])] + [(end, p) for end in (q[0], q[-1])]
    least = min(_squared(end, a, b) for end, path in ends for a, b in pairwise(path))
    step = QQ(1)
    while 2 * step * step >= least:
        step /= 2
    for k in count(2):
        moved = [(x + step / k, y + step / (k * k + 1)) for x, y in q]
        sides = [
            (orientation(a, b, c), orientation(a, b, d), orientation(c, d, a), orientation(c, d, b))
            for (a, b), (c, d) in product(pairwise(p), pairwise(moved))
        ]
        if all(map(all, sides)):
            return sum(s[0] * s[1] < 0 and s[2] * s[3] < 0 for s in sides)
    raise AssertionError("only some directions are those of edges, or from vertex to vertex")


def _squared(v: Point, a: Point, b: Point) -> QQ:
    """Return the squared distance of a point from a segment."""
    to_interior = squared_to_interior(v, a, b)
    if to_interior is not None:
        return to_interior
    return min(squared_distance(v, a), squared_distance(v, b))
