"""How far a body may be from where its rational pieces put it.

Let a be the angle by which the pieces of a `Spin` turn, and a' = omega t the true one. About the
pivot, a point at a distance r from it is turned by a or by a' to points 2 r sin(|a - a'| / 2) <= r
|a - a'| apart; the translation that follows is the same. The distance from the pivot is convex, so
on an edge it is largest at a vertex. The pieces of a `PosePath` turn about its pivot likewise;
their translation has an error of its own, and the two errors add up. The pieces of a `Spline` are
translated, with an error.

**At one time**, a body may be known better. Of an error, a part may be proved: that of fitting
rational pieces to the given formula. It is 0 where the formula itself is rational. The rest is
assumed: a caller stated it, or it was made when a curve was closed up, or angles were unwrapped.
Nothing is known of it but its size, so it counts at every time, also at the start of a scene.
At a time t where the formula has the angle 0, the cosine and the sine are rational. So the body is
put where the formula puts it, not the pieces, and only the assumed part of the error is left: the
assumed place error, and r times the assumed angle error, now with the largest distance r from the
pivot at t.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple, final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, ceil, exponent, power_of_two
from exactpt.kernel.polynomial import Polynomial
from exactpt.kernel.square_root import root_bounds
from exactpt.motion.body import Body
from exactpt.motion.local_time import Spline
from exactpt.motion.motions import Motion, Piecewise, Translation
from exactpt.motion.pose_path import PosePath
from exactpt.motion.spin import Spin
from exactpt.motion.turned_angle import bound_on

BITS: Final = 24
"""Significant bits of a displacement, which is rounded up."""


@final
class Placed(NamedTuple):
    """A body whose true place at a time is known within an error.

    Attributes:
        body: the body where it is put at that time.
        error: the largest distance of one of its points from the true one.
    """

    body: Body
    error: QQ


def displacement(body: Body, start: QQ, end: QQ) -> QQ:
    """Return a bound on how far a point of a body is from its true place, at any time of a span.

    At most 1 + 2^-20 times the largest distance from the pivot (of vertices that deform along
    polynomials: times that of their Bernstein coefficients) times the error of the angle, and the
    place error of a path or the error of a spline; 0 for all other motions.
    """
    motion = body.motion
    if isinstance(motion, Spline):
        off = motion.exact_error
    elif isinstance(motion, PosePath):
        off = motion.exact_place_error + _longest_arm(body, motion, start, end) * motion.exact_error
    elif isinstance(motion, Spin):
        off = _longest_arm(body, motion, start, end) * motion.exact_error
    else:
        return QQ(0)
    return _rounded_up(off) if off else off


def has_assumed_error(motion: Motion) -> bool:
    """Return True if a motion has an error that is not proved: a stated one, or of a closed curve.

    >>> path = PosePath([0, 1], [([0, 1], 0, [0, 1])])
    >>> has_assumed_error(path), has_assumed_error(path.with_place_error("1/10"))
    (False, True)
    """
    return isinstance(motion, Piecewise) and any(motion.exact_assumed_errors())


def placed_at(body: Body, t: QQ, displacement: QQ) -> Placed:
    """Return where a body is known best at a time.

    Args:
        body: the body.
        t: the time.
        displacement: a bound on how far its points are from their true places, at t too.
    """
    motion = body.motion
    unturned = _unturned(motion, t)
    if unturned is None:
        return Placed(body, displacement)
    error = QQ(0)
    if isinstance(motion, PosePath):
        error, angle_error = motion.exact_assumed_errors()
        if angle_error:
            error += _longest_arm(body, motion, t, t) * angle_error
    return Placed(body.with_motion(unturned), error)


def _unturned(motion: Motion, t: QQ) -> Translation | None:
    """Return a translation to where a formula puts a body at t; None if it turns, or is exact."""
    if isinstance(motion, PosePath):
        x, y, angle = motion.exact_pose(t)
        return None if angle else Translation([x], [y])
    if isinstance(motion, Spin):
        return None if motion.exact_omega * t else Translation(motion.x, motion.y)
    return None


def _longest_arm(body: Body, turning: Spin | PosePath, start: QQ, end: QQ) -> QQ:
    """Return a bound on the distance of points of a body from the pivot of its motion."""
    return root_bounds(max(_squared_arms(body, turning.exact_pivot, start, end))).high


def _squared_arms(body: Body, pivot: Point, start: QQ, end: QQ) -> Iterator[QQ]:
    """Yield bounds on the squared distances of the vertices from the pivot, in the rest frame.

    Between keyframes a vertex moves on a segment.
    """
    x, y = pivot
    for frame in body.exact_shape.keyframes:
        for u, v in frame.vertices:
            yield (QQ(u) - x) ** 2 + (QQ(v) - y) ** 2
    for px, py in body.exact_shape.positions:
        dx, dy = px - Polynomial([x]), py - Polynomial([y])
        yield bound_on(dx * dx + dy * dy, start, end)


def _rounded_up(value: QQ) -> QQ:
    unit = power_of_two(exponent(value) - BITS)
    return ceil(value / unit) * unit
