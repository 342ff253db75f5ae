"""What counts as a kept promise, and which questions an engine is asked."""

import pytest
from folding import every

from benchmarks.engines.domain import as_asked, from_zero, kind_of, why_not
from benchmarks.engines.promise import WITHIN, Leeway, fault, leeway
from benchmarks.tests.bench_help import square
from exactpt.testing import FAMILIES, Moving, Question, make_question, truths
from exactpt.testing.truth import Truth, truth_of

NONE = Leeway(0.0, 0.0, 0.0)


def pass_by(height, *, still=None, speed=-1.0, span=8.0):
    """A square that passes another one, a height above its lower edge; at 1 they only touch."""
    moving = square(3.0, height, x=(0.0, speed), y=(0.0, 0.0))
    return Question(still or square(0.0, 0.0), moving, (0.0, span))


CASES = [
    # question, answer, leeway, verdict
    (pass_by(0.0), 2.0, NONE, "right"),
    (pass_by(0.0), 2.0 + 1e-10, NONE, "right"),
    (pass_by(0.0), 1.75, NONE, "early"),
    (pass_by(0.0), 1.75, Leeway(0.25, 0, 0), WITHIN),
    (pass_by(0.0), 1.75, Leeway(0.2499, 9.0, 9.0), "early"),
    (pass_by(0.0), 2.25, NONE, "late"),
    (pass_by(0.0), 2.25, Leeway(0, 0.25, 0), WITHIN),
    (pass_by(0.0), 2.25, Leeway(0, 0.24, 0), "late"),
    (pass_by(0.0), 2.25, Leeway(0.25, 0, 0), WITHIN),
    (pass_by(0.0), 2.25, Leeway(0.24, 0, 0), "late"),
    (pass_by(0.0), None, NONE, "missed"),
    (pass_by(0.0), None, Leeway(0.99, 0, 0), "missed"),
    (pass_by(0.0), None, Leeway(1.0, 0, 0), WITHIN),
    (pass_by(0.0), None, Leeway(0, 9.0, 1.9), "missed"),
    (pass_by(0.0), None, Leeway(0, 0, 2.1), WITHIN),
    # it slides along an edge, and sinks in by nothing, or next to nothing
    (pass_by(1.0), None, NONE, "missed"),
    (pass_by(1.0), None, Leeway(2**-60, 0, 0), WITHIN),
    (pass_by(1.0 - 2**-20), None, Leeway(2**-21, 0, 0), "missed"),
    (pass_by(1.0 - 2**-20), None, Leeway(2**-20, 0, 0), WITHIN),
    # it arrives at the very end
    (pass_by(0.0, span=2.0), None, NONE, "missed"),
    (pass_by(0.0, span=2.0), None, Leeway(2**-60, 0, 0), WITHIN),
    # it passes above
    (pass_by(1.5), None, NONE, "right"),
    (pass_by(1.5), 3.0, NONE, "invented"),
    (pass_by(1.5), 3.0, Leeway(0.5, 0, 0), WITHIN),
    (pass_by(1.5), 3.0, Leeway(0.49, 9.0, 9.0), "invented"),
    (pass_by(1.5), 9.0, Leeway(99.0, 0, 0), "invented"),
    (pass_by(1.5), -1.0, Leeway(99.0, 0, 0), "invented"),
    # a time long after a contact that may be skipped is no contact
    (pass_by(0.0), 7.0, Leeway(0, 0, 2.1), "late"),
    (pass_by(0.0), float("nan"), Leeway(9.0, 9.0, 9.0), "crashed"),
]


@every("question, answer, allowed, verdict", CASES)
def test_a_verdict(question, answer, allowed, verdict):
    assert fault(question, truth_of(question), answer, allowed) == verdict


def test_depths_are_of_convex_bodies_alone():
    notch = Moving(((0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (2.0, 0.5), (0.0, 1.0)))
    question = pass_by(1.0 - 2**-20, still=notch)
    assert fault(question, truth_of(question), None, Leeway(1.0, 0, 0)) == "missed"


def test_segments_on_one_line_do_not_sink_into_each_other():
    still = Moving(((0.0, 0.0), (1.0, 0.0)))
    moving = Moving(((3.0, 0.0), (5.0, 0.0)), (0.0, -1.0), (0.0, 0.0))
    question = Question(still, moving, (0.0, 2.5))
    truth = truth_of(question)
    assert fault(question, truth, None, Leeway(2**-60, 0, 0)) == WITHIN
    assert fault(question, truth, None, NONE) == "missed"


def test_a_leeway_grows_with_the_question():
    allows = {"distance": 1.0, "of_extent": 0.5, "of_coordinates": 0.25, "late": 0.125}
    # x goes from -5 to 4, y from 0 to 1; the largest coordinate is 5
    assert leeway(allows, pass_by(0.0)) == Leeway(1.0 + 4.5 + 1.25, 1.0, 0.0)
    assert leeway(allows, pass_by(0.0)).times(2.0) == Leeway(13.5, 2.0, 0.0)


def test_a_question_from_zero_on_has_the_same_truth():
    made = [make_question(f, 5, i) for f in FAMILIES for i in range(4)]
    shifted = [from_zero(q) for q in made]
    assert any(q.time[0] for q in made)
    for before, after, q, s in zip(truths(made), truths(shifted), made, shifted, strict=True):
        assert s.time[0] == 0.0
        assert {tuple(body.x[:1]) for body in (s.a, s.b)} <= {(), (0.0,)}
        assert (before.time is None) == (after.time is None)
        if before.time is not None:
            assert float(before.time) - q.time[0] == pytest.approx(float(after.time), abs=1e-12)


def test_a_question_that_is_no_longer_of_doubles_is_none():
    fast = square(0.1, 0.0, x=(0.0, 2.0**60), y=(0.0, 1.0))
    assert from_zero(Question(fast, square(9.0, 9.0), (1.0, 2.0))) is None


def test_polygons_are_asked_counter_clockwise():
    ring = square(0.0, 0.0).vertices
    for vertices in (ring, ring[::-1]):
        asked = as_asked(Question(Moving(vertices), square(3.0, 0.0), (0.0, 8.0)))
        assert asked["a"]["vertices"] in [list(map(list, ring[i:] + ring[:i])) for i in range(4)]
        assert asked["a"]["x"] == [0.0, 0.0]


@pytest.mark.parametrize(
    "body, kind",
    [
        (Moving(((0.0, 0.0),)), "point"),
        (Moving(((0.0, 0.0), (1.0, 0.0))), "segment"),
        (Moving(((0.0, 0.0), (1.0, 0.0), (2.0, 1.0)), closed=False), "chain"),
        (square(0.0, 0.0), "convex"),
        (Moving(((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 2.0))), "simple"),
        (Moving(((0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0))), "simple"),
    ],
)
def test_kinds_of_bodies(body, kind):
    assert kind_of(body) == kind


CURVED = square(3.0, 0.0, x=(0.0, -1.0, 0.5), y=(0.0, 0.0))
LONG = square(3.0, 2.0**-30, x=(0.0, -1.0), y=(0.0, 0.0))


@every(
    "takes, moving, why",
    [
        ({}, square(3.0, 0.0), None),
        ({"shapes": ["segment"]}, square(3.0, 0.0), "a convex polygon"),
        ({"vertices": 3}, square(3.0, 0.0), "too many vertices"),
        ({}, CURVED, "not a linear motion"),
        ({"motion": "polynomial"}, CURVED, None),
        ({"most": 1.0}, square(3.0, 0.0, 2.0), "a large body"),
        ({"least": 0.5}, square(3.0, 0.0, 0.25), "a small body"),
        ({"start": "apart"}, square(1.0, 0.0), "in contact at the start"),
        ({"start": "apart"}, square(3.0, 0.0), None),
        ({"digits": 24}, LONG, "numbers of too many digits"),
        ({"digits": 53}, LONG, None),
    ],
)
def test_why_a_question_is_not_asked(takes, moving, why):
    question = Question(square(0.0, 0.0), moving, (0.0, 1.0))
    truth = truth_of(question)
    assert isinstance(truth, Truth)
    assert why_not({"shapes": ["convex"], "motion": "linear", **takes}, question, truth) == why
