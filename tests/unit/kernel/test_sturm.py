"""Sturm's theorem, Descartes' rule and isolation, against SymPy."""

from fractions import Fraction

import pytest
import sympy
from hypothesis import assume, example, given
from hypothesis import strategies as st
from strategies import as_int_poly, as_rational, fractions, int_polys, planted_polys, times

from exactpt.errors import InputError
from exactpt.kernel import sturm
from exactpt.kernel.descartes import HALVINGS, single_roots
from exactpt.kernel.numbers import QQ
from exactpt.kernel.sturm import cauchy_bound, count_roots, isolating_intervals, sturm_sequence
from fuzz.references.real_roots import compare_with_rational, exact, real_roots, value

nonzero = int_polys.filter(bool)


def in_range(roots, lo, hi):
    """Those in (lo, hi]."""
    return [
        r for r in roots if compare_with_rational(r, lo) > 0 and compare_with_rational(r, hi) <= 0
    ]


@st.composite
def polys_with_ends(draw):
    """A polynomial and an interval whose ends are often roots of it."""
    f = draw(nonzero)
    roots = [r.low for r in real_roots(f) if r.is_rational]
    ends = st.one_of(fractions, st.sampled_from(roots)) if roots else fractions
    return f, *sorted([draw(ends), draw(ends)])


@given(case=polys_with_ends())
@example(case=((0, 0, -1, 1), Fraction(0), Fraction(2)))
@example(case=((0, 0, -1, 1), Fraction(-1), Fraction(0)))
@example(case=((1, -3, 3, -1), Fraction(0), Fraction(1)))
@example(case=((1, -3, 3, -1), Fraction(1), Fraction(1)))
def test_sturms_theorem(case):
    """V(lo) - V(hi) is the number of distinct real roots in (lo, hi], ends roots or not."""
    f, lo, hi = case

    count = count_roots(sturm_sequence(as_int_poly(f)), as_rational(lo), as_rational(hi))

    assert count == len(in_range(real_roots(f), lo, hi))


@given(f=nonzero, lo=fractions, hi=fractions)
def test_the_count_is_sympys(f, lo, hi):
    """SymPy counts in closed intervals; with an end that is no root, so do we."""
    lo, hi = sorted([lo, hi])
    p, t = as_int_poly(f), sympy.Symbol("t")
    ends = (
        sympy.Rational(lo.numerator, lo.denominator),
        sympy.Rational(hi.numerator, hi.denominator),
    )
    expected = sympy.Poly(list(reversed(f)), t).count_roots(*ends) - (value(f, lo) == 0)

    assert count_roots(sturm_sequence(p), as_rational(lo), as_rational(hi)) == expected


@given(f=nonzero)
def test_every_complex_root_is_below_cauchys_bound(f):
    bound = cauchy_bound(as_int_poly(f))

    # |c_n| x^n > sum |c_i| x^i for x = bound: then no root is as large (Cauchy).
    smaller = sum(abs(c) * bound**i for i, c in enumerate(f[:-1]))
    assert abs(f[-1]) * bound ** (len(f) - 1) > smaller
    assert bound.denominator == 1
    assert bound.numerator.bit_count() == 1


@given(case=polys_with_ends())
@example(case=(times((0, 1), (-1, 1), (-2, 1)), Fraction(0), Fraction(2)))
@example(case=(times((-1, 1), (-1, 1), (-1, 2)), Fraction(0), Fraction(1)))
def test_isolating_intervals_hold_one_root_each_from_left_to_right(case):
    f, lo, hi = case
    roots = in_range(real_roots(f), lo, hi)

    found = list(
        isolating_intervals(sturm_sequence(as_int_poly(f)), as_rational(lo), as_rational(hi))
    )

    assert len(found) == len(roots)
    for (l, r), root in zip(found, roots, strict=True):
        left, right = exact(l), exact(r)
        if left == right:
            assert compare_with_rational(root, right) == 0
        else:
            (alone,) = in_range(roots, left, right)
            assert alone is root


@given(f=planted_polys())
def test_all_roots_lie_within_cauchys_bound(f):
    p = as_int_poly(f)
    bound = cauchy_bound(p)

    assert count_roots(sturm_sequence(p), -bound, bound) == len(real_roots(f))


def test_roots_are_isolated_lazily(monkeypatch):
    """Who asks for the first of 40 roots does not pay for the others."""
    sequence = sturm_sequence(as_int_poly(times(*[(-k, 1) for k in range(1, 41)])))
    evaluations = []
    plain = sturm._variations
    monkeypatch.setattr(
        sturm, "_variations", lambda sequence, t: evaluations.append(t) or plain(sequence, t)
    )

    next(isolating_intervals(sequence, QQ(0), QQ(64)))
    first = len(evaluations)
    list(isolating_intervals(sequence, QQ(0), QQ(64)))

    assert first < 10
    assert len(evaluations) - first > 40


def test_refusals():
    with pytest.raises(InputError):
        sturm_sequence(())
    with pytest.raises(InputError):
        count_roots(sturm_sequence(as_int_poly([0, 1])), QQ(1), QQ(0))


# Descartes' rule in an interval, against the real roots that SymPy finds


def roots_and_pieces(f, low, high):
    """How many different roots in each piece, whether it says one; and those in none."""
    pieces = list(single_roots(as_int_poly(f), as_rational(low), as_rational(high)))
    inside = [
        r
        for r in real_roots(f)
        if compare_with_rational(r, low) > 0 > compare_with_rational(r, high)
    ]
    held = [
        (
            [
                r.multiplicity
                for r in inside
                if compare_with_rational(r, Fraction(a)) > 0 > compare_with_rational(r, Fraction(b))
            ],
            alone,
        )
        for a, b, alone in pieces
    ]
    ends = [end for a, b, _ in pieces for end in (a, b)]
    return held, len(inside) - sum(len(roots) for roots, _ in held), ends


@given(f=st.one_of(int_polys.filter(bool), planted_polys()), low=fractions, high=fractions)
@example(f=(0, 0, 1), low=Fraction(-1), high=Fraction(1))
@example(f=times((-1, 2), (-1, 3)), low=Fraction(0), high=Fraction(1))
@example(f=times((-1, 2), (-1, 2), (-1, 3)), low=Fraction(0), high=Fraction(1))
def test_pieces_from_left_to_right_hold_all_roots(f, low, high):
    assume(low != high)
    low, high = min(low, high), max(low, high)
    held, missed, ends = roots_and_pieces(f, low, high)

    assert missed == 0
    assert ends == sorted(ends)
    assert all(roots == [1] for roots, alone in held if alone)


def test_roots_are_told_apart_in_any_interval():
    f = times((-1, 2), (-1, 1), (-3, 2), (5, 1))

    for low, high, count in ((-6, 2, 4), (0, 2, 3), (1, 2, 1), (0, 1, 1), (2, 9, 0)):
        held = roots_and_pieces(f, Fraction(low) + Fraction(1, 64), Fraction(high))[0]
        assert held == [([1], True)] * count


@pytest.mark.parametrize("shift", [Fraction(0), Fraction(10**30), Fraction(-7, 10**20)])
def test_a_pair_of_complex_roots_ends_in_no_piece(shift):
    """1 + (t - shift)^2 has none; next to the whole interval the rule allows two."""
    f = tuple(int(c * shift.denominator**2) for c in (1 + shift**2, -2 * shift, 1))

    assert roots_and_pieces(f, shift - 9, shift + 9)[0] == []


def test_close_roots_are_told_apart_as_far_as_promised():
    """Roots at 1/3 and 1/3 + 2^-k, with one at 2/3."""

    def pieces(k):
        near = Fraction(1, 3) + Fraction(1, 2**k)
        f = times((-1, 3), (-near.numerator, near.denominator), (-2, 3))
        return roots_and_pieces(f, Fraction(0), Fraction(1))[0]

    assert pieces(HALVINGS // 2) == [([1], True)] * 3
    assert pieces(2 * HALVINGS) == [([1, 1], False), ([1], True)]
