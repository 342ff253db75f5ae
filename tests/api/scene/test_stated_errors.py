"""Errors that are stated of bodies: what is refused, what keeps them, and who uses them."""

import contextlib
import copy
import pickle
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from public_calls import CALLS, World

from exactpt import (
    Affine,
    Body,
    Bounce,
    InputError,
    Pieces,
    Planner,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
    contacts,
    first_contact_enclosed,
    onward,
    read_shapes,
    stop,
    to_features,
    union,
    write_shapes,
)
from exactpt.exchange.files import lost_by_writing
from exactpt.testing import shrink

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
ERRORS = {"place_error": "1/10", "angle_error": "1/100", "shape_error": ("1/20", "1/30")}
MEASURES = {"units": {"length": "mm", "time": "s"}, "epoch": "2026-01-01T00:00:00Z"}


def errors_of(body):
    return body.place_error, body.angle_error, body.shape_error, body.reference_point


@pytest.mark.parametrize(
    "given, words",
    [
        ({"place_error": -1}, "place_error: it must be at least 0, got -1"),
        ({"place_error": True}, "place_error: not an exact number: True"),
        ({"place_error": False}, "place_error: not an exact number: False"),
        ({"place_error": None}, "place_error: not a number: None"),
        ({"place_error": ""}, "place_error: not a number"),
        ({"place_error": float("nan")}, "place_error: not a finite number"),
        ({"place_error": np.float64("inf")}, "place_error: not a finite number"),
        ({"place_error": [1]}, "place_error: not a number"),
        ({"angle_error": "-1/3", "pivot": (0, 0)}, "angle_error: it must be at least 0, got -1/3"),
        ({"angle_error": 1}, "angle_error: it needs a reference point, got 1 "),
        ({"angle_error": False}, "angle_error: not an exact number"),
        ({"shape_error": 1}, "shape_error: two numbers are needed"),
        ({"shape_error": (1,)}, "shape_error: two numbers are needed"),
        ({"shape_error": (1, 2, 3)}, "shape_error: two numbers are needed"),
        ({"shape_error": "12"}, "shape_error: two numbers are needed"),
        ({"shape_error": None}, "shape_error: two numbers are needed"),
        ({"shape_error": (0, -1)}, "shape_error: it must be at least 0, got -1"),
        ({"shape_error": ((1,), 0)}, "shape_error: not a number"),
        ({"pivot": (0, 0)}, "pivot: it is the reference point of an angle_error above 0"),
        ({"pivot": (0, 0), "place_error": 1}, "pivot: it is the reference point"),
        ({"angle_error": 1, "pivot": 5}, "pivot: two coordinates are needed"),
        ({"angle_error": 1, "pivot": (1, 2, 3)}, "pivot: two coordinates are needed"),
        ({"angle_error": 1, "pivot": "00"}, "pivot: two coordinates are needed"),
        ({"angle_error": 1, "pivot": ("a", 0)}, "pivot: not a number: 'a'"),
        ({"angle_error": 1, "pivot": ([0, 1], 0)}, "pivot: not a number"),
    ],
)
def test_errors_that_are_none_are_refused_with_the_body_and_the_key(given, words):
    at_rest = Body("plate", SQUARE)
    for state in (lambda **e: Body("plate", SQUARE, **e), at_rest.with_errors):
        with pytest.raises(InputError, match=words) as refused:
            state(**given)
        assert str(refused.value).startswith("body 'plate': ")
        assert "\n" not in str(refused.value)


def test_numbers_of_errors_are_exact():
    body = Body("a", SQUARE, place_error=0.1, angle_error=np.float32(0.5), pivot=np.zeros(2),
                shape_error=np.array([0.25, 3]))  # fmt: skip
    assert errors_of(body) == (Fraction(0.1), Fraction(1, 2), (Fraction(1, 4), 3), (0, 0))
    assert {type(body.place_error), type(body.angle_error), type(body.pivot[0])} == {Fraction}
    plain = Body("a", SQUARE)
    assert errors_of(plain) == (0, 0, (0, 0), None)
    assert plain.pivot is None


@pytest.mark.parametrize(
    "motion",
    [
        Rigid([0, 1], pivot=(2, 3)),
        Spin(1, (2, 3), error="1/100"),
        PosePath([0, 1], [(0, 0, [0, 1])], pivot=(2, 3), error="1/100"),
        Pieces([(0, Translation()), (None, Rigid([0, 1], pivot=(2, 3)))]),
    ],
)
def test_a_motion_that_turns_has_the_reference_point(motion):
    body = Body("a", SQUARE, motion, angle_error="1/9")
    assert (body.reference_point, body.pivot) == ((2, 3), None)
    with pytest.raises(InputError, match=r"pivot: the motion turns about \(2, 3\) already, got"):
        Body("a", SQUARE, motion, angle_error="1/9", pivot=(2, 3))


@pytest.mark.parametrize(
    "body",
    [
        Body("a", SQUARE, Translation([0, 1])),
        Body("a", SQUARE, Affine([[1, 0], [0, [1, 1]]])),
        Body("a", SQUARE, Pieces([(0, Translation()), (None, Translation([0, 1]))])),
        Body("a", keyframes=[(0, SQUARE), (1, SQUARE)]),
        Body("a", [{"x": [0, 1]}, (5, 0), (5, 5)]),
    ],
)
def test_a_motion_that_does_not_turn_needs_a_pivot(body):
    with pytest.raises(InputError, match="angle_error: it needs a reference point, got 1/9"):
        body.with_errors(angle_error="1/9")
    stated = body.with_errors(angle_error="1/9", pivot=(2, 3))
    assert stated.reference_point == stated.pivot == (2, 3)


def test_pieces_about_two_pivots_have_no_angle_error():
    turns = [(0, Rigid(0, pivot=(1, 2))), (None, Rigid(0, pivot=(3, 4)))]
    body = Body("a", SQUARE, Pieces(turns), place_error=1)
    with pytest.raises(InputError, match=r"one pivot, .* about \(1, 2\) and about \(3, 4\)"):
        body.with_errors(angle_error=1)


def test_a_new_motion_keeps_the_errors_about_the_same_point():
    body = Body("a", SQUARE, Rigid([0, 1], pivot=(2, 3)), **ERRORS)
    slid = body.with_motion(Translation([0, 1]))
    assert slid.pivot == (2, 3)
    turned = slid.with_motion(Rigid([0, 2], pivot=(2, 3)))
    assert turned.pivot is None
    assert errors_of(body) == errors_of(slid) == errors_of(turned)
    words = r"body 'a': angle_error: it is stated about \(2, 3\), got a motion .* \(0, 0\)"
    for one in (body, slid):
        with pytest.raises(InputError, match=words):
            one.with_motion(Rigid([0, 1]))
    place_alone = body.with_errors(place_error=1)
    assert place_alone.with_motion(Rigid([0, 1])).place_error == 1


def test_errors_are_kept_by_everything_that_makes_a_body_of_a_body():
    body = Body("a", SQUARE, Rigid([0, 1], pivot=(2, 3)), properties={"k": 1}, **ERRORS)
    made = [
        body.with_radius(2),
        pickle.loads(pickle.dumps(body)),
        copy.copy(body),
        copy.deepcopy(body),
        Scene([body]).since("1/2").bodies[0],
        Scene([body]).until("1/2")["a"],
        Simulation(Scene([body])).body("a"),
    ]
    assert {errors_of(one) for one in made} == {errors_of(body)}


def test_a_halted_body_has_its_reference_point_where_the_motion_had_it():
    # At t = 1 the half turn is 1: a quarter turn about (2, 3), then a move by (1, 0).
    body = Body("a", SQUARE, Rigid([0, 1], pivot=(2, 3), x=[0, 1]), **ERRORS)
    halted = body.halted(1)
    assert halted.reference_point == (3, 3)
    assert errors_of(halted)[:3] == errors_of(body)[:3]
    corner = Body("c", [(2, 3)], body.motion).at(1)[0]
    assert corner == halted.reference_point


def test_a_halted_body_states_what_was_assumed_of_its_motion():
    path = PosePath([0, 4], [([0, 1], 0, 0)]).with_place_error("1/10")
    assert Body("a", SQUARE, path).halted(2).place_error == Fraction(1, 10)
    stated = Body("a", SQUARE, path, place_error="1/5").halted(2)
    assert stated.place_error == Fraction(3, 10)
    unwrapped = PosePath.through([0, 1], [(0, 0, 3), (0, 0, -3)], unwrap=True, pivot=(1, 1))
    assumed = unwrapped.assumed_angle_error
    assert assumed > 0
    halted = Body("a", SQUARE, unwrapped).halted(1)
    assert (halted.angle_error, halted.reference_point) == (assumed, (1, 1))
    assert errors_of(Body("a", SQUARE, Spin(1)).halted(1)) == (0, 0, (0, 0), None)


# Responses and histories of simulations


def flying(**errors):
    path = PosePath([0, 9], [([0, 1], 0, 0)]).with_place_error("1/10")
    ball = Body("ball", SQUARE, path, **errors)
    return Scene([ball, Body("wall", [(4, -9), (5, -9), (5, 9), (4, 9)])], (0, 9), **MEASURES)


def test_a_body_that_is_stopped_is_known_no_better_than_before():
    simulation = Simulation(flying(shape_error=(1, 2)), record=True)
    list(simulation.run(on_contact=stop))
    ball = simulation.body("ball")
    assert (ball.place_error, ball.shape_error) == (Fraction(1, 10), (1, 2))
    assert simulation.body("wall").place_error == 0
    assert simulation.scene.units.length == "mm"


def test_a_body_that_bounces_is_known_no_better_than_before_and_so_is_its_history():
    simulation = Simulation(flying(place_error="1/5"), record=True)
    list(simulation.run(on_contact=Bounce(["wall"])))
    ball = simulation.body("ball")
    assert ball.at(9)[0][0] < 3
    assert ball.place_error == Fraction(3, 10)
    whole = simulation.history().scene()
    assert whole.body("ball").place_error == Fraction(3, 10)
    assert (whole.units, whole.epoch) == (flying().units, flying().epoch)
    assert whole.body("ball").at(1) == flying().body("ball").at(1)


def test_a_second_bounce_adds_no_error_again():
    path = PosePath([0, 9], [([0, 1], 0, 0)]).with_place_error("1/10")
    body = Body("ball", SQUARE, path)
    simulation = Simulation(
        Scene([body, *(Body(f"w{x}", [(x, -9), (x, 9)]) for x in (-2, 3))], (0, 20))
    )
    list(simulation.run(on_contact=Bounce(["w-2", "w3"])))
    assert simulation.body("ball").place_error == Fraction(1, 10)


def test_a_body_that_a_caller_gives_in_place_of_a_motion_brings_its_own_errors():
    simulation = Simulation(flying())
    list(simulation.run(until=1))
    ball = simulation.body("ball")
    simulation.set_motion("ball", ball.with_motion(onward(ball, 1, (0, 1))))
    assert simulation.body("ball").place_error == 0


def test_a_history_has_the_largest_errors_of_its_motions():
    simulation = Simulation(Scene([Body("a", SQUARE, **ERRORS, pivot=(1, 1))], (0, 9)), record=True)
    list(simulation.run(until=2))
    other = Body("a", SQUARE, place_error=2, shape_error=("1/99", 1))
    simulation.set_motion("a", other.with_motion(Translation([-2, 1])))
    list(simulation.run(until=4))
    body = simulation.history().scene().body("a")
    assert body.place_error == 2
    assert body.shape_error == (Fraction(1, 20), 1)
    assert (body.angle_error, body.pivot) == (Fraction(1, 100), (1, 1))


def test_a_history_with_angle_errors_about_two_points_is_no_scene():
    quarter = Rigid([0, 1], pivot=(1, 1))
    about = Body("a", SQUARE, quarter, angle_error="1/9")
    simulation = Simulation(Scene([about], (0, 9)), record=True)
    list(simulation.run(until=1))
    # At t = 1 the half turn about (1, 1) is 1: the corner (0, 0) is at (2, 0).
    here = Rigid(1, pivot=(0, 0), x=[2])
    assert Body("a", SQUARE, here).at(1) == about.at(1)
    simulation.set_motion("a", Body("a", SQUARE, here))
    list(simulation.run(until=2))
    assert [life.body.angle_error for life in simulation.history().lives] == [Fraction(1, 9), 0]
    with pytest.raises(InputError, match="what it turns about"):
        simulation.history().scene()


@pytest.mark.parametrize("record", [False, True])
def test_a_saved_run_keeps_errors_units_and_the_epoch(tmp_path, record):
    simulation = Simulation(flying(**ERRORS), record=record)
    list(simulation.run(until=1))
    simulation.save(tmp_path / "run.json")
    restored = Simulation.restore(tmp_path / "run.json")
    assert restored.scene == simulation.scene
    assert errors_of(restored.body("ball")) == errors_of(simulation.body("ball"))
    assert restored.scene.epoch == MEASURES["epoch"]
    assert simulation.copy().scene == simulation.scene


# Unions, planners, formats, shrinking


def test_a_union_has_the_errors_of_its_bodies():
    motion = Translation([0, 1])
    common = {"place_error": 1, "angle_error": 2, "pivot": (7, 7)}
    a = Body("a", SQUARE, motion, shape_error=(1, 4), **common)
    b = Body("b", [(x + 1, y) for x, y in SQUARE], motion, shape_error=(3, 2), **common)
    assert errors_of(union([a, b], name="c")) == (1, 2, (3, 4), (7, 7))
    for other in (b.with_errors(), b.with_errors(place_error=1, angle_error=2, pivot=(7, 8))):
        with pytest.raises(InputError, match="'a' and 'b' have different place or angle errors"):
            union([a, other], name="c")


def test_a_union_at_rest_has_its_reference_point_in_the_scene():
    moved = Body("a", SQUARE, Translation(5), angle_error=1, pivot=(0, 0))
    there = Body("b", [(6, 0), (7, 0), (7, 1), (6, 1)], angle_error=1, pivot=(5, 0))
    assert union([moved, there], name="c").reference_point == (5, 0)
    with pytest.raises(InputError, match="different place or angle errors"):
        union([moved, there.with_errors(angle_error=1, pivot=(0, 0))], name="c")


def test_a_planner_moves_a_shape_with_errors_by_any_motion():
    planner = Planner([Body("wall", [(4, -9), (4, 9)])], (0, 9))
    shape = Body("a", SQUARE, angle_error=1, pivot=(9, 9))
    turn = Rigid([0, 1], x=[0, 1])
    assert planner.first_contact(shape, turn).time == planner.first_contact(SQUARE, turn).time


@pytest.mark.parametrize("suffix", ["geojson", "wkt", "svg", "mfjson"])
def test_other_formats_name_errors_units_and_the_epoch_as_lost(tmp_path, suffix):
    bodies = [Body("a", SQUARE, **ERRORS, pivot=(0, 0)), Body("b", [(5, 5)], place_error=1)]
    scene = Scene(bodies, **MEASURES)
    path = tmp_path / f"out.{suffix}"
    lost = lost_by_writing(scene, path, None)
    for words in (
        "place error of 2 bodies",
        "angle error of 1 body",
        "shape error of 1 body",
        "units",
        "epoch",
    ):
        assert words in lost
    with pytest.raises(InputError, match=r"lost: .*place error of 2 bodies"):
        write_shapes(scene, path, strict=True)
    assert not path.exists()
    write_shapes(scene, path)
    assert {body.place_error for body in read_shapes(path)} == {0}
    assert not {"units", "epoch"} & {*lost_by_writing(Scene([Body("a", SQUARE)]), path, None)}


def test_a_scene_file_loses_nothing(tmp_path):
    scene = Scene([Body("a", SQUARE, **ERRORS, pivot=(0, 0))], **MEASURES)
    path = tmp_path / "scene.json"
    write_shapes(scene, path, strict=True)
    assert read_shapes(path) == Scene.load(path) == scene


def test_a_shrunken_scene_loses_what_has_no_part_in_the_failure():
    bodies = [Body("a", SQUARE, **ERRORS, pivot=(0, 0)), Body("b", SQUARE, place_error=1)]
    scene = Scene(bodies, **MEASURES)
    small = shrink(scene, lambda s: len(s) == 2)
    assert small.units is small.epoch is None
    assert {errors_of(body) for body in small} == {(0, 0, (0, 0), None)}
    kept = shrink(scene, lambda s: s.epoch is not None and s.bodies[0].angle_error > 0)
    assert kept.bodies[0].angle_error == 1
    assert kept.units.time == "s"


# Who uses them


class StatedWorld(World):
    """The same bodies, with errors that would change any result, and a scene with all keys."""

    @property
    def moving(self):
        return super().moving.with_errors(**ERRORS, pivot=(0, 0))

    @property
    def standing(self):
        return super().standing.with_errors(place_error=5)

    def stated(self, scene):
        return Scene(scene.bodies, scene.time, **MEASURES)

    @property
    def scene(self):
        return self.stated(super().scene)

    @property
    def curved(self):
        return self.stated(super().curved)


KEEPS = {
    "Body", "History", "Proof", "Scene", "Scene.load", "Simulation", "Simulation.max_seconds",
    "Simulation.restore", "certify", "prove", "testing.shrink", "union",
}  # fmt: skip
"""Calls that return a body or a scene, or the bytes of one: these keep what is stated."""

REFUSE = {"EnclosedContact", "first_contact_enclosed"}
"""Calls about true bodies that do not take stated errors into account."""


def shown(value):
    return value.to_json() if hasattr(value, "to_json") else repr(value)


@pytest.mark.long
def test_questions_about_modelled_bodies_do_not_use_what_is_stated(tmp_path):
    differ = set()
    for name in CALLS:
        call, results = CALLS[name], []
        for world in (World(tmp_path), StatedWorld(tmp_path)):
            with contextlib.suppress(InputError):
                results.append(shown(call(world)))
        if len(results) < 2:
            assert name in REFUSE, name
        elif results[0] != results[1]:
            differ.add(name)
    assert differ <= KEEPS, differ - KEEPS


def test_a_picture_does_not_show_what_is_stated(tmp_path):
    texts = set()
    for world in (World(tmp_path), StatedWorld(tmp_path)):
        world.scene.draw(tmp_path / "scene.svg", at=1)
        texts.add((tmp_path / "scene.svg").read_text())
    assert len(texts) == 1


@pytest.mark.parametrize("key", ["place_error", "angle_error", "shape_error"])
def test_an_enclosed_contact_refuses_an_error_that_it_does_not_obey(key):
    given = {key: ERRORS[key]} | ({"pivot": (0, 0)} if key == "angle_error" else {})
    scene = Scene([Body("a", [(9, 9)]), Body("b", SQUARE, **given)])
    with pytest.raises(InputError, match=f"body 'b': {key}: first_contact_enclosed obeys"):
        first_contact_enclosed(scene)
    plain = Scene([Body("a", [(9, 9)]), Body("b", SQUARE)], **MEASURES)
    assert first_contact_enclosed(plain) is None


def test_a_world_with_stated_errors_is_another_scene(tmp_path):
    world = World(tmp_path)
    assert StatedWorld(tmp_path).scene != world.scene
    assert replace(world, mover="b").moving.place_error == 0


def test_a_new_motion_of_a_run_keeps_what_was_assumed_of_the_old_one():
    """The place of the true body was known within 1, and is known no better by a new motion."""
    path = PosePath([0, 9], [([0, 1], [0], [0])]).with_place_error(1)
    probe = Body("probe", [(0, 0), (1, 0), (1, 1), (0, 1)], path)
    wall = Body("wall", [(7, 0), (8, 0), (8, 1), (7, 1)])
    simulation = Simulation(Scene([probe, wall], time=(0, 9)))
    for _ in simulation.run(until=1):
        pass

    simulation.set_motion("probe", onward(simulation.body("probe"), 1, (1, 0)))

    assert simulation.body("probe").place_error == 1


def test_dates_of_a_scene_with_an_epoch_are_refused():
    scene = Scene(
        [Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(3, 0)])],
        time=(0, 9),
        units={"time": "h"},
        epoch="2026-01-01T00:00:00Z",
    )

    with pytest.raises(InputError, match="dates: times are taken as seconds"):
        to_features(scene, contacts(scene), dates=True)
