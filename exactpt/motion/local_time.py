"""Motions by velocities and in time since they began; splines.

The formulas of a motion are in the scene's time. People think of "from t = 3 on, two units to the
right in each second": the functions here translate that, exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, shorten, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.curve import PiecewisePolynomial, closed_curve
from exactpt.motion.motions import Affine, Pieces, Rigid, SimpleMotion, Translation


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
        x, y = motion.x.exact_at(begin), motion.y.exact_at(begin)
    return Pieces([*pieces, (None, _held(pieces[-1][1], begin))])


@final
class Spline(Pieces):
    """The translation along a piecewise polynomial curve that was closed up; see `spline`.

    Args:
        pieces: as for `Pieces`.
        error: how far the given curve may be from the pieces, at any time.

    Raises:
        InputError: if an argument is invalid.
    """

    __slots__ = ("exact_error",)

    def __init__(
        self, pieces: Sequence[tuple[Rational | None, SimpleMotion]], error: Rational
    ) -> None:
        super().__init__(pieces)
        self.exact_error = rational(error)
        if self.exact_error < 0:
            raise InputError(
                f"the error of a spline must not be negative, got {show(self.exact_error)}"
            )

    @property
    def error(self) -> Fraction:
        """The largest distance of the given curve from the pieces: the jumps that were closed."""
        return fraction(self.exact_error)

    def exact_assumed_errors(self) -> tuple[QQ, QQ]:
        """See `Pieces.exact_assumed_errors`: the error of the fit is a distance."""
        return self.exact_error, QQ(0)

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        (pieces,), _ = super()._given()
        return (pieces, str(self.exact_error)), {}

    def __repr__(self) -> str:
        span = f"from t = {show(self.exact_until[0])} to {show(self.exact_until[-1])}"
        pieces = counted(len(self.exact_until) - 1, "piece")
        return f"<Spline {span}, {pieces}, error {show(self.exact_error)}>"


def spline(curve: PiecewisePolynomial) -> Spline:
    """Return the translation along a piecewise polynomial of SciPy, such as a ``CubicSpline``.

    Coefficients are taken as the exact values of their doubles. Rounded, they make the curve jump
    by an ulp or two from one piece to the next, so each piece is moved to where the piece before
    it ends (`exactpt.motion.curve`). The attribute ``error`` of the motion is the largest distance
    from the given curve that results; `first_contact_enclosed` takes it into account. The body is
    at rest before the first breakpoint and after the last. Pieces of no duration are left out.

    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> c = np.array([[[0.1, 0.0], [1.0, 1.0]], [[0.2, 0.0], [0.3, 0.0]]])
    >>> motion = spline(SimpleNamespace(c=c, x=[0, 1, 2]))  # a PPoly of SciPy has c and x, too
    >>> float(motion.error)  # the doubles 0.1 and 0.2 add up to another number than 0.3
    2.7755575615628914e-17

    Args:
        curve: a curve in the plane, ``PPoly`` or an object with its attributes ``c`` and ``x``.

    Returns:
        `Pieces` with the attribute ``error``, a length, which cannot be set.

    Raises:
        InputError: if it is not a curve in the plane, a coefficient is not finite, it repeats
            itself (``extrapolate="periodic"``), or it jumps: by more than 8 ulps of the largest
            term of the two polynomials where it does.
    """
    closed = closed_curve(curve, ("x", "y"))
    first, last = closed.times[0], closed.times[-1]
    pieces: list[tuple[Rational | None, SimpleMotion]] = []
    for begin, end, (x, y) in zip(closed.times, closed.times[1:], closed.pieces, strict=False):
        since = Polynomial([-begin, 1])
        pieces.append((end, Translation(x(since), y(since))))
    before, after = _held(pieces[0][1], first), _held(pieces[-1][1], last)
    return Spline([(first, before), *pieces, (None, after)], closed.place_offset)


def _composed(motion: SimpleMotion, time: Polynomial, x: QQ, y: QQ) -> Translation | Rigid | Affine:
    """Return a motion at a time that is a polynomial in the scene's, with a translation added."""
    if isinstance(motion, Translation):
        return Translation(motion.x(time) + x, motion.y(time) + y)
    if isinstance(motion, Rigid):
        return Rigid(
            motion.half_turn(time),
            pivot=motion.exact_pivot,
            x=motion.x(time) + x,
            y=motion.y(time) + y,
            orientation=motion.exact_orientation,
        )
    if isinstance(motion, Affine):
        matrix = [[f(time) for f in row] for row in motion.matrix]
        return Affine(matrix, x=motion.x(time) + x, y=motion.y(time) + y)
    raise InputError(f"not a motion in local time: {shorten(motion)}")


def _held(motion: SimpleMotion, t: QQ) -> SimpleMotion:
    """Return the motion that keeps a body where another motion has it at a time."""
    return _composed(motion, Polynomial([t]), QQ(0), QQ(0))
