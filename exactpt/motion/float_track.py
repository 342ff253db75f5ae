"""The float enclosure of a trajectory: the doubles nearest to its coefficients."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, final

from mypy_extensions import mypyc_attr

from exactpt.filters.error_free import is_exact_sum
from exactpt.filters.rounding import LARGEST, SMALLEST, U

if TYPE_CHECKING:
    from collections.abc import Callable


CANCELLING: Final = 64.0
"""Sums of terms that are larger by this factor, and not exact, lose too many digits."""


@final
@mypyc_attr(acyclic=True)
class Arm:
    """A trajectory as that of a pivot and an arm that turns: p(t) + r(t) / w(t).

    It is normalised as a `FloatTrack` is; the relative error of each coefficient is at most one
    unit. Vertices of one rigid motion have the same p and w.

    Attributes:
        p0, p1, p2, q0, q1, q2: x and y of the pivot.
        x0, x1, x2, y0, y1, y2: x and y of r.
        w0, w1, w2: the denominator, positive at every time.
        x, y: r / w at the time 0.
    """

    __slots__ = (
        "p0", "p1", "p2", "q0", "q1", "q2", "w0", "w1", "w2", "x", "x0", "x1", "x2", "y", "y0",
        "y1", "y2",
    )  # fmt: skip

    def __init__(
        self, p: list[float], q: list[float], x: list[float], y: list[float], w: list[float]
    ) -> None:
        self.p0: float = p[0]
        self.p1: float = p[1]
        self.p2: float = p[2]
        self.q0: float = q[0]
        self.q1: float = q[1]
        self.q2: float = q[2]
        self.x0: float = x[0]
        self.x1: float = x[1]
        self.x2: float = x[2]
        self.y0: float = y[0]
        self.y1: float = y[1]
        self.y2: float = y[2]
        self.w0: float = w[0]
        self.w1: float = w[1]
        self.w2: float = w[2]
        self.x: float = x[3]
        self.y: float = y[3]


@final
@mypyc_attr(acyclic=True)
class FloatTrack:
    """The doubles nearest to the normalised coefficients of a trajectory.

    With the error bounds `exactpt.motion.enclosures.Enclosures.errors` they enclose the trajectory.
    If a coefficient is neither 0 nor of size 2^-300 to 2^100, all of them are NaN, which no
    filter accepts.

    Attributes:
        x0, ..., x3, y0, ..., y3: the coefficients of a translating trajectory, up to t^3;
            0 above its degree.
        xs, ys: all coefficients; both lists have length ``degree`` + 1.
        ws: the denominator's coefficients if the trajectory turns, up to a power of two
            that makes the largest about 1; else empty (a constant denominator is divided out).
        degree: the degree of the trajectory; of the numerators if it turns.
        make_arm: what makes ``arm`` on first access; None if there is none, or
            it is made.
        motion: vertices of equal ``motion`` keep their difference (translating) or
            their distances (turning) for all times; -1 is equal to nothing.
    """

    __slots__ = (
        "_arm",
        "_xs",
        "_ys",
        "degree",
        "make_arm",
        "motion",
        "ws",
        "x0",
        "x1",
        "x2",
        "x3",
        "y0",
        "y1",
        "y2",
        "y3",
    )

    def __init__(self, xs: list[float], ys: list[float], ws: list[float], motion: int) -> None:
        # In this order, so that the fields of a linear motion are adjacent when compiled.
        self.motion: int = motion
        self.ws: list[float] = ws
        self.degree: int = len(xs) - 1
        self.x0: float = xs[0]
        self.y0: float = ys[0]
        self.x1: float = xs[1] if len(xs) > 1 else 0.0
        self.y1: float = ys[1] if len(ys) > 1 else 0.0
        self.x2: float = xs[2] if len(xs) > 2 else 0.0
        self.y2: float = ys[2] if len(ys) > 2 else 0.0
        self.x3: float = xs[3] if len(xs) > 3 else 0.0
        self.y3: float = ys[3] if len(ys) > 3 else 0.0
        is_linear = len(xs) <= 2 and not ws
        self._xs: list[float] | None = None if is_linear else xs
        self._ys: list[float] | None = None if is_linear else ys
        self._arm: Arm | None = None
        self.make_arm: Callable[[], Arm | None] | None = None

    @property
    def arm(self) -> Arm | None:
        """The trajectory once more, if it turns with a half turn of degree 1 about a pivot.

        None if it does not, or the path of the pivot has a degree above 2. Two threads may both
        make it: ``make_arm`` is dropped only when the result is known.
        """
        make = self.make_arm
        if make is not None:
            self._arm = make()
            self.make_arm = None
        return self._arm

    @property
    def xs(self) -> list[float]:
        """The coefficients of x."""
        return [self.x0, self.x1][: self.degree + 1] if self._xs is None else self._xs

    @property
    def ys(self) -> list[float]:
        """The coefficients of y."""
        return [self.y0, self.y1][: self.degree + 1] if self._ys is None else self._ys


def translated(
    places: tuple[list[float], list[float]],
    shift: tuple[float, float],
    units: tuple[float, float],
    tails: tuple[list[float], list[float]],
    motion: int,
) -> list[FloatTrack]:
    """Return the enclosures of translated vertices: constants (place + shift) unit, and tails.

    Args:
        places: the coordinates x and y of the vertices.
        shift: their translation.
        units: powers of two by which the sums are multiplied.
        tails: the coefficients of t, t^2, ... in x and in y.
        motion: the number of the motion.
    """
    (xs, ys), (dx, dy), (x_unit, y_unit), (x_tail, y_tail) = places, shift, units, tails
    float_tracks: list[FloatTrack] = []
    for i in range(len(xs)):
        x, y = xs[i] + dx, ys[i] + dy
        x0, y0 = x * x_unit, y * y_unit
        if _in_range(x, x0) and _in_range(y, y0):
            float_tracks.append(FloatTrack([x0, *x_tail], [y0, *y_tail], [], motion))
        else:
            nan = [math.nan] * (len(x_tail) + 1)
            float_tracks.append(FloatTrack(nan, nan, [], motion))
    return float_tracks


def constant_error(
    places: tuple[list[float], list[float]],
    shift: tuple[float, float],
    units: tuple[float, float],
    *,
    is_exact: bool,
) -> float:
    """Return a bound on the errors of the constants of `translated` that are in range.

    A sum of exact doubles is rounded once, by at most U |x|; multiplying by a power of two
    rounds nothing. If the terms a and b are the nearest doubles, the error is at most
    U (|a| + |b| + |x|), apart from a factor 1 + 2 U. The bounds are twice as large.

    Args:
        places: the coordinates x and y of the vertices.
        shift: their translation.
        units: powers of two by which the sums are multiplied.
        is_exact: whether the places and the shift are exact; else they are the nearest doubles.

    Returns:
        0 if nothing is rounded; -1 if terms that are not exact cancel, so that the bound would be
        much larger than the rounding of the result.
    """
    (xs, ys), (dx, dy), (x_unit, y_unit) = places, shift, units
    some = [
        i
        for i in range(len(xs))
        if _in_range(xs[i] + dx, (xs[i] + dx) * x_unit)
        and _in_range(ys[i] + dy, (ys[i] + dy) * y_unit)
    ]
    of_x = _axis_error([xs[i] for i in some], dx, x_unit, is_exact)
    of_y = _axis_error([ys[i] for i in some], dy, y_unit, is_exact)
    return -1.0 if of_x < 0.0 or of_y < 0.0 else max(of_x, of_y)


def _axis_error(values: list[float], d: float, unit: float, is_exact: bool) -> float:  # noqa: FBT001
    """`constant_error` of one coordinate."""
    terms, largest = 0.0, 0.0
    for a in values:
        x = a + d
        if not (is_exact and is_exact_sum(a, d, x)):
            largest = max(largest, abs(x))
            terms = max(terms, abs(a) + abs(d))
    if is_exact:
        return 2.0 * U * (largest * unit)
    return -1.0 if terms > CANCELLING * largest else 2.0 * U * ((largest + terms) * unit)


def _in_range(before: float, scaled: float) -> bool:
    return before == 0.0 or SMALLEST <= abs(scaled) <= LARGEST
