"""Arrays of doubles from a caller's arrays, without loss."""

from __future__ import annotations

from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from exactpt.errors import InputError
from exactpt.filters.rounding import check_rounding
from exactpt.kernel.numbers import shorten

Floats: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[np.int64]
Flags: TypeAlias = NDArray[np.bool_]

INTEGERS: Final = 2.0**53
"""All integers of at most this absolute value are doubles."""


def doubles(values: ArrayLike, what: str, *, finite: bool = True) -> Floats:
    """Return the values as float64, all of them finite.

    Args:
        values: floats of at most 64 bits, or integers that are doubles.
        what: their name in the message.
        finite: False for an array that may contain infinities and NaN.

    Raises:
        InputError: if a value is not a number, not finite, or not a double.
        RoundingError: see `check_rounding`.
    """
    check_rounding()
    try:
        given = np.asarray(values)
    except ValueError:
        raise InputError(f"{what}: not an array: {shorten(values)}") from None
    if given.dtype.kind not in "fiu":
        raise InputError(f"{what}: not an array of numbers: {shorten(values)}")
    with np.errstate(all="ignore"):
        result = given.astype(np.float64, copy=False)
    if given.dtype.kind != "f":
        large = np.asarray(np.abs(result) > INTEGERS)
        exact = given[large].astype(object) == result[large].astype(object)
        large[large] = ~exact.astype(bool)
        _refuse(large, given, what, "not a double")
    elif given.dtype.itemsize > 8:
        lost = result.astype(given.dtype) != given
        _refuse(lost & (given == given), given, what, "not a double")  # noqa: PLR0124 - not NaN
    if finite:
        _refuse(~np.isfinite(result), given, what, "not a finite number")
    return result


def finite_rows(values: ArrayLike, what: str) -> tuple[Floats, dict[int, str]]:
    """Return the values as `doubles`, 0 instead of those not finite, and the rows of these.

    Returns:
        The array, and by the number of a row, the first index, why it has no finite numbers.
    """
    array = doubles(values, what, finite=False)
    good = np.isfinite(array)
    if not array.ndim or good.all():
        return (array if array.ndim else doubles(values, what)), {}
    faults: dict[int, str] = {}
    for at in np.argwhere(~good).tolist():
        value = array[tuple(at)]
        faults.setdefault(at[0], f"{what}{at}: not a finite number: {value!s}")
    return np.where(good, array, 0.0), faults


def indices(values: ArrayLike, what: str) -> Indices:
    """Return the values as int64.

    Raises:
        InputError: if a value is not an integer.
    """
    try:
        given = np.asarray(values)
    except ValueError:
        raise InputError(f"{what}: not an array: {shorten(values)}") from None
    if given.dtype.kind not in "iu" and given.size:
        raise InputError(f"{what}: not an array of integers: {shorten(values)}")
    return given.astype(np.int64)


def view(vector: Any) -> NDArray[Any]:  # noqa: ANN401 - its type is that of no buffer
    """Return the items of a vector of librt, not copied, until it changes."""
    return np.asarray(memoryview(vector))


def items(array: NDArray[Any]) -> Any:  # noqa: ANN401 - argument of a vector of librt
    """Return the items of an array in memory order, of which a vector makes no objects."""
    return np.ascontiguousarray(array).reshape(-1).data


def native(counts: Indices) -> NDArray[np.intp]:
    """Return counts or indices as `numpy.repeat`, ``reduceat`` and `numpy.bincount` take them.

    That is as integers of a pointer's size: where it has 32 bits, they take no others.
    """
    return counts.astype(np.intp, copy=False)


def first_true(flags: Flags) -> tuple[int, ...] | None:
    """Return the indices of the first true entry; None if there is none."""
    if not flags.any():
        return None
    return tuple(int(i) for i in np.unravel_index(int(flags.argmax()), flags.shape))


def _refuse(wrong: Flags, given: NDArray[np.generic], what: str, why: str) -> None:
    at = first_true(wrong)
    if at is not None:
        place = f"[{', '.join(map(str, at))}]" if at else ""
        raise InputError(f"{what}{place}: {why}: {given[at]!s}")


def middles(rows: Floats) -> Floats:
    """Return the upper median of each column of one or more rows.

    The first use of ``np.median`` imports ``numpy.ma``, which takes longer than many a question.
    """
    middle: Floats = np.sort(rows, axis=0)[len(rows) // 2]
    return middle
