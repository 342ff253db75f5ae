"""Doubles, decimals and dyadic rationals near an algebraic number, or a quotient at one.

Results depend on the number alone (and on its polynomial where stated), never on how far
its interval has been refined, so printed output is the same in every run.
"""

from __future__ import annotations

import math
import sys
from decimal import MAX_EMAX, MAX_PREC, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal
from numbers import Integral
from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import IntPoly, range_on, scale, sign_at, subtract
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    enclosing_floats,
    floor,
    nearest_float,
    power_of_two,
    shorten,
)

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.isolated_root import IsolatedRoot

LARGEST_BITS: Final = 500
"""Maximum bit length of coefficients as floats: products with powers of t seldom overflow."""
MAX_STEPS: Final = 60
"""Maximum number of Newton steps."""
SETTLED: Final = 2.0**-30
"""Relative length of the last Newton step: the error left is about its square."""
ROUNDING: Final = 2.0**-54
"""First galloping step, relative to the size of the terms."""


def nearest_double(x: IsolatedRoot) -> float:
    """Return the nearest double (ties, possible only for a rational, to even); ±inf on overflow."""
    while True:
        low, high = nearest_float(x.exact_low), nearest_float(x.exact_high)
        if low == high:
            return low + 0.0  # never -0.0
        if high == math.nextafter(low, math.inf):
            # Rounding changes at the midpoint of two neighbours.
            middle = (_exact(low) + _exact(high)) / 2
            side = x.compare_rational(middle)
            return nearest_float(middle) if side == 0 else high if side > 0 else low
        x.refine()


def _exact(x: float) -> QQ:
    """Return the value of a double; for an infinity, the value the next double would have."""
    if math.isinf(x):
        return power_of_two(1024) if x > 0 else -power_of_two(1024)
    return QQ(*x.as_integer_ratio())


def enclosing_doubles(x: IsolatedRoot) -> tuple[float, float]:
    """Doubles lo <= x <= hi: equal if x is a double, else neighbours."""
    near = nearest_float(x.exact_low)
    if near == nearest_float(x.exact_high) and math.isfinite(near):
        exact = _exact(near)
        # Both ends round to this double, and neither end equals x unless both do.
        if exact <= x.exact_low:
            return near, (near if exact == x.exact_high else math.nextafter(near, math.inf))
        if exact >= x.exact_high:
            return math.nextafter(near, -math.inf), near
    guessing = len(x.exact_polynomial) > 3
    while True:
        lo, hi = enclosing_floats(x.exact_low)[0], enclosing_floats(x.exact_high)[1]
        between = math.nextafter(lo, math.inf)
        if hi <= between:
            return lo, hi
        if hi == math.nextafter(between, math.inf):
            x.compare_rational(_exact(between))
        elif guessing:
            _narrow_around_guess(x)
            guessing = False
        else:
            x.refine()


def _narrow_around_guess(x: IsolatedRoot) -> None:
    """Narrow x by exact comparisons with doubles around a root estimated in floats.

    A wrong estimate does no harm: the comparisons with x stay valid, only less useful.
    """
    lo, hi = nearest_float(x.exact_low), nearest_float(x.exact_high)
    shift = max(0, max(abs(c) for c in x.exact_polynomial).bit_length() - LARGEST_BITS)
    f = [float(c >> shift) for c in reversed(x.exact_polynomial)]
    rises, t = _value_and_slope(f, hi)[0] > 0.0, (lo + hi) / 2
    for _ in range(MAX_STEPS):
        value, slope = _value_and_slope(f, t)
        lo, hi = (lo, t) if (value > 0.0) == rises else (t, hi)
        step = value / slope if slope else math.inf
        t, last = (t - step, t) if lo < t - step < hi else ((lo + hi) / 2, t)
        if abs(t - last) <= SETTLED * abs(t):
            break
    # The rounding error of f bounds the distance to x: gallop from a fraction of it.
    size, slope = _value_and_slope([abs(c) for c in f], abs(t))[0], abs(_value_and_slope(f, t)[1])
    step = max(math.ulp(t), ROUNDING * size / slope if slope else math.inf)
    side = 0 if not math.isfinite(t) else x.compare_rational(_exact(t))
    while side and math.isfinite(t := t + side * step):
        if x.compare_rational(_exact(t)) != side:
            break
        step *= 2.0


def _value_and_slope(f: list[float], t: float) -> tuple[float, float]:
    """Return the value and the derivative at t of a polynomial, leading coefficient first."""
    value = slope = 0.0
    for c in f:
        slope = slope * t + value
        value = value * t + c
    return value, slope


def canonical_interval(x: IsolatedRoot) -> tuple[QQ, QQ]:
    """See `AlgebraicNumber.canonical_interval`."""
    if x.simplified().is_rational:
        return x.exact_low, x.exact_high
    bits = 64
    while True:
        check_budget()
        grid = power_of_two(-bits)
        m = _floor_on_grid(x, grid)
        low, high = m * grid, (m + 1) * grid
        if _is_alone_in(x, low, high):
            return low, high
        bits *= 2


def _is_alone_in(x: IsolatedRoot, low: QQ, high: QQ) -> bool:
    if x.exact_low <= low and high <= x.exact_high:
        return True
    from exactpt.kernel.sturm import count_roots, sturm_sequence

    return (
        sign_at(x.exact_polynomial, low) != 0
        and count_roots(sturm_sequence(x.exact_polynomial), low, high) == 1
    )


def rational_between(x: IsolatedRoot, y: IsolatedRoot) -> QQ:
    """Return the dyadic rational of least denominator strictly between x and y, x < y.

    The leftmost if there are several.
    """
    # A grid point between x and y belongs to all finer grids too: gallop, then bisect.
    coarse, bits = -1, 0
    while y.compare_rational(found := _next_on_grid(x, bits)) <= 0:
        check_budget()  # in a forged state, x may be y or more
        coarse, bits = bits, 2 * bits + 1
    while bits - coarse > 1:
        middle = (coarse + bits) // 2
        candidate = _next_on_grid(x, middle)
        if y.compare_rational(candidate) > 0:
            bits, found = middle, candidate
        else:
            coarse = middle
    return found


def multiple_before(x: IsolatedRoot, grid: QQ) -> QQ:
    """Return the largest multiple of ``grid`` > 0 that is smaller than x."""
    m = _floor_on_grid(x, grid)
    return (m if x.compare_rational(m * grid) > 0 else m - 1) * grid


def _next_on_grid(x: IsolatedRoot, bits: int) -> QQ:
    """Return the least multiple of 2^-bits that is larger than x."""
    grid = power_of_two(-bits)
    return (_floor_on_grid(x, grid) + 1) * grid


def _floor_on_grid(x: IsolatedRoot, grid: QQ) -> ZZ:
    """Return the largest integer m with m * grid <= x."""
    x.refine_to(grid)
    m = floor(x.exact_low / grid)
    while x.compare_rational((m + 1) * grid) >= 0:
        m += 1
    return m


# Quotients of polynomials at algebraic times, correctly rounded


def exponent(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> int:
    """About the binary exponent of p / w at a time; the least integer if p vanishes there."""
    if time.sign_of(p) == 0:
        return -sys.maxsize
    while True:
        check_budget()
        low, high = _range(p, w, time.exact_low, time.exact_high)
        least = low if low > 0 else -high
        if least > 0:
            return least.numerator.bit_length() - least.denominator.bit_length()
        time.refine()


def nearest_quotient(p: IntPoly, w: IntPoly, time: AlgebraicNumber) -> float:
    """Return the double nearest to p / w at a time, at which w is positive."""
    if time.sign_of(p) == 0:
        return 0.0
    while True:
        check_budget()
        low, high = _range(p, w, time.exact_low, time.exact_high)
        a, b = nearest_float(low), nearest_float(high)
        if a == b:
            return a
        if b == math.nextafter(a, math.inf) and math.isfinite(a + b):
            middle = (QQ(*a.as_integer_ratio()) + QQ(*b.as_integer_ratio())) / 2
            f = subtract(scale(p, ZZ(middle.denominator)), scale(w, ZZ(middle.numerator)))
            s = time.sign_of(f)
            return nearest_float(middle) if s == 0 else b if s > 0 else a
        time.refine()


def decimal_quotient(p: IntPoly, w: IntPoly, time: AlgebraicNumber, digits: int) -> Decimal:
    """Return the decimal nearest to p / w at a time, at which w is positive; of two, the even one.

    Args:
        p: the numerator.
        w: the denominator.
        time: any real algebraic number; it is refined.
        digits: the number of significant digits, at least 1.

    Raises:
        InputError: if ``digits`` is not an integer from 1 to the most that `decimal` has.
    """
    if not isinstance(digits, Integral) or not 1 <= digits <= MAX_PREC:
        raise InputError(f"digits: at least 1, at most {MAX_PREC}: {shorten(digits)}")
    context = rounding_context(digits)
    if time.sign_of(p) == 0:
        return Decimal(0)
    while True:
        check_budget()
        low, high = _range(p, w, time.exact_low, time.exact_high)
        a, b = rounded_decimal(low, context), rounded_decimal(high, context)
        if a == b:
            return a
        if b == context.next_plus(a):
            middle = (QQ(*a.as_integer_ratio()) + QQ(*b.as_integer_ratio())) / 2
            f = subtract(scale(p, ZZ(middle.denominator)), scale(w, ZZ(middle.numerator)))
            s = time.sign_of(f)
            return rounded_decimal(middle, context) if s == 0 else b if s > 0 else a
        time.refine()


def rounding_context(digits: int) -> Context:
    """Return the context that rounds to some digits, whatever the caller's contexts do."""
    return Context(digits, ROUND_HALF_EVEN, MIN_EMIN, MAX_EMAX, capitals=1, clamp=0, traps=[])


def rounded_decimal(q: QQ, context: Context) -> Decimal:
    """Return the decimal nearest to a rational."""
    return context.divide(Decimal(int(q.numerator)), Decimal(int(q.denominator)))


def _range(p: IntPoly, w: IntPoly, low: QQ, high: QQ) -> tuple[QQ, QQ]:
    a, b = range_on(p, low, high)
    c, d = range_on(w, low, high)
    if c <= 0:
        c = QQ(1, 1 << 4096)  # w is positive: any positive bound will do until refinement
    return (a / d if a > 0 else a / c), (b / c if b > 0 else b / d)
