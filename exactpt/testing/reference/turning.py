"""Where points are after a turn by an angle: cosine and sine by their series, in rationals.

No rational function of time turns by omega t, so these points have no track: the places at one time
are known to any number of bits. `Spin` and `PosePath` approximate such motions within a stated
error, which these places judge. (First contacts of such bodies are in `fuzz/references`.)
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import count
from typing import TypeAlias

from exactpt.kernel.numbers import QQ, Rational, fraction, power_of_two, rational

__all__ = ["cosine_and_sine", "turned"]

Point: TypeAlias = tuple[Fraction, Fraction]


def cosine_and_sine(angle: Rational, bits: int) -> Point:
    """Return the cosine and the sine of an angle, both to within 2^-bits.

    >>> c, s = cosine_and_sine("355/113", bits=64)
    >>> float(c), float(s)
    (-0.9999999999999645, -2.667641890624221e-07)

    Args:
        angle: the angle in radians.
        bits: the number of bits.
    """
    x, small = rational(angle), power_of_two(-bits)
    cosine, sine = QQ(0), QQ(0)
    for n, term in _terms(x):
        # Terms alternate in sign, and fall from here on: the rest is less than the next one.
        if n > abs(x) and abs(term) < small:
            break
        if n % 2:
            sine += term
        else:
            cosine += term
    return fraction(cosine), fraction(sine)


def _terms(x: QQ) -> Iterator[tuple[int, QQ]]:
    """Yield n and the term of degree n of both series: x^n / n!, times 1, 1, -1, -1, 1, ..."""
    term = QQ(1)
    for n in count():
        yield n, term if n % 4 < 2 else -term
        term = term * x / (n + 1)


def turned(
    points: Sequence[tuple[Rational, Rational]],
    pivot: tuple[Rational, Rational],
    angle: Rational,
    bits: int,
) -> list[Point]:
    """Return points after a turn about a pivot, each coordinate to within 2^-bits.

    >>> turned([(3, 1)], pivot=(2, 1), angle=0, bits=64)
    [(Fraction(3, 1), Fraction(1, 1))]

    Args:
        points: the points.
        pivot: the center.
        angle: the angle in radians, counter-clockwise.
        bits: the number of bits.
    """
    px, py = map(rational, pivot)
    arms = [(rational(x) - px, rational(y) - py) for x, y in points]
    longest = max((abs(x) + abs(y) for x, y in arms), default=QQ(0))
    c, s = map(rational, cosine_and_sine(angle, bits + int(longest).bit_length()))
    return [(fraction(px + c * x - s * y), fraction(py + s * x + c * y)) for x, y in arms]
