"""New plans for bodies: what is accepted, and how to write plans that stay small.

A plan is taken over at a rational time t, at which it must put every vertex where it is.
All coordinates are exact, so a plan that is made from positions, which are made from
earlier plans, may have ever longer numbers. `onward` makes plans whose numbers do not
grow: a translation with a velocity that is rounded to a grid, of step 2^-g say. Its
constant term is

    position(t) - velocity * t = (old constant) + (old velocity - velocity) * t,

so if t is a multiple of 2^-m, all constants of all such plans are multiples of 2^-(g + m)
plus the rest position. It is only the plan that is rounded: the body is where it was,
exactly, and all decisions are about the plan as it is.
"""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, floor, power_of_two, rational, rationals, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Motion, Pieces, Rigid, SimpleMotion, Translation

__all__ = ["GRID", "moved", "onward", "planned", "rounded", "translation_at"]

GRID = power_of_two(-20)
"""The grid of velocities, if no other is asked for."""


def planned(body: Body, plan: Motion | Body, t: QQ) -> Body:
    """A body with a new plan from a time on.

    Args:
        body: as it has been.
        plan: a motion of its shape (its vertices or keyframes), or another body of the
            same name with as many vertices.
        t: the time.

    Raises:
        InputError: if the plan is for another kind of body, or a vertex would jump.
    """
    if isinstance(plan, Body):
        new = plan
        if (new.name, new.size, new.closed) != (body.name, body.size, body.closed):
            raise InputError(f"body {body.name!r}: {new!r} is no plan for {body!r}")
    else:
        new = moved(body, plan)
    for i, (p, q) in enumerate(zip(body._at(t), new._at(t), strict=True)):
        if p != q:
            raise InputError(
                f"body {body.name!r}: vertex {i} jumps at t = {show(t)} "
                f"from {show(*p)} to {show(*q)}"
            )
    return new


def moved(body: Body, motion: Motion) -> Body:
    """The shape of a body with another motion; it may be at another place."""
    if body._keyframes:
        return Body(body.name, motion=motion, closed=body.closed, keyframes=body._keyframes)
    return Body(body.name, body.vertices, motion, closed=body.closed)


def rounded(value: Rational, grid: Rational = GRID) -> QQ:
    """The multiple of a grid that is nearest to a number (of two, the larger).

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
    """The motion by which a body goes on from where it is, with a new velocity.

    Its translation is replaced by a linear one; a turn or an affine change of its shape
    goes on as it is. Of a motion in pieces, this holds for all pieces from t on.

    Args:
        body: whose motion is replaced.
        t: when, rational; dyadic, if numbers are to stay small.
        velocity: (x, y); rounded to the grid.
        grid: a positive rational; a power of two, if numbers are to stay small.

    Raises:
        InputError: if the motion is a caller's own, which has no translation to replace.
    """
    now = rational(t)
    vx, vy = rationals(velocity, 2, "a velocity has two coordinates")
    v = rounded(vx, grid), rounded(vy, grid)
    if not isinstance(body.motion, Pieces):
        return _onward(body.motion, now, v)
    pieces: list[tuple[QQ | None, SimpleMotion]] = []
    x, y = translation_at(body, now)
    line = Polynomial([x._at(now) - v[0] * now, v[0]]), Polynomial([y._at(now) - v[1] * now, v[1]])
    for end, motion in zip([*body.motion._until, None], body.motion.motions, strict=True):
        if end is None or end > now:
            pieces.append((end, _translated(motion, *line)))
    return Pieces(pieces)


def translation_at(body: Body, t: QQ) -> tuple[Polynomial, Polynomial]:
    """The translation that is part of a body's motion just after a time."""
    motion = body.motion
    if isinstance(motion, Pieces):
        ends = [*motion._until, None]
        parts = zip(ends, motion.motions, strict=True)
        motion = next(m for end, m in parts if end is None or end > t)
    return _translation(motion)


def _onward(motion: SimpleMotion, t: QQ, v: tuple[QQ, QQ]) -> SimpleMotion:
    x, y = _translation(motion)
    return _translated(
        motion, Polynomial([x._at(t) - v[0] * t, v[0]]), Polynomial([y._at(t) - v[1] * t, v[1]])
    )


def _translation(motion: SimpleMotion) -> tuple[Polynomial, Polynomial]:
    if isinstance(motion, (Translation, Rigid, Affine)):
        return motion.x, motion.y
    raise InputError(f"a motion of this kind has no translation: {motion!r}")


def _translated(motion: SimpleMotion, x: Polynomial, y: Polynomial) -> SimpleMotion:
    """A motion with another translation."""
    if isinstance(motion, Rigid):
        return Rigid(motion.half_turn, pivot=motion._pivot, x=x, y=y)
    if isinstance(motion, Affine):
        return Affine(motion.matrix, x=x, y=y)
    return Translation(x, y)
