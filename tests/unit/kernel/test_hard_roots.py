"""Roots that are hard to tell apart, against SymPy: not one may differ.

Multiple and nearly equal roots (2^-200 apart), Wilkinson's polynomial and its famous
perturbation, Mignotte's, Chebyshev's, coefficients of 2,048 bits.

Sources: J. H. Wilkinson, *Rounding Errors in Algebraic Processes* (1963), section 2.9;
M. Mignotte, *Mathematics for Computer Algebra* (1992), section 4.6.
"""

import math
import random
from fractions import Fraction
from itertools import pairwise

import flint
import pytest
from strategies import as_int_poly, as_rational, times

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.roots import roots_after
from exactpt.kernel.sturm import cauchy_bound, count_roots, sturm_sequence
from fuzz.references.real_roots import (
    compare,
    is_root,
    nearest_double,
    real_roots,
    separate,
    sign_at_root,
)

GAP = 2**200


def wilkinson(n, *, perturbed=False):
    f = list(times(*[(-k, 1) for k in range(1, n + 1)]))
    if perturbed:  # Wilkinson: -2^-23 on t^19 moves ten roots off the real line
        f = [c << 23 for c in f]
        f[n - 1] -= 1
    return tuple(f)


def mignotte(n, a):
    """t^n - 2 (a t - 1)^2: two roots near 1/a that are about a^-(n+2)/2 apart."""
    f = [-2, 4 * a, -2 * a * a] + [0] * (n - 2)
    f[n] += 1
    return tuple(f)


def chebyshev(n, kind):
    f = flint.fmpz_poly.chebyshev_t(n) if kind == "T" else flint.fmpz_poly.chebyshev_u(n)
    return tuple(int(c) for c in f.coeffs())


def random_poly(rng, degree, bits):
    f = [rng.randrange(-(2**bits) + 1, 2**bits) for _ in range(degree)]
    return (*f, rng.randrange(2 ** (bits - 1), 2**bits))


def planted(rng):
    """Rational roots of multiplicity up to 4, some 2^-200 from another, and surds."""
    factors = []
    for _ in range(rng.randint(1, 3)):
        p, q = rng.randint(-9, 9), rng.randint(1, 9)
        factors += [(-p, q)] * rng.randint(1, 4)
        if rng.random() < 0.6:
            factors += [(-p * GAP - rng.choice([-1, 1]), q * GAP)] * rng.randint(1, 2)
    if rng.random() < 0.5:
        c = rng.randint(2, 9)
        factors += [(-c, 0, 1)] * rng.randint(1, 2)
        if rng.random() < 0.5:
            factors.append((-c * GAP - 1, 0, GAP))
    return times((rng.choice([-1, 1]),), *factors)


FAMILIES = {
    "wilkinson 20": [wilkinson(20)],
    "wilkinson 20 perturbed": [wilkinson(20, perturbed=True)],
    "mignotte": [mignotte(n, a) for n in (3, 4, 5, 8, 13) for a in (2, 3, 10, 2**20 + 1)],
    "mignotte 2^-200": [mignotte(8, 2**40), mignotte(6, 2**50)],
    "chebyshev": [chebyshev(n, kind) for n in (2, 3, 5, 8, 12, 17, 24) for kind in "TU"],
    "planted": [planted(random.Random(seed)) for seed in range(40)],
    "2^-200 apart": [
        times((-1, 3), (-GAP - 3, 3 * GAP)),
        times((-1, 3), (-GAP - 3, 3 * GAP), (-GAP + 3, 3 * GAP), (-2, 0, 1)),
        times((-1, 3), (-1, 3), (-GAP - 3, 3 * GAP)),
        times((-2, 0, 1), (-2 * GAP - 1, 0, GAP)),
        times((-2, 0, 0, 1), (-2 * GAP - 1, 0, 0, GAP)),
        times((-1, -1, 0, 1), (-GAP - 1, -GAP, 0, GAP), (-GAP + 1, -GAP, 0, GAP)),
    ],
    "2,048 bits": [
        random_poly(random.Random(100 * degree + seed), degree, 2048)
        for degree in (1, 2, 3, 4, 6, 8, 12)
        for seed in range(2)
    ],
    "2,048 bits, planted": [
        times(*[random_poly(random.Random(seed + k), 1, 1024) for k in range(2)] * 2)
        for seed in range(5)
    ],
}  # fmt: skip
QUICK = {"mignotte": 12, "planted": 5, "2,048 bits": 10}
"""How many of a family run in the inner loop; the others are slow."""
CASES = [
    pytest.param(name, i, marks=[pytest.mark.slow] if i >= QUICK.get(name, 99) else [])
    for name, polys in FAMILIES.items()
    for i in range(len(polys))
]


def all_roots(f):
    p = as_int_poly(f)
    bound = cauchy_bound(p)
    return list(roots_after(p, AlgebraicNumber(-bound), bound))


@pytest.mark.long("wilkinson 20 perturbed-0")
@pytest.mark.parametrize("name, i", CASES)
def test_the_roots_are_sympys(name, i):
    """All of them, their crossings, their enclosures, their nearest doubles."""
    f = FAMILIES[name][i]
    expected = real_roots(f)

    found = all_roots(f)

    assert [r.crossing for r in found] == [root.multiplicity % 2 == 1 for root in expected]
    for r, root in zip(found, expected, strict=True):
        assert is_root(r.time.polynomial, r.time.low, r.time.high, root)
        assert float(r.time) == nearest_double(root)
        assert r.time.sign_of(as_int_poly(f)) == 0
        assert r.time.simplified().is_rational == root.is_rational


@pytest.mark.long("wilkinson 20 perturbed-0")
@pytest.mark.parametrize("name, i", CASES)
def test_the_order_of_the_roots_is_sympys(name, i):
    """Each compared with all others, and with those of the derivative; signs there too."""
    f = FAMILIES[name][i]
    g = tuple(k * c for k, c in enumerate(f) if k)
    ours, theirs = all_roots(f), real_roots(f)
    extrema, twins = (all_roots(g), real_roots(g)) if len(g) > 1 else ([], [])

    for (a, _), p in zip(ours, theirs, strict=True):
        for (b, _), q in zip([*ours, *extrema], [*theirs, *twins], strict=True):
            assert a.compare(b) == compare(p, q)
        assert a.sign_of(as_int_poly(g)) == sign_at_root(g, p)
    for (a, _), p in zip(extrema, twins, strict=True):
        assert a.sign_of(as_int_poly(f)) == sign_at_root(f, p)


@pytest.mark.long("wilkinson 20-0", "wilkinson 20 perturbed-0", "chebyshev-12", "chebyshev-13")
@pytest.mark.parametrize("name, i", CASES)
def test_the_first_root_after_a_root_is_the_next(name, i):
    """From each root (exactly), and from doubles on either side of it."""
    f = FAMILIES[name][i]
    p, bound = as_int_poly(f), cauchy_bound(as_int_poly(f))
    ours, theirs = all_roots(f), real_roots(f)

    for (a, _), (b, _) in pairwise(ours):
        first = next(roots_after(p, a, bound))
        assert first.time.compare(b) == 0
    for (a, _), root in zip(ours, theirs, strict=True):
        lo, hi = a.enclosure()
        beside = [
            Fraction(x) for x in (math.nextafter(lo, -math.inf), math.nextafter(hi, math.inf))
        ]
        for q in beside:
            later = [
                r for r in theirs if compare(r, real_roots((-q.numerator, q.denominator))[0]) > 0
            ]
            found = next(roots_after(p, AlgebraicNumber(as_rational(q)), bound), None)
            assert (found is None) == (not later)
            if found:
                assert is_root(found.time.polynomial, found.time.low, found.time.high, later[0])
        assert root.index >= 0


@pytest.mark.parametrize("name, i", CASES)
def test_sturm_counts_between_the_roots(name, i):
    f = FAMILIES[name][i]
    p, theirs = as_int_poly(f), real_roots(f)
    sequence, bound = sturm_sequence(p), cauchy_bound(p)
    ends = [-bound]
    for a, b in pairwise(theirs):
        separate(a, b)
        ends.append(as_rational((a.high + b.low) / 2))
    ends.append(bound)

    for k, lo in enumerate(ends):
        for m in range(k, len(ends)):
            assert count_roots(sequence, lo, ends[m]) == (m - k if theirs else 0)


def test_the_perturbed_wilkinson_polynomial_has_ten_real_roots():
    assert len(all_roots(wilkinson(20))) == 20
    assert len(all_roots(wilkinson(20, perturbed=True))) == 10


def test_nearly_equal_roots_are_told_apart():
    """2^-200 / 3 apart, and the double between them is the same."""
    first, second = all_roots(FAMILIES["2^-200 apart"][0])

    assert first.time < second.time
    assert float(first.time) == float(second.time) == 1 / 3
