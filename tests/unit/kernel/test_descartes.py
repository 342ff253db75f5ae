"""Descartes' rule in an interval, against the real roots that SymPy finds."""

from fractions import Fraction

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from oracles import compare_with_rational, real_roots
from strategies import as_int_poly, as_rational, fractions, int_polys, planted_polys, times

from exactpt.kernel.descartes import HALVINGS, single_roots


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
