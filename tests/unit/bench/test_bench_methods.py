"""Each way to find a first contact, on scenes whose answers are plain."""

import sys

import pytest
from bench_help import closing_jaw, meeting, passing, segments_and_points, thrown, turning

from benchmarks.methods.closed_form import CLOSED_FORM
from benchmarks.methods.method import UnsuitableScene, error_of
from benchmarks.methods.moving import Moving
from benchmarks.methods.own import EXACT_SEARCH, OWN, fresh
from benchmarks.methods.with_arrays import FROM_ARRAYS
from benchmarks.methods.with_box2d import BOX2D
from benchmarks.methods.with_cpp import SWEEP_AND_PRUNE, has_compiler
from benchmarks.methods.with_ipctk import with_additive, with_tight_inclusion
from benchmarks.methods.with_pymunk import with_pymunk
from benchmarks.methods.with_shapely import with_shapely
from benchmarks.shapes import combs, tangle
from exactpt.kernel.algebraic import AlgebraicNumber

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
    found = answer(with_shapely(STEPS, bisect=False), scene)
    if truth is None:
        assert found is None
    elif make is segments_and_points:
        assert found is None  # no step meets a point on a segment
    else:
        assert 0.0 <= found - truth <= float(scene.end) / STEPS
        assert answer(with_shapely(STEPS, bisect=True), scene) == pytest.approx(truth, abs=1e-12)


@pytest.mark.parametrize("make, truth", [pair for pair in ANSWERS if pair[0] is not closing_jaw])
def test_pymunk_is_late_by_at_most_a_step(make, truth):
    pytest.importorskip("pymunk")
    scene = make()
    found = answer(with_pymunk(STEPS), scene)
    if truth is None or make is segments_and_points:
        assert found is None
    else:
        assert 0.0 <= found - truth <= float(scene.end) / STEPS


def test_pymunk_gets_bodies_that_are_not_convex_in_pieces():
    pytest.importorskip("pymunk")
    pytest.importorskip("shapely")
    assert answer(with_pymunk(410), tangle(combs(16))) == pytest.approx(14.0, abs=0.11)


@pytest.mark.parametrize("make, truth", [pair for pair in ANSWERS if pair[0] is not thrown])
@pytest.mark.parametrize("method", [with_tight_inclusion(1e-6, 8), with_additive(0.9999, 8)])
def test_ipctk_is_early(method, make, truth):
    pytest.importorskip("ipctk")
    found = answer(method, make())
    assert found is None if truth is None else -1e-3 < found - truth <= 0.0


def test_a_method_says_what_it_is_not_for():
    with pytest.raises(UnsuitableScene, match="turn"):
        CLOSED_FORM.prepare(turning())
    pytest.importorskip("pymunk")
    with pytest.raises(UnsuitableScene, match="deform"):
        with_pymunk(STEPS).prepare(closing_jaw())


def test_pymunk_without_shapely_takes_convex_bodies_alone(monkeypatch):
    pytest.importorskip("pymunk")
    monkeypatch.setitem(sys.modules, "shapely", None)
    assert answer(with_pymunk(STEPS), meeting()) == pytest.approx(3.0, abs=0.1)
    with pytest.raises(UnsuitableScene, match="without Shapely"):
        with_pymunk(STEPS).prepare(tangle(combs(16)))


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
    found = answer(BOX2D, make())
    assert found is None if truth is None else 0.0 < truth - found < 0.005


@pytest.mark.parametrize("make", [thrown, segments_and_points, closing_jaw, turning])
def test_box2d_is_for_two_polygons_in_linear_motion(make):
    with pytest.raises(UnsuitableScene):
        BOX2D.prepare(make())
