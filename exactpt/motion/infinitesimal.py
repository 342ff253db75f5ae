"""Degenerate bodies as rings around an infinitesimal interior.

A point becomes a triangle, a segment a rectangle, an open chain a strip with blunt ends:
several vertices of the ring are infinitesimal copies of one vertex of the scene. A copy has
the direction of its infinitesimal displacement, which decides in which directions a line
may be tangent to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, negate, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.track import Track, difference

Direction: TypeAlias = tuple[IntPoly, IntPoly]
"""A direction (dx, dy), polynomials in t."""

# A triangle without a side in a direction that is frequent among rows and columns of points.
_POINT_DISPLACEMENTS: Final = ((-3, 1), (1, -4), (2, 3))


def ring_of_copies(size: int) -> list[int]:
    """Return the vertices of the scene along the ring of a degenerate body, counter-clockwise.

    The ring of a chain goes from the left of its first vertex to the right of it, along the
    right side to the last vertex, and back along the left side. (An end with a single copy
    would not do: seen from a point on the line of the last edge, it lies in the direction of
    both sides, and neither has a corner there.)
    """
    if size == 1:
        return [0, 0, 0]
    return [0, *range(size), *range(size - 1, 0, -1)]


class Displacements(NamedTuple):
    """The displacements of the vertices of a ring, and the time up to which they hold.

    A displacement lies to the left of both edges of the chain at its vertex, or to the
    right of both. ``until`` is None if they hold during the whole requested time.
    """

    directions: list[Direction]
    until: QQ | None


def displacements(tracks: Sequence[Track], start: QQ, end: QQ) -> Displacements:
    """Return the displacements of a degenerate body.

    Args:
        tracks: the trajectories of its vertices in the scene.
        start: the time just after which the displacements begin to hold.
        end: the time up to which they are needed.
    """
    if len(tracks) == 1:
        return Displacements(
            [((ZZ(right),), (ZZ(up),)) for right, up in _POINT_DISPLACEMENTS], None
        )
    edges = [_direction(p, q) for p, q in pairwise(tracks)]
    lefts = [_turned(edges[0])]
    until: QQ | None = None
    for d, e in pairwise(edges):
        o, its_end = _left_of_both(d, e, start, end)
        lefts.append(o)
        if its_end is not None and (until is None or its_end < until):
            until = its_end
    lefts.append(_turned(edges[-1]))
    return Displacements([lefts[0], *map(_minus, lefts), *reversed(lefts[1:])], until)


def _left_of_both(d: Direction, e: Direction, start: QQ, end: QQ) -> tuple[Direction, QQ | None]:
    """Return a direction to the left of two successive edges d and e, and the end of its validity.

    While d x e keeps its sign s, s (e - d) is one: d x (e - d) = d x e = e x (e - d).
    While d . e is positive, d turned left is one: e x (d turned left) = e . d. Where the
    first ends, the second holds, and vice versa; else e lies on d, or is a point,
    and that is a contact. So the one that ends later is taken, up to a time at which the
    other holds already.
    """
    turn = subtract(multiply(d[0], e[1]), multiply(d[1], e[0]))
    along = add(multiply(d[0], e[0]), multiply(d[1], e[1]))
    now = AlgebraicNumber(start)
    s = now.sign_after(turn) if turn else 0
    turn_ends, along_ends = _first_root(turn, now, end), _first_root(along, now, end)
    # At the start itself, s (e - d) points along the chain if that is straight, and d turned
    # left points along e if the angle is right.
    turn_is_first = now.sign_of(turn) == 0 or (
        turn_ends is not None and (along_ends is None or turn_ends.compare(along_ends) < 0)
    )
    straight = not s or (turn_is_first and now.sign_of(along) > 0)
    if straight:
        if along_ends is None or along_ends.sign_of(turn) == 0:
            return _turned(d), None
        return _turned(d), _before(along_ends, turn, now, end)
    o = subtract(e[0], d[0]), subtract(e[1], d[1])
    if s < 0:
        o = _minus(o)
    if turn_ends is None or turn_ends.sign_of(along) <= 0:
        return o, None
    return o, _before(turn_ends, along, now, end)


def _first_root(f: IntPoly, now: AlgebraicNumber, end: QQ) -> AlgebraicNumber | None:
    root = next(roots_after(f, now, end), None) if f else None
    return None if root is None else root.time


def _before(time: AlgebraicNumber, f: IntPoly, now: AlgebraicNumber, end: QQ) -> QQ:
    """Return a rational time before ``time`` and after all zeros of f before ``time``."""
    last = now
    for root in roots_after(f, now, end) if f else ():
        if root.time.compare(time) >= 0:
            break
        last = root.time
    return rational_between(last, time)


def _direction(p: Track, q: Track) -> Direction:
    return difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)


def _turned(d: Direction) -> Direction:
    """Return the direction d turned left by a right angle."""
    return negate(d[1]), d[0]


def _minus(d: Direction) -> Direction:
    return negate(d[0]), negate(d[1])
