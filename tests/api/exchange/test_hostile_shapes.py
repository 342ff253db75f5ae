"""Damaged files of shapes: read, or refused with one line; never anything else."""

import random
import warnings

import pytest

from exactpt.errors import InputError
from exactpt.exchange.files import read_shapes

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
