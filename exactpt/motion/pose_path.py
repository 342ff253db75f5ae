"""Rigid motions along paths of poses: x(t), y(t) and the angle theta(t), piecewise polynomials.

The pieces of a `PosePath` are made by `exactpt.motion.pose_pieces`; `exactpt.motion.path_error`
proves the error of any pieces.

**Proved and assumed errors.** A path has three motions: the rational pieces, the polynomials that
are its poses, and the true motion that a caller means. From the pieces to the poses there is an
error of fitting, which is proved, and is 0 where the fit is exact. From the poses to the true
motion there is an error that the caller states. It is assumed, and counts at every time:

* of the translation, the bounds given to `PosePath.with_place_error`, and the jumps of a curve that
  were closed (`exactpt.motion.curve`). A path keeps one number P for both errors. So the assumed
  part is P less the largest proved distance of the pieces from the poses. (P is at least the sum of
  that distance and the stated error, so this part is at least the stated error.)
* of the angle, the jumps that were closed, and the rounding of 2 pi where headings were unwrapped.
  A path keeps this part of `error` by itself, and fits its pieces within the rest of `error`.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    fraction,
    fractions,
    nearest_float,
    place,
    rational,
    rationals,
    shorten,
    show,
)
from exactpt.kernel.polynomial import Polynomial, polynomial
from exactpt.kernel.square_root import root_bounds
from exactpt.motion.curve import PiecewisePolynomial, closed_curve
from exactpt.motion.headings import check_headings, unwrapped
from exactpt.motion.motions import Coefficients, Pieces, Rigid, SimpleMotion
from exactpt.motion.path_error import Pose, angle_error, place_error_squared
from exactpt.motion.pose_pieces import DEGREE, pieces_along
from exactpt.motion.shape import listed


@final
class PosePath(Pieces):
    """A rigid motion along a path of poses (x, y, angle), polynomials of the time in each piece.

    At the time t the body is turned by the angle theta(t), in radians, about the pivot, a point of
    its rest frame, then translated by (x(t), y(t)), as by `Rigid`. The pieces turn by an angle that
    differs from it by at most ``error`` at every time, and their translation by at most
    ``place_error``: a point at a distance r from the pivot is at most r ``error`` + ``place_error``
    from where it should be. So a pivot amid the body keeps this small; where a body is given in
    the frame of a whole drawing, far from the origin, one is needed. Before the first time and
    after the last the body rests.

    >>> path = PosePath([0, 2], [([0, 1], 0, [0, 0, "1/4"])], error="1/1000")
    >>> path.pose(2)
    (Fraction(2, 1), Fraction(0, 1), Fraction(1, 1))
    >>> PosePath([0, 2], [([0, 1], 0, [0, 1])], pivot=(100, 40)).pivot
    (Fraction(100, 1), Fraction(40, 1))

    Args:
        times: m + 1 increasing times.
        poses: m triples x, y, angle: polynomials in the time since the piece began.
        error: the largest error of the angle, in radians.
        place_error: the largest error of the translation. If it is 0, x and y are taken as they
            are, of a degree of at most 3; else they are fitted by cubics. The part that the fit
            does not need counts as a stated error (`assumed_place_error`).
        pivot: the point of the rest frame about which the body turns; the path leads it through
            pivot + (x(t), y(t)).

    Raises:
        InputError: if an argument is invalid, the path jumps, or more than 100,000 pieces are
            needed.
    """

    __slots__ = (
        "exact_assumed_angle_error",
        "exact_error",
        "exact_pivot",
        "exact_place_error",
        "exact_poses",
        "exact_times"
    )  # fmt: skip

    def __init__(
        self,
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        *,
        error: Rational = "1/1000000",
        place_error: Rational = 0,
        pivot: Sequence[Rational] = (0, 0),
    ) -> None:
        self._hold(times, poses, error, place_error, pivot)
        self._fit(self.exact_place_error)

    @classmethod
    def _of_inexact(
        cls,
        times: Sequence[QQ],
        poses: Sequence[Sequence[Polynomial]],
        *,
        error: Rational,
        assumed_angle_error: QQ,
        fit_place_error: Rational = 0,
        assumed_place_error: Rational = 0,
        pivot: Sequence[Rational],
    ) -> PosePath:
        """Return a path whose poses differ from the true motion.

        Args:
            times: see `PosePath`.
            poses: see `PosePath`.
            error: see `PosePath`: of pieces and poses together.
            assumed_angle_error: the part of the error by which the poses may differ.
            fit_place_error: the largest error of the translation of the pieces.
            assumed_place_error: that of the poses, which is added to it.
            pivot: see `PosePath`.
        """
        self = cls.__new__(cls)
        fit = rational(fit_place_error)
        _check_place_error(fit)
        place_error = fit + rational(assumed_place_error)
        self._hold(times, poses, error, place_error, pivot, assumed_angle_error)
        self._fit(fit)
        return self

    def _fit(self, place_error: QQ) -> None:
        """Make the pieces, with at most this error of the translation."""
        if not place_error:
            for i, pose in enumerate(self.exact_poses):
                for name, f in zip("xy", pose[:2], strict=True):
                    if f.degree > DEGREE:
                        raise InputError(
                            f"piece {i}: {name} has degree {f.degree}: give a place_error"
                        )
        angle_error = self.exact_error - self.exact_assumed_angle_error
        pieces = pieces_along(self._spans(), angle_error, place_error, self.exact_pivot)
        Pieces.__init__(self, pieces)

    def _hold(
        self,
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        error: Rational,
        place_error: Rational,
        pivot: Sequence[Rational],
        assumed_angle_error: Rational = 0,
    ) -> None:
        """Check and keep the path and its errors."""
        self.exact_times = tuple(map(rational, listed("times", times)))
        self.exact_poses = tuple(_pose(i, row) for i, row in enumerate(listed("poses", poses)))
        self.exact_error, self.exact_place_error = rational(error), rational(place_error)
        self.exact_assumed_angle_error = rational(assumed_angle_error)
        px, py = rationals(pivot, 2, "a pivot has two coordinates")
        self.exact_pivot: Point = (px, py)
        if len(self.exact_times) != len(self.exact_poses) + 1 or not self.exact_poses:
            raise InputError(
                f"a path has at least one pose, and one pose fewer than times: "
                f"{len(self.exact_times)} times, {len(self.exact_poses)} poses"
            )
        for t, until in pairwise(self.exact_times):
            if t >= until:
                raise InputError(f"times increase: {show(t)}, then {show(until)}")
        if self.exact_error <= 0:
            raise InputError(f"an error is positive: {show(self.exact_error)}")
        _check_place_error(self.exact_place_error)
        if not 0 <= self.exact_assumed_angle_error < self.exact_error:
            raise InputError(
                f"an assumed_angle_error must be at least 0 and less than the error, "
                f"{show(self.exact_error)}, got {show(self.exact_assumed_angle_error)}"
            )
        for i, (before_it, pose) in enumerate(pairwise(self.exact_poses)):
            end = self.exact_times[i + 1]
            for name, f, g in zip(("x", "y", "the angle"), before_it, pose, strict=True):
                jump = g.exact_at(QQ(0)) - f.exact_at(end - self.exact_times[i])
                if jump:
                    by = f"{show(jump)} ({float(jump):.3g})"
                    raise InputError(f"piece {i + 1}: {name} jumps at t = {show(end)} by {by}")

    @classmethod
    def of_curve(
        cls,
        curve: PiecewisePolynomial,
        *,
        error: Rational = "1/1000000",
        place_error: Rational | None = None,
        pivot: Sequence[Rational] = (0, 0),
    ) -> PosePath:
        """Return the path along a piecewise polynomial of SciPy with three columns x, y, angle.

        Coefficients are taken as the exact values of their doubles. Rounded, they make the curve
        jump by an ulp or two from one piece to the next, so each piece is moved to where the piece
        before it ends (`exactpt.motion.curve`). By how far the curve is displaced in x and y is
        added to the ``place_error`` of the path. By how much its angle is changed is taken out of
        ``error`` before the pieces are fitted, so that ``error`` is about the given curve.

        Pieces of no duration, as `PPoly.from_spline` makes them, are left out. That function fails
        for a spline with several columns in SciPy 1.17.1: go column by column. Its coefficients
        are rounded more than those of other classes; if a jump is refused, set the constants
        ``c[-1, 1:]`` to where the pieces before end.

        >>> from types import SimpleNamespace
        >>> import numpy as np
        >>> c = np.array([[[1.0, 0, 0.1], [1, 0, 0]], [[0, 0, 0.2], [1, 0, 0.3]]])
        >>> path = PosePath.of_curve(SimpleNamespace(c=c, x=[0, 1, 2]))  # or a PPoly of SciPy
        >>> path.pose(1)[:2], float(path.assumed_angle_error)
        ((Fraction(1, 1), Fraction(0, 1)), 2.7755575615628914e-17)

        Args:
            curve: ``PPoly``, ``CubicSpline`` or an object with the attributes ``c`` and ``x``.
            error: see `PosePath`.
            place_error: see `PosePath`; if not given, 0 for degrees up to 3, else 10^-6.
            pivot: see `PosePath`.

        Raises:
            InputError: if it has not three columns, a coefficient is not finite, it repeats itself
                (``extrapolate="periodic"``), or it jumps: by more than 8 ulps of the largest term
                of the two polynomials where it does. Also if the smaller jumps of the angle add up
                to more than half of ``error``.
        """
        closed = closed_curve(curve, ("x", "y", "the angle"))
        angle_offset = max(abs(offset) for _, _, offset in closed.offsets)
        whole = rational(error)
        if 0 < whole < 2 * angle_offset:
            raise InputError(
                f"the small jumps of the angle add up to {nearest_float(angle_offset):.3g}, more "
                f"than half of the error, {nearest_float(whole):.6g}; give a larger error, or a "
                f"curve whose pieces fit better"
            )
        if place_error is None:
            place_error = 0 if closed.degree <= DEGREE else "1/1000000"
        return cls._of_inexact(
            closed.times,
            closed.pieces,
            error=whole,
            assumed_angle_error=angle_offset,
            fit_place_error=place_error,
            assumed_place_error=closed.place_offset,
            pivot=pivot,
        )

    @classmethod
    def through(
        cls,
        times: Sequence[Rational],
        samples: Sequence[Sequence[Rational]],
        *,
        ramp: Rational = 0,
        unwrap: bool = False,
        error: Rational = "1/1000000",
        pivot: Sequence[Rational] = (0, 0),
    ) -> PosePath:
        """Return the path through samples, at constant rates or from rest to rest.

        An angle is a number of radians, and the body turns from one angle to the next through all
        the angles between them. A log of headings between -pi and pi jumps where a heading passes
        pi; by the numbers the body would turn back almost all the way around there. So two
        successive angles that differ by more than pi are refused, unless they are unwrapped.

        >>> path = PosePath.through([0, 3], [(0, 0, 0), (2, 0, 1)], ramp="1/3")
        >>> [path.pose(t)[0] for t in (0, 1, 2, 3)]  # trapezoidal: speeds up, goes on, slows down
        [Fraction(0, 1), Fraction(1, 2), Fraction(3, 2), Fraction(2, 1)]
        >>> log = PosePath.through([0, "1/100"], [(0, 0, 3.13), (0, 0, -3.13)], unwrap=True)
        >>> float(log.pose("1/200")[2])  # on past pi, not back through 0
        3.141592653589793

        Args:
            times: increasing times.
            samples: x, y and the angle at each of them.
            ramp: the part of the duration between two samples in which x, y and the angle speed up
                at a constant rate, and that in which they slow down, at most 1/2: trapezoidal
                profiles. With 0 rates are constant between samples.
            unwrap: True if each angle stands for a heading, which full turns do not change: the
                body turns to it by at most pi. Of ``error``, at most a thousandth is needed for
                2 pi as a rational number.
            error: see `PosePath`.
            pivot: see `PosePath`.

        Raises:
            InputError: if an argument is invalid, or two successive angles differ by more than pi
                and are not unwrapped.
        """
        part = rational(ramp)
        if not 0 <= part <= rational("1/2"):
            raise InputError(f"a ramp is between 0 and 1/2: {show(part)}")
        ts, rows = _samples(times, samples)
        whole, rounding = rational(error), QQ(0)
        headings = [angle for _, _, angle in rows]
        if unwrap:
            headings, rounding = unwrapped(headings, whole)
            rows = [(x, y, angle) for (x, y, _), angle in zip(rows, headings, strict=True)]
        else:
            check_headings(headings)
        all_times, poses = ts[:1], list[list[Polynomial]]()
        for (begin, end), (first, last) in zip(pairwise(ts), pairwise(rows), strict=True):
            for until, profile in _profile(end - begin, part):
                moves = [q - p for p, q in zip(first, last, strict=True)]
                poses.append([profile * m + p for m, p in zip(moves, first, strict=True)])
                all_times.append(begin + until)
        return cls._of_inexact(
            all_times, poses, error=whole, assumed_angle_error=rounding, pivot=pivot
        )

    @classmethod
    def of_pieces(
        cls,
        pieces: Sequence[tuple[Rational | None, SimpleMotion]],
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        error: Rational,
        place_error: Rational = 0,
        assumed_angle_error: Rational = 0,
        pivot: Sequence[Rational] = (0, 0),
    ) -> PosePath:
        """Return the path that consists of given pieces, after a proof that they follow it.

        Args:
            pieces: as for `Pieces`: rigid motions about the pivot, the first until the first time,
                the last from the last time on, and in no other piece two pieces of the path.
            times: see `PosePath`.
            poses: see `PosePath`.
            error: see `PosePath`.
            place_error: see `PosePath`.
            assumed_angle_error: the part of the error that is not proved (see the attribute).
            pivot: see `PosePath`.

        Raises:
            InputError: if they do not follow the path within the errors.
        """
        self = cls.__new__(cls)
        Pieces.__init__(self, pieces)
        self._hold(times, poses, error, place_error, pivot, assumed_angle_error)
        self._check_pivots()
        if (wrong := self._not_within()) is not None:
            raise InputError(
                f"the pieces do not follow the path within {show(self.exact_error)} (piece {wrong})"
            )
        return self

    def _spans(self) -> list[tuple[QQ, QQ, Pose]]:
        """Return beginning, end, and pose as polynomials of t of each piece of the path."""
        spans = list[tuple[QQ, QQ, Pose]]()
        for (begin, end), (x, y, angle) in zip(
            pairwise(self.exact_times), self.exact_poses, strict=True
        ):
            since = Polynomial([-begin, 1])
            spans.append((begin, end, (x(since), y(since), angle(since))))
        return spans

    def _check_pivots(self) -> None:
        """Check that all rigid pieces turn about the pivot."""
        for i, turn in enumerate(self.motions):
            if isinstance(turn, Rigid) and turn.exact_pivot != self.exact_pivot:
                raise InputError(
                    f"the pieces of a path turn about its pivot, {show(*self.exact_pivot)}, got "
                    f"{show(*turn.exact_pivot)} (piece {i})"
                )

    def _not_within(self) -> int | None:
        """Return the number of a piece that is not proved to be within the errors; None if none.

        The angle of the pieces must be within the part of the error that is not assumed.
        """
        provable = self.exact_error - self.exact_assumed_angle_error
        ends, spans = self.exact_until, self._spans()
        if len(ends) < 2 or (ends[0], ends[-1]) != (self.exact_times[0], self.exact_times[-1]):
            return 0
        rows = [(ends[0], ends[0]), *pairwise(ends), (ends[-1], ends[-1])]
        k = 0
        for i, ((a, b), turn) in enumerate(zip(rows, self.motions, strict=True)):
            while k < len(spans) - 1 and a >= spans[k][1]:
                k += 1
            if not isinstance(turn, Rigid) or b > spans[k][1]:
                return i
            if a == b and max(turn.half_turn.degree, turn.x.degree, turn.y.degree) > 0:
                return i
            x, y, angle = spans[k][2]
            if angle_error(turn, a, b, angle, provable) > provable:
                return i
            if place_error_squared(turn, a, b, x, y) > self.exact_place_error**2:
                return i
        return None

    @property
    def times(self) -> tuple[Fraction, ...]:
        """The times at which the pieces of the path begin, and the last one ends."""
        return fractions(self.exact_times)

    @property
    def pivot(self) -> tuple[Fraction, Fraction]:
        """The point of the rest frame about which the body turns."""
        return place(self.exact_pivot)

    @property
    def error(self) -> Fraction:
        """The largest error of the angle, in radians."""
        return fraction(self.exact_error)

    @property
    def place_error(self) -> Fraction:
        """The largest error of the translation."""
        return fraction(self.exact_place_error)

    @property
    def assumed_angle_error(self) -> Fraction:
        """The part of `error` by which the true angle may differ from that of the poses.

        It counts at every time; the rest of `error` is proved, and is 0 where the fit is exact.
        """
        return fraction(self.exact_assumed_angle_error)

    @property
    def assumed_place_error(self) -> Fraction:
        """The part of `place_error` by which the true place may differ from that of the poses.

        It counts at every time; the rest of `place_error` is proved, and is 0 where the fit is
        exact.
        """
        return fraction(self.exact_assumed_place_error())

    def exact_assumed_place_error(self) -> QQ:
        """Return the place error less the proved distance of the pieces from the poses."""
        if not self.exact_place_error:
            return QQ(0)
        spans, k, most = self._spans(), 0, QQ(0)
        for (a, b), turn in zip(pairwise(self.exact_until), self.motions[1:-1], strict=True):
            while a >= spans[k][1]:
                k += 1
            x, y, _ = spans[k][2]
            if isinstance(turn, Rigid):
                most = max(most, place_error_squared(turn, a, b, x, y))
        return self.exact_place_error - root_bounds(most).low

    def with_place_error(self, more: Rational) -> PosePath:
        """Return the same pieces for a true path that is known less well.

        Args:
            more: the largest distance, >= 0, between the translation of the true path and that of
                this one. It is added to the `place_error`. So a joint of an arm, whose path is no
                polynomial, is followed by a fitted one (examples/robot_arm.py).

        Raises:
            InputError: if it is negative.
        """
        further = rational(more)
        _check_place_error(further)
        total = self.exact_place_error + further
        return PosePath.of_pieces(
            self.pieces,
            self.exact_times,
            self.exact_poses,
            self.exact_error,
            total,
            self.exact_assumed_angle_error,
            self.exact_pivot,
        )

    def exact_assumed_errors(self) -> tuple[QQ, QQ]:
        """See `Pieces.exact_assumed_errors`: what callers stated of the path."""
        return self.exact_assumed_place_error(), self.exact_assumed_angle_error

    def pose(self, t: Rational) -> tuple[Fraction, Fraction, Fraction]:
        """Return x, y and the angle of the path itself at a time."""
        x, y, angle = fractions(self.exact_pose(rational(t)))
        return x, y, angle

    def exact_pose(self, t: QQ) -> tuple[QQ, QQ, QQ]:
        """Return x, y and the angle at a time; beyond the ends, those at the nearest end."""
        t = min(max(t, self.exact_times[0]), self.exact_times[-1])
        i = max(k for k, begin in enumerate(self.exact_times[:-1]) if begin <= t)
        x, y, angle = (f.exact_at(t - self.exact_times[i]) for f in self.exact_poses[i])
        return x, y, angle

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        (pieces,), _ = super()._given()
        times = tuple(map(str, self.exact_times))
        errors = map(
            str, (self.exact_error, self.exact_place_error, self.exact_assumed_angle_error)
        )
        pivot = tuple(map(str, self.exact_pivot))
        return (pieces, times, self.exact_poses, *errors, pivot), {}

    def __reduce__(self) -> tuple[object, ...]:
        return PosePath.of_pieces, self._given()[0]

    def __repr__(self) -> str:
        start, end, error = (
            show(q) for q in (self.exact_times[0], self.exact_times[-1], self.exact_error)
        )
        pieces = counted(len(self.exact_until) - 1, "piece")
        return f"<PosePath from t = {start} to {end}, {pieces}, error {error}>"


def _check_place_error(error: QQ) -> None:
    if error < 0:
        raise InputError(f"a place_error is not negative: {show(error)}")


def _pose(i: int, row: Sequence[Coefficients]) -> Pose:
    if isinstance(row, str) or len(row) != 3:
        raise InputError(f"piece {i}: a pose is x, y and an angle: {shorten(row)}")
    x, y, angle = map(polynomial, row)
    return x, y, angle


def _samples(
    times: Sequence[Rational], samples: Sequence[Sequence[Rational]]
) -> tuple[list[QQ], list[tuple[QQ, QQ, QQ]]]:
    """Return the times and the poses of a log, checked row by row."""
    ts, rows = listed("times", times), listed("samples", samples)
    if len(ts) != len(rows):
        raise InputError(
            f"a path through samples has x, y and the angle for each time: {len(ts)} times, "
            f"{len(rows)} samples"
        )
    checked = list[tuple[QQ, tuple[QQ, QQ, QQ]]]()
    for i, (time, row) in enumerate(zip(ts, rows, strict=True)):
        try:
            t = rational(time)
            x, y, angle = rationals(row, 3, "a sample is x, y and the angle")
        except InputError as error:
            raise InputError(f"row {i}: {error}") from None
        if checked and t <= checked[-1][0]:
            raise InputError(
                f"row {i}: times increase, got {show(t)} after {show(checked[-1][0])}; "
                f"sort the rows, and leave out repeated ones"
            )
        checked.append((t, (x, y, angle)))
    return [t for t, _ in checked], [pose for _, pose in checked]


def _profile(duration: QQ, ramp: QQ) -> list[tuple[QQ, Polynomial]]:
    """Return the ends and the polynomials of pieces that lead from 0 to 1 in a duration."""
    if not ramp:
        return [(duration, Polynomial([0, 1 / duration]))]
    short = ramp * duration
    speed = 1 / (duration - short)
    half = speed / (2 * short)  # of the acceleration
    left = speed * short
    pieces = [(short, Polynomial([0, 0, half]))]
    if 2 * short < duration:
        pieces.append((duration - short, Polynomial([left / 2, speed])))
    return [*pieces, (duration, Polynomial([1 - left / 2, speed, -half]))]
