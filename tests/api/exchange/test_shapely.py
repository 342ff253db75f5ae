"""Shapely geometries and numpy arrays; rounded bodies as outlines; damaged files of shapes."""

import json
import math
import random
import warnings

import numpy
import pytest
import shapely
from commands import code_of

import exactpt
from exactpt import Body, InputError, Scene, Translation, read_shapes, write_shapes
from exactpt.kernel.numbers import QQ


def test_a_body_from_a_geometry_has_the_exact_values_of_its_doubles():
    triangle = shapely.Polygon([(0.1, 0), (1, 0), (0, 1)])

    body = exactpt.Body.from_shapely(triangle, "t", exactpt.Translation([0, 1]))

    assert body.at(2) == [(QQ(*(0.1).as_integer_ratio()) + 2, 0), (3, 0), (2, 1)]


def test_a_body_has_one_part():
    points = shapely.MultiPoint([(0, 0), (1, 1)])

    with pytest.raises(exactpt.InputError, match=r"'m' has 2 parts.*see Scene.from_shapely"):
        exactpt.Body.from_shapely(points, "m")
    with pytest.raises(exactpt.InputError, match="not a shapely geometry: 'POINT"):
        exactpt.Body.from_shapely("POINT (0 0)", "m")


def test_a_scene_from_geometries_and_back():
    ring = shapely.Point(0, 0).buffer(3).difference(shapely.Point(0, 0).buffer(1))
    given = {"ring": ring, "dots": shapely.MultiPoint([(5, 5), (7, 7)])}

    with pytest.raises(exactpt.InputError, match="geometry 0: polygon 'ring' has 1 hole"):
        exactpt.Scene.from_shapely(given, holes="refuse")
    assert exactpt.Scene.from_shapely(given).to_shapely(0)["ring"].equals(ring)
    scene = exactpt.Scene.from_shapely(given, time=(0, 5), holes="fill")
    back = scene.to_shapely(4)

    assert list(back) == ["ring", "dots", "dots 2"]
    assert back["ring"].equals(shapely.Polygon(ring.exterior))
    assert back["dots 2"] == shapely.Point(7, 7)
    assert scene.end == 5


def test_geometries_in_order_are_numbered():
    scene = exactpt.Scene.from_shapely(
        [shapely.box(0, 0, 1, 1), shapely.LineString([(3, 0), (4, 1)])]
    )

    assert [body.name for body in scene.bodies] == ["body 0", "body 1"]
    with pytest.raises(exactpt.InputError, match="t = 2 is outside the time span from 0 to 1"):
        scene.to_shapely(2)


@pytest.mark.parametrize("kind", [float, numpy.float32, int, numpy.int16, object])
def test_vertices_as_an_array(kind):
    array = numpy.array([[0, 0], [1, 0], [1, 3]], dtype=kind)

    assert exactpt.Body("b", array).at(0) == [(0, 0), (1, 0), (1, 3)]


def test_an_array_of_singles_is_exact():
    """A numpy.float32 is no Python float, but it has an exact value all the same."""
    array = numpy.array([[0.1, 0.2]], dtype=numpy.float32)

    (point,) = exactpt.Body("b", array).at(0)

    assert point == tuple(QQ(*float(c).as_integer_ratio()) for c in array[0])


# Rounded bodies as outlines: arcs become chords within the tolerance

SCENE = Scene(
    [
        Body("disc", [(0, 0)], Translation([0, 2]), radius=3),
        Body("pill", [(10, 0), (10, 4)], radius="1/2"),
        Body("box", [(20, 0), (22, 0), (22, 2), (20, 2)], radius=1),
        Body("ring", [(30, 0), (40, 0), (40, 10), (30, 10), (30, 1)], closed=False, radius=1),
        Body("plain", [(50, 0), (52, 0), (50, 2)]),
    ],
    (0, 9),
)
AREAS = {
    "disc": 9 * math.pi,
    "pill": 4 + math.pi / 4,
    "box": 4 + 8 + math.pi,
    "plain": 2.0,
}


@pytest.mark.parametrize("tolerance", [0.3, 0.1, 0.001])
def test_geometries_are_within_the_tolerance(tolerance):
    """Every chord is inside of the body, and nowhere farther from its boundary than allowed."""
    for name, geometry in SCENE.to_shapely(0, tolerance=tolerance).items():
        body = SCENE.body(name)
        core = Scene([Body(name, body.at(0), closed=body.closed)]).to_shapely(0)[name]
        if not body.radius:
            assert geometry.equals(core)
            continue
        for ring in (geometry.exterior, *geometry.interiors):
            for x, y in ring.coords:
                far = core.distance(shapely.Point(x, y))
                assert -tolerance - 1e-9 <= far - float(body.radius) <= 1e-9
            middles = shapely.segmentize(ring, 0.01)
            away = [core.distance(shapely.Point(p)) for p in middles.coords]
            assert min(away) >= float(body.radius) - tolerance - 1e-9


def test_the_default_is_a_hundredth_of_the_radius():
    for name, area in AREAS.items():
        assert SCENE.to_shapely(0)[name].area == pytest.approx(area, rel=0.02)
    assert SCENE.to_shapely(9)["disc"].centroid.x == pytest.approx(18)
    assert len(SCENE.to_shapely(0)["ring"].interiors) == 1


@pytest.mark.long("geojson")
@pytest.mark.parametrize("ending", ["geojson", "wkt", "svg"])
def test_files_hold_the_outlines(tmp_path, ending):
    path = tmp_path / f"shapes.{ending}"
    write_shapes(SCENE, path, 1, tolerance=0.01)
    found = read_shapes(path).to_shapely(0).values()
    filled = read_shapes(path, holes="fill").to_shapely(0).values()

    expected = SCENE.to_shapely(1, tolerance=0.01).values()
    for geometry, full, whole in zip(found, filled, expected, strict=True):
        assert geometry.symmetric_difference(whole).area < 1e-9
        assert full.symmetric_difference(shapely.Polygon(whole.exterior)).area < 1e-9
    with pytest.raises(InputError, match="hole"):
        read_shapes(path, holes="refuse")


def test_holes_run_clockwise_in_geojson(tmp_path):
    path = tmp_path / "ring.geojson"
    write_shapes(SCENE, path)
    features = json.loads(path.read_text())["features"]
    (outer, hole) = features[3]["geometry"]["coordinates"]

    assert shapely.LinearRing(outer).is_ccw
    assert not shapely.LinearRing(hole).is_ccw


@pytest.mark.parametrize("tolerance", [0.0, -1.0, math.nan, math.inf, 1e-12])
def test_tolerances_that_are_none(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        SCENE.to_shapely(0, tolerance=tolerance)


def test_the_command_takes_a_tolerance(tmp_path):
    scene, fine, coarse = (tmp_path / name for name in ("s.json", "fine.wkt", "coarse.wkt"))
    SCENE.save(scene)
    for path, tolerance in ((fine, "0.001"), (coarse, "0.5")):
        assert code_of("convert", scene, path, "--tolerance", tolerance) == 0

    assert len(fine.read_text()) > 3 * len(coarse.read_text())


@pytest.mark.parametrize("radius", ["1e-40", "1e-400"])
@pytest.mark.parametrize("ending", ["geojson", "wkt", "svg"])
def test_bug_radii_that_no_double_shows(tmp_path, ending, radius):
    """The core is written: shapely's outline around it is empty."""
    scene = Scene(
        [Body("dot", [(1, -3)], radius=radius), Body("bar", [(5, 0), (9, 1)], radius=radius)]
    )
    path = tmp_path / f"shapes.{ending}"

    write_shapes(scene, path)

    if ending != "svg":
        assert [body.size for body in read_shapes(path).bodies] == [1, 2]
    assert [g.geom_type for g in scene.to_shapely(0).values()] == ["Point", "LineString"]


# Damaged files of shapes: read, or refused with one line; never anything else

GEOJSON = """{"type": "FeatureCollection", "features": [
 {"type": "Feature", "id": 7, "properties": {"name": "a"}, "geometry":
  {"type": "MultiPolygon", "coordinates": [[[[0, 0], [3, 0], [3.5, 3e0], [0, 3], [0, 0]],
   [[1, 1], [2, 1], [1, 2], [1, 1]]], [[[9, 9], [10, 9], [9, 10], [9, 9]]]]}},
 {"type": "Feature", "properties": null, "geometry": {"type": "GeometryCollection", "geometries": [
  {"type": "Point", "coordinates": [20, 1, 5]}, {"type": "LineString", "coordinates":
   [[30, 0], [31, -1], [32, 0.25]]}]}}]}"""
WKT = """POLYGON ((0 0, 3 0, 3.5 3e0, 0 3, 0 0), (1 1, 2 1, 1 2, 1 1))
MULTILINESTRING Z ((20 0 1, 21 1 1, 22 0 1), (30 0 1, 31 0 1));
GEOMETRYCOLLECTION (POINT (40 1), MULTIPOINT ((41 1), (42 -1.5)))"""
SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 60" width="45mm">
 <defs><path id="t" d="M0 0h2v3z"/><clipPath id="c"><circle r="3"/></clipPath></defs>
 <g transform="translate(3 4) rotate(30) scale(1 2)"><use href="#t" x="9"/>
 <rect x="1" y="2" width="3" height="4" rx="1"/></g><ellipse cx="40" cy="9" rx="5" ry="3"/>
 <path d="M60 10 C 70 0 80 20 70 30 S 50 30 60 10 Z M63 12 a2 1 20 1 0 4 4 z" fill-rule="evenodd"/>
 <polyline points="5,50 9,55 14,50"/><line x1="20" y1="50" x2="29" y2="59" style="display:inline"/>
</svg>"""
ODD = [
    "", "0", "-", "1e999", "1e-999", "1e9999999", "NaN", "null", "[", "]", "{", "}", "(", ")", "<",
    ">", '"', ",", "\\", "\x00", "\ud7ff", "EMPTY", "%", "url(#x)", "#t", "none", "1/0", "M", "a",
]  # fmt: skip


def damaged(text, rng):
    for _ in range(rng.choice([1, 1, 2, 5])):
        i, j = sorted(rng.randrange(len(text) + 1) for _ in range(2))
        j = min(j, i + rng.choice([0, 1, 1, 3, 30]))
        text = text[:i] + rng.choice([*ODD, text[i:j] * 2]) + text[j:]
    return text


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("ending, text", [("geojson", GEOJSON), ("wkt", WKT), ("svg", SVG)])
def test_damaged_files(ending, text, seed, tmp_path):
    rng = random.Random(f"{ending}:{seed}")
    file = tmp_path / f"shapes.{ending}"
    refused = []
    for _ in range(50):
        file.write_text(damaged(text, rng), encoding="utf-8")
        try:
            with warnings.catch_warnings(action="ignore"):
                read_shapes(file, holes=rng.choice(["fill", "refuse"]), tolerance=0.5)
        except InputError as error:
            refused.append(str(error))
    assert refused
    assert [line for line in refused if "\n" in line or not line.startswith(str(file))] == []


def test_geometry_that_is_empty_is_refused_or_left_out():
    """An empty collection vanished without a word."""
    given = {"a": shapely.GeometryCollection(), "b": shapely.Point(1, 2)}

    with pytest.raises(InputError, match="geometry 0: point 'a' is empty: remove it"):
        Scene.from_shapely(given)
    assert [body.name for body in Scene.from_shapely(given, skip_invalid=True).bodies] == ["b"]


def test_polygon_that_crosses_itself_is_repaired_on_request():
    """Two triangles of base 4 and height 2: the area is 8."""
    tie = shapely.Polygon([(0, 0), (4, 4), (4, 0), (0, 4)])

    (body,) = Scene.from_shapely({"tie": tie}, repair=True).bodies

    assert len(body.parts) == 2
    assert Scene([body]).to_shapely(0)["tie"].area == 8


def test_one_geometry_and_coordinates_that_are_no_numbers_are_named():
    with pytest.raises(InputError, match="geometries: not a list, but one geometry"):
        Scene.from_shapely(shapely.Point(1, 2))
    with pytest.raises(InputError, match=r"geometry 0 \(a\): not a finite number: nan"):
        Scene.from_shapely({"a": shapely.Point(math.nan, 1)})
