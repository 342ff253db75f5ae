"""New motions for bodies: the conditions, and motions whose coefficients do not grow.

A new motion starts at a rational time t, at which it must leave every vertex in place. All
coordinates are exact; so if each motion were computed from positions that result from earlier
motions, its coefficients could become ever longer. `onward` avoids this by a translation whose
velocity is rounded to a grid of step 2^-g. Its constant term is

    position(t) - velocity * t = (old constant) + (old velocity - velocity) * t,

so if t is a multiple of 2^-m, the constant terms of all such translations are multiples of
2^-(g + m), plus the rest position. Only the new velocity is rounded: the position at time t is
exact, and all decisions refer to the motion as given.
"""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    floor,
    power_of_two,
    rational,
    rationals,
    shorten,
    show,
)
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.course import jump
from exactpt.motion.motions import Affine, Motion, Pieces, Rigid, SimpleMotion, Translation
from exactpt.motion.spin import Spin
from exactpt.motion.stated_errors import NONE_STATED

GRID = power_of_two(-20)
"""Default grid of velocities."""


def with_new_motion(body: Body, motion: Motion | Body, t: QQ) -> Body:
    """Return a body with a new motion from a time on; it is known no better than before.

    What is assumed of the old motion becomes an error that is stated of the body, unless the
    caller gives a body, which states its own errors.

    Args:
        body: the body with its current motion.
        motion: a motion of the same shape (vertices or keyframes), or another body of the same
            name and number of vertices.
        t: the time.

    Raises:
        InputError: if the motion is for another kind of body, or a vertex would jump.
    """
    if isinstance(motion, Body):
        new = motion
        if (new.name, new.closed, new.parts) != (body.name, body.closed, body.parts):
            raise InputError(
                f"body {shorten(body.name)}: {shorten(new)} is not a motion of {shorten(body)}"
            )
    else:
        new = continued(body, motion)
    if _moves_on(body, new, t):
        return new
    for i, (p, q) in enumerate(zip(body.exact_at(t), new.exact_at(t), strict=True)):
        if p != q:
            raise InputError(
                f"body {shorten(body.name)}: vertex {i} {jump(t, p, q)}; "
                f"exactpt.onward continues from where the body is"
            )
    return new


def _moves_on(body: Body, new: Body, t: QQ) -> bool:
    """Return True if a shape is translated before and after a time, by one vector there."""
    before, after = body.exact_piece_after(t).motion, new.exact_piece_after(t).motion
    return (
        body.exact_shape is new.exact_shape
        and isinstance(before, Translation)
        and isinstance(after, Translation)
        and before.exact_at(t) == after.exact_at(t)
    )


def round_to_grid(value: Rational, grid: Rational = GRID) -> QQ:
    """Return the multiple of ``grid`` nearest to a number; the larger of two.

    Raises:
        InputError: if the grid is not positive.
    """
    step = rational(grid)
    if step <= 0:
        raise InputError(f"a grid is positive: {show(step)}")
    return floor(rational(value) / step + QQ(1, 2)) * step


def onward(
    body: Body, t: Rational, velocity: Sequence[Rational], *, grid: Rational = GRID
) -> Motion:
    """Return the motion by which a body continues from its position with a new velocity.

    The translation becomes linear; rotation or affine deformation continues unchanged. For a
    motion in pieces this applies to all pieces from t on. A `Spin` turns on as before, within its
    error. The pieces of a path or a spline continue without its error; `Bounce` states the part of
    it that is assumed of the body.

    Args:
        body: the body whose motion is replaced.
        t: the rational time; dyadic if coefficients are to stay short.
        velocity: the velocity (x, y), rounded to the grid.
        grid: a positive rational; a power of two if coefficients are to stay short.

    Raises:
        InputError: if the motion is of a user-defined class, whose translation is unknown.
    """
    now = rational(t)
    vx, vy = rationals(velocity, 2, "a velocity has two coordinates")
    x, y = (
        Polynomial([f.exact_at(now) - v * now, v])
        for f, v in zip(
            translation_at(body, now),
            (round_to_grid(vx, grid), round_to_grid(vy, grid)),
            strict=True,
        )
    )
    motion = body.motion
    if isinstance(motion, Spin):
        return motion.with_translation(x, y)
    if not isinstance(motion, Pieces):
        return _translated(body.exact_piece_after(now).motion, x, y)
    ends = (*motion.exact_until, None)
    return Pieces(
        [
            (end, _translated(part, x, y))
            for end, part in zip(ends, motion.motions, strict=True)
            if end is None or end > now
        ]
    )


def continued(body: Body, motion: Motion) -> Body:
    """Return a body that goes on with another motion, and is known no better than before.

    What is assumed of its old motion, such as by `PosePath.with_place_error`, becomes an error that
    is stated of the body.
    """
    assumed = body.exact_errors.plus_assumed_of(body.motion)
    errors = assumed.with_motion(body.motion, motion)
    # Without errors first: they are about a pivot that the motion need not have.
    plain = body.exact_with_errors(NONE_STATED)
    return plain.with_motion(motion).exact_with_errors(errors)


def translation_at(body: Body, t: QQ) -> tuple[Polynomial, Polynomial]:
    """Return the translational part of a body's motion just after a time."""
    motion = body.exact_piece_after(t).motion
    if isinstance(motion, (Translation, Rigid, Affine)):
        return motion.x, motion.y
    raise InputError(f"a motion of this kind has no translation: {shorten(motion)}")


def translation_velocity(body: Body, t: QQ | AlgebraicNumber) -> tuple[QQ, QQ]:
    """Return the velocity that the motion's translation gives to every vertex just after a time.

    Raises:
        InputError: if the time is irrational, and the velocity is not constant there.
    """
    if isinstance(t, AlgebraicNumber):
        t = t.simplified()
        near = t.exact_low if t.is_rational else body.exact_last_breakpoint(t, t.exact_low)
        if not t.is_rational and any(f.degree > 1 for f in translation_at(body, near)):
            raise InputError(
                f"body {shorten(body.name)}: its velocity at the irrational time {float(t)!r} is "
                f"not rational; run to a rational time before it"
            )
        t = near
    x, y = translation_at(body, t)
    return x.derivative().exact_at(t), y.derivative().exact_at(t)


def _translated(motion: SimpleMotion, x: Polynomial, y: Polynomial) -> SimpleMotion:
    """Return the same motion with another translation."""
    if isinstance(motion, Rigid):
        turned = motion.exact_orientation
        return Rigid(motion.half_turn, pivot=motion.exact_pivot, x=x, y=y, orientation=turned)
    if isinstance(motion, Affine):
        return Affine(motion.matrix, x=x, y=y)
    return Translation(x, y)
