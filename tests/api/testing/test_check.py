"""Grading by `check`, and `assert_same_contact`."""

import math
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from folding import every
from toi_mistakes import MISTAKES, toi, wrong

from exactpt import Body, InputError, Scene, Translation, first_contact
from exactpt.testing import (
    FAMILIES,
    LINEAR,
    Question,
    assert_same_contact,
    check,
    make_question,
    truths,
)
from exactpt.testing.truth import truth_of

ROOT = Path(__file__).parents[3]
CASES = 3 * len(FAMILIES)


@pytest.mark.long
def test_an_exact_function_is_right_about_every_family():
    report = check(toi, cases=3 * len(FAMILIES))

    assert str(report) == str(report.table)
    assert report.ok
    assert set(report.table.rows) == set(FAMILIES)


@pytest.mark.long
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_is_found_and_gets_small(mistake):
    report = check(wrong(mistake), cases=CASES)

    assert not report.ok
    assert report.counterexamples
    for example in report.counterexamples:
        sizes = [len(body.vertices) for body in (example.question.a, example.question.b)]
        assert max(sizes) <= 4, str(example)


def test_truths_are_those_of_the_first_contact():
    questions = [make_question(family, 1, number) for family in FAMILIES for number in range(4)]

    for question, truth in zip(questions, truths(questions), strict=True):
        assert truth.to_json() == truth_of(question).to_json(), question


def test_questions_are_the_same_everywhere():
    assert make_question("apex", 0, 0).to_json() == {
        "id": "apex:0:0",
        "time": [-2.0, 4.0],
        "a": {
            "vertices": [[-2.0, -13.0], [0.0, -15.0], [-2.0, -16.0], [-4.0, -13.0]],
            "motion": {"x": [0.0, 0.0], "y": [0.0, -2.0, 1.0]},
        },
        "b": {
            "vertices": [[-8.0, -18.0], [4.0, -18.0], [4.0, -17.0], [-8.0, -17.0]],
            "motion": {"x": [0.0, 0.0], "y": [0.0, 0.0]},
        },
    }


@every("family", LINEAR)
def test_linear_families_are_linear(family):
    question = make_question(family)

    assert max(len(f) for m in (question.a, question.b) for f in (m.x, m.y)) <= 2


def test_every_family_asks_what_it_says():
    """Degenerate families have their degeneracy, and no family is always a miss."""
    kinds = {
        family: [truth.kind for truth in truths([make_question(family, 2, n) for n in range(12)])]
        for family in FAMILIES
    }

    assert all(set(found) != {None} for found in kinds.values())
    assert set(kinds["touching_at_start"]) == set(kinds["overlapping_at_start"]) == {"initial"}
    assert set(kinds["grazing_corner"]) <= {"vertex-vertex", "vertex-edge"}
    for family in ("hairs_breadth", "last_moment", "apex", "together", "convex_pairs"):
        assert {None} < set(kinds[family]), family


def half_wrong(question):
    """Late by one, if there is a contact; a counterexample for the file."""
    time = truth_of(question).time
    return None if time is None else float(time) + 1.0


@pytest.mark.long
def test_counterexamples_are_a_pytest_file_that_fails_until_the_function_is_mended(tmp_path):
    report = check(half_wrong, cases=4, families=["edge_to_edge"])
    text = report.pytest_file()
    assert f"from {half_wrong.__module__} import half_wrong as toi" in text
    name = "tested"
    text = text.replace(half_wrong.__module__, name).replace(half_wrong.__name__, "toi")
    (tmp_path / "test_late.py").write_text(text)

    def run(body):
        (tmp_path / f"{name}.py").write_text(body)
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_late.py"]
        return subprocess.run(
            command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(ROOT)},
            capture_output=True, text=True, check=False,
        )  # fmt: skip

    exact = "from exactpt.testing.truth import truth_of\ndef toi(q):\n    t = truth_of(q).time\n"
    wrong_run = run(exact + "    return None if t is None else float(t) + 1.0\n")
    right_run = run(exact + "    return None if t is None else float(t)\n")

    assert wrong_run.returncode == 1
    assert "late: the answer is a contact at t =" in wrong_run.stdout
    assert "def assert_same_contact" not in wrong_run.stdout  # frames of exactpt are hidden
    assert right_run.returncode == 0, right_run.stdout


def test_each_family_has_a_counterexample_of_each_verdict():
    families = ["edge_to_edge", "sliding"]

    report = check(lambda _: 1000, cases=6, families=families)

    found = [(e.question.name.partition(":")[0], e.verdict) for e in report.counterexamples]
    assert found == [("edge_to_edge", "late"), ("sliding", "late")]
    names = ["def test_edge_to_edge_late():", "def test_sliding_late():"]
    assert [line for line in report.pytest_file().splitlines() if line[:4] == "def "] == names


def in_domain(question):
    return question.convex and question.time[0] == 0


def test_a_domain_holds_while_questions_are_drawn_and_shrunken():
    asked = []

    def mine(question):
        asked.append(question)

    families = ["sliding", "star_pairs", "ties"]
    report = check(mine, cases=6, families=families, accept=in_domain)

    assert all(map(in_domain, asked))
    assert set(report.table.rows) == {"sliding"}, "the others have no convex bodies"
    assert report.table.total["missed"] == 6
    (example,) = report.counterexamples
    assert in_domain(example.question)
    assert {len(body.vertices) for body in (example.question.a, example.question.b)} == {3}


def test_kinds_of_bodies():
    named = (("sliding", 0, 0), ("ties", 0, 0), ("sliding", 0, 8))
    boxes, forks, segments = (make_question(*name) for name in named)

    assert (boxes.polygons, boxes.convex) == (True, True)
    assert (forks.polygons, forks.convex) == (True, False)
    assert (segments.polygons, segments.convex) == (False, False)


@pytest.mark.long
def test_what_crashes_is_counted_and_shown():
    def crashing(question):
        raise ZeroDivisionError("no")

    report = check(crashing, cases=2, families=["sliding"])

    assert report.table.total["crashed"] == 2
    assert "crashed (sliding:0:" in str(report)
    assert "ZeroDivisionError" in str(report)
    assert "from my_module import toi" in report.pytest_file()


@pytest.mark.long
@pytest.mark.parametrize("answer", [math.nan, math.inf, "soon", (1, 2), True])
def test_what_is_no_time_counts_as_crashed(answer):
    report = check(lambda _: answer, cases=1, families=["sliding"])

    assert report.table.total["crashed"] == 1


def test_a_wrong_family_is_refused():
    with pytest.raises(InputError, match=r"no family 'circles'; there are: corner_to_corner, "):
        check(toi, families=["circles"])
    with pytest.raises(InputError, match="none is named"):
        check(toi, families=[])


def test_a_negative_tolerance_is_refused():
    with pytest.raises(InputError, match="a tolerance is not negative: -1"):
        check(toi, tolerance=-1)


@pytest.mark.long
def test_the_tolerance_is_exact():
    def off(question):
        return truth_of(question).time.low + 1

    asked = {"cases": 2, "families": ["sliding"]}
    assert check(off, tolerance=1, **asked).ok
    assert check(off, tolerance="0.999999999999999999", **asked).table.total["late"] == 2


def test_a_question_is_the_scene_that_it_makes():
    question = make_question("thrown_pairs")

    assert Question.from_scene(question.scene).scene == question.scene
    assert Question.from_json(question.to_json()) == question


def test_arrays_answer_all_questions_with_linear_motions(monkeypatch):
    """So the oracle is fast: none of them is asked by itself."""
    questions = [make_question(family, 4, number) for family in LINEAR for number in range(20)]
    alone = []
    monkeypatch.setattr("exactpt.testing.truth.truth_of", alone.append)

    assert len(truths(questions)) == len(questions)
    assert alone == []


@pytest.mark.parametrize(
    "function, options, message",
    [
        (None, {}, "toi: not a function: None"),
        (toi, {"accept": 1}, "accept: not a function: 1"),
        (
            toi,
            {"accept": lambda _: False, "families": ["bullet"]},
            "accept: it refuses all questions",
        ),
        (toi, {"cases": -1}, "cases: not a number of questions: -1"),
        (toi, {"cases": 1.5}, "cases: not a number of questions: 1.5"),
    ],
)
def test_what_cannot_be_asked_is_refused(function, options, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        check(function, **options)


# assert_same_contact: missed, invented, early, late, or the wrong witness, in one line

BOX = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1]))
WALL = Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])
HIT = Scene([BOX, WALL], (0, 10))
MISS = Scene([BOX, WALL], (0, 1))
SURD = Scene([Body("p", [(0, 0)], Translation([0, 0, 1])), Body("s", [(2, -1), (2, 1)])], (0, 2))
TRUTH = "the truth is a contact at t = 2 (vertex-edge): vertex 1 of box and edge 3 of wall, "


@pytest.mark.parametrize("answer", [2, 2.0, Fraction(2), "2", 2 + 1e-10])
def test_what_is_right_passes(answer):
    assert_same_contact(HIT, answer)


def test_contacts_pass_and_their_json():
    contact = first_contact(HIT)

    assert_same_contact(HIT, contact)
    assert_same_contact(HIT, contact.to_json())
    assert_same_contact(HIT, contact.time)
    assert_same_contact(SURD, first_contact(SURD).time)
    assert_same_contact(MISS, None)


@pytest.mark.parametrize(
    "scene, answer, says",
    [
        (HIT, None, f"missed: the answer is no contact; {TRUTH}"),
        (MISS, 0.5, "invented: the answer is a contact at t = 0.5; the truth is no contact"),
        (HIT, 1.5, f"early: the answer is a contact at t = 1.5; {TRUTH}"),
        (HIT, 2.5, f"late: the answer is a contact at t = 2.5; {TRUTH}"),
        (SURD, 1.5, "t = 1.4142135623730951, a root of [-2, 0, 1] (vertex-edge): vertex 0 of p"),
    ],
)
def test_what_is_wrong_is_one_line(scene, answer, says):
    with pytest.raises(AssertionError, match=re.escape(says)) as raised:
        assert_same_contact(scene, answer)

    assert "\n" not in str(raised.value)


def test_a_wrong_witness():
    wrong = {
        "time": 2,
        "pairs": [{"a": {"body": "box", "vertex": 0}, "b": {"body": "wall", "edge": 3}}],
    }

    with pytest.raises(AssertionError, match="wrong witness: vertex 0 of box and edge 3 of wall"):
        assert_same_contact(HIT, wrong)


@pytest.mark.parametrize("answer", [float("nan"), "soon", {"time": []}, {"time": 2, "pairs": 3}])
def test_what_is_no_answer_is_refused(answer):
    with pytest.raises(InputError, match="not "):
        assert_same_contact(HIT, answer)
