"""Piecewise polynomials of SciPy as exact curves that do not jump.

The coefficients of a curve are doubles. Where one piece ends and the next one begins, these differ
by some units in the last place: SciPy rounded the coefficients, and the exact values of the rounded
ones do not fit. A motion must not jump, so a curve is *closed up*: each piece is moved to where the
piece before it ends.

**The jump that is allowed.** Let piece i have the terms c_0, c_1 s, ..., c_n s^n, in the time s
since it begins, and the duration h. Its end is the sum of the terms c_k h^k. Each of them is
computed with a few roundings, and so is the constant term with which piece i + 1 begins. A rounding
changes a term by half an ulp (unit in the last place of a double). So a difference of some ulps *of
the largest of these terms* is rounding, and any other is a jump of the curve itself. `MAX_ULPS`
ulps are allowed; a larger difference is refused, for nobody knows which of the two ends is right.
(Of 150 random curves of each of the classes `CubicSpline`, `PchipInterpolator`,
`Akima1DInterpolator` and `CubicHermiteSpline`, none differs by more than 2.2 ulps.)

**The change by closing up.** Let f_i be piece i as given, g_i as closed up, and j_i the jump
from the end of f_(i-1) to the beginning of f_i. The piece keeps its shape, so g_i = f_i - S_i with
a constant S_i. The beginning of g_i is the end of g_(i-1):

    f_i - S_i = (f_i - j_i) - S_(i-1) there, so S_i = S_(i-1) + j_i, and S_0 = 0.

So the curve closed up differs from the given one by the running sum S_i of the jumps, in all of
piece i, and by at most the largest |S_i| anywhere. This is not an error of fitting: a caller who
means the curve as given does not get it, from the first jump on. It is a stated error of the curve,
and counts at every time.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Final, NamedTuple, Protocol, TypeAlias, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import (
    QQ,
    exponent,
    nearest_float,
    power_of_two,
    rational,
    shorten,
    show,
)
from exactpt.kernel.polynomial import Polynomial
from exactpt.kernel.square_root import root_bounds

MAX_ULPS: Final = 8
"""The largest jump that counts as rounding, in ulps of the largest term where it is."""
_DIGITS: Final = 52
"""Binary digits of a double after the first."""
_SUBNORMAL: Final = -1074
"""The exponent of the least positive double, which is the ulp of all smaller numbers."""


class PiecewisePolynomial(Protocol):
    """The attributes of ``scipy.interpolate.PPoly``, and of the splines derived from it.

    Attributes:
        c: coefficients, shape (k, m, columns), the highest power first, in the time since the
            beginning of the piece.
        x: m + 1 increasing breakpoints. Pieces of no duration are left out.
    """

    c: Any
    x: Any


@final
class ClosedCurve(NamedTuple):
    """A piecewise polynomial that does not jump.

    Attributes:
        times: the times at which its pieces begin, and the time at which the last one ends.
        pieces: for each piece and each column a polynomial of the time since the piece began.
        offsets: for each piece and each column the running sum of jumps: by as much the given curve
            is above this one.
    """

    times: tuple[QQ, ...]
    pieces: tuple[tuple[Polynomial, ...], ...]
    offsets: tuple[tuple[QQ, ...], ...]

    @property
    def degree(self) -> int:
        """The largest degree of a polynomial."""
        return max(f.degree for piece in self.pieces for f in piece)

    @property
    def place_offset(self) -> QQ:
        """A bound on the distance of this curve from the given one, in its columns x and y."""
        return max(_length(x, y) for x, y, *_ in self.offsets)


def closed_curve(curve: PiecewisePolynomial, columns: Sequence[str]) -> ClosedCurve:
    """Return a piecewise polynomial of SciPy, read exactly and closed up.

    Args:
        curve: ``PPoly``, ``CubicSpline`` or another object with the attributes ``c`` and ``x``.
        columns: the names of its columns, for messages.

    Raises:
        InputError: if it has other columns, is not a piecewise polynomial in powers of the time,
            repeats itself, has a coefficient or a breakpoint that is not a finite number, or jumps.
    """
    _check_form(curve, len(columns))
    breakpoints = _breakpoints(curve)
    given = _Pieces(curve, columns)
    kept = [i for i, (a, b) in enumerate(pairwise(breakpoints)) if a < b]
    if not kept:
        raise InputError(f"all pieces of the curve have no duration: {shorten(curve)}")
    offset = (QQ(0),) * len(columns)
    pieces, offsets = [given.terms(kept[0])], [offset]
    for before, i in pairwise(kept):
        terms = given.terms(i)
        duration = breakpoints[before + 1] - breakpoints[before]
        jumps = given.jumps(i, breakpoints[i], terms, given.terms(before), duration)
        offset = tuple(s + jump for s, jump in zip(offset, jumps, strict=True))
        pieces.append(terms)
        offsets.append(offset)
    return ClosedCurve(
        times=(breakpoints[kept[0]], *(breakpoints[i + 1] for i in kept)),
        pieces=tuple(
            tuple(Polynomial(f) - s for f, s in zip(terms, offset, strict=True))
            for terms, offset in zip(pieces, offsets, strict=True)
        ),
        offsets=tuple(offsets),
    )


Terms: TypeAlias = tuple[tuple[QQ, ...], ...]
"""The coefficients of each column of a piece, the constant one first."""


@final
class _Pieces:
    """The pieces of a curve as they are given."""

    def __init__(self, curve: PiecewisePolynomial, columns: Sequence[str]) -> None:
        self._curve = curve
        self._columns = columns

    def terms(self, i: int) -> Terms:
        """Return the coefficients of a piece.

        Raises:
            InputError: if one of them is not a finite number.
        """
        result = []
        for k, name in enumerate(self._columns):
            try:
                powers = [rational(c) for c in self._curve.c[:, i, k]]
            except InputError as error:
                raise InputError(f"piece {i}: a coefficient of {name}: {error}") from None
            result.append(tuple(reversed(powers)))
        return tuple(result)

    def jumps(
        self, i: int, t: QQ, terms: Terms, terms_before: Terms, duration: QQ
    ) -> tuple[QQ, ...]:
        """Return the jump of each column from the end of a piece to the beginning of the next.

        Args:
            i: the number of the latter.
            t: the time of its beginning.
            terms: its coefficients.
            terms_before: those of the piece that ends there.
            duration: the duration of the piece that ends there.

        Raises:
            InputError: if one of the jumps is more than rounding.
        """
        jumps, faults = [], []
        for name, after, before in zip(self._columns, terms, terms_before, strict=True):
            at_end = [c * duration**k for k, c in enumerate(before)]
            jump = after[0] - sum(at_end, QQ(0))
            jumps.append(jump)
            largest = max(abs(after[0]), *map(abs, at_end))
            if abs(jump) > MAX_ULPS * _ulp(largest):
                faults.append(f"{name} by {nearest_float(jump):.6g}")
        if faults:
            raise InputError(
                f"piece {i} jumps at t = {show(t)}: {', '.join(faults)}, more than {MAX_ULPS} ulps "
                f"of the largest term there; let it begin where the piece before it ends"
            )
        return tuple(jumps)


def _check_form(curve: PiecewisePolynomial, columns: int) -> None:
    """Refuse a curve whose attributes do not describe powers of the time in pieces."""
    if hasattr(curve, "c") and not hasattr(curve, "x"):
        raise InputError(
            f"a curve without breakpoints x: {shorten(curve)}; of a B-spline take "
            f"PPoly.from_spline, column by column"
        )
    shape: tuple[int, ...] = getattr(getattr(curve, "c", None), "shape", ())
    if len(shape) != 3 or shape[2] != columns or not shape[0]:
        what = {2: "curve in the plane", 3: "with three columns x, y, angle"}[columns]
        hint = "; PosePath.of_curve takes x, y and an angle"
        three = columns == 2 and shape[2:] == (3,)
        raise InputError(
            f"not a piecewise polynomial {what}: {shorten(curve)}{hint if three else ''}"
        )
    kinds = {kind.__name__ for kind in type(curve).__mro__}
    if "BPoly" in kinds:
        raise InputError(
            "a curve in the Bernstein basis: write PPoly.from_bernstein_basis(curve) instead"
        )
    if isinstance(extrapolate := getattr(curve, "extrapolate", None), str):
        raise InputError(
            f"the curve repeats itself, extrapolate = {shorten(extrapolate)}, and a motion does "
            f"not; to pass it once and rest, set curve.extrapolate = False"
        )


def _breakpoints(curve: PiecewisePolynomial) -> list[QQ]:
    """Return the breakpoints of a curve, which do not decrease."""
    times = []
    for i, t in enumerate(curve.x):
        try:
            times.append(rational(t))
        except InputError as error:
            raise InputError(f"breakpoint {i}: {error}") from None
    count = curve.c.shape[1] + 1
    if len(times) != count or count < 2:
        raise InputError(
            f"a curve has one breakpoint more than pieces: {len(times)} breakpoints, "
            f"{count - 1} pieces"
        )
    for i, (before, t) in enumerate(pairwise(times)):
        if t < before:
            raise InputError(
                f"breakpoint {i + 1}: times increase, got {show(t)} after {show(before)}"
            )
    return times


def _ulp(size: QQ) -> QQ:
    """Return the unit in the last place of doubles of this size, >= 0."""
    if not size:
        return power_of_two(_SUBNORMAL)
    e = exponent(size)  # of the leading binary digit, or one more or less
    while power_of_two(e) > size:
        e -= 1
    while power_of_two(e + 1) <= size:
        e += 1
    return power_of_two(max(e - _DIGITS, _SUBNORMAL))


def _length(x: QQ, y: QQ) -> QQ:
    """Return an upper bound on the length of a vector: itself if it is rational."""
    return root_bounds(x * x + y * y).high
