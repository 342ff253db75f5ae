"""Each way to find a first contact, on plain scenes; planted answers are the exact ones."""

import sys
from random import Random

import pytest
from folding import every

from benchmarks.methods import others, own
from benchmarks.methods.arrays import FROM_ARRAYS
from benchmarks.methods.closed_form import CLOSED_FORM
from benchmarks.methods.cpp import SWEEP_AND_PRUNE, has_compiler
from benchmarks.methods.method import Method, UnsuitableScene, error_of
from benchmarks.methods.moving import Moving
from benchmarks.methods.own import EXACT_SEARCH, OWN, fresh
from benchmarks.peers import is_installed
from benchmarks.planted import FAMILIES, Planted
from benchmarks.programs import with_fcl
from benchmarks.shapes import combs, tangle
from benchmarks.tests.bench_help import (
    closing_jaw,
    meeting,
    passing,
    segments_and_points,
    thrown,
    turning,
)
from benchmarks.wrong_answers import Wrong, count_wrong
from exactpt import Body, Scene, Translation
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference

STEPS = 128
ANSWERS = [
    (meeting, 3.0),
    (thrown, 5.0),
    (segments_and_points, 3.0),
    (closing_jaw, 2.0),
    (passing, None),
]


def answer(method, scene):
    return method.prepare(scene)()


@pytest.mark.parametrize("make, truth", ANSWERS)
@pytest.mark.parametrize("method", [*OWN, EXACT_SEARCH], ids=lambda m: m.name + m.setting)
def test_exact_ways_are_exact(method, make, truth):
    found = answer(method, make())
    assert found is None if truth is None else found == AlgebraicNumber(truth)


@pytest.mark.parametrize("make, truth", [(meeting, 3.0), (thrown, 5.0), (passing, None)])
def test_scenes_in_arrays_are_answered_exactly(make, truth):
    found = answer(FROM_ARRAYS, make())
    assert found is None if truth is None else found == AlgebraicNumber(truth)


def test_rows_of_a_compiled_build_say_so(monkeypatch):
    monkeypatch.setattr(own, "is_compiled", lambda: True)
    assert own.in_build("pairs") == "pairs, compiled"
    monkeypatch.setattr(own, "is_compiled", lambda: False)
    assert own.in_build("pairs") == "pairs"


def test_fcl_is_called_for_the_pairs_that_come_near(monkeypatch):
    """The earliest of their times, from the start of the span on; FCL itself is not needed."""
    called = []

    def answered(question, way):
        called.append((question["a"]["vertices"][0], way))
        return None if len(called) == 1 else 3.0 / len(called)

    monkeypatch.setattr(with_fcl, "answer", answered)
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    bodies = [
        Body(str(i), [(x + 3 * i, y) for x, y in box], Translation([1, 1 if i else -1]))
        for i in range(4)
    ]

    assert answer(others.FCL, Scene(bodies[:2], time=(1, 2))) is None
    assert not called  # they move apart
    assert answer(others.FCL, Scene(bodies, time=(1, 9))) == 1.0 + 3.0 / 3
    assert [place for place, _ in called] == [[5.0, 0.0], [5.0, 0.0], [8.0, 0.0]]
    with pytest.raises(UnsuitableScene, match="linear ones"):
        others.FCL.prepare(thrown())
    with pytest.raises(UnsuitableScene, match="convex"):
        others.FCL.prepare(closing_jaw())


@pytest.mark.skipif(not is_installed("python-fcl"), reason="python-fcl is not installed")
def test_fcl_finds_a_contact_within_its_tolerance():
    assert answer(others.FCL, meeting()) == pytest.approx(3.0, abs=0.01)
    assert answer(others.FCL, passing()) is None


@pytest.mark.long
@pytest.mark.skipif(not has_compiler(), reason="g++ is not installed")
def test_sweep_and_prune_in_cpp():
    assert answer(SWEEP_AND_PRUNE, meeting()) == 3.0
    assert answer(SWEEP_AND_PRUNE, passing()) is None
    assert answer(SWEEP_AND_PRUNE, tangle(combs(16))) == pytest.approx(14.0)
    with pytest.raises(UnsuitableScene, match="not linear"):
        SWEEP_AND_PRUNE.prepare(thrown())


@pytest.mark.parametrize("make, truth", ANSWERS)
def test_closed_form(make, truth):
    assert answer(CLOSED_FORM, make()) == truth


@pytest.mark.parametrize("make, truth", ANSWERS)
def test_shapely_is_late_by_at_most_a_step(make, truth):
    pytest.importorskip("shapely")
    scene = make()
    found = answer(others.shapely(STEPS, bisect=False), scene)
    if truth is None:
        assert found is None
    elif make is segments_and_points:
        assert found is None  # no step meets a point on a segment
    else:
        assert 0.0 <= found - truth <= float(scene.end) / STEPS
        assert answer(others.shapely(STEPS, bisect=True), scene) == pytest.approx(truth, abs=1e-12)


@pytest.mark.parametrize("make, truth", [pair for pair in ANSWERS if pair[0] is not closing_jaw])
def test_pymunk_is_late_by_at_most_a_step(make, truth):
    pytest.importorskip("pymunk")
    scene = make()
    found = answer(others.pymunk(STEPS), scene)
    if truth is None or make is segments_and_points:
        assert found is None
    else:
        assert 0.0 <= found - truth <= float(scene.end) / STEPS


def test_pymunk_gets_bodies_that_are_not_convex_in_pieces():
    pytest.importorskip("pymunk")
    pytest.importorskip("shapely")
    assert answer(others.pymunk(410), tangle(combs(16))) == pytest.approx(14.0, abs=0.11)


@pytest.mark.parametrize("make, truth", [pair for pair in ANSWERS if pair[0] is not thrown])
@pytest.mark.parametrize("method", [others.tight_inclusion(1e-6, 8), others.additive(0.9999, 8)])
def test_ipctk_is_early(method, make, truth):
    pytest.importorskip("ipctk")
    found = answer(method, make())
    assert found is None if truth is None else -1e-3 < found - truth <= 0.0


def test_a_method_says_what_it_is_not_for():
    with pytest.raises(UnsuitableScene, match="turn"):
        CLOSED_FORM.prepare(turning())
    pytest.importorskip("pymunk")
    with pytest.raises(UnsuitableScene, match="deform"):
        others.pymunk(STEPS).prepare(closing_jaw())


def test_pymunk_without_shapely_takes_convex_bodies_alone(monkeypatch):
    pytest.importorskip("pymunk")
    monkeypatch.setitem(sys.modules, "shapely", None)
    assert answer(others.pymunk(STEPS), meeting()) == pytest.approx(3.0, abs=0.1)
    with pytest.raises(UnsuitableScene, match="without Shapely"):
        others.pymunk(STEPS).prepare(tangle(combs(16)))


def test_positions_in_doubles_are_the_positions():
    scene = thrown()
    exact = [point for points in scene.at("5/2").values() for point in points]
    assert Moving(scene).at(2.5).tolist() == [[float(x), float(y)] for x, y in exact]


def test_errors():
    root_of_two = AlgebraicNumber.root((-2, 0, 1), 1, 2)
    assert error_of(AlgebraicNumber.root((-2, 0, 1), 0, 3), root_of_two) == 0.0
    assert error_of(2.0**0.5, root_of_two) == 0.0
    assert error_of(AlgebraicNumber("1.4142135623730951"), root_of_two) > 0.0
    assert error_of(1.5, root_of_two) == pytest.approx(0.0857864)


def test_a_fresh_scene_is_the_same_scene():
    assert fresh(thrown()).at(3) == thrown().at(3)


@pytest.mark.parametrize("make, truth", [(meeting, 3.0), (passing, None)])
def test_box2d_stops_just_before_the_contact(make, truth):
    pytest.importorskip("Box2D")
    found = answer(others.BOX2D, make())
    assert found is None if truth is None else 0.0 < truth - found < 0.005


@pytest.mark.parametrize("make", [thrown, segments_and_points, closing_jaw, turning])
def test_box2d_is_for_two_polygons_in_linear_motion(make):
    with pytest.raises(UnsuitableScene):
        others.BOX2D.prepare(make())


# Planted answers are those of the plain exact search, and what is asked is asked in doubles

NO_CONTACT = {"graze, gap 2^-40", "tangential, gap 2^-47"}
ALWAYS_CONTACT = {"exact graze", "graze, overlap 2^-40", "tangential touch"}
ALWAYS_CONTACT |= {"tangential, crossing 2^-47"}
NO_DOUBLES = {"rational grid", "offset 2^30 to 2^50"}


def planted(family, count=4):
    return [FAMILIES[family](Random(f"{family}:test:{i}")) for i in range(count)]


@every("family", FAMILIES)
def test_the_planted_answer_is_true(family):
    for scene, truth in planted(family):
        contact = reference.first_contact(scene)
        assert (contact and contact.time) == truth
        assert family not in NO_CONTACT or truth is None
        assert family not in ALWAYS_CONTACT or truth is not None


@pytest.mark.parametrize("family", sorted(set(FAMILIES) - NO_DOUBLES))
def test_coordinates_are_doubles(family):
    for scene, _ in planted(family):
        for body in scene.bodies:
            for track in body.exact_piece_after(scene.start).tracks:
                for c in (*track.x, *track.y):
                    value = QQ(c, track.w[0])
                    assert QQ(*float(value).as_integer_ratio()) == value


def method_that_says(answer):
    return Method("test", "", lambda _: lambda: answer)


def test_wrong_answers_are_counted():
    scene = planted("exact graze", 1)[0].scene
    scenes = [Planted(scene, AlgebraicNumber(1)), Planted(scene, None)]
    assert count_wrong(method_that_says(None), scenes) == Wrong(2, missed=1)
    assert count_wrong(method_that_says(1.0), scenes) == Wrong(2, invented=1)
    assert count_wrong(method_that_says(1.0 + 1e-8), scenes) == Wrong(2, invented=1, off=1)
    assert count_wrong(method_that_says(1.0 + 1e-10), scenes) == Wrong(2, invented=1)


def test_of_exactpt_any_error_counts(monkeypatch):
    late = Method(*[getattr(OWN[0], a) for a in ("name", "setting")], lambda _: lambda: 1.0 + 1e-15)
    monkeypatch.setattr("benchmarks.wrong_answers.EXACT", (late,))
    scenes = [Planted(planted("exact graze", 1)[0].scene, AlgebraicNumber(1))]
    assert count_wrong(late, scenes) == Wrong(1, off=1)
