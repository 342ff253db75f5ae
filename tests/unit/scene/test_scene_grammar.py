"""The keys of version 0.3 in scenes: errors of bodies, pivots of records, units and the epoch."""

import copy
import json
import pickle
import random
from fractions import Fraction
from pathlib import Path

import pytest
from commands import code_of
from folding import every

from exactpt import (
    Body,
    InputError,
    Pieces,
    PosePath,
    Rigid,
    Scene,
    Spin,
    Translation,
    Units,
    batch,
    first_contact,
)
from exactpt.motion.stated_errors import pivots_of
from fuzz.general import MOTIONS, random_scene

TABLE = json.loads(Path("tests/data/grammar-misuse.json").read_text(encoding="utf-8"))
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
MEASURED = {"length": "mm", "time": "s"}
EPOCH = "2026-01-01T00:00:00.25+01:00"


def without_new_keys(data):
    """Return the data of a scene as version 0.2 would write it."""
    kept = {key: value for key, value in data.items() if key not in ("units", "epoch", "ignoring")}
    errors = ("place_error", "angle_error", "shape_error", "pivot")
    kept["bodies"] = [
        {key: value for key, value in body.items() if key not in errors} for body in data["bodies"]
    ]
    return kept


@every("row", [row for row in TABLE if row["accepted"]])
def test_a_scene_that_the_grammar_has_is_read_and_written(row):
    scene = Scene.from_json(row["scene"])
    written = scene.to_json()
    again = Scene.from_json(json.loads(json.dumps(written)))
    assert again == scene
    assert again.to_json() == written


@every("row", [row for row in TABLE if not row["accepted"]])
def test_a_scene_that_the_grammar_has_not_is_refused_in_one_line(row):
    with pytest.raises(InputError) as refused:
        Scene.from_json(row["scene"])
    message = str(refused.value)
    assert row["word"] in message
    assert len(message.splitlines()) == 1
    assert len(message) < 400


def test_a_batch_refuses_and_accepts_what_a_scene_file_does():
    lines = [json.dumps(row["scene"]).encode() for row in TABLE]
    for row, answer in zip(TABLE, batch.answers(lines), strict=True):
        refused = answer.get("error")
        assert (refused is None) == row["accepted"], row["name"]
        assert refused is None or row["word"] in refused


def test_a_command_names_the_file_of_a_refused_scene(tmp_path, capsys):
    path = tmp_path / "scene.json"
    row = next(row for row in TABLE if row["name"] == "epoch: leap second")
    path.write_text(json.dumps(row["scene"]))
    assert code_of("collide", path) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert f"{path}: epoch: " in err


def stated(rng, body):
    """Return a body with random errors of the kinds that its motion permits."""

    def number():
        return rng.choice([0, Fraction(1, 3), 2, 0.1, "1e-30", Fraction(10**40, 7)])

    pivots = pivots_of(body.motion)
    angle = number() if len(pivots) < 2 else 0
    point = (number(), -Fraction(number()) / 7)
    return body.with_errors(
        place_error=number(),
        angle_error=angle,
        shape_error=(number(), number()),
        pivot=point if angle and not pivots else None,
    )


@pytest.mark.parametrize("kind", MOTIONS)
def test_random_scenes_with_all_keys_are_read_as_written(kind):
    for seed in range(4):
        rng = random.Random(f"{kind}:{seed}")
        plain = random_scene(kind, "ratios", seed, side=2)
        scene = Scene(
            [stated(rng, body) for body in plain.bodies], plain.time, units=MEASURED, epoch=EPOCH
        )
        data = scene.to_json()
        assert without_new_keys(data) == plain.to_json()
        for same in (
            Scene.from_json(data),
            Scene.from_json(json.loads(json.dumps(data))),
            pickle.loads(pickle.dumps(scene)),
            copy.deepcopy(scene),
            copy.copy(scene),
        ):
            assert same == scene
            assert hash(same) == hash(scene)
            assert same.to_json() == data
            assert [body.reference_point for body in same.bodies] == [
                body.reference_point for body in scene.bodies
            ]


def test_a_scene_without_the_keys_is_written_as_before():
    motion = PosePath([0, 1], [([0, 1], 0, [0, 1])], error="1/100")
    scene = Scene([Body("a", SQUARE, motion), Body("b", [(5, 5)], Spin(1))])
    zero = Scene(
        [body.with_errors(place_error=0, angle_error="0", shape_error=(0, 0.0)) for body in scene],
        units=None,
        epoch=None,
    )
    assert zero == scene
    assert zero.to_json() == scene.to_json() == without_new_keys(scene.to_json())
    assert [*scene.to_json()] == ["exactpt", "time", "bodies"]
    assert "pivot" not in scene.to_json()["bodies"][0]["motion"]["path"]
    assert [*scene.to_json()["bodies"][1]["motion"]["spin"]] == ["omega", "error"]


@pytest.mark.parametrize(
    "change",
    [
        {"place_error": "1/7"},
        {"angle_error": "1/7", "pivot": (1, 1)},
        {"angle_error": "1/8", "pivot": (0, 0)},
        {"shape_error": ("1/7", 0)},
        {"shape_error": (0, "1/7")},
    ],
)
def test_bodies_of_different_errors_are_different(change):
    base = Body("a", SQUARE, angle_error="1/7", pivot=(0, 0))
    assert base.with_errors(**change) != base
    assert base.with_errors(angle_error="1/7", pivot=(0, 0)) == base


def test_scenes_of_different_units_or_epochs_are_different():
    bodies = [Body("a", SQUARE)]
    one = Scene(bodies, units=MEASURED, epoch=EPOCH)
    assert one != Scene(bodies, units=MEASURED)
    assert one != Scene(bodies, units={"time": "s"}, epoch=EPOCH)
    assert one != Scene(bodies)
    assert one == Scene(bodies, units=Units(length="mm", time="s"), epoch=EPOCH)


def test_units_and_the_epoch_are_kept_by_scenes_made_of_a_scene():
    motion = Pieces([(2, Translation([0, 1])), (None, Translation(2))])
    scene = Scene([Body("a", SQUARE, motion)], (0, 9), units=MEASURED, epoch=EPOCH)
    made = [
        scene.until(5),
        scene.since(3),
        scene.until(5).since(1),
        scene.going_on(scene.bodies, scene.exact_start),
        Scene.from_arrays(SQUARE, [0, 4], units=scene.units, epoch=scene.epoch),
    ]
    for other in made:
        assert (other.units, other.epoch) == (Units(length="mm", time="s"), EPOCH)
    assert scene.units.length == "mm"
    assert Scene.from_arrays(SQUARE, [0, 4]).units is None


@pytest.mark.parametrize(
    "measures, words",
    [
        ({"units": 5}, "units: not a mapping"),
        ({"units": "mm"}, "units: not a mapping"),
        ({"units": {}}, "units: a length or a time is needed"),
        ({"units": {"mass": "kg"}}, "units: .* got 'mass'"),
        ({"units": {"length": None}}, "units: length: .* got None"),
        ({"units": {"length": "m" * 33}}, "units: length"),
        ({"units": {"length": b"mm"}}, "units: length"),
        ({"epoch": EPOCH}, "epoch: it needs a unit of time"),
        ({"units": {"time": "s"}, "epoch": 5}, "epoch: not a date"),
        ({"units": {"time": "s"}, "epoch": "today"}, "epoch: not a date .* 'today'"),
    ],
)
def test_units_and_epochs_that_are_none_are_refused(measures, words):
    for make in (Scene, lambda _, **given: Scene.from_arrays(SQUARE, [0, 4], **given)):
        with pytest.raises(InputError, match=words):
            make([Body("a", SQUARE)], **measures)


def test_units_of_neither_length_nor_time_are_refused():
    with pytest.raises(InputError, match="a length or a time is needed"):
        Units()
    with pytest.raises(InputError, match="units: time"):
        Units("mm", "")


def test_the_fast_reader_of_batches_leaves_the_keys_to_the_reader_of_scenes():
    moving = {"name": "a", "vertices": [[0, 0], [1, 0], [0, 1]], "motion": {"x": [0, 1]}}
    resting = {"name": "b", "vertices": [[5, 0], [6, 0], [5, 1]]}
    plain = {"exactpt": 1, "time": [0, 9], "bodies": [moving, resting]}
    stated_body = {**moving, "place_error": 1, "angle_error": "1/2", "pivot": [0, 0]}
    lines = [
        plain,
        {**plain, "bodies": [stated_body, resting]},
        {**plain, "units": MEASURED, "epoch": EPOCH},
        {**plain, "bodies": [{**moving, "place_error": -1}, resting]},
    ]
    first, *same, refused = batch.answers([json.dumps(line).encode() for line in lines])
    assert first["contact"]["time"]["low"] == "4"
    assert same == [first, first]
    assert "place_error" in refused["error"]
    assert first_contact(Scene.from_json(lines[1])).time == 4


def test_a_reader_of_an_angle_error_takes_the_pivot_of_the_motion():
    spin = Spin(1, (2, 3), error="1/100")
    path = PosePath([0, 1], [(0, 0, [0, 1])], error="1/100", pivot=(4, 5))
    turn = Rigid([0, 1], pivot=(6, 7))
    pieces = Pieces([(1, Translation()), (None, Rigid(0, pivot=(8, 9)))])
    for motion, point in ((spin, (2, 3)), (path, (4, 5)), (turn, (6, 7)), (pieces, (8, 9))):
        body = Body("a", SQUARE, motion, angle_error="1/9")
        again = Scene.from_json(Scene([body]).to_json()).bodies[0]
        for one in (body, again):
            assert one.reference_point == point
            assert one.pivot is None
    assert spin.pivot == (2, 3)
