"""Values of any length in any argument: a refusal is one short line that shows a part of them."""

import json

import pytest
from folding import every
from public_calls import World, command

import exactpt
import exactpt.testing
from exactpt.brief import LONGEST

pytestmark = pytest.mark.long

LONG = "N" * 20_000
SHAPE = [(0, 0), (1, 0), (0, 1)]


def scene_of(body):
    """Return the scene with one body of JSON."""
    return exactpt.Scene.from_json({"exactpt": 1, "time": [0, 1], "bodies": [body]})


DOORS = {
    "a body twice": lambda w: exactpt.Scene([w.moving, w.moving], time=(0, 1)),
    "a body that is missing": lambda w: w.scene.body("x" + LONG),
    "a jump": lambda _: exactpt.Body(
        LONG,
        SHAPE,
        exactpt.Pieces([(1, exactpt.Translation([0])), (None, exactpt.Translation([9]))]),
    ),
    "a vertex of three numbers": lambda _: exactpt.Body(LONG, [(0, 0, 0)]),
    "a coordinate": lambda _: exactpt.Body(LONG, [(0, LONG)]),
    "radius": lambda _: exactpt.Body(LONG, SHAPE, radius=LONG),
    "a name that is no text": lambda _: exactpt.Body(LONG + "\ud800", SHAPE),
    "bodies that touch at the start": lambda w: (
        exactpt.Simulation(
            exactpt.Scene([w.moving, exactpt.Body(LONG + "2", SHAPE)], time=(0, 1))
        ).tiling
    ),
    "another body that is missing": lambda w: exactpt.clearance(w.scene, LONG, "x" + LONG),
    "dist": lambda w: exactpt.distance(w.scene, "x" + LONG, "b", at=0),
    "dist same": lambda w: exactpt.distance(w.scene, LONG, LONG, at=0),
    "within": lambda w: exactpt.first_within(w.scene, "x" + LONG, "b", 1),
    "ignoring": lambda w: exactpt.first_contact(w.scene, ignoring=[[LONG, "y" + LONG]]),
    "ign text": lambda w: exactpt.first_contact(w.scene, ignoring=LONG),
    "between": lambda w: exactpt.first_contact(w.scene, between=[[LONG, "y" + LONG]]),
    "between1": lambda w: exactpt.first_contact(w.scene, between=[[LONG]]),
    "between same": lambda w: exactpt.first_contact(w.scene, between=[[LONG, LONG]]),
    "method": lambda w: exactpt.first_contact(w.scene, method=LONG),
    "tiling2": lambda w: exactpt.first_contact(w.scene, tiling=LONG),
    "since": lambda w: w.scene.since(LONG),
    "at": lambda w: w.scene.at(LONG),
    "time": lambda w: exactpt.Scene([w.moving], time=(LONG, 1)),
    "time3": lambda w: exactpt.Scene([w.moving], time=LONG),
    "sim set": lambda w: exactpt.Simulation(w.scene).set_motion("x" + LONG, exactpt.Translation()),
    "sim jump": lambda w: exactpt.Simulation(w.scene).set_motion(LONG, exactpt.Translation([3])),
    "sim add": lambda w: exactpt.Simulation(w.scene).add(exactpt.Body("c", SHAPE)),
    "sim add2": lambda w: exactpt.Simulation(w.scene).add(w.moving),
    "sim rm": lambda w: exactpt.Simulation(w.scene).remove("x" + LONG),
    "locate": lambda w: exactpt.Simulation(w.scene).locate((LONG, 0)),
    "short": lambda w: exactpt.Simulation(w.scene).shorten([(9, 9), ("1/9", "1/9"), (8, 8)]),
    "relh2": lambda w: exactpt.Simulation(w.scene).relative_hull("x" + LONG),
    "bounce": lambda w: list(
        exactpt.Simulation(w.scene).run(on_contact=exactpt.Bounce(fixed=["x" + LONG]))
    ),
    "bounce2": lambda _: exactpt.Bounce(fixed=LONG),
    "bounce3": lambda _: exactpt.Bounce(masses={LONG: LONG}),
    "bounce4": lambda _: exactpt.Bounce(restitution=LONG),
    "a coordinate of JSON": lambda _: scene_of({"name": LONG, "vertices": [[0, LONG]]}),
    "a key of a body": lambda _: scene_of({"name": LONG, LONG: 1}),
    "a key of a scene": lambda _: exactpt.Scene.from_json({LONG: 1}),
    "a version": lambda _: exactpt.Scene.from_json({"exactpt": LONG, "time": [0, 1], "bodies": []}),
    "a key of a motion": lambda _: scene_of(
        {"name": LONG, "vertices": [[0, 0]], "motion": {LONG: LONG}}
    ),
    "a body of JSON": lambda _: scene_of(LONG),
    "a name of JSON": lambda _: scene_of({"name": [LONG] * 5, "vertices": [[0, 0]]}),
    "keyframes of JSON": lambda _: scene_of(
        {
            "name": LONG,
            "vertices": [[0, 0], [1, 0], [0, 1]],
            "keyframes": [{"t": 0, "vertices": [[0, 0]]}, {"t": 1, "vertices": [[0, 0], [1, 1]]}],
        }
    ),
    "props save": lambda _: exactpt.Scene(
        [exactpt.Body(LONG, SHAPE, properties={"k": {1, 2}})], time=(0, 1)
    ).to_json(),
    "poly": lambda _: exactpt.Polynomial([LONG]),
    "alg": lambda _: exactpt.AlgebraicNumber(LONG),
    "rigid": lambda _: exactpt.Rigid(LONG),
    "rig2": lambda _: exactpt.Rigid([0], pivot=LONG),
    "aff": lambda _: exactpt.Affine(LONG),
    "aff2": lambda _: exactpt.Affine([[LONG, 0], [0, 0]]),
    "pieces": lambda _: exactpt.Pieces([(LONG, exactpt.Translation())]),
    "pieces2": lambda _: exactpt.Pieces([(1, LONG), (None, LONG)]),
    "spin": lambda _: exactpt.Spin(LONG),
    "pose": lambda _: exactpt.PosePath([0, LONG], [([0], [0], [0])]),
    "pose2": lambda _: exactpt.PosePath([0, 1], [(LONG, LONG)]),
    "a date": lambda _: exactpt.from_datetime(LONG),
    "write": lambda w: exactpt.write_shapes(w.scene, w.folder / ("x." + "y" * 100), at=0),
    "a time to write": lambda w: exactpt.write_shapes(w.scene, w.folder / "a.svg", at=LONG),
    "planner": lambda w: exactpt.Planner([w.moving, w.moving]),
    "planner2": lambda w: exactpt.Planner([w.standing]).first_contact(LONG, exactpt.Translation()),
    "local": lambda _: exactpt.in_local_time(LONG),
    "spline": lambda _: exactpt.spline(LONG),
    "an index of arrays": lambda _: exactpt.arrays.first_contacts([[0, 0]], [0, 1], [(0, LONG)]),
    "a choice of arrays": lambda _: exactpt.arrays.first_contacts(
        [[0, 0]] * 4, [0, 2, 4], [(0, 1)], errors=LONG
    ),
    "an index out of range": lambda _: exactpt.arrays.first_contacts(
        [[0, 0]] * 4, [0, 2, 4], [(0, 7)]
    ),
    "batch2": lambda _: exactpt.batch.Options(method=LONG),
    "a family": lambda _: exactpt.testing.make_question(LONG, 1, 1),
    "features": lambda w: exactpt.to_features(w.scene, LONG),
    "restore": lambda _: exactpt.Simulation.restore("scene.json"),
    "onward": lambda w: exactpt.onward(w.moving, 0, (LONG, 0)),
    "with_motion": lambda w: w.moving.with_motion(LONG),
}
"""Calls that are refused, each with a long name, text or key."""

COMMANDS = [
    ["collide", "scene.json"], ["collide", "scene.json", "--all"],
    ["collide", "scene.json", "--enclosed"], ["collide", "scene.json", "--ignore", LONG],
    ["collide", "scene.json", "--between", f"{LONG},w"], ["collide", "scene.json", "--until", LONG],
    ["collide", LONG[:3000]], ["collide", "scene.json", "--tiling", LONG],
    ["simulate", "scene.json"], ["generate", LONG], ["check", "scene.json"], [LONG],
    ["collide", "wrong.json"], ["batch", "wrong.jsonl", "-o", "out.jsonl"], ["judge", "wrong.json"],
    ["convert", "wrong.wkt", "out.json"], ["convert", "wrong.geojson", "out.json"],
]  # fmt: skip


@pytest.fixture
def world(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    world = World(tmp_path, mover=LONG, wall="b")
    world.file()
    body = {"name": LONG, "vertices": [["0", LONG]]}
    text = json.dumps({"exactpt": 1, "time": ["0", "1"], "bodies": [body]})
    (tmp_path / "wrong.json").write_text(text)
    (tmp_path / "wrong.jsonl").write_text(f"{text}\n")
    (tmp_path / "wrong.wkt").write_text(f"{LONG} (0 0)")
    geometry = {"type": LONG, "coordinates": []}
    feature = {"type": "Feature", "properties": {"name": LONG}, "geometry": geometry}
    features = {"type": "FeatureCollection", "features": [feature]}
    (tmp_path / "wrong.geojson").write_text(json.dumps(features))
    return world


@every("name", DOORS)
def test_a_refusal_shows_a_part_of_a_long_value(name, world):
    with pytest.raises(Exception) as refusal:  # noqa: PT011 - each kind
        DOORS[name](world)

    message = str(refusal.value)
    assert max(map(len, message.split(" "))) <= LONGEST + 20, message[:500]
    assert len(message) <= 4 * LONGEST
    assert message.isprintable()


@every("arguments", COMMANDS)
def test_a_command_shows_a_part_of_a_long_value(arguments, world):
    _, out, err = command(*arguments)

    for line in (out + err).splitlines():
        assert max(map(len, line.split(" "))) <= LONGEST + 20, line[:500]
        assert len(line) <= 4 * LONGEST
