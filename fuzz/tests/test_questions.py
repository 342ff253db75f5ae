"""Questions against their definitions: cases repeat, and what is wrong is found."""

from fractions import Fraction
from random import Random
from unittest.mock import ANY

import pytest
import shapely
from click.testing import CliRunner
from folding import every

from exactpt import AlgebraicNumber, Body, Scene
from exactpt.kernel.numbers import QQ
from exactpt.motion import curve
from exactpt.motion.displacement import Placed, placed_at
from exactpt.pair.sure import surely_meet
from exactpt.search import enclosed
from exactpt.search.clearance import Minimum
from exactpt.testing.reference import overlap
from fuzz.laws.runner import Case, Looked, look
from fuzz.questions import by_cgal, checks, convoys
from fuzz.questions.command import questions
from fuzz.questions.scenes import distant_scene
from fuzz.questions.stated import stated_case
from fuzz.questions.tiny import touching_scene

DEFINED = [name for name in checks.QUESTIONS if name != "cgal"]


def run(*words):
    return CliRunner().invoke(questions, [*words, "--jobs", "0"], catch_exceptions=False)


@pytest.mark.parametrize("question", DEFINED)
def test_no_difference(question, tmp_path):
    slow = ("spin", "path", "stated", "touching-rings")
    cases = "12" if question in slow else "60"
    result = run("--question", question, "--cases", cases, "--keep", str(tmp_path / "found"))

    assert result.exit_code == 0, result.output
    assert f"\n{question}, seed 0: {cases} cases" in result.output
    assert result.output.endswith(" 0 differences\n")
    assert len(result.output.splitlines()) > 3  # several kinds of cases
    assert not (tmp_path / "found").exists()


@pytest.mark.cgal
def test_no_difference_by_cgal():
    result = run("--question", "cgal", "--cases", "60")

    assert result.exit_code == 0, result.output
    assert " decisions of CGAL, 0 differences" in result.output


@pytest.mark.parametrize("question", DEFINED)
def test_a_case_is_the_same_in_every_run(question):
    first, again = (checks.checked(question, 3, 14) for _ in range(2))

    assert first == again
    assert checks.checked(question, 3, 15).scene != first.scene


def never(*_, **__):
    return None


def test_a_wrong_answer_is_found(monkeypatch, tmp_path):
    monkeypatch.setattr(convoys, "first_contact", never)
    result = run("--question", "convoy", "--cases", "20", "--keep", str(tmp_path))

    assert result.exit_code == 1
    assert "convoy, case " in result.output
    kept = sorted(tmp_path.glob("convoy-0-*.json"))
    assert kept
    assert Scene.load(kept[0]).bodies


def forgets(body, t, displacement):
    """Place a body as if a stated error did not count at the start."""
    return Placed(placed_at(body, t, displacement).body, QQ(0))


def halves(body, t, displacement):
    placed = placed_at(body, t, displacement)
    return Placed(placed.body, placed.error / 2)


def is_strict(a, b, t, error):
    return surely_meet(a, b, t, 2 * error)


@pytest.mark.parametrize(
    "planted, bug, cases",
    [("placed_at", forgets, 3), ("placed_at", halves, 40), ("surely_meet", is_strict, 40)],
)
def test_a_wrong_start_of_bodies_with_stated_errors_is_found(planted, bug, cases, monkeypatch):
    monkeypatch.setattr(enclosed, planted, bug)
    faults = (checks.checked("stated", 0, number).fault for number in range(cases))
    assert any(faults)


def test_bug_error_of_a_fit_was_taken_for_a_stated_one():
    """Squares of side 4, at (7/4 + 10^-9, 1) from each other, overlap by 9/4 - 10^-9.

    A place error of 5/4 is stated. The other is 1 by the constructor, of which the fit needs more
    than 10^-9: so less than 9/4 - 10^-9 is stated in all, and the contact is certain.
    """
    case = Case("enclosed/errors", "own", 7004, 52)

    made = stated_case(Random(f"choices {case}"))

    assert sorted(body.motion.place_error for body in made.scene.bodies) == [1, Fraction(5, 4)]
    assert max(made.errors) == Fraction(5, 4)
    assert 2 < made.error < Fraction(9, 4) - Fraction(1, 10**9)
    assert look(case) == Looked(case, "certain, touching", ANY)


def test_a_curve_whose_jumps_are_forgotten_is_found(monkeypatch):
    monkeypatch.setattr(curve.ClosedCurve, "place_offset", QQ(0))
    faults = (checks.checked("curves", 0, number).fault for number in range(20))
    assert any(fault and "error of the place" in fault for fault in faults)


def test_a_curve_that_is_closed_up_over_any_jump_is_found(monkeypatch):
    monkeypatch.setattr(curve, "MAX_ULPS", 10**30)
    faults = (checks.checked("curves", 0, number).fault for number in range(20))
    assert "it jumps and is not refused" in faults


@pytest.fixture
def gap():
    return checks.clearance(distant_scene(Random("1")), "a", "b")


@pytest.mark.cgal
def test_cgal_finds_a_wrong_minimum_and_a_wrong_time(gap):
    scene = distant_scene(Random("1"))
    time = checks.first_within(scene, "a", "b", 1)
    assert by_cgal.compare(scene, gap, QQ(1), time)[1] is None
    other = AlgebraicNumber(QQ(1, 7))
    assert by_cgal.compare(scene, gap, QQ(0), other)[1] is not None
    object.__setattr__(
        gap, "minimum", Minimum(gap.minimum.time, AlgebraicNumber(gap.minimum.squared.high + 1))
    )
    assert (
        "less than" in by_cgal.compare(scene, gap, QQ(1), time)[1]
        or "is not" in (by_cgal.compare(scene, gap, QQ(1), time)[1])
    )


def test_overlap_by_vertical_lines_is_an_area_in_common():
    random, seen = Random(5), set()
    for _ in range(150):
        scene = touching_scene(random)
        a, b = scene.bodies[:2]
        p, q = (body.exact_at(scene.exact_start) for body in (a, b))
        if not a.has_interior or not b.has_interior:
            continue
        area = shapely.Polygon(p).intersection(shapely.Polygon(q)).area
        found = overlap(a, b, scene.exact_start)
        assert found == (area > 1e-9)
        seen.add(found)
    assert seen == {True, False}


@every(
    "first, second, expected",
    [
        ([(0, 0), (4, 0), (0, 4)], [(1, 1)], True),
        ([(0, 0), (4, 0), (0, 4)], [(2, 0)], False),
        ([(0, 0), (4, 0), (0, 4)], [(0, 0)], False),
        ([(0, 0), (4, 0), (4, 4), (0, 4), (1, 2)], [(1, 2)], False),  # a reflex vertex
        ([(0, 0), (4, 0), (0, 4)], [(0, 0), (2, 2)], True),
        ([(0, 0), (4, 0), (0, 4)], [(0, 0), (3, 0)], False),
        ([(0, 0), (4, 0), (0, 4)], [(1, 0), (1, 4)], True),
        ([(0, 0), (2, 2)], [(0, 2), (2, 0)], True),
        ([(0, 0), (2, 2)], [(1, 1), (2, 0)], False),
    ],
)
def test_overlap_of_thin_bodies(first, second, expected):
    a, b = Body("a", first), Body("b", second)

    assert overlap(a, b, QQ(0)) is expected
    assert overlap(b, a, QQ(0)) is expected
