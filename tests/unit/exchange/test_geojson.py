"""GeoJSON in and out: exact decimals, names, parts, and what is refused."""

import json

import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, InputError, Scene, Translation, read_shapes, write_shapes
from exactpt.exchange.bodies import scene_of
from exactpt.exchange.geojson import geojson_of, shapes_of
from exactpt.exchange.shapes import Shape, shapes_at
from exactpt.kernel.numbers import QQ, parse_rational

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]
decimals = st.decimals(min_value=-1000, max_value=1000, places=20)


def text(kind, coordinates, **properties):
    geometry = {"type": kind, "coordinates": coordinates}
    feature = {"type": "Feature", "properties": properties, "geometry": geometry}
    return json.dumps({"type": "FeatureCollection", "features": [feature]})


def scene(data, **options):
    return scene_of(shapes_of(data), **options)


@given(x=decimals, y=decimals)
def test_a_decimal_is_the_decimal_that_is_written(x, y):
    """Twenty decimals, more than a double holds."""
    written = f'{{"type": "Point", "coordinates": [{x:f}, {y:f}]}}'

    (body,) = scene(written).bodies

    assert body.at(0) == [(parse_rational(f"{x:f}"), parse_rational(f"{y:f}"))]


@every(
    "kind, coordinates, sizes",
    [
        ("Point", [1, 2, 300], [1]),
        ("MultiPoint", [[1, 2], [3, 4]], [1, 1]),
        ("LineString", [[0, 0], [1, 1]], [2]),
        ("LineString", [[0, 0], [1, 1], [2, 0]], [3]),
        ("MultiLineString", [[[0, 0], [1, 1]], [[2, 2], [3, 3], [4, 2]]], [2, 3]),
        ("Polygon", [SQUARE], [4]),
        ("Polygon", [SQUARE[::-1]], [4]),
        ("MultiPolygon", [[SQUARE], [[[5, 5], [6, 5], [5, 6], [5, 5]]]], [4, 3]),
    ],
)
def test_each_part_is_a_body(kind, coordinates, sizes):
    bodies = scene(text(kind, coordinates), parts="split").bodies

    assert [body.size for body in bodies] == sizes


def test_a_line_is_open_and_one_that_closes_is_a_polygon():
    (chain,) = scene(text("LineString", [[0, 0], [1, 0], [1, 1]])).bodies
    (ring,) = scene(text("LineString", SQUARE)).bodies

    assert (chain.closed, chain.size) == (False, 3)
    assert (ring.closed, ring.size) == (True, 4)


def test_a_point_that_comes_twice_in_a_row_counts_once():
    twice = [[0, 0], [0, 0], [1, 0], [1, 1], [1, 1.0], [0, 1], [0, 0], [0, 0]]

    (body,) = scene(text("Polygon", [twice])).bodies

    assert body.at(0) == [(0, 0), (1, 0), (1, 1), (0, 1)]


def test_names_come_from_properties_and_are_made_unique():
    def feature(properties, x, **more):
        point = {"type": "Point", "coordinates": [x, 0]}
        return {"type": "Feature", "properties": properties, "geometry": point, **more}

    features = [
        feature({"name": "Oslo", "id": "o"}, 0),
        feature({"NAME": "Oslo"}, 1),
        feature({"ID": 17}, 2),
        feature(None, 3, id="own"),
        feature({"name": None}, 4),
        feature({"name": " "}, 5),
        feature({"name": "Oslo 2"}, 6),
        feature({"name": "\ud800"}, 7),
    ]
    data = json.dumps({"type": "FeatureCollection", "features": features})

    names = [body.name for body in scene(data).bodies]

    assert names == ["Oslo", "Oslo 2", "17", "own", "feature 4", "feature 5", "Oslo 2 2", "?"]


HOLED = text("Polygon", [SQUARE, [[0.2, 0.2], [0.4, 0.2], [0.2, 0.4], [0.2, 0.2]]], name="lake")


def test_holes_are_refused_or_filled_on_demand():
    with pytest.raises(InputError, match=r"feature 0 \(lake\): polygon 'lake' has 1 hole.*--holes"):
        scene(HOLED, holes="refuse")

    assert scene(HOLED, holes="fill").bodies[0].size == 4


@every(
    "data, message",
    [
        (text("Polygon", [[[0, 0], [1, 1], [0, 0]]]), "'feature 0' has no area: remove it"),
        (text("Polygon", [[[0, 0], [1, 1], [2, 2], [0, 0]]]), "has no area"),
        (text("Polygon", []), "is empty"),
        (text("LineString", [[1, 1], [1, 1]]), "has no length"),
        (text("LineString", []), "is empty"),
        (text("Polygon", [[[0, 0], [2, 2], [2, 0], [0, 1], [0, 0]]], name="tie"),
         r"feature 0 \(tie\): body 'tie': not a simple polygon .*--skip-invalid"),
        (text("LineString", [[0, 0], [2, 0], [1, 1], [1, -1]]), "not a simple chain"),
        (text("Point", [1]), "not a position"),
        (text("Point", ["1", "2"]), "not a position"),
        (text("Point", [True, 2]), "not a position"),
        (text("Point", 3), "not a list: 3"),
        (text("Point", [float("nan"), 1]), "not a number"),
        (text("MultiPolygon", [3]), "part 0: not a list"),
        (text("Polygon", [[[0, 0], None]]), "ring 0, position 1: not a list"),
        (text("Circle", [0, 0]), "not a geometry"),
        (text("Feature", [0, 0]), "a Feature is inside of a geometry"),
        ('{"type": "Feature"}', 'feature has no geometry: the key "geometry" is missing$'),
        ('{"type": "Feature", "geometri": {}, "id": "a"}',
         r"feature \(a\) has no geometry: the key .* is missing; is it 'geometri'\?"),
        (text("MultiPolygon", [], name="isles"),
         r"feature 0 \(isles\): polygon 'isles' is empty"),
        (text("MultiLineString", []), "feature 0: line 'feature 0' is empty"),
        (text("MultiPoint", []), "feature 0: point 'feature 0' is empty"),
        ('{"type": "GeometryCollection", "geometries": []}',
         "geometry: point 'body' is empty"),
        ('{"type": "FeatureCollection", "features": [{"type": "Point"}]}', "not a feature"),
        ('{"type": "FeatureCollection"}', '"features": not a list'),
        ('{"type": "Topology"}', "TopoJSON is not supported"),
        ("[]", "not GeoJSON"),
        ("{", "not JSON"),
        ('{"type": "GeometryCollection", "geometries": [' * 3 + "1" + "]}" * 3,
         "geometry, geometry 0, geometry 0, geometry 0: not a geometry: 1"),
        ('{"type": "GeometryCollection", "geometries": [' * 9000, "nested too deeply|not JSON"),
    ],
)  # fmt: skip
def test_what_is_refused(data, message):
    with pytest.raises(InputError, match=message) as refused:
        scene(data)

    assert "\n" not in str(refused.value)


def test_what_cannot_be_a_body_is_left_out_on_demand():
    parts = [[SQUARE], [[[5, 5], [6, 6], [5, 5]]], [[[8, 8], [9, 8], [8, 9], [8, 8]]]]
    said = []

    bodies = scene(text("MultiPolygon", parts, name="isles"), skipped=said.append).bodies

    assert [(body.name, len(body.parts)) for body in bodies] == [("isles", 2)]
    assert len(said) == 1
    assert said[0].startswith("feature 0 (isles), part 1: polygon 'isles' has no area")


def test_geometry_collections_are_walked():
    point, line = (
        {"type": "Point", "coordinates": [0, 0]},
        {"type": "LineString", "coordinates": [[1, 1], [2, 2]]},
    )
    inner = {"type": "GeometryCollection", "geometries": [line]}
    data = json.dumps({"type": "GeometryCollection", "geometries": [point, inner]})

    assert [(body.name, body.size) for body in scene(data).bodies] == [("body", 1), ("body 2", 2)]


def test_positions_are_written_as_the_nearest_doubles():
    third = Body("third", [("1/3", 0)], Translation(["0", "1/7"]))
    segment = Body("s", [(0, 0), (1, 1)])

    data = json.loads(geojson_of(shapes_at(Scene([third, segment], (0, 2)), QQ(1))))

    point, line = (feature["geometry"] for feature in data["features"])
    assert point == {"type": "Point", "coordinates": [10 / 21, 0.0]}
    assert line == {"type": "LineString", "coordinates": [[0.0, 0.0], [1.0, 1.0]]}


@given(st.permutations(range(4)), st.booleans())
def test_polygons_keep_their_order_and_are_closed(order, backwards):
    """RFC 7946 asks for counter-clockwise rings; contacts name vertices by their number."""
    corners = [(0, 0), (3, 0), (3, 3), (0, 3)]
    turned = [corners[(k + order[0]) % 4] for k in range(4)]
    shape = Shape("", "p", "polygon", [(QQ(x), QQ(y)) for x, y in turned[:: 1 - 2 * backwards]])

    (feature,) = json.loads(geojson_of([shape]))["features"]

    (ring,) = feature["geometry"]["coordinates"]
    assert ring[0] == ring[-1]
    assert [tuple(p) for p in ring[:-1]] == list(shape.points)


def test_there_and_back(tmp_path):
    """Doubles survive both ways, so a second trip changes nothing."""
    bodies = [
        Body("a", [(0.1, 0.2), (1.7, 0.3), (0.5, 2.9)]),
        Body("b", [(5, 5), (6.1, 7), (8, 7.2)], closed=False),
        Body("c", [(-1, -1)]),
    ]
    write_shapes(Scene(bodies), tmp_path / "one.geojson")

    again = read_shapes(tmp_path / "one.geojson", time=(2, 3))
    write_shapes(again, tmp_path / "two.geojson")

    assert (tmp_path / "one.geojson").read_text() == (tmp_path / "two.geojson").read_text()
    assert (again.start, again.end) == (2, 3)
    assert [body.name for body in again.bodies] == ["a", "b", "c"]


def test_coordinates_beyond_doubles_are_refused_when_written():
    with pytest.raises(InputError, match="body 'far': a coordinate is too large"):
        geojson_of(shapes_at(Scene([Body("far", [("1e400", 0)])]), QQ(0)))
