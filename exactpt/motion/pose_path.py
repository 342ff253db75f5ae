"""Rigid motions along paths of poses: x(t), y(t) and the angle theta(t), piecewise polynomials.

The pieces of a `PosePath` are made by `exactpt.motion.pose_pieces`; `exactpt.motion.path_error`
proves the error of any pieces.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, fraction, fractions, rational, shorten, show
from exactpt.kernel.polynomial import Polynomial, polynomial
from exactpt.motion.local_time import PiecewisePolynomial
from exactpt.motion.motions import Coefficients, Pieces, Rigid, SimpleMotion
from exactpt.motion.path_error import Pose, angle_error, place_error_squared
from exactpt.motion.pose_pieces import DEGREE, pieces_along


@final
class PosePath(Pieces):
    """A rigid motion along a path of poses (x, y, angle), polynomials of the time in each piece.

    At the time t the body is turned by the angle theta(t), in radians, about the origin of its rest
    frame, then translated by (x(t), y(t)). The pieces turn by an angle that differs from it by at
    most ``error`` at every time, and their translation by at most ``place_error``: a point at a
    distance r from the origin is at most r ``error`` + ``place_error`` from where it should be.
    Before the first time and after the last the body rests.

    >>> path = PosePath([0, 2], [([0, 1], 0, [0, 0, "1/4"])], error="1/1000")
    >>> path.pose(2)
    (Fraction(2, 1), Fraction(0, 1), Fraction(1, 1))

    Args:
        times: m + 1 increasing times.
        poses: m triples x, y, angle: polynomials in the time since the piece began.
        error: the largest error of the angle, in radians.
        place_error: the largest error of the translation. If it is 0, x and y are taken as they
            are, of a degree of at most 3; else they are fitted by cubics.

    Raises:
        InputError: if an argument is invalid, the path jumps, or more than 100,000 pieces are
            needed.
    """

    __slots__ = ("_error", "_place_error", "_poses", "_times")

    def __init__(
        self,
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        *,
        error: Rational = "1/1000000",
        place_error: Rational = 0,
    ) -> None:
        self._hold(times, poses, error, place_error)
        if not self._place_error:
            for i, pose in enumerate(self._poses):
                for name, f in zip("xy", pose[:2], strict=True):
                    if f.degree > DEGREE:
                        raise InputError(
                            f"piece {i}: {name} has degree {f.degree}: give a place_error"
                        )
        super().__init__(pieces_along(self._spans(), self._error, self._place_error))

    def _hold(
        self,
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        error: Rational,
        place_error: Rational,
    ) -> None:
        """Check and keep the path and its errors."""
        self._times = tuple(map(rational, times))
        self._poses = tuple(_pose(i, row) for i, row in enumerate(poses))
        self._error, self._place_error = rational(error), rational(place_error)
        if len(self._times) != len(self._poses) + 1 or not self._poses:
            raise InputError(
                f"a path has at least one pose, and one pose fewer than times: "
                f"{len(self._times)} times, {len(self._poses)} poses"
            )
        for t, until in pairwise(self._times):
            if t >= until:
                raise InputError(f"times increase: {show(t)}, then {show(until)}")
        if self._error <= 0:
            raise InputError(f"an error is positive: {show(self._error)}")
        if self._place_error < 0:
            raise InputError(f"a place_error is not negative: {show(self._place_error)}")
        for i, (before_it, pose) in enumerate(pairwise(self._poses)):
            end = self._times[i + 1]
            for name, f, g in zip(("x", "y", "the angle"), before_it, pose, strict=True):
                jump = g._at(QQ(0)) - f._at(end - self._times[i])
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
    ) -> PosePath:
        """Return the path along a piecewise polynomial of SciPy with three columns x, y, angle.

        Coefficients are taken as in `spline`: as the values of their doubles, but for the constant
        ones of all pieces but the first. Pieces of no duration, as `PPoly.from_spline` makes them,
        are left out. (Of a spline with several columns that function fails in SciPy 1.17.1: go
        column by column.)

        Args:
            curve: ``PPoly``, ``CubicSpline`` or an object with the attributes ``c`` and ``x``.
            error: see `PosePath`.
            place_error: see `PosePath`; if not given, 0 for degrees up to 3, else 10^-6.

        Raises:
            InputError: if it has not three columns, or a coefficient is not finite.
        """
        shape: tuple[int, ...] = getattr(getattr(curve, "c", None), "shape", ())
        if len(shape) != 3 or shape[2] != 3:
            raise InputError(
                f"not a piecewise polynomial with three columns x, y, angle: {shorten(curve)}"
            )
        times = [rational(t) for t in curve.x]
        start = [rational(c) for c in curve.c[-1, 0]]
        kept, poses = [times[0]], list[list[Polynomial]]()
        for i, (begin, end) in enumerate(pairwise(times)):
            if begin == end:
                continue
            powers = [[rational(c) for c in curve.c[:-1, i, k]] for k in range(3)]
            pose = [Polynomial([c, *reversed(p)]) for c, p in zip(start, powers, strict=True)]
            start = [f._at(end - begin) for f in pose]
            kept.append(end)
            poses.append(pose)
        if place_error is None:
            place_error = 0 if shape[0] <= DEGREE + 1 else "1/1000000"
        return cls(kept, poses, error=error, place_error=place_error)

    @classmethod
    def through(
        cls,
        times: Sequence[Rational],
        samples: Sequence[Sequence[Rational]],
        *,
        ramp: Rational = 0,
        error: Rational = "1/1000000",
    ) -> PosePath:
        """Return the path through samples, at constant rates or from rest to rest.

        >>> path = PosePath.through([0, 3], [(0, 0, 0), (2, 0, 1)], ramp="1/3")
        >>> [path.pose(t)[0] for t in (0, 1, 2, 3)]  # trapezoidal: speeds up, goes on, slows down
        [Fraction(0, 1), Fraction(1, 2), Fraction(3, 2), Fraction(2, 1)]

        Args:
            times: increasing times.
            samples: x, y and the angle at each of them.
            ramp: the part of the duration between two samples in which x, y and the angle speed up
                at a constant rate, and that in which they slow down, at most 1/2: trapezoidal
                profiles. With 0 rates are constant between samples.
            error: see `PosePath`.

        Raises:
            InputError: if an argument is invalid.
        """
        part = rational(ramp)
        if not 0 <= part <= rational("1/2"):
            raise InputError(f"a ramp is between 0 and 1/2: {show(part)}")
        ts, rows = [rational(t) for t in times], [list(map(rational, row)) for row in samples]
        if len(ts) != len(rows) or any(len(row) != 3 for row in rows):
            raise InputError("a path through samples has x, y and the angle for each time")
        all_times, poses = ts[:1], list[list[Polynomial]]()
        for (begin, end), (first, last) in zip(pairwise(ts), pairwise(rows), strict=True):
            for until, profile in _profile(end - begin, part):
                moves = [q - p for p, q in zip(first, last, strict=True)]
                poses.append([profile * m + p for m, p in zip(moves, first, strict=True)])
                all_times.append(begin + until)
        return cls(all_times, poses, error=error)

    @classmethod
    def of_pieces(
        cls,
        pieces: Sequence[tuple[Rational | None, SimpleMotion]],
        times: Sequence[Rational],
        poses: Sequence[Sequence[Coefficients]],
        error: Rational,
        place_error: Rational = 0,
    ) -> PosePath:
        """Return the path that consists of given pieces, after a proof that they follow it.

        Args:
            pieces: as for `Pieces`: rigid motions about the origin, the first until the first time,
                the last from the last time on, and in no other piece two pieces of the path.
            times: see `PosePath`.
            poses: see `PosePath`.
            error: see `PosePath`.
            place_error: see `PosePath`.

        Raises:
            InputError: if they do not follow the path within the errors.
        """
        self = cls.__new__(cls)
        Pieces.__init__(self, pieces)
        self._hold(times, poses, error, place_error)
        if (wrong := self._not_within()) is not None:
            raise InputError(
                f"the pieces do not follow the path within {show(self._error)} (piece {wrong})"
            )
        return self

    def _spans(self) -> list[tuple[QQ, QQ, Pose]]:
        """Return beginning, end, and pose as polynomials of t of each piece of the path."""
        spans = list[tuple[QQ, QQ, Pose]]()
        for (begin, end), (x, y, angle) in zip(pairwise(self._times), self._poses, strict=True):
            since = Polynomial([-begin, 1])
            spans.append((begin, end, (x(since), y(since), angle(since))))
        return spans

    def _not_within(self) -> int | None:
        """Return the number of a piece that is not proved to be within the errors; None if none."""
        ends, spans = self._until, self._spans()
        if len(ends) < 2 or (ends[0], ends[-1]) != (self._times[0], self._times[-1]):
            return 0
        rows = [(ends[0], ends[0]), *pairwise(ends), (ends[-1], ends[-1])]
        k = 0
        for i, ((a, b), turn) in enumerate(zip(rows, self.motions, strict=True)):
            while k < len(spans) - 1 and a >= spans[k][1]:
                k += 1
            if not isinstance(turn, Rigid) or any(turn._pivot) or b > spans[k][1]:
                return i
            if a == b and max(turn.half_turn.degree, turn.x.degree, turn.y.degree) > 0:
                return i
            x, y, angle = spans[k][2]
            if angle_error(turn, a, b, angle, self._error) > self._error:
                return i
            if place_error_squared(turn, a, b, x, y) > self._place_error**2:
                return i
        return None

    @property
    def times(self) -> tuple[Fraction, ...]:
        """The times at which the pieces of the path begin, and the last one ends."""
        return fractions(self._times)

    @property
    def error(self) -> Fraction:
        """The largest error of the angle, in radians."""
        return fraction(self._error)

    @property
    def place_error(self) -> Fraction:
        """The largest error of the translation."""
        return fraction(self._place_error)

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
        if further < 0:
            raise InputError(f"a place_error is not negative: {show(further)}")
        total = self._place_error + further
        return PosePath.of_pieces(self.pieces, self._times, self._poses, self._error, total)

    def pose(self, t: Rational) -> tuple[Fraction, Fraction, Fraction]:
        """Return x, y and the angle of the path itself at a time."""
        x, y, angle = fractions(self._pose(rational(t)))
        return x, y, angle

    def _pose(self, t: QQ) -> tuple[QQ, QQ, QQ]:
        t = min(max(t, self._times[0]), self._times[-1])
        i = max(k for k, begin in enumerate(self._times[:-1]) if begin <= t)
        x, y, angle = (f._at(t - self._times[i]) for f in self._poses[i])
        return x, y, angle

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        (pieces,), _ = super()._given()
        times = tuple(map(str, self._times))
        return (pieces, times, self._poses, str(self._error), str(self._place_error)), {}

    def __reduce__(self) -> tuple[object, ...]:
        return PosePath.of_pieces, self._given()[0]

    def __repr__(self) -> str:
        start, end, error = (show(q) for q in (self._times[0], self._times[-1], self._error))
        pieces = counted(len(self._until) - 1, "piece")
        return f"<PosePath from t = {start} to {end}, {pieces}, error {error}>"


def _pose(i: int, row: Sequence[Coefficients]) -> Pose:
    if len(row) != 3:
        raise InputError(f"piece {i}: a pose is x, y and an angle: {shorten(row)}")
    x, y, angle = map(polynomial, row)
    return x, y, angle


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
