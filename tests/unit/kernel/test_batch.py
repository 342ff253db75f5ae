"""The batch filters against the scalar ones: the same answers, bit for bit."""

import math
import random

import numpy as np
import pytest

from exactpt.kernel import vectorized
from fuzz.filter_attacks import answer, answers, extreme, generic, hostile


@pytest.mark.long("hostile-2")
@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("make", [hostile, extreme])
def test_answers_are_those_of_the_scalar_filter(make, degree):
    rng = random.Random(degree)
    cases = [make(rng, degree) for _ in range(2_000)]

    said = answers(cases)

    assert said == [answer(case) for case in cases]
    assert {s for s, _, _ in said} == {-1, 0, 1}
    assert any(math.isfinite(low) and s for s, low, _ in said)


def test_generic_certificates_are_decided():
    rng = random.Random(0)
    said = answers([generic(rng, 1) for _ in range(500)])

    assert sum(s != 0 for s, _, _ in said) > 495


def test_one_now_for_all():
    c0, c1, c2 = np.array([[-4.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).T
    none = np.zeros(3)

    said = vectorized.quadratics(c0, c1, c2, none, none, none, 0.5, 0.5, 10.0, none > 0.0)

    assert said.signs.tolist() == [-1, 1, 1]
    assert said.lows[0] <= 2.0 <= said.highs[0] < 2.0 + 1e-12
    assert said.lows[1:].tolist() == [math.inf, math.inf]


def test_none_at_all():
    none = np.zeros(0)

    assert [
        len(column)
        for column in vectorized.linears(none, none, none, none, 0.0, 0.0, 1.0, none > 0.0)
    ] == [0] * 3


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_nan_and_infinity_end_as_unsure(bad):
    for i in range(3):
        c = [np.array([x]) for x in (1.0, -3.0, 1.5)]
        c[i] = np.array([bad])
        none = np.zeros(1)

        assert vectorized.quadratics(*c, none, none, none, 0.0, 0.0, 10.0, none > 0.0).signs[0] == 0
