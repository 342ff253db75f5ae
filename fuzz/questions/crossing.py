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
from itertools import count, pairwise, product
from typing import TypeAlias

from exactpt.kernel.numbers import QQ

__all__ = ["chains_cross"]

Point: TypeAlias = tuple[QQ, QQ]
Path: TypeAlias = Sequence[Point]


def chains_cross(p: Path, q: Path) -> bool:
    """Return True if two simple chains cross."""
    u, v = _refined(p, q), _refined(q, p)
    return any(_crossings(a, b) % 2 for a, b in _pieces(u, v))


def _refined(p: Path, q: Path) -> list[Point]:
    """Return a chain with the points at which edges of another one end on it or cross it."""
    found = [p[0]]
    for a, b in pairwise(p):
        cuts = {b, *(c for c in q if _is_on(c, a, b))}
        for c, d in pairwise(q):
            sides = [_side(a, b, c), _side(a, b, d), _side(c, d, a), _side(c, d, b)]
            if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
                part = sides[0] / (sides[0] - sides[1])
                cuts.add((c[0] + part * (d[0] - c[0]), c[1] + part * (d[1] - c[1])))
        found += sorted(cuts - {a}, key=lambda c: abs(c[0] - a[0]) + abs(c[1] - a[1]))
    return found


def _pieces(u: Path, v: Path) -> Iterator[tuple[Path, Path]]:
    """Return both paths along each common piece without an end of a chain, and a bit beyond."""
    i = 0
    while i < len(u):
        j = i
        if u[i] in v:
            while j + 1 < len(u) and any(_is_on(_middle(u[j], u[j + 1]), *e) for e in pairwise(v)):
                j += 1
            numbers = [k for k, at in enumerate(v) if at in u[i : j + 1]]
            first, last = min(numbers), max(numbers)
            if i > 0 and first > 0 and j + 1 < len(u) and last + 1 < len(v):
                yield _around(u, i, j), _around(v, first, last)
        i = j + 1


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
            (_side(a, b, c), _side(a, b, d), _side(c, d, a), _side(c, d, b))
            for (a, b), (c, d) in product(pairwise(p), pairwise(moved))
        ]
        if all(map(all, sides)):
            return sum(s[0] * s[1] < 0 and s[2] * s[3] < 0 for s in sides)
    raise AssertionError("only some directions are those of edges, or from vertex to vertex")


def _squared(v: Point, a: Point, b: Point) -> QQ:
    """Return the squared distance of a point from a segment."""
    x, y, u, w = b[0] - a[0], b[1] - a[1], v[0] - a[0], v[1] - a[1]
    along = min(max((x * u + y * w) / (x * x + y * y), QQ(0)), QQ(1))
    return (u - along * x) ** 2 + (w - along * y) ** 2


def _is_on(v: Point, a: Point, b: Point) -> bool:
    return _side(a, b, v) == 0 and min(a, b) <= v <= max(a, b)


def _side(a: Point, b: Point, c: Point) -> QQ:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
