"""The normalisation of space and time in which doubles compute.

It shifts and scales: x' = (x - cx) / 2^s, likewise y with a scale of its own,
t' = (t - t0) / 2^r. The signs of orientations and of differences of coordinates, and the order
of times, stay as they are. So the filters work as well for a scene that is far from the origin,
or very small or large, as for any other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, power_of_two
from exactpt.kernel.polynomial import substituted

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.motion.track import Track


class Reach(NamedTuple):
    """The numbers of a scene by which its normalisation is chosen.

    Attributes:
        x, y: the least and the greatest coordinate.
        span: the start and the end of the time.
    """

    x: tuple[QQ, QQ]
    y: tuple[QQ, QQ]
    span: tuple[QQ, QQ]


@final
class Normalization:
    """A normalisation of space and time.

    Attributes:
        center, scale, origin, time_scale: x' = (x - center[0]) / 2^scale[0], likewise y;
            t' = (t - origin) / 2^time_scale.
        reach: the numbers by which it was chosen; None if it was not chosen for a scene.
        is_identity: whether it changes nothing.
        only_scales: whether it shifts nothing.
    """

    def __init__(
        self,
        center: tuple[QQ, QQ],
        scale: tuple[int, int],
        origin: QQ,
        time_scale: int,
        reach: Reach | None = None,
    ) -> None:
        self.center = center
        self.scale = scale
        self.origin = origin
        self.time_scale = time_scale
        self.reach = reach
        self.only_scales: bool = center == (QQ(0), QQ(0)) and origin == 0
        self.is_identity: bool = self.only_scales and scale == (0, 0) and time_scale == 0

    def point(self, position: tuple[QQ, QQ]) -> tuple[float, float]:
        """Return the doubles nearest to a normalised position."""
        if self.is_identity:
            return nearest_float(position[0]), nearest_float(position[1])
        return (
            nearest_float((position[0] - self.center[0]) * power_of_two(-self.scale[0])),
            nearest_float((position[1] - self.center[1]) * power_of_two(-self.scale[1])),
        )

    def time(self, t: QQ) -> tuple[float, float]:
        """Doubles that enclose a rational time, normalised."""
        if self.is_identity:
            return enclosing_floats(t)
        return enclosing_floats((t - self.origin) * power_of_two(-self.time_scale))

    def enclosure(self, t: AlgebraicNumber) -> tuple[float, float]:
        """Doubles that enclose an algebraic time, normalised; at most two ulps apart."""
        if self.is_identity:
            return t.enclosure()
        while not t.is_rational:
            lo, hi = self.time(t.exact_low)[0], self.time(t.exact_high)[1]
            if hi <= math.nextafter(math.nextafter(lo, math.inf), math.inf):
                return lo, hi
            t.refine()
        return self.time(t.exact_low)

    def exact_time(self, t: float) -> QQ:
        """Return the rational time of which a double is the normalised value."""
        return QQ(*t.as_integer_ratio()) * power_of_two(self.time_scale) + self.origin

    def in_time(self, f: list[QQ]) -> list[QQ]:
        """Return a polynomial in the scene's time as one in normalised time."""
        return substituted(f, self.origin, power_of_two(self.time_scale))

    def moved(self, track: Track) -> tuple[Sequence[QQ], Sequence[QQ], Sequence[QQ]]:
        """Return the exact normalised coefficients of a trajectory, up to a common factor."""
        if self.is_identity:
            return track.x, track.y, track.w  # type: ignore[return-value]
        if self.only_scales:
            sx, sy = self.scale
            return self._scaled(track.x, sx), self._scaled(track.y, sy), self._scaled(track.w, 0)
        cx, cy = self.center
        x, y, w = ([QQ(c) for c in part] for part in (track.x, track.y, track.w))
        x = combined(x, w, -cx, power_of_two(-self.scale[0]))
        y = combined(y, w, -cy, power_of_two(-self.scale[1]))
        return self.in_time(x), self.in_time(y), self.in_time(w)

    def _scaled(self, f: Sequence[int], scale: int) -> list[QQ]:
        """Return a polynomial in the scene's time, over 2^scale, as one in normalised time."""
        return [c * power_of_two(i * self.time_scale - scale) for i, c in enumerate(f)]


def combined(f: list[QQ], g: list[QQ], a: QQ, factor: QQ) -> list[QQ]:
    """(f + a g) * factor."""
    size = max(len(f), len(g))
    f = f + [QQ(0)] * (size - len(f))
    g = g + [QQ(0)] * (size - len(g))
    return [(x + a * y) * factor for x, y in zip(f, g, strict=True)]


def normalization_for(points: Sequence[tuple[QQ, QQ]], start: QQ, end: QQ) -> Normalization:
    """Return a normalisation in which these points and the time span are of moderate size.

    It shifts and scales only where needed, so that the integers of an ordinary scene stay
    unchanged.
    """
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return normalization_of(Reach((min(xs), max(xs)), (min(ys), max(ys)), (start, end)))


def normalization_of(reach: Reach) -> Normalization:
    """Return the normalisation for a scene of this reach, see `normalization_for`.

    Its exponents are differences of the lengths of these numbers: so they are bounded by the
    length of the text in which the numbers were read.
    """
    start, end = reach.span
    cx, sx = _axis(*reach.x)
    cy, sy = _axis(*reach.y)
    span = end - start
    r = binary_exponent(span)
    r = 0 if -10 <= r <= 10 else r
    far = max(abs(start), abs(end)) > 16 * span
    return Normalization((cx, cy), (sx, sy), start if far else QQ(0), r, reach)


def _axis(low: QQ, high: QQ) -> tuple[QQ, int]:
    """Return the center and the scale of a coordinate between two values.

    The center is the value of least size if the others are near it: then doubles stay
    doubles, being multiples of its last bit. If 0 is between the two, no value is near another
    compared with its size, and the center is 0.
    """
    extent = high - low
    least = low if low > 0 else high
    is_far = low * high > 0 and abs(least) > 16 * extent
    exponent = binary_exponent(extent or max(abs(low), abs(high)))
    return (least if is_far else QQ(0)), (0 if -20 <= exponent <= 20 else exponent)


def binary_exponent(value: QQ) -> int:
    """About the binary exponent of a number; 0 for 0."""
    if value == 0:
        return 0
    return abs(value.numerator).bit_length() - value.denominator.bit_length()
