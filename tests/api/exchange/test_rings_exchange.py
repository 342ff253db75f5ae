"""Holes and MultiPolygons in GeoJSON, WKT, SVG and shapely: in as they are, out again; repairs."""

import json

import pytest
from commands import code_of

from exactpt import Body, InputError, Scene, Translation, read_shapes, write_shapes
from exactpt.testing.scenes import RINGS, generate

LAND = [(0, 0), (9, 0), (9, 9), (0, 9)]
LAKE = [(1, 1), (8, 1), (8, 8), (1, 8)]
ISLE = [(3, 3), (5, 3), (3, 5)]
FAR = [(20, 0), (22, 0), (20, 2)]
WHOLE = Body("land", parts=[{"vertices": LAND, "holes": [LAKE]}, ISLE, FAR])
TIE = "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"


def places(body):
    """The rings of each part as sets of vertices, in doubles."""
    at = [(float(x), float(y)) for x, y in body.at(0)]
    return [[{at[i] for i in ring} for ring in rings] for rings in body.parts]


@pytest.mark.parametrize("ending", ["geojson", "wkt"])
@pytest.mark.parametrize("family", sorted(RINGS))
def test_what_is_written_is_read_back(tmp_path, family, ending):
    """In the same order and to the last digit."""
    for seed in range(8):
        scene = generate(family, seed)
        first, second = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
        rounded = Scene(
            [Body.from_shapely(g, name) for name, g in scene.to_shapely(0).items()],
            (scene.start, scene.end),
        )
        write_shapes(rounded, first)
        back = read_shapes(first, time=(scene.start, scene.end))
        assert list(map(places, back.bodies)) == list(map(places, rounded.bodies))
        write_shapes(back, second)
        if ending == "wkt":
            assert second.read_text() == first.read_text()
        else:
            assert json.loads(second.read_text()) == json.loads(first.read_text())


def test_geojson_has_the_kinds_of_the_standard_and_the_order_of_the_body(tmp_path):
    path = tmp_path / "land.geojson"
    write_shapes(Scene([WHOLE, Body("plain", [(50, 0), (51, 0), (50, 1)])]), path)
    first, second = json.loads(path.read_text())["features"]
    assert (first["geometry"]["type"], second["geometry"]["type"]) == ("MultiPolygon", "Polygon")
    written = [
        [tuple(p) for p in ring[:-1]] for part in first["geometry"]["coordinates"] for ring in part
    ]
    assert written == [LAND, LAKE, ISLE, FAR]


def test_a_drawing_has_one_path_with_all_rings(tmp_path):
    path = tmp_path / "land.svg"
    write_shapes(Scene([WHOLE]), path)
    assert path.read_text().count("<path") == 1
    assert path.read_text().count("evenodd") == 1
    back = read_shapes(path)
    assert [len(body.rings) for body in back.bodies] == [2, 1, 1]


def test_shapely_and_back_at_a_time():
    scene = Scene([WHOLE.with_motion(Translation([0, 2]))], (0, 4))
    moved = scene.to_shapely(3)["land"]
    assert moved.geom_type == "MultiPolygon"
    assert moved.is_valid
    assert moved.area == 81 - 49 + 2 + 2
    assert moved.bounds == (6, 0, 28, 9)
    assert Scene.from_shapely({"land": moved}).to_shapely(0)["land"].equals(moved)
    assert Body.from_shapely(moved, "land").parts == WHOLE.parts


def test_parts_are_bodies_of_their_own_on_demand():
    whole = Scene([WHOLE]).to_shapely(0)
    split = Scene.from_shapely(whole, parts="split")
    assert [body.name for body in split.bodies] == ["land", "land 2", "land 3"]
    assert [len(body.rings) for body in split.bodies] == [2, 1, 1]


@pytest.mark.parametrize("given", [{"holes": "drop"}, {"parts": "drop"}])
def test_other_words_are_refused(tmp_path, given):
    path = tmp_path / "tie.wkt"
    path.write_text(TIE)
    with pytest.raises(InputError, match=r"either keep"):
        read_shapes(path, **given)


def test_parts_with_a_common_edge_are_refused_with_what_to_do(tmp_path):
    path = tmp_path / "touching.wkt"
    path.write_text("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((1 0, 2 0, 1 1, 1 0)))")
    with pytest.raises(InputError, match=r"common piece: .*split it \(--parts split\), mend it"):
        read_shapes(path)
    assert len(read_shapes(path, parts="split").bodies) == 2


@pytest.mark.parametrize(
    "suffix, text",
    [
        ("wkt", "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((1 1, 2 1, 2 2, 1 1)))"),
        (
            "geojson",
            json.dumps(
                {
                    "type": "MultiPolygon",
                    "coordinates": [
                        [[[0, 0], [1, 0], [1, 1], [0, 0]]],
                        [[[1, 1], [2, 1], [2, 2], [1, 1]]],
                    ],
                }
            ),
        ),
    ],
)
def test_parts_that_touch_in_a_point_are_one_body(tmp_path, suffix, text):
    """The parts touch at (1, 1)."""
    path = tmp_path / f"touching.{suffix}"
    path.write_text(text)
    bodies = read_shapes(path).bodies
    assert [body.rings for body in bodies] == [(range(3), range(3, 6))]


@pytest.mark.parametrize("suffix", ["wkt", "geojson", "svg"])
def test_a_hole_that_touches_the_outline_survives_a_round_trip(tmp_path, suffix):
    """The hole touches the outline at (4, 0), inside of an edge: the area is 64 - 2 = 62."""
    notched = Body("notched", [(0, 0), (8, 0), (8, 8), (0, 8)], holes=[[(4, 0), (5, 2), (3, 2)]])
    path = tmp_path / f"notched.{suffix}"
    write_shapes(Scene([notched]), path)
    (body,) = read_shapes(path).bodies
    (geometry,) = Scene([body]).to_shapely(0).values()
    assert geometry.is_valid
    assert geometry.area == 62
    assert sorted(body.at(0)) == sorted(notched.at(0))
    assert sorted(map(len, body.rings)) == [3, 4]


def test_repair_says_what_it_changes(tmp_path, capsys):
    source, target = tmp_path / "a.wkt", tmp_path / "a.json"
    source.write_text(
        "POLYGON ((30 0, 40 0, 40 9, 30 9, 30 0), (32 1, 36 1, 36 8, 32 8, 32 1), "
        f"(35 3, 38 3, 38 5, 35 5, 35 3))\n{TIE}\nPOLYGON ((60 0, 61 0, 60 1, 60 0))"
    )
    assert code_of("convert", source, target) == 2
    assert code_of("convert", source, target, "--repair") == 0
    message = [line for line in capsys.readouterr().err.splitlines() if "repaired" in line]
    assert len(message) == 2
    assert "geometry 0: repaired 'body 0' (not valid at the start" in message[0]
    assert "two rings cross: edge 5 from (36, 1) meets edge 8 from (35, 3)): " in message[0]
    assert message[0].endswith("1 polygon of 12 vertices became 2 polygons of 16 vertices")
    assert "geometry 1: repaired 'body 1' (not a simple polygon" in message[1]
    assert message[1].endswith("1 polygon of 4 vertices became 2 polygons of 6 vertices")
    bodies = Scene.load(target).bodies
    assert [body.name for body in bodies] == ["body 0", "body 1", "body 2"]
    assert [len(body.rings) for body in bodies] == [3, 2, 1]


def test_what_has_no_area_is_not_repaired(tmp_path, capsys):
    source, target = tmp_path / "a.wkt", tmp_path / "a.json"
    source.write_text("POLYGON ((0 0, 1 1, 2 2, 0 0))")
    assert code_of("convert", source, target, "--repair") == 2
    assert "nothing of 'body 0' has an area" in capsys.readouterr().err
    source.write_text("LINESTRING (0 0, 2 0, 1 1, 1 -1)")
    assert code_of("convert", source, target, "--repair") == 2
    assert "only polygons are repaired" in capsys.readouterr().err


@pytest.mark.parametrize(
    "hole, options, message",
    [
        ("(1 1, 5 5, 3 3, 1 1)", [], "a hole of polygon 'body 0' has no area: mend it (--repair)"),
        ("(0 0, 5 2, 2 5, 0 0)", [], None),
        ("(0 0, 5 2, 2 5, 0 0)", ["--repair"], None),
        ("(0 0, 9 2, 2 5, 0 0)", [], "touch at (9, 2) and (0, 0)"),
        ("(0 0, 9 2, 2 5, 0 0)", [], "fill its holes (--holes fill), mend it (--repair)"),
        ("(1 1, 5 5, 3 3, 1 1)", ["--repair"], None),
        ("(0 0, 9 2, 2 5, 0 0)", ["--holes", "fill"], None),
    ],
)
def test_a_flat_hole_and_one_that_touches_the_outline(tmp_path, capsys, hole, options, message):
    """One that touches it twice divides the inside."""
    source, target = tmp_path / "a.wkt", tmp_path / "a.json"
    source.write_text(f"POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), {hole})")

    assert code_of("convert", source, target, *options) == (2 if message else 0)
    assert message is None or message in capsys.readouterr().err


def test_the_command_has_the_choices(tmp_path):
    source, target = tmp_path / "a.geojson", tmp_path / "a.json"
    write_shapes(Scene([WHOLE]), source)
    assert code_of("convert", source, target, "--quiet") == 0
    assert len(Scene.load(target).bodies[0].rings) == 4
    assert code_of("convert", source, target, "--quiet", "--holes", "fill", "--parts", "split") == 0
    assert [len(b.rings) for b in Scene.load(target).bodies] == [1, 1, 1]
    assert code_of("convert", source, target, "--quiet", "--holes", "refuse") == 2
