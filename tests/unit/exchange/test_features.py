"""Properties of features, answers as features, dates, and shapes at irrational times."""

import functools
import json
import math
import pickle
from datetime import UTC, datetime, timedelta, timezone
from fractions import Fraction

import pytest

import exactpt
from exactpt import Body, InputError, Scene, Translation, Velocity

SHIP = {"name": "Mary", "mmsi": 211000000, "length": 12.5, "flags": ["a", None], "ok": True}


def feature(properties, coordinates=(0, 0)):
    geometry = {"type": "Point", "coordinates": list(coordinates)}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def collection(tmp_path, *features, name="in.geojson"):
    path = tmp_path / name
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


def test_properties_of_features_come_back(tmp_path):
    path = collection(tmp_path, feature(SHIP), feature({"name": "Mary", "cat": 2}, (5, 5)))

    scene = exactpt.read_shapes(path)
    exactpt.write_shapes(scene, tmp_path / "out.geojson")

    first, second = scene.bodies
    assert first.properties == SHIP
    assert (second.name, second.properties["cat"]) == ("Mary 2", 2)
    written = json.loads((tmp_path / "out.geojson").read_text())["features"]
    assert [f["properties"] for f in written] == [SHIP, {"name": "Mary 2", "cat": 2}]


def test_properties_are_in_scene_files(tmp_path):
    data = {**SHIP, "of": [{"a": [True, None, 1.5, -3]}, ""], "vertices": 5}
    pentagon = [(0, 0), (4, 0), (4, 4), (0, 4)]
    bodies = [
        Body("chain", [(9, 9), (9, 8), (8, 8)], closed=False, properties=data),
        Body("keyed", keyframes=[(0, [(0, 9)]), (1, [(1, 9)])], properties=data),
        Body("holed", pentagon, holes=[[(1, 1), (1, 2), (2, 1)]], properties=data),
        Body(
            "two", parts=[[(20, 0), (21, 0), (20, 1)], [(22, 0), (23, 0), (22, 1)]], properties=data
        ),
        Body("none", [(30, 0)]),
    ]
    scene = Scene(bodies, time=(0, 9))
    scene.save(tmp_path / "scene.json")

    again = Scene.load(tmp_path / "scene.json")
    assert again == scene
    assert [body.properties for body in again.bodies] == [data] * 4 + [{}]
    assert "properties" not in again.to_json()["bodies"][4]
    assert exactpt.first_contact(again) is None
    exactpt.write_shapes(again, tmp_path / "map.geojson", at=0)
    kept = exactpt.read_shapes(tmp_path / "map.geojson").bodies
    assert [body.properties.get("mmsi") for body in kept[:3]] == [SHIP["mmsi"]] * 3


@pytest.mark.parametrize(
    "value", [float("nan"), {1, 2}, "\ud800", functools.reduce(lambda a, _: [a], range(29), 1)]
)
def test_properties_that_scene_files_do_not_have(value):
    scene = Scene([Body("a", [(0, 0)], properties={"x": value})], time=(0, 1))
    with pytest.raises(InputError, match=r"^body 'a': properties: [^\n]+$"):
        scene.to_json()


def test_properties_follow_copies_and_have_no_part_in_equality():
    ship = Body("Mary", [(0, 0)], properties=SHIP)

    copies = [
        ship.with_motion(Velocity(1, 0)), ship.with_radius(2), ship.halted(3),
        pickle.loads(pickle.dumps(ship)),
    ]  # fmt: skip
    assert [copy.properties for copy in copies] == [SHIP] * 4
    assert ship == Body("Mary", [(0, 0)])
    assert Body("b", [(0, 0)]).properties == {}
    ship.properties["mmsi"] = 1
    assert ship.properties == SHIP


MOVING = {
    "type": "Feature",
    "properties": SHIP,
    "temporalGeometry": {
        "type": "MovingPoint",
        "datetimes": ["2026-09-01T00:00:00Z", "2026-09-01T01:00:00Z"],
        "coordinates": [[0, 0], [1, 0]],
        "interpolation": "Linear",
    },
}


def test_moving_features_have_properties_and_dates(tmp_path):
    path = collection(tmp_path, MOVING, name="in.mfjson")
    span = datetime(2026, 9, 1, tzinfo=UTC), datetime(2026, 9, 1, 0, 30, tzinfo=UTC)

    scene = exactpt.read_shapes(path, time=span)
    exactpt.write_shapes(scene, tmp_path / "out.mfjson")

    assert [exactpt.to_datetime(t) for t in (scene.start, scene.end)] == list(span)
    (written,) = json.loads((tmp_path / "out.mfjson").read_text())["features"]
    assert written["properties"] == SHIP
    assert written["temporalGeometry"]["datetimes"][1] == "2026-09-01T00:30:00Z"


def test_answers_as_features():
    storm = Body("storm", [(3, -1), (4, -1), (4, 1), (3, 1)], properties={"cat": 4})
    ship = Body("ship", [(0, 0)], Translation([0, 0, "1/2"]), properties={"mmsi": 7})
    scene = Scene([ship, storm], time=(0, 9))

    found = exactpt.to_features(scene, exactpt.contacts(scene))
    (one,) = found["features"]
    start = 6**0.5
    assert one["properties"] == {
        "a": "ship", "b": "storm", "start": start, "end": 8**0.5, "a_mmsi": 7, "b_cat": 4,
    }  # fmt: skip
    assert one["geometry"] == {"type": "Point", "coordinates": (3.0, 0.0)}
    json.dumps(found)
    dated = exactpt.to_features(scene, exactpt.contacts(scene), geometry="b", dates=True)
    assert dated["features"][0]["properties"]["start"] == "1970-01-01T00:00:02.449490Z"
    assert dated["features"][0]["geometry"]["type"] == "Polygon"

    (near,) = exactpt.to_features(scene, exactpt.clearance(scene, "ship").below(1))["features"]
    assert near["properties"]["start"] == 2.0
    contact = exactpt.first_contact(scene)
    (touch,) = exactpt.to_features(scene, [contact])["features"]
    assert touch["geometry"] == {"type": "Point", "coordinates": [3.0, 0.0]}
    assert touch["properties"]["kind"] == "vertex-edge"
    with pytest.raises(InputError, match="neither an interval nor a contact: 3"):
        exactpt.to_features(scene, [3])
    with pytest.raises(InputError, match="either a or b: 'c'"):
        exactpt.to_features(scene, [], geometry="c")


def test_overlaps_at_the_start_have_no_geometry():
    scene = Scene([Body("a", [(0, 0), (4, 0), (0, 4)]), Body("b", [(1, 1)])], time=(0, 1))

    (found,) = exactpt.to_features(scene, [exactpt.first_contact(scene)])["features"]

    assert (found["properties"]["kind"], found["geometry"]) == ("initial", None)


def test_dates_there_and_back():
    east = datetime(2026, 9, 1, 14, 0, 0, 250000, tzinfo=timezone(timedelta(hours=2)))

    seconds = exactpt.from_datetime(east)
    assert seconds == exactpt.from_datetime("2026-09-01T12:00:00.25Z")
    assert exactpt.to_datetime(seconds) == east
    assert exactpt.from_datetime(datetime(1969, 12, 31, 23, 59, 59)) == -1
    root = exactpt.AlgebraicNumber.root([-2, 0, 1], 1, 2)
    assert exactpt.to_datetime(root).isoformat() == "1970-01-01T00:00:01.414214+00:00"
    with pytest.raises(InputError, match="not a date with a time: 3"):
        exactpt.from_datetime(3)
    for far in (10**15, -(10**10000)):
        with pytest.raises(InputError, match="a year from 1 to 9999"):
            exactpt.to_datetime(far)


def test_shapes_at_an_irrational_time(tmp_path):
    falling = Body("b", [(0, 0), (1, 0), (0, 1)], Translation([0], [0, 0, 1]))
    floor = Body("floor", [(-9, 2), (9, 2)])
    scene = Scene([falling, floor], time=(0, 9))
    time = exactpt.first_contact(scene).time  # 1
    late = exactpt.AlgebraicNumber.root([-2, 0, 1], 1, 2)

    assert time == 1
    exactpt.write_shapes(scene, tmp_path / "then.geojson", at=late)
    data = json.loads((tmp_path / "then.geojson").read_text())["features"][0]
    assert data["geometry"]["coordinates"][0][0] == [0.0, 2.0]
    shapely = pytest.importorskip("shapely")
    assert shapely.get_coordinates(scene.to_shapely(late)["b"])[0].tolist() == [0.0, 2.0]
    with pytest.raises(InputError, match=r"t = 9\.055"):
        scene.to_shapely(exactpt.AlgebraicNumber.root([-82, 0, 1], 9, 10))
    with pytest.raises(InputError, match="outside the time span"):
        scene.to_shapely(Fraction(10))


def test_a_number_beyond_doubles_stays_a_text(tmp_path):
    path, copy = tmp_path / "a.geojson", tmp_path / "b.geojson"
    long = "9" * 5000
    path.write_text(json.dumps(feature({"name": "a", "x": 0})).replace("0}", f"[-1e400, {long}]}}"))

    exactpt.write_shapes(exactpt.read_shapes(path), copy)

    assert exactpt.read_shapes(copy).bodies[0].properties == {"name": "a", "x": ["-1e400", long]}


@pytest.mark.parametrize("value", [math.inf, {1, 2}, object()])
def test_properties_that_json_does_not_have(tmp_path, value):
    for name in ("a.geojson", "a.mfjson"):
        with pytest.raises(InputError, match=rf"{name}: body 'a': properties: [^\n]+$"):
            exactpt.write_shapes(
                Scene([Body("a", [(0, 0)], properties={"x": value})]), tmp_path / name
            )


@pytest.mark.parametrize("properties", [5, [("x", 1)], {1: 2}])
def test_properties_that_are_not_a_mapping_of_texts(properties):
    with pytest.raises(InputError, match=r"^body 'a': properties: not a mapping of texts to data$"):
        Body("a", [(0, 0)], properties=properties)


def test_a_time_that_is_not_a_span(tmp_path):
    with pytest.raises(InputError, match=r"^time: not a list: 5$"):
        exactpt.read_shapes(tmp_path / "a.geojson", time=5)


def test_one_contact_is_not_a_list_of_answers():
    scene = Scene([Body("a", [(0, 0)]), Body("b", [(0, 0)])])
    with pytest.raises(InputError, match=r"^answers: not a list: [^\n]+$"):
        exactpt.to_features(scene, exactpt.first_contact(scene))
