"""Dates with times (RFC 3339), and exact seconds since 1970-01-01T00:00:00Z without leap ones."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime, time, timedelta
from fractions import Fraction
from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, floor, fraction, parse_rational, shorten, show
from exactpt.scene.json_values import Json, Number, exact_number, shown

_TEXT: Final = re.compile(
    r"(\d{4}-\d\d-\d\d)[Tt ](\d\d:\d\d:\d\d)(\.\d+)?(?:([Zz])|([+-])(\d\d)(?::?(\d\d))?)?", re.ASCII
)
_DAY: Final = 86_400
_EPOCH: Final = date(1970, 1, 1)


def is_date(text: str) -> bool:
    """Return True if a text has the form of a date with a time."""
    return _TEXT.fullmatch(text) is not None


def seconds_of(data: Json, where: str) -> QQ:
    """Return the seconds of a date with a time, which may have any number of decimals.

    Without a time zone it is in UTC; a number is milliseconds.

    Raises:
        InputError: if it is neither.
    """
    if isinstance(data, Number):
        return exact_number(data, where) / 1000
    match = _TEXT.fullmatch(data) if isinstance(data, str) else None
    try:
        if match is None:
            raise ValueError
        day, clock, decimals, _, sign, hours, minutes = match.groups()
        at = time.fromisoformat(clock)
        days = (date.fromisoformat(day) - _EPOCH).days
        offset = [int(part or 0) for part in (hours, minutes)]
        if offset[0] > 23 or offset[1] > 59:
            raise ValueError
    except ValueError:
        raise InputError(f"{where}: not a date with a time: {shown(data)}") from None
    whole = days * _DAY + at.hour * 3600 + at.minute * 60 + at.second
    zone = (offset[0] * 3600 + offset[1] * 60) * (-1 if sign == "-" else 1)
    return QQ(whole - zone) + (parse_rational(f"0{decimals}") if decimals else 0)


def from_datetime(at: datetime | str) -> Fraction:
    """Return the exact seconds since 1970-01-01T00:00:00Z, as scenes of moving features have them.

    >>> from_datetime("2026-09-01T12:00:00.5Z") - from_datetime("2026-09-01T12:00:00Z")
    Fraction(1, 2)

    Args:
        at: a datetime, or a text as in RFC 3339; without a time zone it is in UTC.

    Raises:
        InputError: if it is neither.
    """
    if not isinstance(at, datetime):
        return fraction(seconds_of(at, "datetime"))
    since = (at if at.tzinfo else at.replace(tzinfo=UTC)) - datetime(1970, 1, 1, tzinfo=UTC)
    return Fraction(since // timedelta(microseconds=1), 10**6)


def to_datetime(time: Rational | AlgebraicNumber) -> datetime:
    """Return the datetime in UTC of seconds since 1970-01-01T00:00:00Z.

    It is rounded to the nearest microsecond, of two to an even one.

    >>> to_datetime(from_datetime("2026-09-01T12:00:00.5Z")).isoformat()
    '2026-09-01T12:00:00.500000+00:00'

    Raises:
        InputError: if its year is not from 1 to 9999.
    """
    exact = time if isinstance(time, AlgebraicNumber) else AlgebraicNumber(time)
    try:
        since = timedelta(microseconds=int(round(exact, 6) * 10**6))
        return datetime(1970, 1, 1, tzinfo=UTC) + since
    except OverflowError:
        when = show(exact.exact_low) if exact.is_rational else repr(float(exact))
        raise InputError(f"a date has a year from 1 to 9999: t = {when}") from None


def instant_of(seconds: QQ) -> str:
    """Return the date with the time in UTC, with as many decimals as it takes.

    Raises:
        InputError: if it has no finite decimals, or its year is not from 1 to 9999.
    """
    whole = int(floor(seconds))
    digits = _decimals(seconds - whole)
    try:
        at = datetime(1970, 1, 1) + timedelta(seconds=whole)
    except OverflowError:
        raise InputError(f"a date has a year from 1 to 9999: t = {show(seconds)}") from None
    return f"{at.isoformat()}{digits}Z"


def _decimals(part: QQ) -> str:
    """Return the decimals of a number in [0, 1), with the point; empty for 0."""
    if not part:
        return ""
    rest, twos, fives = int(part.denominator), 0, 0
    while rest % 2 == 0:
        rest, twos = rest // 2, twos + 1
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    if rest > 1:
        raise InputError(f"a date needs a decimal number of seconds, got {shorten(show(part))}")
    places = max(twos, fives)
    return f".{int(part * 10**places):0{places}}"
