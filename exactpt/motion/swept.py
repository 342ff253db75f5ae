"""Boxes proven to contain moving vertices during a time interval, in numpy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, final

import numpy as np

from exactpt.filters.rounding import SLACK, SMALL, TINY, U
from exactpt.geometry.boxes import Boxes, widen_unknown
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats, middles

if TYPE_CHECKING:
    from exactpt.motion.float_track import FloatTrack


NO_DRIFT: Final = np.zeros((2, 1))
"""The coefficients of a drift that is 0."""


@final
class SweptBoxes:
    """Float enclosures of trajectories as arrays, relative to a common drift.

    A motion common to all bodies, such as the velocity of a convoy, brings no two of them
    closer. So the drift is subtracted: the medians of the coefficients of t, t^2, ... over
    all translating vertices. Differences of positions are unchanged.

    Args:
        float_tracks: the enclosures.
        errors: their error bounds, see `exactpt.motion.enclosures.Enclosures`.
        drift: the coefficients of the drift; by default these medians, unless more vertices turn.

    Attributes:
        drift: the coefficients of the drift in x and in y, the constant (0) first.
    """

    def __init__(
        self,
        float_tracks: Sequence[FloatTrack],
        errors: Sequence[float],
        drift: Floats | None = None,
    ) -> None:
        size = max(float_track.degree for float_track in float_tracks) + 1
        if drift is not None:
            size = max(size, drift.shape[1])
        self._xs, self._ys, self._ws = (np.zeros((len(float_tracks), size)) for _ in range(3))
        self._turning = np.zeros(len(float_tracks), dtype=np.bool_)
        self.drift = np.zeros((2, size))
        if drift is not None:
            self.drift[:, : drift.shape[1]] = drift
        self.replace(0, float_tracks, errors)
        straight = ~self._turning & ~np.isnan(self._xs[:, 0])
        if drift is None and 2 * straight.sum() >= len(straight):
            for path, cs in zip(self.drift, (self._xs, self._ys), strict=True):
                path[1:] = middles(cs[straight, 1:])
                cs[~self._turning] -= path
            self._gather()

    def replace(
        self, first: int, float_tracks: Sequence[FloatTrack], errors: Sequence[float]
    ) -> bool:
        """Replace the enclosures from number ``first`` on, if none is of a larger degree.

        The drift stays as it is: any will do.

        Returns:
            Whether they have been replaced.
        """
        size = self._xs.shape[1]
        if any(float_track.degree >= size for float_track in float_tracks):
            return False
        for i, float_track in enumerate(float_tracks, start=first):
            rest = [0.0] * (size - 1 - float_track.degree)
            self._turning[i] = bool(float_track.ws)
            self._ws[i] = float_track.ws + rest if float_track.ws else 0.0
            self._xs[i], self._ys[i] = float_track.xs + rest, float_track.ys + rest
            if not float_track.ws:
                self._xs[i] -= self.drift[0]
                self._ys[i] -= self.drift[1]
        self._errors = np.array([*errors, *[0.0] * size][:size])
        self._gather()
        return True

    def _gather(self) -> None:
        """Put all polynomials below each other: numpy computes with them at once."""
        self._any_turning = bool(self._turning.any())
        parts = [self._xs, self._ys]
        if self._any_turning:
            parts += [self._ws, self.drift]  # the drift is exact
        self._rows: Floats = np.concatenate(parts)
        self._are_rounded: Floats = np.ones(len(self._rows))
        if self._any_turning:
            self._are_rounded[-2:] = 0.0

    @np.errstate(all="ignore")
    def during(self, low: Floats | float, high: Floats | float) -> Boxes:
        """Return a box for each trajectory less the drift, normalised, during low <= t <= high.

        For arrays of shape (k,), boxes during each of k intervals: of shape (k, n, 4).

        Around the middle m of the interval, r its half-width, a polynomial is
        c'_0 + c'_1 (t - m) + ..., so it is off c'_0 by at most sum |c'_i| r^i. Computing
        the c'_i by Horner's rule takes at most 2 n operations each; their errors times
        r^i add up to at most 4 n u sum |c_i| (|m| + r)^i, and the coefficients
        themselves are off by ``errors[i]`` (of turning trajectories: by 2 u |c_i|), and by
        another u |c_i| from the subtraction of the drift. `TINY` covers underflow: an error
        below 2^-1070 grows by (1 + |m| + r)^n at most, and where that is large the leading
        term, with a coefficient of 2^-300 or more, is larger. Where a bound is NaN, the box
        is the whole plane.
        """
        n = len(self._turning)
        lows, highs = self._ranges(low, high)
        x_low, y_low = lows[..., :n], lows[..., n : 2 * n]
        x_high, y_high = highs[..., :n], highs[..., n : 2 * n]
        if self._any_turning:
            w_low, w_high = lows[..., 2 * n : -2], highs[..., 2 * n : -2]
            x, y = (
                _difference(
                    _quotient(*place, w_low, w_high),
                    lows[..., k, None],
                    highs[..., k, None],
                )
                for k, place in ((-2, (x_low, x_high)), (-1, (y_low, y_high)))
            )
            x_low, x_high = np.where(self._turning, x, (x_low, x_high))
            y_low, y_high = np.where(self._turning, y, (y_low, y_high))
        boxes = np.stack((x_low, x_high, y_low, y_high), axis=-1)
        widen_unknown(boxes)
        return boxes

    def _ranges(self, low: Floats | float, high: Floats | float) -> tuple[Floats, Floats]:
        """Return bounds of all x, then all y; if a vertex turns, of all w, and the drift too."""
        cs, n = self._rows, self._rows.shape[1]
        m = np.asarray(0.5 * (low + high))[..., None]
        r = np.maximum(high - m[..., 0], m[..., 0] - low)[..., None] * (1.0 + 4.0 * U)
        shifted = np.broadcast_to(cs, (*m.shape[:-1], *cs.shape)).copy()
        for i in range(n - 1):
            check_budget()
            for j in range(n - 2, i - 1, -1):
                shifted[..., j] += m * shifted[..., j + 1]
        powers = r ** np.arange(n)
        spread = (np.abs(shifted[..., 1:]) @ powers[..., 1:, None])[..., 0]
        reach = (np.abs(m) + r) ** np.arange(n)
        rounding = (np.abs(cs) @ reach[..., None])[..., 0] * (16.0 * n * U)
        rounding += (reach @ self._errors)[..., None] * self._are_rounded
        radius = (spread + rounding) * SLACK + 4.0 * U * np.abs(shifted[..., 0]) + TINY
        return shifted[..., 0] - radius, shifted[..., 0] + radius

    @np.errstate(all="ignore")
    def places(self, times: Sequence[float]) -> Floats:
        """Return about the places of all vertices less the drift at some times: (k, n, 2).

        They are the middles of boxes; NaN where these are not known.
        """
        boxes = self.during(np.array(times), np.array(times))
        return 0.5 * (boxes[..., ::2] + boxes[..., 1::2])


def _difference(
    interval: tuple[Floats, Floats], low: Floats, high: Floats
) -> tuple[Floats, Floats]:
    """Return the range of x - y for x in an interval and y in [low, high]."""
    least, most = interval[0] - high, interval[1] - low
    return least - 2.0 * U * np.abs(least) - TINY, most + 2.0 * U * np.abs(most) + TINY


def _quotient(low: Floats, high: Floats, w_low: Floats, w_high: Floats) -> tuple[Floats, Floats]:
    """Return the range of a quotient with positive denominator; NaN if it may not be positive."""
    w_low = np.where(w_low > SMALL, w_low, np.nan)
    least = low / np.where(low < 0.0, w_low, w_high)
    most = high / np.where(high < 0.0, w_high, w_low)
    return least - 2.0 * U * np.abs(least) - TINY, most + 2.0 * U * np.abs(most) + TINY
