"""What a file has and a scene has no place for: kept as data, named once, or refused on demand."""

import json
from pathlib import Path

import pytest
import shapely
from commands import code_of, run
from folding import every

from exactpt import Body, InputError, PosePath, Scene, Translation, read_shapes, write_shapes
from exactpt.exchange.files import lost_by_writing

POINT = {"type": "Point", "coordinates": [1, 2]}
HIGH = {"type": "LineString", "coordinates": [[0, 0, 5], [1, 1, 6]]}


def feature(geometry=POINT, properties=None, **members):
    return {"type": "Feature", "geometry": geometry, "properties": properties, **members}


def collection(*features, **members):
    return {"type": "FeatureCollection", "features": list(features), **members}


def read(tmp_path, text, suffix="geojson", **options):
    path = tmp_path / f"in.{suffix}"
    path.write_text(text if isinstance(text, str) else json.dumps(text))
    return read_shapes(path, **options)


@every(
    "data, lost",
    [
        (collection(feature()), ()),
        (collection(feature(HIGH), feature(HIGH), crs={}), ("crs", "z of 4 points")),
        (collection(feature(crs=None, bbox=None)), ()),
        (collection(feature(bbox=[1, 2, 1, 2]), bbox=[1, 2, 1, 2]), ("bbox",)),
        (collection(feature(), name="layer"), ("name of the collection",)),
        (feature({"type": "Point", "coordinates": [1, 2], "radius": 3}), ("radius of 1 geometry",)),
        (feature({"type": "Point", "coordinates": [1, 2, 3, 4]}),
         ("z of 1 point", "further coordinates of 1 point")),
        (feature(None), ("feature has no geometry (null)",)),
        (collection(feature(None, {"name": "a"})), ("feature 0 (a) has no geometry (null)",)),
        (collection(feature(None), feature(), feature(None)),
         ("feature 0 and 1 more have no geometry (null)",)),
    ],
)  # fmt: skip
def test_losses_of_geojson_are_named_once(tmp_path, data, lost):
    assert read(tmp_path, data).lost == lost


@every(
    "text, lost, properties",
    [
        ("POINT (1 2)", (), {}),
        ("POINT Z (1 2 3)", ("z of 1 point",), {}),
        ("LINESTRING M (1 2 3, 4 5 6)", ("m of 2 points",), {}),
        ("POINT ZM (1 2 3 4)", ("z of 1 point", "m of 1 point"), {}),
        ("SRID=4326;POINT (1 2)", (), {"SRID": 4326}),
        (" srid = 25832 ; MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5)))", (),
         {"SRID": 25832}),
    ],
)  # fmt: skip
def test_losses_of_wkt_are_named_and_srids_kept(tmp_path, text, lost, properties):
    scene = read(tmp_path, text, "wkt")

    assert scene.lost == lost
    assert scene.bodies[0].properties == properties


def test_losses_of_shapely_are_named():
    found = shapely.set_srid(shapely.from_wkt(["POINT Z (1 2 3)", "POINT (4 5)"]), [4326, 0])

    assert Scene.from_shapely(found).lost == ("z of 1 point", "SRID of 1 geometry")


def test_other_scenes_have_lost_nothing(tmp_path):
    scene = read(tmp_path, feature(HIGH))

    assert scene.lost
    assert scene.until("1/2").lost == Scene(scene.bodies).lost == ()
    assert scene == Scene(scene.bodies)


def test_strict_refuses_what_would_be_lost(tmp_path):
    data = collection(feature(HIGH), crs={})

    with pytest.raises(InputError, match=r"in\.geojson: lost: crs, z of 2 points; leave out --str"):
        read(tmp_path, data, strict=True)
    assert read(tmp_path, collection(feature()), strict=True).lost == ()


@pytest.mark.parametrize("value", [7, "7", "seven", 7.5, -(10**20)])
@pytest.mark.parametrize("suffix", ["geojson", "mfjson"])
def test_an_id_comes_back_with_its_type(tmp_path, value, suffix):
    dates = ["1970-01-01T00:00:00Z", "1970-01-01T00:00:01Z"]
    moving = {"type": "MovingPoint", "datetimes": dates, "coordinates": [[0, 0], [1, 1]]}
    given = feature(properties={"name": "a"}, id=value)
    if suffix == "mfjson":
        given = {**given, "geometry": None, "temporalGeometry": moving}
    scene = read(tmp_path, collection(given), suffix)
    scene.save(tmp_path / "scene.json")

    write_shapes(Scene.load(tmp_path / "scene.json"), tmp_path / f"out.{suffix}")

    assert scene.bodies[0].properties["id"] == value
    (written,) = json.loads((tmp_path / f"out.{suffix}").read_text())["features"]
    assert (written["id"], type(written["id"])) == (value, type(value))
    assert written["properties"] == {"name": "a"}


@every(
    "given",
    [
        feature(id=7),
        feature(properties={"id": 7}),
        feature(properties={"id": "own"}, id=7),
        feature(properties={"name": 17}),
        feature(properties={"name": "a", "title": 1}, title="b", links=[{"href": "x"}]),
        feature(properties={"name": "a", "title": 1, "title 2": 2}, title="b"),
    ],
)
def test_features_come_back_as_they_were(tmp_path, given):
    scene = read(tmp_path, collection(given))
    scene.save(tmp_path / "scene.json")
    write_shapes(Scene.load(tmp_path / "scene.json"), tmp_path / "out.geojson")

    (written,) = json.loads((tmp_path / "out.geojson").read_text())["features"]
    assert {**written, "geometry": None} == {
        **given, "geometry": None, "properties": given["properties"] or {},
    }  # fmt: skip


DATES = ["2026-01-01T00:00:00Z", "2026-01-01T00:00:01Z"]
TRACKS = {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 1]], [[5, 5], [6, 6]]]}


@every(
    "data",
    [
        feature(HIGH, {"coordTimes": DATES}),
        feature(HIGH, {"DateTimes": [0, 1000]}),
        feature(HIGH, {"coordinateProperties": {"times": DATES}}),
        feature({**HIGH, "type": "MultiPoint"}, {"datetimes": DATES}),
        feature(TRACKS, {"datetimes": [DATES, DATES]}),
        feature(HIGH, datetimes=DATES),
        feature({**HIGH, "datetimes": DATES}),
        {**HIGH, "datetimes": [0, 1000]},
        feature({"type": "GeometryCollection", "geometries": [POINT, HIGH]}, {"datetimes": DATES}),
    ],
)
def test_dates_of_positions_at_rest_are_refused(tmp_path, data):
    """GPS logs are written so: the track of a body that moves, not a wire."""
    with pytest.raises(InputError, match=r"has a date for each position, and would be at rest"):
        read(tmp_path, data)


@every(
    "data",
    [
        feature(HIGH, {"dates": DATES[:1]}),
        feature(HIGH, {"words": ["a", "b"]}),
        feature(HIGH, {"heights": [1, 2]}),
        feature(POINT, {"datetimes": DATES}),
        feature(TRACKS, {"datetimes": DATES}),
    ],
)
def test_other_lists_are_properties(tmp_path, data):
    scene = read(tmp_path, data)

    assert scene.bodies[0].properties == data["properties"]


@every(
    "data, message",
    [
        (feature(coordinates=[1, 2]), "a Feature has no 'coordinates': remove it"),
        (collection(feature(), geometry=None), "a FeatureCollection has no 'geometry'"),
        (collection(feature(), temporalGeometry={}), "Collection has no 'temporalGeometry'"),
        (feature({**POINT, "temporalGeometry": {}}), "a Point has no 'temporalGeometry'"),
        (feature({**POINT, "geometries": []}), "a Point has no 'geometries'"),
        (feature({"type": "GeometryCollection", "geometries": [POINT], "coordinates": []}),
         "a GeometryCollection has no 'coordinates'"),
        (feature(properties=[1]), '"properties": not an object'),
        (feature(properties={"feature_members": {}}, id=1), "'feature_members' is reserved"),
        (feature(HIGH, {"times": ["2026-01-01T00:00:00Z", "2026-01-01T00:00:01Z"]}),
         "'times' has a date for each position, and would be at rest"),
    ],
)  # fmt: skip
def test_members_that_change_a_shape_are_refused(tmp_path, data, message):
    with pytest.raises(InputError, match=message):
        read(tmp_path, data)


def test_topojson_is_named(tmp_path):
    path = tmp_path / "map.json"
    path.write_text('{"type": "Topology", "objects": {}, "arcs": []}')

    with pytest.raises(InputError, match="TopoJSON is not supported"):
        read_shapes(path)
    with pytest.raises(InputError, match="not a scene: TopoJSON is not supported"):
        Scene.load(path)


def test_the_command_names_losses_once_on_standard_error(tmp_path):
    source, target = tmp_path / "in.geojson", tmp_path / "out.json"
    source.write_text(json.dumps(collection(feature(HIGH), feature(None), crs={})))

    done = run("convert", source, target)

    assert done.exit_code == 0
    line = "lost: crs, z of 2 points, feature 1 has no geometry (null)\n"
    assert done.stderr.count("lost:") == 1
    assert line in done.stderr
    assert "lost" not in done.stdout
    assert run("convert", source, target, "--quiet").stderr == ""


def test_strict_is_exit_code_2_and_writes_nothing(tmp_path, capsys):
    source, target = tmp_path / "in.geojson", tmp_path / "out.json"
    source.write_text(json.dumps(collection(feature(HIGH))))

    assert code_of("convert", source, target, "--strict") == 2
    assert capsys.readouterr().err.startswith(f"exactpt: {source}: lost: z of 2 points; ")
    assert not target.exists()
    source.write_text(json.dumps(collection(feature())))
    assert code_of("convert", source, target, "--strict") == 0


@pytest.mark.parametrize(
    "suffix, at, lost",
    [
        ("json", None, None),
        ("mfjson", None, None),
        ("geojson", None, "motion of 1 body"),
        ("geojson", 0, None),
        ("wkt", 0, "name of 2 bodies, properties of 1 body"),
        ("svg", None, "motion of 1 body, properties of 1 body"),
    ],
)
def test_losses_of_writing_are_named(tmp_path, suffix, at, lost):
    bodies = [
        Body("a", [(0, 0)], Translation([0, 1]), properties={"n": 1}),
        Body("b", [(5, 5), (6, 5)]),
    ]
    scene, target = tmp_path / "scene.json", tmp_path / f"out.{suffix}"
    Scene(bodies).save(scene)
    when = () if at is None else ("--at", at)

    done = run("convert", scene, target, *when)

    assert [line for line in done.stderr.splitlines() if line.startswith("lost")] == (
        [] if lost is None else [f"lost: {lost}"]
    )
    assert code_of("convert", scene, target, "--strict", *when) == (0 if lost is None else 2)


@pytest.mark.parametrize(
    "suffix, at, lost",
    [
        ("json", None, ()),
        ("mfjson", None, ("error of the motion of 1 body",)),
        ("geojson", 1, ("error of the motion of 1 body",)),
        ("geojson", None, ("motion of 2 bodies",)),
    ],
)
def test_stated_errors_of_motions_are_named_where_a_format_has_no_place_for_them(suffix, at, lost):
    """The errors of fitting of both paths vanish, as they do not turn; one has a stated error."""
    path = PosePath([0, 1], [([0, 1], 0, 0)])
    known_less = Body("a", [(0, 0)], path.with_place_error("1/10"))
    scene = Scene([known_less, Body("b", [(5, 5)], path)])

    assert lost_by_writing(scene, Path(f"out.{suffix}"), at) == lost


def test_names_that_a_format_cannot_hold_are_named(tmp_path):
    """The second Mary is "Mary 2" in results and files; XML has no control characters."""
    source = tmp_path / "in.geojson"
    source.write_text(json.dumps(collection(*[feature(properties={"name": "Mary"})] * 2)))

    done = run("convert", source, tmp_path / "out.geojson")
    Scene([Body("a\x01", [(0, 0)])]).save(tmp_path / "scene.json")

    assert "lost: property name of 1 body\n" in done.stderr
    drawn = run("convert", tmp_path / "scene.json", tmp_path / "out.svg")
    assert drawn.stderr == "lost: name of 1 body\n"


def test_rounded_bodies_keep_their_properties_when_written(tmp_path):
    disc = Body("disc", [(0, 0)], radius=2, properties={"n": 1})
    write_shapes(Scene([disc]), tmp_path / "disc.geojson")

    (written,) = json.loads((tmp_path / "disc.geojson").read_text())["features"]
    assert written["properties"] == {"name": "disc", "n": 1}


RINGS = [
    [(0, 0), (9, 0), (9, 9), (0, 9)],
    [(0, 9), (9, 9), (9, 0), (0, 0)],
    [(9, 0), (9, 9), (0, 9), (0, 4), (0, 0)],
]


@pytest.mark.parametrize("suffix", ["geojson", "wkt", "svg", "mfjson", "json", "shapely"])
@pytest.mark.parametrize("ring", RINGS)
@pytest.mark.parametrize("hole", [[(1, 1), (2, 1), (1, 2)], [(1, 2), (2, 1), (1, 1)]])
def test_vertices_keep_their_order_and_orientation(tmp_path, suffix, ring, hole):
    """The vertex on an edge, (0, 4), stays too: contacts name vertices by their numbers."""
    scene = Scene([Body("plate", ring, holes=[hole]), Body("wire", [(20, 0), (21, 3)])])
    if suffix == "shapely":
        back = Scene.from_shapely(scene.to_shapely(0))
    else:
        write_shapes(scene, tmp_path / f"out.{suffix}")
        back = read_shapes(tmp_path / f"out.{suffix}")

    assert back.bodies[0].at(0) == [*ring, *hole]
    assert back.bodies[0].parts == scene.bodies[0].parts
    assert back.bodies[1].at(0) == [(20, 0), (21, 3)]


def test_a_number_as_a_name_is_refused_with_the_text_to_write():
    body = {"name": 211042114, "vertices": [[0, 0]]}

    with pytest.raises(InputError, match='"name": expected a text, got 211042114; write "2110421'):
        Scene.from_json({"exactpt": 1, "time": [0, 1], "bodies": [body]})


@every("key, dates", [("datetimes", DATES), ("datetimes", []), ("times", DATES)])
def test_line_at_rest_whose_properties_would_make_it_move_is_not_written(tmp_path, key, dates):
    """A LineString with ``datetimes`` is a point that moves along it: a wire came back as one."""
    wire = Body("wire", [(0, 0), (1, 1)], properties={key: dates})

    with pytest.raises(InputError, match=f"body 'wire': with the property '{key}' this line would"):
        write_shapes(Scene([wire]), tmp_path / "out.geojson")
    assert not (tmp_path / "out.geojson").exists()


@every(
    "given",
    [
        {"feature_members": 3},
        {"feature_members": {"x": "missing"}},
        {"feature_members": {"geometry": "g"}, "g": 1},
        {"feature_members": {"features": "g", "id": "h"}, "g": 1, "h": 2},
    ],
)
def test_property_with_a_reserved_name_and_another_content_stays(tmp_path, given):
    """It vanished without a word, or wrote a member that readers refuse."""
    write_shapes(Scene([Body("b", [(0, 0)], properties=given)]), tmp_path / "out.geojson")

    (body,) = read_shapes(tmp_path / "out.geojson").bodies
    assert body.properties == {"name": "b", **given}


def test_name_that_a_file_does_not_give_back_is_lost(tmp_path):
    """A name of spaces alone is no name to readers, who take the number of the feature."""
    scene = Scene([Body("  ", [(0, 0)])])

    for ending in ("geojson", "mfjson"):
        with pytest.raises(InputError, match="lost: name of 1 body"):
            write_shapes(scene, tmp_path / f"out.{ending}", strict=True)


def test_scene_that_a_format_cannot_hold_is_refused_with_the_file(tmp_path):
    disc = Scene([Body("disc", [(0, 0)], radius=1)])

    for file, at, message in (
        ("out.mfjson", None, r"out\.mfjson: body 'disc': moving features have no radius"),
        ("out.wkt", 9, r"out\.wkt: t = 9 is outside the time span from 0 to 1$"),
        ("out.json", 0, r"out\.json: a scene has all times"),
    ):
        with pytest.raises(InputError, match=message):
            write_shapes(disc, tmp_path / file, at)
        assert not (tmp_path / file).exists()
