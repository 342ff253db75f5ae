"""Motions by velocities and in time since they began; splines.

The formulas of a motion are in the scene's time. People think of "from t = 3 on, two units to the
right in each second": the functions here translate that, exactly.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any, Protocol

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, rational, shorten, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.motions import Affine, Pieces, Rigid, SimpleMotion, Translation


class PiecewisePolynomial(Protocol):
    """The attributes of ``scipy.interpolate.PPoly``, and of the splines derived from it.

    Attributes:
        c: coefficients, shape (k, m, 2), the highest power first, in the time since the
            beginning of the piece.
        x: m + 1 increasing breakpoints.
    """

    c: Any
    x: Any


def Velocity(vx: Rational, vy: Rational, *, since: Rational = 0) -> Translation:  # noqa: N802
    """Return the translation with a constant velocity that is the identity at the time ``since``.

    >>> Velocity(2, 0, since=3)
    Translation(x=Polynomial(['-6', '2']), y=Polynomial([]))

    Args:
        vx: the velocity in x, in units of length per unit of time.
        vy: the velocity in y.
        since: the time at which the body is where its vertices are.

    Raises:
        InputError: if one of them is not a number.
    """
    elapsed = Polynomial([-rational(since), 1])
    return Translation(elapsed * vx, elapsed * vy)


def in_local_time(
    steps: Sequence[tuple[Rational | None, SimpleMotion]], *, start: Rational = 0
) -> Pieces:
    """Motions one after another, each in the time since it began.

    Each begins where the one before it ended; constants of its translation are added to that.
    Three steps to the right and two upwards are

    >>> right, up = Translation([0, 1]), Translation(0, [0, 1])
    >>> in_local_time([(3, right), (2, up)], start=10).until
    (Fraction(10, 1), Fraction(13, 1), Fraction(15, 1))

    The body is at rest before the start, and after the last step if that has a duration. Angles of
    rotation are not added up: half-turns and orientations of successive rotations must fit (see
    `Rigid`).

    Args:
        steps: pairs of a positive duration and a motion; the last duration may be None.
        start: the time at which the first begins.

    Raises:
        InputError: if a duration is not positive or missing, or a motion is of a class that
            exactpt does not know.
    """
    if not steps:
        raise InputError("at least one step is needed")
    begin = rational(start)
    pieces: list[tuple[Rational | None, SimpleMotion]] = []
    x = y = QQ(0)
    for i, (given, step) in enumerate(steps):
        motion = _composed(step, Polynomial([-begin, 1]), x, y)
        if i == 0:
            pieces.append((begin, _held(motion, begin)))
        if given is None:
            if i < len(steps) - 1:
                raise InputError(f"step {i}: only the last step may have no end")
            pieces.append((None, motion))
            return Pieces(pieces)
        duration = rational(given)
        if duration <= 0:
            raise InputError(f"step {i}: a duration is positive: {show(duration)}")
        begin += duration
        pieces.append((begin, motion))
        x, y = motion.x._at(begin), motion.y._at(begin)
    return Pieces([*pieces, (None, _held(pieces[-1][1], begin))])


def spline(curve: PiecewisePolynomial) -> Pieces:
    """Return the translation along a piecewise polynomial of SciPy, such as a ``CubicSpline``.

    Coefficients are taken as the exact values of their doubles, but for the constant ones of all
    pieces but the first: rounded, these make the curve jump by an ulp from one piece to the next.
    Each piece begins exactly where the one before it ends. The body is at rest before the first
    breakpoint and after the last.

    Args:
        curve: a curve in the plane, ``PPoly`` or an object with its attributes ``c`` and ``x``.

    Raises:
        InputError: if it is not a curve in the plane, or a coefficient is not finite.
    """
    shape: tuple[int, ...] = getattr(getattr(curve, "c", None), "shape", ())
    if len(shape) != 3 or shape[2] != 2:
        hint = "; PosePath.of_curve takes x, y and an angle" if shape[2:] == (3,) else ""
        raise InputError(f"not a piecewise polynomial curve in the plane: {shorten(curve)}{hint}")
    times = [rational(t) for t in curve.x]
    first = [rational(c) for c in curve.c[-1, 0]]
    steps: list[tuple[Rational | None, SimpleMotion]] = []
    for piece, (begin, end) in enumerate(pairwise(times)):
        paths = (_from_zero(curve.c[:-1, piece, k]) for k in (0, 1))
        x, y = (path + c for path, c in zip(paths, first, strict=True))
        steps.append((end - begin, Translation(x, y)))
        first = [QQ(0), QQ(0)]
    return in_local_time(steps, start=times[0])


def _from_zero(powers: Iterable[Rational]) -> Polynomial:
    """Return the polynomial with these coefficients, the highest first, and the constant 0."""
    return Polynomial([0, *reversed([rational(c) for c in powers])])


def _composed(motion: SimpleMotion, time: Polynomial, x: QQ, y: QQ) -> Translation | Rigid | Affine:
    """Return a motion at a time that is a polynomial in the scene's, with a translation added."""
    if isinstance(motion, Translation):
        return Translation(motion.x(time) + x, motion.y(time) + y)
    if isinstance(motion, Rigid):
        return Rigid(
            motion.half_turn(time),
            pivot=motion._pivot,
            x=motion.x(time) + x,
            y=motion.y(time) + y,
            orientation=motion._orientation,
        )
    if isinstance(motion, Affine):
        matrix = [[f(time) for f in row] for row in motion.matrix]
        return Affine(matrix, x=motion.x(time) + x, y=motion.y(time) + y)
    raise InputError(f"not a motion in local time: {shorten(motion)}")


def _held(motion: SimpleMotion, t: QQ) -> SimpleMotion:
    """Return the motion that keeps a body where another motion has it at a time."""
    return _composed(motion, Polynomial([t]), QQ(0), QQ(0))
