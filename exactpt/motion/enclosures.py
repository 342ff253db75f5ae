"""Float enclosures of trajectories: doubles with proven error bounds, in normalised units."""

from __future__ import annotations

import math
from collections.abc import Collection, Hashable, Sequence
from functools import partial
from itertools import chain, zip_longest
from typing import TYPE_CHECKING, Final, NamedTuple, final

import numpy as np

from exactpt.filters.rounding import LARGEST, SMALLEST, U
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, ZZ, nearest_float, power_of_two
from exactpt.kernel.polynomial import ONE
from exactpt.motion.float_track import Arm, FloatTrack, constant_error, translated
from exactpt.motion.normalization import Normalization, binary_exponent, combined
from exactpt.motion.track import Turning

if TYPE_CHECKING:
    from exactpt.kernel.doubles import Floats, Indices
    from exactpt.motion.course import Piece
    from exactpt.motion.track import Track

MAX_SCALED_EXPONENT: Final = 900
"""Largest absolute value of a scale 2^s by which doubles are multiplied."""
SMALLEST_OF_ARMS: Final = 2.0**-100
"""The same for `Arm`: certificates with arms have products of four coefficients."""
FEW: Final = 16
"""Number of trajectories from one look at the budget to the next."""
INTEGERS: Final = 2.0**53
"""All integers of smaller absolute value are doubles."""

_ONE: Final = (ZZ(1),)
_ZERO: Final = QQ(0)


class _Common(NamedTuple):
    """The common part of the arms of all vertices of a motion.

    Attributes:
        w, w_now: the constant coefficients of 1 + h^2, in the scene's and in normalised time.
        divisor: the power of two by which coefficients are divided.
        pivot_x, pivot_y: the path of the pivot.
        part_x, part_y: three coefficients of its product with 1 + h^2, in the scene's time.
        denominator: 1 + h^2, divided.
    """

    w: QQ
    w_now: QQ
    divisor: QQ
    pivot_x: list[float]
    pivot_y: list[float]
    part_x: list[QQ]
    part_y: list[QQ]
    denominator: list[float]


@final
class Enclosures:
    """The enclosures in a normalization: numbers for their rigid motions, bounds on their errors.

    Attributes:
        errors: ``errors[i]`` bounds the error of coefficient i of every enclosure of a
            translating trajectory made so far, in x and in y; 0 while all are exact.
    """

    def __init__(self, normalization: Normalization) -> None:
        self._normalization = normalization
        self._motions: dict[object, int] = {}
        self._velocities: Floats | None = None  # of the first motions, until `_motions` is needed
        self._named: int = 0
        self._turning: Turning | None = None  # of the last arm, and its common part
        self._common: _Common | None = None
        self.errors: list[float] = [0.0, 0.0]

    def of_piece(self, piece: Piece) -> list[FloatTrack]:
        """Return the enclosures of the trajectories of a piece of motion."""
        return self._translated(piece) or self.float_tracks(piece.tracks)

    def _translated(self, piece: Piece) -> list[FloatTrack] | None:
        """Return the enclosures of vertices that are translated, without their trajectories.

        None if doubles are not known, or would lose digits when they are added.
        """
        moved = piece.translation
        if moved is None or max(map(abs, self._normalization.scale)) > MAX_SCALED_EXPONENT:
            return None
        check_budget()
        places, translation = moved
        paths = translation.x.exact_coefficients, translation.y.exact_coefficients
        size = max(*map(len, paths), 1)
        (sx, sy), (cx, cy) = self._normalization.scale, self._normalization.center
        x_shift, x = self._path(paths[0], size, sx, cx)
        y_shift, y = self._path(paths[1], size, sy, cy)
        shift = nearest_float(x_shift), nearest_float(y_shift)
        if not (_is_near(shift[0], x_shift) and _is_near(shift[1], y_shift)):
            return None
        is_exact = places.is_exact and shift[0] == x_shift and shift[1] == y_shift
        motion = self._number((paths[0][1:], paths[1][1:]))
        tails = _floats(x, size - 1), _floats(y, size - 1)
        self.errors += [0.0] * (size - len(self.errors))
        if not (_moderate(tails[0]) and _moderate(tails[1])):
            nan = [math.nan] * size
            return [FloatTrack(nan, nan, [], motion)] * len(places[0])
        units = 2.0**-sx, 2.0**-sy
        error = constant_error((places.xs, places.ys), shift, units, is_exact=is_exact)
        if error < 0.0:
            return None
        self.errors[0] = max(self.errors[0], error)
        self._note_errors(x, tails[0], first=1)
        self._note_errors(y, tails[1], first=1)
        return translated((places.xs, places.ys), shift, units, tails, motion)

    def _path(
        self, path: Sequence[QQ], size: int, scale: int, center: QQ
    ) -> tuple[QQ, Sequence[QQ]]:
        """Return a coordinate of a translation in normalised time.

        Returns:
            The translation less the center, and the coefficients of t, t^2, ..., scaled.
        """
        if self._normalization.is_identity:
            return (path[0], path[1:]) if path else (_ZERO, path)
        shift, *tail = self._normalization.in_time([*path, *[_ZERO] * (size - len(path))])
        return shift - center, [c * power_of_two(-scale) for c in tail]

    def float_tracks(self, tracks: Sequence[Track]) -> list[FloatTrack]:
        """Return the enclosures of trajectories; fast if successive ones share their motion."""
        float_tracks: list[FloatTrack] = []
        motion, last = -1, None
        tails: tuple[list[float], list[float]] | None = None
        for k, track in enumerate(tracks):
            if k % FEW == 0:
                check_budget()
            if last is None or track.motion != last:
                motion, last = self._number(track.motion), track.motion
                tails = self._integer_tails(track)
            float_track = None if tails is None else _integer_float_track(track, *tails, motion)
            float_tracks.append(float_track or self._float_track(track, motion))
        return float_tracks

    def _number(self, motion: Hashable) -> int:
        """Return the number of a rigid motion, as in `Track.motion`; -1 for None."""
        if motion is None:
            return -1
        if self._velocities is not None:
            rates, self._velocities = self._velocities.tolist(), None
            for k, (x, y) in enumerate(rates):
                self._motions[(x,) if x else (), (y,) if y else ()] = k
        number = self._motions.setdefault(motion, self._named)
        self._named = max(self._named, number + 1)
        return number

    def begin_linear(self, velocities: Floats, error: float) -> Indices:
        """Assign numbers to linear translations with these velocities, the first enclosures.

        Args:
            velocities: shape (n, 2), exact.
            error: a bound on the errors of all constant coefficients.
        """
        self._velocities, numbers = np.unique(velocities, axis=0, return_inverse=True)
        self._named = len(self._velocities)
        self.errors[0] = error
        return numbers.reshape(-1)

    def _integer_tails(self, track: Track) -> tuple[list[float], list[float]] | None:
        """Return all but the constant coefficients of a trajectory, if they are small integers.

        Rounding is monotone and 2^53 is a double, so an integer rounded to less than 2^53
        is itself less, and hence a double.
        """
        if not self._normalization.is_identity or track.w != _ONE:
            return None
        x, y = ([nearest_float(QQ(c)) for c in part[1:]] for part in (track.x, track.y))
        if not all(abs(c) < INTEGERS for c in (*x, *y)):
            return None
        size = max(len(x), len(y))
        self.errors += [0.0] * (size + 1 - len(self.errors))
        return x + [0.0] * (size - len(x)), y + [0.0] * (size - len(y))

    def _float_track(self, track: Track, motion: int) -> FloatTrack:
        x, y, w = self._normalization.moved(track)
        size = max(len(x), len(y), 1)
        if len(w) > 1:
            size = max(size, len(w))
            # A common factor of x, y and w is free. The power of two rounds nothing.
            divisor = power_of_two(binary_exponent(QQ(max(map(abs, w)))))
            ws = _floats(_quotients(w, divisor), size)
        else:
            ws, divisor = [], QQ(w[0])
        x, y = _quotients(x, divisor), _quotients(y, divisor)
        xs, ys = _floats(x, size), _floats(y, size)
        self.errors += [0.0] * (size - len(self.errors))
        if not (_moderate(xs) and _moderate(ys) and _moderate(ws)):
            nan = [math.nan] * size
            return FloatTrack(nan, nan, nan if ws else [], motion)
        if not ws:
            self._note_errors(x, xs)
            self._note_errors(y, ys)
        float_track = FloatTrack(xs, ys, ws, motion)
        if isinstance(track.motion, Turning):
            common = self._common_of(track.motion)
            if common is not None:
                float_track.make_arm = partial(_arm, track, common, self._normalization)
        return float_track

    def _common_of(self, turning: Turning) -> _Common | None:
        """Return the common part of the arms of a motion's vertices; None if there is none."""
        if self._turning is not turning:
            self._turning, self._common = turning, _common_of(turning, self._normalization)
        return self._common

    @property
    def motion_count(self) -> int:
        """The number of different motions known."""
        return len(self._motions)

    def forget_motions(self, kept: Collection[int]) -> None:
        """Forget all motions but those in ``kept``: no enclosure has them any more."""
        self._motions = {key: i for key, i in self._motions.items() if i in kept}

    def _note_errors(self, exact: Sequence[QQ], floats: list[float], first: int = 0) -> None:
        # Rounding to nearest errs by at most U |c| / (1 + U), and so by at most U times the
        # double; doubled, for a margin. A third of it would be wrong: 1 + U (1 - epsilon)
        # becomes 1, with an error of nearly U. (gmpy2 compares a rational with a double exactly.)
        for i, (c, near) in enumerate(zip(exact, floats, strict=False), start=first):
            error = abs(near) * (2.0 * U)
            if error > self.errors[i] and c != near:
                self.errors[i] = error


def _arm(track: Track, common: _Common, normalization: Normalization) -> Arm | None:
    """Return the trajectory as a pivot and an arm, with w = 1 + h^2 for the half turn h.

    (The denominators of trajectories of one motion differ by constants.) None if the
    degrees are too large, or a coefficient is out of range.
    """
    factor = common.w / track.w[0]
    arms = []
    for x, part, scale in zip(
        (track.x, track.y), (common.part_x, common.part_y), normalization.scale, strict=True
    ):
        unit = power_of_two(-scale)
        r = [(a * factor - b) * unit for a, b in zip_longest(x[:3], part, fillvalue=QQ(0))]
        r = normalization.in_time(r)
        arms.append(
            [*_floats(_quotients(r, common.divisor), 3), *_floats([r[0] / common.w_now], 1)]
        )
    if not all(map(_fits_in_arms, chain(*arms))):
        return None
    arm_x, arm_y = arms
    return Arm(common.pivot_x, common.pivot_y, arm_x, arm_y, common.denominator)


def _common_of(turning: Turning, normalization: Normalization) -> _Common | None:
    """Return the common part of the arms of all vertices of a motion; None if there is none."""
    paths = turning.x.exact_coefficients, turning.y.exact_coefficients
    h = turning.half_turn
    w = ONE + h * h
    if w.degree > 2 or max(map(len, paths)) > 3:
        return None
    w_now = normalization.in_time(list(w.exact_coefficients))
    divisor = power_of_two(binary_exponent(max(map(abs, w_now))))
    pivots = [
        _floats(normalization.in_time(combined(list(path), [QQ(1)], -c, power_of_two(-scale))), 3)
        for path, c, scale in zip(paths, normalization.center, normalization.scale, strict=True)
    ]
    denominator = _floats(_quotients(w_now, divisor), 3)
    if not all(map(_fits_in_arms, chain(denominator, *pivots))):
        return None
    parts = ([*(w * path).exact_coefficients, *[QQ(0)] * 3][:3] for path in (turning.x, turning.y))
    (pivot_x, pivot_y), (part_x, part_y) = pivots, parts
    constants = w.exact_coefficients[0], w_now[0], divisor
    return _Common(*constants, pivot_x, pivot_y, part_x, part_y, denominator)


def _integer_float_track(
    track: Track, x: list[float], y: list[float], motion: int
) -> FloatTrack | None:
    """Return the enclosure with these higher coefficients, if it is exact; else None."""
    if track.w != _ONE:
        return None
    try:
        x0 = float(track.x[0]) if track.x else 0.0
        y0 = float(track.y[0]) if track.y else 0.0
    except OverflowError:
        return None
    if abs(x0) < INTEGERS and abs(y0) < INTEGERS:
        return FloatTrack([x0, *x], [y0, *y], [], motion)
    return None


def _quotients(coefficients: Sequence[QQ], divisor: QQ) -> Sequence[QQ]:
    return coefficients if divisor == 1 else [c / divisor for c in coefficients]


def _floats(coefficients: Sequence[QQ], size: int) -> list[float]:
    # Only 0 itself becomes 0.0: a number that underflows becomes NaN, as out of range.
    values = [nearest_float(c) or (math.nan if c else 0.0) for c in coefficients]
    return values + [0.0] * (size - len(values))


def _moderate(values: list[float]) -> bool:
    for v in values:  # noqa: SIM110 - called for every vertex
        if v != 0.0 and not SMALLEST <= abs(v) <= LARGEST:
            return False
    return True


def _is_near(near: float, exact: QQ) -> bool:
    """Return True if the relative error of the nearest double is at most a unit."""
    return near == exact or SMALLEST <= abs(near) <= LARGEST


def _fits_in_arms(v: float) -> bool:
    """Return True if products of four such numbers do not underflow."""
    return v == 0.0 or SMALLEST_OF_ARMS <= abs(v) <= LARGEST
