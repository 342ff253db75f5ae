"""The units of the rows of a scene: what doubles are relative to, so that they tell places apart.

Most scenes are read as they are. Others are read in units of their own:

    far in place     from a point near all bodies, where the nearest doubles would join them;
    far in time      from the start, where powers of the time would be large beside what moves;
    tiny or huge     times a power of two, where products of doubles would under- or overflow.

Units change no result: exact arithmetic has the numbers of the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from exactpt.filters.boxes import around_all
from exactpt.filters.rounding import FAR
from exactpt.filters.rows import Table
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.normalization import Normalization, binary_exponent

LARGEST_EXPONENT: Final = 64
"""Binary exponents of lengths and times that may keep their units are at most of this size."""
FEW_BITS: Final = 4
"""The same of times in units that are chosen: powers of a time are of its order then."""
TINIEST: Final = 2.0**-LARGEST_EXPONENT
ONE: Final = QQ(1)

PLAIN: Final = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
"""The units of most scenes: those in which they are given."""


def units_of(bodies: Sequence[Body], start: QQ, end: QQ) -> Normalization:
    """Return units for the rows of some bodies in a time span, from their exact places.

    Args:
        bodies: the bodies.
        start: the start of the span.
        end: its end.
    """
    places = []
    for body in bodies:
        check_budget()
        places += body.exact_at(start)
    xs, ys = [x for x, _ in places], [y for _, y in places]
    extent = max(max(xs) - min(xs), max(ys) - min(ys)) if places else ONE
    scale = _scale(binary_exponent(extent), LARGEST_EXPONENT)
    origin, time_scale = time_units(start, end)
    center = _center(xs, extent), _center(ys, extent)
    return Normalization(center, (scale, scale), origin, time_scale)


def are_plain_places(table: Table, t: float) -> bool:
    """Return True if the places of rows in plain units are neither far nor tiny nor huge.

    Args:
        table: the rows.
        t: the start of the time span.
    """
    left, right, bottom, top = around_all(table, t)
    extent = max(right - left, top - bottom)
    if not TINIEST < extent < 1.0 / TINIEST:
        return False
    return max(abs(left), abs(right), abs(bottom), abs(top)) <= FAR * extent


def are_plain_times(low: float, high: float) -> bool:
    """Return True if a span between two doubles is neither far from 0 nor very short or long."""
    duration = high - low
    if not TINIEST < duration < 1.0 / TINIEST:
        return False
    return max(abs(low), abs(high)) <= 0.5 * FAR * duration


def suits_high_degrees(low: float, high: float) -> bool:
    """Return True if high powers of a time span are about of the order of the span itself."""
    return 2.0**-FEW_BITS <= high - low <= 2.0**FEW_BITS


def time_units(start: QQ, end: QQ) -> tuple[QQ, int]:
    """Return the origin of the time, and the binary exponent of its unit."""
    duration = end - start
    is_far = max(abs(start), abs(end)) > QQ(FAR) * duration
    return (start if is_far else QQ(0)), _scale(binary_exponent(duration), FEW_BITS)


def _scale(exponent: int, largest: int) -> int:
    """Return the exponent of a unit: 0 unless it is needed."""
    return 0 if abs(exponent) <= largest else exponent


def _center(values: Sequence[QQ], extent: QQ) -> QQ:
    """Return one of some values, if they are far from 0 beside their distances; else 0."""
    if not values or max(map(abs, values)) <= QQ(FAR) * extent:
        return QQ(0)
    return values[0]
