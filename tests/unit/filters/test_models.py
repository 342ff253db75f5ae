"""Models: quadratics in a window with a bound on everything else."""

import math
from unittest.mock import patch

import pytest
from librt.vecs import vec

from exactpt.filters import models
from exactpt.filters.rounding import U
from fuzz.adversaries.models import PARTS
from fuzz.power.edits import Edit

NAN, INFINITY = math.nan, math.inf
ONE = (1.0, 0.0, 0.0, 0.0)
is_plain = models.__file__.endswith(".py")


@pytest.mark.parametrize("name", PARTS)
def test_models_made_by_an_adversary_are_within_their_remainders(name):
    report = PARTS[name](3000, 59)

    assert report.wrong == []
    assert report.close > 100


def test_model_of_a_square_in_a_window_is_exact():
    # t = 3 + s / 2, so t^2 = 9 + 3 s + s^2 / 4
    c0, c1, c2, rest = models.of_polynomial(vec[float]([0.0, 0.0, 1.0, 0.0]), 0, 3.0, 0.5)

    assert (c0, c1, c2) == (9.0, 3.0, 0.25)
    assert 0.0 < rest < 1e-13


def test_model_of_a_cube_leaves_the_cubic_term_to_the_remainder():
    # t = s / 8, so t^3 = s^3 / 512
    *quadratic, rest = models.of_polynomial(vec[float]([0.0, 0.0, 0.0, 1.0]), 0, 0.0, 0.125)

    assert quadratic == [0.0, 0.0, 0.0]
    assert 1 / 512 <= rest < 1.001 / 512


@pytest.mark.parametrize("c", [NAN, INFINITY, -INFINITY])
@pytest.mark.parametrize("k", range(4))
def test_coefficient_that_is_no_number_has_no_finite_remainder(c, k):
    coefficients = [1.0] * 4
    coefficients[k] = c

    assert not models.of_polynomial(vec[float](coefficients), 0, 0.5, 0.25)[3] < INFINITY


@pytest.mark.parametrize("middle", [NAN, INFINITY, 2.0**101])
def test_window_that_is_too_far_has_no_model(middle):
    assert not models.of_polynomial(vec[float]([1.0] * 4), 0, middle, 1.0)[3] < INFINITY


@pytest.mark.parametrize("c", [NAN, INFINITY, -INFINITY])
@pytest.mark.parametrize("k", range(6))
def test_coefficient_of_a_long_polynomial_that_is_no_number_has_no_finite_remainder(c, k):
    coefficients = [1.0] * 6
    coefficients[k] = c

    assert not models.of_long_polynomial(vec[float](coefficients), 0, 6, 0.5, 0.25)[3] < INFINITY


@pytest.mark.parametrize("middle", [NAN, INFINITY, 2.0**101, 2.0**80])
def test_window_that_is_too_far_has_no_model_of_a_long_polynomial(middle):
    assert not models.of_long_polynomial(vec[float]([1.0] * 6), 0, 6, middle, 1.0)[3] < INFINITY


def test_long_polynomial_of_degree_3_is_that_of_the_short_one():
    c = vec[float]([3.0, -1.0, 0.5, 2.0])

    long = models.of_long_polynomial(c, 0, 4, 0.75, 0.25)

    assert long[:3] == models.of_polynomial(c, 0, 0.75, 0.25)[:3]
    assert models.of_long_polynomial(c, 1, 1, 0.75, 0.25)[:3] == (-1.0, 0.0, 0.0)


def test_constant_turn_of_90_degrees_makes_a_cosine_of_a_sine():
    cosine, sine = models.turned((0.5, 0.25, 0.0, 0.0), (0.75, 0.125, 0.0, 0.0), 0.0, 1.0)

    assert cosine[:3] == (-0.75, -0.125, 0.0)
    assert sine[:3] == (0.5, 0.25, 0.0)


@pytest.mark.parametrize("w", [(0.0, 1.0, 0.0, 0.0), (1.0, 0.5, 0.1, 0.0), (NAN, 0.0, 0.0, 0.0)])
def test_inverse_of_what_may_vanish_has_no_finite_remainder(w):
    assert not models.inverse(w)[3] < INFINITY


def test_turn_of_a_half_angle_of_45_degrees_is_a_right_angle():
    cosine, sine = models.turn((1.0, 0.0, 0.0, 0.0))

    assert cosine[:3] == (0.0, 0.0, 0.0)
    assert sine[:3] == (1.0, 0.0, 0.0)
    assert max(cosine[3], sine[3]) < 1e-14


def test_turn_that_is_too_long_for_a_series_is_somewhere_on_the_circle():
    unknown = (0.0, 0.0, 0.0, 1.0)

    assert models.turn((0.0, 100.0, 0.0, 0.0)) == (unknown, unknown)


def test_turn_by_no_number_has_no_finite_remainder():
    cosine, sine = models.turn((NAN, 0.0, 0.0, 0.0))

    assert not cosine[3] < INFINITY
    assert not sine[3] < INFINITY


MISTAKES = {
    "polynomial: the cubic term": Edit(models, "of_polynomial", "cubic + ", ""),
    "polynomial: its slope": Edit(models, "of_polynomial", "2.0 * c2 + 3.0", "2.0 * c2 + 2.0"),
    "long polynomial: the cubic term": Edit(models, "of_long_polynomial", "cubic + ", ""),
    "long polynomial: the rounding": Edit(models, "of_long_polynomial", " + rounding", ""),
    "long polynomial: its constant": Edit(
        models, "of_long_polynomial", "4.0 * float(terms + 4)", "0.1 * float(terms + 4)"
    ),
    "long polynomial: its third derivative": Edit(
        models, "of_long_polynomial", "third * reach + second", "third * reach"
    ),
    "long polynomial: its bend": Edit(models, "of_long_polynomial", "half * half * bend", "bend"),
    "constant turn: a sign": Edit(models, "turned", "minus(scaled", "plus(scaled"),
    "constant turn: the error of a number": Edit(
        models, "scaled", "f_rest + ROUNDING * size_of(f)", "f_rest"
    ),
    "constant turn: a remainder": Edit(models, "scaled", "(f_rest + ", "("),
    "shift: its rounding": Edit(
        models, "moved", "f_rest + ROUNDING * (abs(f0) + abs(by))", "f_rest"
    ),
    "shift: a number": Edit(models, "moved", "f0 + by", "f0 - by"),
    "sum: a remainder": Edit(models, "plus", "f_rest + g_rest", "f_rest"),
    "difference: a sign": Edit(models, "minus", "-g1", "g1"),
    "product: terms of the third order": Edit(models, "times", "high + ", ""),
    "product: a remainder": Edit(models, "times", " + g_rest * f_size", ""),
    "product: both remainders": Edit(models, "times", "(g_size + g_rest)", "g_size"),
    "inverse: terms of the third order": Edit(models, "inverse", "abs(2.0 * e1 * e2) + ", ""),
    "inverse: the end of the series": Edit(models, "inverse", "square + cubic", "square"),
    "inverse: the remainder of its square": Edit(
        models, "inverse", " + e_rest * (2.0 * q + e_rest)", ""
    ),
    "inverse: its square": Edit(models, "inverse", "e1 * e1 - e2", "-e2"),
    "turn: the remainder of the cosine": Edit(models, "turn", "2.0 * i_rest)", "i_rest)"),
    "turn: one that is too long": Edit(models, "turn", "0.0, 1.0)", "0.0, 0.9)"),
}


@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_models_is_found(mistake):
    with mistake.made():
        assert is_found()


@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
def test_rounding_of_2_units_in_models_is_found():
    with patch.object(models, "ROUNDING", 2.0 * U):
        assert PARTS["polynomials"](10_000, 59).wrong


def is_found():
    """Return whether an adversary finds a wrong model: first by few rows."""
    return any(part(rows, 59).wrong for rows in (300, 3000, 30_000) for part in PARTS.values())
