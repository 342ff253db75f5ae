"""Families of a point and a segment: exact as doubles, and what their names say."""

from collections import Counter
from fractions import Fraction

import numpy as np
import pytest

from exactpt.collision_set.answers import answers, coordinates
from exactpt.collision_set.passages import DEGENERATE, FAMILIES, GENERIC, make_passage, polynomial
from exactpt.errors import InputError


def some(family, count=60):
    return [make_passage(family, number) for number in range(count)]


def test_there_are_twelve_degenerate_families_or_more_and_four_generic_ones():
    assert len(DEGENERATE) >= 12
    assert len(GENERIC) == 4


@pytest.mark.parametrize("family", FAMILIES)
def test_nothing_is_rounded_and_no_segment_is_a_point(family):
    for passage in some(family):
        numbers = coordinates(passage)
        for k, (first, last) in enumerate(
            zip(sum(passage.start, ()), sum(passage.end, ()), strict=True)
        ):
            unit = Fraction(1, 2**passage.bits)
            assert Fraction(numbers[k]) == first * unit
            assert Fraction(numbers[6 + k]) == (last - first) * unit
            assert Fraction(float(last * unit)) == last * unit
        (_, a, b), (_, c, d) = passage.start, passage.end
        t = [
            Fraction(f - g, (f - g) - (h - i))
            for f, g, h, i in zip(a, b, c, d, strict=True)
            if f - g != h - i
        ]
        shrinks = [s for s in t if 0 <= s <= 1 and all(
            (f - g) * (1 - s) + (h - i) * s == 0 for f, g, h, i in zip(a, b, c, d, strict=True)
        )]  # fmt: skip
        assert a != b
        assert not shrinks


def test_single_precision_holds_its_family():
    for passage in some("single_precision"):
        for place in passage.start + passage.end:
            values = [c / 2**passage.bits for c in place]
            assert [float(np.float32(v)) for v in values] == values


def test_tangents_have_double_roots_and_their_neighbours_have_not():
    discriminants = {
        family: [c1 * c1 - 4 * c0 * c2 for c0, c1, c2 in map(polynomial, some(family)) if c2]
        for family in ("tangent", "nearly_tangent")
    }

    assert len(discriminants["tangent"]) > 40
    assert set(discriminants["tangent"]) == {0}
    assert {d > 0 for d in discriminants["nearly_tangent"] if d} == {True, False}
    assert all(t.time is not None for t in answers(some("tangent")))


def test_level_polynomials_have_no_leading_coefficient():
    assert {polynomial(passage)[2] for passage in some("level")} == {0}


def test_times_are_where_the_families_put_them():
    times = {f: [t.time for t in answers(some(f))] for f in ("at_start", "at_end", "onto_end")}

    assert sum(t is not None and t == 0 for t in times["at_start"]) > 30
    assert sum(t is not None and t == 1 for t in times["at_end"]) > 20
    assert None in times["at_end"]
    assert all(8 * t.low == int(8 * t.low) for t in times["onto_end"])


def test_hairs_decide():
    kinds = Counter(truth.kind for truth in answers(some("past_end")))

    assert kinds[None] > 10
    assert kinds["vertex-edge"] > 10


def test_other_names_are_refused():
    with pytest.raises(InputError, match="no family 'circle'; there are: onto_end"):
        make_passage("circle", 0)
