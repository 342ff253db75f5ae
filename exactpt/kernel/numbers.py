"""Integers and rationals: the only module that imports gmpy2.

gmpy2 ships no type stubs. For the type checker `ZZ` is ``int`` and `QQ` is
``Fraction``, which have the same interface; so a float mixed with an exact
number is a type error (at run time gmpy2 would silently return an inexact
``mpfr``).
"""

from __future__ import annotations

import math
import operator
import re
import sys
from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeAlias

import gmpy2

from exactpt.brief import cut, in_brief
from exactpt.errors import InputError
from exactpt.filters.rounding import FAR

if TYPE_CHECKING:
    ZZ = int
    QQ = Fraction

    def gcd(*values: ZZ) -> ZZ:
        """Return the greatest common divisor, never negative."""

    def isqrt(value: ZZ) -> ZZ:
        """Return the integer part of the square root of ``value >= 0``."""

    def isqrt_rem(value: ZZ) -> tuple[ZZ, ZZ]:
        """Return the integer part r of the square root of ``value >= 0``, and ``value - r * r``."""

    def is_square(value: ZZ) -> bool:
        """Return True if ``value`` is the square of an integer."""

    def digits(value: ZZ, width: int) -> list[ZZ]:
        """Return the digits of ``value >= 0`` in base 2^width, lowest first."""

else:
    QQ = gmpy2.mpq
    ZZ = gmpy2.mpz
    gcd = gmpy2.gcd
    isqrt = gmpy2.isqrt
    isqrt_rem = gmpy2.isqrt_rem
    is_square = gmpy2.is_square
    digits = gmpy2.unpack


class SupportsRatio(Protocol):
    """A number that is a ratio of integers: numpy's floats, a rational `AlgebraicNumber`."""

    def as_integer_ratio(self) -> tuple[int, int]:
        """Return the numerator and the positive denominator, without a common factor."""
        ...


Rational: TypeAlias = "int | Fraction | QQ | float | str | Decimal | SupportsRatio"
"""What a caller may pass as a number; see `rational`."""

_NUMBER: Final = re.compile(
    r"([+-]?\d++)(?:/(\d++))?\Z|([+-]?)(\d*+)\.?(\d*+)(?:[eE]([+-]?\d{1,18}))?\Z", re.ASCII
)  # possessive quantifiers: no backtracking, so a long invalid text takes linear time
_EXPONENT_LIMIT: Final = 100_000
_MAX_DECIMALS: Final = 15
"""Maximum number of decimals of a coordinate in a message; with more it is a quotient."""
_INTEGERS: Final = 1 << 53
_EXACT: Final[type[QQ]] = type(QQ())
_INEXACT: Final = ("bool", "mpfr")
"""Names of refused types; before numpy 2.3 its booleans have an ``__index__``."""


def sign(value: QQ | ZZ) -> int:
    """-1, 0 or 1."""
    return (value > 0) - (value < 0)


def floor(value: QQ) -> ZZ:
    """Return the largest integer at most ``value``."""
    return ZZ(value.numerator // value.denominator)


def ceil(value: QQ) -> ZZ:
    """Return the smallest integer at least ``value``."""
    return ZZ(-(-value.numerator // value.denominator))


def exponent(value: QQ) -> int:
    """Return the binary logarithm of a positive number, to within 1."""
    return int(value.numerator.bit_length() - value.denominator.bit_length())


def power_of_two(exponent: int) -> QQ:
    """2**exponent; the exponent may be negative."""
    one = ZZ(1)
    return QQ(one << exponent) if exponent >= 0 else QQ(one, one << -exponent)


def fraction(value: QQ) -> Fraction:
    """Return the number as a ``Fraction``, for callers outside the package.

    gmpy2's numbers stay inside: in gmpy2 2.3, `limit_denominator` frees the number it is
    called on if it returns that number itself. So a number that callers and the package both
    read has two attributes: ``scene.start`` is a ``Fraction``, and ``scene.exact_start`` the
    same number of GMP. Attributes and methods that begin with ``exact_`` are for the code of
    the package, and are not in the reference of the public interface.
    """
    return Fraction(int(value.numerator), int(value.denominator))


def fractions(values: Iterable[QQ]) -> tuple[Fraction, ...]:
    """Return the numbers as ``Fraction``."""
    return tuple(map(fraction, values))


def place(point: tuple[QQ, QQ]) -> tuple[Fraction, Fraction]:
    """Return the point with coordinates as ``Fraction``."""
    return fraction(point[0]), fraction(point[1])


def parse_rational(text: str) -> QQ:
    """Return the number written as ``"p"``, ``"p/q"``, ``"1.25"`` or ``"-3e-2"``, exactly.

    Raises:
        InputError: if the text is none of these, a denominator is 0, or a decimal
            exponent is beyond ±100,000 (its digits alone would fill the memory).
    """
    match = _NUMBER.match(text)
    if match is None:
        raise InputError(f"not a number: {shorten(text)}")
    whole, denominator, minus, units, decimals, exponent = match.groups()
    if whole is not None:
        if denominator is None:
            return QQ(ZZ(whole))
        q = ZZ(denominator)
        if q == 0:
            raise InputError(f"denominator is zero: {shorten(text)}")
        return QQ(ZZ(whole), q)
    digits = units + decimals
    if not digits:
        raise InputError(f"not a number: {shorten(text)}")
    power = int(exponent or 0)
    if abs(power) > _EXPONENT_LIMIT:
        raise InputError(f"exponent beyond {_EXPONENT_LIMIT}: {shorten(text)}")
    power -= len(decimals)
    value = QQ(ZZ(digits))
    scale: ZZ = ZZ(10) ** abs(power)
    value = value * scale if power >= 0 else value / scale
    return -value if minus == "-" else value


def shorten(text: object, limit: int = 60) -> str:
    """Return the ``repr`` of a value, cut so that a message stays one readable line."""
    try:
        shown = " ".join(repr(text).splitlines())
    except Exception:  # an integer has more digits than Python writes, or a caller's class fails
        return in_brief(text, limit)
    return cut(shown, limit)


def show(*numbers: QQ) -> str:
    """Return a number, or (x, y), as text for a message; long numbers are cut.

    The coordinates of a point are short decimals where these are exact, as in files of shapes.
    """
    if len(numbers) == 1:
        return shorten(str(numbers[0]))[1:-1]
    return f"({', '.join(shorten(_short_decimal(q) or str(q))[1:-1] for q in numbers)})"


def show_points(points: Sequence[tuple[QQ, QQ]], most: int = 3) -> str:
    """Return points as text for a message: the first ones, and how many more there are.

    >>> show_points([(QQ(k), QQ(k, 2)) for k in range(5)])
    '(0, 0) and (1, 0.5) and (2, 1) and 2 more'
    """
    words = " and ".join(show(*point) for point in points[:most])
    more = len(points) - most
    return f"{words} and {more} more" if more > 0 else words


def _short_decimal(value: QQ) -> str | None:
    """Return a number with at most `_MAX_DECIMALS` decimals, written so; None for another one.

    >>> _short_decimal(QQ(-13383529, 1000000)), _short_decimal(QQ(1, 3)), _short_decimal(QQ(7))
    ('-13.383529', None, '7')
    """
    scaled = value * 10**_MAX_DECIMALS
    if scaled.denominator != 1:
        return None
    digits = str(abs(scaled.numerator)).rjust(_MAX_DECIMALS + 1, "0")
    decimals = digits[-_MAX_DECIMALS:].rstrip("0")
    minus = "-" if value < 0 else ""
    return f"{minus}{digits[:-_MAX_DECIMALS]}{decimals and '.'}{decimals}"


def of_double(x: float) -> QQ:
    """Return the value of a finite double."""
    return QQ(*x.as_integer_ratio())


def rational(value: Rational) -> QQ:
    """Return the exact rational that ``value`` denotes.

    Accepts ints, Fractions, Decimals, gmpy2 ``mpz`` and ``mpq``, numpy integers, finite
    floats including numpy's (their exact binary value), the strings of `parse_rational`, and
    an `AlgebraicNumber` that is rational.

    Raises:
        InputError: for anything else (booleans, NaN, infinities, inexact ``mpfr``, irrational
            numbers).
    """
    if isinstance(value, _EXACT):
        return value
    if isinstance(value, str):
        return parse_rational(value)
    if isinstance(value, float):  # numpy.float64 too
        if not math.isfinite(value):
            raise InputError(f"not a finite number: {shorten(value)}")
        return of_double(value)
    if isinstance(value, Decimal):  # as text, which bounds the exponent
        return parse_rational(str(value))
    if type(value).__name__ in _INEXACT:
        raise InputError(f"not an exact number: {shorten(value)}")
    try:
        if hasattr(value, "numerator") and hasattr(value, "denominator"):
            return QQ(ZZ(int(value.numerator)), ZZ(int(value.denominator)))
        if hasattr(value, "as_integer_ratio"):
            return QQ(*map(int, value.as_integer_ratio()))
        # numpy integers have no denominator
        return QQ(ZZ(operator.index(value)))  # type: ignore[arg-type]
    except InputError:
        raise
    except (OverflowError, ValueError):
        raise InputError(f"not a finite number: {shorten(value)}") from None
    except TypeError:  # an array's __index__ and a class's numerator do not give a number
        raise InputError(f"not a number: {shorten(value)}") from None


def as_doubles(values: list[Any]) -> list[float] | None:
    """Return the values as doubles; None unless each is a finite ``float`` or small ``int``.

    Of the types derived from these only ``numpy.float64`` counts; integers are small if all
    of their size are doubles. A list of floats is returned itself.
    """
    for value in values:
        if type(value) is not float:
            break
    else:
        if math.isfinite(sum(values)):  # then each is
            return values
    result: list[float] = []
    for value in values:
        kind = type(value)
        if kind is int:
            if not -_INTEGERS <= value <= _INTEGERS:
                return None
        elif not (kind is float or (isinstance(value, float) and kind.__module__ == "numpy")):
            return None
        near = float(value)
        if not -math.inf < near < math.inf:
            return None
        result.append(near)
    return result


def rationals(values: object, count: int, what: str) -> tuple[QQ, ...]:
    """Exactly ``count`` rationals.

    Raises:
        InputError: if there are more or fewer; the message begins with ``what``.
    """
    listed = list(values) if isinstance(values, Iterable) else None
    if listed is None or isinstance(values, str) or len(listed) != count:
        raise InputError(f"{what}: {shorten(values)}")
    return tuple(map(rational, listed))


def nearest_float(value: QQ | float) -> float:
    """Return the double nearest to ``value``; ±inf beyond the largest double.

    gmpy2 and ``fractions`` round correctly, but for too large a value the former
    returns inf and the latter raises.
    """
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def relative_doubles(values: Sequence[QQ]) -> tuple[list[float], QQ]:
    """Return the doubles nearest to the values less an origin, and the origin.

    That is the first value where all are close together but far from 0 (`FAR`), so that rounding
    keeps them apart; else 0.
    """
    near = [nearest_float(value) for value in values]
    least, most = min(near), max(near)
    if max(-least, most) <= FAR * (most - least):  # false also if both are infinite
        return near, QQ(0)
    origin = values[0]
    return [nearest_float(value - origin) for value in values], origin


def finite(x: float) -> float:
    """x, with infinities replaced by the largest finite double: JSON has no infinity."""
    return min(max(x, -sys.float_info.max), sys.float_info.max)


def enclosing_floats(value: QQ) -> tuple[float, float]:
    """Return the tightest doubles lo <= value <= hi; equal if and only if value is a double."""
    near = nearest_float(value)
    if math.isinf(near):
        largest = math.nextafter(math.inf, 0.0)
        return (largest, near) if near > 0 else (near, -largest)
    exact = QQ(*near.as_integer_ratio())
    if exact == value:
        return near, near
    if exact < value:
        return near, math.nextafter(near, math.inf)
    return math.nextafter(near, -math.inf), near
