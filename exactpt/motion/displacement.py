"""How far a body that turns by a true angle may be from where its rational pieces put it.

Let a be the angle by which the pieces of a `Spin` turn, and a' = omega t the true one (before the
span and after it, that at its start and at its end). About the pivot, a point at a distance r from
it is turned by a or by a' to points 2 r sin(|a - a'| / 2) <= r |a - a'| apart; the translation
that follows is the same. The distance from the pivot is convex, so on an edge it is largest at a
vertex. The pieces of a `PosePath` turn about the origin likewise; their translation has an error of
its own, and the two errors add up.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, ceil, exponent, isqrt, power_of_two
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Rigid
from exactpt.motion.pose_path import PosePath
from exactpt.motion.spin import Spin
from exactpt.motion.turned_angle import bound_on

BITS: Final = 24
"""Significant bits of a displacement, which is rounded up."""


def displacement(body: Body, start: QQ, end: QQ) -> QQ:
    """Return a bound on how far a point of a body is from its true place, at any time of a span.

    At most 1 + 2^-20 times the largest distance from the pivot (of vertices that deform along
    polynomials: times that of their Bernstein coefficients) times the error of the angle, and the
    place error of a path; 0 if the motion is neither a `Spin` nor a `PosePath`.
    """
    motion = body.motion
    if not isinstance(motion, (Spin, PosePath)):
        return QQ(0)
    pivot = next(turn._pivot for turn in motion.motions if isinstance(turn, Rigid))
    squared = max(_squared_arms(body, pivot, start, end))
    off = motion._place_error if isinstance(motion, PosePath) else QQ(0)
    if squared:
        off += _root_above(squared) * motion._error
    return _rounded_up(off) if off else off


def _squared_arms(body: Body, pivot: Point, start: QQ, end: QQ) -> Iterator[QQ]:
    """Yield bounds on the squared distances of the vertices from the pivot, in the rest frame.

    Between keyframes a vertex moves on a segment.
    """
    x, y = pivot
    for frame in body._shape.keyframes:
        for u, v in frame.vertices:
            yield (QQ(u) - x) ** 2 + (QQ(v) - y) ** 2
    for px, py in body._shape.positions:
        dx, dy = px - Polynomial([x]), py - Polynomial([y])
        yield bound_on(dx * dx + dy * dy, start, end)


def _root_above(value: QQ) -> QQ:
    """Return an upper bound on a square root, at most 1 + 2^-21 times it."""
    unit = power_of_two(2 * (exponent(value) // 2 - BITS))
    return QQ(isqrt(ceil(value / unit)) + 1) * power_of_two(exponent(value) // 2 - BITS)


def _rounded_up(value: QQ) -> QQ:
    unit = power_of_two(exponent(value) - BITS)
    return ceil(value / unit) * unit
