"""Each bound of the filter of degree 3 to 6 by itself, in exact arithmetic."""

import itertools
import math
import random
from fractions import Fraction

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st
from strategies import small

from exactpt.certificates import sextics
from exactpt.kernel.numbers import QQ, rational
from fuzz.filter_attacks import Case, answer, hostile, judge
from fuzz.references.real_roots import value

U = Fraction(1, 2**53)


def padded(values):
    return [*values, *[0.0] * (7 - len(values))]


def fraction(q):
    return Fraction(int(q.numerator), int(q.denominator))


def hostile_polynomial(rng):
    """Doubles, the g[i] of their bounds, and the true coefficients."""
    case = hostile(rng, rng.randint(1, 6))
    c, e = padded(case.c), padded(case.e)
    g = [sextics.UNIT * abs(x) + b for x, b in zip(c, e, strict=True)]
    return c, g, [*map(fraction, case.true), *[Fraction(0)] * (7 - len(case.true))]


def at(f, x):
    return sum(c * x**i for i, c in enumerate(f))


def window(rng):
    a = rng.choice([0.0, 1.0, -1.0, rng.uniform(-3, 3), rng.uniform(-1, 1) * 2.0**20])
    return a, rng.choice([1.0, 2.0**-20, rng.uniform(0, 4), 2.0**20 * rng.random() + 1e-9])


def computed_on(c, a, h, cuts, *, without_constant=False):
    """The Bernstein coefficients as the filter finds them, after some cuts to a quarter."""
    scaled = sextics._scaled(*c, a, h)
    scaled = [x * 2.0 ** (-2 * cuts * k) for k, x in enumerate(scaled)]
    if without_constant:
        scaled[0] = 0.0
    return [scaled[0], *sextics._sums(*scaled)]


def polar(f, arguments):
    """The symmetric multi-affine form of f, of as many arguments as the degree of the list."""
    symmetric = [Fraction(1)]
    for x in arguments:
        symmetric = [
            p + x * q for p, q in zip([*symmetric, 0], [Fraction(0), *symmetric], strict=True)
        ]
    n = len(arguments)
    return sum(c * symmetric[i] / math.comb(n, i) for i, c in enumerate(f) if c)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_the_bound_holds_for_bernstein_coefficients(seed):
    """The far end rounded, the window cut to quarters."""
    rng = random.Random(seed)
    for _ in range(150):
        c, g, true = hostile_polynomial(rng)
        a, h = window(rng)
        cuts = rng.choice([0, 0, 1, 2, 5])
        computed = computed_on(c, a, h, cuts)
        h *= 0.25**cuts
        ends = [Fraction(a)], [Fraction(a + h)]

        bound = Fraction(sextics._bound(*g, abs(a) + h))

        for k in range(7):
            exact = polar(true, ends[0] * (6 - k) + ends[1] * k)
            assert abs(Fraction(computed[k]) - exact) <= bound


@pytest.mark.parametrize("seed", range(6))
def test_the_bound_holds_for_the_quotient_by_a_root(seed):
    """The coefficients of p / (t - r) on [r, b], wherever in now r is."""
    rng = random.Random(seed)
    for _ in range(150):
        c, g, true = hostile_polynomial(rng)
        a, h = window(rng)
        width = h * rng.choice([0.0, 2.0**-52, 2.0**-40, rng.random()])
        r = Fraction(a) + Fraction(width) * rng.randint(0, 8) / 8
        true[0] -= at(true, r)
        end = Fraction(a + h)
        if end < r:
            continue
        quotient = [Fraction(0)] * 6  # by Horner's rule
        for i in range(5, -1, -1):
            quotient[i] = true[i + 1] + (quotient[i + 1] * r if i < 5 else 0)
        computed = computed_on(c, a, h, 0, without_constant=True)

        t = abs(Fraction(a)) + Fraction(h)
        bound = Fraction(sextics._bound(0.0, *g[1:], float(t))) * Fraction(h) / t
        bound *= 1 + 5 * Fraction(width) / (32 * U * t)

        for k in range(1, 7):
            exact = polar(quotient, [r] * (6 - k) + [end] * (k - 1)) * Fraction(h) / 6
            assert abs(Fraction(computed[k]) / k - exact) <= bound


@pytest.mark.parametrize("seed", range(6))
def test_the_bound_holds_for_values(seed):
    rng = random.Random(seed)
    for _ in range(300):
        c, g, true = hostile_polynomial(rng)
        x = rng.choice([rng.uniform(-3, 3), rng.uniform(-1, 1) * 2.0 ** rng.randint(-40, 40)])

        bound = Fraction(sextics._bound(*g, abs(x)))

        assert abs(Fraction(sextics._value(*c, x)) - at(true, Fraction(x))) <= bound


@given(
    f=st.lists(small, min_size=4, max_size=7).filter(lambda f: f[-1] != 0),
    low=small,
    width=st.integers(1, 4),
    guess=st.floats(-1, 6),
)
def test_tightening_keeps_the_root(f, low, width, guess):
    high = low + width
    first, last = value(f, low), value(f, high)
    s = (first > 0) - (first < 0)
    inside = [value(f, low + Fraction(width * k, 64)) * s > 0 for k in range(65)]
    if s == 0 or last * s >= 0 or sum(x != y for x, y in itertools.pairwise(inside)) != 1:
        return
    c = padded([float(x) for x in f])
    g = [sextics.UNIT * abs(x) for x in c]

    l, r = sextics._tighten(*c, *g, float(low), float(high), low + guess, float(s))

    assert low <= l < r <= high
    assert value(f, Fraction(l)) * s > 0
    assert value(f, Fraction(r)) * s < 0
    assert r - l < 0.01


# What the filter is asked in a run


def case_of(c, now, horizon, *, at_root=False, width=0.0):
    exact = tuple(map(rational, c))
    e = (0.0,) * len(c)
    return Case(exact, tuple(c), e, QQ(now), now - width, now + width, horizon, at_root)


@every("width", [0.0, 1e-15])
@every("horizon", [2.5, 3.5, 10.0, 1000.0])
def test_the_root_after_a_root(horizon, width):
    """(t - 2)(t - 3)(t - 5)(t^2 + 1) at 2: negative no more, until 3."""
    c = [-30.0, 31.0, -40.0, 32.0, -10.0, 1.0]
    case = case_of(c, 2, horizon, at_root=True, width=width)

    s, low, high = answer(case)

    assert s == 1
    assert low <= 3.0 <= high if horizon > 3 else low == math.inf
    assert judge(case, (s, low, high)) == ""


@pytest.mark.parametrize("error", [1.0, 1.5])
def test_an_unknown_slope_at_a_root_decides_nothing(error):
    """It vanishes at 0, with the slope 1 or not; it falls later in any case."""
    c, e = padded([0.0, 1.0, -3.0, -3.0]), padded([0.0, error])

    assert sextics.sextic(*c, *e, 0.0, 0.0, 4.0, at_root=True)[0] == 0


@pytest.mark.parametrize("gap", [2.0**-4, 2.0**-8, 2.0**-12])
def test_two_roots_close_together_are_told_apart(gap):
    """((t - 1)^2 - gap^2)(t^2 + 1)(t^2 + 4): the first of them, however far the horizon is."""
    pair = [1.0 - gap * gap, -2.0, 1.0]
    c = [0.0] * 7
    for i, p in enumerate(pair):
        for j, q in enumerate([4.0, 0.0, 5.0, 0.0, 1.0]):
            c[i + j] += p * q
    case = case_of(c, 0, 100.0)

    s, low, high = answer(case)

    assert s == 1
    assert low <= 1.0 - gap <= high
    assert high - low < 1e-8
    assert judge(case, (s, low, high)) == ""


def test_now_near_zero_is_told_although_the_horizon_is_far():
    """2^-40 + t + t^6 now: the error of a window up to 1000 is far larger than that."""
    case = case_of([2.0**-40, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0], 0, 1000.0)

    assert answer(case) == (1, math.inf, math.inf)


def test_bug_newton_left_the_window_for_another_root():
    """A coefficient known to 1.35 only, and a polynomial that is said to vanish now.

    Newton's method found no root in the window of 4e-6, and its last step led to another
    root, where the signs were right as well.
    """
    c = [
        0.0,
        0.3354526640686834,
        -0.04571264894983673,
        -0.012858158836144072,
        -0.00019418129663412322,
    ]
    e = [
        1.346292616361,
        4.0657581468206416e-17,
        6.5865281978494394e-18,
        3.1170812458958252e-19,
        5.421010862427522e-20,
    ]

    s, low, high = sextics.sextic(
        *padded(c),
        *padded(e),
        -4.671144025639079,
        -4.671144025639043,
        -4.671139570888958,
        at_root=True,
    )

    assert s == 0 or low == math.inf or low <= high <= -4.671139570888958
