"""The float enclosure of a trajectory: the doubles nearest to its coefficients."""

from __future__ import annotations

import math
from typing import Final, final

from mypy_extensions import mypyc_attr

from exactpt.kernel.error_free import is_exact_sum

__all__ = ["LARGEST", "SMALLEST", "Arm", "Image", "translated"]

SMALLEST: Final = 2.0**-300
LARGEST: Final = 2.0**100
"""Range of the size of nonzero coefficients that the filters accept.

Certificates are sums of products of two differences, or of three coefficients. A difference
of doubles of size 2^-300 or more is 0 or at least 2^-352. So no product underflows.
"""


@final
@mypyc_attr(acyclic=True)
class Arm:
    """A trajectory as that of a pivot and an arm that turns: p(t) + r(t) / w(t).

    It is normalised as an `Image` is; the relative error of each coefficient is at most one
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
class Image:
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
        arm: the trajectory once more, if it turns with a half turn of degree 1 about a pivot
            whose path has at most degree 2; else None.
        motion: vertices of equal ``motion`` keep their difference (translating) or
            their distances (turning) for ever; -1 is equal to nothing.
    """

    __slots__ = (
        "_xs",
        "_ys",
        "arm",
        "degree",
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
        # In this order, so that what a linear motion needs is in one place when compiled.
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
        self.arm: Arm | None = None

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
) -> tuple[list[Image], float]:
    """The enclosures of vertices that are translated: constants (place + shift) unit, and tails.

    The units are powers of two, so a sum of doubles is rounded once, to the nearest double, as
    long as the result is in the range of the filters.

    Args:
        places: the coordinates x and y of the vertices.
        shift: what is added to them.
        units: what the sums are multiplied by.
        tails: the coefficients of t, t^2, ... in x and in y.
        motion: the number of the motion.

    Returns:
        The enclosures, and the largest absolute value of a constant coefficient that is not
        exact, or 0.
    """
    (xs, ys), (dx, dy), (x_unit, y_unit), (x_tail, y_tail) = places, shift, units, tails
    images: list[Image] = []
    largest = 0.0
    for i in range(len(xs)):
        x, y = xs[i] + dx, ys[i] + dy
        x0, y0 = x * x_unit, y * y_unit
        if not (_in_range(x, x0) and _in_range(y, y0)):
            nan = [math.nan] * (len(x_tail) + 1)
            images.append(Image(nan, nan, [], motion))
            continue
        if abs(x0) > largest and not is_exact_sum(xs[i], dx, x):
            largest = abs(x0)
        if abs(y0) > largest and not is_exact_sum(ys[i], dy, y):
            largest = abs(y0)
        images.append(Image([x0, *x_tail], [y0, *y_tail], [], motion))
    return images, largest


def _in_range(before: float, scaled: float) -> bool:
    return before == 0.0 or SMALLEST <= abs(scaled) <= LARGEST
