"""Functions of time in a window: quadratics with a bound on everything else.

A window of time is [middle - half, middle + half]. In it time runs as t = middle + half s, with s
in [-1, 1]. The model (c0, c1, c2, r) stands for every function f with

    |f(t) - (c0 + c1 s + c2 s^2)| <= r    for all s in [-1, 1].

       f  |            . - ' '     }  r
          |      _ - '_ .  - '
          |  . -'. - '             }  r     Every motion becomes models. What is special about
          |.' -'                            its formula ends here: filters see quadratics alone.
          +----------+----------> s
         -1          0          1

For functions of degree 1 or 2 the remainder r is rounding alone. For others it is of the third
order in the width: a window of a thousandth has a remainder of 10^-9.

Rounding. A term of a sum of products that goes through k operations is multiplied by a number
within 1 +- k U / (1 - k U) (Higham, lemma 3.1). So the error of the sum is at most about k U times
the sum of the sizes of all terms. Below, k is at most 10 with the errors of what is given: of
coefficients, and of a time since an origin.
The bound is `ROUNDING` = 16 U times that sum, as computed; the factor `SLACK` covers the rounding
of the bound.

Underflow. A product that underflows is off by at most 2^-1075. Coefficients are 0 or of size
2^-300 to 2^100 (or NaN), times are below `FARTHEST` = 2^100, and the divisor of `inverse` is above
2^-300. So later factors multiply that error by at most 2^400, and `TINY` = 2^-500 covers it. A
window that reaches farther has no model.

NaN and infinity. If a number overflows or is a NaN, the remainder is infinite or a NaN. No test of
a filter accepts such a bound.

Source: M. Berz, G. Hoffstaetter, "Computation and application of Taylor polynomials with interval
remainder bounds", Reliable Computing 4 (1998).
"""

from typing import Final

from librt.vecs import vec
from mypy_extensions import i64

from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U

Model = tuple[float, float, float, float]
"""c0, c1, c2 and the remainder r. A tuple, since compiled code keeps its numbers in registers."""

ROUNDING: Final = 16.0 * U
"""Error of a sum of products, relative to the sum of the sizes of its terms."""
FARTHEST: Final = 2.0**100
"""Time up to which there are models."""
LARGEST_POWER: Final = 2.0**400
"""Powers of the time up to which there are models of long polynomials."""
ONE: Final[float] = 1.0


def of_polynomial(c: vec[float], at: i64, middle: float, half: float) -> Model:
    """Return the model of c[at] + c[at + 1] t + c[at + 2] t^2 + c[at + 3] t^3.

    The coefficients may have relative errors up to U.

    By Horner's rule, the Taylor coefficients at the middle. The cubic term is left to the
    remainder. A coefficient goes through at most 6 operations, and with it at most three factors
    of the middle, which has an error of U if it is the time since an origin. The sizes of all terms
    that come from c[i] t^i add up to |c[i]| (|middle| + half)^i.
    """
    c0 = c[at]
    c1 = c[at + 1]
    c2 = c[at + 2]
    c3 = c[at + 3]
    reach = abs(middle) + half
    if not reach < FARTHEST:
        return c0, 0.0, 0.0, INFINITY
    value = c0 + middle * (c1 + middle * (c2 + middle * c3))
    slope = half * (c1 + middle * (2.0 * c2 + 3.0 * middle * c3))
    bend = half * half * (c2 + 3.0 * middle * c3)
    cubic = half * half * half * abs(c3)
    size = abs(c0) + reach * (abs(c1) + reach * (abs(c2) + reach * abs(c3)))
    rest = cubic + ROUNDING * size
    return value, slope, bend, rest * SLACK + TINY


def of_long_polynomial(c: vec[float], at: i64, terms: i64, middle: float, half: float) -> Model:
    """Return the model of a polynomial with any number of coefficients.

    The coefficients may have relative errors up to U. With R = |middle| + half, the third
    derivative is at most 6 times the sum of binomial(i, 3) |c[i]| R^(i - 3), so half^3 times that
    sum bounds the remainder. Horner's scheme finds the first three Taylor coefficients at the
    middle, and with the sizes at R it finds that sum and the sum of all |c[i]| R^i. In each step a
    term goes through 2 operations at most. So 4 U times the number of terms covers all rounding,
    with that of the time: as in `of_polynomial` the sizes of what comes from c[i] t^i add up to
    |c[i]| R^i.

    Underflow is covered if the powers of R stay below 2^400; else there is no model.
    """
    reach = abs(middle) + half
    if not is_small_power(reach, terms):
        return c[at], 0.0, 0.0, INFINITY
    # The Taylor coefficients of the polynomial at the middle.
    value = 0.0
    slope = 0.0
    bend = 0.0
    # Those of the polynomial of the sizes |c[i]|, at R.
    size = 0.0
    first = 0.0
    second = 0.0
    third = 0.0
    i = terms
    while i > 0:
        i -= 1
        bend = bend * middle + slope
        slope = slope * middle + value
        value = value * middle + c[at + i]
        third = third * reach + second
        second = second * reach + first
        first = first * reach + size
        size = size * reach + abs(c[at + i])
    cubic = half * half * half * third
    rounding = 4.0 * float(terms + 4) * U * size
    rest = cubic + rounding
    return value, half * slope, half * half * bend, rest * SLACK + TINY


def is_small_power(x: float, exponent: i64) -> bool:
    """Return True if a power of a number, which is not negative, is certainly below 2^400."""
    power = 1.0
    k: i64 = 0
    while k < exponent:
        power *= max(x, 1.0)
        k += 1
    return power < LARGEST_POWER and x < FARTHEST


def size_of(f: Model) -> float:
    """Return a bound of the quadratic, without the remainder."""
    # By positions: compiled, names for them cost a tenth of the time of a window.
    return abs(f[0]) + abs(f[1]) + abs(f[2])


def rest_of(f: Model) -> float:
    """Return the remainder r of a model."""
    return f[3]


def plus(f: Model, g: Model) -> Model:
    """Return the model of f + g."""
    f0, f1, f2, f_rest = f
    g0, g1, g2, g_rest = g
    size = size_of(f) + size_of(g)
    rest = f_rest + g_rest + ROUNDING * size
    return f0 + g0, f1 + g1, f2 + g2, rest * SLACK + TINY


def minus(f: Model, g: Model) -> Model:
    """Return the model of f - g."""
    g0, g1, g2, g_rest = g
    return plus(f, (-g0, -g1, -g2, g_rest))


def times(f: Model, g: Model) -> Model:
    """Return the model of f g.

    The terms in s^3 and s^4 go to the remainder, as does what the remainders of f and g add.
    """
    f0, f1, f2, f_rest = f
    g0, g1, g2, g_rest = g
    f_size = size_of(f)
    g_size = size_of(g)
    high = abs(f1 * g2) + abs(f2 * g1) + abs(f2 * g2)
    inherited = f_rest * (g_size + g_rest) + g_rest * f_size
    rest = high + inherited + ROUNDING * f_size * g_size
    value = f0 * g0
    slope = f0 * g1 + f1 * g0
    bend = f0 * g2 + f1 * g1 + f2 * g0
    return value, slope, bend, rest * SLACK + TINY


def inverse(w: Model) -> Model:
    """Return the model of 1 / w. The remainder is infinite unless w is near enough to a constant.

    With w = w0 (1 + e) and |e| <= q < 1 / 2,

        1 / w = (1 - e + e^2 - e^3 / (1 + e)) / w0,    where |e^3 / (1 + e)| <= q^3 / (1 - q).

    e is p = e1 s + e2 s^2, but for an error of at most e_rest. So e^2 is e1^2 s^2, but for
    |2 e1 e2| + e2^2 (the terms in s^3 and s^4 of p^2) and
    2 |p| e_rest + e_rest^2 <= e_rest (2 q + e_rest).
    A coefficient goes through at most 5 operations.
    """
    w0, w1, w2, w_rest = w
    if not abs(w0) > SMALL:
        return 0.0, 0.0, 0.0, INFINITY
    e1 = w1 / w0
    e2 = w2 / w0
    e_rest = abs(w_rest / w0)
    q = (abs(e1) + abs(e2) + e_rest) * SLACK
    if not q < 0.5:
        return 0.0, 0.0, 0.0, INFINITY
    cubic = q * q * q / (1.0 - q)
    square = abs(2.0 * e1 * e2) + e2 * e2 + e_rest * (2.0 * q + e_rest)
    rounding = ROUNDING * (1.0 + q + q * q)
    rest = (e_rest + square + cubic + rounding) / abs(w0)
    return 1.0 / w0, -e1 / w0, (e1 * e1 - e2) / w0, rest * SLACK + TINY


def turned(cosine: Model, sine: Model, c: float, s: float) -> tuple[Model, Model]:
    """Return the models of the cosine and the sine of an angle and a constant angle together.

    Args:
        cosine: that of the angle.
        sine: that of the angle.
        c: the cosine of the constant angle, with a relative error up to U.
        s: its sine, likewise.
    """
    cosine_of_both = minus(scaled(cosine, c), scaled(sine, s))
    sine_of_both = plus(scaled(sine, c), scaled(cosine, s))
    return cosine_of_both, sine_of_both


def moved(f: Model, by: float) -> Model:
    """Return the model of f and a constant, which is exact."""
    f0, f1, f2, f_rest = f
    rest = f_rest + ROUNDING * (abs(f0) + abs(by))
    return f0 + by, f1, f2, rest * SLACK + TINY


def scaled(f: Model, factor: float) -> Model:
    """Return the model of f times a number, which may have a relative error up to U."""
    f0, f1, f2, f_rest = f
    rest = abs(factor) * (f_rest + ROUNDING * size_of(f))
    return factor * f0, factor * f1, factor * f2, rest * SLACK + TINY


def turn(h: Model) -> tuple[Model, Model]:
    """Return the models of the cosine and of the sine of an angle, given the tangent h of its half.

    cos = 2 / (1 + h^2) - 1 and sin = h 2 / (1 + h^2). In a window in which h changes too much for
    `inverse`, the models are 0 with the remainder 1, which is true of each angle.
    """
    one: Model = (ONE, 0.0, 0.0, 0.0)
    i0, i1, i2, i_rest = inverse(plus(one, times(h, h)))
    if i_rest == INFINITY and size_of(h) + rest_of(h) < INFINITY:  # and not as h is unknown
        unknown: Model = (0.0, 0.0, 0.0, 1.0)
        return unknown, unknown
    twice: Model = (2.0 * i0, 2.0 * i1, 2.0 * i2, 2.0 * i_rest)
    return minus(twice, one), times(h, twice)
