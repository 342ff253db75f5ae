"""The first zero of a pair of features in a window."""

import math
from unittest.mock import patch

import pytest
from librt.vecs import vec

from exactpt.filters import zeros
from exactpt.filters.rounding import U
from exactpt.filters.zeros import MAYBE, NONE, SURE, Vector, Zero, following
from exactpt.kernel.numbers import QQ
from fuzz.adversaries.zeros import PARTS
from fuzz.power.edits import Edit

NAN, INFINITY = math.nan, math.inf
is_plain = zeros.__file__.endswith(".py")


@pytest.mark.parametrize("name", [name for name in PARTS if name != "misses"])
def test_answers_to_an_adversary_are_right(name):
    report = PARTS[name](2000, 59)

    assert report.wrong == []
    assert report.close > 20
    assert report.counts["sure"] > 50


def test_zero_of_a_polynomial_that_stays_positive_is_never_sure():
    report = PARTS["misses"](3000, 59)

    assert report.wrong == []
    assert report.close > 200
    assert report.counts["maybe"] > 1000


def polynomial(*f, error=0.0):
    """The search for a zero of a polynomial, without a foot."""
    zero = Zero()
    zero.f0, zero.f1, zero.f2, zero.f3, zero.f4 = [*f, *[0.0] * (5 - len(f))]
    zero.error = error
    return zero


def on_edge(vertex, rho=0.0):
    """The orientation of a vertex and the edge from (0, 0) to (4, 0)."""
    zero = Zero()
    q = vec[float]([0.0] * 6 + [4.0] + [0.0] * 5)
    zero.z.set(vec[float](vertex), 0, q, 0, rho)
    zero.u.set(q, 1, q, 0, rho)
    zero.orientation()
    return zero


def test_simple_zero_is_sure_and_narrow():
    zero = polynomial(-0.25, 1.0)

    assert zero.find() == SURE
    assert zero.low <= 0.25 <= zero.high
    assert zero.high - zero.low < 1e-13


def test_first_of_two_zeros_is_found():
    zero = polynomial(-0.25, 0.0, 1.0)  # at -1/2 and 1/2

    assert zero.find() == SURE
    assert zero.low <= -0.5 <= zero.high


def test_double_zero_may_be_one():
    zero = polynomial(0.25, -1.0, 1.0)  # (s - 1/2)^2

    assert zero.find() == MAYBE
    assert zero.low <= 0.5
    assert zero.low > 0.4999


@pytest.mark.parametrize("f", [(2.0, 1.0), (-2.0, 0.5, 0.5, 0.5), (1e-3, 0.0, 1.0), (1.0,)])
def test_polynomial_that_keeps_its_sign_has_no_zero(f):
    assert polynomial(*f).find() == NONE


def test_polynomial_within_its_error_may_vanish():
    assert polynomial(1.0, error=1.5).find() == MAYBE


@pytest.mark.parametrize("f", [(NAN,), (1.0, NAN), (INFINITY,), (1.0, 0.0, INFINITY), (1e308,) * 5])
def test_polynomial_of_no_numbers_may_vanish_from_the_begin_on(f):
    zero = polynomial(*f, error=NAN)

    assert zero.find() == MAYBE
    assert (zero.low, zero.high) == (-1.0, 1.0)


def test_vertex_that_crosses_an_edge_is_sure():
    zero = on_edge([1.0, 0.0, 0.0, 0.5, 1.0, 0.0])  # (1, 1/2 + s)

    assert zero.find() == SURE
    assert zero.low <= -0.5 <= zero.high


def test_vertex_that_passes_beside_an_edge_has_no_zero():
    assert on_edge([5.0, 0.0, 0.0, 0.5, 1.0, 0.0]).find() == NONE


def test_vertex_that_passes_an_end_of_an_edge_may_touch():
    assert on_edge([4.0, 0.0, 0.0, 0.5, 1.0, 0.0]).find() == MAYBE


def test_vertex_that_moves_along_an_edge_may_touch_from_its_end_on():
    zero = on_edge([-0.5, 1.0, 0.0, 0.0, 0.0, 0.0])  # (s - 1/2, 0) enters at s = 1/2

    assert zero.find() == MAYBE
    assert 0.4999 < zero.low <= 0.5


def test_vertex_at_a_distance_of_an_edge_is_sure_on_its_side():
    for side, y, at in ((1.0, 2.0, -0.5), (-1.0, -2.0, 0.5)):
        zero = on_edge([1.0, 0.0, 0.0, y, 1.0, 0.0])  # (1, y + s)
        zero.subtract_length(side * 1.5, is_rigid=True)

        assert zero.find() == SURE
        assert zero.low <= at <= zero.high


def test_two_vertices_at_a_distance_are_sure():
    zero = Zero()
    zero.z.set(vec[float]([5.5, 2.0, 0.0, 4.0, 0.0, 0.0]), 0, vec[float]([0.0] * 6), 0, 0.0)
    zero.squared_distance(5.0)  # (5.5 + 2 s, 4) is at the distance 5 at s = -5/4 and before: none

    assert zero.find() == NONE

    zero.squared_distance(6.0)  # 5.5 + 2 s = sqrt(20) at s = -0.5139...
    assert zero.find() == SURE
    assert zero.low <= (20**0.5 - 5.5) / 2 <= zero.high


def test_vector_is_far_only_beyond_its_way_and_its_error():
    vector = Vector()
    vector.set(vec[float]([4.0, 1.0, 0.0, 0.0, 0.0, 0.0]), 0, vec[float]([0.0] * 6), 0, 0.5)

    assert vector.is_far(2.4)
    assert not vector.is_far(2.5)


@pytest.mark.parametrize("width", [2.0, 1.0, 0.5, 2.0**-10])
def test_parts_that_follow_one_another_fill_the_window(width):
    low = -1.0
    while low < 1.0:
        assert low + width <= 1.0
        low, width = following(low, width)
    assert low == 1.0


def test_part_that_follows_is_the_widest_that_halving_makes():
    # [-1, -7/8], then [-7/8, -3/4], [-3/4, -1/2], [-1/2, 0], [0, 1]
    assert following(-1.0, 0.125) == (-0.875, 0.125)
    assert following(-0.875, 0.125) == (-0.75, 0.25)
    assert following(-0.75, 0.25) == (-0.5, 0.5)
    assert following(-0.5, 0.5) == (0.0, 1.0)


# Not among them: du left out of `orientation`. Errors p of the vertex and q of the ends change
# u x z by u x (p - (1 - c) q_a - c q_b) + (q_b - q_a) x n, where z = c u + n. The foot is on the
# edge, so c is in [0, 1], and the first term is at most |u| (p + q), which |u| dz covers. In the
# second one |n| is 0 where the vertex is on the edge, and next to a zero at most the error by |u|:
# 2 du dz covers that. At the distance R the same error of u is in R |u|.
MISTAKES = {
    "vector: rho": Edit(Vector, "set", "rho + U2", "U2"),
    "vector: a way": Edit(Vector, "set", "abs(x1) + 2.0 * abs(x2)", "abs(x1)"),
    "orientation: a sign": Edit(Zero, "orientation", "ux0 * zy0 - uy0", "ux0 * zy0 + uy0"),
    "orientation: the error of z": Edit(Zero, "orientation", "u.size * z.off + ", ""),
    "distance: the side": Edit(Zero, "subtract_length", "before - distance", "before + distance"),
    "distance: a change": Edit(Zero, "subtract_length", " + change", ""),
    "vertices: the error of z": Edit(Zero, "squared_distance", "2.0 * z.size * z.off + ", ""),
    "find: the first test": Edit(Zero, "find", "(rest + self.error)", "(0.5 * rest + self.error)"),
    "find: rounding": Edit(Zero, "find", "EVALUATION * ", "0.0 * "),
    "look: the spread": Edit(Zero, "_look", "abs(g1) + (abs(g2)", "abs(g1) + (0.0 * abs(g2)"),
    "look: the foot": Edit(Zero, "_look", "== NONE", "!= SURE"),
    "look: the change of the slope": Edit(Zero, "_look", "(error + change * r)", "(error)"),
    "look: a side": Edit(Zero, "_look", "m - f / g1", "m + f / g1"),
    "narrow: the error": Edit(Zero, "_narrow", "(error + change * r)", "(change * r)"),
    "sure: the error": Edit(Zero, "_vanishes", "abs(before) > error and ", ""),
    "sure: the foot": Edit(Zero, "_vanishes", "== SURE", "!= NONE"),
    "taylor: a factor": Edit(Zero, "taylor", "m * 6.0 * f4", "m * 4.0 * f4"),
    "foot: the way of z": Edit(Zero, "foot", "z.way * r + ", ""),
    "foot: the way of u": Edit(Zero, "foot", "u.way * r + ", ""),
    "foot: the error of z": Edit(Zero, "foot", " + z.off", ""),
    "foot: an end": Edit(Zero, "foot", "along > length + end_margin", "along > length"),
    "following: an end": Edit(zeros, "following", "low += width", "low += 1.5 * width"),
}


@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_zeros_is_found(mistake):
    with mistake.made():
        assert is_found()


@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
def test_rounding_of_2_units_in_zeros_is_found():
    with patch.object(zeros, "ROUNDING", 2.0 * U):
        assert PARTS["vertices"](4000, 1).wrong


TOUCHING_1 = [
    float.fromhex(f)
    for f in (
        "0x1.0040449df8af1p+0",
        "-0x1p-53",
        "-0x1.002137df11d78p+1",
        "-0x1p-53",
        "0x1.00022b202b000p+0",
    )
]
"""About (s^2 - 1)^2: not positive at 1, but 4 U when it is evaluated a little before 1."""


def test_polynomial_of_which_all_roundings_add_up_may_vanish():
    at_1 = sum(map(QQ, TOUCHING_1))

    assert QQ(TOUCHING_1[0]) > 0 >= at_1  # so it vanishes between 0 and 1
    assert polynomial(*TOUCHING_1).find() == MAYBE


# 4 U in place of 64 U is no mistake. Let S be the sum of the sizes of f0, ..., f4. By Horner, f(m)
# is b0, with bk = fk + m b(k+1) and b4 = f4. Each of its 7 roundings before the last one changes it
# by at most U |bk m^k| with k > 0. That is at most U S / 2 if b0 = 0, as bk m^k goes from 0 to it
# and back to 0 in steps fk m^k. So f(m) is off by at most 3.5 U S. `SLACK` adds 10^-10 of |f(m)|
# and of the spread, which covers all rounding unless f(m), g1 r, g2 r^2, ... are all less than
# 3 10^-5 S. If they are, the errors of all of them together are at most 3.5 U S, too (the linear
# program over f0, ..., f4 for each sign of the partial results was solved for m and r on a grid),
# and that only where r is small and f has a slope, so that 8 U in the width of a zero cover it. At
# a double zero b1, ..., b4 also add up to 0, and 1.75 U S is the most.
@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
def test_evaluation_error_of_1_unit_in_zeros_is_found():
    with patch.object(zeros, "EVALUATION", U):
        assert polynomial(*TOUCHING_1).find() == NONE


def is_found():
    """Return whether an adversary finds a wrong answer: first by few rows."""
    return any(part(rows, 59).wrong for rows in (200, 2000, 20_000) for part in PARTS.values())
