"""Roots: the witness against SymPy and against planted answers, and exactpt against the witness."""

import random
from fractions import Fraction
from itertools import product

import pytest
import sympy

from exactpt import AlgebraicNumber, InputError
from exactpt.cgal import IsolatedRoot, Signs
from exactpt.geometry.predicates import orientation
from exactpt.kernel.integer_polynomial import multiply, trimmed
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after

pytestmark = pytest.mark.cgal

t = sympy.Symbol("t")
NEAR = Fraction(1, 2**200)
near = sympy.Rational(1, 2**200)


def coefficients(expression):
    """Integers, constant term first, of a positive multiple."""
    _, f = sympy.Poly(expression, t, domain="QQ").clear_denoms(convert=True)
    return [int(c) for c in reversed(f.all_coeffs())]


def product_of(*factors):
    return coefficients(sympy.prod(factors))


# Polynomials with double roots, roots shared with others, rational and irrational roots,
# roots 2^-200 apart, and no real root at all.
SQUARE_ROOT = product_of(t**2 - 2)
TWO_NEAR = product_of(t - 1, t - 1 - near)
NEAR_DOUBLE = product_of((t - 1 - near) ** 2, t + 1)
NO_ROOT = product_of(t**2 + t + 1)
POLYNOMIALS = [
    SQUARE_ROOT,
    TWO_NEAR,
    NEAR_DOUBLE,
    NO_ROOT,
    product_of(t),
    product_of(3 * t - 1),
    product_of((t - 1) ** 2),
    product_of((t - 1) ** 3, t + 2),
    product_of((t**2 - 2) ** 2, t - 1),
    product_of(-1 * (t**2 - 2) ** 2),
    product_of(t**2 - 2, t**3 - 3, 5 * t - 7),
    product_of(t**4 - 10 * t**2 + 1),
    product_of(t**5 - t - 1),
    product_of(t**5 - t - 1, t - 1, t**2 + 1),
    product_of(t**2 - 2 - near),
    product_of(t**3 - 2, t**3 - 2 - near),
]


def claims(f):
    """The distinct real roots that SymPy finds, each with an interval: (root, claim)."""
    p = sympy.Poly(list(reversed(f)), t)
    if p.degree() == 0:
        return []
    part = p.sqf_part()
    roots = sorted(set(p.real_roots()), key=lambda r: sympy.Poly(p).real_roots().index(r))
    intervals = [interval for interval, _ in part.intervals(eps=near / 2**10)]
    assert len(roots) == len(intervals)
    return [
        (root, IsolatedRoot(f, QQ(int(lo.p), int(lo.q)), QQ(int(hi.p), int(hi.q))))
        for root, (lo, hi) in zip(roots, intervals, strict=True)
    ]


ROOTS = [(root, claim) for f in POLYNOMIALS for root, claim in claims(f)]


def sympy_sign(number):
    """Exact: a zero is proved, and everything else is far enough from it for 400 digits."""
    number = sympy.sympify(number)
    if number.is_Rational:
        return int(sympy.sign(number))
    if abs(number.evalf(450)) > sympy.Float(10) ** -400:
        return int(sympy.sign(number.evalf(450)))
    assert sympy.minimal_polynomial(number, t) == t
    return 0


@pytest.mark.parametrize("f", POLYNOMIALS, ids=str)
def test_number_rank_and_multiplicity_of_roots(witness, f):
    found = claims(f)
    p = sympy.Poly(list(reversed(f)), t)
    multiplicities = [p.real_roots().count(root) for root, _ in found]

    verdicts = [witness.check_root(*claim) for _, claim in found]

    assert [v.stats for v in verdicts] == [
        {"roots": len(found), "rank": i + 1, "multiplicity": m}
        for i, m in enumerate(multiplicities)
    ]


@pytest.mark.parametrize(
    "f, low, high, inside, roots",
    [
        (TWO_NEAR, 0, 2, 2, 2),
        (TWO_NEAR, 1, 1 + NEAR, 2, 2),
        (TWO_NEAR, 1 + NEAR / 3, 1 + NEAR / 2, 0, 2),
        (NEAR_DOUBLE, 1 + NEAR * 2, 2, 0, 2),
        (NO_ROOT, -9, 9, 0, 0),
        (SQUARE_ROOT, "7/5", "141/100", 0, 2),
        ([5], 0, 1, 0, 0),
    ],
)
def test_an_interval_with_no_root_or_two_is_refused(witness, f, low, high, inside, roots):
    verdict = witness.check_root(f, low, high)

    assert not verdict.ok
    assert verdict.reason == f"{inside} of the {roots} distinct real roots are in the interval"


@pytest.mark.parametrize("low, high", [(1, 1 + NEAR / 2), (1, 1), (1 - NEAR / 2, 1)])
def test_the_interval_is_closed(witness, low, high):
    """1 is a root and an end; the other root is 2^-200 away."""
    assert witness.check_root(TWO_NEAR, low, high).stats["rank"] == 1


def test_order_of_roots(witness):
    """All pairs: equal roots of different polynomials, and roots 2^-200 apart."""
    seen = set()
    for (a, claim_a), (b, claim_b) in product(ROOTS, ROOTS):
        expected = 0 if a == b else sympy_sign(a - b)
        seen.add((expected, claim_a.polynomial == claim_b.polynomial))
        assert witness.compare_roots(claim_a, claim_b) == expected

    assert seen == {(s, same) for s in (-1, 0, 1) for same in (False, True)}


def test_signs_at_before_and_after_a_root(witness):
    """SymPy: the value; before and after from the multiplicity of the root of g."""
    seen = set()
    for root, claim in ROOTS[::3]:
        for g in POLYNOMIALS[::-1]:
            p = sympy.Poly(list(reversed(g)), t)
            at, order = sympy_sign(p.eval(root)), 0
            while (after := sympy_sign(p.eval(root))) == 0:
                p, order = p.diff(), order + 1
            expected = Signs(after * (-1) ** order, at, after)
            seen.add(expected)
            assert witness.sign_at_root(g, claim) == expected

    assert len(seen) == 6  # each sign at a root or not; a double root from above or below


def test_signs_of_constants_and_of_zero(witness):
    root = IsolatedRoot([-2, 0, 1], QQ(1), QQ(2))

    assert witness.sign_at_root([], root) == (0, 0, 0)
    assert witness.sign_at_root([-7], root) == (-1, -1, -1)


def test_a_root_that_is_not_isolated_is_the_callers_fault(witness):
    good, bad = IsolatedRoot([-2, 0, 1], QQ(1), QQ(2)), IsolatedRoot([-2, 0, 1], QQ(-2), QQ(2))

    with pytest.raises(InputError, match="the second: 2 of the 2 distinct real roots"):
        witness.compare_roots(good, bad)
    with pytest.raises(InputError, match="2 of the 2 distinct real roots"):
        witness.sign_at_root([1], bad)
    assert witness.compare_roots(good, good) == 0


def random_polynomial(rng):
    """A product of small factors, so that roots are often multiple or shared."""
    f = (ZZ(rng.choice([-3, -1, 1, 2])),)
    for _ in range(rng.randint(1, 4)):
        factor = trimmed(ZZ(rng.randint(-4, 4)) for _ in range(rng.randint(2, 4)))
        f = multiply(f, factor) or f
    return f


def test_exactpt_and_the_witness_agree_on_roots(witness):
    """Isolation, order, equality, and whether the sign changes: random and degenerate."""
    rng, everything = random.Random(11), []
    start = AlgebraicNumber(-1000)
    for _ in range(60):
        f = random_polynomial(rng)
        for rank, root in enumerate(roots_after(f, start, QQ(1000)), 1):
            signs = witness.sign_at_root(f, root.time)
            assert signs.at == 0
            assert root.crossing == (signs.before != signs.after)
            assert root.time.sign_after(f) == signs.after
            verdict = witness.check_root(root.time.polynomial, root.time.low, root.time.high)
            assert verdict.stats["multiplicity"] == 1
            original = witness.check_root(f, root.time.low, root.time.high)
            assert not original.ok or original.stats["rank"] == rank
            everything.append(root.time)
    equal = 0
    for a, b in zip(everything, rng.sample(everything, len(everything)), strict=True):
        assert witness.compare_roots(a, b) == a.compare(b)
        equal += a.compare(b) == 0

    assert len(everything) > 80
    assert equal > 0


def test_exactpt_and_the_witness_agree_on_signs(witness):
    rng, zeros = random.Random(12), 0
    for _ in range(150):
        f, g = random_polynomial(rng), random_polynomial(rng)
        for root in roots_after(f, AlgebraicNumber(-1000), QQ(1000)):
            signs = witness.sign_at_root(g, root.time)
            assert (root.time.sign_of(g), root.time.sign_after(g)) == (signs.at, signs.after)
            zeros += signs.at == 0

    assert zeros > 10


def test_orientations_of_points_that_are_nearly_collinear(witness):
    """Planted: c is on the line of a and b, or 10^-50 off to either side; and exactpt's answer."""
    rng, triples, expected = random.Random(13), [], []
    for _ in range(200):
        a, b = [(QQ(rng.randint(-9, 9), rng.randint(1, 9)), QQ(rng.randint(-9, 9))) for _ in "ab"]
        if a == b:
            continue
        s, off = QQ(rng.randint(-9, 9), rng.randint(1, 9)), rng.choice([-1, 0, 1])
        dx, dy = b[0] - a[0], b[1] - a[1]
        aside = QQ(ZZ(off), ZZ(10) ** 50)
        c = (a[0] + s * dx - aside * dy, a[1] + s * dy + aside * dx)
        triples.append((a, b, c))
        expected.append(off)

    assert witness.orientations(triples) == expected
    assert [orientation(*triple) for triple in triples] == expected


def test_hull_of_points_with_a_planted_hull(witness):
    """A square, points on its sides, points inside, and repeated points."""
    square = [(0, 0), (6, 0), (6, 6), (0, 6)]
    inner = [("1/3", 2), (3, 3)]
    sides = [(3, 0), (6, "1/7"), (0, 5)]
    points = [*inner, *sides, *square, *square]

    assert witness.hull(points) == [5, 6, 7, 8]
    assert witness.hull(sides[:1] * 3) == [0]
    assert witness.hull([(1, 1), (2, 2), (0, 0)]) == [2, 1]
    assert witness.hull([]) == []
    # Many copies, so that no sort keeps their order by accident.
    assert witness.hull([(1, 1)] * 40 + [(i % 2, 0) for i in range(60)]) == [40, 41, 0]
