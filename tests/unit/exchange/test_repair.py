"""Repairs: what is not valid becomes a valid body, or fills nothing."""

import json
from fractions import Fraction
from random import Random

import pytest
import shapely
from commands import code_of

from exactpt import InputError, Scene, read_shapes
from fuzz.overlays import random_drawing

TIE = "POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))"


def written(tmp_path, text):
    file = tmp_path / "shapes.wkt"
    file.write_text(text)
    return file


@pytest.mark.parametrize(
    "text, area, rings",
    [
        (TIE, 8, [2]),
        ("MULTIPOLYGON (((0 0, 2 0, 0 2, 0 0)), ((2 0, 2 2, 0 2, 2 0)))", 4, [1]),
        ("MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0)), ((2 2, 6 2, 6 6, 2 6, 2 2)))", 28, [1]),
        ("MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0)), ((3 3, 5 3, 5 5, 3 5, 3 3)))", 81, [1]),
        ("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (0 0, 3 0, 3 3, 0 3, 0 0))", 72, [1]),
        ("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 2 2, 3 3, 1 1))", 81, [1]),
        ("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (0 3, 4 4, 9 3, 4 5, 0 3))", "153/2", [2]),
        ("POLYGON ((0 0, 9 0, 9 0, 9 9, 12 12, 9 9, 0 9, 0 0))", 81, [1]),
        ("POLYGON ((0 0, 4 0, 4 4, 2 0, 0 4, 0 0))", 8, [2]),
        ("LINESTRING (0 0, 4 4, 4 0, 0 4, 0 0)", 8, [2]),
        (f"{TIE} POLYGON ((9 0, 10 0, 10 1, 9 0))", "17/2", [2, 1]),
    ],
)
def test_repaired_polygons_are_valid_with_the_exact_area(tmp_path, text, area, rings):
    """A bow tie, parts with a common edge, overlapping ones, a hole along an edge, spikes."""
    file = written(tmp_path, text)
    with pytest.raises(InputError):
        read_shapes(file)

    scene = read_shapes(file, repair=True)

    shapes = scene.to_shapely(0).values()
    assert all(shape.is_valid for shape in shapes)
    assert Fraction(sum(shape.area for shape in shapes)) == Fraction(area)
    assert [len(body.rings) for body in scene.bodies] == rings


def test_a_crossing_is_exact(tmp_path):
    """The diagonals of a trapezium meet in thirds: (4/3, 4/3)."""
    scene = read_shapes(written(tmp_path, "POLYGON ((0 0, 2 2, 2 0, 0 4, 0 0))"), repair=True)

    assert (Fraction(4, 3), Fraction(4, 3)) in scene.bodies[0].at(0)


@pytest.mark.parametrize(
    "text", ["POLYGON ((0 0, 4 4, 2 2, 0 0))", "POLYGON ((0 0, 4 0, 4 4, 4 0, 0 0))"]
)
def test_what_fills_nothing_says_so(tmp_path, text):
    with pytest.raises(InputError, match="nothing of 'body 0' has an area"):
        read_shapes(written(tmp_path, text), repair=True)
    with pytest.raises(
        InputError,
        match=r"edge 0 from .* meets edge 2 from .*; only polygons are repaired: remove it",
    ):
        read_shapes(written(tmp_path, "LINESTRING (0 0, 4 0, 2 2, 2 -2)"), repair=True)


def test_a_chain_that_crosses_itself_is_not_told_to_be_repaired(tmp_path):
    """Edge 2 leads from (2, 2) to (2, -2) through (2, 0) on edge 0."""
    with pytest.raises(InputError, match=r"not a simple chain .* mend it, or leave"):
        read_shapes(written(tmp_path, "LINESTRING (0 0, 4 0, 2 2, 2 -2)"))


def test_a_bow_tie_of_equal_lobes_crosses_itself(tmp_path):
    """Its signed area is 0, and so is that of a ring without area, which is to be removed."""
    with pytest.raises(InputError, match=r"edge 0 from \(0, 0\) meets edge 2 .*mend it"):
        read_shapes(written(tmp_path, TIE))
    with pytest.raises(InputError, match="has no area: remove it"):
        read_shapes(written(tmp_path, "POLYGON ((0 0, 4 4, 1 1, 0 0))"))


def test_crossing_edges_are_shown_as_decimals(tmp_path):
    text = "POLYGON ((13.383529 52.515496, 13.4 52.6, 13.4 52.515496, 13.383529 52.6))"
    with pytest.raises(InputError, match=r"edge 0 from \(13\.383529, 52\.515496\) meets edge 2"):
        read_shapes(written(tmp_path, text.replace("))", ", 13.383529 52.515496))")))


@pytest.mark.parametrize("options", [{"repair": True}, {}])
def test_callbacks_are_beside_the_switches(tmp_path, options):
    """A callback alone is enough, as is the switch alone."""
    file = written(tmp_path, f"{TIE}\nPOLYGON ((0 0, 1 1, 2 2, 0 0))")
    repaired, skipped = [], []

    scene = read_shapes(file, repaired=repaired.append, skipped=skipped.append, **options)

    assert len(scene.bodies) == 1
    assert len(repaired) == len(skipped) == 1
    assert "repaired 'body 0' (not a simple polygon" in repaired[0]
    assert "nothing of 'body 1' has an area" in skipped[0]
    assert read_shapes(file, repair=True, skip_invalid=True).bodies == scene.bodies


def test_properties_and_unchanged_rings_stay(tmp_path):
    """The part that is not affected keeps its first vertex and its orientation."""
    part = [[5, 9], [6, 9], [6, 8], [5, 9]]
    tie = [[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]
    geometry = {"type": "MultiPolygon", "coordinates": [[tie], [part]]}
    feature = {"type": "Feature", "properties": {"name": "x", "kind": 3}, "geometry": geometry}
    file = tmp_path / "shapes.geojson"
    file.write_text(json.dumps(feature))

    (body,) = read_shapes(file, repair=True).bodies

    assert body.properties["kind"] == 3
    last = body.rings[-1]
    assert body.at(0)[last.start : last.stop] == [tuple(p) for p in part[:3]]


@pytest.mark.parametrize("parts, sizes", [("keep", [6]), ("split", [3, 3])])
def test_the_parts_of_a_repaired_polygon_may_be_split(tmp_path, parts, sizes):
    scene = read_shapes(written(tmp_path, TIE), repair=True, parts=parts)

    assert [body.size for body in scene.bodies] == sizes


def test_filled_holes_take_no_part_in_a_repair(tmp_path):
    text = "POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0), (1 2, 9 2, 9 3, 1 2))"

    scene = read_shapes(written(tmp_path, text), repair=True, holes="fill")

    assert sum(shape.area for shape in scene.to_shapely(0).values()) == 8


@pytest.mark.parametrize("seed", range(60))
def test_every_drawing_ends_with_a_valid_body_or_without_area(tmp_path, seed):
    """As MultiPolygons of random rings: what is valid in exact arithmetic, a scene accepts."""
    drawing = random_drawing(Random(f"repair {seed}"))
    rings = [[*ring, ring[0]] for ring in drawing.rings if drawing.kind != "out of range"]
    if not rings:
        return
    polygons = [[[[float(x), float(y)] for x, y in ring]] for ring in rings]
    file = tmp_path / "shapes.geojson"
    file.write_text(json.dumps({"type": "MultiPolygon", "coordinates": polygons}))
    said = []
    bodies = read_shapes(file, repair=True, skipped=said.append).bodies

    assert len(bodies) == (not said)
    assert all("has an area" in line or "has no area" in line for line in said)
    assert Scene(bodies).bodies == bodies


def test_the_command_repairs_and_leaves_out(tmp_path, capsys):
    file, target = written(tmp_path, f"{TIE}\nPOLYGON ((0 0, 1 1, 2 2, 0 0))"), tmp_path / "a.json"

    assert code_of("convert", file, target, "--repair", "--skip-invalid") == 0

    messages = capsys.readouterr().err
    assert "1 polygon of 4 vertices became 2 polygons of 6 vertices" in messages
    assert "left out: " in messages
    assert shapely.union_all(list(Scene.load(target).to_shapely(0).values())).area == 8


@pytest.mark.parametrize("ending", ["wkt", "svg"])
def test_too_many_crossings_are_refused(tmp_path, monkeypatch, ending):
    """Each edge of this ring crosses most others: the memory is bounded."""
    monkeypatch.setattr("exactpt.geometry.overlay.MAX_CUTS", 100)
    points = [(k, 100 * (k % 2)) for k in range(60)] + [(60, 50), (-1, 50)]
    file = tmp_path / f"shapes.{ending}"
    ring = ", ".join(f"{x} {y}" for x, y in [*points, points[0]])
    texts = {"wkt": f"POLYGON (({ring}))", "svg": f'<svg><polygon points="{ring}"/></svg>'}
    file.write_text(texts[ending])

    with pytest.raises(InputError, match=r"0.*: its edges cross or touch in more than 50 points"):
        read_shapes(file, repair=True)
