"""MF-JSON: moving features become scenes and come back, dates are exact, the rest is refused."""

import json
from fractions import Fraction

import pytest
from commands import code_of
from folding import every
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, Pieces, Rigid, Scene, Translation, first_contact
from exactpt.errors import InputError
from exactpt.exchange.files import read_shapes, write_shapes
from exactpt.exchange.instants import instant_of, seconds_of
from exactpt.kernel.numbers import QQ
from exactpt.motion.motions import REST
from exactpt.scene.json_values import Number

DATES = ["2000-01-01T00:00:00Z", "2000-01-01T00:00:10Z"]
START = 946_684_800
CHAIN = [[0, 0], [1, 1], [2, 0]]


def feature(name="a", kind="MovingPoint", coordinates=((0, 0), (10, 0)), dates=DATES, **more):
    geometry = {"type": kind, "coordinates": coordinates, "datetimes": list(dates), **more}
    return {"type": "Feature", "properties": {"name": name}, "temporalGeometry": geometry}


def read(tmp_path, data, **options):
    path = tmp_path / "in.mfjson"
    path.write_text(data if isinstance(data, str) else json.dumps(data))
    return read_shapes(path, **options)


def collection(*features):
    return {"type": "FeatureCollection", "features": list(features)}


@every(
    "text, seconds",
    [
        ("1970-01-01T00:00:00Z", 0),
        ("2000-01-01T00:00:00+00", START),
        ("2000-01-01T01:00:00+01", START),
        ("2000-01-01T05:30:00+05:30", START),
        ("1999-12-31T20:30:00-0330", START),
        ("2000-01-01 00:00:00", START),
        ("2000-01-01t00:00:00.1z", Fraction(10 * START + 1, 10)),
        ("1969-12-31T23:59:59.999999999999Z", Fraction(-1, 10**12)),
        ("2016-02-29T12:00:00Z", 1_456_747_200),
        (Number("1500"), Fraction(3, 2)),
    ],
)
def test_dates_are_exact_seconds(text, seconds):
    assert seconds_of(text, "here") == seconds


@every(
    "text",
    ["2000-01-01", "2000-13-01T00:00:00Z", "2000-01-01T00:00:60Z", "2001-02-29T00:00:00Z",
     "2000-01-01T00:00:00+24", "2000-01-01T00:00:00+01:60", "now", "", None, True, ["1"]],
)  # fmt: skip
def test_what_is_no_date_is_refused(text):
    with pytest.raises(InputError, match="here: not a date with a time"):
        seconds_of(text, "here")


@given(st.integers(-(10**13), 10**14), st.integers(0, 3), st.integers(0, 3))
def test_dates_come_back(number, twos, fives):
    seconds = QQ(number, 1000 * 2**twos * 5**fives)

    assert seconds_of(instant_of(seconds), "") == seconds


@pytest.mark.parametrize(
    "seconds, says",
    [(QQ(1, 3), "needs a decimal number of seconds, got '1/3'"), (QQ(10**12), "from 1 to 9999")],
)
def test_what_is_no_date_is_not_written(seconds, says):
    with pytest.raises(InputError, match=says):
        instant_of(seconds)


def test_points_and_polygons_move_and_touch(tmp_path):
    ring = [[20, -1], [22, -1], [22, 1], [20, 1], [20, -1]]
    moved = [[x - 5, y] for x, y in ring]
    scene = read(
        tmp_path,
        collection(
            feature("dot", interpolation="Linear"),
            feature("box", "MovingPolygon", [[ring], [moved]], interpolations=["Linear"]),
        ),
    )

    assert (scene.start, scene.end) == (START, START + 10)
    assert [body.name for body in scene.bodies] == ["dot", "box"]
    assert isinstance(scene.bodies[1].motion, Translation)
    box = feature("box", "MovingPolygon", [[ring], [moved]])
    later = read(tmp_path, collection(feature("dot", coordinates=[[0, 0], [30, 0]]), box))
    assert first_contact(scene) is None
    assert first_contact(later).time == START + Fraction(20 * 10, 35)


def test_pieces_and_lines_that_deform(tmp_path):
    dates = [*DATES, "2000-01-01T00:00:20.5Z"]
    scene = read(
        tmp_path,
        collection(
            feature("p", coordinates=[[0, 0], [1, 0.1], [1, 5]], dates=dates),
            feature("l", "MovingLineString", [[[0, 9], [1, 9]]] * 2 + [[[0, 9], [3, 9]]], dates),
        ),
    )

    p, line = scene.bodies
    assert p.at(START + 5) == [(Fraction(1, 2), Fraction(1, 20))]
    assert p.at(START + Fraction(61, 4)) == [(1, Fraction(51, 20))]
    assert line.keyframes
    assert line.at(START + Fraction(61, 4)) == [(0, 9), (2, 9)]


def test_what_mobilitydb_writes(tmp_path):
    """asMFJSON of a tgeompoint, of one with one sequence, and of a trgeometry."""
    head = '{"type":"MovingPoint","crs":{"type":"Name","properties":{"name":"EPSG:4326"}},'
    times = '"datetimes":["2000-01-01T00:00:00+00","2000-01-01T00:00:10+00"],'
    ends = '"lower_inc":true,"upper_inc":true'
    point = head + '"coordinates":[[1,1],[2,2]],' + times + ends + ',"interpolation":"Linear"}'
    several = (
        head + '"sequences":[{"coordinates":[[1,1],[2,2]],' + times + ends + "}],"
        '"interpolation":"Linear"}'
    )
    rigid = (
        '{"type":"MovingRigidGeometry","geometry":{"type":"Polygon",'
        '"coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]},'
        '"values":[{"position":{"lat":0,"lon":0},"rotation":0},'
        '{"position":{"lat":0.5,"lon":2},"rotation":0}],'
        + times
        + ends
        + ',"interpolation":"Linear"}'
    )

    for text in (point, several):
        (body,) = read(tmp_path, text).bodies
        assert body.at(START + 5) == [(Fraction(3, 2), Fraction(3, 2))]
    (box,) = read(tmp_path, rigid).bodies
    assert isinstance(box.motion, Translation)
    assert box.at(START + 10)[0] == (2, Fraction(1, 2))
    with pytest.raises(InputError, match=r"value 1: it turns, by an angle whose cosine is not rat"):
        read(tmp_path, rigid.replace('2},"rotation":0', '2},"rotation":0.5'))


@pytest.mark.parametrize(
    "changed, says",
    [
        ({"interpolation": "Discrete"}, "moves by linear interpolation, not 'Discrete'"),
        ({"interpolation": "Step"}, "linear interpolation, not 'Step'"),
        ({"interpolations": ["Linear", "Quadratic"]}, "linear interpolation, not"),
        ({"dates": DATES[::-1]}, "datetimes do not increase"),
        ({"dates": DATES[:1]}, "expected at least two timestamps"),
        ({"dates": [DATES[0], "noon"]}, "datetime 1: not a date with a time: 'noon'"),
        ({"coordinates": [[0, 0]]}, "2 datetimes for 1 positions"),
        ({"coordinates": [[0, 0], [1]]}, "position 1: not a position"),
        ({"kind": "MovingPointCloud"}, "not one of MovingPoint, MovingLineString"),
        ({"sequences": [{}, {}]}, "2 sequences: a body is there without a gap"),
        (
            {"kind": "MovingLineString", "coordinates": [CHAIN[:2], CHAIN]},
            "position 1: 3 vertices, after 2",
        ),
        ({"kind": "MovingPolygon", "coordinates": [[CHAIN[:2]]] * 2}, "polygon 'a' has no area"),
        (
            {"kind": "MovingPolygon", "coordinates": [[[[0, 0], [2, 2], [2, 0], [0, 1]]]] * 2},
            "mend it, or leave it out",
        ),
    ],
)  # fmt: skip
def test_what_is_no_body_is_refused_in_one_line(tmp_path, changed, says):
    wrong = collection(feature("b"), feature(**changed))

    with pytest.raises(InputError) as refused:
        read(tmp_path, wrong)
    left_out = []
    scene = read(tmp_path, wrong, skipped=left_out.append)

    assert says in str(refused.value)
    assert str(refused.value).startswith(f"{tmp_path / 'in.mfjson'}: feature 1")
    assert "\n" not in str(refused.value)
    assert [body.name for body in scene.bodies] == ["b"]
    assert len(left_out) == 1


def test_features_need_one_time_span(tmp_path):
    other = feature("b", coordinates=[[0, 5], [1, 5]], dates=[DATES[0], "2000-01-01T00:00:20Z"])
    both = collection(feature(), other)

    with pytest.raises(
        InputError, match=r"feature 1 \(b\): it moves from t = 946684800 to 946684820"
    ):
        read(tmp_path, both)
    with pytest.raises(InputError, match=r"feature 0 \(a\): it moves from"):
        read(tmp_path, both, time=(START, START + 11))
    scene = read(tmp_path, both, time=(START + 1, START + 10))
    assert (scene.start, scene.end) == (START + 1, START + 10)


def scene_of_everything():
    hop = Pieces([("5/2", Translation([0, 1])), (None, Translation(["5/4", "1/2"]))])
    return Scene(
        [
            Body("rest", [(0, 0), (2, 0), (0, 2)]),
            Body("hop", [(50, 50)], hop),
            Body(
                "wire", [(0, 90), (3, 91), (6, 90)], Translation([0, "0.5"], [0, -1]), closed=False
            ),
            Body("grows", [{"x": [20, 1], "y": [0]}, {"x": [30], "y": [0]}, (25, 5)]),
        ],
        time=(0, 8),
    )


@pytest.mark.parametrize("suffix", [".mfjson", ".json", ".geojson"])
def test_scenes_come_back(tmp_path, suffix):
    scene = scene_of_everything()
    write_shapes(scene, tmp_path / "out.mfjson")
    (tmp_path / f"in{suffix}").write_text((tmp_path / "out.mfjson").read_text())

    back = read_shapes(tmp_path / f"in{suffix}")

    assert (back.start, back.end) == (scene.start, scene.end)
    for old, new in zip(scene.bodies, back.bodies, strict=True):
        assert (old.name, old.closed) == (new.name, new.closed)
        for t in (0, Fraction(7, 3), Fraction(5, 2), Fraction(29, 7), 8):
            assert old.at(t) == new.at(t)
    assert back.bodies[0].motion is REST
    written = json.loads((tmp_path / "out.mfjson").read_text())["features"]
    assert [f["temporalGeometry"]["type"] for f in written] == [
        "MovingPolygon", "MovingPoint", "MovingLineString", "MovingPolygon",
    ]  # fmt: skip
    assert written[1]["temporalGeometry"]["datetimes"] == [
        "1970-01-01T00:00:00Z", "1970-01-01T00:00:02.5Z", "1970-01-01T00:00:08Z",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "body, says",
    [
        (Body("b", [(0, 0), (1, 0)], Rigid([0, 1])), "do not move straight from t = 0 on"),
        (Body("b", [(0, 0)], Translation([0, 0, 1])), "do not move straight from t = 0 on"),
        (Body("b", [(0, 0)], radius=1), "have no radius: write a scene"),
        (
            Body(
                "b", [(0, 0)], Pieces([("1/3", Translation([0, 1])), (None, Translation(["1/3"]))])
            ),
            "needs a decimal number of seconds, got '1/3'",
        ),
    ],
)
def test_what_moving_features_cannot_say_is_not_written(tmp_path, body, says):
    with pytest.raises(InputError, match=f"body 'b': .*{says}"):
        write_shapes(Scene([body], time=(0, 8)), tmp_path / "out.mfjson")

    assert list(tmp_path.iterdir()) == []


def test_convert_goes_both_ways(tmp_path, capsys):
    there, scene, back = (tmp_path / name for name in ("in.mfjson", "scene.json", "back.mfjson"))
    there.write_text(json.dumps(collection(feature())))

    for arguments in ((there, scene), (scene, back), (there, scene, "--time", START, START + 3)):
        assert code_of("convert", *arguments) == 0

    assert json.loads(back.read_text()) == collection(
        {**feature(), "temporalGeometry": {**feature()["temporalGeometry"],
                                           "coordinates": [[0.0, 0.0], [10.0, 0.0]],
                                           "interpolation": "Linear"}}
    )  # fmt: skip
    assert json.loads(scene.read_text())["time"] == [str(START), str(START + 3)]
    code_of("convert", scene, back, "--at", "0")
    assert "moving features have all times" in capsys.readouterr().err


# The encoding Trajectory, and members that are read, lost or refused


def trajectory(name="a", places=((0, 0), (2, 2), (0, 2)), seconds=(0, 5, 9), **members):
    dates = [f"1970-01-01T00:00:0{second}Z" for second in seconds]
    return {
        "type": "Feature",
        "id": name,
        "geometry": {"type": "LineString", "coordinates": [list(place) for place in places]},
        "properties": {"datetimes": dates, "state": ["walking", "running"]},
        **members,
    }


@pytest.mark.parametrize("suffix", ["mfjson", "json", "geojson"])
def test_a_trajectory_is_a_point_that_moves(tmp_path, suffix):
    """A is at (2t/5, 2t/5) up to 5, then at (2 - (t - 5)/2, 2); B at (2t/9, 2 - 2t/9).

    y agrees at t = 45/14 alone, where x is 9/7 and 5/7: no contact. If C goes there in time, it
    meets A at 5/2, which is at (1, 1).
    """
    path = tmp_path / f"in.{suffix}"
    others = trajectory("B", [(0, 2), (2, 0)], (0, 9)), trajectory("C", [(1, 1), (1, 1.5)], (0, 9))
    path.write_text(json.dumps(collection(trajectory("A"), others[0])))
    scene = read_shapes(path)

    assert [body.name for body in scene.bodies] == ["A", "B"]
    assert scene.time == (0, 9)
    assert scene.at(7) == {"A": [(1, 2)], "B": [(Fraction(14, 9), Fraction(4, 9))]}
    assert first_contact(scene) is None
    assert scene.bodies[0].properties["state"] == ["walking", "running"]
    path.write_text(
        json.dumps(collection(trajectory("A"), trajectory("C", [(1, 1), (1, 1)], (0, 9))))
    )
    assert first_contact(read_shapes(path)).time == Fraction(5, 2)


def test_a_trajectory_comes_back_as_a_moving_point(tmp_path):
    scene = read(tmp_path, collection(trajectory("A")))
    write_shapes(scene, tmp_path / "out.mfjson")

    back = read_shapes(tmp_path / "out.mfjson")

    for t in (0, Fraction(5, 2), 5, 7, 9):
        assert back.at(t) == scene.at(t)
    assert back.bodies[0].properties == scene.bodies[0].properties
    (written,) = json.loads((tmp_path / "out.mfjson").read_text())["features"]
    assert written["id"] == "A"
    assert "geometry" not in written


@pytest.mark.parametrize(
    "data, message",
    [
        (trajectory(seconds=(0, 5)), "2 datetimes for 3 positions"),
        (trajectory(seconds=(0, 5, 5)), "datetimes do not increase"),
        (trajectory(places=[(0, 0)], seconds=[0]), "at least two timestamps"),
        (trajectory(properties={"datetimes": "noon"}), '"datetimes": not a list'),
        (trajectory(trs={"type": "Name", "properties": {"name": "weeks"}}), '"trs": times are da'),
        (collection(trajectory(), {"type": "Feature", "properties": {}, "geometry": {
            "type": "Point", "coordinates": [1, 2]}}), "feature 1: it does not move"),
    ],
)  # fmt: skip
def test_a_trajectory_that_is_none_is_refused(tmp_path, data, message):
    with pytest.raises(InputError, match=message):
        read(tmp_path, data)


UPRIGHT = {"scales": [1, 1, 1], "angles": [0, 0, 0]}


@every(
    "geometry, members, lost",
    [
        ({}, {}, ()),
        ({"interpolation": None, "base": None, "orientations": [UPRIGHT]}, {"trs": None}, ()),
        ({"crs": {}, "upper_inc": False, "velocity": 3}, {},
         ("crs", "velocity of 1 moving geometry", "upper_inc of 1 moving geometry")),
        ({"coordinates": [[0, 0, 1], [10, 0, 2]]}, {"bbox": [0, 0, 1, 1]},
         ("bbox", "z of 2 points")),
        ({}, {"geometry": {"type": "Point", "coordinates": [0, 0]}, "time": DATES},
         ("geometry of 1 moving feature",)),
        ({}, {"time": [DATES[0], "2001-01-01T00:00:00Z"]},
         ("time beyond the positions of 1 moving feature",)),
        ({}, {"trs": {"type": "Link", "properties": {
            "href": "http://www.opengis.net/def/uom/ISO-8601/0/Gregorian", "type": "OGCDEF"}}}, ()),
    ],
)  # fmt: skip
def test_losses_of_moving_features_are_named(tmp_path, geometry, members, lost):
    given = {**feature(), **members}
    given["temporalGeometry"] = {**given["temporalGeometry"], **geometry}

    scene = read(tmp_path, given)

    assert scene.lost == lost
    assert scene.at(START + 5) == {"a": [(5, 0)]}


def test_losses_of_two_moving_geometries_are_counted_in_the_plural(tmp_path):
    one = feature()
    one["temporalGeometry"] = {**one["temporalGeometry"], "velocity": 3}

    scene = read(tmp_path, {"type": "FeatureCollection", "features": [one, one]})

    assert scene.lost == ("velocity of 2 moving geometries",)


def test_temporal_properties_stay_with_the_body(tmp_path):
    speeds = [{"datetimes": DATES, "speed": {"values": [1, 2.5], "interpolation": "Linear"}}]
    scene = read(tmp_path, {**feature(), "temporalProperties": speeds})
    scene.save(tmp_path / "scene.json")

    assert scene.bodies[0].properties["temporalProperties"] == speeds
    write_shapes(Scene.load(tmp_path / "scene.json"), tmp_path / "out.mfjson")
    (written,) = json.loads((tmp_path / "out.mfjson").read_text())["features"]
    assert written["temporalProperties"] == speeds
    assert written["properties"] == {"name": "a"}


def test_a_life_bounds_the_time_of_a_feature(tmp_path):
    """It moves for 10 s, and is there from 4 s to 8 s."""
    life = ["2000-01-01T00:00:04Z", "2000-01-01T00:00:08Z"]
    scene = read(tmp_path, {**feature(), "lifeSpan": life})

    assert scene.time == (START + 4, START + 8)
    assert scene.at(START + 4) == {"a": [(4, 0)]}
    with pytest.raises(InputError, match="it moves from t = 946684804 to 946684808"):
        read(tmp_path, {**feature(), "time": life}, time=(START, START + 8))
    with pytest.raises(InputError, match="it is nowhere while it is there"):
        read(tmp_path, {**feature(), "time": ["2001-01-01T00:00:00Z", "2002-01-01T00:00:00Z"]})


RING = [[0, 0], [4, 0], [4, 4], [0, 0]]


@pytest.mark.parametrize(
    "geometry, message",
    [
        ({"base": {"type": "glTF", "href": "car.gltf"}}, '"base": a model that moves'),
        ({"orientations": [{"scales": [1, 1, 1], "angles": [0, 0, 90]}]}, "it turns or scales"),
        ({"orientations": [{"scales": [1, 2, 1], "angles": [0, 0, 0]}]}, "it turns or scales"),
        ({"interpolation": "Stepwise"}, "linear interpolation, not 'Stepwise'"),
        ({"interpolation": "Linear", "interpolations": ["Discrete"]}, "linear interpolation, not"),
        ({"type": "MovingGeometryCollection", "prisms": []}, "not one of MovingPoint"),
        ({"sequences": [{"datetimes": DATES, "coordinates": [[7, 7], [8, 8]]}]},
         "two values of 'coordinates'"),
        # The corner that is there twice is another one: the vertices would swap.
        ({"type": "MovingPolygon", "coordinates": [
            [[[0, 0], [0, 0], [4, 0], [4, 4], [0, 0]]], [[[0, 0], [4, 0], [4, 0], [4, 4], [0, 0]]],
        ]}, "position 1: its rings, or its vertices that coincide"),
        # Three corners of an open line, then a closed one: a wire that becomes a plate.
        ({"type": "MovingLineString", "coordinates": [RING[:3], RING]},
         "position 1: its rings, or its vertices that coincide"),
    ],
)  # fmt: skip
def test_members_that_change_a_motion_are_refused(tmp_path, geometry, message):
    given = feature()
    given["temporalGeometry"] = {**given["temporalGeometry"], **geometry}

    with pytest.raises(InputError, match=message):
        read(tmp_path, given)


@pytest.mark.parametrize(
    "pose, message",
    [
        ({"rotation": 0, "yaw": 0.5}, "value 0: it turns"),
        ({"rotation": 0, "pitch": 0.5}, "value 0: it turns"),
        ({"rotation": 0, "quaternion": {}}, "value 0: unknown key 'quaternion'"),
        ({}, "value 0: rotation: not a number"),
    ],
)
def test_poses_that_turn_in_another_way_are_refused(tmp_path, pose, message):
    rigid = {
        "type": "MovingRigidGeometry",
        "geometry": {"type": "Polygon", "coordinates": [RING]},
        "datetimes": DATES,
        "values": [{"position": {"lat": 0, "lon": 0, "alt": 3}, **pose}] * 2,
    }

    with pytest.raises(InputError, match=message):
        read(tmp_path, rigid)
    rigid["values"] = [{"position": {"lat": 0, "lon": 0, "alt": 3}, "rotation": 0}] * 2
    assert read(tmp_path, rigid).lost == ("alt of 2 positions",)
