"""Thin bodies: rings around an infinitesimal inside, told by the offsets of their vertices.

A point becomes a triangle, a segment a rectangle, an open chain a strip with blunt ends;
several vertices of a ring are then copies of one vertex of the scene. A copy has
the direction of its offset, which says only in which directions a line may touch it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, negate, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.incidence import difference
from exactpt.motion.track import Track

__all__ = ["Offset", "Offsets", "thin_offsets", "thin_ring"]

Offset: TypeAlias = tuple[IntPoly, IntPoly]
"""A direction (dx, dy), polynomials in t."""

# A triangle with no side in a direction that rows and columns of points have.
_POINT_OFFSETS: Final = ((-3, 1), (1, -4), (2, 3))


def thin_ring(size: int) -> list[int]:
    """The vertices of the scene around a thin body, counter-clockwise.

    A chain goes from the left of its first vertex to the right of it, along its right side
    to its last vertex, and back along its left. (A pointed end would not do: what lies on
    the line of the last edge sees it in a direction of both sides, and on neither is the
    angle a corner.)
    """
    if size == 1:
        return [0, 0, 0]
    return [0, *range(size), *range(size - 1, 0, -1)]


class Offsets(NamedTuple):
    """The offsets of the vertices of a ring, and the time up to which they hold (None: for ever).

    An offset is on the left, or on the right, of both edges of the chain at its vertex.
    """

    directions: list[Offset]
    until: QQ | None


def thin_offsets(tracks: Sequence[Track], start: QQ, end: QQ) -> Offsets:
    """The offsets of a thin body.

    Args:
        tracks: of the vertices of the scene.
        start: the time just after which the offsets begin to hold.
        end: the time up to which they are needed.
    """
    if len(tracks) == 1:
        return Offsets([((ZZ(right),), (ZZ(up),)) for right, up in _POINT_OFFSETS], None)
    edges = [_direction(p, q) for p, q in pairwise(tracks)]
    lefts = [_turned(edges[0])]
    until: QQ | None = None
    for d, e in pairwise(edges):
        o, its_end = _left_of_both(d, e, start, end)
        lefts.append(o)
        if its_end is not None and (until is None or its_end < until):
            until = its_end
    lefts.append(_turned(edges[-1]))
    return Offsets([lefts[0], *map(_minus, lefts), *reversed(lefts[1:])], until)


def _left_of_both(d: Offset, e: Offset, start: QQ, end: QQ) -> tuple[Offset, QQ | None]:
    """A direction on the left of two successive edges d and e, and how long it is.

    While d x e keeps its sign s, that is s (e - d): d x (e - d) = d x e = e x (e - d).
    While d . e is positive, that is d turned left: e x (d turned left) = e . d. Where the
    first ends, the second holds, and the other way round; else e lies on d, or is a point,
    and that is a contact. So the one that ends later is taken, up to a time at which the
    other holds already.
    """
    turn = subtract(multiply(d[0], e[1]), multiply(d[1], e[0]))
    along = add(multiply(d[0], e[0]), multiply(d[1], e[1]))
    now = AlgebraicNumber(start)
    s = now.sign_after(turn) if turn else 0
    turn_ends, along_ends = _first_root(turn, now, end), _first_root(along, now, end)
    # At the start itself, if the chain is straight then, s (e - d) points along it; and if
    # it has a right angle, d turned left points along e.
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
    """A rational time before a time, later than all zeros of f before it."""
    last = now
    for root in roots_after(f, now, end) if f else ():
        if root.time.compare(time) >= 0:
            break
        last = root.time
    return rational_between(last, time)


def _direction(p: Track, q: Track) -> Offset:
    return difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)


def _turned(d: Offset) -> Offset:
    """d turned left by a right angle."""
    return negate(d[1]), d[0]


def _minus(d: Offset) -> Offset:
    return negate(d[0]), negate(d[1])
