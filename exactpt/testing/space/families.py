"""Families of hard queries in space.

Each family places four vertices at small integers, or at a contact at a chosen time. `make_query`
then disguises them: a unimodular map, a common motion, the order of the vertices. All numbers are
exact in doubles.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, shorten
from exactpt.testing.space.queries import KINDS, Kind, Point, SpaceQuery

Places: TypeAlias = Sequence[Sequence["QQ | int"]]
Motion: TypeAlias = tuple[Places, Places]
"""Four points at t = 0, and the same at t = 1."""
Family: TypeAlias = Callable[[Random, bool], Motion]
"""Makes a query about a vertex and a face if the second argument is True, else about two edges."""


def generic(rng: Random, is_face: bool) -> Motion:  # noqa: ARG001, FBT001
    """Return vertices at random integers."""
    size = rng.choice([2, 5, 20])
    return _integers(rng, size), _integers(rng, size)


def interior(rng: Random, is_face: bool) -> Motion:  # noqa: FBT001
    """Return a vertex that reaches an inner point of the face, or edges that cross."""
    p, q, r = _integers(rng, 3)[:3]
    if is_face:
        return _through(rng, [[0, 0, 0], [4 * c for c in p], [4 * c for c in q],
                              [-4 * (a + b) for a, b in zip(p, q, strict=True)]])  # fmt: skip
    return _through(rng, [p, [-3 * c for c in p], r, [-c for c in r]])


def boundary(rng: Random, is_face: bool) -> Motion:  # noqa: FBT001
    """Return a vertex that reaches the face's boundary, or an end that reaches an edge."""
    p, q = _integers(rng, 3)[:2]
    s = rng.choice([0, 1, 3])
    if is_face:
        return _through(rng, [[0, 0, 0], p, [-s * c for c in p], q])
    return _through(rng, [[0, 0, 0], q, p, [-s * c for c in p]])


def graze(rng: Random, is_face: bool) -> Motion:  # noqa: FBT001
    """Return a contact at a double root of the cubic, or two near roots, or a near miss."""
    t, size = rng.choice([QQ(1, 4), QQ(1, 2), QQ(3, 4)]), rng.randint(2, 4)
    gap = QQ(rng.choice([0, 0, 1, -1]), 2 ** rng.choice([10, 20, 30, 40]))

    def at(now: int) -> Places:
        slope: QQ = now - t
        if is_face:
            corners = [(-size, -size), (size, -size), (0, size)]
            return [(slope, 0, gap), *((x, y, slope * x) for x, y in corners)]
        ends = [(-size, 0, -size * slope), (size, 0, size * slope)]
        return [*ends, (slope, -size, gap), (slope, size, gap)]

    return at(0), at(1)


def coplanar(rng: Random, is_face: bool) -> Motion:  # noqa: ARG001, FBT001
    """Return vertices that move in one plane: the cubic is identically zero."""
    size = rng.choice([2, 4])
    start, end = _integers(rng, size), _integers(rng, size)
    return [[x, y, 0] for x, y, _ in start], [[x, y, 0] for x, y, _ in end]


def collinear(rng: Random, is_face: bool) -> Motion:  # noqa: ARG001, FBT001
    """Return vertices that move on one line."""
    start, end = _integers(rng, 3), _integers(rng, 3)
    return [[p[0], 0, 0] for p in start], [[p[0], 0, 0] for p in end]


def degenerate(rng: Random, is_face: bool) -> Motion:  # noqa: ARG001, FBT001
    """Return a face that is a segment, or an edge that is a point, at all times or at one."""
    start, end = (_integers(rng, 2) for _ in range(2))
    for points in rng.choice([(start, end), (start,), (end,)]):
        points[3] = points[2]
    return start, end


def opposite(rng: Random, is_face: bool) -> Motion:  # noqa: ARG001, FBT001
    """Return vertices of which several collapse or reverse during the motion."""
    start = _integers(rng, 2)
    return start, [[c * rng.choice([-1, 0, 1]) for c in p] for p in start]


def far(rng: Random, is_face: bool) -> Motion:  # noqa: FBT001
    """Return a contact on the boundary, far from the origin, missed by little or not at all."""
    start, end = boundary(rng, is_face)
    place = [rng.choice([1, -1]) * 2 ** rng.randint(20, 40) for _ in range(3)]
    near = QQ(rng.choice([0, 0, 1, -1]), 2**10)
    moved = [[[c + d for c, d in zip(p, place, strict=True)] for p in points]
             for points in (start, end)]  # fmt: skip
    for points in moved:
        points[0][2] += near
    return moved[0], moved[1]


FAMILIES: Final[dict[str, Family]] = {
    f.__name__: f
    for f in (
        generic, interior, boundary, graze, coplanar, collinear, degenerate, opposite, far,
    )
}  # fmt: skip


def make_query(kind: Kind, family: str, seed: int = 0, number: int = 0) -> SpaceQuery:
    """Return a query of a family, the same on every machine.

    Args:
        kind: "vertex-face" or "edge-edge".
        family: one of `FAMILIES`.
        seed: the seed of a series of queries.
        number: the number of the query in the series.

    Raises:
        InputError: for an unknown kind or family.
    """
    if kind not in KINDS:
        raise InputError(f"kind: expected one of {', '.join(KINDS)}, got {shorten(kind)}")
    if family not in FAMILIES:
        raise InputError(f"no family {shorten(family)}; there are: {', '.join(FAMILIES)}")
    name = f"{family}:{seed}:{number}"
    rng = Random(f"{kind}:{name}")
    start, end = FAMILIES[family](rng, kind == "vertex-face")
    return _disguised(rng, kind, start, end, name)


def _disguised(rng: Random, kind: Kind, start: Places, end: Places, name: str) -> SpaceQuery:
    """Return the query after a unimodular map, a common motion and a new order of its vertices."""
    axes, i, j = rng.sample(range(3), 3), *rng.sample(range(3), 2)
    shear, signs = rng.choice([0, 0, 1, -2]), [rng.choice([1, -1]) for _ in range(3)]
    offset = _integers(rng, 3)[:2]
    if kind == "vertex-face":
        order = [0, *rng.sample([1, 2, 3], 3)]
    else:
        pairs = [rng.sample([0, 1], 2), rng.sample([2, 3], 2)]
        order = [k for pair in rng.sample(pairs, 2) for k in pair]

    def mapped(points: Places, move: Sequence[int]) -> tuple[Point, ...]:
        result = []
        for k in order:
            p = [points[k][axis] * s for axis, s in zip(axes, signs, strict=True)]
            p[i] += shear * p[j]
            x, y, z = (float(c + d) for c, d in zip(p, move, strict=True))
            result.append((x, y, z))
        return tuple(result)

    return SpaceQuery(kind, mapped(start, offset[0]), mapped(end, offset[1]), name)


def _through(rng: Random, places: Places) -> Motion:
    """Return random motions in which the vertices are at the given places at one time."""
    t = rng.choice([QQ(0), QQ(1, 4), QQ(1, 2), QQ(3, 4), QQ(1)])
    speeds = [[4 * c for c in p] for p in _integers(rng, 3)]
    start, end = (
        [
            [c + (now - t) * v for c, v in zip(p, w, strict=True)]
            for p, w in zip(places, speeds, strict=True)
        ]
        for now in (0, 1)
    )
    return start, end


def _integers(rng: Random, size: int) -> list[list[int]]:
    return [[rng.randint(-size, size) for _ in range(3)] for _ in range(4)]
