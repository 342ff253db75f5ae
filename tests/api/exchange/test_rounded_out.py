"""Rounded bodies as outlines: arcs become chords within the tolerance."""

import json
import math

import pytest
import shapely

from exactpt import Body, InputError, Scene, Translation, read_shapes, write_shapes
from exactpt.cli import main

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
        with pytest.raises(SystemExit) as end:
            main(["convert", str(scene), str(path), "--tolerance", tolerance])
        assert end.value.code == 0

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
