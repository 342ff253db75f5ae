"""The float filters may be unsure, but never wrong: hostile cases against the exact kernel."""

import itertools
import math
import random
from collections import Counter
from fractions import Fraction

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, small

from exactpt.certificates import first_root as filters
from exactpt.certificates import root_windows as windows
from exactpt.kernel.numbers import QQ, rational
from fuzz.filter_attacks import Case, answer, extreme, generic, hostile, judge, variants
from fuzz.references.real_roots import value

DEGREES = [1, 2, 2, 2, 3, 4, 5, 6, 7, 8, 8]
NOTHING = (math.inf, math.inf)
SOME = [1.0, -3.0, 1.5, 0.25, 2.0, 1.0, -0.5, 0.125]
"""Coefficients, so many as are asked for."""


def attack(seed, cases, make=hostile):
    """What was decided wrongly, and how many answers were judged."""
    rng, wrong, judged = random.Random(seed), [], 0
    for _ in range(cases):
        case = make(rng, rng.choice(DEGREES))
        said = answer(case)
        for one in (case, *variants(rng, case, said)):
            judged += said[0] != 0
            if fault := judge(one, said):
                wrong.append((fault, said, one))
    return wrong, judged


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_no_hostile_case_is_decided_wrongly(seed):
    wrong, judged = attack(seed, 1_000)

    assert wrong == []
    assert judged > 700


@pytest.mark.parametrize("seed", range(2))
def test_no_extreme_case_is_decided_wrongly(seed):
    """Doubles of any size, up to the ends of their range: nothing is assumed of them."""
    wrong, judged = attack(seed, 1_000, extreme)

    assert wrong == []
    assert judged > 200


@pytest.mark.slow
def test_none_of_100_000_extreme_cases_is_decided_wrongly():
    wrong, judged = attack(100, 100_000, extreme)

    assert wrong == []
    assert judged > 20_000


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 110))
def test_none_of_200_000_hostile_cases_is_decided_wrongly(seed):
    wrong, judged = attack(seed, 20_000)

    assert wrong == []
    assert judged > 20_000


def decided(d, cases):
    rng = random.Random(d)
    asked = [generic(rng, d) for _ in range(cases)]
    answers = [answer(case) for case in asked]
    assert [f for case, said in zip(asked, answers, strict=True) if (f := judge(case, said))] == []
    return sum(said[0] != 0 for said in answers) / cases


@pytest.mark.long("4")
@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_generic_certificates_are_decided(d):
    """Three random points on paths of degree d, from a root of another certificate: 99 in 100."""
    assert decided(d, 400) > 0.99


# Each bound by itself, in exact arithmetic


def doubles_near(rng, degree):
    case = hostile(rng, degree)
    return list(case.c), list(case.e), list(case.true)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_the_bernstein_error_bounds_every_coefficient(seed):
    """The float window against the blossom over `Fraction`, the far end rounded as it is used."""
    rng = random.Random(seed)
    for _ in range(150):
        degree = rng.randint(1, 8)
        c, e, true = doubles_near(rng, degree)
        a = rng.choice([0.0, 1.0, -1.0, rng.uniform(-3, 3), rng.uniform(-1, 1) * 2.0**20])
        h = rng.choice([1.0, 2.0**-20, rng.uniform(0, 4), 2.0**20 * rng.random() + 1e-9])
        end = Fraction(a + h)

        computed = windows._bernstein(c, a, h)
        bound = Fraction(windows._bernstein_error(c, e, a, h))

        for k, exact in enumerate(blossoms(true, Fraction(a), end)):
            assert abs(Fraction(computed[k]) - exact) <= bound


def blossoms(f, a, b):
    """The Bernstein coefficients of f on [a, b], by their definition as polar forms."""
    n = len(f) - 1
    for k in range(n + 1):
        # Symmetric functions of n - k arguments a and k arguments b.
        symmetric = [Fraction(1)] + [Fraction(0)] * n
        for x in [a] * (n - k) + [b] * k:
            for i in range(n, 0, -1):
                symmetric[i] += x * symmetric[i - 1]
        yield sum(
            Fraction(int(q.numerator), int(q.denominator)) * symmetric[i] / math.comb(n, i)
            for i, q in enumerate(f)
        )


@pytest.mark.parametrize("seed", range(6))
def test_the_certain_sign_is_the_sign(seed):
    """At zeros, next to them, anywhere."""
    rng = random.Random(seed)
    for _ in range(300):
        case = hostile(rng, rng.randint(1, 8))
        x = rng.choice([case.now_low, case.now_high, case.horizon, rng.uniform(-3, 3)])

        said = windows._sign(list(case.c), list(case.e), x)

        exact = QQ(0)
        for q in reversed(case.true):
            exact = exact * rational(x) + q
        assert said in (0, (exact > 0) - (exact < 0))


@pytest.mark.parametrize("n", range(1, 7))
def test_one_change_is_one_change_whatever_the_unknown_signs(n):
    for signs in itertools.product([1.0, 0.0, -1.0], repeat=n):
        if signs[0] == 0.0:
            continue  # the callers know the first
        choices = [[1, -1] if s == 0.0 else [s] for s in signs]
        changes = {
            sum(x != y for x, y in itertools.pairwise(pattern))
            for pattern in itertools.product(*choices)
        }

        assert windows._one_change(list(signs), 0.5) <= (changes == {1})
        assert windows._one_change(list(signs), 0.5) or signs.count(0.0) > 1 or changes != {1}


@pytest.mark.parametrize("n", range(1, 7))
def test_one_sign_is_one_certain_sign(n):
    for signs in itertools.product([1.0, 0.0, -1.0], repeat=n):
        expected = int(signs[0]) if len(set(signs)) == 1 else 0

        assert windows._one_sign(list(signs), 0.5) == expected


@given(
    f=st.lists(small, min_size=4, max_size=7).filter(lambda f: f[-1] != 0),
    low=small,
    width=st.integers(1, 4),
)
def test_tightening_keeps_the_root(f, low, width):
    c, high = [float(x) for x in f], low + width
    first, last = value(f, low), value(f, high)
    s = (first > 0) - (first < 0)
    inside = [value(f, low + Fraction(width * k, 64)) * s > 0 for k in range(65)]
    if s == 0 or last * s >= 0 or sum(x != y for x, y in itertools.pairwise(inside)) != 1:
        return

    l, r = windows._tighten(c, [0.0] * len(c), float(low), float(high), s)

    assert low <= l < r <= high
    assert value(f, Fraction(l)) * s > 0
    assert value(f, Fraction(r)) * s < 0


# What is known without luck


@every(
    "c, now, expected",
    [
        ([-1.0, 1.0], 0.0, (-1, 1.0)),
        ([-1.0, 1.0], 2.0, (1, None)),
        ([1.0, 0.0], 0.0, (1, None)),
        ([-1.0, 1e-9], 0.0, (-1, None)),
        ([-4.0, 0.0, 1.0], 0.0, (-1, 2.0)),
        ([-4.0, 0.0, 1.0], -3.0, (1, -2.0)),
        ([-4.0, 0.0, 1.0], 3.0, (1, None)),
        ([4.0, 0.0, 1.0], 0.0, (1, None)),
        ([-4.0, 0.0, -1.0], 0.0, (-1, None)),
        ([2.0, -3.0, 1.0], 0.0, (1, 1.0)),
        ([2.0, -3.0, 1.0], 1.5, (-1, 2.0)),
        ([-6.0, 11.0, -6.0, 1.0], 0.0, (-1, 1.0)),
        ([-6.0, 11.0, -6.0, 1.0], 1.5, (1, 2.0)),
        ([-6.0, 11.0, -6.0, 1.0], 2.5, (-1, 3.0)),
        ([-6.0, 11.0, -6.0, 1.0], 4.0, (1, None)),
        ([1.0, 0.0, 0.0, 0.0, 1.0], 0.0, (1, None)),
    ],
)
def test_plain_questions_are_decided(c, now, expected):
    sign, root = expected

    s, low, high = answer(plain(c, now))

    assert s == sign
    if root is None:
        assert (low, high) == NOTHING
    else:
        assert low <= root <= high
        assert high - low < 1e-12


@pytest.mark.parametrize(
    "c, now, expected",
    [
        ([-1.0, 1.0], 1.0, (1, None)),
        ([2.0, -3.0, 1.0], 1.0, (-1, 2.0)),
        ([2.0, -3.0, 1.0], 2.0, (1, None)),
        ([-6.0, 11.0, -6.0, 1.0], 1.0, (1, 2.0)),
        ([-6.0, 11.0, -6.0, 1.0], 2.0, (-1, 3.0)),
        ([-6.0, 11.0, -6.0, 1.0], 3.0, (1, None)),
    ],
)
def test_who_says_that_it_vanishes_now_is_told_what_follows(c, now, expected):
    sign, root = expected

    s, low, high = answer(plain(c, now, at_root=True))

    assert s == sign
    assert (low, high) == NOTHING if root is None else low <= root <= high


@every(
    "c, now",
    [
        ([-1.0, 1.0], 1.0),
        ([2.0, -3.0, 1.0], 1.0),
        ([1.0, -2.0, 1.0], 0.0),  # a double root is never decided
        ([1.0, -2.0, 1.0], 1.0),
        ([0.0, 0.0], 0.0),
        ([0.0, 0.0, 0.0], 0.0),
        ([0.0, 0.0, 0.0, 0.0], 0.0),
        ([-1.0, 3.0, -3.0, 1.0], 0.0),
    ],
)
def test_unsure_where_it_must_be(c, now):
    assert answer(plain(c, now)) == filters.UNSURE


@every("bad", [math.nan, math.inf, -math.inf])
@every("size", [2, 3, 4, 6, 8])
def test_nan_and_infinity_in_a_coefficient_end_as_unsure(bad, size):
    for i in range(size):
        c = SOME[:size]
        c[i] = bad

        assert answer(plain(c, 0.0)) == filters.UNSURE


@every("bad", [math.nan, math.inf])
@every("size", [2, 3, 4, 6, 8])
def test_nan_and_infinity_in_a_bound_end_as_unsure(bad, size):
    for i in range(size):
        e = [0.0] * size
        e[i] = bad

        said = answer(plain(SOME[:size], 0.0, e=e))

        assert said == filters.UNSURE


@pytest.mark.parametrize("size", [2, 3, 4, 6, 8])
def test_an_unbounded_error_decides_nothing(size):
    c = SOME[:size]

    assert answer(plain(c, 0.0, e=[10.0] * size)) == filters.UNSURE


def plain(c, now, *, e=None, at_root=False):
    exact = tuple(rational(x) if math.isfinite(x) else QQ(0) for x in c)
    bounds = tuple(e or [0.0] * len(c))
    return Case(exact, tuple(c), bounds, as_rational(Fraction(now)), now, now, 10.0, at_root)


# Bugs found by the attack


@pytest.mark.parametrize("more", [0, 4])
def test_bug_the_scale_of_a_window_underflows(more):
    """2^-460 t - 2^460 t^3 has the root 2^-460, but h^3 = 0 in doubles: "no root" was said."""
    c = (0.0, 2.0**-460, 0.0, -(2.0**460), *[0.0] * more)
    exact, now = tuple(map(rational, c)), 2.0**-471
    case = Case(exact, c, (0.0,) * len(c), rational(now), now, now, 2.0**-452, at_root=False)

    assert judge(case, answer(case)) == ""


def test_bug_the_scale_of_a_window_overflows():
    """2^66 t^7 + 2^-66 t^8 from -2^131: h^8 = inf passed for certainly positive."""
    c = (*[0.0] * 7, 2.0**66, 2.0**-66)
    exact, now = tuple(map(rational, c)), -(2.0**131)
    case = Case(exact, c, (0.0,) * 9, rational(now), now, now, -1.0, at_root=False)

    assert judge(case, answer(case)) == ""


@pytest.mark.parametrize("more", [0, 4])
def test_bug_now_is_zero_within_subnormals(more):
    """2^140 t^2 + t^3 vanishes now, at a hidden zero, which is enclosed by [-5e-324, 0].

    The slope at the end of the window was lost to underflow, and "falling" was said.
    """
    c = (0.0, 0.0, 2.0**140, 1.0, *[0.0] * more)
    exact = tuple(map(rational, c))
    case = Case(exact, c, (0.0,) * len(c), QQ(0), -5e-324, 0.0, 0.0, at_root=True)

    assert judge(case, answer(case)) == ""


@pytest.mark.long
def test_the_attack_hits():
    """The cases reach every degree, sure and unsure, away from a root and on one."""
    rng, seen = random.Random(0), Counter()
    for _ in range(1_500):
        case = hostile(rng, rng.choice(DEGREES))
        seen[len(case.c), answer(case)[0] != 0, case.at_root] += 1

    # (A linear polynomial on its root is unsure only if the sign of its slope is.)
    for key in itertools.product([2, 3, 4, 5, 6, 7, 8, 9], [True, False], [True, False]):
        assert seen[key] >= 3 or key == (2, False, True)


@pytest.mark.parametrize("error", [0.0, 1e-18, 1e-17, 1e-16])
def test_bug_an_enclosure_has_one_root_alone(error):
    """Two roots that the rounding blurs: the first one's enclosure ends before the second."""
    decided = 0
    for k in range(1, 400):
        at = k * 1e-17
        s, low, high = filters.quadratic(
            at, 0.0, -1.0, error, error, error, -1.0, -1.0, 2.0, at_root=False
        )
        decided += s != 0
        assert s == 0 or not low <= math.sqrt(at) <= high
    assert decided > 10
